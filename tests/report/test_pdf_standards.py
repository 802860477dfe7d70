"""A PDF keeps to PDF/A and PDF/UA, and has the machine with it."""

import json
import re
import zlib
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import ParameterFile, open_file, without_secrets
from amp_studio.files.example_files import examples_folder
from amp_studio.formats import import_file, open_for_reading
from amp_studio.formats.report_pdf import attached_machine
from amp_studio.report import Contents, print_report, results_paper, write_paper
from amp_studio.report.output.typesetter import ends_parted
from tests.campaigns import CAMPAIGN

from .test_pdf import output_of, poppler

MILL = examples_folder() / "mill-1394" / "MILL_1394.amp"
ALL_EXAMPLES = sorted(path.name for path in examples_folder().glob("*/*.amp"))
SHORT = Contents(changed_only=True, without=frozenset({"pictures", "motion", "power-up", "signatures"}))


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("report") / "mill.pdf"
    notes: list[str] = []
    print_report(open_file(MILL).file, path, SHORT, source=MILL, notify=notes.append)
    assert notes == []
    return path


def test_a_report_keeps_to_the_standards_for_archives_and_for_readers_aloud(printed: Path) -> None:
    content = printed.read_bytes()
    assert b"<pdfaid:part>3</pdfaid:part>" in content
    assert b"<pdfaid:conformance>A</pdfaid:conformance>" in content
    assert b"<pdfuaid:part>1</pdfuaid:part>" in content


def test_a_paper_of_tables_keeps_to_them_too(tmp_path: Path) -> None:
    notes: list[str] = []
    paper = results_paper("Results", ("Who", "What"), [("X", "1 mm")])
    write_paper(paper, tmp_path / "results.pdf", notes.append)
    assert notes == []
    assert b"<pdfuaid:part>1</pdfuaid:part>" in (tmp_path / "results.pdf").read_bytes()


def test_a_report_has_its_subject_and_its_keywords_but_not_the_folder_of_its_author(printed: Path) -> None:
    content = printed.read_bytes()
    assert b"Machine parameters by group, Allen-Bradley 9/PC AMP" in content
    assert b"Allen-Bradley 9/PC AMP, MILL_1394, MILL_1394.amp" in content
    assert str(examples_folder()).encode() not in content


def test_opening_a_report_gives_the_machine_back_without_its_secrets(printed: Path) -> None:
    file = open_file(MILL).file
    back = open_for_reading(printed)
    assert back.values == without_secrets(file).values
    assert len(back.values) < len(file.values)


def test_a_report_has_itself_as_data(printed: Path) -> None:
    packed = re.findall(rb"/EmbeddedFile\b.*?stream\r?\n(.*?)endstream", printed.read_bytes(), re.DOTALL)
    documents = [text for text in map(_unpacked, packed) if text[:1] == b"{"]
    assert json.loads(documents[0])["family"]


@poppler
@pytest.mark.parametrize(
    "machine", ALL_EXAMPLES if CAMPAIGN else ["GRBL_ROUTER.amp"]
)  # pdfinfo: 1.7 s, a mill 26 s
def test_who_has_the_pages_read_aloud_hears_every_heading_and_the_heads_of_every_table(
    machine: str, tmp_path: Path
) -> None:
    path = next(examples_folder().glob(f"*/{machine}"))
    print_report(open_file(path).file, tmp_path / "read.pdf", SHORT, source=path)
    lines = output_of("pdfinfo", "-struct-text", tmp_path / "read.pdf").splitlines()
    parts = [(len(line) - len(line.lstrip()), line.strip()) for line in lines if line.strip()]
    heads = [at for at, (_, text) in enumerate(parts) if re.match(r"H[12]\b", text)]
    assert len(heads) >= 9
    assert [at for at in heads if parts[at + 1][0] <= parts[at][0]] == [], "a heading without words"
    tables = [at for at, (_, text) in enumerate(parts) if text.startswith("Table")]
    ends = {
        at: next((n for n in range(at + 1, len(parts)) if parts[n][0] <= parts[at][0]), None) for at in tables
    }
    assert len(tables) > 5
    assert [at for at in tables if not any(t.startswith("TH") for _, t in parts[at : ends[at]])] == []


def _unpacked(packed: bytes) -> bytes:
    return zlib.decompressobj().decompress(packed)


def test_a_script_without_a_font_is_reported_and_printed_all_the_same(
    mill: ParameterFile, tmp_path: Path
) -> None:
    mill.header.name = "\u2d30"  # Tifinagh, for which no font of the system is asked
    notes: list[str] = []
    print_report(mill, tmp_path / "odd.pdf", SHORT, notify=notes.append)
    assert (tmp_path / "odd.pdf").read_bytes().startswith(b"%PDF")
    assert notes == ["The PDF does not keep to PDF/A and PDF/UA: no font here has the character \u2d30"]


def test_the_machine_of_a_report_is_without_its_secrets_and_the_import_names_them(printed: Path) -> None:
    notes: list[str] = []
    file = import_file(printed, notify=notes.append)
    assert notes == ["A report is without secret values: Characters of the Password"]
    missing = set(open_file(MILL).file.values) - set(file.values)
    assert {parameter for parameter, _ in missing} == {"password.character"}


def test_the_machine_of_a_report_has_its_name_and_nothing_of_the_comments(
    printed: Path, tmp_path: Path
) -> None:
    # A comment of the example spells its password out.
    assert b"MILL94" in MILL.read_bytes()
    attached = attached_machine(printed.read_bytes())
    assert attached is not None
    assert b"MILL94" not in attached
    assert run(["import", str(printed), "-o", str(tmp_path / "again.amp")]) == 0
    assert open_file(tmp_path / "again.amp").file.header.name == "MILL_1394"


def _pdf_of(*streams: bytes) -> bytes:
    """Return what is a PDF to who reads its table, as Typst writes it."""
    parts, places = [b"%PDF-1.7\n"], list[int]()
    for number, data in enumerate(streams, 1):
        places.append(len(b"".join(parts)))
        parts.append(
            b"%d 0 obj\n<<\n  /Length %d\n>>\nstream\n%s\nendstream\nendobj\n\n" % (number, len(data), data)
        )
    table = b"xref\n0 %d\n0000000000 65535 f\r\n" % (len(streams) + 1)
    table += b"".join(b"%010d 00000 n\r\n" % place for place in places)
    body = b"".join(parts)
    return body + table + b"trailer\n<</Size 9>>\nstartxref\n%d\n%%%%EOF" % len(body)


def test_data_that_end_in_cr_are_parted_from_the_end_of_their_stream_and_the_table_knows() -> None:
    data = [b"one\r", b"two", b"th\nendstream\nendobjree\r", b"four\n"]
    pdf = ends_parted(_pdf_of(*data))
    at = int(pdf.rpartition(b"startxref\n")[2].split()[0])
    assert pdf[at : at + 5] == b"xref\n"
    places = [int(entry) for entry in re.findall(rb"(\d{10}) 00000 n\r\n", pdf[at:])]
    for number, (place, each) in enumerate(zip(places, data, strict=True), 1):
        found = re.match(rb"%d 0 obj\n<<\n  /Length (\d+)\n>>\nstream\n" % number, pdf[place:])
        assert found is not None
        begin = place + found.end()
        assert pdf[begin : begin + int(found[1])] == each
        end = b"\r\nendstream" if each.endswith(b"\r") else b"\nendstream"
        assert pdf[begin + len(each) :].startswith(end), each


def test_a_pdf_whose_streams_end_otherwise_is_as_the_typesetter_wrote_it(printed: Path) -> None:
    clear = _pdf_of(b"one", b"two\n")
    assert ends_parted(clear) is clear
    assert b"\r\nendstream" not in printed.read_bytes().replace(b"\r\r\nendstream", b"")


@pytest.mark.parametrize(
    "content", [b"%PDF-1.7\n", b"%PDF-1.7\n<</Type /EmbeddedFile>>\nstream\nnothing\nendstream"]
)
def test_a_pdf_without_a_machine_has_none(content: bytes) -> None:
    assert attached_machine(content) is None
