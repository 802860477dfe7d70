"""Exit codes of verbs; ``cli`` explains them."""

FAULT, CHANGED, UNKNOWN = 2, 3, 4
AT_CONTROL = {"old": FAULT, "new": CHANGED, "mixed": CHANGED, "defaults": CHANGED, "unknown": UNKNOWN}
"""The exit code of an exchange by what the control contains after it."""
