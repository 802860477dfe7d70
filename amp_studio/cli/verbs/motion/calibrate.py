"""The calibration table and the reversal error of an axis, from measured points or by hand; without either,
show them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from fractions import Fraction
from itertools import chain, product
from typing import TYPE_CHECKING, Any

from amp_studio.cli.arguments import AXIS, DRY_RUN, JSON, OUTPUT, PATH, path_of
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.output import check_replaced
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.calibration import CalibrationTable, Compensation, Measurement, Proposal, TableForm
    from amp_studio.files import Change, ParameterFile
    from amp_studio.schema import Address, Value

VERB = Verb(
    __doc__,
    PATH,
    AXIS.but(required=True, help="axis by its letter or number"),
    VerbArgument(
        "--from",
        dest="measured",
        type=path_of,
        metavar="FILE",
        help="points measured by a laser interferometer or a ball-bar: columns as CSV, or Renishaw .rtl",
    ),
    VerbArgument("--unit", metavar="UNIT", help="unit of the positions: mm, in, um, deg, counts"),
    VerbArgument("--error-unit", metavar="UNIT", help="unit of the errors: mm, in, um, deg, arcsec, counts"),
    VerbArgument(
        "--sign",
        choices=("measured-target", "target-measured"),
        help="what an error is: measured less target (ISO 230-2), or the correction",
    ),
    VerbArgument("--decimal", choices=("point", "comma"), help="decimal sign of the points"),
    VerbArgument(
        "--compensation",
        choices=("on", "off"),
        help="whether the axis was measured with its compensation on; points are then added to it",
    ),
    VerbArgument(
        "--circle",
        choices=("first", "second"),
        help="which axis of the circle of a ball-bar (angle, deviation) it is",
    ),
    VerbArgument("--only", choices=("table", "reversal"), help="make only one of both"),
    VerbArgument("--input", choices=("measurement", "deviation"), help="how the control has its points"),
    VerbArgument(
        "--start", choices=("positive", "negative"), help="end of the travel at which the table starts"
    ),
    VerbArgument(
        "--insert",
        action="append",
        metavar="POSITION=FIGURE",
        help="one more point of the table",
        signed=True,
    ),
    VerbArgument(
        "--replace", action="append", metavar="POSITION=FIGURE", help="another figure at a point", signed=True
    ),
    VerbArgument("--delete", action="append", metavar="POSITION", help="a point that goes", signed=True),
    VerbArgument("--clear", action="store_true", help="delete all points of the axis"),
    OUTPUT.but(required=False, help="the errors before and after as a picture (.svg)"),
    DRY_RUN,
    JSON,
    writes=("path", "output"),
    examples=(
        "amp-studio calibrate MILL_1394.amp --axis X",
        "amp-studio calibrate MILL_1394.amp --axis X --from laser.csv --dry-run -o errors.svg",
        "amp-studio calibrate MILL_1394.amp --axis X --from laser.csv --sign measured-target",
        (
            "amp-studio calibrate MILL_1394.amp --axis X --compensation on --from laser.csv --sign"
            " measured-target --json --dry-run"
        ),
    ),
)


_STARTS = {"positive": "+", "negative": "-"}

_OPTIONS = {"unit": "--unit", "error_unit": "--error-unit", "sign": "--sign", "decimal": "--decimal"}

_LONGEST = 64
"""Characters of a value that is printed whole."""


def run(options: Options) -> int:
    """Show or change the calibration of one axis; all or nothing."""
    from amp_studio import RangeError, edit
    from amp_studio.calibration import CalibrationError, compensation_of
    from amp_studio.schema import InvalidValueError, resolve_axis

    by_hand = _is_by_hand(options)
    writes = (by_hand or bool(options.measured)) and not options.dry_run
    # Without a lock where nothing is written: the window may have the file open meanwhile.
    with edit(options.path, only_view=not writes) as machine:
        file = machine.file
        offered = compensation_of(file.schema.family.family)
        axis = resolve_axis(file.evaluation, _instances(file, offered), options.axis)
        try:
            found = _correction(options, file, offered, axis, by_hand)
            # In a dry run too: the file in memory is this process's own, and a value out of range is
            # refused as it would be.
            changes = file.set_checked(found.settings)
        except (CalibrationError, RangeError, InvalidValueError) as error:
            raise UsageError(f"{error}; nothing was changed") from None
        if writes:
            _demand_answers(found.measurement)
            if changes:
                machine.save(verb="calibrate")
    if options.output and found.proposal is not None:
        _draw(options, file, found.proposal)
    if options.json:
        print_json(_json(options, file, offered, axis, found, changes))
    else:
        print("\n".join(_lines(options, file, offered, axis, found, changes)))
    return 0


def _is_by_hand(options: Options) -> bool:
    """Return whether points are changed by hand; raises UsageError for options that exclude each other."""
    by_hand = any((options.insert, options.replace, options.delete, options.clear))
    if by_hand and options.measured:
        raise UsageError(
            "points are measured (--from) or changed by hand (--insert, --replace, --delete, --clear)"
        )
    if options.output:
        _check_picture(options)
    return by_hand


def _check_picture(options: Options) -> None:
    if not options.measured:
        raise UsageError("a picture is drawn of measured points: --from FILE")
    if options.output.suffix.lower() != ".svg":
        raise UsageError(f"A picture is drawn as SVG: name the file {options.output.stem}.svg")
    check_replaced(options.output, options.path)
    check_replaced(options.output, options.measured)


def _draw(options: Options, file: ParameterFile, proposal: Proposal) -> None:
    """Write the picture of the errors before and after."""
    from amp_studio.cli.motion.calibration_picture import proposal_scene
    from amp_studio.drawing import scene_svg
    from amp_studio.files import write_atomic
    from amp_studio.schema import axis_name

    letter = axis_name(file.evaluation, proposal.axis) or proposal.axis
    scene = proposal_scene(proposal, f"Axis {letter}: mean errors")
    # No backup: the picture can be drawn again from the same points.
    write_atomic(options.output, scene_svg(scene).encode(), keep_backup=False, notify=print_remark)
    print_remark(f"Written: {options.output}")


def _instances(file: ParameterFile, offered: Compensation) -> tuple[str, ...]:
    if not offered.reversal and offered.table is None:
        raise UsageError(f"{file.schema.family.name} has neither a calibration table nor a reversal error")
    parameter = file.schema.parameters[offered.table.parameter if offered.table else offered.reversal]
    instances = file.machine_schema.instances(parameter)
    if not instances:
        raise UsageError(f"{file.machine} has neither a calibration table nor a reversal error")
    return instances


class _Correction:
    """What the options set: the values, with the measurement and the proposal that they come from."""

    def __init__(self, settings: dict[Address, Value | None]) -> None:
        self.settings = settings
        self.measurement: Measurement | None = None
        self.proposal: Proposal | None = None


def _correction(
    options: Options, file: ParameterFile, offered: Compensation, axis: str, by_hand: bool
) -> _Correction:
    """Return what the options set: edited by hand, of measured points, or nothing."""
    from amp_studio.calibration import (
        MeasurementAnswers,
        ProposalRequest,
        base_unit,
        propose,
        read_measured_file,
    )

    if by_hand:
        return _Correction(_edited(options, file, offered, axis))
    if not options.measured:
        return _Correction({})
    answers = MeasurementAnswers(
        *(getattr(options, name) or "" for name in ("unit", "error_unit", "sign", "decimal"))
    )
    measurement = read_measured_file(options.measured, answers, base_unit(file, offered, axis))
    # None is not "off": only a table that was active while it was measured is added to the errors.
    was_on = None if options.compensation is None else options.compensation == "on"
    request = ProposalRequest(
        was_on,
        options.input or "",
        _STARTS.get(options.start or "", ""),
        table=options.only != "reversal",
        reversal=options.only != "table",
        circle=options.circle or "",
    )
    proposal = propose(file, axis, measurement, request)
    correction = _Correction(dict(proposal.settings))
    correction.measurement, correction.proposal = measurement, proposal
    return correction


def _demand_answers(measurement: Measurement | None) -> None:
    """Refuse to write what rests on an assumption; the dry run shows it."""
    if measurement is not None and measurement.assumed:
        used = asdict(measurement.answers)
        asked = ", ".join(f"{_OPTIONS[name]} {used[name]}" for name in measurement.assumed)
        raise UsageError(
            f"the points do not name everything: look at it with --dry-run and confirm with {asked}, or give"
            " what is true; nothing was changed"
        )


def _edited(
    options: Options, file: ParameterFile, offered: Compensation, axis: str
) -> dict[Address, Value | None]:
    """Return the table with the points that the options insert, replace and delete."""
    from amp_studio.calibration import deleted, inserted, replaced, shown_unit
    from amp_studio.schema import Value

    form = offered.table
    if form is None:
        raise UsageError(f"{file.schema.family.name} has no calibration table of an axis")
    table = _table_to_edit(options, file, offered, form, axis)
    _, size = shown_unit(file, table)
    # Deleted before it is inserted: one call may move a point, which is both.
    for text in options.delete or ():
        table = deleted(table, _number(text) * size)
    if options.insert and form.is_even:
        raise UsageError("the positions of this table are fixed: --replace changes a figure")
    changes = product([replaced], options.replace or ()), product([inserted], options.insert or ())
    for put, text in chain(*changes):
        at, figure = (number * size for number in _pair(text))
        table = put(table, at, _error(options, form, table, at, figure))
    text = "" if options.clear and not (options.insert or options.replace) else form.write(file, axis, table)
    return {(form.parameter, axis): Value(text) if text else None}


def _table_to_edit(
    options: Options, file: ParameterFile, offered: Compensation, form: TableForm, axis: str
) -> CalibrationTable:
    """Return the table that is edited: that of the axis, or an empty one."""
    from amp_studio.calibration import present_table, rechosen

    start = _STARTS.get(options.start or "", "")
    table = None if options.clear else present_table(file, offered, axis)
    if table is None:
        return form.empty(file, axis, options.input or "", start)
    return rechosen(table, options.input or table.input, start or table.start)


def _error(
    options: Options, form: TableForm, table: CalibrationTable, at: Fraction, figure: Fraction
) -> Fraction:
    """Return the error that a figure means; measured with the calibration on it comes on top of the
    table's.
    """
    from amp_studio.calibration import left_over

    error = form.error(table, at, figure)
    return left_over(table, at, error) if options.compensation == "on" else error


def _pair(text: str) -> tuple[Fraction, Fraction]:
    at, equals, figure = text.partition("=")
    if not equals:
        raise UsageError(f"{text[:40]} is not POSITION=FIGURE")
    return _number(at), _number(figure)


def _number(text: str) -> Fraction:
    from amp_studio.schema import read_exact

    # Exact: a position is found in the table by its value, which a binary fraction of it would miss.
    number, rest = read_exact(text)
    if rest.strip():
        raise UsageError(f"{text[:40]} is no bare number: positions and figures are in the unit of the table")
    return number


def _lines(
    options: Options,
    file: ParameterFile,
    offered: Compensation,
    axis: str,
    correction: _Correction,
    changes: list[Change],
) -> Iterator[str]:
    """Yield the lines for a terminal: the measurement, the table, each change."""
    from amp_studio.calibration import present_table
    from amp_studio.files import describe
    from amp_studio.schema import show_value

    proposal = correction.proposal
    if proposal is not None and correction.measurement is not None:
        yield from _measured(correction.measurement, proposal)
    yield from _table_lines(file, offered, axis, present_table(file, offered, axis))
    would = "would be " if options.dry_run else ""
    for change in changes:
        parameter = file.schema.parameters[change.address[0]]
        old, new = (_short(show_value(parameter, value)) for value in (change.old, change.new))
        yield f"{describe(file, change.address)}: {old} -> {new}"
    if correction.settings:
        yield f"{options.path}: {len(changes)} value{'' if len(changes) == 1 else 's'} {would}changed"
    if correction.measurement is not None:
        used = asdict(correction.measurement.answers)
        for name in correction.measurement.assumed:
            print_remark(f"assumed, because nothing names it: {_OPTIONS[name]} {used[name]}")


def _measured(measurement: Measurement, proposal: Proposal) -> Iterator[str]:
    """Yield what was read, its figures, and what error is expected to remain."""
    from amp_studio.report import counted
    from amp_studio.schema import unit_text

    figures, unit = proposal.figures, unit_text(proposal.unit)
    used = measurement.answers
    for text in proposal.notes:
        print_remark(text)
    if measurement.is_circle:
        yield (
            f"{counted(len(measurement.runs), 'circle')} of a ball-bar; errors of the radius in"
            f" {unit_text(used.error_unit)}, {used.sign}"
        )
        return
    yield (
        f"{len(measurement.targets)} targets, {figures.runs_rising} runs rising and {figures.runs_falling}"
        f" falling; positions in {unit_text(used.unit)}, errors in {unit_text(used.error_unit)}, {used.sign}"
    )
    rows = (
        ("Systematic deviation E", figures.systematic),
        ("Range of the mean errors M", figures.mean_range),
        ("Reversal value B", figures.reversal),
        ("Mean reversal value", figures.mean_reversal),
        ("Repeatability R", figures.repeatability),
        ("Accuracy A", figures.accuracy),
    )
    for name, value in rows:
        # From one direction alone there is no reversal value, and from one run no repeatability.
        if value is not None:
            yield f"{name}: {value:.5f} {unit}"
    yield (
        f"Error of both directions: {float(proposal.span_before):.5f} {unit} measured,"
        f" {float(proposal.span_after):.5f} {unit} expected"
    )


def _table_lines(
    file: ParameterFile, offered: Compensation, axis: str, table: CalibrationTable | None
) -> Iterator[str]:
    """Yield the reversal error and the table of an axis, point by point; its remarks go to standard error."""
    from amp_studio.calibration import shown_unit
    from amp_studio.files import describe
    from amp_studio.schema import show_value, unit_text

    if offered.reversal:
        value = file.get((offered.reversal, axis))
        parameter = file.schema.parameters[offered.reversal]
        yield f"{describe(file, (offered.reversal, axis))}: {show_value(parameter, value)}"
    form = offered.table
    if form is None:
        return
    if table is None:
        yield "No calibration table"
    else:
        how = (
            f", {table.input}, starts at the most {'negative' if table.start == '-' else 'positive'} position"
            if table.input
            else ""
        )
        unit, size = shown_unit(file, table)
        yield f"Calibration table: {len(table.points)} points in {unit_text(unit)}{how}"
        for at, by in table.points:
            yield f"{float(at / size):14.5f} {float(form.figure(table, at, by) / size):14.5f}"
        # To standard error: standard output stays a table that a program can read.
        for remark in form.remarks(file, axis, table):
            print_remark(remark)
    yield from form.limits(file, axis)
    yield form.switching


def _short(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def _json(
    options: Options,
    file: ParameterFile,
    offered: Compensation,
    axis: str,
    correction: _Correction,
    changes: list[Change],
) -> dict[str, Any]:
    """Return tables, figures and changes of an axis as ``--json`` prints them."""
    from amp_studio.calibration import base_unit, present_table, shown_unit

    table = present_table(file, offered, axis)
    form = offered.table
    data: dict[str, Any] = {
        "file": str(options.path),
        "axis": axis,
        "unit": base_unit(file, offered, axis),
        "reversal": _value(file, (offered.reversal, axis)) if offered.reversal else None,
        "table": None,
        "changes": [
            {
                "param": file.machine_schema.short(c.address),
                "old": _written(file, c.address, c.old),
                "new": _written(file, c.address, c.new),
            }
            for c in changes
        ],
        "dry_run": options.dry_run,
    }
    if form is not None and table is not None:
        unit, size = shown_unit(file, table)
        data["table"] = {
            "param": file.machine_schema.short((form.parameter, axis)),
            "unit": unit,
            "input": table.input,
            "start": table.start,
            "points": [
                {
                    "position": float(at / size),
                    "figure": float(form.figure(table, at, by) / size),
                    "error": float(by / size),
                }
                for at, by in table.points
            ],
        }
    if form is not None:
        data["limits"] = list(form.limits(file, axis))
        data["remarks"] = list(form.remarks(file, axis, table)) if table is not None else []
    if correction.proposal is not None and correction.measurement is not None:
        data |= _proposal_json(correction.measurement, correction.proposal)
    return data


def _proposal_json(measurement: Measurement, proposal: Proposal) -> dict[str, Any]:
    """Return what was measured and what is expected to remain, as ``--json`` prints it."""
    figures = asdict(proposal.figures)
    targets = [asdict(t) | {"mean": t.mean, "reversal": t.reversal} for t in proposal.figures.targets]
    names = {True: "rising", False: "falling"}
    # A ball-bar measures radii and has no targets: the figures of ISO 230-2 are not defined for it.
    if measurement.is_circle:
        asked = [_OPTIONS[name] for name in measurement.assumed]
        return {"answers": asdict(measurement.answers), "assumed": asked, "notes": list(proposal.notes)}
    return {
        "answers": asdict(measurement.answers),
        "assumed": [_OPTIONS[name] for name in measurement.assumed],
        "figures": figures | {"targets": targets},
        "residual": {"before": float(proposal.span_before), "after": float(proposal.span_after)},
        "curves": {
            when: {
                names[side]: [[float(at), float(by)] for at, by in curve.points]
                for side, curve in sides.items()
            }
            for when, sides in (("before", proposal.before), ("after", proposal.after))
        },
        "notes": list(proposal.notes),
    }


def _value(file: ParameterFile, address: Address) -> dict[str, str | None]:
    return {"param": file.machine_schema.short(address), "value": _written(file, address, file.get(address))}


def _written(file: ParameterFile, address: Address, value: Value | None) -> str | None:
    from amp_studio.schema import write_value

    return None if value is None else write_value(file.schema.parameters[address[0]], value)
