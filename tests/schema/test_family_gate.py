"""Only the id of a family that is there is ever looked up, whatever names it."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFileError, Project, ProjectInfo, open_file
from amp_studio.files.project import InvalidNameError
from amp_studio.formats import import_file
from amp_studio.schema import UnknownFamilyError, database_folder, family_ids, load_schema
from amp_studio.schema import load as loading
from amp_studio.schema.load import compile_family

OUTSIDE = [
    "../x",
    "../../etc",
    "/tmp",
    ".",
    "..",
    "",
    "9PC",
    "9pc/",
    "9pc/../9pc",
    "9pc\x00",
    "9pc ",
    "９pc",
    "*",
    "x" * 10_000_000,
    "\x1b[31m",
    "9pc/groups",
    "a\nb",
    "con",
    "9pc.",
    "C:\\x",
    "ﬁ",
    "~",
]


@pytest.fixture
def no_other_file(monkeypatch) -> None:
    """Fail where the facts of a folder are looked for after all."""

    def looked(folder: Path) -> None:
        raise AssertionError(f"{folder} was looked at")

    monkeypatch.setattr(loading, "compile_family", looked)
    monkeypatch.setattr(loading, "cached_record", looked)
    monkeypatch.setattr(loading, "content_key", looked)


@pytest.mark.usefixtures("no_other_file")
@pytest.mark.parametrize("message", OUTSIDE, ids=range(len(OUTSIDE)))
def test_what_is_no_family_id_is_refused_in_one_short_sentence_wherever_it_is(
    tmp_path: Path, message: str
) -> None:
    with pytest.raises(UnknownFamilyError) as error:
        load_schema(message)
    sentence = str(error.value)
    assert sentence.startswith("Unknown family '")
    assert sentence.partition(". Did you mean: ")[0].endswith("'. Known: " + ", ".join(family_ids()))
    assert (len(sentence) < 200, sentence.isprintable()) == (True, True)
    with pytest.raises(InvalidNameError):
        Project.create(tmp_path / "p", ProjectInfo("x", message))
    (tmp_path / "x.csv").write_text("id,value,unit\n")
    if message:
        with pytest.raises(UnknownFamilyError):
            import_file(tmp_path / "x.csv", message, format_key="csv")


@pytest.mark.parametrize("message", ["../x", "[a, b]", "{a: b}", "~", "", "5", "'9pc '", "x" * 1_000_000])
def test_a_file_that_names_none_is_refused_and_touches_nothing(tmp_path: Path, message: str) -> None:
    foreign = tmp_path / "x"
    foreign.mkdir()
    (foreign / "family.yaml").write_bytes((database_folder() / "9pc" / "family.yaml").read_bytes())
    folder = tmp_path / "machines"
    folder.mkdir()
    (folder / "a.amp").write_text(f"amp_studio: 1\nfamily: {message}\nvalues: {{}}\n...\n")
    before = {p: p.read_bytes() if p.is_file() else b"" for p in tmp_path.rglob("*")}
    with pytest.raises(
        ParameterFileError, match=r"a\.amp(, line 2)?: (Unknown family|names no control family)"
    ) as error:
        open_file(folder / "a.amp")
    assert len(str(error.value)) < 500
    assert before == {p: p.read_bytes() if p.is_file() else b"" for p in tmp_path.rglob("*")}


def test_a_folder_of_facts_can_still_be_compiled_by_its_path() -> None:
    assert compile_family(database_folder() / "57c422b").family.family == "57c422b"
