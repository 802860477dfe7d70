"""The pictures of the machine, live beside the table."""
