"""Numbers as the 9/PC manual prints them, and nonsense refused."""

from collections.abc import Callable
from decimal import ROUND_HALF_UP, Decimal

import pytest


def as_printed(value: float, decimals: int = 0) -> float:
    """Return the value as the manual would print it: rounded half up to so many decimals."""
    # Twelve significant digits first, so that 0.1 + 0.2 counts as the 0.3 it means.
    plain = Decimal(f"{value:.12g}")
    return float(plain.quantize(Decimal(1).scaleb(-decimals), rounding=ROUND_HALF_UP))


def assert_refused(call: Callable[[], object], message: str) -> None:
    """Nonsense is refused with one sentence."""
    with pytest.raises(ValueError) as error:  # noqa: PT011  # its text is compared below
        call()
    text = str(error.value)
    assert message in text
    assert text.endswith(".")
    assert "\n" not in text
