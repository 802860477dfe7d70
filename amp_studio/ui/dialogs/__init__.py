"""Dialogs that belong to no other folder."""
