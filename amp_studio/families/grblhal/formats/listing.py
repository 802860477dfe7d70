"""The answer to ``$$`` as every sender saves it: ``$110=500.000`` on each line, often with a remark in parentheses.

What a sender's log has around it is passed over: greeting, ``ok``, status reports, messages, the ``$$`` that was sent.
"""

from __future__ import annotations

import re

from amp_studio.families.grblhal.settings import (
    SettingError,
    addresses_by_number,
    settings_of_file,
    values_of_settings,
)
from amp_studio.files import ParameterFile
from amp_studio.formats.text_format import FormatError, TextFormat, TextRead
from amp_studio.schema import Schema, Value
from amp_studio.schema.quoting import quoted, short
from amp_studio.schema.storage import StorageError

CLASSIC = "grbl-1.1"
_SETTING = re.compile(r"\$(0|[1-9][0-9]{0,4})\s*=\s*(.*)")
_REMARK = re.compile(r"\s*(\(.*\)|;.*)\s*$")
_AROUND = re.compile(
    r"(ok|Grbl .*|GrblHAL .*|<.*>|\[.*\]|(>+ *)?\$[$#GIN+]|\$N\d=.*|[;%(].*)?", re.IGNORECASE
)
"""Lines of a sender's log that are no settings."""
_STARTUP = re.compile(r"(\$N\d)=\s*\S.*")
_STEPS = 100
_NEW_IN_1_1 = {30, 31, 32}


def _recognises(text: str) -> bool:
    lines = (line.strip() for line in text.lstrip("\ufeff").split("\n", 50))
    first = next((line for line in lines if not _AROUND.fullmatch(line)), "")
    return _SETTING.fullmatch(first) is not None


def _settings(text: str) -> tuple[dict[int, str], dict[int, int]]:
    """Return number -> text, and number -> line; raises FormatError."""
    settings: dict[int, str] = {}
    lines: dict[int, int] = {}
    for n, whole in enumerate(text.lstrip("\ufeff").split("\n"), 1):
        line = whole.strip()
        found = _SETTING.fullmatch(line)
        if found is None:
            if _AROUND.fullmatch(line):
                continue
            raise FormatError(
                f"{quoted(line)} is no setting: a number and a value are wanted, as $110=500", n, 1
            )
        number, value = int(found[1]), _REMARK.sub("", found[2]).strip()
        if settings.setdefault(number, value) != value:
            raise FormatError(f"${number} occurs twice, in line {lines[number]} already", n, 1)
        lines.setdefault(number, n)
    if not settings:
        raise FormatError("there is no setting in it")
    return settings, lines


def _read(text: str, schema: Schema, keep_unknown: bool) -> TextRead:
    settings, lines = _settings(text)
    machine = _machine(schema, settings)
    found = TextRead(machine=machine)
    startup = [line[1] for whole in text.split("\n") if (line := _STARTUP.fullmatch(whole.strip()))]
    if startup:
        found.notes.append(f"start-up lines are no settings and are left out: {', '.join(startup[:9])}")
    known = addresses_by_number(schema.on(machine))
    for number, value in settings.items():
        if number not in known:
            if not keep_unknown:
                raise FormatError(
                    f"${number} is a setting that is not known without its control", lines[number], 1
                )
            found.unknown[f"${number}"] = value
    try:
        found.values, _ = values_of_settings(schema, settings, machine)
    except SettingError as error:
        raise FormatError(str(error), lines[error.number], 1) from None
    count = next((n for n in range(9) if _STEPS + n not in settings), 9)
    declared, letters = schema.family.declared_axes, schema.family.scopes["axis"].instances
    if declared and declared.letters and count >= declared.least:
        found.values[declared.letters, ""] = Value("".join(letters[:count]))
    return found


def _machine(schema: Schema, settings: dict[int, str]) -> str:
    """Return the machine type: a listing of a Grbl has all of its settings, and no other."""
    if CLASSIC in schema.machines:
        classic = set(addresses_by_number(schema.on(CLASSIC)))
        if classic - _NEW_IN_1_1 <= settings.keys() <= classic:
            return CLASSIC
    return schema.family.default_machine


def _write(file: ParameterFile) -> str:
    try:
        settings = settings_of_file(file, padded=True)
    except StorageError as error:
        raise FormatError(str(error)) from None
    for key, value in file.unknown.items():
        if re.fullmatch(r"\$[0-9]{1,5}", key) and int(key[1:]) not in settings:
            settings[int(key[1:])] = value
    if not settings:
        raise FormatError(
            f"no setting has a value: {short(file.header.name) or 'the file'} gives an empty listing"
        )
    for number, value in settings.items():
        if re.search(r"[\r\n]", value):
            raise FormatError(f"${number} is a text of several lines, which no setting can be")
    return "".join(f"${number}={value}\n" for number, value in sorted(settings.items()))


FORMAT = TextFormat(
    "grbl", "Grbl settings, as $$ lists them", ".settings", _recognises, _read, _write,
    other_endings=(".grbl", ".nc"),
)  # fmt: skip
