"""The recorded description and listing are those of the real firmware, where it is built (``make peers``)."""

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.families.grblhal.content import read_content
from amp_studio.families.grblhal.described import schema_of
from amp_studio.families.grblhal.description import description_of
from amp_studio.families.grblhal.driver import GrblDriver
from amp_studio.files import open_file
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.opening import connect
from tests.campaigns import CAMPAIGN
from tests.families.grblhal.real_control import FIRMWARE, RealControl, real_control
from tests.families.grblhal.recorded import LISTING, THREE_AXES

pytestmark = pytest.mark.skipif(
    not FIRMWARE.exists(), reason="the firmware is not built here: make peers AMP_STUDIO_PEERS=FOLDER"
)


@pytest.fixture
def control(tmp_path: Path) -> Iterator[RealControl]:
    with real_control(tmp_path) as made:
        yield made


def test_what_was_recorded_is_what_it_answers(control: RealControl) -> None:
    place = parse_endpoint(control.address)
    with closing(GrblDriver(lambda look: connect(place, look=look))) as driver:
        content = driver.fetch()
    lines = set(description_of(content).splitlines())
    assert set(THREE_AXES.splitlines()) - {b"[NVS STORAGE:*EEPROM]"} <= lines
    others = {line.partition(b":")[0] for line in lines - set(THREE_AXES.splitlines())}
    assert others == {b"[SETTINGDESCR", b"[ALARMCODE", b"[ERRORCODE"}
    displayed = read_content(content).settings
    assert "".join(f"${n}={text}\n" for n, text in sorted(displayed.items())) == LISTING
    assert schema_of(content).signature == schema_of(THREE_AXES).signature


@pytest.mark.skipif(not CAMPAIGN, reason="make faults: the firmware keeps a processor busy for long")
def test_a_new_file_and_one_of_another_build_meet_the_control(
    control: RealControl, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    new, more, back = (tmp_path / f"{name}.amp" for name in ("new", "more", "back"))
    assert run(["new", "grblhal", str(new), "--axes", "X,Y,Z"]) == 0
    assert run(["set", str(new), "$110=600", "$22=Enable", "$20=yes"]) == 0
    assert run(["download", str(new), "--to", control.address]) == 0
    assert run(["new", "grblhal", str(more), "--axes", "X,Y,Z,A"]) == 0
    assert run(["set", str(more), "$110=600", "$22=Enable", "$20=yes"]) == 0
    capsys.readouterr()
    assert run(["download", str(more), "--to", control.address]) == 0
    assert "Not sent: the control does not have $47, $103, $113" in capsys.readouterr().out
    assert run(["upload", "--from", control.address, "-o", str(back)]) == 0
    assert run(["diff", str(new), str(back)]) == 0
    assert (
        open_file(back).file.schema.parameters["homing.cycle"].help.what.startswith("Enables homing cycle.")
    )
