"""Emulated controls: their memory on disk, what they do with a request, and the process that serves them."""
