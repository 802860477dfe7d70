"""Verbs that make, change and read parameter files."""
