"""Where values are on the pages of a report, for the preview; and a template to begin with."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, SaveError, atomic
from amp_studio.files.storage import save_file
from amp_studio.report import Contents, set_report
from amp_studio.report.build import build_report
from amp_studio.report.templating.starting import write_starting_template
from tests.campaigns import CAMPAIGN

SHORT = Contents(changed_only=True, without=frozenset({"pictures", "motion", "exchanges"}))


@pytest.fixture
def mill(small_mill: ParameterFile) -> ParameterFile:
    return small_mill.copy()


@pytest.fixture
def machine(tmp_path: Path, mill: ParameterFile) -> Path:
    save_file(mill, tmp_path / "mill.amp")
    return tmp_path / "mill.amp"


def test_every_printed_value_has_its_place_on_a_page(machine: Path, mill: ParameterFile) -> None:
    found = set_report(mill, SHORT, 24, source=machine)
    places = found.places()
    printed = [(row.id, row.instance) for row in build_report(mill, SHORT).rows()]
    assert len(printed) > 4
    assert set(places) == set(printed)
    pages = [places[address].page for address in printed]
    assert pages == sorted(pages)
    assert pages[-1] < len(found.pages)  # signatures come last
    home = [places["home.calibration", axis] for axis in "12"]
    assert home[0].y == home[1].y
    assert home[0].x < home[1].x


def test_a_template_that_leaves_the_values_out_has_no_places(machine: Path, mill: ParameterFile) -> None:
    own = machine.parent / "templates"
    own.mkdir()
    (own / "report.typ.j2").write_text(
        '{% extends "standard/report.typ.j2" %}\n{% block values %}\n= Nothing\n{% endblock %}\n'
    )
    notes: list[str] = []
    assert set_report(mill, SHORT, 24, source=machine, notify=notes.append).places() == {}
    assert notes == []


@pytest.mark.parametrize(
    ("mistake", "reported"),
    [
        ("#foo(3)", "unknown variable: foo"),
        ('#image("lgo.svg", width: 30mm)', "file not found"),
        ("#let x = {{ report.title }} + wrong", "unknown variable: wrong"),
        ("#strong[never closed", "unclosed delimiter"),
    ][:: 1 if CAMPAIGN else 3],
)
def test_a_mistake_in_typst_has_the_line_of_the_template(
    machine: Path, mill: ParameterFile, mistake: str, reported: str
) -> None:
    own = machine.parent / "templates"
    own.mkdir()
    (own / "report.typ.j2").write_text(
        f'{{% extends "standard/report.typ.j2" %}}\n{{% block chapters %}}\n{mistake}\n= Service\n{{%'
        " endblock %}\n"
    )
    notes: list[str] = []
    found = set_report(mill, SHORT, 24, source=machine, notify=notes.append)
    assert len(found.pages) > 2
    assert f"{own / 'report.typ.j2'}: line 3: Typst: {reported}" in notes[0]
    assert notes[0].endswith("The standard report is used")


def test_a_line_that_is_there_twice_is_not_guessed(machine: Path, mill: ParameterFile) -> None:
    own = machine.parent / "templates"
    own.mkdir()
    (own / "report.typ.j2").write_text(
        '{% extends "standard/report.typ.j2" %}\n{% block chapters %}\n#foo(3)\n\n#foo(3)\n{% endblock %}\n'
    )
    notes: list[str] = []
    set_report(mill, SHORT, 24, source=machine, notify=notes.append)
    assert "report.typ.j2: Typst: unknown variable: foo" in notes[0]


def test_the_template_to_begin_with_is_used_without_a_mistake_and_never_replaces_one(
    machine: Path, mill: ParameterFile
) -> None:
    path = write_starting_template(machine.parent)
    assert path == machine.parent / "templates" / "report.typ.j2"
    notes: list[str] = []
    found = set_report(mill, SHORT, 24, source=machine, notify=notes.append)
    assert notes == []
    assert '#image("logo.svg"' in found.source
    assert "= Service" in found.source
    path.write_text("mine")
    (path.parent / "logo.svg").write_text("mine")
    with pytest.raises(SaveError, match="exists already: it is left as it is"):
        write_starting_template(machine.parent)
    path.unlink()
    write_starting_template(machine.parent)
    assert (path.parent / "logo.svg").read_text() == "mine"


def test_a_folder_that_cannot_be_written_is_a_sentence(
    machine: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was ``[Errno 13] Permission denied``."""

    def refused(_folder: Path, **_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "mkdir", refused)
    with pytest.raises(SaveError, match=r"report\.typ\.j2 cannot be written: Permission denied$"):
        write_starting_template(machine.parent)


def test_a_full_disk_leaves_no_empty_template(machine: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It stayed, refused the next try, and was the template of every report from then on."""

    def full(_handle: int, _content: bytes) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(atomic, "write_all", full)
        with pytest.raises(SaveError, match=r"No space left on device$"):
            write_starting_template(machine.parent)
    assert list((machine.parent / "templates").iterdir()) == []
    assert write_starting_template(machine.parent).stat().st_size > 1000
