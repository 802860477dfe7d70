"""Blocks and programs: what a control makes of a part program under a file."""
