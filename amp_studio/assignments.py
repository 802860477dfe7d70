"""Assignments as a user types them, each read in the light of those before it: all of them or none."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from numbers import Real
from types import NoneType
from typing import TYPE_CHECKING

from amp_studio.errors import AmpStudioError
from amp_studio.schema import Value
from amp_studio.value_rows import ParameterEntry

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.schema import Address

    NewValues = Mapping[str, "NewValue | ParameterEntry"] | Sequence[tuple[str, "NewValue | ParameterEntry"]]

# As in ``machine``, a function imports what it needs: a start loads no more than its verb uses.

CLEARING_TEXT = "not-set"
"""The text of an assignment that clears a parameter."""

NewValue = str | float | bool | Value | None
"""What can be set: a text as a user types it (``5 mm``), a number in the unit of the file, yes or no,
a Value, None to clear."""


class MachineError(AmpStudioError, ValueError):
    """What was asked of a machine cannot be done; nothing was changed, and nothing was written."""


class AssignmentError(MachineError):
    """Values that cannot be set; the text names each of them, and nothing was changed."""


def refused(error: Exception) -> AmpStudioError:
    """Return an error of the system or of Python as one of the program; one of the program as it is."""
    if isinstance(error, AmpStudioError):
        return error
    if isinstance(error, OSError) and error.strerror:
        return MachineError(f"{error.filename}: {error.strerror}")
    return MachineError(str(error))


def need_name(axis: str | None) -> None:
    """Refuse an empty name, which is no axis and not the first one."""
    if axis is not None and not axis.strip():
        raise MachineError("an axis is named, as X or 1, or left out")


def read_assignments(
    file: ParameterFile,
    assignments: Iterable[tuple[str, str | Value]],
    notify: Callable[[str], object] = lambda _message: None,
) -> dict[Address, Value | None]:
    """Read assignments in order, each in the light of those before it; the file itself is not changed.

    Raises AssignmentError that names everything that cannot be set. ``notify`` is called with which parameter
    a number means that is printed for several. A value is cleared by ``CLEARING_TEXT`` only:
    an empty text may be a variable without a value.
    """
    from amp_studio.schema import UnknownParameterError, fault

    trial = file.copy()
    values: dict[Address, Value | None] = {}
    slips: list[str] = []
    for param, text in assignments:
        try:
            message = _assign(trial, values, param, text)
        except UnknownParameterError as error:
            slips.append(str(error))
        except (TypeError, ValueError) as error:  # a Value of a list, for one
            slips.append(f"{param}: {error}")
        else:
            if message:
                notify(message)
    if slips:
        # Only beside slips: without any, the file itself refuses what is out of range, unless it is
        # forced.
        faults = ((a, fault(trial.evaluation, a, v)) for a, v in values.items() if v is not None)
        slips += [f"{trial.machine_schema.short(a)}: {bad}" for a, bad in faults if bad]
        raise AssignmentError("; ".join(slips))
    return values


def _assign(trial: ParameterFile, values: dict[Address, Value | None], param: str, text: str | Value) -> str:
    """Set one value in the copy and in ``values``; returns which parameter its number means
    where it is printed for several. Raises UnknownParameterError, TypeError and ValueError.
    """
    from amp_studio.schema import resolve_address

    resolved = resolve_address(trial.evaluation, param)
    address = resolved.address
    if isinstance(text, Value):
        trial.set(address, text)
        values[address] = trial.get(address)
        return ""
    value = _read_assigned(trial, param, address, resolved.bit, text)
    # Several fields of one word are no contradiction.
    if resolved.bit is None and values.get(address, value) != value:
        raise ValueError("it is given two values")
    values[address] = value
    trial.set(address, value)
    return resolved.remark(trial.schema)


def _read_assigned(
    trial: ParameterFile, param: str, address: Address, bit: int | None, text: str
) -> Value | None:
    """Return the value that a text gives an address, or one bit of it; None clears it. Raises ValueError."""
    if not text:
        raise ValueError(
            f"no value is given ({param}={CLEARING_TEXT} clears it)" if bit is None else "no value is given"
        )
    if bit is not None:
        return _with_bit(trial, address, bit, text)
    return None if _clears(text) else _entered(trial, address, text)


def _entered(file: ParameterFile, address: Address, text: str) -> Value | None:
    """Read a value, or an expression behind ``=``; raises InvalidValueError.

    The user does not see the result before it is set, so that what only looks like one (``10-5``) is none.
    """
    from amp_studio.validate import enter

    if not text.lstrip().startswith("="):
        return file.read(address, text)
    return enter(file, address, text, lambda a: file.evaluation.unit(a, file.header.units)).value


def _clears(text: str) -> bool:
    """Return whether a text is ``CLEARING_TEXT``, also as ``get`` prints it: not set."""
    return "-".join(text.casefold().split()) == CLEARING_TEXT


def _with_bit(file: ParameterFile, address: Address, bit: int, text: str) -> Value:
    """Return the value of a word of bits with one field changed;
    a word that is not set counts as its default, or 0.
    """
    from amp_studio.schema import field_at, with_field

    field = field_at(file.schema.parameters[address[0]], bit)
    word = file.get(address) or file.default(address) or Value(0)
    return Value(with_field(field, int(word.value), text), word.unit)


def typed(value: NewValue | ParameterEntry) -> str | Value:
    """Return a new value as a user types it; raises AssignmentError for what is no value."""
    if isinstance(value, ParameterEntry):
        return CLEARING_TEXT if value.value is None else f"{_plain(value.value)} {value.unit}".rstrip()
    if isinstance(value, (str, Value)):
        return value
    if not isinstance(value, (Real, NoneType)):
        raise AssignmentError(f"a value is a text, a number, yes or no, a Value or None, not {value!r:.80}")
    return CLEARING_TEXT if value is None else _plain(value)


def _plain(value: float | bool | str) -> str:
    """Return a value as a user types it: yes or no, a text, or a number."""
    from amp_studio.schema import write_number

    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    # float and int write themselves; a number of numpy, which is one of them too, writes its type.
    return write_number(int(value) if hasattr(value, "__index__") else float(value))
