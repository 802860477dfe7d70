"""Every verb that takes a file takes a control's own text in its place, in each format that a family has."""

import codecs
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.cli.registry import verb_names
from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.formats import export_file, open_for_reading
from amp_studio.formats.import_export import all_formats, formats_of
from tests.campaigns import CAMPAIGN

NOWHERE = "tcp://127.0.0.1:1"
READS = {
    "validate": "RAW",
    "get": "RAW --not-set",
    "diff": "RAW RAW",
    "compare": "RAW RAW",
    "merge": "RAW RAW RAW -o merged.amp",
    "report": "RAW -o report.txt",
    "export": "RAW -o table.csv",
    "import": "RAW -o made.amp",
    "new": "FAMILY like.amp --like RAW",
    "guide": "RAW",
    "find": "RAW axis",
    "block": "RAW",
    "cam": "RAW --axis X",
    "picture": "RAW",
    "machine-tests": "RAW",
    "simulate": "RAW --list",
    "check": "RAW --axis none",
    "program": "end.nc --machine RAW --override none",
    "note": "RAW",
    "axis": "RAW",
    "form": "RAW -o form.csv",
    "sheet": "RAW --against RAW",
    "fix": "RAW --dry-run",
    "calibrate": "RAW --axis X",
    "history": "RAW",
    "migrate": "RAW --to grblhal -o migrated --draft",
    "download": f"RAW --to {NOWHERE} --accept-errors",
    "verify": f"RAW --with {NOWHERE}",
}
"""Verb -> its words. A check or a program in motion takes seconds: it is asked for what there is not."""
WRITES = {
    "set": "RAW A=1",
    "fix": "RAW",
    "axis": "RAW remove X",
    "note": "RAW machine TEXT",
    "guide": "RAW --done 1",
    "calibrate": "RAW --axis X --clear",
}
NO_FILE = {
    "families",
    "schema",
    "show",
    "tables",
    "calculate",
    "emulate",
    "upload",
    "restore",
    "send",
    "receive",
    "identify",
    "status",
    "ports",
    "completion",
    "man",
    "demo",
}
"""Verbs that take none, or a control's content as it is."""
REFUSED = (
    "has no cams that are printed",
    "has no cam: its number of points is 0",
    "no page here prints how its blocks are read",
    "No test program is printed",
    "No axis is fitted",
    "no axis of the file is fitted",
    "Unknown axis",
    "is not set for axis",
    "the soft limits of the axis are not set",
    "neither a calibration table nor a reversal error",
    "the file is one of",
    "--override",
    "is no folder",
    "no connection to the control",
)
"""What is refused of a parameter file of that family too, and at a control that is not there."""


@pytest.fixture(scope="module")
def raw(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Return format -> a text of it, written from an example."""
    folder = tmp_path_factory.mktemp("raw")
    found: dict[str, Path] = {}
    for path in sorted(examples_folder().glob("*/*.amp")):
        file = open_file(path).file
        for each in formats_of(file.schema.family.family):
            if each.key not in found:
                found[each.key] = folder / f"{file.schema.family.family}.{each.key}{each.ending}"
                if each.key == "bsc":  # no example has a table
                    found[each.key].write_text("X0E.00000\nX1E.00025\nX2E-.00010\n", "utf-8")
                else:
                    export_file(file, found[each.key], each.key)
    return found


@pytest.fixture(scope="module")
def texts(raw: dict[str, Path]) -> Iterator[dict[str, Path]]:
    before = {key: path.read_bytes() for key, path in raw.items()}
    yield raw
    assert before == {key: path.read_bytes() for key, path in raw.items()}, "a text is not changed"


def test_every_verb_is_here() -> None:
    assert {*READS, *WRITES, *NO_FILE} == verb_names().keys()


@pytest.mark.parametrize("key", [each.key for each in all_formats()])
def test_every_verb_reads_a_text(
    texts: dict[str, Path],
    key: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("end.nc").write_text("M30\n", "utf-8")
    family = texts[key].name.partition(".")[0]
    # Each verb reads a fifth of the formats, and each format is read by a fifth of the verbs.
    turn = 0 if CAMPAIGN else 1 + [each.key for each in all_formats()].index(key) % 5
    for verb, words in (item for n, item in enumerate(READS.items()) if not turn or n % 5 == turn - 1):
        named = words.replace("RAW", str(texts[key])).replace("FAMILY", family)
        code = cli.run([verb, *named.split()])
        error = capsys.readouterr().err
        assert "Traceback" not in error
        assert code in (0, 1) or any(reason in error for reason in REFUSED), f"{verb} {words}: {error}"


@pytest.mark.parametrize("verb", WRITES)
def test_a_verb_that_writes_needs_a_parameter_file(
    texts: dict[str, Path], verb: str, capsys: pytest.CaptureFixture[str]
) -> None:
    for path in texts.values():
        assert cli.run([verb, *WRITES[verb].replace("RAW", str(path)).split()]) == 2
        error = capsys.readouterr().err
        assert "is a control's own text, which is not changed: import it first" in error


def test_a_report_is_not_called_a_text_of_a_control(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report = tmp_path / "r.pdf"
    report.write_bytes(b"%PDF-1.7\n")
    assert cli.run(["set", str(report), "1300@X=1"]) == 2
    assert "is a report, which is not changed" in capsys.readouterr().err


DISGUISES: dict[str, Callable[[bytes], bytes]] = {
    "16-bit characters": lambda text: text.decode("latin-1").encode("utf-16"),
    "a byte order mark": lambda text: codecs.BOM_UTF8 + text,
    "the end of a DOS text": lambda text: text + b"\x1a",
    "lines of an old Macintosh": lambda text: text.replace(b"\r\n", b"\n").replace(b"\n", b"\r"),
}


@pytest.mark.parametrize("key", [each.key for each in all_formats()])
def test_a_text_is_read_whatever_wrote_it_down(texts: dict[str, Path], key: str, tmp_path: Path) -> None:
    """An editor or a terminal of Windows saved it, under any name: every verb opens it as an import does."""
    plain = texts[key].read_bytes()
    family = texts[key].name.partition(".")[0]
    values = open_for_reading(texts[key], family=family).values
    for n, disguise in enumerate(DISGUISES.values()):
        path = tmp_path / f"copy {n}"
        path.write_bytes(disguise(plain))
        assert open_for_reading(path, family=family).values == values
