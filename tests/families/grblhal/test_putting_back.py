"""What a copy of a Grbl control brings back: settings in their order, offsets, start-up lines;
also on another build.
"""

from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from amp_studio.families.grblhal.content import read_content, write_content
from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.errors import ConnectionCutError, TransferError
from amp_studio.transfer.image import ImageError
from tests.families.grblhal.bench import Bench, current, edited, put, sent


def test_disabling_homing_takes_soft_limits_along_and_the_copy_brings_them_back(bench: Bench) -> None:
    put(bench, {22: "1", 20: "1", 40: "1"})
    copy = bench.driver.fetch()
    assert put(bench, {22: "0", 20: "0", 40: "0", 676: "15"}).verified
    assert [current(bench).settings[n] for n in (20, 22, 40)] == ["0", "0", "0"]
    outcome = download(
        bench.driver, WantedContent(partial(bench.driver.refit, copy), "", what="Restore"), lambda _: "kept"
    )
    assert outcome.verified
    assert bench.driver.fetch() == copy


def test_rates_of_each_axis_come_and_go_with_an_option(bench: Bench) -> None:
    before = bench.driver.fetch()
    common = read_content(before).settings[24]
    with_rates = edited(bench, n22=513.0)
    assert download(
        bench.driver, WantedContent(partial(bench.driver.encode, with_rates), ""), lambda _: "kept"
    ).verified
    now = current(bench).settings
    assert [now[180], now[181], now[182]] == [common] * 3, "each axis has the rate that was there for all"
    assert not {24, 25} & now.keys(), "they are hidden, and not sent"
    assert not bench.driver.left_out(with_rates, bench.driver.fetch())
    own = edited(bench, n181=31.0)
    assert download(
        bench.driver, WantedContent(partial(bench.driver.encode, own), ""), lambda _: "kept"
    ).verified
    assert current(bench).settings[181] == "31.0"
    assert download(
        bench.driver, WantedContent(partial(bench.driver.refit, before), ""), lambda _: "kept"
    ).verified
    assert bench.driver.fetch() == before


def test_offsets_and_harmless_start_up_lines_are_put_back_and_the_rest_is_reported(bench: Bench) -> None:
    bench.firmware.offsets |= {"G54": "1.500,-2.250,3.000", "G28": "5.000,0.000,0.000"}
    bench.firmware.startup.update({0: "G21G54", 1: "M3S100"})
    copy = bench.driver.fetch()
    bench.firmware.offsets |= {"G54": "0.000,0.000,0.000", "G28": "0.000,0.000,0.000"}
    bench.firmware.startup.update({0: "", 1: ""})
    outcome = download(
        bench.driver, WantedContent(partial(bench.driver.refit, copy), "", what="Restore"), lambda _: "kept"
    )
    assert sent(bench) == ["$N0=G21G54"]
    assert "G21G10L2P1X1.5Y-2.25Z3" in bench.lines
    assert (bench.firmware.offsets["G54"], bench.firmware.startup) == (
        "1.500,-2.250,3.000",
        {0: "G21G54", 1: ""},
    )
    assert "G28 was 5.000,0.000,0.000 and is 0.000,0.000,0.000: it is not put back" in outcome.text
    assert "The start-up line $N1=M3S100 is not put back: the control would execute it now." in outcome.text


def test_a_locked_control_takes_no_offsets_and_nothing_else_of_the_copy_is_sent(bench: Bench) -> None:
    present = current(bench)
    wanted = replace(
        present,
        settings={**present.settings, 130: "5.000"},
        offsets={**present.offsets, "G54": "1.000,0.000,0.000"},
    )
    bench.firmware.operate("alarm 1")
    with pytest.raises(
        TransferError, match=r"the control is locked, and takes no offsets .*; nothing was replaced"
    ):
        download(bench.driver, WantedContent(write_content(wanted), ""), lambda _: "kept")
    assert sent(bench) == []


def test_offsets_that_are_shown_in_inches_are_put_back_in_inches(bench: Bench) -> None:
    bench.firmware.settings.store(13, "1")
    bench.firmware.offsets["G55"] = "25.400,0.000,-50.800"
    copy = bench.driver.fetch()
    bench.firmware.offsets["G55"] = "0.000,0.000,0.000"
    assert download(
        bench.driver, WantedContent(partial(bench.driver.refit, copy), ""), lambda _: "kept"
    ).verified
    assert bench.firmware.offsets["G55"] == "25.400,0.000,-50.800"
    assert bench.lines[-30:].count("G21") == 1, "the unit of the program is as it was"
    assert not any("G20" in line for line in bench.lines), "nor was it another one meanwhile"


@pytest.mark.parametrize("was", ["0", "1"])
def test_offsets_stay_where_the_unit_of_reports_changes(bench: Bench, was: str) -> None:
    """They were sent again: 10 mm as 10 inches."""
    bench.firmware.settings.store(13, was)
    bench.firmware.offsets["G54"] = "10.000,-20.401,0.500"
    file = edited(bench, n13="No" if was == "1" else "Yes", n130=301.5)
    outcome = download(bench.driver, WantedContent(partial(bench.driver.encode, file), ""), lambda _: "kept")
    assert outcome.verified
    assert not any("G10" in line for line in bench.lines)
    assert bench.firmware.offsets["G54"] == "10.000,-20.401,0.500"


@pytest.mark.parametrize("is_cut_before", ["$130=", "$13="])
def test_a_break_while_the_unit_of_reports_changes_is_no_loss_of_the_memory(
    bench: Bench, is_cut_before: str
) -> None:
    """Nine offsets that are shown with other digits were settings that nobody has touched."""
    bench.firmware.offsets["G54"] = "10.000,-20.401,0.500"
    bench.firmware.is_writing = True
    bench.firmware.answer()
    file = edited(bench, n13="Yes", n130=301.5)

    def restart(data: bytes) -> bytes:
        if is_cut_before.encode() not in data:
            return data
        bench.spoil_in = lambda data: data
        bench.firmware.answer()
        bench.firmware.power_cycle()
        return b""

    bench.spoil_in = restart
    with pytest.raises(ConnectionCutError) as caught:
        download(bench.driver, WantedContent(partial(bench.driver.encode, file), ""), lambda _: "kept")
    is_half = is_cut_before == "$130="
    assert caught.value.at_control == ("mixed" if is_half else "old")
    assert caught.value.new == (("$13",) if is_half else ())


def test_a_copy_without_some_offsets_leaves_them_where_it_shows_another_unit(tmp_path: Path) -> None:
    """A Grbl 1.1 has no G59.1 to G59.3: those of the control were sent in the unit of the copy."""
    classic, hal = Bench(tmp_path / "classic", "grbl-1.1"), Bench(tmp_path / "hal")
    classic.firmware.settings.store(13, "1")
    hal.firmware.offsets["G59.2"] = "10.000,20.000,30.000"
    back = partial(hal.driver.refit, classic.driver.fetch())
    assert download(hal.driver, WantedContent(back, ""), lambda _: "kept").verified
    assert hal.firmware.offsets["G59.2"] == "10.000,20.000,30.000"


@pytest.mark.parametrize(
    "line",
    [
        "M3S100",
        "G0X10",
        "G28",
        "$H",
        "G1F100X1",
        "M8",
        "T1M6",
        "G10L2P1X0",
        "G92X0",
        "G53G0Z0",
        "G4P1",
        "M62P1",
        "G38.2Z-5F10",
        "(G21)",
        "#1=2",
        "G2 0X1",
        "M30",
        "S1000",
    ],
)
def test_a_start_up_line_that_does_anything_is_not_sent(bench: Bench, line: str) -> None:
    present = current(bench)
    outcome = download(
        bench.driver,
        WantedContent(write_content(replace(present, startup={0: line, 1: ""})), ""),
        lambda _: "kept",
    )
    assert sent(bench) == []
    assert f"$N0={line} is not put back" in outcome.text


def test_a_copy_of_another_build_goes_back_by_the_numbers_or_shows_what_is_not_there(tmp_path: Path) -> None:
    three, four = Bench(tmp_path / "3"), Bench(tmp_path / "4", axes="XYZA")
    three.firmware.settings.store(130, "300")
    three.firmware.offsets["G54"] = "1.000,2.000,3.000"
    four.firmware.offsets["G54"] = "0.000,0.000,0.000,45.000"
    copy = three.driver.fetch()
    assert download(
        four.driver, WantedContent(partial(four.driver.refit, copy), ""), lambda _: "kept"
    ).verified
    assert current(four).settings[130] == "300.000"
    assert current(four).axes == ("X", "Y", "Z", "A")
    assert current(four).offsets["G54"] == "1.000,2.000,3.000,45.000"
    four.firmware.settings.store(131, "250")
    back = four.driver.fetch()
    assert download(
        three.driver, WantedContent(partial(three.driver.refit, back), ""), lambda _: "kept"
    ).verified
    assert current(three).settings[131] == "250.000"
    assert 103 not in current(three).settings


def test_a_copy_in_inches_is_not_put_on_other_axes_in_millimeters(tmp_path: Path) -> None:
    three, four = Bench(tmp_path / "3"), Bench(tmp_path / "4", axes="XYZA")
    three.firmware.settings.store(13, "1")
    with pytest.raises(ImageError, match=r"set \$13 alike first"):
        download(
            four.driver, WantedContent(partial(four.driver.refit, three.driver.fetch()), ""), lambda _: "kept"
        )


def test_a_file_of_another_build_is_mapped_by_number_and_shows_what_is_not_there(tmp_path: Path) -> None:
    three, four = Bench(tmp_path / "3"), Bench(tmp_path / "4", axes="XYZA")
    file = edited(three, n130=300.0)
    assert download(
        four.driver, WantedContent(partial(four.driver.encode, file), ""), lambda _: "kept"
    ).verified
    assert current(four).settings[130] == "300.000"
    wide = edited(four, n131=250.0)
    present = three.driver.fetch()
    assert three.driver.left_out(wide, present).startswith(
        "the control does not have $47, $103, $113, $123, $133"
    )
    assert download(
        three.driver, WantedContent(partial(three.driver.encode, wide), ""), lambda _: "kept"
    ).verified
    assert current(three).settings[131] == "250.000"
    assert 103 not in current(three).settings
