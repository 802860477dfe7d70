"""Verbs at a control or a serial line."""
