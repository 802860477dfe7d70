"""Numbers as the 9/PC manual prints them."""

from decimal import ROUND_HALF_UP, Decimal


def as_printed(value: float, decimals: int = 0) -> float:
    """Return the value as the manual would print it: rounded half up to so many decimals."""
    # Twelve significant digits first, so that 0.1 + 0.2 counts as the 0.3 it means.
    plain = Decimal(f"{value:.12g}")
    return float(plain.quantize(Decimal(1).scaleb(-decimals), rounding=ROUND_HALF_UP))
