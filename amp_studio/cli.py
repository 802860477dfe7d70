"""The command line: every verb of the program without a display.

Exit codes: 0 done and nothing wrong; 1 done, and what was checked has errors;
2 the input cannot be used (one line on standard error, nothing written).
argparse is used because it answers misuse with exit code 2 and costs no start-up time.
"""

from __future__ import annotations

import argparse
import io
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from amp_studio import __version__
from amp_studio.schema import DatabaseFault, UnknownParameter, ValueFault

FAULT = 2


class UsageFault(Exception):
    """Input that cannot be used; the text is the one line the user sees."""


class _Parser(argparse.ArgumentParser):
    """An argument parser that says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        raise UsageFault(f"{message} (see '{self.prog} --help')")


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run one verb and exit with its code; without a verb the desktop program opens."""
    for stream in (sys.stdout, sys.stderr):  # a sign that the terminal does not have is no reason to stop
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    sys.exit(run(sys.argv[1:] if arguments is None else arguments))


def run(arguments: Sequence[str]) -> int:
    """Run one verb and return its exit code."""
    if not arguments:
        from amp_studio.ui import main as desktop

        return desktop([])
    try:
        options = _parser().parse_args(arguments)
        return int(options.act(options))
    except (UsageFault, UnknownParameter, ValueFault, DatabaseFault) as error:
        return _refuse(str(error))
    except BrokenPipeError:
        sys.stderr.close()
        return FAULT
    except KeyboardInterrupt:
        return _refuse("stopped")
    except (ValueError, OSError) as error:
        return _refuse(_one_line(error))


def _one_line(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror and error.filename:
        return f"{error.filename}: {error.strerror}"
    return " ".join(str(error).split())


def _refuse(text: str) -> int:
    print(f"amp-studio: {text}", file=sys.stderr)
    return FAULT


def _note(text: str) -> None:
    print(text, file=sys.stderr)


def _print_json(data: Any) -> None:
    print(json.dumps(data, ensure_ascii=(sys.stdout.encoding or "").lower() != "utf-8", indent=2))


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="amp-studio", description="Edit, check, print and exchange the parameters of a machine control."
    )
    parser.add_argument("--version", action="version", version=f"amp-studio {__version__}")
    verbs = parser.add_subparsers(metavar="VERB", required=True, parser_class=_Parser)

    def verb(name: str, act: Any, told: str) -> argparse.ArgumentParser:
        sub = verbs.add_parser(name, help=told, description=told)
        sub.set_defaults(act=act)
        return sub

    def json_option(sub: argparse.ArgumentParser) -> None:
        sub.add_argument("--json", action="store_true", help="print one JSON document")

    sub = verb("families", _families, "list the control families")
    json_option(sub)
    sub = verb("schema", _schema, "every parameter definition of a family")
    sub.add_argument("family")
    sub.add_argument("--group")
    json_option(sub)
    sub = verb("show", _show, "one parameter as a person reads it")
    sub.add_argument("family")
    sub.add_argument("param")
    sub.add_argument(
        "--machine", help="machine type, where a number means another parameter on another machine"
    )
    sub = verb("new", _new, "a new parameter file with the family's defaults")
    sub.add_argument("family")
    sub.add_argument("path", type=Path)
    sub.add_argument("--machine")
    sub.add_argument("--axes", help="axis names in order, with commas")
    sub = verb("set", _set, "change values, all or none; the previous file becomes the backup")
    sub.add_argument("path", type=Path)
    sub.add_argument("assignments", nargs="+", metavar="PARAM=VALUE")
    sub.add_argument("--force", action="store_true", help="take values out of range, and mark them")
    sub = verb("get", _get, "values with unit, default, and whether changed")
    sub.add_argument("path", type=Path)
    sub.add_argument("params", nargs="*", metavar="PARAM")
    sub.add_argument("--all", action="store_true", help="also what is hidden or not set")
    json_option(sub)
    sub = verb("validate", _validate, "range, choice, state and cross-parameter findings")
    sub.add_argument("paths", nargs="+", type=Path, metavar="PATH")
    sub.add_argument("--rules", type=Path, help="further rules in the same form")
    json_option(sub)
    sub = verb("diff", _diff, "differences by parameter; A or B may be a control's address")
    sub.add_argument("a")
    sub.add_argument("b")
    json_option(sub)
    sub = verb("merge", _merge, "three-way merge by parameter")
    for name in ("base", "ours", "theirs"):
        sub.add_argument(name, type=Path)
    sub.add_argument("-o", "--output", type=Path, required=True)
    sub = verb("report", _report, "documentation as .pdf, .html, .csv or .txt")
    sub.add_argument("path", type=Path)
    sub.add_argument("-o", "--output", type=Path, required=True)
    sub.add_argument("--sort", choices=("axis", "number", "group"), default="group")
    sub.add_argument("--changed-only", action="store_true")
    sub = verb("emulate", _emulate, "an emulated control that takes downloads and gives uploads")
    sub.add_argument("family")
    sub.add_argument("--listen", required=True, metavar="ADDRESS")
    sub.add_argument("--state", type=Path, metavar="DIR", help="where the control keeps its memory")
    sub.add_argument("--machine", help="machine type of the file it is born with")
    sub.add_argument("--no-estop", action="store_true", help="start out of E-stop")
    sub.add_argument(
        "--manual-restart", action="store_true", help="do not restart by itself after a download"
    )
    sub.add_argument(
        "--faults",
        default="{}",
        metavar="JSON",
        help='what goes wrong, to practise with: {"drop_after_bytes": 9000}',
    )
    sub = verb("download", _download, "send a file to a control, read it back and compare")
    sub.add_argument("path", type=Path)
    sub.add_argument("--to", required=True, metavar="ADDRESS")
    sub.add_argument(
        "--keep", type=Path, metavar="DIR", help="where to keep what the control held (beside the file)"
    )
    sub = verb("upload", _upload, "fetch the control's file under a new name")
    sub.add_argument("--from", dest="source", required=True, metavar="ADDRESS")
    sub.add_argument("-o", "--output", type=Path, required=True)
    sub.add_argument("--on-fault", choices=("ask", "keep", "quit"), default="ask",
                     help="what to do with out-of-range values (default: ask at a terminal, else quit)")  # fmt: skip
    sub = verb("verify", _verify, "compare a file with what the control holds")
    sub.add_argument("path", type=Path)
    sub.add_argument("--with", dest="control", required=True, metavar="ADDRESS")
    json_option(sub)
    sub = verb("simulate", _simulate, "check settings in motion")
    sub.add_argument("path", type=Path)
    sub.add_argument("scenario")
    sub.add_argument("--axis")
    sub.add_argument("--set", action="append", default=[], metavar="PARAM=VALUE", dest="assignments")
    sub.add_argument("-o", "--output", type=Path)
    json_option(sub)
    sub = verb(
        "demo",
        _demo,
        "the whole job on the example machine: in the desktop program, or here without a display",
    )
    sub.add_argument(
        "--terminal", action="store_true", help="stay in the terminal even where there is a display"
    )
    return parser


# -- the schema ----------------------------------------------------------------


def _family(name: str) -> Any:
    from amp_studio.schema import family_ids, load_schema

    try:
        return load_schema(name)
    except KeyError:
        raise UsageFault(f"'{name}' is no control family: {', '.join(family_ids())}") from None


def _families(options: argparse.Namespace) -> int:
    from amp_studio.schema import family_ids

    rows = []
    for family_id in family_ids():
        schema = _family(family_id)
        values = max(len(schema.addresses(m.key)) for m in schema.family.machines)
        rows.append(
            {
                "id": family_id,
                "name": schema.family.name,
                "parameters": len(schema.parameters),
                "values": values,
            }
        )
    if options.json:
        _print_json({"families": rows})
    else:
        for row in rows:
            print(f"{row['id']:10} {row['name']:40} {row['parameters']:5} parameters, {row['values']} values")
    return 0


def _schema(options: argparse.Namespace) -> int:
    from amp_studio.report import definition, one_line

    schema = _family(options.family)
    groups = [g for g in schema.groups if options.group in (None, g.key, g.name, g.section)]
    if not groups:
        names = ", ".join(dict.fromkeys(g.name for g in schema.groups))
        raise UsageFault(f"{schema.family.name} has no group '{options.group}': {names}")
    parameters = [p for g in groups for p in g.parameters]
    if options.json:
        _print_json({"family": options.family, "signature": schema.signature,
                     "parameters": [definition(schema, p) for p in parameters]})  # fmt: skip
    else:
        for parameter in parameters:
            print(one_line(schema, parameter))
    return 0


def _show(options: argparse.Namespace) -> int:
    from amp_studio.report import page_of

    schema = _family(options.family)
    print(page_of(schema, options.param, options.machine))
    return 0


# -- files ---------------------------------------------------------------------


def _new(options: argparse.Namespace) -> int:
    from amp_studio.files import Document, new_file

    schema = _family(options.family)
    axes = [a.strip() for a in options.axes.split(",")] if options.axes else []
    file = new_file(options.family, options.machine, axes, options.path.stem)
    Document.create(file, options.path).close()
    print(f"{options.path}: {schema.family.name}, {file.machine}, {len(file.values)} values")
    return 0


def _assignments(texts: Sequence[str]) -> list[tuple[str, str]]:
    pairs = []
    for text in texts:
        param, sign, value = text.partition("=")
        if not sign or not param.strip():
            raise UsageFault(f"'{text}' is not PARAM=VALUE")
        pairs.append((param.strip(), value.strip()))
    return pairs


def _set(options: argparse.Namespace) -> int:
    from amp_studio.files import Document, RangeFault, describe
    from amp_studio.files.lock import now
    from amp_studio.schema import show_value

    with Document.open(options.path) as document:
        file = document.file
        wanted, marks = _wanted(file, options.assignments), dict(file.forced)
        try:
            changes = file.set_many(wanted, force=f"on {now()} by 'set --force'" if options.force else "")
        except RangeFault as error:
            raise UsageFault(f"{error}; nothing was changed (--force takes it and marks it)") from None
        if changes or file.forced != marks:
            document.save("set --force" if options.force else "set")
        if not changes:
            _note("nothing changed: every value was so already")
        for change in changes:
            parameter = file.schema.parameters[change.address[0]]
            print(f"{describe(file, change.address)}: {show_value(parameter, change.old)} -> "
                  f"{show_value(parameter, change.new)}")  # fmt: skip
            state = file.situation.state(change.address)
            if state.state != "in-force":
                _note(f"{describe(file, change.address)} is {state.state}: {state.why}")
    return 0


def _wanted(file: Any, texts: Sequence[str]) -> dict[Any, Any]:
    """Read assignments in order, each in the light of those before it; the file itself is not changed."""
    trial, wanted = file.copy(), {}
    for param, text in _assignments(texts):
        address, bit = trial.situation.find_bit(param)
        if bit is not None:
            value = _with_bit(trial, address, bit, text)
        else:
            value = trial.read(address, text) if text else None
        wanted[address] = value
        trial.set(address, value)
    return wanted


def _with_bit(file: Any, address: Any, bit: int, text: str) -> Any:
    """Return the value of a word of bits with one field changed; a word that is not set counts as its default, or 0."""
    from amp_studio.schema import Value, field_at, with_field

    field = field_at(file.schema.parameters[address[0]], bit)
    word = file.get(address) or file.default(address) or Value(0)
    return Value(with_field(field, int(word.value), text), word.unit)


def _bit_row(file: Any, address: Any, bit: int) -> dict[str, Any]:
    """Return one field of a word of bits as ``get`` shows it."""
    from amp_studio.schema import field_at, field_value

    field = field_at(file.schema.parameters[address[0]], bit)
    words = (file.get(address), file.default(address))
    word, default = (None if v is None else field_value(field, int(v.value)) for v in words)
    labels = {c.raw: c.label for c in field.choices or ()}
    return {"param": f"{file.schema.short(address, file.machine)}.{bit}", "id": address[0], "instance": address[1],
            "bit": bit, "label": field.label, "value": labels.get(word, word), "unit": "", "raw": word,
            "default": word == default, "state": file.situation.state(address).state,
            "forced": address in file.forced}  # fmt: skip


def _get(options: argparse.Namespace) -> int:
    from amp_studio.files import open_file
    from amp_studio.schema import show_value, write_value
    from amp_studio.transfer.image import stored_number

    file = open_file(options.path).file
    if options.params:
        found = [file.situation.find_bit(p) for p in options.params]
    else:
        found = [(a, None) for a in file.addresses()
                 if options.all or (a in file.values and file.situation.state(a).state != "hidden")]  # fmt: skip
    rows = []
    for address, bit in found:
        if bit is not None:
            rows.append(_bit_row(file, address, bit))
            if not options.json:
                held = "—" if rows[-1]["value"] is None else rows[-1]["value"]
                print(f"{rows[-1]['param']} {rows[-1]['label']:40} {held}")
            continue
        parameter, value = file.schema.parameters[address[0]], file.get(address)
        plain = None if value is None else value.value
        if isinstance(plain, (str, bool)):
            plain = write_value(parameter, value)
        raw = None if value is None else stored_number(parameter, value, file.situation.turns(address))
        rows.append({
            "param": file.schema.short(address, file.machine), "id": address[0], "instance": address[1],
            "value": plain, "unit": value.unit if value else file.situation.unit(address, file.header.units), "raw": raw,
            "default": file.is_default(address), "state": file.situation.state(address).state,
            "forced": address in file.forced,
        })  # fmt: skip
        if not options.json:
            mark = "" if rows[-1]["default"] else " *"
            state = "" if rows[-1]["state"] == "in-force" else f"  ({rows[-1]['state']})"
            print(
                f"{file.schema.label(address, file.machine):52} {show_value(parameter, value)}{mark}{state}"
            )
    if options.json:
        _print_json({"values": rows})
    return 0


def _validate(options: argparse.Namespace) -> int:
    from amp_studio.files import open_file
    from amp_studio.report import finding_json, finding_text
    from amp_studio.schema import read_rules
    from amp_studio.validate import Validator

    extra = read_rules(options.rules) if options.rules else ()
    documents, errors = [], 0
    for path in options.paths:
        file = open_file(path).file
        findings = Validator(file, extra).run()
        counts = {s: sum(f.severity == s for f in findings) for s in ("error", "warning", "advice")}
        errors += counts["error"]
        documents.append({"file": str(path), "errors": counts["error"], "warnings": counts["warning"],
                          "advice": counts["advice"], "findings": [finding_json(file, f) for f in findings]})  # fmt: skip
        if not options.json:
            for finding in findings:
                print(finding_text(file, finding))
            print(
                f"{path}: {counts['error']} errors, {counts['warning']} warnings, {counts['advice']} pieces of advice"
            )
    if options.json:
        _print_json(documents[0] if len(documents) == 1 else {"files": documents})
    return 1 if errors else 0


def _diff(options: argparse.Namespace) -> int:
    from amp_studio.files import compare
    from amp_studio.schema import show_value, write_value

    a, b = _side(options.a), _side(options.b)
    if a.schema is not b.schema:
        raise UsageFault(f"{options.a} is for {a.schema.family.name}, {options.b} for {b.schema.family.name}")
    found = compare(a.schema, a.values, b.values)
    if options.json:

        def text(d: Any, v: Any) -> str | None:
            return None if v is None else write_value(a.schema.parameters[d.address[0]], v)

        _print_json({"differences": [{"param": a.schema.short(d.address, a.machine), "id": d.address[0],
                                      "instance": d.address[1], "a": text(d, d.a), "b": text(d, d.b)}
                                     for d in found.differences], "same": found.same})  # fmt: skip
    else:
        for d in found.differences:
            parameter = a.schema.parameters[d.address[0]]
            print(
                f"{a.schema.label(d.address, a.machine):52} {show_value(parameter, d.a)}  |  {show_value(parameter, d.b)}"
            )
        print(f"{len(found.differences)} differ, {found.same} are the same, {found.absent_in_a} are absent in A, "
              f"{found.absent_in_b} absent in B")  # fmt: skip
    return 1 if found.differences else 0


def _side(text: str) -> Any:
    from amp_studio.files import open_file

    if "://" in text or text.startswith(("serial:", "pty:")):
        from amp_studio.transfer.parameters import fetch_file

        return fetch_file(text, _progress())
    return open_file(Path(text)).file


def _merge(options: argparse.Namespace) -> int:
    from amp_studio.files import Document, merge, open_file
    from amp_studio.schema import show_value

    base, ours, theirs = (open_file(p).file for p in (options.base, options.ours, options.theirs))
    merged, conflicts = merge(base, ours, theirs)
    merged.header.name = options.output.stem
    Document.create(merged, options.output).close()
    for c in conflicts:
        p = base.schema.parameters.get(c.address[0])
        if p is None:  # an entry that the schema does not know
            print(f"conflict at {'@'.join(filter(None, c.address))}: ours stands")
            continue
        print(f"conflict at {base.schema.label(c.address, ours.machine)}: base {show_value(p, c.base)}, "
              f"ours {show_value(p, c.ours)}, theirs {show_value(p, c.theirs)}; ours stands")  # fmt: skip
    print(f"{options.output}: {len(conflicts)} conflicts")
    return 1 if conflicts else 0


def _report(options: argparse.Namespace) -> int:
    from amp_studio.files import open_file
    from amp_studio.report import write_report

    file = open_file(options.path).file
    write_report(
        file, options.output, sort=options.sort, changed_only=options.changed_only, source=options.path
    )
    print(options.output)
    return 0


# -- the control ---------------------------------------------------------------


def _progress() -> Any:
    """Return a progress callback: one line on standard error that counts the per cent."""
    last: dict[str, int] = {}

    def show(stage: str, done: int, total: int) -> None:
        percent = 100 if total == 0 else done * 100 // total
        if last.get(stage) != percent:
            last[stage] = percent
            if sys.stderr.isatty():
                print(
                    f"\r{stage} {percent:3d} %",
                    end="\n" if percent == 100 else "",
                    file=sys.stderr,
                    flush=True,
                )
            elif percent == 100:
                print(f"{stage} 100 %", file=sys.stderr, flush=True)

    return show


def _emulate(options: argparse.Namespace) -> int:
    from amp_studio.transfer.parameters import emulate

    _family(options.family)
    return emulate(options.family, options.listen, options.state, machine=options.machine, estop=not options.no_estop,
                   autostart=not options.manual_restart, faults=options.faults)  # fmt: skip


def _download(options: argparse.Namespace) -> int:
    from amp_studio.files import open_file
    from amp_studio.transfer.parameters import download_file

    file = open_file(options.path).file
    outcome = download_file(
        file, options.to, options.keep or options.path.parent, options.path.stem, _progress()
    )
    print(outcome.text)
    return 0 if outcome.verified else 1


def _upload(options: argparse.Namespace) -> int:
    from amp_studio.files import Document
    from amp_studio.transfer.parameters import fetch_file, out_of_range

    if options.output.exists():
        raise UsageFault(f"{options.output} exists already: an upload gets a new name")
    file = fetch_file(options.source, _progress())
    for address, said in out_of_range(file):
        _walk(file, address, said, options.on_fault)
    file.header.name = options.output.stem
    Document.create(file, options.output).close()
    print(f"{options.output}: {len(file.values)} values")
    return 0


def _walk(file: Any, address: Any, said: str, on_fault: str) -> None:
    """Ask what to do with one out-of-range value of an upload: continue, edit, or quit."""
    from amp_studio.files import RangeFault
    from amp_studio.files.lock import now

    if on_fault == "quit" or (on_fault == "ask" and not sys.stdin.isatty()):
        raise UsageFault(
            f"the upload holds an illegal value, nothing was written: {said} (--on-fault keep takes it)"
        )
    while on_fault == "ask":
        answer = input(f"{said}\n[C]ontinue checking, [E]dit parameter, [Q]uit? ").strip().casefold()
        if answer.startswith("q"):
            raise UsageFault("upload given up, nothing was written")
        if answer.startswith("c"):
            break
        if answer.startswith("e"):
            try:
                file.set_many({address: file.read(address, input("new value: "))})
                return
            except (ValueFault, RangeFault) as error:
                _note(str(error))
    file.forced[address] = f"on {now()} by an upload"


def _verify(options: argparse.Namespace) -> int:
    options.a, options.b = str(options.path), options.control
    return _diff(options)


# -- motion, demo --------------------------------------------------------------


def _simulate(options: argparse.Namespace) -> int:
    from amp_studio.files import open_file
    from amp_studio.sim import simulate, trace_summary, trace_text, write_trace

    file = open_file(options.path).file
    settings, own = _settings(options.assignments)
    for address, value in _wanted(file, own).items():
        file.set(address, value)
    axis = _axis(file, options.axis) if options.axis else None
    trace = simulate(file, options.scenario, axis, settings)
    if options.output:
        write_trace(trace, options.output)
    if options.json:
        _print_json(trace_summary(trace))
    else:
        print(trace_text(trace))
    return 1 if trace.alarms else 0


def _axis(file: Any, text: str) -> str:
    """Return the axis a person means by its number or its name."""
    from amp_studio.files import axis_instances
    from amp_studio.schema import write_value

    profile, instances = file.schema.family.axes, axis_instances(file)
    for axis in instances:
        value = file.get((profile.name, axis))
        name = write_value(file.schema.parameters[profile.name], value)
        if axis == text or (value is not None and name.casefold() == text.casefold()):
            return axis
    raise UsageFault(f"there is no axis '{text}'")


def _settings(texts: Sequence[str]) -> tuple[dict[str, float | str], list[str]]:
    """Part the settings of the scenario and its model (``move.feedrate=3000``) from parameters."""
    from amp_studio.schema import canonical, unit_named
    from amp_studio.schema.values import read_number

    settings: dict[str, float | str] = {}
    own = []
    for param, text in _assignments(texts):
        if param.partition(".")[0] not in ("move", "model"):
            own.append(f"{param}={text}")
            continue
        try:
            number, unit = read_number(text)
            settings[param] = canonical(number, unit_named(unit)) if unit.strip() else number
        except ValueFault:
            settings[param] = text
    return settings, own


def _demo(options: argparse.Namespace) -> int:
    from amp_studio.demo import run_demo

    return run_demo(terminal=options.terminal)


if __name__ == "__main__":
    main()
