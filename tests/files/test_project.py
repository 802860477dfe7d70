"""A project: a folder with the files of one machine."""

from pathlib import Path

import pytest

from amp_studio.files import (
    Document,
    InUseError,
    ParameterFileError,
    Project,
    ProjectInfo,
    backup_path,
    new_file,
    open_file,
)
from amp_studio.files.project import InvalidNameError
from amp_studio.files.storage import save_file
from amp_studio.schema import Value

CALIBRATION = ("home.calibration", "1")


@pytest.fixture
def project(tmp_path: Path) -> Project:
    """Return a new, empty project for a mill."""
    return Project.create(tmp_path / "bench", ProjectInfo("Bench", "9pc", machine="mill"))


@pytest.fixture
def with_file(project: Project) -> Path:
    """Return the one file of a project."""
    path = project.path("first")
    save_file(new_file("9pc", "mill", ["X"], name="first"), path)
    return path


def names(folder: Path) -> set[str]:
    """Return everything that lies in a folder."""
    return {path.name for path in folder.iterdir()}


def save_again(path: Path, number: float) -> None:
    """Save a file with another value, as the program does."""
    with Document.open(path) as document:
        document.file.set(CALIBRATION, Value(number, "mm"))
        document.save()


# -- the project itself --------------------------------------------------------------------------------------


def test_a_project_is_opened_as_it_was_made(project: Project) -> None:
    info = ProjectInfo(
        "Bench",
        "9pc",
        "Mill/Lathe",
        "mill",
        "tcp://10.0.0.2:4000",
        "CNC_1",
        "2.30",
        "Cincinnati",
        "A-17",
        "1996",
        "5 axes",
        "J. Fitter",
        "hall 4\n# no comment",
    )
    project.change(
        **{key: getattr(info, key) for key in vars(info) if key not in ("name", "family", "machine", "extra")}
    )
    assert info == project.info == Project.open(project.folder).info
    assert [] == project.files() == project.backups()


def test_a_folder_that_is_a_project_is_not_made_one_again(project: Project) -> None:
    before = (project.folder / "project.yaml").read_bytes()
    with pytest.raises(InvalidNameError, match="is a project already"):
        Project.create(project.folder, ProjectInfo("Other", "9pc"))
    assert before == (project.folder / "project.yaml").read_bytes()


@pytest.mark.parametrize(
    ("info", "message"),
    [
        (ProjectInfo(" ", "9pc"), "a project needs a name"),
        (ProjectInfo("x", "9pd"), "Unknown family '9pd'. Known: .*9pc"),
        (ProjectInfo("x", "9pc", machine="grinder"), "'grinder' is no machine type: lathe, mill"),
    ],
)
def test_a_project_that_cannot_be_is_not_made(
    tmp_path: Path, project: Project, info: ProjectInfo, message: str
) -> None:
    with pytest.raises(InvalidNameError, match=message):
        Project.create(tmp_path / "other", info)
    assert not (tmp_path / "other").exists()
    with pytest.raises(InvalidNameError, match=message):
        project.change(name=info.name, family=info.family, machine=info.machine)
    assert "Bench" == project.info.name == Project.open(project.folder).info.name


def test_comments_and_unknown_keys_of_a_project_survive(project: Project) -> None:
    path = project.folder / "project.yaml"
    path.write_text("# ours\n" + path.read_text() + "shift: {day: 2, night: 1}   # until May\n")
    again = Project.open(project.folder)
    assert again.info.extra == {"shift": {"day": 2, "night": 1}}
    again.change(notes="new")
    text = path.read_text()
    assert ("# ours" in text, "shift: {day: 2, night: 1}   # until May" in text, "notes: new" in text) == (
        True,
        True,
        True,
    )
    again.change(notes="")
    assert Project.open(project.folder).info.notes == ""


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("", None, "is not an AMP Studio project"),
        ("[1]", None, "is not an AMP Studio project"),
        ("name: x\n", None, "is not an AMP Studio project"),
        ("amp_studio_project: yes it is\n", None, "is not an AMP Studio project"),
        ("amp_studio_project: true\nname: x\nfamily: 9pc\n", None, "is not an AMP Studio project"),
        (
            "amp_studio_project: 2\nname: x\nfamily: 9pc\n",
            None,
            "was written by a newer AMP Studio (project format 2)",
        ),
        ("amp_studio_project: 1\nfamily: 9pc\n", None, "a project needs a name"),
        ("amp_studio_project: 1\nname: x\n", None, "a project needs a control family"),
        (
            "amp_studio_project: 1\nname: x\nfamly: 9pc\n",
            3,
            "'famly': there is no such key, did you mean 'family'?",
        ),
        (
            "amp_studio_project: 1\nnmae: x\nfamily: 9pc\n",
            2,
            "'nmae': there is no such key, did you mean 'name'?",
        ),
        ("amp_studio_project: 1\nname: x\nfamily: fanuc\n", 3, "Unknown family 'fanuc'. Known: "),
        ("amp_studio_project: 1\nname: [x\n", 3, "is not readable: did not find expected"),
        ("amp_studio_project: 1\nname: &x 2001-99-99\n", 2, "is not readable: it uses a YAML reference"),
        ("amp_studio_project: 1\nname: x\nname: y\n", 3, "'name' occurs twice"),
    ],
)
def test_a_project_file_that_is_not_understood_is_refused(
    project: Project, text: str, line: int | None, message: str
) -> None:
    path = project.folder / "project.yaml"
    path.write_text(text)
    with pytest.raises(ParameterFileError) as refused:
        Project.open(project.folder)
    assert (path, line) == (refused.value.path, line and refused.value.line)
    assert message in refused.value.what
    assert text == path.read_text()


def test_a_folder_without_a_project_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterFileError, match=r"project\.yaml: cannot be read: No such file"):
        Project.open(tmp_path)


def test_a_project_whose_save_fails_is_the_old_one(project: Project, disk) -> None:
    before = (project.folder / "project.yaml").read_bytes()
    disk.fail(1, for_ever=True)
    with pytest.raises(OSError, match="cannot be written"):
        project.change(notes="new")
    disk.mend()
    assert (before, {"project.yaml"}) == (
        (project.folder / "project.yaml").read_bytes(),
        names(project.folder),
    )


# -- names


@pytest.mark.parametrize(
    "name", ["first", "X-1", "0815", "Fräse 2", "a.b", "größe_1", "x" * 64, "first.amp", "CONSOLE", "com10"]
)
def test_a_name_that_every_system_can_keep_is_taken(project: Project, name: str) -> None:
    path = project.path(name)
    assert (project.folder, f"{name.removesuffix('.amp')}.amp") == (path.parent, path.name)


@pytest.mark.parametrize(
    "name",
    [
        "",
        " ",
        ".",
        "..",
        "a/b",
        "a\\b",
        "/etc/passwd",
        "../up",
        "a:b",
        "a*b",
        'a"b',
        "a?b",
        "a<b",
        "a|b",
        "a\nb",
        "a\0b",
        ".hidden",
        "_under",
        "-dash",
        "end ",
        "end.",
        "x" * 65,
        "a\tb",
        ".amp",
    ],
)
def test_a_name_that_some_system_cannot_keep_is_refused(project: Project, name: str) -> None:
    with pytest.raises(InvalidNameError, match="is no file name: letters, digits"):
        project.path(name)


@pytest.mark.parametrize(
    "name",
    ["con", "CON", "Aux", "nul", "PRN", "com1", "LPT9", "con.amp", "nul.old", "COM1.a.b", "com¹", "aux .x"],
)
def test_a_name_that_windows_keeps_for_itself_is_refused(project: Project, name: str) -> None:
    with pytest.raises(InvalidNameError, match="is a name that Windows keeps for itself"):
        project.path(name)


def test_a_name_that_differs_in_case_only_is_taken_already(project: Project, with_file: Path) -> None:
    for act in (lambda: project.copy(with_file, "FIRST"), lambda: project.rename(with_file, "First")):
        with pytest.raises(InvalidNameError, match=r"there is a file '(FIRST|First)' already"):
            act()
    assert {"first.amp", "project.yaml"} == names(project.folder)


# -- files


def test_the_files_of_a_project_are_listed_by_name(project: Project, with_file: Path) -> None:
    project.copy(with_file, "another")
    save_again(with_file, 1.0)
    (project.folder / "notes.txt").write_text("no file of ours")
    assert [path.name for path in project.files()] == ["another.amp", "first.amp"]
    assert [with_file] == project.backups()


def test_a_copy_of_what_a_control_contained_is_no_machine(project: Project, with_file: Path) -> None:
    kept = with_file.with_name("first.before-20261130-140500.amp")
    kept.write_bytes(with_file.read_bytes())
    assert [with_file] == project.files()


def test_a_copy_is_the_same_and_has_no_past(project: Project, with_file: Path) -> None:
    save_again(with_file, 1.0)
    copied = project.copy(with_file, "second")
    assert with_file.read_bytes() == copied.read_bytes()
    assert not backup_path(copied).exists()
    assert Document.view(copied).history() == []


def test_a_file_of_another_project_is_copied_too(tmp_path: Path, project: Project, with_file: Path) -> None:
    other = Project.create(tmp_path / "other", ProjectInfo("Other", "9pc"))
    copied = other.copy(with_file, "first")
    assert (with_file.read_bytes(), [copied]) == (copied.read_bytes(), other.files())


def test_what_cannot_be_copied_is_refused_and_leaves_nothing(
    project: Project, with_file: Path, family, tmp_path: Path
) -> None:
    broken = project.folder / "broken.amp"
    broken.write_bytes(with_file.read_bytes()[:99])
    before = names(project.folder)
    with pytest.raises(ParameterFileError):
        project.copy(broken, "second")
    with pytest.raises(ParameterFileError, match="cannot be read"):
        project.copy(project.path("none"), "second")
    with pytest.raises(InvalidNameError, match="there is a file 'broken' already"):
        project.copy(with_file, "broken")
    assert before == names(project.folder)


def test_a_file_of_another_family_is_refused(family, tmp_path: Path) -> None:
    head = """
        family: {0}
        name: Control {0}
        document: d
        title: t
        machines: [{{key: one, name: One}}]
        default_machine: one
        scopes: {{global: {{instances: [""], label: Control}}}}
        units: {{}}
        effect: {{level: reset}}
        groups: [all]
        """
    number = '\n- {id: a.number, name: Number, type: integer, help: {what: A number.}, page: "1"}\n'
    family(head.format("one"), number)
    family(head.format("two"), number)
    path = tmp_path / "one.amp"
    save_file(new_file("one"), path)
    project = Project.create(tmp_path / "project", ProjectInfo("Two", "two"))
    with pytest.raises(InvalidNameError, match=r"one\.amp is for Control one, this project for Control two"):
        project.copy(path, "first")
    assert project.files() == []


def test_a_renamed_file_takes_its_backup_its_history_and_its_unsaved_work_along(
    project: Project, with_file: Path
) -> None:
    save_again(with_file, 1.0)
    with_file.with_name(".first.amp.unsaved").write_text("{}")
    content, backup = with_file.read_bytes(), backup_path(with_file).read_bytes()
    renamed = project.rename(with_file, "second")
    assert (content, backup) == (renamed.read_bytes(), backup_path(renamed).read_bytes())
    assert len(Document.view(renamed).history()) == 1
    companions = {"second.amp", "second.amp.bak", "second.amp.history", ".second.amp.unsaved"}
    assert companions | {"project.yaml"} == names(project.folder)


def test_a_deleted_file_can_be_recovered(project: Project, with_file: Path) -> None:
    save_again(with_file, 1.0)
    content = with_file.read_bytes()
    project.delete(with_file)
    assert ([], [with_file]) == (project.files(), project.backups())
    project.recover(with_file)
    assert (content, [with_file]) == (with_file.read_bytes(), project.files())
    assert len(Document.view(with_file).history()) == 1, "its history waited for it"


def test_recovering_puts_the_previous_file_in_place_and_keeps_the_present_one(
    project: Project, with_file: Path
) -> None:
    save_again(with_file, 1.0)
    project.recover(with_file)
    assert Value(0.0, "mm") == open_file(with_file).file.get(CALIBRATION)
    project.recover(with_file)
    assert Value(1.0, "mm") == open_file(with_file).file.get(CALIBRATION)
    with pytest.raises(FileNotFoundError, match="has no backup"):
        project.recover(project.path("never"))


def test_an_open_file_is_not_renamed_deleted_or_recovered(project: Project, with_file: Path) -> None:
    save_again(with_file, 1.0)
    with Document.open(with_file):
        before = names(project.folder)
        for act in (
            lambda: project.rename(with_file, "x"),
            lambda: project.delete(with_file),
            lambda: project.recover(with_file),
        ):
            with pytest.raises(InUseError, match=r"first\.amp is open in another program"):
                act()
        assert before == names(project.folder)


def test_a_file_that_is_not_there_is_neither_renamed_nor_deleted(project: Project) -> None:
    for act in (
        lambda: project.rename(project.path("none"), "x"),
        lambda: project.delete(project.path("none")),
    ):
        with pytest.raises(FileNotFoundError):
            act()
    assert {"project.yaml"} == names(project.folder)
