"""Makes the sheet of a file against what a control contains."""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass, field

from amp_studio.errors import AmpStudioError
from amp_studio.files import Difference, ParameterFile, axis_letter, axis_letters, by_schema, compare
from amp_studio.schema import Address, show_value
from amp_studio.validate import NO_RULES, BuilderRules, Finding, Interim, NewValue

from .keying import NOT_OFFERED, Keyed, Keying, keying_of
from .model import LeftOut, Sheet, SheetEntry
from .order import bad, safe_order


class SheetError(AmpStudioError, ValueError):
    """Two files of which no sheet can be made; one clear sentence."""


def _with_source(finding: Finding) -> str:
    """Return the message of a finding and where it is from."""
    return finding.message + (f" ({finding.cited})" if finding.cited else "")


@dataclass
class _Line:
    """One value on its way to an entry."""

    step: NewValue
    old: Keyed | None
    new: Keyed
    stage: int
    order: str = ""
    until: list[str] = field(default_factory=list)


def make_sheet(
    wanted: ParameterFile,
    present: ParameterFile,
    *,
    of: str = "",
    against: str = "",
    own: BuilderRules = NO_RULES,
    secrets: bool = False,
    message: Callable[[Finding], str] = _with_source,
) -> Sheet:
    """Return what has to be keyed in at a control that contains ``present`` so that it contains ``wanted``.

    Values that ``wanted`` does not set stay as they are. ``of`` and ``against`` name the two sides; ``own``
    are a builder's rules. Secrets are on the sheet only with ``secrets``; ``message`` words a finding in the
    language of the sheet. Raises SheetError where the two are of different families or machine types.
    """
    _check_sides(wanted, present)
    # A control may describe itself: its values are compared under the schema of the file.
    there, present = present.schema, by_schema(present, wanted.schema)
    keying = keying_of(wanted.schema.family.family)
    found = compare(wanted.schema, wanted.values, present.values)
    lines, left_out, same = [], [], found.same
    for difference in found.differences:
        is_missing = difference.address[0] in wanted.schema.parameters.keys() - there.parameters.keys()
        made = (
            _missing(wanted, difference)
            if is_missing
            else _line(keying, wanted, present, difference, secrets)
        )
        if isinstance(made, _Line):
            lines.append(made)
        elif made is not None:
            left_out.append(made)
        else:
            same += 1
    # Before the order is searched: lines that are taken out are no steps of it.
    lines, otherwise = _same_in_control(keying, lines, wanted, present)
    left_out += otherwise
    lines = _in_order(lines, wanted, present, own, message)
    warnings = _warnings(lines, present, own, message)
    entries = tuple(_entry(line, wanted, secrets) for line in lines)
    name = wanted.header.name or present.header.name
    return Sheet(
        keying.title,
        wanted.schema.family.name,
        name,
        against,
        of,
        entries,
        tuple(left_out),
        keying.stages,
        keying.before,
        keying.after,
        warnings,
        same,
        wanted.schema.family.family,
    )


def _check_sides(wanted: ParameterFile, present: ParameterFile) -> None:
    """Raise SheetError where numbers of one side may mean something else on the other."""
    if wanted.schema.family.family != present.schema.family.family:
        names = [side.schema.family.name for side in (wanted, present)]
        raise SheetError(
            f"one side is for {names[0]}, the other for {names[1]}: no sheet can be made of them"
        )
    if wanted.machine != present.machine:
        raise SheetError(
            f"the file is for the machine type {wanted.machine}, and the control contains one for"
            f" {present.machine}: numbers may mean something else there, so it has to be downloaded as a"
            " whole"
        )


def _missing(wanted: ParameterFile, difference: Difference) -> LeftOut:
    return _left_out(wanted, difference.address, "this control does not have it")


def _line(
    keying: Keying, wanted: ParameterFile, present: ParameterFile, difference: Difference, secrets: bool
) -> _Line | LeftOut | None:
    """Return the line of a difference, or why there is none; None where the control shows the same for
    both.
    """
    address, value = difference.address, difference.a
    parameter = wanted.schema.parameters.get(address[0])
    if parameter is None:
        return None
    if value is None:
        return _left_out(wanted, address, "the file does not set it: the control keeps its own value")
    if obstacle := _why_not_keyed(keying, wanted, address, secrets):
        return _left_out(wanted, address, obstacle)
    new = keying.text(wanted, address, value)
    if new is None:
        why = f"no code is printed for {show_value(parameter, value)}: {NOT_OFFERED}"
        return _left_out(wanted, address, why)
    old = None if difference.b is None else keying.text(present, address, difference.b)
    if old == new:  # a finer difference than the control shows
        return None
    stage = keying.stage(present, wanted, address)
    return _Line(NewValue(address, value), old, new, stage)


def _why_not_keyed(keying: Keying, file: ParameterFile, address: Address, secrets: bool) -> str | None:
    """Return why a value that the file sets is not keyed in, None where it is."""
    if file.evaluation.state(address).state == "hidden":
        return "it does not exist on this machine as the file configures it"
    parameter = file.schema.parameters[address[0]]
    if parameter.access == "read":
        return "the control writes it itself"
    if obstacle := keying.obstacle(file, address):
        return obstacle
    if parameter.secret and not secrets:
        return "it is a secret, which is on the sheet only where somebody asks for it"
    return None


def _same_in_control(
    keying: Keying, lines: list[_Line], wanted: ParameterFile, present: ParameterFile
) -> tuple[list[_Line], list[LeftOut]]:
    """Part the lines into those that mean in the control what they mean in the file, and the others.

    What cannot be keyed in stays as it is there: the type of an axis, for one, by which a number is another
    parameter, or the same figure degrees instead of millimetres.
    """
    otherwise: list[LeftOut] = []
    while True:
        final = _final(lines, present)
        wrong = [
            line
            for line in lines
            if final.evaluation.state(line.step.address).state == "hidden"
            or line.step.value is None
            or keying.text(final, line.step.address, line.step.value) != line.new
        ]
        if not wrong:
            return lines, otherwise
        # Once more: without these lines others may mean something else too.
        lines = [line for line in lines if line not in wrong]
        otherwise += [
            _left_out(
                wanted,
                line.step.address,
                "the control is configured otherwise than the file, so that it would mean something else"
                " there",
            )
            for line in wrong
        ]


def _final(lines: Iterable[_Line], present: ParameterFile) -> ParameterFile:
    """Return what the control contains when everything has been keyed in."""
    final = present.copy()
    final.take({line.step.address: line.step.value for line in lines if line.step.value is not None})
    return final


def _in_order(
    lines: Sequence[_Line],
    wanted: ParameterFile,
    present: ParameterFile,
    own: BuilderRules,
    message: Callable[[Finding], str],
) -> list[_Line]:
    """Return the lines in a safe order, each with why it comes so late and what it breaks for how long."""
    # By stage, and within one in the manual's order, in which the differences come: this is what the
    # search keeps to as far as it can.
    lines = sorted(lines, key=lambda line: line.stage)
    if not lines:
        return lines
    line_of = {line.step: line for line in lines}
    interim = Interim(present, own)
    allowed = _broken_after(lines, present, own)
    order = [line_of[step] for step in safe_order(interim, [line.step for line in lines], allowed)]
    _explain(order, lines, wanted, present, own, allowed, message)
    return order


def _broken_after(
    lines: Iterable[_Line], present: ParameterFile, own: BuilderRules
) -> dict[Hashable, Finding]:
    """Return what is broken when everything has been keyed in."""
    return Interim(_final(lines, present), own).broken


def _explain(
    order: Sequence[_Line],
    wanted_lines: Sequence[_Line],
    wanted: ParameterFile,
    present: ParameterFile,
    own: BuilderRules,
    allowed: dict[Hashable, Finding],
    message: Callable[[Finding], str],
) -> None:
    """Walk the order once more: this is the proof,
    and it shows why a line waits and what is broken on the way.
    """
    interim = Interim(present, own)
    wanted_place = {line.step: n for n, line in enumerate(wanted_lines)}
    read_by = {line.step: interim.checks_of(line.step.address) for line in order}
    open_from: dict[Hashable, tuple[_Line, Finding]] = {}
    for n, line in enumerate(order):
        for late in order[n + 1 :]:
            # Only of a line that was wanted earlier, and that a check reads together with this one, is
            # there a reason to ask for.
            if wanted_place[late.step] < wanted_place[line.step] and not read_by[late.step].isdisjoint(
                read_by[line.step]
            ):
                _ask_why(late, line, interim, wanted, allowed, message)
        new = bad(interim.set(line.step), allowed, ("error", "warning"))
        broken = interim.broken
        for key in [key for key in open_from if key not in broken]:
            first, finding = open_from.pop(key)
            first.until.append(f"Until step {n + 1}: {message(finding)}")
        open_from |= {finding.key: (line, finding) for finding in new}
    for first, finding in open_from.values():
        first.until.append(f"From here on: {message(finding)}")


def _ask_why(
    late: _Line,
    first: _Line,
    interim: Interim,
    wanted: ParameterFile,
    allowed: dict[Hashable, Finding],
    message: Callable[[Finding], str],
) -> None:
    """Note why a line comes after another, which is about to be keyed in: what it would break before."""
    old = NewValue(late.step.address, interim.file.get(late.step.address))
    stopped = bad(interim.set(late.step), allowed, ("error", "warning"))
    # Taken back: this was a trial on the state from which the walk goes on.
    interim.set(old)
    if stopped:
        after = _number_and_name(wanted, first.step.address)[0]
        late.order = f"After {after}, or else: {message(stopped[0])}"


def _warnings(
    lines: Sequence[_Line], present: ParameterFile, own: BuilderRules, message: Callable[[Finding], str]
) -> tuple[str, ...]:
    """Return the errors that the control has when all is keyed in; those of the file itself are among
    them. One of several axes is one line.
    """
    before, final = Interim(present, own).broken, _final(lines, present)
    errors: dict[tuple[str, str], dict[str, None]] = {}
    for key, finding in Interim(final, own).broken.items():
        if finding.severity == "error":
            when = "Error as before" if key in before else "Error when all is keyed in"
            errors.setdefault((when, message(finding)), {}).update(_axes(final, finding))
    return (
        *(fault.message for fault in own.faults),
        *(
            f"{when} ({', '.join(axes)}): {text}" if axes else f"{when}: {text}"
            for (when, text), axes in errors.items()
        ),
    )


def _axes(file: ParameterFile, finding: Finding) -> dict[str, None]:
    """Return the letters of the axes that are wrong, in their order."""
    places = (place for place in finding.causes if file.evaluation.scope(place) == "axis")
    return dict.fromkeys(axis_letter(file, axis) or axis for _, axis in places)


def _entry(line: _Line, wanted: ParameterFile, secrets: bool) -> SheetEntry:
    """Return the entry of a line, with what the value means if it is keyed in otherwise."""
    address, value = line.step.address, line.step.value
    assert value is not None
    parameter = wanted.schema.parameters[address[0]]
    number, name = _number_and_name(wanted, address)
    meaning = show_value(parameter, value, secrets=secrets)
    if meaning == f"{line.new.text} {line.new.unit}".rstrip():
        meaning = ""
    elif line.new.is_rounded:
        meaning += ", rounded"
    page = parameter.pages.get(address[1]) or parameter.page
    return SheetEntry(
        address,
        number,
        name,
        line.old,
        line.new,
        meaning,
        page,
        line.stage,
        line.order,
        tuple(line.until),
        is_label=parameter.type not in ("integer", "real"),
        place=_place(wanted, address),
    )


def _left_out(file: ParameterFile, address: Address, why: str) -> LeftOut:
    return LeftOut(*_number_and_name(file, address), why, _place(file, address))


def _place(file: ParameterFile, address: Address) -> str:
    """Return ``Axis X``; by its number where it has no letter, or another one has the same."""
    label, axis = file.machine_schema.instance_label(address), address[1].partition(".")[0]
    letters = axis_letters(file) if file.evaluation.scope(address) == "axis" else {}
    letter = letters.get(axis, "")
    is_its_own = letter and list(letters.values()).count(letter) == 1
    return re.sub(rf"\b{axis}\b", letter, label, count=1) if is_its_own else label


def _number_and_name(file: ParameterFile, address: Address) -> tuple[str, str]:
    schema, parameter = file.machine_schema, file.schema.parameters[address[0]]
    number = schema.number(address)
    screen_text = number if number and not schema.is_disputed(address[0]) else schema.short(address)
    return screen_text, f"{parameter.name} {_place(file, address)}".rstrip()
