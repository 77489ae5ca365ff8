"""The past: checkpoints and the commands between them, so that a run can be replayed and forked to the bit."""
