"""Loops: the linear model, what makes one sound, and the one solver that every recommended gain comes
from.
"""
