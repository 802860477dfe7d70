"""Text formats of LinuxCNC."""
