"""Verbs about findings, fixes and differences."""
