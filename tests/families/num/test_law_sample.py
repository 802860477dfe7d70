"""The position loop of a NUM from sample to sample, against what the manual prints."""

from collections.abc import Callable

import pytest

from amp_studio.families.num import law_sample as law
from amp_studio.sim.engine import signals

PERIOD = 0.005  # s, P50 of a 1060


def mill(**figures: float) -> list[float]:
    """Return the parameters of the axis of page 6-14: 100 mm/s at 9 V, 60 ms, µm, KVAR 4915; no checks."""
    p = [0.0] * law.PARAMETERS
    p[law.GAIN] = 4915.0  # points per mm: thousandths of a point per µm
    p[law.CONSTANT], p[law.PERIOD], p[law.TERMS] = 0.06, PERIOD, 1.0
    p[law.EMAX], p[law.TOLERANCE], p[law.VOLTS] = 1e9, -1.0, 0.09
    p[law.SYNC_LIMIT], p[law.WHOLE] = 1e9, 1.0
    for name, figure in figures.items():
        p[getattr(law, name)] = figure
    return p


class Axis:
    """A law and the signals between it and a drive that turns 9 V into 100 mm/s at once."""

    def __init__(self, p: list[float]) -> None:
        self.p, self.s, self.io = p, [0.0] * law.STATES, [0.0] * 24

    def sample(self, command: float, position: float) -> float:
        self.io[signals.COMMAND], self.io[signals.POSITION] = command, position
        law.position_sample(self.p, self.s, self.io)
        return self.io[signals.OUTPUT]

    def run(self, command: Callable[[float], float], samples: int) -> None:
        position = 0.0
        for k in range(samples):
            position += PERIOD * self.sample(command(k * PERIOD), position) / 9.0 * 100.0

    @property
    def error(self) -> float:
        return self.io[signals.COMMAND] - self.io[signals.REFERENCE_LAG] - self.io[signals.POSITION]

    @property
    def alarm(self) -> float:
        return self.io[signals.STOP]


def at(speed: float) -> Callable[[float], float]:
    return lambda time: speed * time


def test_kvar_4915_makes_9_volts_of_the_following_error_at_100_mm_s() -> None:
    # 6-14: 29491 points are 9 V; the entered 4915 leaves out the decimals of 4915.16
    axis = Axis(mill())
    volts = axis.sample(6.0, 0.0)
    assert axis.io[signals.MONITOR + law.POINTS] == 29490.0
    assert volts == pytest.approx(8.99963, abs=1e-5)


def test_the_reference_ends_at_10_volts() -> None:
    assert Axis(mill()).sample(100.0, 0.0) == 10.0
    assert Axis(mill()).sample(-100.0, 0.0) == -10.0


def test_the_reference_is_whole_points_of_a_15_bit_converter() -> None:
    axis = Axis(mill())
    axis.sample(0.0001, 0.0)  # 0.4915 of a point
    assert axis.io[signals.OUTPUT] == 0.0
    axis.sample(0.0002, 0.0)
    assert axis.io[signals.OUTPUT] == pytest.approx(10.0 / 32768.0)


def test_one_metre_a_minute_at_60_ms_is_followed_1_mm_behind() -> None:
    axis = Axis(mill())  # 6-18
    axis.run(at(1000.0 / 60.0), 400)
    assert axis.error == pytest.approx(1.0, abs=0.001)


def test_at_100_mm_s_the_error_settles_at_speed_times_time_constant() -> None:
    axis = Axis(mill())  # 11-3: VMAX x T
    axis.run(at(100.0), 400)
    assert axis.error == pytest.approx(6.0, abs=0.002)


@pytest.mark.parametrize(("share", "left"), [(0.4, 3.6), (1.0, 0.0)])
def test_speed_anticipation_takes_its_share_of_the_following_error(share: float, left: float) -> None:
    axis = Axis(mill(SHARE=share))  # 6-26
    axis.run(at(100.0), 400)
    assert axis.error == pytest.approx(left, abs=0.003)


def test_the_filter_averages_the_last_five_references() -> None:
    axis = Axis(mill(TERMS=5.0))  # 6-26: 2j+1 = 5
    axis.sample(0.0, 0.0)
    errors = []
    for _ in range(6):
        axis.sample(1.0, 0.0)
        errors.append(axis.error)
    assert errors == pytest.approx([0.2, 0.4, 0.6, 0.8, 1.0, 1.0])


def test_with_full_anticipation_a_filtered_axis_follows_its_filtered_reference() -> None:
    axis = Axis(mill(TERMS=5.0, SHARE=1.0))
    axis.run(at(100.0), 400)
    assert axis.error == pytest.approx(0.0, abs=0.003)


def test_the_friction_correction_dies_away_by_the_printed_recursion() -> None:
    axis = Axis(mill(FRICTION=0.010, FRICTION_LEFT=0.9))  # 6-34: 10 µm, Te / Tf = 5 ms / 50 ms
    volts = [axis.sample(k * 1e-9, k * 1e-9) for k in range(5)]
    points = [round(v / 10.0 * 32768.0) for v in volts]
    assert points == [0, 49, 44, 40, 36]  # 49.15 x 1, 0.9, 0.81, 0.729


def test_a_reversal_adds_twice_the_amplitude() -> None:
    axis = Axis(mill(FRICTION=0.010, FRICTION_LEFT=0.0))
    commands = (0.0, 1e-9, 2e-9, 1e-9)
    points = [round(axis.sample(c, c) / 10.0 * 32768.0) for c in commands]
    assert points == [0, 49, 0, -98]


def test_the_reversal_error_compensation_is_added_on_positive_moves() -> None:
    axis = Axis(mill(BACKLASH=0.020))  # 7-14
    errors = []
    for command in (0.0, 1.0, 2.0, 2.0, 1.0, 2.0):
        axis.sample(command, command)
        errors.append(axis.error)
    assert errors == pytest.approx([0.0, 0.020, 0.020, 0.020, 0.0, 0.020])


def test_a_following_error_above_emax_is_an_alarm() -> None:
    axis = Axis(mill(EMAX=6.6))  # 6-23: 6600 µm
    axis.sample(6.6, 0.0)
    assert axis.alarm == 0.0
    axis.sample(6.6, -0.001)
    assert axis.alarm == law.EXCESS_ERROR


def moved(real: float, tolerance: float) -> float:
    """Return the alarm of an axis that was 6 mm behind, which at 60 ms should have moved 0.5 mm in a
    sample.
    """
    axis = Axis(mill(TOLERANCE=tolerance))
    axis.sample(6.0, 0.0)
    axis.sample(6.0, real)
    return axis.alarm


def test_the_dynamic_check_lets_pass_0_875_to_1_125_of_the_theoretical_speed() -> None:
    assert moved(0.4375, 0.0) == 0.0  # 6-24
    assert moved(0.5625, 0.0) == 0.0
    assert moved(0.4374, 0.0) == law.DYNAMIC_CHECK
    assert moved(0.5626, 0.0) == law.DYNAMIC_CHECK


def test_the_tolerance_of_p57_widens_the_band() -> None:
    assert moved(0.4175, 0.020) == 0.0
    assert moved(0.4174, 0.020) == law.DYNAMIC_CHECK


def test_a_negative_tolerance_is_no_check() -> None:
    assert moved(0.0, -1.0) == 0.0


def test_an_axis_that_moves_backwards_is_checked_the_same_way() -> None:
    axis = Axis(mill(TOLERANCE=0.0))
    axis.sample(-6.0, 0.0)
    axis.sample(-6.5, -0.5)
    assert axis.alarm == 0.0
    axis.sample(-6.5, -0.5 - 0.6)
    assert axis.alarm == law.DYNAMIC_CHECK


def led(positions: list[float], **figures: float) -> Axis:
    """Return an axis whose drive axis is measured at these positions, sample by sample."""
    return Axis([*mill(LEADER=float(len(positions)), **figures), *positions])


def test_a_synchronised_axis_keeps_the_share_of_the_difference_that_the_correction_leaves() -> None:
    # 6-30: the driven axis has 50 ms, the drive axis follows 60 ms late: V (T - T') / (1 + c)
    late = [100.0 * (k * PERIOD - 0.06) for k in range(600)]
    axis = led(late, GAIN=4915.0 * 60.0 / 50.0, CONSTANT=0.05, CORRECTION=0.25)
    axis.run(at(100.0), 600)
    assert axis.io[signals.MONITOR + law.SYNC_ERROR] == pytest.approx(-0.8, abs=0.003)


def test_threshold_1_is_an_alarm_of_a_synchronised_axis() -> None:
    axis = led([0.0, 0.0], SYNC_LIMIT=0.160)  # 6-30: 160 µm
    axis.sample(0.0, 0.160)
    assert axis.alarm == 0.0
    axis.sample(0.0, 0.161)
    assert axis.alarm == law.SYNCHRONISATION


def test_the_velocity_test_sends_the_speed_to_the_drive_without_a_loop() -> None:
    axis = Axis(mill())
    axis.io[signals.MODE], axis.io[signals.COMMAND_VELOCITY] = signals.VELOCITY_LOOP, 50.0
    assert axis.sample(0.0, 7.0) == pytest.approx(4.5, abs=2e-4)


def test_the_output_test_sends_the_command_as_volts() -> None:
    axis = Axis(mill())
    axis.io[signals.MODE] = signals.OUTPUT_TEST
    assert axis.sample(2.5, 7.0) == 2.5
    assert axis.sample(12.0, 7.0) == 10.0


@pytest.mark.parametrize("terms", [1.0, 5.0])
def test_acceleration_anticipation_is_the_printed_formula_with_the_reference_that_it_misses(
    terms: float,
) -> None:
    # 6-34: (Ri - Ri-2j-1 + Ri-2j-2) / (2j + 1) misses - Ri-1: with it the sum is 0 at rest and at a constant
    # speed.
    def points(ahead: float, references: list[float]) -> float:
        axis = Axis(mill(TERMS=terms, SHARE=1.0, WHOLE=0.0, AHEAD=ahead))
        for reference in references:
            axis.sample(reference, reference)
        return axis.io[signals.MONITOR + law.POINTS]

    rest, even, rising = [3.0] * 20, [0.01 * k for k in range(20)], [0.001 * k * k for k in range(20)]
    assert points(0.1, rest) == points(0.0, rest)
    assert points(0.1, even) == pytest.approx(points(0.0, even))
    last = {k: rising[-1 - k] for k in range(int(terms) + 2)}
    printed = (last[0] - last[1] - last[int(terms)] + last[int(terms) + 1]) / terms
    assert points(0.1, rising) - points(0.0, rising) == pytest.approx(4915.0 * 0.06 / PERIOD * 0.1 * printed)
