"""Verbs about the machine in motion, its pictures and its errors."""
