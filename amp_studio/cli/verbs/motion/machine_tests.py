"""Programs and procedures that try a machine out, written from its file: inside its travel and speeds,
or refused with the reason.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.cli import candidates
from amp_studio.cli.arguments import AXIS, JSON, LANGUAGE, OUTPUT, PATH, TEXT
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio import MachineParameters
    from amp_studio.sim import MachineTest

_PAPERS = (".pdf", ".html")

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument(
        "name",
        nargs="?",
        metavar="TEST",
        help="one of them by its name; without it all are listed",
        completes=candidates.machine_tests,
    ),
    AXIS,
    OUTPUT.but(
        required=False,
        help="file for the program of one test, as the control reads it; .pdf or .html for the check list of"
        " all of them",
    ),
    VerbArgument(
        "--done", action="store_true", help="tick the test of an axis as done; it is kept in the file"
    ),
    VerbArgument("--not-done", action="store_true", help="take that tick away"),
    LANGUAGE,
    JSON,
    *TEXT,
    writes=("output", "path"),
    examples=(
        "amp-studio machine-tests MILL_1394.amp --axis X",
        "amp-studio machine-tests MILL_1394.amp tuning --axis X -o tuning.nc",
        "amp-studio machine-tests MILL_1394.amp -o tests.pdf",
        "amp-studio machine-tests MILL_1394.amp tuning --axis X --done",
    ),
)


def run(options: Options) -> int:
    """List the tests of an axis, or write the program of one; 1 where one that was named is refused."""
    from amp_studio.sim import machine_tests

    if options.output:
        check_replaced(options.output, options.path)
    if options.done or options.not_done:
        return _tick(options)
    machine = opened(options.path, options)
    file, axis = machine.file, machine.axis(options.axis) if options.axis else None
    if options.output and options.output.suffix.lower() in _PAPERS:
        return _write_list(options, machine, axis)
    tests = machine_tests(file, axis)
    if options.name:
        tests = _named_test(tests, options.name)
    if options.output:
        _write(options.output, tests)
    if options.json:
        print_json({"tests": [asdict(test) for test in tests]})
    else:
        print("\n\n".join(map(text, tests)))
    return int(bool(options.name) and bool(tests[0].refusal))


def _tick(options: Options) -> int:
    """Tick the test that is named, of the axis or of the first one, or take its tick away."""
    from amp_studio import edit
    from amp_studio.dossier import tick_of_test
    from amp_studio.files import now, user
    from amp_studio.guide import tick
    from amp_studio.sim import machine_tests, simulated_axes

    if not options.name or (options.done and options.not_done):
        raise UsageError("Name the one test that is ticked, with --done or --not-done")
    with edit(options.path) as machine:
        axis = machine.axis(options.axis) if options.axis else next(iter(simulated_axes(machine.file)), "")
        test = _named_test(machine_tests(machine.file, axis), options.name)[0]
        if tick(
            machine.file, tick_of_test(test.name, axis), f"{now()} by {user()}" if options.done else None
        ):
            machine.save(verb="machine-tests")
    print(f"{options.path}: {test.name} of axis {axis} {'ticked' if options.done else 'not ticked'}")
    return 0


def _write_list(options: Options, machine: MachineParameters, axis: str | None) -> int:
    """Write the tests as a list with a box for each step."""
    from amp_studio.dossier import machine_tests_of
    from amp_studio.guide import progress
    from amp_studio.report import build_check_list, write_check_list

    file = machine.file
    name = f"{options.name}@" if options.name else ""
    tests = [test for test in machine_tests_of(file, axis) if test.id.startswith(name)]
    if not tests:
        raise UsageError(f"{options.path} has no such test. `amp-studio machine-tests` lists them")
    come = progress(machine.validator(), ())
    checks = build_check_list(
        file, replace(come, steps=()), options.path, language=options.language, tests=tests
    )
    write_check_list(replace(checks, summary="", order=""), options.output, print_remark)
    print(options.output)
    return 0


def _named_test(tests: Sequence[MachineTest], name: str) -> tuple[MachineTest, ...]:
    """Return the one test with a name; raises UsageError."""
    named = tuple(test for test in tests if test.name == name)
    if not named:
        raise UsageError(f"Unknown test '{name}'. Known: {', '.join(test.name for test in tests)}")
    return named


def text(test: MachineTest) -> str:
    """Return a test as a person reads it at the machine, with a box to tick for each step."""
    lines = [f"{test.name}: {test.title} (page {test.page})"]
    if test.refusal:
        return "\n".join([*lines, f"  refused: {test.refusal}"])
    lines += [f"    {line}" for line in test.lines]
    lines += [f"  [ ] {step.do}.\n      Must be seen: {step.see}." for step in test.steps]
    return "\n".join([*lines, *(f"  {text}" for text in test.notes)])


def _write(path: Path, tests: Sequence[MachineTest]) -> None:
    """Write the program of the one test that was named."""
    from amp_studio.files import write_atomic

    if len(tests) != 1:
        raise UsageError("Name the test whose program is written")
    test = tests[0]
    if test.refusal:
        raise UsageError(test.refusal)
    # ASCII is what every control reads; the lines are made here, and have nothing else in them.
    write_atomic(path, "".join(f"{line}\n" for line in test.lines).encode("ascii"), keep_backup=False)
    print_remark(f"{path}: {len(test.lines)} lines")
