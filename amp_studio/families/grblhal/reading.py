"""Reading all that a control contains: its identity, settings, offsets,
start-up lines and how it describes itself.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from amp_studio.schema import DescriptionError, visible
from amp_studio.transfer import MovingError, Progress, ProtocolMismatchError, quiet

from .content import ENUMERATIONS, IDENTITY, OFFSETS, GrblContent, write_content
from .description import read_description
from .line import GrblLine, GrblRefusalError

_READS = 4
"""How often the settings are read until two readings are the same."""

_NAMED = re.compile(r"\[([A-Z][A-Z0-9. ]*):(.*)\]")
_SETTING = re.compile(r"\$(0|[1-9]\d{0,4})=(.*)")
_STARTUP = re.compile(r"\$N(\d)=(.*)")


def read_identity(line: GrblLine) -> GrblContent:
    """Return who answers, without its settings; raises ProtocolMismatchError for what is no Grbl,
    and MovingError.
    """
    try:
        lines = line.ask("$I")
    except GrblRefusalError as refusal:
        if refusal.code == 8:
            raise MovingError("the control cannot be read while the machine moves", "") from None
        raise ProtocolMismatchError(
            f"the control does not say what it is: it answers {refusal} to $I"
        ) from None
    kept = tuple(_clean(text) for text in lines if (f := _NAMED.fullmatch(text)) and f[1] in IDENTITY)
    if not any(text.startswith("[VER:") for text in kept):
        raise ProtocolMismatchError("what answers there is no Grbl control: it has no version")
    return GrblContent(kept)


def read_control(
    line: GrblLine, before: GrblContent | None, progress: Progress = quiet, stage: str = "upload"
) -> GrblContent:
    """Return all of it; how it describes itself is as ``before`` while it is the same build
    with the same settings.

    Raises as ``GrblLine.ask``.
    """
    who = read_identity(line)
    done, steps = 0, 2

    def step() -> None:
        nonlocal done
        done += 1
        progress(stage, done, steps)

    progress(stage, 0, steps)
    settings, offsets, startup = _read_twice(line, who, step)
    enumerations: Mapping[str, tuple[str, ...]] = {}
    # The enumerations are most of the bytes: over a serial line they last seconds.
    if before is not None and (before.identity, before.settings.keys()) == (who.identity, settings.keys()):
        enumerations = before.enumerations
    elif _is_grblhal(who):
        steps += len(ENUMERATIONS)
        enumerations = _read_enumerations(line, who, step)
    return GrblContent(who.identity, settings, offsets, startup, enumerations)


def _read_enumerations(
    line: GrblLine, who: GrblContent, step: Callable[[], None]
) -> Mapping[str, tuple[str, ...]]:
    """Return how a control describes itself; what cannot be read was damaged
    on the line if it comes otherwise the next time.
    """
    found: Mapping[str, tuple[str, ...]] = {}
    for attempt in range(_READS):
        before, found = found, {}
        for name in ENUMERATIONS:
            found = {**found, **_enumeration(line, name)}
            if not attempt:
                step()
        try:
            read_description(write_content(GrblContent(who.identity, enumerations=found)))
        except DescriptionError:
            # What comes the same twice was not damaged on the line: this build describes itself so.
            if found != before:
                continue
        break
    return found


def _read_twice(
    line: GrblLine, who: GrblContent, step: Callable[[], None]
) -> tuple[dict[int, str], dict[str, str], dict[int, str]]:
    """Return settings, offsets and start-up lines as they were read twice the same: the line has no
    checksum.
    """
    read: tuple[dict[int, str], dict[str, str], dict[int, str]] | None = None
    for attempt in range(_READS):
        again = (read_settings(line, who), _read_offsets(line), _read_startup(line))
        if attempt < 2:
            step()
        if again == read:
            # Two empty readings are equal too, and prove nothing.
            if not again[0] or not again[1]:
                raise ProtocolMismatchError("the control shows no settings")
            return again
        read = again
    raise ProtocolMismatchError("the control shows other settings each time: the line changes them")


def _read_offsets(line: GrblLine) -> dict[str, str]:
    found = (_NAMED.fullmatch(_clean(text)) for text in line.ask("$#"))
    return {f[1]: f[2] for f in found if f and f[1] in OFFSETS}


def _read_startup(line: GrblLine) -> dict[int, str]:
    return dict(_matches(line.ask("$N"), _STARTUP, "a start-up line"))


def _is_grblhal(who: GrblContent) -> bool:
    """Return whether a control is one that describes itself, and not a Grbl 1.1."""
    return who.identity_word("FIRMWARE") == "grblHAL"


def read_settings(line: GrblLine, who: GrblContent) -> dict[int, str]:
    """Return the settings as the control shows them; raises as ``GrblLine.ask``."""
    return dict(_matches(line.ask("$+" if _is_grblhal(who) else "$$"), _SETTING, "a setting"))


def _enumeration(line: GrblLine, name: str) -> dict[str, tuple[str, ...]]:
    """Return the answer under its command; nothing where this build does not know it."""
    try:
        # A line that begins so would be a section of the kept content.
        lines = (_clean(text).removeprefix("> ") for text in line.ask(name))
        return {name: tuple(text for text in lines if text.strip())}
    except GrblRefusalError:
        return {}


def _matches(lines: list[str], form: re.Pattern[str], what: str) -> list[tuple[int, str]]:
    """Return number and text of each line; raises ProtocolMismatchError for another line,
    and for one that comes twice.
    """
    found: dict[int, str] = {}
    for text in lines:
        match = form.fullmatch(_clean(text))
        if match is None:
            raise ProtocolMismatchError(f"the control shows '{visible(text[:60])}', which is not {what}")
        if int(match[1]) in found:
            raise ProtocolMismatchError(f"the control shows {what} twice: '{visible(text[:60])}'")
        found[int(match[1])] = match[2]
    return list(found.items())


def _clean(text: str) -> str:
    """Return a line without control characters, which a damaged line has; tabs of ``$ESH`` stay."""
    return re.sub(r"[\x00-\x08\x0a-\x1f\x7f-\x9f]", "\N{REPLACEMENT CHARACTER}", text)
