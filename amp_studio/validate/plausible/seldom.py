"""Values that nearly every machine keeps as delivered, and this one does not."""

from __future__ import annotations

from collections.abc import Iterator

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, show_value
from amp_studio.validate.finding import Finding

SELDOM = "plausible.seldom"
REASON = "ours, not the manual's: nearly every machine keeps the printed default here"


class SeldomChanged:
    """The values of one file that are seldom changed, as the facts of its family name them."""

    def __init__(self, file: ParameterFile) -> None:
        self._file, self._names = file, frozenset(file.schema.plausible.seldom)
        self._findings: dict[Address, Finding] = {}

    def check_all(self) -> None:
        """Look at every value."""
        self._findings.clear()
        for address in [a for a in self._file.values if a[0] in self._names]:
            self.recheck(address)

    def recheck(self, address: Address) -> bool:
        """Look at one value again; returns whether anything is otherwise."""
        if address[0] not in self._names:
            return False
        before, file = self._findings.pop(address, None), self._file
        # A control that describes itself prints no defaults: nothing is known of what it was delivered with.
        has_default = address in file.values and file.default(address) is not None
        is_changed = has_default and not file.is_default(address)
        if is_changed and file.evaluation.state(address).is_active:
            self._findings[address] = self._finding(address)
        return self._findings.get(address) != before

    def findings(self) -> Iterator[Finding]:
        """Yield what was found."""
        yield from self._findings.values()

    def _finding(self, address: Address) -> Finding:
        schema, parameter = self._file.schema, self._file.schema.parameters[address[0]]
        label, default = schema.on(self._file.machine).label(address), self._file.default(address)
        assert default is not None  # as recheck has seen
        printed = show_value(parameter, default)
        text = show_value(parameter, self._file.values[address])
        message = f"{label} is {text}; nearly every machine keeps the default {printed}. Is it meant?"
        return Finding(SELDOM, "advice", (address,), message, reason=REASON)
