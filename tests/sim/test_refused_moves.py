"""A move that the control refuses before it begins has no stop, and sentences call parameters by their
names."""

import ast
from pathlib import Path

import pytest

from amp_studio.families import __path__ as families
from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.sim import check_motion, simulate


@pytest.mark.parametrize(
    ("example", "settings"),
    [
        ("grblhal-router/GRBL_ROUTER", {}),
        ("grblhal-router/GRBL_ROUTER", {"move.start": "-100,-100", "move.to": "-9999,-100"}),
        ("linuxcnc-mill/MILL", {}),
        ("linuxcnc-mill/MILL", {"move.start": "0,0", "move.to": "9999,3"}),
    ],
)
def test_a_refused_move_has_no_stop_position(example: str, settings: dict[str, str]) -> None:
    """grblHAL (machine_limits.c) and LinuxCNC (CM218) check the whole block before it begins."""
    file = open_file(examples_folder() / f"{example}.amp").file
    trace = simulate(file, "travel", "X,Y" if settings else "X", settings or None, advise=False)
    assert "refused" in trace.alarms[0].message
    assert not [name for name in trace.result if name.startswith(("stop", "overrun", "time", "speed"))]
    assert trace.result["limit"][0] is not None


def test_a_refused_move_is_good_in_a_check() -> None:
    file = open_file(examples_folder() / "linuxcnc-mill/MILL.amp").file
    assert {check.verdict for check in check_motion(file) if check.scenario == "travel"} == {"good"}


def test_no_sentence_of_a_family_is_made_with_the_id_of_a_parameter() -> None:
    made = []
    for path in Path(families[0]).rglob("*.py"):
        for text in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(text, ast.JoinedStr):
                filled = [part.value for part in text.values if isinstance(part, ast.FormattedValue)]
                is_id = [each for each in filled if ast.unparse(each).startswith(("ids.", "ids["))]
                made += [f"{path.name}:{text.lineno}" for _ in is_id]
    assert made == []
