"""A saved answer to $$ is read with whatever a sender has around it, and written as the control shows it."""

import json
from pathlib import Path
from typing import Any

import pytest

from amp_studio.cli import run
from amp_studio.families.grblhal.formats.listing import FORMAT
from amp_studio.files import open_file
from amp_studio.formats.text_format import FormatError, ReadOptions, TextRead
from amp_studio.schema import Value, load_schema

from .recorded import LISTING

CLASSIC = """Grbl 1.1h ['$' for help]
ok
$0=10 (Step pulse time, microseconds)
$1=25    (Step idle delay, milliseconds)
$2=0
$3=5 ; direction
$4=0
$5=0
$6=0
$10=1
$11=0.010
$12=0.002
$13=0
$20=0
$21=0
$22=1
$23=3
$24=25.000
$25=500.000
$26=250
$27=1.000
$30=1000.
$31=0.
$32=0
$100=250.000
$101=250.000
$102=250.000
$110=500.000
$111=500.000
$112=500.000
$120=10.000
$121=10.000
$122=10.000
$130=200.000
$131=200.000
$132=200.000
ok
<Idle|MPos:0.000,0.000,0.000|FS:0,0>
"""


def everything(text: str, **options: Any) -> TextRead:
    assert FORMAT.recognises(text)
    return FORMAT.read(text, load_schema("grblhal"), ReadOptions(**options))


def read(text: str) -> dict[tuple[str, str], Value]:
    return everything(text).values


def test_a_listing_comes_back_as_it_was(tmp_path: Path) -> None:
    text, made, again = tmp_path / "backup.txt", tmp_path / "mill.amp", tmp_path / "again.settings"
    text.write_text(f">>> $$\r\n{LISTING}ok\n", "utf-8")
    assert run(["import", str(text), "-o", str(made)]) == 0
    assert open_file(made).file.values[("build.axes", "")] == Value("XYZ")
    assert run(["validate", str(made)]) == 0
    assert run(["export", str(made), "-o", str(again)]) == 0
    assert again.read_text("utf-8") == LISTING


def test_a_listing_of_a_grbl_is_of_that_machine_type(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, made = tmp_path / "old.nc", tmp_path / "old.amp"
    text.write_text(CLASSIC, "utf-8")
    assert run(["import", str(text), "-o", str(made)]) == 0
    capsys.readouterr()
    assert run(["get", str(made), "$22", "$3", "$30", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["values"]
    assert [(row["id"], row["value"]) for row in rows] == [
        ("classic.homing", "Yes"),
        ("stepper.invert_direction", 5),
        ("spindle.max_speed", 1000.0),
    ]


@pytest.mark.parametrize(
    ("before", "after"),
    [("$10=1\n", "$10=511\n"), ("$5=0\n", "$5=7\n"), ("$22=1\n", "$22=17\n"), ("$32=0", "$32=2")],
)
def test_the_machine_type_is_the_one_whose_bounds_all_values_fit(before: str, after: str) -> None:
    changed = CLASSIC.replace(before, after)
    assert changed != CLASSIC
    assert (everything(CLASSIC).machine, everything(changed).machine) == ("grbl-1.1", "grblhal")


def test_missing_lines_do_not_make_another_control_of_it() -> None:
    shorter = "".join(line for n, line in enumerate(CLASSIC.splitlines(True)) if n % 5)
    assert everything(shorter).machine == "grbl-1.1"


def test_the_machine_type_can_be_chosen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text, made = tmp_path / "old.nc", tmp_path / "old.amp"
    text.write_text(CLASSIC, "utf-8")
    assert run(["import", str(text), "-o", str(made), "--machine", "grblhal"]) == 0
    assert open_file(made).file.machine == "grblhal"
    assert "machine type" not in capsys.readouterr().err
    assert run(["import", str(text), "-o", str(tmp_path / "x.amp"), "--machine", "mill"]) == 2
    assert "Unknown machine type 'mill'" in capsys.readouterr().err


def test_start_up_lines_are_kept_as_text_with_a_note_and_offsets_are_left_out() -> None:
    found = everything("$I\n[VER:1.1f:]\n$#\n[G54:0.000,0.000,0.000]\n$N0=G21 G90\n$N1=\n$110=600\nok\n")
    assert found.values == {("axis.max_rate", "X"): Value(600.0, "mm/min")}
    assert found.unknown == {"$N0": "G21 G90", "$N1": ""}
    assert "start-up lines are no settings and are kept as text: $N0" in found.notes


def test_the_header_of_a_backup_is_the_identity_of_the_build_and_comes_back(tmp_path: Path) -> None:
    text, made, again = tmp_path / "backup.txt", tmp_path / "mill.amp", tmp_path / "again.settings"
    identity = [
        "[OPT:VNMSL+,999,1024,4,0]",
        "[AXS:4:XYZA]",
        "[BOARD:T41U5XBB]",
        "[PLUGIN:ENCODER v0.01]",
        "[PLUGIN:FANS v0.01]",
    ]
    text.write_text(
        "%\n; grblHAL\n" + "".join(f"; {i}\n" for i in identity) + "$N0=\n; 0 - Step pulse time\n$0=10.0\n"
    )
    assert run(["import", str(text), "-o", str(made)]) == 0
    file = open_file(made).file
    assert (file.machine, file.values["build.axes", ""]) == ("grblhal", Value("XYZA"))
    assert file.header.extra["control"] == identity
    assert run(["export", str(made), "-o", str(again)]) == 0
    assert again.read_text("utf-8").splitlines() == [f"; {i}" for i in identity] + ["$N0=", "$0=10.0"]


def test_a_setting_that_is_inactive_as_the_control_is_set_goes_out_again(tmp_path: Path) -> None:
    text, made, again = tmp_path / "backup.txt", tmp_path / "mill.amp", tmp_path / "again.settings"
    listing = "$22=17\n$24=150.0\n$180=150.0\n$190=4300.0\n"
    text.write_text(listing, "utf-8")
    assert run(["import", str(text), "-o", str(made)]) == 0
    assert run(["export", str(made), "-o", str(again)]) == 0
    assert again.read_text("utf-8") == listing


def test_a_part_of_a_listing_is_read_as_one_of_grblhal() -> None:
    assert read("$22=1\n$110=600\n") == {
        ("homing.cycle", ""): Value(1),
        ("axis.max_rate", "X"): Value(600.0, "mm/min"),
    }


def test_the_steps_report_how_many_axes_there_are() -> None:
    text = "".join(f"${100 + n}=80\n" for n in range(5))
    assert read(text)["build.axes", ""] == Value("XYZAB")
    assert read(text + "$376=1\n")["axis.steps", "A"] == Value(80.0, "steps/deg")
    assert read(text + "$376=1\n")["axis.steps", "B"] == Value(80.0, "steps/mm")


def test_what_is_not_known_is_kept_with_one_note_for_all() -> None:
    found = everything("$0=5\n$9990=a b\n$9991=7\n")
    assert found.unknown == {"$9990": "a b", "$9991": "7"}
    assert [note for note in found.notes if "$9990" in note] == [
        "2 of 3 settings are not known without the control and kept as text: $9990, $9991"
    ]


def test_every_text_that_is_no_value_is_named_at_once_and_can_be_kept() -> None:
    text = "$0=1e-05\n$1=25\n$22=1.5\n$100=\n"
    with pytest.raises(FormatError) as error:
        everything(text)
    assert (
        str(error.value)
        == "line 1, column 1: $0: '1e-05' is not a number; so are $22 (line 3), $100 (line 4). "
        "What is no value can be kept as an unknown setting"
    )
    assert everything(text, keep_unknown=True).unknown == {"$0": "1e-05", "$22": "1.5", "$100": ""}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("$0=1e-05\n", r"line 1, column 1: \$0: '1e-05' is not a number"),
        ("$0=\n", r"\$0: '' is not a number"),
        ("$22=1.5\n", r"\$22: Homing cycle takes whole numbers, not 1.5"),
        ("$0=" + "9" * 400 + "\n", "is not a number"),
        ("$0=nan\n", "is not a number"),
        ("$0=0x05\n", "is not a number"),
    ],
)
def test_what_cannot_be_understood_is_refused_with_its_line(text: str, message: str) -> None:
    with pytest.raises(FormatError, match=message):
        read(text)


FOUR = "".join(f"Machine {n}:\n======\n{CLASSIC.replace('$110=500', f'$110={n}00')}\n" for n in (1, 2, 3, 4))


def test_of_several_listings_the_last_is_read_and_another_can_be_chosen(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = tmp_path / "log.txt"
    text.write_text(FOUR, "utf-8")
    for options, rate in (([], 400.0), (["--listing", "2"], 200.0)):
        made = tmp_path / f"{rate}.amp"
        assert run(["import", str(text), "-o", str(made), *options]) == 0
        assert open_file(made).file.values["axis.max_rate", "X"] == Value(rate, "mm/min")
    error = capsys.readouterr().err
    assert "the text has 4 listings, and number 4 is read (line 128, 'Machine 4:')" in error
    assert "as none was given. Others: 1 (line 5, 'Machine 1:'), 2 (line 46" in error
    assert run(["import", str(text), "-o", str(tmp_path / "x.amp"), "--listing", "5"]) == 2
    assert "there is no listing 5, the text has 4 listings" in capsys.readouterr().err


def test_the_same_listing_twice_is_one() -> None:
    assert not any("listings" in note for note in everything(CLASSIC * 2).notes)


def test_a_few_settings_that_come_again_are_changes_unless_the_control_refused_them() -> None:
    found = everything(f"{CLASSIC}> $100=80\nok\n> $101=90\nerror:9 (locked)\n")
    assert found.values["axis.steps", "X"] == Value(80.0, "steps/mm")
    assert found.values["axis.steps", "Y"] == Value(250.0, "steps/mm")
    assert any("$100 from 250.000 to 80 (line 39)" in note for note in found.notes)
    assert any("line 41" in note for note in found.notes)


def test_a_sentence_about_a_setting_changes_nothing() -> None:
    found = everything(f"{CLASSIC}Then I set $100=80 and it works.\n")
    assert found.values["axis.steps", "X"] == Value(250.0, "steps/mm")


@pytest.mark.parametrize("text", ["", "G0 X1\n$0=5\n", "hello", "$N0=G21", "$X", "$100 is the first"])
def test_other_texts_are_not_recognised(text: str) -> None:
    assert not FORMAT.recognises(text)


def test_a_choice_out_of_range_and_a_code_are_read_as_they_are() -> None:
    found = read("$32=7\n$20=3\n")
    assert found == {("general.mode", ""): Value("raw:7"), ("limits.soft", ""): Value("raw:3")}


def test_a_figure_smaller_than_what_is_shown_is_written_whole(tmp_path: Path) -> None:
    made, text = tmp_path / "mill.amp", tmp_path / "mill.settings"
    assert run(["new", "grblhal", str(made)]) == 0
    assert run(["set", str(made), "$11=0.0004", "$100=123.4567891"]) == 0
    assert run(["export", str(made), "-o", str(text)]) == 0
    assert "\n$11=0.0004\n" in text.read_text("utf-8")
    assert "\n$100=123.4567891\n" in text.read_text("utf-8")


def test_an_example_behind_sentences_changes_nothing_and_is_named() -> None:
    text = f"{CLASSIC}\nYou can change a value.\n\n\t$33=1\n\t$100=80\n"
    found = everything(f"Before, try this:\n$20=1\n\nMy settings now.\n{text}")
    assert found.values["axis.steps", "X"] == Value(250.0, "steps/mm")
    assert found.values["limits.soft", ""] == Value(False)
    assert found.machine == "grbl-1.1"
    assert any(
        "settings behind sentences change nothing: line" in note and "'$33=1'" in note for note in found.notes
    )


def test_headings_in_between_do_not_end_a_listing() -> None:
    text = CLASSIC.replace("$100=", "Steps per mm:\n$100=").replace("$110=", "Largest rates\n$110=")
    assert everything(text).values == everything(CLASSIC).values


OLD = (40.02, 40.02, 320, 30, 500, 500, 252, 255, 25, 0.05, 0.1, 25, 3, 0, 1, 0, 0, 0, 0, 25, 250, 100, 1)


def test_the_numbers_of_grbl_08_mean_other_settings_and_are_read_by_those_of_today() -> None:
    plain = "".join(f"${n}={value}\n" for n, value in enumerate(OLD))
    whole = plain.replace("$0=40.02", "$0=250 (x, step/mm)").replace("0.05", "1").replace("=0.1\n", "=1\n")
    for text in (plain, whole, f"Grbl 0.8c ['$' for help]\n{plain.replace('.', '')}"):
        found = everything(text)
        assert found.machine == "grbl-0.9"
        assert found.values["classic.pulse_time", ""].value == 30
        assert found.values["axis.steps", "Z"] == Value(320.0, "steps/mm")
        assert found.values["classic.idle_delay", ""].value == 255
        assert ("axis.max_rate", "X") not in found.values
        assert " ".join(key.split()[-1] for key in found.unknown) == "$4 $5 $6 $8 $10 $11 $12 $14 $18"
        assert any("is for a Grbl 0.9 or newer, not for that control" in note for note in found.notes)
    assert everything(f"Old:\n{plain}\nNew:\n{CLASSIC}").machine == "grbl-1.1"
    assert (
        everything("$0=10 (step pulse, usec)\n$1=25\n$11=0.01\n").values["classic.idle_delay", ""].value == 25
    )


def test_a_listing_with_a_few_of_its_remarks_is_read_whole_by_the_numbers_of_its_release() -> None:
    remarks = {5: " (default seek, mm/min)", 8: " (acceleration, mm/sec^2)", 20: " (homing seek, mm/min)"}
    found = everything("".join(f"${n}={value}{remarks.get(n, '')}\n" for n, value in enumerate(OLD)))
    assert found.values["axis.steps", "Z"] == Value(320.0, "steps/mm")
    assert found.values["classic.pulse_time", ""].value == 30
    assert len(found.unknown) == 9, "as without a remark"


def test_the_names_of_a_tinyg_are_no_settings() -> None:
    assert not FORMAT.recognises("$gun=1 ; units mode\n$1ma=0\n$1sa=1.8\n$xvm=16000\n$xfr=16000\n$xtm=220\n")


def test_remarks_of_what_grbl_no_longer_has_show_the_age_of_a_few_lines() -> None:
    text = (
        "$0=25.464 (x, step/mm)\n$1=24.615 (y, step/mm)\n$4=15000.000 (default feed, mm/min)\n"
        "$8=100.000 (acceleration, mm/sec^2)\n"
    )
    found = everything(text)
    assert found.values == {
        ("axis.steps", "X"): Value(25.464, "steps/mm"),
        ("axis.steps", "Y"): Value(24.615, "steps/mm"),
    }
    assert len(found.unknown) == 2


def test_remarks_of_other_settings_beside_today_s_numbers_change_nothing() -> None:
    """A memory in disorder lists a $151 as (x, step/mm), of an owner of a Grbl 0.9."""
    remarks = "".join(f"${n}={n}.000 (x, step/mm)\n" for n in (101, 102, 151, 152))
    found = everything(f"$0=10 (step pulse, usec)\n$1=25\n$100=80.000 (x, step/mm)\n{remarks}")
    assert found.values["axis.steps", "X"] == Value(80.0, "steps/mm")
    assert found.values["axis.steps", "Z"] == Value(102.0, "steps/mm")


def test_a_listing_of_which_only_the_age_shows_is_refused() -> None:
    text = "".join(f"${n}={value}\n" for n, value in enumerate(OLD[:9])) + "$9=0.05\n"
    for keep in (False, True):
        with pytest.raises(FormatError, match=r"line 1, column 1: this is a listing of a Grbl before 0\.9g"):
            everything(text.replace("=30\n", "=30.5\n"), keep_unknown=keep)


EARLY_09 = """$0=250.000 (x, step/mm)
$1=250.000 (y, step/mm)
$2=320.000 (z, step/mm)
$3=500.000 (x max rate, mm/min)
$9=200.000 (x max travel, mm)
$12=10 (step pulse, usec)
$13=250.000 (default feed, mm/min)
$14=192 (step port invert mask, int:11000000)
$15=25 (step idle delay, msec)
$16=0.050 (junction deviation, mm)
$17=0.005 (arc tolerance, mm)
$22=1 (soft limits, bool)
$26=25.000 (homing feed, mm/min)
"""


@pytest.mark.parametrize("keep", [False, True])
def test_the_remarks_of_an_early_grbl_09_decide_whatever_its_numbers_are(keep: bool) -> None:
    found = everything(EARLY_09, keep_unknown=keep)
    assert found.machine == "grbl-0.9"
    got = {address: value.value for address, value in found.values.items()}
    assert got == {
        ("axis.steps", "X"): 250.0,
        ("axis.steps", "Y"): 250.0,
        ("axis.steps", "Z"): 320.0,
        ("axis.max_rate", "X"): 500.0,
        ("axis.max_travel", "X"): 200.0,
        ("classic.pulse_time", ""): 10,
        ("classic.idle_delay", ""): 25,
        ("general.junction_deviation", ""): 0.05,
        ("general.arc_tolerance", ""): 0.005,
        ("limits.soft", ""): True,
        ("homing.locate_rate", ""): 25.0,
        ("build.axes", ""): "XYZ",
    }
    assert list(found.unknown) == ["Grbl 0.9b $13", "Grbl 0.9b $14"]


# -- texts with the signs of a remark ----------------------------------------------------------------------

NETWORK = "".join(
    f"${n}={text}\n"
    for n, text in {
        0: "10",
        1: "25",
        20: "0",
        21: "0",
        22: "1",
        70: "7",
        74: "My;SSID",
        75: "pa(ss)word;#x",
        300: "mill (hall 2) ; left",
        130: "200",
        131: "200",
        132: "60",
        9999: "a(b);c // d",
    }.items()
)


def test_a_text_setting_keeps_the_signs_that_begin_a_remark_elsewhere(tmp_path: Path) -> None:
    found = everything(NETWORK, machine="grblhal")
    assert [
        found.values[key, ""]
        for key in ("wifi.wifi_station_sta_ssid", "wifi.wifi_station_sta_password", "networking.hostname")
    ] == [Value("My;SSID"), Value("pa(ss)word;#x"), Value("mill (hall 2) ; left")]
    assert found.unknown == {"$9999": "a(b);c // d"}
    text, made, again = tmp_path / "backup.txt", tmp_path / "made.amp", tmp_path / "again.settings"
    text.write_text(NETWORK, "utf-8")
    assert run(["import", str(text), "-o", str(made), "--machine", "grblhal"]) == 0
    assert run(["export", str(made), "-o", str(again), "--secrets"]) == 0
    written = again.read_text("utf-8").splitlines()
    for line in NETWORK.splitlines():
        if line.startswith(("$74", "$75", "$300", "$9999")):
            assert line in written


def test_where_figures_have_remarks_one_begins_behind_a_blank_of_a_text() -> None:
    text = NETWORK.replace("$0=10", "$0=10 (step pulse, usec)").replace(
        "$74=My;SSID", "$74=My;SSID (network)"
    )
    found = everything(text, machine="grblhal").values
    assert [
        found[key, ""]
        for key in ("wifi.wifi_station_sta_ssid", "wifi.wifi_station_sta_password", "networking.hostname")
    ] == [Value("My;SSID"), Value("pa(ss)word;#x"), Value("mill")]
    assert found["axis.max_travel", "X"] == Value(200.0, "mm")


def test_a_text_in_quotes_or_before_another_setting_ends_there() -> None:
    for line in ('"$74": "Hall;2",', "$74=Hall;2 $75=x"):
        text = NETWORK.replace("$74=My;SSID\n", f"{line}\n")
        found = everything(text, machine="grblhal").values
        assert found["wifi.wifi_station_sta_ssid", ""] == Value("Hall" if line[0] == '"' else "Hall;2")


def test_a_listing_without_the_spindle_is_no_older_grbl() -> None:
    """The settings of 0.9 and no more, but a $10 that 0.9 does not have as a rule."""
    numbers = [
        *range(7),
        *range(10, 14),
        *range(20, 28),
        *range(100, 103),
        *range(110, 113),
        *range(120, 123),
    ]
    lines = [f"${n}=1" for n in (*numbers, *range(130, 133))]
    schema = load_schema("grblhal")
    assert FORMAT.read("\n".join(lines), schema, ReadOptions()).machine == "grbl-1.1"
    older = "\n".join(lines).replace("$10=1", "$10=3")
    assert FORMAT.read(older, schema, ReadOptions()).machine == "grbl-0.9"
