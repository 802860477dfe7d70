"""The driver and the command line against the real firmware, where it is built (``make peers``).

The firmware keeps a processor busy all the while, so ``make faults`` has the power cuts, and what is put
back.
"""

import random
import threading
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.families.grblhal.content import read_content, write_content
from amp_studio.families.grblhal.driver import GrblDriver
from amp_studio.families.grblhal.line import GrblLine
from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.errors import TransferError
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.opening import connect
from amp_studio.transfer.waiting import Waiting
from tests.campaigns import CAMPAIGN
from tests.families.grblhal.conversation import answers, recorded
from tests.families.grblhal.real_control import FIRMWARE, FIVE_AXES, RealControl, real_control

pytestmark = pytest.mark.skipif(
    not FIRMWARE.exists(), reason="the firmware is not built here: make peers AMP_STUDIO_PEERS=FOLDER"
)


@pytest.fixture
def control(tmp_path: Path) -> Iterator[RealControl]:
    with real_control(tmp_path) as made:
        yield made


def test_what_was_recorded_is_what_the_real_one_answers(control: RealControl) -> None:
    place = parse_endpoint(control.address)
    with closing(GrblLine(lambda look: connect(place, look=look), Waiting())) as line:
        assert answers(line) == recorded()


def changed_at(control: RealControl, path: Path) -> None:
    """Upload a file from a control, and download it again with three settings changed."""
    assert run(["upload", "--from", control.address, "-o", str(path)]) == 0
    assert run(["set", str(path), "$130=301.5", "$22=Enable", "$20=yes"]) == 0
    assert run(["download", str(path), "--to", control.address]) == 0


@pytest.mark.skipif(not CAMPAIGN, reason="make faults; the download to five axes is tried each time")
def test_upload_set_download_and_verify_over_the_command_line(control: RealControl, tmp_path: Path) -> None:
    changed_at(control, tmp_path / "router.amp")
    assert run(["verify", str(tmp_path / "router.amp"), "--with", control.address]) == 0


@pytest.mark.skipif(not CAMPAIGN, reason="make faults")
def test_what_a_download_replaced_is_put_back_over_the_command_line(
    control: RealControl, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "router.amp"
    changed_at(control, path)
    (copy,) = tmp_path.glob("router.before-*.img")
    assert run(["restore", str(copy), "--to", control.address]) == 0
    assert run(["verify", str(path), "--with", control.address]) == 1
    assert "3 differ" in capsys.readouterr().out


@pytest.mark.skipif(not FIVE_AXES.exists(), reason="the firmware for five axes is not built here: make peers")
def test_a_file_of_three_axes_leaves_the_others_of_five_real_axes_as_they_are(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    narrow = tmp_path / "narrow.amp"
    assert run(["new", "grblhal", str(narrow), "--axes", "X,Y,Z"]) == 0
    assert run(["set", str(narrow), "$3=1", "$5=2"]) == 0
    with real_control(tmp_path, FIVE_AXES) as five:
        _ask(five, "$3=24", "$4=31", "$5=31")
        capsys.readouterr()
        assert run(["download", str(narrow), "--to", five.address]) == 0
        assert "as the control has it: A, B in $2, $3, $4, $5" in capsys.readouterr().out
        assert _settings(five, 3, 5) == ["25", "26"]


@pytest.mark.skipif(
    not (CAMPAIGN and FIVE_AXES.exists()), reason="make faults, with the firmware for five axes"
)
def test_a_file_of_three_axes_and_a_copy_of_five_go_to_five_real_axes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "3").mkdir()
    (tmp_path / "5").mkdir()
    narrow, wide = tmp_path / "3" / "narrow.amp", tmp_path / "5" / "wide.amp"
    with real_control(tmp_path / "3") as three:
        assert run(["upload", "--from", three.address, "-o", str(narrow)]) == 0
        assert run(["set", str(narrow), "$3=1", "$5=2"]) == 0
    with real_control(tmp_path / "5", FIVE_AXES) as five:
        assert run(["upload", "--from", five.address, "-o", str(wide)]) == 0
        assert run(["set", str(wide), "$3=24", "$4=31", "$5=31", "$376=3"]) == 0
        assert run(["download", str(wide), "--to", five.address]) == 0
        capsys.readouterr()
        assert run(["download", str(narrow), "--to", five.address]) == 0
        assert "as the control has it: A, B in $2, $3, $4, $5" in capsys.readouterr().out
        assert _settings(five, 3, 4, 5, 376) == ["25", "31", "26", "3"]
        assert run(["verify", str(narrow), "--with", five.address]) == 0
        assert "not compared: A, B in $2, $3, $4, $5" in capsys.readouterr().out
        (copy,) = (tmp_path / "3").glob("narrow.before-*.img")
        assert run(["restore", str(copy), "--to", five.address]) == 0
        assert _settings(five, 3, 4, 5, 376) == ["24", "31", "31", "3"]


def _settings(control: RealControl, *numbers: int) -> list[str]:
    """Return what a control shows of these settings, over a separate line."""
    displayed = dict(text.split("=") for text in _ask(control, "$$"))
    return [displayed[f"${number}"] for number in numbers]


def _ask(control: RealControl, *commands: str) -> list[str]:
    """Send commands over a separate line; return what the last one is answered with."""
    place = parse_endpoint(control.address)
    with closing(GrblLine(lambda look: connect(place, look=look), Waiting())) as line:
        return [line.ask(command) for command in commands][-1]


@pytest.mark.skipif(
    not (CAMPAIGN and FIVE_AXES.exists()), reason="make faults, with the firmware for five axes"
)
def test_a_file_and_a_copy_of_five_real_axes_go_to_three(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "3").mkdir()
    (tmp_path / "5").mkdir()
    wide = tmp_path / "5" / "wide.amp"
    with real_control(tmp_path / "5", FIVE_AXES) as five:
        assert run(["upload", "--from", five.address, "-o", str(wide)]) == 0
        assert run(["set", str(wide), "$3=24", "$4=31", "$5=31", "$376=3"]) == 0
        assert run(["download", str(wide), "--to", five.address]) == 0
        assert run(["upload", "--from", five.address, "-o", str(tmp_path / "copy.img")]) == 0
    with real_control(tmp_path / "3") as three:
        capsys.readouterr()
        assert run(["download", str(wide), "--to", three.address]) == 0
        assert "bits of axes that the control does not have (A, B in $3, $4, $5" in capsys.readouterr().out
        assert _settings(three, 3, 4, 5) == ["0", "7", "7"]
        assert run(["restore", str(tmp_path / "copy.img"), "--to", three.address]) == 0
        assert run(["verify", str(wide), "--with", three.address]) == 1


@pytest.mark.parametrize("seed", range(3 if CAMPAIGN else 0))
def test_power_cut_in_a_download_leaves_old_new_some_of_both_or_defaults_and_shows_which(
    seed: int, tmp_path: Path
) -> None:
    assert power_cut(seed, tmp_path) == []


def power_cut(seed: int, folder: Path) -> list[str]:
    """Kill the real firmware somewhere in a download, start it again,
    and compare what was reported with what it shows.
    """
    chance = random.Random(seed)
    with (
        real_control(folder) as control,
        closing(GrblDriver(lambda look: connect(parse_endpoint(control.address), look=look))) as driver,
    ):
        current = driver.fetch()
        present = read_content(current)
        own = replace(
            present,
            settings={
                **present.settings,
                30: "24000.000",
                131: "333.000",
                1: "50",
                121: "33.000",
                27: "2.000",
            },
        )
        download(driver, WantedContent(write_content(own), ""), lambda _: "first")
        changes = {
            n: f"{chance.randint(10, 90)}.000"
            for n in chance.sample([100, 101, 102, 110, 111, 112, 120, 130], 6)
        }
        changes |= {n: f"{text}00" for n, text in changes.items() if n < 103}
        wanted = replace(own, settings={**own.settings, **changes})
        cut_at, kept = chance.randint(1, 6), []

        def pull(stage: str, done: int, total: int) -> None:
            if (stage, done) == ("download", cut_at):
                control.kill()
                threading.Timer(0.3, control.start).start()

        reported, new = "", ()
        try:
            reported = download(
                driver,
                WantedContent(write_content(wanted), ""),
                lambda old: str(kept.append(old)),
                Exchange(pull),
            ).at_control
        except TransferError as error:
            reported, new = error.at_control, error.new
        driver.close()
        after = read_content(driver.fetch()).settings
        fresh = {n for n in changes if after[n] == wanted.settings[n]}
        truth = {
            "old": after == own.settings,
            "new": after == wanted.settings,
            "defaults": after == present.settings,
            "mixed": (
                {f"${n}" for n in fresh} == set(new)
                and all(after[n] in (own.settings[n], wanted.settings[n]) for n in after)
            ),
            "unknown": True,
        }
        found = (
            []
            if truth[reported]
            else [f"seed {seed}: said {reported} {new}, and new are {sorted(fresh)} of {sorted(changes)}"]
        )
        if kept != [write_content(own)]:
            found.append(f"seed {seed}: the copy is not what the control contained")
        back = partial(driver.refit, kept[0])
        if not download(driver, WantedContent(back, ""), lambda _: "kept").verified:
            found.append(f"seed {seed}: the copy does not go back")
        return found
