"""Templates of a project: what they may change, what they may not do, and what becomes of their mistakes."""

import re
import shutil
import subprocess
import sys
from importlib.util import cache_from_source
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.files.storage import save_file
from amp_studio.report import Contents, print_report
from amp_studio.report.apart import made
from amp_studio.report.build import build_report
from amp_studio.report.output.page import render_html
from amp_studio.report.templating import templates as templating
from amp_studio.report.templating.folder_copy import copied_template
from amp_studio.report.templating.templates import TEMPLATES
from amp_studio.report.write import FORMATS
from tests.campaigns import CAMPAIGN

SHORT = Contents(changed_only=True, without=frozenset({"pictures", "signatures"}))
EXTENDS_PAGE = '{% extends "standard/report.html.j2" %}\n'
EXTENDS_PDF = '{% extends "standard/report.typ.j2" %}\n'


@pytest.fixture
def mill(small_mill: ParameterFile) -> ParameterFile:
    return small_mill.copy()


@pytest.fixture
def machine(tmp_path: Path, mill: ParameterFile) -> Path:
    save_file(mill, tmp_path / "mill.amp")
    (tmp_path / "templates").mkdir()
    return tmp_path / "mill.amp"


@pytest.fixture(autouse=True)
def in_this_process(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make reports in this process, which takes less time; tests of the process apart are named so."""
    if "apart" not in request.node.name:
        monkeypatch.setattr("amp_studio.report.write.made_apart", made)


def printed(machine: Path, mill: ParameterFile, ending: str, template: str) -> tuple[bytes, list[str]]:
    """Return the report by a template of the project, and what was noted."""
    name = {"html": "report.html.j2", "pdf": "report.typ.j2"}[ending]
    (machine.parent / "templates" / name).write_text(template, "utf-8")
    notes: list[str] = []
    out = machine.parent / f"out.{ending}"
    print_report(mill, out, SHORT, source=machine, notify=notes.append)
    return out.read_bytes(), notes


def text_of(pdf: bytes, folder: Path) -> str:
    (folder / "t.pdf").write_bytes(pdf)
    return subprocess.run(
        ["pdftotext", folder / "t.pdf", "-"], capture_output=True, text=True, check=True
    ).stdout


def test_a_block_of_the_page_is_replaced_and_the_rest_stays(machine: Path, mill: ParameterFile) -> None:
    page, notes = printed(
        machine,
        mill,
        "html",
        EXTENDS_PAGE + "{% block chapters %}<h2>Service: {{ report.title }}</h2>{% endblock %}",
    )
    assert notes == []
    assert b"<h2>Service: Mill 7</h2>" in page
    assert b"Home Calibration" in page


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="needs poppler's tools")
def test_logo_colours_header_and_a_chapter_of_a_pdf(machine: Path, mill: ParameterFile) -> None:
    (machine.parent / "templates" / "logo.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><circle cx="5" cy="5" r="5"/></svg>'
    )
    template = (
        EXTENDS_PDF
        + '{% block logo %}#image("logo.svg", width: 20mm, alt: "Works"){% endblock %}\n'
        + '{% block colours %}#let accent = rgb("#006633"){% endblock %}\n'
        + "{% block header %}Works department #h(1fr) #{{ report.title }}{% endblock %}\n"
        + "{% block chapters %}\n= Service\nCall #{{ report.title }}.\n{% endblock %}\n"
    )
    pdf, notes = printed(machine, mill, "pdf", template)
    text = text_of(pdf, machine.parent)
    assert notes == []
    assert "Works department" in text
    assert "Call Mill 7." in text
    assert "Home Calibration" in text


@pytest.mark.parametrize("apart", [False, True], ids=["here", "apart"])
@pytest.mark.parametrize(
    ("ending", "template"),
    [
        ("html", EXTENDS_PAGE + '{% block chapters %}{% include "note.txt" %}{% endblock %}'),
        ("pdf", EXTENDS_PDF + '{% block chapters %}\n#read("note.txt")\n{% endblock %}'),
        ("pdf", EXTENDS_PDF + '{% block chapters %}\n#read("inside/note.txt")\n{% endblock %}'),
    ],
)
def test_a_link_beside_a_template_is_not_followed(
    machine: Path,
    mill: ParameterFile,
    ending: str,
    template: str,
    apart: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if apart:
        monkeypatch.undo()
    secret = machine.parent / "private"
    secret.mkdir()
    (secret / "note.txt").write_text("a secret of the user")
    (machine.parent / "templates" / "note.txt").symlink_to(secret / "note.txt")
    (machine.parent / "templates" / "inside").symlink_to(secret, target_is_directory=True)
    if not CAMPAIGN:
        monkeypatch.setitem(FORMATS, ".pdf", lambda report: b"")
    report, (note,) = printed(machine, mill, ending, template)
    assert b"a secret of the user" not in report
    assert "links are not followed: inside, note.txt" in note
    assert "/private" not in note
    assert "amp-studio-templates" not in note


@pytest.mark.parametrize("name", ["note.txt", "report.html.j2"])
def test_nor_is_a_file_that_has_a_second_name_elsewhere(
    machine: Path, mill: ParameterFile, name: str
) -> None:
    secret, templates = machine.parent / "private.txt", machine.parent / "templates"
    secret.write_text("a secret of the user")
    (templates / "report.html.j2").write_text(
        EXTENDS_PAGE + '{% block chapters %}{% include "note.txt" %}{% endblock %}'
    )
    (templates / name).unlink(missing_ok=True)
    (templates / name).hardlink_to(secret)
    notes: list[str] = []
    print_report(mill, machine.parent / "out.html", SHORT, source=machine, notify=notes.append)
    assert b"a secret of the user" not in (machine.parent / "out.html").read_bytes()
    assert "links are not followed" in notes[0]


@pytest.mark.parametrize("what", ["file", "folder"])
def test_a_template_that_is_a_link_is_refused(machine: Path, mill: ParameterFile, what: str) -> None:
    elsewhere = machine.parent / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "report.html.j2").write_text("a secret of the user")
    templates = machine.parent / "templates"
    if what == "file":
        (templates / "report.html.j2").symlink_to(elsewhere / "report.html.j2")
    else:
        templates.rmdir()
        templates.symlink_to(elsewhere, target_is_directory=True)
    notes: list[str] = []
    print_report(mill, machine.parent / "out.html", SHORT, source=machine, notify=notes.append)
    assert b"a secret of the user" not in (machine.parent / "out.html").read_bytes()
    assert "links are not followed" in notes[0]


@pytest.mark.parametrize(
    ("ending", "template", "message"),
    [
        (
            "html",
            EXTENDS_PAGE + "{% block chapters %}\n{{ report.titel }}{% endblock %}",
            "line 3: there is no 'titel' in a Report, did you mean 'title'? The",
        ),
        (
            "html",
            EXTENDS_PAGE + "{% block chapters %}{{ reprot.title }}{% endblock %}",
            "there is no 'reprot', did you mean 'report'?",
        ),
        ("html", EXTENDS_PAGE + "\n\n{% block chapters %}", "line 4: "),
        ("html", "{% extends 'standard/nothing.j2' %}", "nothing.j2"),
        ("html", EXTENDS_PAGE + "{% block chapters %}{{ 1 / 0 }}{% endblock %}", "line 2: division by zero"),
        ("html", EXTENDS_PAGE + "{% block chapters %}{{ ''.__class__.__mro__ }}{% endblock %}", "unsafe"),
        (
            "html",
            EXTENDS_PAGE + "{% block chapters %}{{ cycler.__init__.__globals__ }}{% endblock %}",
            "unsafe",
        ),
        ("html", "{% include '../../../../etc/passwd' %}", "passwd"),
        ("html", "{% for a in range(1000000000) %}x{% endfor %}", "too big"),
        (
            "html",
            EXTENDS_PAGE + "{% block chapters %}\n{{ 'x' * 10**11 }}{% endblock %}",
            "line 3: '*' makes too much",
        ),
        ("html", "{{ '%9999999999d' % 1 }}", "'%' makes too much"),
        ("html", "{{ 'x'|center(9999999999) }}", "a filter makes too much"),
        ("html", "{{ '{:>99999999999999}'.format(1) }}", "line 1: needs too much memory"),
        ("html", "{{ '\\ud800' }}", "half a character"),
        ("html", "{% for each in range(1000000000) %}x{% endfor %}", "(100000). The standard"),
        ("html", EXTENDS_PAGE + "{% block chapter %}x{% endblock %}", "line 2: there is no block 'chapter'"),
        ("html", "{{ cycler() }}", "at least one item"),
        ("html", "{{ 'x'|truncate(-5) }}", "expected length"),
        ("html", "{{ " + "x" * 9_000 + " }}", "xxx…"),
        ("html", "x" * 300_000, "larger than 256 KB"),
        ("pdf", EXTENDS_PDF + "{% block chapters %}#let{% endblock %}", "Typst: "),
        ("pdf", EXTENDS_PDF + '{% block logo %}#image("../mill.amp"){% endblock %}', "Typst: "),
        ("pdf", EXTENDS_PDF + '{% block logo %}#read("/etc/passwd"){% endblock %}', "Typst: "),
        ("pdf", EXTENDS_PDF + '{% block logo %}#import "@preview/tablex:0.0.8": *{% endblock %}', "network"),
        ("pdf", EXTENDS_PDF + "{% block logo %}#while true {}{% endblock %}", "Typst: "),
    ],
)
def test_a_mistake_is_noted_with_its_line_and_the_standard_report_is_written(
    machine: Path,
    mill: ParameterFile,
    ending: str,
    template: str,
    message: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if "#while" not in template and not CAMPAIGN:  # of one mistake the standard PDF is set, half a second
        monkeypatch.setitem(FORMATS, ".pdf", lambda report: bytes(10_001))
    content, (note,) = printed(machine, mill, ending, template)
    assert message in note
    assert note.startswith(str(machine.parent / "templates"))
    assert note.count(f"report.{'typ' if ending == 'pdf' else 'html'}.j2: ") == 1, note
    assert note.endswith("The standard report was written")
    assert ".. The standard" not in note, note
    assert len(content) > 10_000


def test_a_text_of_the_file_stays_a_text_in_a_template_too(machine: Path, mill: ParameterFile) -> None:
    mill.header.name = "<script>alert(1)</script> #panic()"
    page, _ = printed(
        machine, mill, "html", EXTENDS_PAGE + "{% block chapters %}<p>{{ report.title }}</p>{% endblock %}"
    )
    assert b"<p>&lt;script&gt;" in page
    pdf, notes = printed(
        machine, mill, "pdf", EXTENDS_PDF + "{% block chapters %}#{{ report.title }}{% endblock %}"
    )
    assert notes == []
    assert pdf.startswith(b"%PDF")


@pytest.mark.parametrize(
    "template",
    [
        (
            "{% set a = range(9999)|list %}{% for b in a %}{% for c in a %}{% for d in a %}{% endfor %}{%"
            " endfor %}{% endfor %}"
        ),
        "{% macro f(n) %}{{ f(n - 1) if n }}{{ f(n - 1) if n }}{% endmacro %}{{ f(60) }}",
    ],
)
def test_a_template_that_works_without_end_and_writes_nothing_is_ended(
    machine: Path, mill: ParameterFile, template: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.report.templating.templates._PATIENCE_S", 0.05)
    _, (note,) = printed(machine, mill, "html", template)
    assert "works without end" in note


def test_every_block_of_the_documentation_is_one_of_a_standard_template() -> None:
    table = (Path(__file__).parents[2] / "docs" / "reports.md").read_text("utf-8").split("| block |")[1]
    reported = set(re.findall(r"`([a-z_]+)`", "\n".join(re.findall(r"^\|(.*?)\|", table, re.MULTILINE))))
    has = {
        ending: set(re.findall(r"{% block (\w+) %}", (TEMPLATES / f"report.{ending}.j2").read_text("utf-8")))
        for ending in ("typ", "html")
    }
    assert reported == has["typ"]
    assert reported - {"contents"} == has["html"]


def test_a_block_that_does_not_exist_is_a_mistake(machine: Path, mill: ParameterFile) -> None:
    content, (note,) = printed(machine, mill, "html", EXTENDS_PAGE + "\n{% block chapter %}x{% endblock %}")
    assert "line 3: there is no block 'chapter'. Known: chapters, checks, colours" in note
    assert b"Home Calibration" in content
    own = "{% block chapters %}{% block mine %}<p>own</p>{% endblock %}{% endblock %}"
    assert printed(machine, mill, "html", EXTENDS_PAGE + own)[1] == [], "a block within a block is printed"


@pytest.mark.parametrize(
    ("part", "message"),
    [
        ("a\nb\n{{ nothing.x }}", "part.html: line 3: there is no 'nothing'"),
        ("a\n{% if %}", "part.html: line 2: Expected an expression"),
        (None, "line 2: there is no template 'part.html' beside it"),
    ],
)
def test_a_mistake_in_an_included_file_has_its_name_and_line(
    machine: Path, mill: ParameterFile, part: str | None, message: str
) -> None:
    if part is not None:
        (machine.parent / "templates" / "part.html").write_text(part)
    template = EXTENDS_PAGE + "{% block chapters %}{% include 'part.html' %}{% endblock %}"
    _, (note,) = printed(machine, mill, "html", template)
    assert message in note


def test_a_template_changes_nothing_of_the_report(machine: Path, mill: ParameterFile) -> None:
    content, (note,) = printed(
        machine, mill, "html", EXTENDS_PAGE + "{% block chapters %}{{ report.help.clear() }}{% endblock %}"
    )
    assert "line 2: " in note
    assert b'{"home.calibration"' in content or b'"home.calibration": [' in content


def test_a_template_of_the_program_is_kept_compiled_and_one_of_a_project_is_not(
    machine: Path, mill: ParameterFile, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It lies beside the program's compiled modules: nowhere else, and nothing of a person is run from
    there.
    """
    kept = tmp_path / "bytecode"
    monkeypatch.setattr(sys, "pycache_prefix", str(kept))
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    folder = Path(cache_from_source(templating.__file__)).parent
    folder.mkdir(parents=True)
    report = build_report(mill, SHORT)
    first = render_html(report)
    names = [path.name for path in folder.iterdir()]
    assert len(names) == 1
    assert render_html(report) == first
    own = machine.parent / "templates" / "report.html.j2"
    own.write_text(EXTENDS_PAGE, "utf-8")
    assert render_html(report, own) == first
    assert [path.name for path in folder.iterdir()] == names
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    (folder / names[0]).unlink()
    assert render_html(report) == first
    assert list(folder.iterdir()) == []


def test_a_template_that_writes_nothing_is_a_mistake(machine: Path, mill: ParameterFile) -> None:
    for ending in ("html", "pdf"):
        content, (note,) = printed(machine, mill, ending, "{# nothing #}\n")
        assert "writes nothing" in note
        assert len(content) > 10_000


def test_a_process_apart_writes_the_report(machine: Path, mill: ParameterFile) -> None:
    template = EXTENDS_PAGE + "{% block chapters %}<h2>Service</h2>{% endblock %}"
    page, notes = printed(machine, mill, "html", template)
    assert notes == []
    assert b"<h2>Service</h2>" in page


def test_apart_a_template_that_takes_all_memory_ends_alone(
    machine: Path, mill: ParameterFile, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("resource")
    monkeypatch.setattr("amp_studio.report.apart._MAX_MEMORY", 800 * 2**20)
    content, (note,) = printed(
        machine, mill, "pdf", EXTENDS_PDF + "{% block chapters %}#range(10000000000).len(){% endblock %}"
    )
    assert "needs too much memory" in note
    assert content.startswith(b"%PDF")


def test_apart_a_template_that_works_without_end_is_ended(
    machine: Path, mill: ParameterFile, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.report.apart._PATIENCE_S", 0.3)
    endless = "#let x = range(9000)\n#for a in x { for b in x { for c in x {} } }"
    content, (note,) = printed(
        machine, mill, "pdf", EXTENDS_PDF + "{% block chapters %}" + endless + "{% endblock %}"
    )
    assert "works without end" in note
    assert content.startswith(b"%PDF")


def test_a_folder_that_may_not_be_looked_into_is_a_mistake_of_the_template_and_ends_no_report(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: Path) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "is_file", refuse)
    monkeypatch.setattr(Path, "iterdir", refuse)
    own = templating.own_template(tmp_path, "report.typ.j2")
    assert own is not None
    with (
        pytest.raises(templating.TemplateMistakeError, match=r"cannot be read: Permission denied"),
        copied_template(own),
    ):
        pass
