"""The steps of commissioning in the manual's order: what is set, what is not, what is next."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON, LANGUAGE, OUTPUT, TEXT, path_of
from amp_studio.cli.console import family, is_family, print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.files.ways import way_lines, way_names, ways_json
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced, print_remarks
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from collections.abc import Sequence

    from amp_studio import MachineParameters
    from amp_studio.files import ParameterFile
    from amp_studio.guide import GuideProgress, SetupStep, StepProgress
    from amp_studio.report import OpenValue
    from amp_studio.schema import Address, Schema

VERB = Verb(
    __doc__,
    VerbArgument(
        "path", type=path_of, metavar="FILE", help="parameter file (.amp), or a family for its steps alone"
    ),
    VerbArgument(
        "step",
        nargs="?",
        metavar="STEP",
        help="only this step, by number or id, with its values",
        completes=candidates.steps,
    ),
    VerbArgument("--step", dest="at", metavar="STEP", help="the same", completes=candidates.steps),
    VerbArgument(
        "--way",
        metavar="WAY",
        help="a printed way of tuning or fitting, step by step, with what shows each on the simulated axis",
        completes=candidates.ways,
    ),
    VerbArgument("--next", action="store_true", help="the next value that is not set, with its help"),
    VerbArgument(
        "--after",
        metavar="PARAM",
        help="with --next: the one that comes after this parameter",
        completes=candidates.parameters,
    ),
    VerbArgument(
        "--done",
        action="append",
        metavar="STEP",
        help="tick a step as done; it is kept in the file",
        completes=candidates.steps,
    ),
    VerbArgument(
        "--not-done", action="append", metavar="STEP", help="take that tick away", completes=candidates.steps
    ),
    VerbArgument(
        "--keep-defaults",
        metavar="STEP",
        help="set what is not set in a step to the printed defaults",
        completes=candidates.steps,
    ),
    OUTPUT.but(required=False, help="write the check list as .pdf, .html or .txt"),
    LANGUAGE,
    JSON,
    *TEXT,
    writes=("path", "output"),
    sections=("families", "PARAM"),
    examples=(
        "amp-studio guide 9pc",
        "amp-studio guide MILL_1394.amp",
        "amp-studio guide MILL_1394.amp home",
        "amp-studio guide MILL_1394.amp --way tuning",
        "amp-studio guide MILL_1394.amp --next --json",
        "amp-studio guide MILL_1394.amp --done dual",
        "amp-studio guide MILL_1394.amp -o list.pdf",
    ),
)


_MARKS = {"not begun": " ", "begun": "~", "done": "x", "not needed": "-"}

_CHANGING = ("done", "not_done", "keep_defaults")

_MAX_OPEN_VALUES = 12
"""Open values that the overview lists; the step alone lists all of them."""


def run(options: Options) -> int:
    """Print the steps of a family, or how far a file has come in them; tick a step, keep its defaults,
    print the check list.
    """
    from amp_studio.guide import progress

    asked_for = options.step or options.at
    if is_family(str(options.path)):
        return _family(options, family(str(options.path)), asked_for)
    path = options.path
    if options.output:
        check_replaced(options.output, path)
    is_changing = any(getattr(options, key) for key in _CHANGING)
    machine = _changed(options) if is_changing else opened(path, options)
    file = machine.file
    # --json has every way with each answer.
    if options.way and not options.json:
        print("\n".join(way_lines(file.schema, options.way, str(path), file)))
        return 0
    step = _step(file.schema, asked_for) if asked_for else None
    validator = machine.validator()
    come = progress(validator, validator.run())
    if options.output:
        return _write(options, file, come, path)
    if options.next:
        return _next(options, file, come, step)
    if options.json:
        print_json(_as_json(file, come, path, step))
        return 0
    if is_changing:
        print("\n".join(_changed_lines(options, file, come)))
    else:
        print("\n".join(_overview(file, come, path) if step is None else _step_lines(file, come.of(step))))
    return 0


def _changed_lines(options: Options, file: ParameterFile, come: GuideProgress) -> Iterator[str]:
    changed = (*(options.done or ()), *(options.not_done or ()), options.keep_defaults)
    return (_step_line(come.of(_step(file.schema, name)), 0) for name in changed if name)


def _changed(options: Options) -> MachineParameters:
    """Tick steps, or keep their defaults, in the file; returns it as it is then."""
    from amp_studio import edit

    with edit(options.path) as machine:
        _change(options, machine)
        # A tick that was there already changes nothing: a save would make the backup a copy of the file.
        if machine.document and machine.document.is_dirty:
            machine.save(verb="guide")
            print_remarks(machine.notes)
    return machine


def _step(schema: Schema, text: str) -> SetupStep:
    from amp_studio.guide import find_step

    try:
        return find_step(schema, text)
    except ValueError as error:
        raise UsageError(str(error)) from None


def _family(options: Options, schema: Schema, asked_for: str | None) -> int:
    """Print the steps of a family, or one step with its parameters."""
    from amp_studio.guide import steps_of

    if any(getattr(options, key) for key in (*_CHANGING, "next", "output")):
        raise UsageError(f"{options.path} is a family: only the guide of a file has ticks and open values")
    steps = (_step(schema, asked_for),) if asked_for else steps_of(schema)
    if options.json:
        facts = {"steps": [_facts(s) for s in steps], "ways": ways_json(schema)}
        print_json({"family": schema.family.family, **_order(schema), **facts})
        return 0
    if options.way:
        print("\n".join(way_lines(schema, options.way, str(options.path), None)))
        return 0
    print("\n".join(_step_with_parameters(schema, steps[0]) if asked_for else _all_steps(schema, steps)))
    return 0


def _all_steps(schema: Schema, steps: Sequence[SetupStep]) -> Iterator[str]:
    """Yield whose order the steps have, a line for each, and the printed ways."""
    order = _order(schema)
    if order["order"]:
        yield f"{order['why']}{_cited({'manual': order['page']}.get(order['order']))}"
    yield from map(_head_of_step, steps)
    yield from way_names(schema)


def _step_with_parameters(schema: Schema, step: SetupStep) -> Iterator[str]:
    """Yield the line of a step, and one for each of its parameters."""
    yield _head_of_step(step)
    yield from (f"     {label}" for label in _parameter_labels(schema, step))


def _head_of_step(step: SetupStep) -> str:
    return f"{step.number:>3}  {step.title}{_cited(step.page)}"


def _cited(page: str | None) -> str:
    return f" (page {page})" if page else ""


def _parameter_labels(schema: Schema, step: SetupStep) -> Iterator[str]:
    """Yield the label of each parameter of a step that the usual machine of a family has."""
    here = schema.on(schema.family.default_machine)
    for parameter in step.parameters:
        if instances := here.instances(parameter):
            yield here.label((parameter.id, instances[0]))


def _order(schema: Schema) -> dict[str, Any]:
    """Return whose order the steps have, and where it comes from."""
    order = schema.commissioning
    if order is None:
        return {"order": None, "why": None, "page": None}
    return {"order": order.order, "why": order.why, "page": order.page}


def _facts(step: SetupStep) -> dict[str, Any]:
    """Return what the facts have of a step, as ``--json`` lists it."""
    return {
        "step": step.number,
        "id": step.id,
        "title": step.title,
        "what": step.what,
        "page": step.page or None,
        "parameters": [p.id for p in step.parameters],
        "again": [p.id for p in step.again],
    }


def _change(options: Options, machine: MachineParameters) -> None:
    """Tick steps, take ticks away, and set open values to their defaults."""
    from amp_studio.files import now as stamp
    from amp_studio.files import user
    from amp_studio.guide import progress, tick
    from amp_studio.report import counted

    file = machine.file
    for names, by in ((options.done, f"{stamp()} by {user()}"), (options.not_done, None)):
        for name in names or ():
            tick(file, _step(file.schema, name), by)
    if not options.keep_defaults:
        return
    step = _step(file.schema, options.keep_defaults)
    validator = machine.validator()
    come = progress(validator, validator.run())
    wanted = {a: value for a in come.of(step).open if (value := file.default(a)) is not None}
    # All together: the range of one default may be given by another of them.
    file.set_checked(wanted)
    print_remark(f"{step.title}: {counted(len(wanted), 'value')} set to the default")


def _write(options: Options, file: ParameterFile, come: GuideProgress, path: Path) -> int:
    from amp_studio.dossier import machine_tests_of
    from amp_studio.report import build_check_list, write_check_list

    checks = build_check_list(file, come, path, language=options.language, tests=machine_tests_of(file))
    write_check_list(checks, options.output, print_remark)
    print(options.output)
    return 0


def _next(options: Options, file: ParameterFile, come: GuideProgress, only: SetupStep | None) -> int:
    """Print the next open value, of the file or of one step, and what is known about it."""
    from amp_studio.guide import next_open, step_of
    from amp_studio.report import open_value
    from amp_studio.schema import resolve_addresses

    # A number may be several words: what follows the last of them is asked for.
    behind = resolve_addresses(file.evaluation, options.after)[-1] if options.after else None
    if only is not None:
        come = replace(come, steps=tuple(each for each in come.steps if each.step is only))
    found = next_open(come, behind)
    if options.json:
        print_json({"next": None if found is None else _open_json(file, found)})
    elif found is None:
        print("Every active value is set." if only is None else f"Every active value of {only.title} is set.")
    else:
        step, value = step_of(file.schema)[found[0]], open_value(file, found)
        print(f"Step {step.number} {step.title}: {_value_text(value)}")
        parameter = file.schema.parameters[found[0]]
        for text in filter(None, (parameter.help.what, parameter.help.find)):
            print(text)
        print(f"Set it with: {file.machine_schema.short(found)}=…")
    return 0


def _value_text(value: OpenValue) -> str:
    about = "; ".join(filter(None, (value.allowed, f"page {value.page}")))
    return f"{' '.join(filter(None, (value.number, value.name, value.place)))} ({about})"


def _overview(file: ParameterFile, come: GuideProgress, path: Path) -> Iterator[str]:
    """Yield how far commissioning is, and a line for each step."""
    from amp_studio.files import with_local_times
    from amp_studio.report import delivered_text

    yield f"{path}: {come.done} of {len(come.needed)} steps done, {come.set} of {come.total} values set"
    order = file.schema.commissioning
    if order is not None and order.order == "ours":
        yield order.why
    width = max(len(each.step.title) for each in come.steps)
    for each in come.steps:
        yield _step_line(each, width)
        if each is come.current:
            yield from _open_lines(file, each.open)
    # Ticks of tests at the machine are kept beside those of steps, by names with the axis behind an @.
    known = {each.step.id for each in come.steps}
    for name, who in file.header.done.items():
        if name not in known:
            yield f"[x] at the machine: {name.replace('@', ', axis ')}, ticked {with_local_times(who)}"
    yield from way_names(file.schema)
    if come.deferred:
        # Counted alone: errors of printed defaults would bury the step that is next.
        yield f"{delivered_text(come.deferred, come.deferred_to)}; validate --json lists them"


def _open_lines(file: ParameterFile, addresses: Sequence[Address]) -> Iterator[str]:
    """Yield the first of the values that are not set, and how many more there are."""
    from amp_studio.report import open_value

    for address in addresses[:_MAX_OPEN_VALUES]:
        value = open_value(file, address)
        yield f"        {' '.join(filter(None, (value.number, value.name, value.place)))}"
    if len(addresses) > _MAX_OPEN_VALUES:
        yield f"        and {len(addresses) - _MAX_OPEN_VALUES} more"


def _step_line(each: StepProgress, width: int) -> str:
    """Return the line of a step: its mark, number and title, what is set, found and ticked."""
    from amp_studio.files import with_local_times
    from amp_studio.report import counted
    from amp_studio.validate import SEVERITIES

    parts = [f"{each.set} of {each.total} set"] if each.total else []
    parts += [counted(n, severity) for severity in SEVERITIES if (n := each.count(severity))]
    parts += ["not needed on this machine"] if each.state == "not needed" else []
    parts += [f"ticked {with_local_times(each.ticked)}"] if each.ticked else []
    step = each.step
    text = (
        f"[{_MARKS[each.state]}] {step.number:>2}  {step.title:{width}}  {step.page:>7}  {', '.join(parts)}"
    )
    return text.rstrip()


def _value_lines(file: ParameterFile, each: StepProgress) -> Iterator[str]:
    """Yield the values of a step that are active, and what those can be that are not set."""
    from amp_studio.report import open_value
    from amp_studio.schema import show_value

    here, open_values = file.machine_schema, set(each.open)
    for parameter in each.step.parameters:
        for instance in here.instances(parameter):
            address = (parameter.id, instance)
            if address in open_values:
                yield f"  {here.named(address):52} not set  {open_value(file, address).allowed}".rstrip()
            # An inactive value is left out, set or not: on this machine it decides nothing.
            elif address in file.values and file.evaluation.state(address).is_active:
                mark = "" if file.is_default(address) else " *"
                yield f"  {here.named(address):52} {show_value(parameter, file.get(address))}{mark}"


def _step_lines(file: ParameterFile, each: StepProgress) -> Iterator[str]:
    """Yield a step with every value of it that is active."""
    from amp_studio.files import with_local_times

    step = each.step
    yield f"Step {step.number}: {step.title}" + (f" (page {step.page})" if step.page else "")
    if step.what:
        yield step.what
    ticked = f", ticked {with_local_times(each.ticked)}" if each.ticked else ""
    yield f"{each.state}, {each.set} of {each.total} set{ticked}"
    yield from _value_lines(file, each)
    if step.again:
        yield f"Check again: {', '.join(parameter.name for parameter in step.again)}"
    for finding in each.findings:
        yield f"{finding.severity}: {finding.message}" + (f" ({finding.cited})" if finding.cited else "")


def _as_json(file: ParameterFile, come: GuideProgress, path: Path, only: SetupStep | None) -> dict[str, Any]:
    """Return how far a file is, as ``--json`` prints it; ``only`` one step, with its values."""
    from amp_studio.guide import next_open
    from amp_studio.validate import SEVERITIES

    following = next_open(come)
    return {
        "file": str(path),
        "family": file.schema.family.family,
        **_order(file.schema),
        "steps_done": come.done,
        "steps_needed": len(come.needed),
        "set": come.set,
        "total": come.total,
        "current": come.current.step.id if come.current else None,
        "next": None if following is None else _open_json(file, following),
        "later": {
            # The keys are older than the word "recommendation", and scripts read them.
            f"{key}s" if key != "advice" else key: sum(f.severity == key for f in come.deferred)
            for key in SEVERITIES
        },
        "steps": [
            _step_json(file, each) | ({} if only is None else {"values": _values_json(file, each)})
            for each in come.steps
            if only in (None, each.step)
        ],
        "ways": ways_json(file.schema),
    }


def _values_json(file: ParameterFile, each: StepProgress) -> list[dict[str, Any]]:
    """Return every active value of a step, set or not, in the form of ``get --json``."""
    from amp_studio import MachineParameters
    from amp_studio.schema import ResolvedAddress

    machine, parameters = MachineParameters(file), each.step.parameters
    every = [(p.id, instance) for p in parameters for instance in file.machine_schema.instances(p)]
    return [machine.row(ResolvedAddress(a)) for a in every if file.evaluation.state(a).is_active]


def _step_json(file: ParameterFile, each: StepProgress) -> dict[str, Any]:
    """Return one step as ``--json`` lists it."""
    from amp_studio.report import finding_json

    return _facts(each.step) | {
        "state": each.state,
        "set": each.set,
        "total": each.total,
        "active": each.active,
        "own": each.own,
        "ticked": each.ticked or None,
        "errors": each.count("error"),
        "warnings": each.count("warning"),
        "advice": each.count("advice"),
        "open": [_open_json(file, address) for address in each.open],
        "findings": [finding_json(file, finding) for finding in each.findings],
    }


def _open_json(file: ParameterFile, address: Address) -> dict[str, Any]:
    """Return a value that is not set as ``--json`` lists it, with what it can be."""
    from amp_studio.guide import step_of
    from amp_studio.report import open_value

    value = open_value(file, address)
    return {
        "param": file.machine_schema.short(address),
        "id": address[0],
        "instance": address[1],
        "name": value.name,
        "step": step_of(file.schema)[address[0]].number,
        "unit": value.unit,
        "allowed": value.allowed,
        "page": value.page,
    }
