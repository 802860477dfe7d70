"""What no manual prints and still looks like a slip: recommendations, each marked as ours.

Like axes against each other, usual figures, and tables in which a single value jumps out. The facts behind it are data
(``plausible.yaml`` of a family); nothing here knows a parameter.
"""

from .experience import TITLES, Experience

__all__ = ["TITLES", "Experience"]
