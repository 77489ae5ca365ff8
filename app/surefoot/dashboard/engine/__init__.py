"""The session thread, the worker processes that simulate, pacing and twin coordination."""
