"""Text formats of Grbl and grblHAL."""
