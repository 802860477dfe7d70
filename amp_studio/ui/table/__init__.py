"""The table of parameters: its cells, heads and editors,
the filter above it and the panel of one parameter beside it.
"""
