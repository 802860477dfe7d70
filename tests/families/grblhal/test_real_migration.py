"""What `migrate --to grblhal` writes, sent to the real firmware where it is built (``make peers``): each line
is taken, and read back as it was written.
"""

from contextlib import closing
from pathlib import Path

import pytest

from amp_studio.assignments import read_assignments
from amp_studio.families.grblhal.line import GrblLine
from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.meaning import migrate
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.opening import connect
from amp_studio.transfer.waiting import Waiting
from tests.campaigns import CAMPAIGN

from .real_control import FIVE_AXES, real_control

OTHERS = ("num-1060-mill", "syntec-mill", "acromill-router", "lathe-ls176")
MACHINES = ("mill-1394", *(OTHERS if CAMPAIGN else ()))
ANSWERS = {"home.pull_off": "2", "build.backlash": "yes"} | {f"steps.{letter}": "200" for letter in "XYZAB"}
BACKLASH = {"mill-1394": {"1340": "0.012 mm"}, "num-1060-mill": {"P18N0": "7"}}


def settings_of(machine: str) -> list[str]:
    file = open_file(next((examples_folder() / machine).glob("*.amp"))).file
    file.set_checked(read_assignments(file, BACKLASH.get(machine, {}).items()), force="a backlash")
    asked = {question.id for question in migrate(file, "grblhal").written.asked}
    answers = {name: text for name, text in ANSWERS.items() if name in asked}
    (text,) = migrate(file, "grblhal", answers).written.texts.values()
    return [line for line in text.splitlines() if line.startswith("$")]


@pytest.mark.skipif(not FIVE_AXES.exists(), reason="the firmware is not built here: make peers")
@pytest.mark.parametrize("machine", MACHINES)
def test_the_real_firmware_takes_each_line_and_has_it(machine: str, tmp_path: Path) -> None:
    wanted = settings_of(machine)
    if machine in BACKLASH:
        assert any(line.startswith("$160=") for line in wanted)
    with real_control(tmp_path, FIVE_AXES) as control:
        place = parse_endpoint(control.address)
        with closing(GrblLine(lambda look: connect(place, look=look), Waiting())) as line:
            for each in wanted:
                line.ask(each, writes=True)
            answered = dict(each.split("=", 1) for each in line.ask("$$") if each.startswith("$"))
    for each in wanted:
        key, _, value = each.partition("=")
        if key != "$N0":
            assert float(answered[key]) == pytest.approx(float(value), abs=5e-4), each
