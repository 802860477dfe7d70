"""The sample functions of the 9/PC, called with arrays: what each loop does with one sample (chapter 7)."""

import pytest

from amp_studio.families.ninepc import law_samples as law
from amp_studio.sim.engine.signals import (
    COMMAND,
    COMMAND_VELOCITY,
    FEED_SHARE,
    MODE,
    MONITOR,
    MOTOR,
    OUTPUT,
    OUTPUT_TEST,
    POSITION,
    STOP,
    VELOCITY_LOOP,
)

FAR = 1e9
SPEED = 100.0
"""u/s"""


class Servo:
    """Arrays of one axis at gain 1 (60 ms) that counts in thousandths, with what a test sets."""

    def __init__(self, **figures: float) -> None:
        self.p = [0.0] * law.SIZE
        usual = {
            "GAIN": 1000.0 / 60.0,
            "BREAK_POINT": FAR,
            "BREAK_RATIO": 1.0,
            "EXCESS": FAR,
            "SUPPRESSION": FAR,
        }
        usual |= {"COUNT": 0.001, "PROPORTIONAL": 1.0, "DISCHARGE": 1.0, "LIMIT_POSITIVE": 200.0}
        usual |= {"LIMIT_NEGATIVE": 200.0, "FILTER": 1.0, "PERIOD": 0.001, "VOLTS_LIMIT": 10.0}
        for name, figure in {**usual, **figures}.items():
            self.p[getattr(law, name)] = figure
        self.s, self.io = [0.0] * law.STATE_SIZE, [0.0] * (MONITOR + len(law.MONITORS))

    def position(self, command: float, measured: float = 0.0, velocity: float = 0.0) -> float:
        """Take one position sample; return the velocity command."""
        self.io[COMMAND], self.io[POSITION], self.io[COMMAND_VELOCITY] = command, measured, velocity
        law.position_sample(self.p, self.s, self.io)
        return self.s[law.VELOCITY_COMMAND]

    def torque(self, velocity_command: float, moved: float = 0.0) -> float:
        """Take one velocity sample after the motor has moved so far; return the torque."""
        self.s[law.VELOCITY_COMMAND] = velocity_command
        self.io[MOTOR] += moved
        law.velocity_sample(self.p, self.s, self.io)
        return self.io[OUTPUT]


# -- position loop ---------------------------------------------------------------------------------


@pytest.mark.parametrize(("gain", "error"), [(0.25, 0.004), (0.5, 0.002), (1.0, 0.001), (2.0, 0.0005)])
def test_table_7_a_is_the_following_error_for_1_mm_a_minute(gain: float, error: float) -> None:
    # Page 7-25; its other column is the same in ms.
    assert Servo(GAIN=gain * 1000.0 / 60.0).position(error) * 60.0 == pytest.approx(1.0)


def test_beyond_the_gain_break_point_the_rest_of_the_error_counts_for_the_ratio_only() -> None:
    # Pages 7-22 and 7-27; no step at the break point.
    servo = Servo(GAIN=10.0, BREAK_POINT=2.0, BREAK_RATIO=0.5)
    assert [servo.position(error) for error in (1.0, 2.0, 3.0, -6.0)] == [10.0, 20.0, 25.0, -40.0]


def test_feed_forward_adds_a_share_of_the_command_velocity() -> None:
    # Page 7-28: with 80 % a fifth of the following error is enough for the feedrate.
    servo = Servo(GAIN=10.0, FEED_FORWARD=0.8)
    assert servo.position(2.0, velocity=SPEED) == pytest.approx(SPEED)


def test_an_open_loop_and_the_velocity_mode_take_the_command_velocity_and_check_nothing() -> None:
    # Page 7-13.
    servo = Servo(OPEN=1.0, EXCESS=1.0)
    assert (servo.position(50.0, velocity=SPEED), servo.io[STOP]) == (SPEED, 0.0)
    servo = Servo(EXCESS=1.0)
    servo.io[MODE] = VELOCITY_LOOP
    assert (servo.position(50.0, velocity=SPEED), servo.io[STOP]) == (SPEED, 0.0)


def test_a_following_error_above_its_limit_stops_the_control_and_the_suppression_halves_the_feedrate() -> (
    None
):
    # Pages 7-20 and 7-21: above, not at, and in both directions.
    servo = Servo(SUPPRESSION=4.0, EXCESS=5.0)
    seen = []
    for error in (4.0, -4.001, 3.9, 5.0, -5.001):
        servo.position(error)
        seen.append((servo.io[FEED_SHARE], servo.io[STOP]))
    assert seen == [(1.0, 0.0), (0.5, 0.0), (1.0, 0.0), (0.5, 0.0), (0.5, law.EXCESS_ERROR_ALARM)]


@pytest.mark.parametrize(
    ("came_from", "shifts"),
    [
        # Negative: added to the first motion in the positive direction; positive: to the first in the
        # negative one.
        (-1.0, [0.0, 0.02, 0.02, 0.0, 0.02]),
        (1.0, [0.0, 0.0, 0.0, -0.02, 0.0]),
    ],
)
def test_reversal_error_is_added_at_each_reversal_from_the_first_direction_on(
    came_from: float, shifts: list[float]
) -> None:
    # Page 7-18.
    servo = Servo(REVERSAL=0.02, FIRST=came_from)
    seen = []
    for velocity in (0.0, SPEED, 0.0, -SPEED, SPEED):
        servo.position(0.0, velocity=velocity)
        seen.append(servo.s[law.SHIFT])
    assert seen == pytest.approx(shifts)


# -- friction compensation -------------------------------------------------------------------------


def test_friction_compensation_begins_at_ten_counts_with_stiction_for_one_sample() -> None:
    # Page 7-85: 0 to 9 counts none, 10 and more friction, and stiction in the first iteration alone.
    servo = Servo(THRESHOLD=10.0, STICTION=7.0, FRICTION_POSITIVE=3.0, FRICTION_NEGATIVE=4.0)
    seen = []
    for counts in (9, 10, 11, 200, 9, 10, 10):
        servo.position(counts * 0.001, velocity=SPEED)
        seen.append(servo.s[law.FRICTION])
    assert seen == [0.0, 10.0, 3.0, 3.0, 0.0, 10.0, 3.0]
    servo.position(-0.010, velocity=-SPEED)
    assert servo.s[law.FRICTION] == -4.0


def test_stiction_alone_is_for_one_sample() -> None:
    servo = Servo(THRESHOLD=10.0, STICTION=7.0)
    seen = []
    for counts in (9, 10, 11):
        servo.position(counts * 0.001, velocity=SPEED)
        seen.append(servo.s[law.FRICTION])
    assert seen == [0.0, 7.0, 0.0]


def test_at_rest_friction_compensation_has_the_direction_of_the_following_error() -> None:
    servo = Servo(THRESHOLD=10.0, FRICTION_POSITIVE=3.0, FRICTION_NEGATIVE=4.0)
    seen = []
    for error in (0.02, -0.02, 0.0):
        servo.position(error)
        seen.append(servo.s[law.FRICTION])
    assert seen == [3.0, -4.0, 0.0]


# -- velocity loop ---------------------------------------------------------------------------------


def test_the_proportional_and_the_integral_product_are_added() -> None:
    # Pages 7-54 and 7-56: errors 10, 10, 4 (the motor turns), gains 2 and 0.5.
    servo = Servo(PROPORTIONAL=2.0, INTEGRAL=0.5)
    assert [servo.torque(10.0), servo.torque(10.0), servo.torque(10.0, moved=0.006)] == pytest.approx(
        [2 * 10 + 0.5 * 10, 2 * 10 + 0.5 * 20, 2 * 4 + 0.5 * 24]
    )


def test_the_sum_discharges_faster_than_it_charges_and_no_further_than_zero() -> None:
    # Page 7-58.
    sums = [law.summed(total, error, 4.0) for total, error in ((0, 3), (12, 3), (12, -2), (-12, 2), (12, -5))]
    assert sums == [3.0, 15.0, 4.0, -4.0, -2.0]


def test_the_torque_is_limited_by_the_direction_of_travel_not_by_its_sign() -> None:
    # Pages 7-61, 7-62: the limit of a direction is valid for accelerating and for decelerating in it.
    servo = Servo(PROPORTIONAL=1e6, LIMIT_POSITIVE=150.0, LIMIT_NEGATIVE=60.0)
    assert servo.torque(50.0, moved=0.001) == 150.0
    assert servo.torque(-50.0, moved=0.001) == -150.0  # braking on the way
    assert servo.torque(-50.0, moved=-0.001) == -60.0
    assert servo.torque(50.0, moved=-0.001) == 60.0
    assert servo.torque(-50.0) == -60.0  # at rest: where it shall go


def test_the_sum_stops_while_the_torque_is_limited() -> None:
    servo = Servo(INTEGRAL=1.0, LIMIT_POSITIVE=100.0)
    for _ in range(50):
        servo.torque(90.0)
    assert servo.s[law.ERROR_SUM] == 0.0
    servo.torque(40.0)
    assert servo.s[law.ERROR_SUM] == 40.0


def test_one_percent_of_offset_makes_four_of_three_two_of_minus_three_and_one_at_rest() -> None:
    # Page 7-63.
    for wanted, applied in ((3.0, 4.0), (-3.0, -2.0), (0.0, 1.0)):
        assert Servo(OFFSET=1.0).torque(wanted) == applied


def test_the_torque_filter_lets_a_share_of_each_change_through() -> None:
    servo = Servo(FILTER=0.25)
    assert [servo.torque(16.0) for _ in range(3)] == [4.0, 7.0, 9.25]


def test_an_output_test_keeps_to_the_limit_of_its_direction() -> None:
    servo = Servo(LIMIT_POSITIVE=150.0)
    servo.io[MODE], servo.io[COMMAND] = OUTPUT_TEST, 500.0
    assert servo.torque(0.0) == 150.0


# -- analog output ---------------------------------------------------------------------------------


def test_an_analog_servo_gets_its_voltage_at_rapid_in_each_direction_and_ten_volts_at_most() -> None:
    # Pages 7-41 and 7-43: 8 V and -6 V at 200 u/s.
    servo = Servo(GAIN=10.0, VOLTS_POSITIVE=8.0 / 200.0, VOLTS_NEGATIVE=6.0 / 200.0)
    seen = []
    for error in (20.0, -20.0, 10.0, 40.0):
        servo.io[COMMAND] = error
        law.analog_sample(servo.p, servo.s, servo.io)
        seen.append(servo.io[OUTPUT])
    assert seen == pytest.approx([8.0, -6.0, 4.0, 10.0])


# -- split axes ------------------------------------------------------------------------------------


def slave(**figures: float) -> Servo:
    """Return the slave of a split axis whose master has following errors of 1, 2 and 3 u."""
    servo = Servo(GAIN=10.0, SKEW_LIMIT=FAR, MASTER_SAMPLES=3.0, **figures)
    servo.p += [1.0, 2.0, 3.0]
    return servo


def test_the_gain_of_a_slave_changes_with_the_skew_and_not_at_deskew_gain_0() -> None:
    # Page 32-9: up where the slave is further behind, down where it is ahead.
    assert [slave(DESKEW=0.5).position(error) for error in (1.0, 1.5, 0.5)] == [10.0, 18.75, 3.75]
    assert slave(DESKEW=0.0).position(1.5) == 15.0


def test_a_skew_above_its_limit_stops_the_control() -> None:
    # Page 32-10; the errors of the master are taken sample by sample, the last one from then on.
    servo = slave(DESKEW=0.0)
    servo.p[law.SKEW_LIMIT] = 0.5
    stops = []
    for error in (1.5, 2.5, 3.5, 3.51):
        servo.position(error)
        stops.append(servo.io[STOP])
    assert stops == [0.0, 0.0, 0.0, law.EXCESS_SKEW_ALARM]
