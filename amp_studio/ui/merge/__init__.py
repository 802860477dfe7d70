"""Comparing and merging files and machines."""
