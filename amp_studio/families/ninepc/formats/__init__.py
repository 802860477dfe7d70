"""Text formats of the 9/PC: the sheet of Patch AMP."""
