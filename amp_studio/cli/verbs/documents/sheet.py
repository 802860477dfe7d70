"""The values to key in at a control by hand: in its own numbers, in a safe order, to tick and to read
back.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON, LANGUAGE, OUTPUT, PATH, SECRETS, TEXT, file_or_address, path_of
from amp_studio.cli.console import print_json, print_remark, progress
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.sheet import ReadBack, Sheet, SheetEntry, Ticks

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument(
        "--against",
        required=True,
        type=file_or_address,
        metavar="OTHER",
        help="what the control contains: a file, a kept copy, or the control's address",
    ),
    OUTPUT.but(required=False, help="the sheet as .pdf, .html, .csv or .txt (default: as text here)"),
    LANGUAGE,
    VerbArgument(
        "--tick",
        action="append",
        metavar="PARAM",
        help="remember that this value is keyed in; beside the file",
        completes=candidates.parameters,
    ),
    VerbArgument(
        "--untick",
        action="append",
        metavar="PARAM",
        help="forget that again",
        completes=candidates.parameters,
    ),
    VerbArgument(
        "--check",
        type=path_of,
        metavar="LIST",
        help="lines of number and what the screen shows, or the sheet's .csv filled in: compare exactly",
    ),
    JSON,
    *TEXT,
    SECRETS,
    writes=("output",),
    sections=("PARAM", "ADDRESS"),
    examples=(
        "amp-studio sheet MILL_1394.amp --against other.amp -o sheet.pdf",
        "amp-studio sheet MILL_1394.amp --against other.amp --tick 1300",
        "amp-studio sheet MILL_1394.amp --against other.amp --check screen.txt",
    ),
)


_LARGEST = 1 << 20  # bytes of a list of what the screen shows


def run(options: Options) -> int:
    """Print or write the sheet; with ``--check`` compare what the screen shows:
    1 where something is not as keyed in.
    """
    from amp_studio.report import counted, language_of
    from amp_studio.sheet import SheetError, Ticks, TicksError, make_sheet, ticks_path

    path: Path = options.path
    machine = opened(path, options)
    file = machine.file
    # The ticks as well: they are the only record of what has been keyed in.
    inputs = [path, ticks_path(path), *([options.check] if options.check else [])]
    if options.output:
        check_replaced(options.output, *inputs)
    present, against = _present(options)
    words = language_of(options.language, file.schema.family.family)
    try:
        sheet = make_sheet(
            file,
            present,
            of=path.name,
            against=against,
            own=machine.builder_rules(),
            secrets=options.secrets,
            message=words.cited,
        )
        ticks = Ticks(ticks_path(path), sheet)
    except (SheetError, TicksError) as error:
        raise UsageError(str(error)) from None
    _tick(options, file, sheet, ticks)
    if ticks.forgotten:
        print_remark(f"{counted(ticks.forgotten, 'tick')} left out: the values have changed since")
    for warning in sheet.warnings:
        print_remark(words.sentence(warning))
    if options.check:
        return _check(options, file, sheet, ticks)
    _print(options, sheet, ticks, {})
    return 0


def _present(options: Options) -> tuple[ParameterFile, str]:
    """Return what a control contains and its source: a file, a kept copy, or the control itself."""
    from amp_studio.transfer.links import is_endpoint

    text: str = options.against
    if is_endpoint(text):
        from amp_studio import connect

        control = connect(text, progress=progress())
        return control.upload().file, f"{text}, sha256 {control.sha256}"
    from amp_studio.transfer.client import open_copy

    path = Path(text)
    # An .img is a copy that the client kept of a control, in the form in which it was read.
    if path.suffix != ".img":
        return opened(path, options).file, path.name
    copy = open_copy(path)
    if copy.file is None:
        raise UsageError(f"{path}: {copy.fault}")
    return copy.file, path.name


def _tick(options: Options, file: ParameterFile, sheet: Sheet, ticks: Ticks) -> None:
    for names, on in ((options.tick, True), (options.untick, False)):
        if names:
            ticks.tick(_named(names, file, sheet), on)


def _named(names: Iterable[str], file: ParameterFile, sheet: Sheet) -> list[SheetEntry]:
    """Return the entries of numbers or ids; raises UsageError, UnknownParameterError."""
    entries, found = {entry.address: entry for entry in sheet.entries}, []
    for name in names:
        entry = entries.get(file.find(name))
        if entry is None:
            raise UsageError(f"{name} is not on this sheet")
        found.append(entry)
    return found


def _check(options: Options, file: ParameterFile, sheet: Sheet, ticks: Ticks) -> int:
    found = _read_back(options, file, sheet)
    # What the screen does not show is not the same either: it has not been checked.
    different = [each for each in found if each.state != "same"]
    if options.json or options.output:
        _print(options, sheet, ticks, {each.entry.number: each for each in found})
    if not options.json:
        print(*map(_outcome, different), _counts(found), sep="\n")
    return int(bool(different))


def _counts(found: Sequence[ReadBack]) -> str:
    """Return how many entries the control has, lacks and has otherwise."""
    from collections import Counter

    from amp_studio.sheet import STATES

    counts = Counter(each.state for each in found)
    words = (f"{counts[state]} {name}" for state, name in STATES.items() if counts[state])
    return ", ".join(words) or "Nothing is on the sheet"


def _outcome(each: ReadBack) -> str:
    """Return the line of an entry that is not on the screen as it was to be keyed in."""
    from amp_studio.sheet import STATES

    entry = each.entry
    screen_text = (
        ""
        if each.screen_text is None
        else f": the screen shows {each.screen_text}, it should be {entry.new} {entry.unit}".rstrip()
    )
    return f"{entry.number} {entry.name}: {STATES[each.state]}{screen_text}"


def _read_back(options: Options, file: ParameterFile, sheet: Sheet) -> Sequence[ReadBack]:
    """Return what the screen showed of each entry; raises UsageError for a text that is not readable."""
    from amp_studio.schema import read_file
    from amp_studio.sheet import ReadBackError, compare_screen, read_screen_readings

    content = read_file(options.check, _LARGEST)
    try:
        # A spreadsheet puts the mark of UTF-8 in front of the list.
        return compare_screen(sheet, file, read_screen_readings(content.decode("utf-8-sig")))
    except UnicodeDecodeError:
        raise UsageError(f"{options.check}: there is a byte that is no UTF-8 text") from None
    except ReadBackError as error:
        raise UsageError(f"{options.check}: {error}") from None


def _print(options: Options, sheet: Sheet, ticks: Ticks, found: dict[str, ReadBack]) -> None:
    """Write the sheet, or print it as text or JSON; what was read back just now comes before what is kept."""
    from amp_studio.report import PrintedSheet, counted, text_lines, write_sheet

    screen_text = dict(ticks.screen_text) | {
        number: each.screen_text for number, each in found.items() if each.screen_text
    }
    printed = PrintedSheet(
        sheet,
        {e.number for e in sheet.entries if e in ticks},
        tuple(screen_text.items()),
        language=options.language,
    )
    if options.output:
        write_sheet(printed, options.output, print_remark)
    if options.json:
        print_json(_json(sheet, ticks, found))
    elif options.output:
        print(f"{options.output}: {counted(len(sheet.entries), 'value')} to key in, {ticks.done} ticked")
    else:
        print("\n".join(line.rstrip() for line in text_lines(printed)))


def _json(sheet: Sheet, ticks: Ticks, found: dict[str, ReadBack]) -> dict[str, Any]:
    """Return the sheet as ``--json`` prints it."""
    return {
        "title": sheet.title,
        "family": sheet.family,
        "against": sheet.present,
        "same": sheet.same,
        "entries": [
            _entry_json(n, entry, sheet, ticks, found.get(entry.number))
            for n, entry in enumerate(sheet.entries, 1)
        ],
        "left_out": [{"param": each.number, "name": each.name, "why": each.why} for each in sheet.left_out],
        "before": _instructions(sheet.before),
        "after": _instructions(sheet.after),
        "warnings": list(sheet.warnings),
    }


def _instructions(steps: Sequence[Any]) -> list[dict[str, str]]:
    return [{"text": each.text, "page": each.page} for each in steps]


def _entry_json(
    step: int, entry: SheetEntry, sheet: Sheet, ticks: Ticks, read: ReadBack | None
) -> dict[str, Any]:
    """Return one entry as ``--json`` lists it, with what was read back where something was."""
    stage = sheet.stages[entry.stage]
    return {
        "step": step,
        "param": entry.number,
        "id": entry.address[0],
        "instance": entry.address[1],
        "name": entry.name,
        "old": entry.old or None,
        "new": entry.new,
        "unit": entry.unit,
        "meaning": entry.meaning,
        "page": entry.page,
        "stage": {"title": stage.title, "why": stage.why, "page": stage.page},
        "order": entry.order or None,
        "until": list(entry.until),
        "ticked": entry in ticks,
    } | ({} if read is None else {"read_back": read.screen_text, "state": read.state})
