"""Findings in words and as data: by rule, alike ones as one, for a terminal, a list or a page."""
