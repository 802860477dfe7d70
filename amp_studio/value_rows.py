"""One value of a machine as the library returns it, and as ``get --json`` prints it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.schema import Address, Parameter, ResolvedAddress, Value

# As in ``machine``, a function imports what it needs: a start loads no more than its verb uses.


@dataclass(frozen=True)
class ParameterEntry:
    """One value of a machine, as it was when it was read."""

    param: str
    """Its number, or its address where it has none."""
    id: str
    instance: str
    value: float | bool | str | None
    """A number in ``unit``, the label of a choice, a text, yes or no; None where it is not set,
    and for a secret."""
    unit: str
    raw: float | str | None
    """What the control stores; None where it is unknown."""
    default: bool
    """Whether it is the printed default."""
    state: str
    """``in-force``, ``ignored``, ``unusable`` or ``hidden``."""
    forced: bool
    """Whether it is out of range on purpose."""
    text: str
    """Value and unit as a report prints them."""

    def __str__(self) -> str:
        return self.text


_OF_ENTRY = ("param", "id", "instance", "value", "unit", "raw", "default", "state", "forced")
"""Keys of a row that an entry has too."""


def value_row(file: ParameterFile, resolved: ResolvedAddress, *, secrets: bool = False) -> dict[str, Any]:
    """Return a value, or one field of a word of bits, as ``get --json`` gives it.

    A secret that is set has neither ``value`` nor ``raw`` unless ``secrets`` asks for them.
    """
    if resolved.bit is not None:
        return _bit_row(file, resolved.address, resolved.bit)
    return _whole_row(file, resolved.address, secrets)


def entry_of(file: ParameterFile, resolved: ResolvedAddress) -> ParameterEntry:
    """Return a value, or one field of a word of bits, as the library gives it."""
    from amp_studio.schema import show_value

    row = value_row(file, resolved)
    if resolved.bit is not None:
        text = "not set" if row["value"] is None else str(row["value"])
    else:
        text = show_value(file.schema.parameters[resolved.address[0]], file.get(resolved.address))
    return ParameterEntry(**{name: row[name] for name in _OF_ENTRY}, text=text)


def _bit_row(file: ParameterFile, address: Address, bit: int) -> dict[str, Any]:
    """Return one field of a word of bits as ``get`` shows it."""
    from amp_studio.schema import field_at, field_value

    field = field_at(file.schema.parameters[address[0]], bit)
    words = (file.get(address), file.default(address))
    word, default = (None if v is None else field_value(field, int(v.value)) for v in words)
    labels = {c.raw: c.label for c in field.choices or ()}
    return {
        "param": f"{file.machine_schema.short(address)}.{bit}",
        "id": address[0],
        "instance": address[1],
        "bit": bit,
        "label": field.label,
        "value": labels.get(word, word),
        "unit": "",
        "raw": word,
        "default": word == default,
        "state": file.evaluation.state(address).state,
        "forced": address in file.forced,
    }


def _whole_row(file: ParameterFile, address: Address, secrets: bool) -> dict[str, Any]:
    """Return a value with all its bits."""
    from amp_studio.schema import stored_number, write_value

    parameter, value = file.schema.parameters[address[0]], file.get(address)
    masked = parameter.secret and not secrets
    plain = None if value is None or masked else value.value
    if isinstance(plain, (str, bool)):
        plain = write_value(parameter, value)
    raw = None
    if value is not None and not masked:
        raw = stored_number(parameter, value, turns=file.evaluation.turns(address))
    return (
        {
            "param": file.machine_schema.short(address),
            "id": address[0],
            "instance": address[1],
            "value": plain,
            "unit": value.unit if value else file.evaluation.unit(address, file.header.units),
            "raw": raw,
            "default": file.is_default(address),
            "state": file.evaluation.state(address).state,
            "forced": address in file.forced,
        }
        | _labels(parameter, value)
        | ({"secret": True, "set": value is not None} if parameter.secret else {})
        | _real_figure(file, address)
    )


def _labels(parameter: Parameter, value: Value | None) -> dict[str, str]:
    """Return what is set in a word of bits by its labels."""
    from amp_studio.schema import labels_of_word

    if not parameter.bits or value is None or not isinstance(value.value, int):
        return {}
    return {"labels": labels_of_word(parameter, value.value)}


def _real_figure(file: ParameterFile, address: Address) -> dict[str, Any]:
    """Return what a value in internal units is in mm or degrees."""
    from amp_studio.schema import real_value

    real = real_value(file.evaluation, address, file.get(address))
    return {} if real is None else {"real": {"value": real.value, "unit": real.unit}}
