"""Verbs about the facts of the families."""
