"""Who may connect, which client is calling, and who drives."""
