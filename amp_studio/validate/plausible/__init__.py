"""What no manual prints and still looks like a slip: recommendations, each marked as ours.

Like axes against each other, usual figures, tables in which a single value jumps out, and the file against
what it was. The facts behind it are data (``plausible.yaml`` of a family); nothing here knows a parameter.
"""

from .earlier import Earlier, values_of_fleet
from .experience import OF_A_SLIP, TITLES, Experience

__all__ = ["OF_A_SLIP", "TITLES", "Earlier", "Experience", "values_of_fleet"]
