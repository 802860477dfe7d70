"""Inertia and friction of an axis out of the record of its drive, and the machine kept as a file."""
