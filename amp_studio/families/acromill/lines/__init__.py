"""Speaking to an ACR card: its terminal, a line at a time."""
