"""A file in one line: machine, axes and how many findings."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFileError, content_of, new_file
from amp_studio.files.example_files import examples
from amp_studio.guide.summary import summary_of
from amp_studio.schema import Value


@pytest.mark.parametrize(
    ("family", "machine", "axes"),
    [
        ("num", "", ("X", "Y", "Z", "B")),
        ("57c422b", "", ("X", "Y")),
        ("syntec", "Generic controller", ("X", "Y", "Z", "A")),
        ("grblhal", "grblHAL", ("X", "Y", "Z")),
    ],
)
def test_every_family_has_its_machine_and_the_letters_of_its_axes(
    family: str, machine: str, axes: tuple[str, ...]
) -> None:
    (example,) = (e for e in examples() if e.family == family)
    found = summary_of(example.path)
    assert (found.family, found.machine, found.axes) == (family, machine, axes)
    assert found.counts == {}, "an example has no findings"
    assert found.name == example.path.stem


def test_findings_are_counted_with_the_rules_beside_the_file(tmp_path: Path) -> None:
    file = new_file("9pc", "mill", ["X"], "one")
    file.set(("home.calibration", "1"), Value(1e9, "mm"))
    path = tmp_path / "one.amp"
    path.write_bytes(content_of(file))
    errors = summary_of(path).counts["error"]
    (tmp_path / "rules.yaml").write_text(
        "rules:\n  - {id: own.never, title: Never, severity: error, page: '1', reads: {c: control.type},\n"
        "     check: 'false', message: never}\n"
    )
    assert summary_of(path).counts["error"] == errors + 1


def test_a_file_that_is_none_is_refused(tmp_path: Path) -> None:
    (tmp_path / "none.amp").write_text("nothing: [")
    with pytest.raises(ParameterFileError):
        summary_of(tmp_path / "none.amp")
