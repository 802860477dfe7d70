"""LOPASS and NOTCH of an ACR controller do what appendix C describes (page 128)."""

import math

import pytest

from amp_studio.families.acromill import formulas as acromill
from amp_studio.families.acromill import law_sample as loop
from amp_studio.families.acromill.law_filters import PASS, lopass, notch
from amp_studio.sim import SimulationError
from amp_studio.sim.engine.signals import COMMAND, OUTPUT


def gain(section: tuple[float, ...], frequency: float, servo_hz: float = 5000.0) -> float:
    return float(acromill.filter_gain([section], frequency, servo_hz))


def test_a_notch_as_wide_as_its_frequency_lets_nothing_through_there() -> None:
    # NOTCH X(100,100) at a servo update of 5000 Hz, the command of the guide.
    assert gain(notch(100, 100, 5000), 100) == pytest.approx(0.0, abs=1e-12)
    assert gain(notch(100, 100, 5000), 1) == pytest.approx(1.0, abs=1e-3)
    assert gain(notch(100, 100, 5000), 2000) == pytest.approx(1.0, abs=1e-2)


def test_a_wider_notch_takes_out_more_and_one_of_1_hz_very_little() -> None:
    depths = [gain(notch(500, width, 5000), 500) for width in (1, 50, 250, 500)]
    assert depths == pytest.approx([0.998, 0.9, 0.5, 0.0], abs=1e-9)


def test_the_widest_notch_is_3_db_down_over_its_width() -> None:
    section = notch(100, 100, 50_000.0)  # far below the servo update, where the transform bends nothing
    assert gain(section, 61.8, 50_000.0) == pytest.approx(0.5**0.5, rel=0.001)
    assert gain(section, 161.8, 50_000.0) == pytest.approx(0.5**0.5, rel=0.001)


def test_lopass_is_3_db_down_at_its_frequency() -> None:
    section = lopass(200, 5000)  # LOPASS X200 at 5000 Hz, the command of the guide
    assert gain(section, 200) == pytest.approx(0.5**0.5, rel=1e-9)
    assert gain(section, 1) == pytest.approx(1.0, abs=1e-6)
    assert gain(section, 1000) < 0.05


def test_the_same_filter_twice_falls_twice_as_steep() -> None:
    # Page 128: the parameters of the first filter copied into the second.
    once, twice = gain(lopass(200, 5000), 500), acromill.filter_gain([lopass(200, 5000)] * 2, 500, 5000)
    assert twice == pytest.approx(once**2)


def test_a_filter_above_half_the_servo_update_is_refused_with_both_figures() -> None:
    with pytest.raises(SimulationError, match=r"LOPASS 1250 Hz .* servo update frequency, which is 2500 Hz"):
        lopass(1250, 2500)
    with pytest.raises(SimulationError, match=r"NOTCH\(100, 101\): the width"):
        notch(100, 101, 5000)


@pytest.mark.parametrize(
    ("filters", "expected"),
    [
        ((), {50: 10.0, 100: 10.0}),
        ((notch(100, 100, 5000),), {20: 9.8, 100: 0.0, 1000: 9.9}),
        ((lopass(200, 5000),), {20: 10.0, 200: 7.07, 1000: 0.3}),
    ],
    ids=["none", "NOTCH X(100,100)", "LOPASS X200"],
)
def test_the_sine_of_the_guide_comes_out_of_the_servo_loop_as_its_traces_are_described(
    filters: tuple[tuple[float, ...], ...], expected: dict[int, float]
) -> None:
    # Page 128: motor off, PGAIN 0.00244, a sine of one turn of 4096 pulses is 10 V at the output; 5000 Hz.
    p = [0.0] * loop.PARAMETERS
    p[loop.PULSES], p[loop.PERIOD], p[loop.P_GAIN], p[loop.TORQUE_LIMIT] = 4096.0, 1 / 5000, 10 / 4096, 10.0
    p[loop.D_PERIODS] = p[loop.DAC_SHARE] = 1.0
    sections = [*filters, PASS, PASS][:2]
    p[loop.FILTERS :] = [figure for section in sections for figure in section]
    for frequency, volts in expected.items():
        s, seen = [0.0] * loop.STATE, []
        for k in range(1000):
            io = [0.0] * 24
            io[COMMAND] = math.sin(2.0 * math.pi * frequency * k / 5000)
            loop.position_sample(p, s, io)
            seen.append(io[OUTPUT])
        assert max(map(abs, seen[500:])) == pytest.approx(volts, abs=0.3)
