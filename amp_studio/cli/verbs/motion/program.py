"""A part program under a file: its path and time, which parameter limits each piece, and how far the axes
are from it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON, OUTPUT, count, path_of
from amp_studio.cli.console import print_json, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.schema import Address, Value
    from amp_studio.sim import ProgramRun

VERB = Verb(
    __doc__,
    VerbArgument("program", type=path_of, metavar="FILE.nc", help="part program, a text of blocks"),
    VerbArgument(
        "--machine", dest="path", type=path_of, required=True, metavar="PATH", help="parameter file (.amp)"
    ),
    VerbArgument(
        "--what-if",
        action="append",
        default=[],
        metavar="PARAM=VALUE",
        help="the same program with another value, as 5 or +20%; several are tried each and together",
        completes=candidates.assignments,
    ),
    VerbArgument(
        "--over",
        action="append",
        default=[],
        metavar="PARAM=FROM:TO:STEPS",
        help="the same program with a row of values, as 1210=200:800:4 or 1210=-20%:+20%",
        completes=candidates.assignments,
    ),
    VerbArgument(
        "--against",
        action="append",
        type=path_of,
        default=[],
        metavar="FILE",
        help="the same program under another file: an older one, or that of another machine",
    ),
    VerbArgument(
        "--history",
        type=count,
        metavar="N",
        help="the same program under the file as it was before each of its last N saves",
    ),
    VerbArgument(
        "--start", metavar="X0,Y0", help="where the axes are at first, in the machine (default: home)"
    ),
    VerbArgument(
        "--zero", metavar="X0,Y0", help="where the zero of the program is, in place of work coordinates"
    ),
    VerbArgument("--override", metavar="PERCENT", help="override of the feed (default: 100)"),
    VerbArgument("--rapid-override", metavar="PERCENT", help="override of the rapid (default: 100)"),
    VerbArgument("--retract", metavar="LENGTH", help="retract distance of a chip-breaking cycle, as '1 mm'"),
    VerbArgument("--no-contour", action="store_true", help="leave out the simulation of the servo loops"),
    OUTPUT.but(required=False, help="file to write: .csv (a row for each move), .svg or .pdf (path)"),
    JSON,
    writes=("output",),
    examples=(
        "amp-studio program plate.nc --machine ROUTER.amp",
        "amp-studio program plate.nc --machine ROUTER.amp --what-if speeds.feed_acc_dec=+20%",
        "amp-studio program plate.nc --machine ROUTER.amp -o path.svg",
        "amp-studio program plate.nc --machine ROUTER.amp --over speeds.feed_acc_dec=-20%:+20%",
    ),
)
_ENDINGS = (".csv", ".svg", ".pdf")


def run(options: Options) -> int:
    """Run a program: 1 where it meets a limit, or the control cannot use a block."""
    from amp_studio.programs import ProgramBlockError, read_program
    from amp_studio.sim import (
        ProgramJob,
        SimulationError,
        program_summary,
        program_text,
        typed_places,
        typed_steps,
        versions,
        what_if,
    )

    if options.output:
        check_replaced(options.output, options.path, options.program)
        if options.output.suffix.lower() not in _ENDINGS:
            raise UsageError(f"{options.output}: a program is written as {', '.join(_ENDINGS)}")
    file = opened(options.path).file
    show = progress()

    def step(what: str, share: float) -> None:
        # The line of progress counts steps of an exchange; a plan has shares: hundredths are its steps.
        show(what, int(100.0 * share), 100)

    try:
        job = ProgramJob(
            read_program(options.program, file),
            start=_start(options, file),
            zero=typed_places(options.zero, file) if options.zero else None,
            retract=_length(options.retract, file),
            override=_percent(options.override, "--override"),
            rapid_override=_percent(options.rapid_override, "--rapid-override"),
            with_contour=not options.no_contour,
        )
        changes = _tries(options.what_if, file)
        found = job.run(file, step)
        changes += [values for text in options.over for values in typed_steps(file, text)]
        tries = what_if(job, file, changes, step)
        files = {f"{path}": opened(path).file for path in options.against} | _earlier(options)
        others = versions(job, files, step)
    except (ProgramBlockError, SimulationError) as error:
        raise UsageError(f"{error}") from None
    if options.output:
        _write(options, file, found)
    if options.json:
        print_json(program_summary(file, found, tries, others))
    else:
        print(program_text(file, found, tries, others))
    return int(bool(found.alarms))


def _earlier(options: Options) -> dict[str, ParameterFile]:
    """Return the file as it was before its last saves, by when and what they changed."""
    if not options.history:
        return {}
    from amp_studio.files import Document, local_time, real_path, saved_versions
    from amp_studio.schema import read_address

    path = real_path(options.path)
    file = opened(path).file
    short = file.machine_schema.short
    found = {}
    for version in saved_versions(file, Document(file, path, None).history(), options.history):
        changed = ", ".join(short(read_address(each)) for each in version.changed[:3])
        more = ", …" if len(version.changed) > 3 else ""
        found[f"before {local_time(version.when)} ({changed}{more})"] = version.file
    return found


def _write(options: Options, file: ParameterFile, found: ProgramRun) -> None:
    """Write the moves as a table, or the path as a picture; a table of any length, part by part."""
    from amp_studio.drawing import picture_svg
    from amp_studio.files import write_atomic
    from amp_studio.sim import path_picture, program_csv

    content: bytes | Iterator[bytes]
    ending = options.output.suffix.lower()
    if ending == ".csv":
        content = (part.encode() for part in program_csv(file, found))
    else:
        picture = picture_svg(path_picture(file, found))
        content = picture.encode() if ending == ".svg" else _pdf(picture)
    # No backup: the program and the file make it again.
    write_atomic(options.output, content, keep_backup=False)


def _pdf(picture: str) -> bytes:
    """Return a page as large as the picture."""
    import json
    from datetime import datetime

    from amp_studio.report import typeset

    title = '"Path of a part program"'
    image = f'#image(bytes({json.dumps(picture, ensure_ascii=False)}), format: "svg", alt: {title})'
    # The text of JSON is one of Typst as well, without escapes of letters: Typst writes those otherwise.
    page = f"#set document(title: {title})\n#set page(width: auto, height: auto, margin: 10mm)\n{image}\n"
    return typeset(page, datetime.now().astimezone())


def _start(options: Options, file: ParameterFile) -> Sequence[float] | None:
    """Return where the axes are at first, in the order of the path; None for home."""
    from amp_studio.programs import path_letters
    from amp_studio.sim import typed_places

    if options.start is None:
        return None
    places, letters = typed_places(options.start, file), path_letters(file)
    if other := sorted(set(places) - set(letters)):
        raise UsageError(f"--start: the machine has no axis {', '.join(other)}")
    # An axis that is not named begins at the zero of the machine.
    return [places.get(letter, 0.0) for letter in letters]


def _percent(text: str | None, option: str) -> float:
    if text is None:
        return 1.0
    figure = text.strip().removesuffix("%").strip()
    if not re.fullmatch(r"[0-9]{1,3}(\.[0-9]+)?", figure) or not float(figure) > 0.0:
        raise UsageError(f"{option} is '{text}'; it takes per cent above 0 and below 1000")
    return float(figure) / 100.0


def _length(text: str | None, file: ParameterFile) -> float | None:
    if text is None:
        return None
    word = re.fullmatch(r"([0-9]+\.?[0-9]*|\.[0-9]+) ?(mm|in)?", text.strip())
    if word is None:
        raise UsageError(f"--retract is '{text}'; it takes a length, as '1 mm'")
    is_inch = word[2] == "in" or (not word[2] and file.header.units == "inch")
    # The simulator counts in mm; a bare figure has the unit system of the file.
    return float(word[1]) * (25.4 if is_inch else 1.0)


def _tries(texts: Sequence[str], file: ParameterFile) -> list[Mapping[Address, Value]]:
    """Return each change by itself, and all together where there are several."""
    from amp_studio.sim import typed_values

    each = [typed_values(file, [text]) for text in texts]
    # Together last: of two changes to one parameter the later counts.
    return [*each, *([{k: v for one in each for k, v in one.items()}] if len(each) > 1 else [])]
