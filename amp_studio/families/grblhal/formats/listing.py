"""The answer to ``$$`` as every sender saves it: ``$110=500.000`` on each line,
with whatever is around it (log.py).

The machine type is the one whose settings these are and whose bounds the values fit. What the schema does not
have is kept as text and written back.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeVar

from amp_studio.families.grblhal.settings import (
    SettingError,
    addresses_by_number,
    settings_of_file,
    values_of_settings,
)
from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, TextFormat, TextOffer, TextRead
from amp_studio.schema import Address, Schema, StorageError, Value, fault, quoted, short, unknown_name

from .log import Log, LoggedListing, figure, is_listing, read_log
from .older import OLDER, read_older
from .relatives import Relative, is_relative, read_relative

_K = TypeVar("_K")
_V = TypeVar("_V")
_STEPS = 100
_OF_AXES = 9
"""Ten numbers are for each quantity of the axes; the last one is of no axis."""
_IDENTITY = "control"
"""Key of the header: the answers of the control to ``$I``."""


def _recognises(text: str) -> bool:
    return is_listing(text) or is_relative(text)


def _read(text: str, schema: Schema, options: ReadOptions) -> TextRead:
    """Return what a listing contains, or a log with one, also of firmware that is older or another."""
    relative = _relative(text)
    log = read_log(text) if relative is None else _log_of(relative)
    chosen = _chosen(log, options.listing)
    listing, then = read_older(chosen, log.greeting) or (chosen, None)
    fit = _machine(schema, log, listing, options.machine or (OLDER if then else ""))
    if fit.unreadable and not options.keep_unknown:
        raise _unreadable(listing, fit)
    found = TextRead(values=fit.values, machine=fit.machine)
    kept = sorted((*fit.unknown, *fit.other, *fit.unreadable))
    found.unknown = {f"${number}": text for number, text in listing.texts_of(kept).items()} | log.startup
    if relative is not None:
        found.unknown |= relative.kept
        found.notes.append(_account_of(relative))
    if then is not None:
        found.unknown |= then.kept
        found.notes.append(str(then))
    found.unknown_lines = {f"${number}": listing.lines[number] for number in kept}
    known = addresses_by_number(schema.on(fit.machine))
    found.value_lines = {a: listing.lines[n] for n, a in known.items() if n in listing.lines}
    if identity := _identity(log):
        found.extra[_IDENTITY] = identity
    found.notes += _notes(schema, log, chosen, fit, options)
    return found


def _identity(log: Log) -> list[str]:
    """Return the lines of a log that name the control."""
    facts = [f"[{tag}:{fact}]" for tag, texts in log.facts.items() for fact in texts]
    return [log.greeting, *facts] if log.greeting else facts


def _offer(text: str, schema: Schema) -> TextOffer:
    relative = _relative(text)
    log = read_log(text) if relative is None else _log_of(relative)
    chosen = _chosen(log, 0)
    listing, then = read_older(chosen, log.greeting) or (chosen, None)
    fit = _machine(schema, log, listing, OLDER if then else "")
    return TextOffer(schema.family.family, tuple(map(_place, log.listings)), fit.machine)


def _relative(text: str) -> Relative | None:
    return read_relative(text) if not is_listing(text) and is_relative(text) else None


def _place(listing: LoggedListing) -> str:
    heading = f", {quoted(short(listing.heading))}" if listing.heading else ""
    return f"line {listing.first_line}{heading}"


def _log_of(relative: Relative) -> Log:
    """Return the settings of a related firmware as a listing; raises FormatError where it has none in
    common.
    """
    if not relative.settings:
        raise FormatError(f"nothing of this {relative.name} is a setting of Grbl")
    lines = dict.fromkeys(relative.settings, 1)
    listing = LoggedListing(relative.settings, lines, dict.fromkeys(lines, ""))
    return Log([listing], greeting=relative.name)


def _account_of(relative: Relative) -> str:
    settings = ", ".join(f"${number}" for number in sorted(relative.settings))
    kept = f"; kept as text: {len(relative.kept)} entries" if relative.kept else ""
    return f"a {relative.name}: what it has in common with Grbl was read, {settings}{kept}"


def _chosen(log: Log, number: int) -> LoggedListing:
    """Return the listing that is wanted, or the last one; raises FormatError."""
    if not log.listings:
        raise FormatError("there is no setting in it")
    if number > len(log.listings):
        count = "one listing" if len(log.listings) == 1 else f"{len(log.listings)} listings"
        raise FormatError(f"there is no listing {number}, the text has {count}")
    return log.listings[number - 1]  # 0 is the last one


# -- machine type


@dataclass(frozen=True)
class _Fit:
    """The settings of a listing on one machine type."""

    machine: str
    values: dict[Address, Value]
    unknown: tuple[int, ...]
    other: tuple[int, ...]
    """Settings that another build has under a number that is known of some builds:
    their text does not fit there."""
    unreadable: dict[int, str]
    """Number -> why its text is no value."""
    outside: int
    """Values that are not allowed."""
    missing: int
    share: float
    """Part of the settings of the machine type that the listing has."""


def _machine(schema: Schema, log: Log, listing: LoggedListing, wanted: str) -> _Fit:
    """Return the machine type whose settings these are and whose bounds they fit, where none is wanted."""
    if wanted:
        if wanted not in schema.machines:
            raise FormatError(unknown_name("machine type", wanted, schema.machines))
        return _fit(schema, log, listing, wanted)
    default, hint = schema.family.default_machine, _hint(log, listing)
    fits = [_fit(schema, log, listing, machine) for machine in schema.machines]
    # A few settings are of any control: the one that has most of them is the default.
    likely = [fit for fit in fits if fit.machine in (default, hint) or fit.share >= 0.5]
    return min(
        likely,
        key=lambda fit: (
            len(fit.unknown) + len(fit.other) + len(fit.unreadable) + fit.outside,
            fit.machine != hint,
            fit.machine == OLDER and _is_rather_newer(listing, fit.missing),
            fit.missing,
        ),
    )


_MAX_MISSING = 3
"""Settings that a listing of Grbl 0.9 may lack before it is rather part of one of a newer Grbl."""


def _is_rather_newer(listing: LoggedListing, missing: int) -> bool:
    """Return whether a listing without a sign of Grbl 0.9 is rather part of one of Grbl 1.1.

    0.9 lists all of its settings, with remarks, and its $10 is 3 as delivered; that of 1.1 is 0 to 2 as a
    rule (Grbl v1.1 Configuration, $10).
    """
    return missing > _MAX_MISSING or figure(listing.settings.get(10, "")) in ("", "0", "1", "2")


def _hint(log: Log, listing: LoggedListing) -> str:
    """Return the machine type that the control or the remarks of its listing name;
    empty where they name none.
    """
    greeting = log.greeting.casefold()
    # Grbl_ESP32 alone has the debounce as a decimal (SettingsDefinitions.cpp:376, a FloatSetting).
    if (
        "fluidnc" in greeting
        or "esp32" in greeting
        or re.match(r"[0-9]+\.[0-9]", listing.settings.get(26, ""))
    ):
        return "grbl-esp32"
    if {"NEWOPT", "FIRMWARE", "BOARD", "DRIVER"} & log.facts.keys() or greeting.startswith("grblhal"):
        return "grblhal"
    if re.match(r"grbl v?0\.[6-9]", greeting) or any("usec" in remark for remark in listing.remarks.values()):
        return "grbl-0.9"
    return ""


def _fit(schema: Schema, log: Log, listing: LoggedListing, machine: str) -> _Fit:
    """Return how a listing fits the settings of a machine type: values, and what has no place in it."""
    known = addresses_by_number(schema.on(machine))
    texts = _texts(schema, listing, known)
    values, unreadable = _readable(schema, texts, machine)
    values |= _axes(schema, log, listing.settings, machine)

    def is_of_other_build(n: int) -> bool:
        """Return whether a number that only some builds have means something else in this one, or is
        masked: its text is no value of it.
        """
        parameter = schema.parameters[known[n][0]]
        is_masked = parameter.secret and not texts[n].strip("*")
        return bool(parameter.needs) and (n in unreadable or is_masked or known[n] in outside)

    # Bounds depend on other settings: all are in a file before any of them is checked.
    file = ParameterFile(schema)
    file.header.machine = machine
    file.take(values)
    outside = {address for address, value in values.items() if fault(file.evaluation, address, value)}
    other = {n: known[n] for n in texts if n in known and is_of_other_build(n)}
    missing = known.keys() - texts.keys()
    return _Fit(
        machine,
        _without(values, other.values()),
        tuple(n for n in texts if n not in known),
        tuple(other),
        _without(unreadable, other),
        len(outside.difference(other.values())),
        len(missing),
        1 - len(missing) / max(1, len(known)),
    )


def _texts(schema: Schema, listing: LoggedListing, known: Mapping[int, Address]) -> dict[int, str]:
    """Return the text of each setting that is its value: all that is written for a text, else the figure."""
    written = {n for n in listing.settings if n in known and schema.parameters[known[n][0]].type == "text"}
    texts = listing.texts_of(written)
    return {n: texts[n] if n in texts else figure(text) for n, text in listing.settings.items()}


def _readable(
    schema: Schema, texts: Mapping[int, str], machine: str
) -> tuple[dict[Address, Value], dict[int, str]]:
    """Return the values of the settings whose text is one, and why the others are none."""
    unreadable: dict[int, str] = {}
    # Each round finds one text that is no value: the reader stops at the first.
    while True:
        try:
            return values_of_settings(schema, _without(texts, unreadable), machine)[0], unreadable
        except SettingError as error:
            unreadable[error.number] = str(error)


def _without(entries: Mapping[_K, _V], keys: Collection[_K]) -> dict[_K, _V]:
    return {key: entry for key, entry in entries.items() if key not in keys}


def _axes(schema: Schema, log: Log, settings: Iterable[int], machine: str) -> dict[Address, Value]:
    """Return the letters of the axes: those that the control names, or as many as have settings."""
    declared, letters = schema.family.declared_axes, schema.family.scopes["axis"].instances
    if not declared or not declared.letters:
        return {}
    named = re.fullmatch(r"\d:([A-Z]{1,9})", log.facts.get("AXS", [""])[-1])
    fact = named[1] if named else ""
    most = declared.most.get(machine, len(letters))
    # Steps, rates, accelerations and travels: $100 to $139, the last digit is the axis.
    have = [n % 10 for n in settings if n // 10 * 10 in range(_STEPS, _STEPS + 40, 10) and n % 10 < _OF_AXES]
    count = len(fact) or max(have, default=-1) + 1
    # Letters in another order are not those of this schema: no axes are better than wrong ones.
    if not "".join(letters).startswith(fact) or not declared.least <= count <= most:
        return {}
    return {(declared.letters, ""): Value("".join(letters[:count]))}


# -- what a person should know


def _unreadable(listing: LoggedListing, fit: _Fit) -> FormatError:
    """Return one error for all settings whose text is no value."""
    numbers = sorted(fit.unreadable, key=lambda n: listing.lines[n])
    first, more = numbers[0], numbers[1:]
    others = f"; so {_are(more)} {', '.join(f'${n} (line {listing.lines[n]})' for n in more)}" if more else ""
    return FormatError(
        f"{fit.unreadable[first]}{others}. What is no value can be kept as an unknown setting",
        listing.lines[first],
        1,
    )


def _notes(
    schema: Schema, log: Log, listing: LoggedListing, fit: _Fit, options: ReadOptions
) -> Iterable[str]:
    """Yield what a person has to know of a listing that was taken: which of several, what changed in it."""
    yield from _notes_of_listings(log, listing)
    yield from _notes_of_kept(log, listing, fit)
    if log.others:
        n, line = log.others[0]
        count = "a line" if len(log.others) == 1 else f"{len(log.others)} lines"
        yield (
            f"{count} without a setting left out: line {n},"
            f" {quoted(short(line))}{', …' if len(log.others) > 1 else ''}"
        )
    if not options.machine:
        family = schema.family
        keys = ", ".join(m.key for m in family.machines)
        yield f"machine type {family.machine_name(fit.machine)}, as none was given. Known: {keys}"


def _notes_of_listings(log: Log, listing: LoggedListing) -> Iterator[str]:
    """Yield which listing was read, and what beside it is a setting, or none."""
    if len(log.listings) > 1:
        others = ", ".join(
            f"{n} ({_place(one)})" for n, one in enumerate(log.listings, 1) if one is not listing
        )
        yield (
            f"the text has {len(log.listings)} listings, and number {log.listings.index(listing) + 1} is read"
            f" ({_place(listing)}), as none was given. Others: {others}"
        )
    if listing.changed:
        changes = ", ".join(
            f"${n} from {old} to {new} (line {listing.lines[n]})"
            for n, (old, new) in sorted(listing.changed.items())
        )
        yield f"settings that occur again later have the later value: {changes}"
    if listing.aside:
        lines = ", ".join(
            f"line {line} {quoted(short(text))}" for line, text in list(listing.aside.items())[:9]
        )
        yield f"settings behind sentences change nothing: {lines}"
    if log.is_comment:
        yield "every setting here is a comment, and is read"
    if log.bare:
        yield f"a number without $ is read as a setting: line {', '.join(map(str, log.bare[:9]))}"
    if log.refused:
        yield (
            "what the control answered with an error is left out: line"
            f" {', '.join(map(str, log.refused[:9]))}"
        )


def _notes_of_kept(log: Log, listing: LoggedListing, fit: _Fit) -> Iterator[str]:
    """Yield what is kept as text."""
    kept = sorted((*fit.unknown, *fit.unreadable))
    if kept:
        yield (
            f"{len(kept)} of {len(listing.settings)} settings {_are(kept)} not known without the control and"
            " kept as text: " + ", ".join(f"${n}" for n in kept)
        )
    if fit.other:
        have = "has" if len(fit.other) == 1 else "have"
        yield (
            f"{len(fit.other)} of {len(listing.settings)} settings {have} in this build another meaning than"
            f" is known, or no value, and {_are(list(fit.other))} kept as text:"
            f" {', '.join(f'${n}' for n in sorted(fit.other))}"
        )
    if any(log.startup.values()):
        lines = ", ".join(key for key, block in log.startup.items() if block)
        yield f"start-up lines are no settings and are kept as text: {lines}"


def _are(numbers: list[int]) -> str:
    return "is" if len(numbers) == 1 else "are"


# -- writing


def _write(file: ParameterFile) -> str:
    """Return a file as the listing that its control would print; raises FormatError."""
    try:
        settings = settings_of_file(file, padded=True, hidden=True)
    except StorageError as error:
        raise FormatError(str(error)) from None
    unknown = {int(key[1:]): text for key, text in file.unknown.items() if re.fullmatch(r"\$[0-9]{1,5}", key)}
    settings = unknown | settings
    if not settings:
        raise FormatError(
            f"no setting has a value: {short(file.header.name) or 'the file'} gives an empty listing"
        )
    lines = {f"${number}": value for number, value in sorted(settings.items())}
    startup = {key: value for key, value in sorted(file.unknown.items()) if re.fullmatch(r"\$N[0-9]", key)}
    for key, value in (lines | startup).items():
        if re.search(r"[\r\n]", value):
            raise FormatError(f"{key} is a text of several lines, which no setting can be")
    return "".join(
        f"{line}\n"
        for line in (*_remarks(file), *(f"{key}={value}" for key, value in (startup | lines).items()))
    )


def _remarks(file: ParameterFile) -> Iterator[str]:
    """Yield what the control answers to ``$I``, and what the file has that is no line of a listing."""
    fact = file.header.extra.get(_IDENTITY)
    remarks = [one for one in fact if isinstance(one, str)] if isinstance(fact, list) else []
    remarks += [
        f"{key} {text}" for key, text in file.unknown.items() if not re.match(r"\$(N[0-9]|[0-9]{1,5})$", key)
    ]
    return (f"; {' '.join(one.split())}" for one in remarks)


FORMAT = TextFormat(
    "grbl",
    "Grbl settings, as $$ lists them",
    ".settings",
    _recognises,
    _read,
    _write,
    other_endings=(".grbl", ".nc"),
    offer=_offer,
    otherwise="cp1252",
)
