"""The command line: a module a command, with its flags and what it prints."""
