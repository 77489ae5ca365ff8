"""The paper, rerun and interrogated: its figures, its claims, every number and every reading of a gap."""
