"""`simulate` on files of NUM and Syntec controls, from an empty file to a moving axis."""

import json
from pathlib import Path
from typing import Any

import pytest

from amp_studio.cli import run

EXAMPLE = Path(__file__).parents[3] / "examples" / "num-1060-mill" / "MILL_1060.amp"
NUM_WORDS = (
    "P2N0=1 P3N0=1 P9N0=0x00 P4N2=3 P50N0=5000 P11N0=1 P11N1=2 P30N0=6000 P32N1=1000 P21N0=4915 P22N0=20"
    " P23N0=6600"
)
SYNTEC_VALUES = (
    "Pr61=2500 Pr81=4 Pr201=0 Pr121=1 Pr122=1 Pr161=10000 Pr461=24000 servo.loop_gain@1=30"
    " control.series=super Pr3203=2000 Pr541=100"
)


def settings(words: str) -> list[str]:
    return [part for word in words.split() for part in ("--set", word)]


def new(tmp_path: Path, *family: str) -> str:
    path = str(tmp_path / "new.amp")
    assert run(["new", family[0], path, *family[1:]]) == 0
    return path


def simulated(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, Any]:
    capsys.readouterr()
    assert run(["simulate", *arguments, "--json"]) == 0
    reported: dict[str, Any] = json.loads(capsys.readouterr().out)
    return reported


def test_a_new_num_file_shows_how_an_axis_is_declared(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["simulate", new(tmp_path, "num"), "step"]) == 2
    assert "No axis is servo-controlled. Declare one in P2N0 and P3N0" in capsys.readouterr().err


def test_a_new_num_file_shows_in_one_sentence_what_its_axis_needs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = settings("P2N0=1 P3N0=1 P9N0=0x00 P4N2=3")
    assert run(["simulate", new(tmp_path, "num"), "step", *words]) == 2
    assert (
        "needs values that are not set: P50N0 CNC Sampling Period, P11N0 Axis Measurement"
        in capsys.readouterr().err
    )


def test_a_new_num_file_moves_with_the_words_of_the_manual(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    reported = simulated(capsys, new(tmp_path, "num"), "step", "--axis", "X", *settings(NUM_WORDS))
    assert reported["axis"] == "0"
    assert reported["result"]["steady_following_error"]["value"] == pytest.approx(6.0, abs=0.002)
    assert reported["alarms"] == []
    assert "P53N0 is not set: 0 is taken, the sin² ramps of older software (6-38)." in reported["assumptions"]


def test_words_and_model_of_a_num_axis_can_be_set_for_one_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = new(tmp_path, "num")
    half = settings(NUM_WORDS.replace("P21N0=4915", "P21N0=9830"))
    assert simulated(capsys, path, "step", *half)["result"]["steady_following_error"][
        "value"
    ] == pytest.approx(3.0, abs=0.002)
    other = NUM_WORDS + " model.drive_voltage=4.5 model.velocity_bandwidth=80"
    reported = simulated(capsys, path, "step", *settings(other))
    assert reported["result"]["steady_following_error"]["value"] == pytest.approx(3.0, abs=0.002)
    assert reported["result"]["peak_output"]["value"] == pytest.approx(4.5, abs=0.002)
    assert not any("model.velocity_bandwidth" in each for each in reported["assumptions"])


def test_a_model_setting_that_num_does_not_have_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = new(tmp_path, "num")
    assert run(["simulate", path, "step", *settings(NUM_WORDS + " model.voltage=9")]) == 2
    assert "model.voltage" in capsys.readouterr().err


def test_the_sine_squared_ramp_of_p7n1_keeps_its_acceleration(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = new(tmp_path, "num")
    sine = simulated(capsys, path, "step", *settings(NUM_WORDS + " P7N1=0x20"))
    assert sine["result"]["steady_following_error"]["value"] == pytest.approx(6.0, abs=0.002)
    assert sine["alarms"] == []


def test_a_new_syntec_file_shows_in_one_sentence_what_its_axis_needs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["simulate", new(tmp_path, "syntec", "--axes", "X,Z"), "step"]) == 2
    reported = capsys.readouterr().err
    assert "The simulation of axis 1 needs values that are not set: Pr61 Axis encoder resolution" in reported
    assert "Controller series, Pr3203 In" in reported


def test_a_new_syntec_file_moves_with_the_values_of_the_slides(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = new(tmp_path, "syntec", "--axes", "X,Z")
    reported = simulated(capsys, path, "step", *settings(SYNTEC_VALUES))
    assert reported["result"]["steady_following_error"]["value"] == pytest.approx(13.333, abs=0.003)


def test_too_fast_a_syntec_axis_brings_mot_005(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = new(tmp_path, "syntec", "--axes", "X")
    fast = settings(SYNTEC_VALUES.replace("Pr461=24000", "Pr461=62503"))
    capsys.readouterr()
    assert run(["simulate", path, "step", *fast, "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["alarms"][0]["code"] == "MOT-005"


def test_a_circle_of_a_num_mill_goes_as_fast_as_its_tolerated_error_allows(
    capsys: pytest.CaptureFixture[str],
) -> None:
    # 6-32: 50 µm and 60 ms leave the root of 2 R x 50 µm over 60 ms, 447 mm/min with 2 mm; the circle is then
    # smaller by the 50 µm, less what sampling and drive take away
    words = settings("move.radius=2 move.feedrate=5000 P50N0=2000")
    reported = simulated(capsys, str(EXAMPLE), "circle", *words)["result"]
    assert reported["feedrate"]["value"] == pytest.approx(447.21, abs=0.01)
    assert reported["first_order_radius_error"]["value"] == pytest.approx(0.050, abs=1e-5)
    assert reported["radius_error"]["value"] == pytest.approx(0.047, abs=0.003)


def test_after_an_excess_error_the_velocity_drive_brakes_the_axis(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = new(tmp_path, "num")
    words = settings(NUM_WORDS.replace("P23N0=6600", "P23N0=3000"))
    capsys.readouterr()
    assert run(["simulate", path, "step", *words, "--json"]) == 1
    reported = json.loads(capsys.readouterr().out)
    # from about 50 mm/s, with a drive of 50 Hz
    assert 0.1 < reported["result"]["stop_distance"]["value"] < 5.0
    assert reported["result"]["stop_position"]["value"] is not None


def test_a_dry_friction_correction_of_some_micrometres_makes_the_reversals_of_a_circle_smaller(
    capsys: pytest.CaptureFixture[str],
) -> None:
    # 6-34: about 10 µm and 50 ms; the right amplitude is that of the machine's own friction, four times as
    # much is too much
    def spike(amplitude: int) -> float:
        words = "move.radius=5 model.coulomb_friction=10 model.static_friction=12 P19N64=5000 P19N65=5000"
        both = settings(f"{words} P19N32={amplitude} P19N33={amplitude}")
        return float(simulated(capsys, str(EXAMPLE), "circle", *both)["result"]["reversal_spike"]["value"])

    assert spike(5) < 0.7 * spike(0)
    assert spike(40) > 2.0 * spike(0)


def test_the_reversal_error_compensation_makes_reversals_smaller_and_with_the_wrong_sign_larger(
    capsys: pytest.CaptureFixture[str],
) -> None:
    # 7-14; friction keeps the load on its side of the play, and the loop takes its 60 ms to follow the
    # compensation
    def spike(compensation: int) -> float:
        words = "move.radius=5 model.backlash=0.02 model.coulomb_friction=5 model.resonance=80"
        both = settings(f"{words} P18N0={compensation} P18N1={compensation}")
        return float(simulated(capsys, str(EXAMPLE), "circle", *both)["result"]["reversal_spike"]["value"])

    none = spike(0)
    assert spike(20) < 0.75 * none
    assert spike(-20) > 1.4 * none


def test_without_backlash_the_compensation_of_p18_is_not_used_and_this_is_named(
    capsys: pytest.CaptureFixture[str],
) -> None:
    reported = simulated(capsys, str(EXAMPLE), "step", *settings("P18N0=20"))
    assert reported["result"]["overshoot"]["value"] == 0.0
    assert any("P18N0 is not used" in each for each in reported["assumptions"])
