"""Several values entered at once: what would change, what is the same, what is refused and why,
before anything changes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from amp_studio.schema import Address, InvalidValueError, Value, same_value

from .parameter_file import ParameterFile, RangeError

ReadText = Callable[[Address, str], Value | None]
"""Reads what is meant for an address by a text; raises InvalidValueError."""
# As `get` and the table print it, so that what was copied there can be entered again.
_NOT_SET = ("not set", "not-set", "—")


@dataclass(frozen=True, slots=True)
class EnteredCell:
    """One value of a block: its text, what it was read as, and why it is refused."""

    address: Address
    text: str
    old: Value | None
    new: Value | None = None
    problem: str = ""

    @property
    def changes(self) -> bool:
        """Whether it would change the file."""
        return not self.problem and self.old != self.new


@dataclass(frozen=True)
class BlockEntry:
    """What entering a block would do."""

    cells: tuple[EnteredCell, ...]

    @property
    def changed(self) -> dict[Address, Value | None]:
        """The values that would change."""
        return {cell.address: cell.new for cell in self.cells if cell.changes}

    @property
    def refused(self) -> tuple[EnteredCell, ...]:
        """The cells that are refused."""
        return tuple(cell for cell in self.cells if cell.problem)

    @property
    def same(self) -> int:
        """How many are so already."""
        return sum(not cell.problem and not cell.changes for cell in self.cells)


def plan_entry(file: ParameterFile, texts: Mapping[Address, str], read: ReadText) -> BlockEntry:
    """Return what entering texts would do; the file itself is not changed.

    ``not set`` clears a value. The values are tried together, as two that bound each other may move together;
    those out of range are refused, and the others are tried again without them.
    """
    read_all = {address: _read(file, address, text, read) for address, text in texts.items()}
    return _tried(file, texts, read_all)


def plan_values(file: ParameterFile, wanted: Mapping[Address, Value | None]) -> BlockEntry:
    """Return what setting values would do; the file itself is not changed."""
    cells = {a: _cell(file, a, "", value) for a, value in wanted.items()}
    return _tried(file, dict.fromkeys(wanted, ""), cells)


def _tried(
    file: ParameterFile, texts: Mapping[Address, str], cells: dict[Address, EnteredCell]
) -> BlockEntry:
    """Return the cells with those refused that are out of range beside the others."""
    wanted = {a: cell.new for a, cell in cells.items() if cell.changes}
    # Each round refuses one value at least, so that it ends.
    while wanted:
        try:
            file.copy().set_checked(wanted)
            break
        except RangeError as error:
            for address, problem in error.faults.items():
                old = cells[address].old
                cells[address] = EnteredCell(address, texts[address], old, wanted.pop(address), problem)
    return BlockEntry(tuple(cells.values()))


def _read(file: ParameterFile, address: Address, text: str, read: ReadText) -> EnteredCell:
    old = file.get(address)
    if text.strip().casefold() in _NOT_SET:
        return _cell(file, address, text, None)
    try:
        return _cell(file, address, text, read(address, text))
    except InvalidValueError as error:
        return EnteredCell(address, text, old, None, str(error))


def _cell(file: ParameterFile, address: Address, text: str, new: Value | None) -> EnteredCell:
    """Return what a value would do: refused where it cannot be set, no change where it is the same."""
    old, parameter = file.get(address), file.schema.parameters[address[0]]
    if parameter.access == "read" and old != new:
        problem = f"{parameter.name} can only be read: the control writes it itself"
        return EnteredCell(address, text, old, new, problem)
    state = file.evaluation.state(address)
    if state.state == "hidden" and new is not None:
        return EnteredCell(address, text, old, new, f"{parameter.name} does not exist here: {state.why}")
    # The same in another unit is no change, and stays written as it was.
    kept = old if old is not None and new is not None and same_value(old, new) else new
    return EnteredCell(address, text, old, kept)
