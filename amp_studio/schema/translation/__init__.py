"""The facts of a family in another language: loaded when that language is asked for, kept compiled."""
