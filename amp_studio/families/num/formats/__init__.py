"""Text formats of the NUM controls: the parameter table."""
