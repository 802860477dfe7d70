"""Verbs about this program."""
