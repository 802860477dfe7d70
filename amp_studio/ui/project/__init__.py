"""The project: its tree, its files and their check."""
