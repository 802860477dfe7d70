"""Live: what a control states of itself now, beside the file, with one value at a time to turn."""
