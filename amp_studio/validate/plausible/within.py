"""Positions outside the travel of their axis: a zone, a reference point,
a home position that the axis never reaches.
"""

from __future__ import annotations

from collections.abc import Iterator

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, TravelSpan, canonical, dimension, show_value
from amp_studio.validate.finding import Finding

OUTSIDE = "plausible.outside-travel"
REASON = (
    "ours, not the manual's: the axis stops at the end of its travel and never reaches a position behind it"
)


class WithinTravel:
    """The positions of one file against the ends of travel, as the facts of its family name them."""

    def __init__(self, file: ParameterFile) -> None:
        self._file = file
        self._of: dict[str, list[TravelSpan]] = {}
        """Parameter -> the travels that it is an end of, or a position in."""
        for travel in file.schema.plausible.within:
            for name in (travel.low, travel.high, *travel.inside):
                self._of.setdefault(name, []).append(travel)
        self._findings: dict[Address, Finding] = {}

    def check_all(self) -> None:
        """Look at every position."""
        self._findings.clear()
        if self._of:
            for address in self._file.values:
                if address[0] in self._of:
                    self._check_position(address)

    def recheck(self, address: Address) -> bool:
        """Look again at a position, or at all of an axis whose travel changed;
        returns whether anything is otherwise.
        """
        travels, instance = self._of.get(address[0], ()), address[1]
        positions = {(name, instance) for travel in travels for name in travel.inside}
        before = {a: self._findings.pop(a, None) for a in positions}
        # A changed end moves for all positions of its axis, those that had no finding too.
        for position in positions:
            self._check_position(position)
        return any(self._findings.get(a) != found for a, found in before.items())

    def findings(self) -> Iterator[Finding]:
        """Yield what was found."""
        yield from self._findings.values()

    def _check_position(self, address: Address) -> None:
        """Compare one position with each travel that it is in."""
        for travel in self._of[address[0]]:
            if address[0] not in travel.inside:
                continue
            ends = (travel.low, address[1]), (travel.high, address[1])
            at, low, high = map(self._position, (address, *ends))
            # Ends that are equal or the wrong way round enclose nothing: every position would be outside.
            if at is None or low is None or high is None or low >= high:
                continue
            # A share of the travel and no length: a lathe and a gantry have the same fact.
            slack = travel.beyond * (high - low)
            if not low - slack <= at <= high + slack:
                self._findings[address] = self._finding(address, ends)

    def _position(self, address: Address) -> float | None:
        """Return an active position in the canonical unit of a length or an angle; None for none."""
        value = self._file.values.get(address)
        if value is None or isinstance(value.value, bool | str):
            return None
        if (
            dimension(value.unit) != self._measures(address)
            or not self._file.evaluation.state(address).is_active
        ):
            return None
        return canonical(value.value, value.unit)

    def _measures(self, address: Address) -> str:
        low = self._file.values.get((self._of[address[0]][0].low, address[1]))
        return dimension(low.unit) if low is not None else ""

    def _finding(self, address: Address, ends: tuple[Address, Address]) -> Finding:
        here, parameters = self._file.schema.on(self._file.machine), self._file.schema.parameters
        at, low, high = (show_value(parameters[a[0]], self._file.values[a]) for a in (address, *ends))
        message = (
            f"{here.label(address)} is {at}, outside the travel of its axis from {low} to {high}. Is it"
            " meant?"
        )
        return Finding(OUTSIDE, "advice", (address,), message, compared=ends, reason=REASON)
