"""What a copy of Grbl settings means: between a parameter file and all that a control contains,
by the numbers of settings.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from amp_studio.files import Header, ParameterFile
from amp_studio.schema import (
    DescriptionError,
    InvalidValueError,
    Schema,
    Value,
    described_schema,
    load_schema,
)
from amp_studio.transfer import ImageError

from .bounds import BoundsError, check_text
from .content import GrblContent, read_content, write_content
from .description import PASSWORD, DescribedSetting, description_of, read_description
from .fitting import Misfit, build_of, fit_to
from .masks import Build, MaskBits, bits_beyond, named_bits, with_bits
from .numbers import decimals_of, is_same_number, is_shown_as, read_number, shown_number, written_number
from .offsets import PUT_BACK, at_axes, offset_differences, offsets_in, reports_inches
from .settings import compiled_in, settings_of_file, values_of_settings

FAMILY, CLASSIC = "grblhal", "grbl-1.1"
HOMING, SOFT_LIMITS, JOG_LIMITS, RESET_ACTIONS, LOCATE_RATE, SEEK_RATE = 22, 20, 40, 676, 24, 25
PER_AXIS_RATES = range(180, 200)
"""Settings that are there only while bit 9 of $22 is set,
and $24 and $25 only while it is not (settings.c ``is_setting_available``)."""
_COMMON_RATES = {LOCATE_RATE: range(180, 190), SEEK_RATE: range(190, 200)}
"""The rate of all axes -> the rates of each, which begin with it."""
_PER_AXIS, _KEEP_HOMED = 1 << 9, 1 << 7
_SHOWN, _NAMED = 5, 60
"""Differences, and numbers, that a message names."""


class GrblContentKind:
    """``grblHAL settings 1`` (docs/protocols/grblhal.md)."""

    has_header = False

    def decode(self, content: bytes) -> ParameterFile:
        """Return the settings as a file, with the schema that the control describes; raises ImageError."""
        read = read_content(content)
        machine = "" if read.describes_itself else CLASSIC
        try:
            schema = _schema_of(read, content)
            file = ParameterFile(
                schema, Header(revision=read.version, machine=machine, signature=schema.signature)
            )
            values, others = values_of_settings(schema, read.settings, machine)
        except (InvalidValueError, DescriptionError) as error:
            raise ImageError(str(error)) from None
        file.take({**compiled_in(schema), **values, ("build.axes", ""): Value("".join(read.axes))})
        file.unknown.update({f"${number}": text for number, text in others.items()})
        return file

    def encode(self, file: ParameterFile, current: bytes) -> bytes:
        """Return what a control contains after a download: the file's settings by their numbers,
        else what is in ``current``.

        A setting that the control does not have is left out (``left_out`` names it): the number of any other
        means the same in each build. Bits of masks that the file does not have stay as they are (``stays``
        names them). Raises ImageError for a value that the control would not store as it is.
        """
        present = read_content(current)
        wanted = _settings_for(file, present, current)
        settings = _fitted(wanted.settings, present, described(current))
        return write_content(replace(present, settings=settings, offsets=offsets_in(present, settings)))

    def left_out(self, file: ParameterFile, current: bytes) -> str:
        """Return the settings and bits of a file that a control of another build does not have;
        raises ImageError.
        """
        present = read_content(current)
        wanted = _settings_for(file, present, current)
        lacking = sorted({*wanted.lacking, *_lacking(wanted.settings, present)})
        lost = (
            [f"bits of axes that the control does not have ({named_bits(wanted.lost)})"]
            if wanted.lost
            else []
        )
        return " and ".join([text for text in (_lacking_text(lacking),) if text] + lost)

    def stays(self, file: ParameterFile, current: bytes) -> str:
        """Return the bits of masks that a control has and the file does not; raises ImageError."""
        return named_bits(_settings_for(file, read_content(current), current).kept)

    def lacks(self, content: bytes, earlier: bytes) -> str:  # noqa: ARG002  # other kinds need them
        """Return "": settings come and go with options, and are read until two readings are the same."""
        return ""

    def refit(self, content: bytes, current: bytes) -> bytes:
        """Return what a control contains once a copy is put back: its settings, offsets and start-up lines;
        raises ImageError.

        How the control describes itself stays, so that a copy of another build goes back too, by the numbers.
        """
        copy, present = read_content(content), read_content(current)
        # Offsets of axes that the copy does not have stay: in two units one line of them could not be
        # written.
        if copy.axes != present.axes and reports_inches(copy) != reports_inches(present):
            raise ImageError(
                "the copy is of a control with other axes, and shows offsets in another unit: set $13 alike"
                " first"
            )
        settings = _fitted(_masked(copy, content, present, current), present, described(current))
        offsets = {name: at_axes(copy, present, name) for name in present.offsets}
        startup = {**present.startup, **{n: line for n, line in copy.startup.items() if n in present.startup}}
        return write_content(replace(present, settings=settings, offsets=offsets, startup=startup))

    def displayed(self, content: bytes, found: bytes) -> bytes:
        """Return a content with the settings of another one that shows the same, coarser: ``32.7`` of
        ``32.735``.
        """
        wanted, present = read_content(content), read_content(found)
        displayed = {n: present.settings.get(n, "") for n in wanted.settings}
        settings = {
            n: displayed[n] if is_shown_as(text, displayed[n]) else text
            for n, text in wanted.settings.items()
        }
        return write_content(replace(wanted, settings=settings))

    def difference(self, content: bytes, found: bytes) -> str:
        """Return which settings, offsets and start-up lines differ as far as the control shows them."""
        wanted, present = read_content(content), read_content(found)
        differing = [
            f"in ${n}, which is {present.settings.get(n, 'not there')} and not {text}"
            for n, text in wanted.settings.items()
            if not is_shown_as(text, present.settings.get(n, ""))
        ]
        differing += [
            f"in {name}, which is {present.offsets.get(name, 'not there')} and not {wanted.offsets[name]}"
            for name in offset_differences(wanted, present)
            if name in PUT_BACK
        ]
        more = [f"and in {len(differing) - _SHOWN} more"] if len(differing) > _SHOWN else []
        return ", ".join(differing[:_SHOWN] + more)


def described(content: bytes) -> Mapping[int, DescribedSetting]:
    """Return number -> what the control describes of a setting; nothing of one that does not."""
    try:
        return read_description(content).settings
    except DescriptionError:
        return {}


def _schema_of(read: GrblContent, content: bytes) -> Schema:
    """Return the schema that a control describes, the family's own for a Grbl 1.1; raises
    DescriptionError.
    """
    return described_schema(FAMILY, description_of(content)) if read.describes_itself else load_schema(FAMILY)


@dataclass(frozen=True)
class _SentSettings:
    """What a file sets at one control.

    ``settings``  number -> text
    ``lacking``   the numbers that a control of another build does not have
    ``kept``      the bits of masks that stay as the control has them
    ``lost``      the bits that are set for axes that the control does not have
    """

    settings: dict[int, str]
    lacking: list[int]
    kept: MaskBits
    lost: MaskBits


def _settings_for(file: ParameterFile, present: GrblContent, current: bytes) -> _SentSettings:
    """Return what a file sets at a control.

    Raises ImageError for a file of another family,
    and where the control has a setting but cannot take the value.
    """
    if file.schema.family.family != FAMILY:
        raise ImageError(f"a file for {file.schema.family.name} is nothing for a Grbl control")
    try:
        schema = _schema_of(present, current)
        build = _build(schema, present)
        # Of the same build only bits of axes can differ: names of all others are the same.
        kept = bits_beyond(build, build_of(file), axes_only=file.schema.signature == schema.signature)
        file, lacking, lost = _of_build(file, schema, present.axes)
        unnamed = {
            int(key[1:]): text for key, text in file.unknown.items() if re.fullmatch(r"\$\d{1,5}", key)
        }
        settings = {**unnamed, **settings_of_file(file)}
    except (InvalidValueError, DescriptionError) as error:
        raise ImageError(str(error)) from None
    # The control may know bits that the file's build has no name for; writing 0 there would switch an
    # option off unseen.
    kept = {n: bits for n, bits in kept.items() if n in settings and n in present.settings}
    settings |= {n: with_bits(settings[n], bits, present.settings[n]) for n, bits in kept.items()}
    return _SentSettings(settings, lacking, kept, lost)


def _of_build(
    file: ParameterFile, schema: Schema, axes: Sequence[str]
) -> tuple[ParameterFile, list[int], MaskBits]:
    """Return a file as a file of the build of a control, the numbers that the control lacks, and the bits
    that are lost; raises ImageError for a value that it has and cannot take.
    """
    if file.schema.signature == schema.signature:
        return file, [], {}
    fitted = fit_to(file, schema, axes)
    if others := [misfit for misfit in fitted.misfits if not misfit.is_lacking]:
        raise ImageError(_misfit_text(others))
    lacking = [int(f[1]) for m in fitted.misfits if (f := re.match(r"\$(\d+)", m.name))]
    return fitted.file, lacking, fitted.lost


def _build(schema: Schema, content: GrblContent) -> Build:
    """Return the build that a control is of."""
    return Build(
        schema.on(schema.family.default_machine if content.describes_itself else CLASSIC), content.axes
    )


def _masked(copy: GrblContent, content: bytes, present: GrblContent, current: bytes) -> dict[int, str]:
    """Return the settings of a copy with the bits of masks that its build does not have
    as the control has them.

    A copy whose description cannot be read goes back as it is.
    """
    settings = dict(copy.settings)
    try:
        theirs, own = _build(_schema_of(copy, content), copy), _build(_schema_of(present, current), present)
    except (InvalidValueError, DescriptionError):
        return settings
    for here, other in ((own, theirs), (theirs, own)):
        for number, bits in bits_beyond(here, other, axes_only=here is theirs).items():
            if number in settings:
                reported = present.settings.get(number, "0") if here is own else "0"
                settings[number] = with_bits(settings[number], bits, reported)
    return settings


def _lacking(wanted: Mapping[int, str], present: GrblContent) -> list[int]:
    """Return the numbers that a control does not have, and does not get by what is written."""
    comes = _coming(wanted, present)
    by_option = {*PER_AXIS_RATES, *_COMMON_RATES}
    return [n for n in wanted if n not in present.settings and n not in comes and n not in by_option]


def _coming(wanted: Mapping[int, str], present: GrblContent) -> set[int]:
    """Return the rates of single axes that are there once the settings are written."""
    homing = wanted.get(HOMING, present.settings.get(HOMING, "0"))
    has_rates = homing.isdecimal() and bool(int(homing) & _PER_AXIS)
    return {n for n in PER_AXIS_RATES if has_rates and n % 10 < len(present.axes)}


def _fitted(
    wanted: Mapping[int, str], present: GrblContent, known: Mapping[int, DescribedSetting]
) -> dict[int, str]:
    """Return the settings of a control after these are written; raises ImageError."""
    comes = _coming(wanted, present)
    settings = _with_rates(present.settings, comes)
    for number, text in wanted.items():
        if number not in settings and number not in comes:
            continue
        reported = settings.get(number, "")
        # It is there already: not written, so that the memory is not worn.
        if _is_masked_password(text, known.get(number)) or (
            is_shown_as(text, reported) and _is_as_fine(text, reported)
        ):
            continue
        try:
            check_text(known.get(number), number, text, len(present.axes))
        except BoundsError as error:
            raise ImageError(str(error)) from None
        settings[number] = _as_shown(text, reported)
    return _moved(settings, wanted, has_rates=bool(comes))


def _is_masked_password(text: str, setting: DescribedSetting | None) -> bool:
    """Return whether a text is the asterisks that a control shows for a password: sent back, they would
    become the password.
    """
    return setting is not None and setting.type == PASSWORD and not text.strip("*")


def _with_rates(present: Mapping[int, str], comes: set[int]) -> dict[int, str]:
    """Return the settings of a control with the rates of single axes that come, each as the common rate was;
    the common rate, where it is not there, is that of the first axis.
    """
    settings = dict(present)
    for common, rates in _COMMON_RATES.items():
        if common in settings:
            settings |= {n: settings[common] for n in rates if n in comes and n not in settings}
        elif rates[0] in settings:
            settings[common] = settings[rates[0]]
    return settings


def _misfit_text(misfits: Sequence[Misfit]) -> str:
    """Return the values that a control of another build cannot take, with the reasons."""
    named = "; ".join(map(str, misfits[:_SHOWN]))
    more = f" and {len(misfits) - _SHOWN} more" if len(misfits) > _SHOWN else ""
    return f"the control cannot take {named}{more}"


def _lacking_text(numbers: Sequence[int]) -> str:
    named = ", ".join(f"${n}" for n in numbers[:_NAMED])
    more = f" and {len(numbers) - _NAMED} more" if len(numbers) > _NAMED else ""
    return f"the control does not have {named}{more}" if numbers else ""


def _is_as_fine(text: str, reported: str) -> bool:
    """Return whether what is shown is all of it: of 0.0004 a control shows 0.000, and may contain either."""
    return text == reported or is_same_number(text, reported)


def _as_shown(text: str, reported: str) -> str:
    """Return a text in the form in which the control will show it, if it is the same number."""
    decimals = decimals_of(reported)
    try:
        will_show = "" if decimals is None else shown_number(read_number(text), decimals)
        return (
            will_show
            if is_same_number(will_show, text)
            else text
            if decimals is None
            else written_number(float(text))
        )
    except ValueError:
        return text


def _moved(settings: dict[int, str], wanted: Mapping[int, str], *, has_rates: bool) -> dict[int, str]:
    """Return the settings with those that others move and that were not set (settings.c
    ``set_homing_enable``).
    """
    hidden = _COMMON_RATES.keys() if has_rates else PER_AXIS_RATES
    visible = {n: text for n, text in settings.items() if n not in hidden}
    moved = _moved_by_homing(settings, wanted.get(HOMING, ""))
    return visible | {n: moved[n] for n in moved if n in visible and n not in wanted}


def _moved_by_homing(settings: Mapping[int, str], homing: str) -> dict[int, str]:
    """Return the settings that go with a new value of $22."""
    if not homing.isdecimal():
        return {}
    # Without homing the firmware switches soft limits off: no position is known to check.
    moved = {} if int(homing) & 1 else {SOFT_LIMITS: "0", JOG_LIMITS: "0"}
    if settings.get(RESET_ACTIONS, "").isdecimal():
        keeps = int(homing) & 1 and int(homing) & _KEEP_HOMED
        moved[RESET_ACTIONS] = str(int(settings[RESET_ACTIONS]) & ~1 | (0 if keeps else 1))
    return moved
