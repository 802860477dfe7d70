"""A part program in motion: limits of its rows, look-ahead, time, and the axes on it."""
