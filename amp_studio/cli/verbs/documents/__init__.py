"""Verbs that print, and those that read and write text formats."""
