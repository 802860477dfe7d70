"""The text of a value as it is stored in the control."""

from __future__ import annotations

import re

from amp_studio.schema import (
    Address,
    Parameter,
    StorageError,
    Value,
    single,
    stored_number,
    stored_unit,
    to_figure,
    words_of,
    write_number,
)

from .parameter_file import ParameterFile

_LAST_NUMBER = re.compile(r"([0-9]+)(?!.*[0-9])")


def storage_text(file: ParameterFile, address: Address) -> str:
    """Return ``10485760: R19 = 160 (0x00A0), R20 = 0 (0x0000)``, or the stored code or number alone.

    Empty where it is what is shown anyway, for a secret, and where the manual prints no form.
    """
    parameter, value = file.schema.parameters[address[0]], file.get(address)
    if value is None or parameter.secret:
        return ""
    stored = stored_number(parameter, value, turns=file.evaluation.turns(address))
    if stored is None:
        return ""
    storage = parameter.storage
    if storage is not None and storage.single:
        return _single_text(parameter, value, turns=file.evaluation.turns(address))
    text = write_number(stored)
    if storage is None or storage.words == 1:
        return "" if _is_as_stored(value, stored) else text
    return _words_text(file, address, stored, storage.unit or value.unit)


def _is_as_stored(value: Value, stored: float) -> bool:
    is_number = isinstance(value.value, (int, float)) and not isinstance(value.value, bool)
    return is_number and stored == value.value


def _words_text(file: ParameterFile, address: Address, stored: float, unit: str) -> str:
    """Return a stored number with the words that it is in; alone where it is in none."""
    parameter, value = file.schema.parameters[address[0]], file.values[address]
    try:
        words = words_of(parameter, value, unit)
    except StorageError:
        return write_number(stored)
    number = file.machine_schema.number(address) or ""
    each = ", ".join(f"{_behind(number, n)} = {word} (0x{word:04X})" for n, word in enumerate(words))
    return f"{write_number(round(stored))}: {each}"


def _behind(number: str, count: int) -> str:
    """Return the number of the word that comes so many words after one: ``R20`` behind ``R19``."""
    return _LAST_NUMBER.sub(lambda match: str(int(match[1]) + count), number)


def _single_text(parameter: Parameter, value: Value, *, turns: bool) -> str:
    """Return ``0.0004, shown as 0.000``: the 32-bit float that the control keeps,
    where it is coarser or shown coarser.
    """
    storage = parameter.storage
    assert storage is not None
    unit = stored_unit(parameter, turns=turns)
    figure = to_figure(parameter, value, unit)
    kept = single(figure)
    rounded = f"{kept:.{storage.decimals or 0}f}"
    if kept == float(rounded):
        return "" if kept == value.value and value.unit == unit else write_number(kept)
    return f"{write_number(kept)}, shown as {rounded}"
