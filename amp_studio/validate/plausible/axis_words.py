"""A word with a bit for each axis, against the axes that are there."""

from __future__ import annotations

from collections.abc import Iterator

from amp_studio.files import ParameterFile, axis_instances, shown_axes
from amp_studio.schema import Address
from amp_studio.validate.finding import Finding

NO_AXIS = "plausible.no-axis"
REASON = "ours, not the manual's: a bit of an axis that is not there does nothing until somebody fits one"


class AxisWords:
    """The words by axes of one file, as the facts of its family name them."""

    def __init__(self, file: ParameterFile) -> None:
        self._file, self._names = file, frozenset(file.schema.plausible.axis_words)
        self._findings: dict[Address, Finding] = {}
        self._there = 0
        """A bit for each axis whose input is used."""

    def check_all(self) -> None:
        """Look at every word."""
        self._findings.clear()
        if not self._names:
            return
        there, every = set(shown_axes(self._file)), axis_instances(self._file)
        # Bit n is the n-th axis of the family, whether this machine has it or not.
        self._there = sum(1 << n for n, axis in enumerate(every) if axis in there)
        for address in self._file.values:
            self.recheck(address)

    def recheck(self, address: Address) -> bool:
        """Look at one word again; returns whether anything is otherwise."""
        if address[0] not in self._names:
            return False
        before = self._findings.pop(address, None)
        value = self._file.values.get(address)
        if value is not None and isinstance(value.value, int) and value.value & ~self._there:
            bits = value.value & ~self._there
            every = axis_instances(self._file)
            named = [axis for n, axis in enumerate(every) if bits >> n & 1]
            if named and self._file.evaluation.state(address).is_active:
                self._findings[address] = self._finding(address, named)
        return self._findings.get(address) != before

    def findings(self) -> Iterator[Finding]:
        """Yield what was found."""
        yield from self._findings.values()

    def _finding(self, address: Address, axes: list[str]) -> Finding:
        label = self._file.schema.on(self._file.machine).label(address)
        which = f"axis {axes[0]}, which is" if len(axes) == 1 else f"axes {', '.join(axes)}, which are"
        message = f"{label} has the bit of {which} not there. Is it meant?"
        return Finding(NO_AXIS, "advice", (address,), message, reason=REASON)
