"""A mask by axes keeps, at a control with more axes, the bits of those that a file does not have:
an axis must not turn round.
"""

from functools import partial
from pathlib import Path

import pytest

from amp_studio.families.grblhal.described import schema_of
from amp_studio.families.grblhal.masks import Build, bits_beyond, with_bits
from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.transfer.client.exchange import Outcome, WantedContent, download
from amp_studio.transfer.client.parameters import remarks_of
from amp_studio.transfer.client.verification import verify_content
from amp_studio.transfer.content import decode_content
from tests.families.grblhal.bench import Bench, current
from tests.families.grblhal.recorded import build

MASKS = {3: "24", 4: "31", 5: "31", 45: "24"}


@pytest.fixture
def three(tmp_path: Path) -> Bench:
    return Bench(tmp_path / "3")


@pytest.fixture
def five(tmp_path: Path) -> Bench:
    made = Bench(tmp_path / "5", axes="XYZAB")
    for number, text in MASKS.items():
        made.firmware.settings.store(number, text)
    return made


def file_of(bench: Bench, **values: int) -> ParameterFile:
    """Return the file of a control with other values of some of its masks: ``n3=1`` is $3."""
    file = decode_content(bench.driver.fetch())
    for name, value in values.items():
        file.set(file.find(f"${name[1:]}"), Value(value))
    return file


def sent_to(bench: Bench, file: ParameterFile) -> Outcome:
    return download(bench.driver, WantedContent(partial(bench.driver.encode, file), ""), lambda _: "kept")


def masks(bench: Bench) -> dict[int, str]:
    return {n: current(bench).settings[n] for n in (3, 4, 5, 23, 45) if n in current(bench).settings}


def test_a_file_of_three_axes_leaves_the_bits_of_two_more_axes_as_they_are(three: Bench, five: Bench) -> None:
    file = file_of(three, n3=1, n4=7, n5=0, n45=3)
    before = masks(five)
    assert sent_to(five, file).verified
    assert masks(five) == before | {3: "25", 4: "31", 5: "24", 45: "27"}


def test_the_bits_that_stay_are_named_when_they_are_sent_and_when_they_are_compared(
    three: Bench, five: Bench
) -> None:
    file = file_of(three)
    (remark,) = remarks_of(five.driver, file, five.driver.fetch())
    assert remark.startswith("Not in the file, and as the control has it: A, B in $2, $3, $4, $5")
    sent_to(five, file)
    found = verify_content(file, five.driver.fetch())
    assert found.is_same
    assert "Not in the file, and not compared: A, B in $2, $3" in found.summary()
    of_the_control = decode_content(five.driver.fetch()).values
    assert found.values.same == len(of_the_control.keys() & file.values.keys())
    assert found.not_compared == len(of_the_control.keys() - file.values.keys()) > 0
    assert f"{found.not_compared} values of the control are not set in the file" in found.summary()
    assert "every byte" not in found.summary()


def test_a_file_of_five_axes_goes_to_three_and_the_bits_of_the_others_are_named(
    three: Bench, five: Bench
) -> None:
    file = file_of(five, n3=25)
    present = three.driver.fetch()
    assert sent_to(three, file).verified
    assert masks(three) == {3: "1", 4: "7", 5: "7", 23: "0", 45: "0"}
    left_out = three.driver.left_out(file, present)
    assert "bits of axes that the control does not have (B in $45" not in left_out
    assert "A, B in $3, $4, $5" in left_out


def test_a_copy_of_five_axes_is_put_back_at_three_and_one_of_three_at_five(three: Bench, five: Bench) -> None:
    wide, narrow = five.driver.fetch(), three.driver.fetch()
    before = masks(five)
    assert download(
        five.driver, WantedContent(partial(five.driver.refit, narrow), ""), lambda _: "kept"
    ).verified
    assert masks(five) == before | {5: "24", 45: "27"}
    assert download(
        three.driver, WantedContent(partial(three.driver.refit, wide), ""), lambda _: "kept"
    ).verified
    assert masks(three) == {3: "0", 4: "7", 5: "7", 23: "0", 45: "0"}


def test_a_mask_of_rotary_axes_begins_with_the_fourth_axis() -> None:
    four, five = (Build(schema_of(build(axes)).on("grblhal"), axes) for axes in ("XYZA", "XYZAB"))
    assert bits_beyond(five, four)[376] == {1: "B"}, "bit 0 is of A"
    assert with_bits("0", {1: "B"}, "3") == "2"


def test_the_control_of_the_file_itself_takes_all_bits(five: Bench) -> None:
    file = file_of(five, n3=2)
    assert not five.driver.stays(file, five.driver.fetch())
    assert sent_to(five, file).verified
    assert current(five).settings[3] == "2"
