"""The pulse loop of a Syntec axis in one interpolation time, against what the slides print."""

import pytest

from amp_studio.families.syntec import law_sample as law
from amp_studio.sim.engine import signals

TIME = 1966e-6  # s: Pr3203 = 2000 on a Super series


def mill(**figures: float) -> list[float]:
    """Return the axis of page 1.4.2, 10000 pulses and 10 mm a turn, with the loop gain of 1.5.3; no
    limits.
    """
    p = [0.0] * law.PARAMETERS
    p[law.PULSE], p[law.GAIN], p[law.MAX_PULSES], p[law.WHOLE] = 0.001, 30.0, 2047.0, 1.0
    p[law.LIMIT] = p[law.FATAL_LIMIT] = 1e9
    for name, figure in figures.items():
        p[getattr(law, name)] = figure
    return p


class Axis:
    """A law and its signals."""

    def __init__(self, p: list[float]) -> None:
        self.p, self.s, self.io = p, [0.0] * law.STATES, [0.0] * 24

    def sample(self, command: float, position: float = 0.0) -> float:
        """Return the speed in mm/s that one sample of the drive gives."""
        self.io[signals.COMMAND], self.io[signals.POSITION] = command, position
        law.position_sample(self.p, self.s, self.io)
        return self.io[signals.OUTPUT] / 60.0

    def interpolate(self, command: float, position: float = 0.0) -> list[float]:
        """Return the speeds of one interpolation time."""
        return [self.sample(command, position) for _ in range(law.PARTS)]

    @property
    def pulses(self) -> float:
        return self.io[signals.MONITOR + law.PULSES]

    @property
    def alarm(self) -> float:
        return self.io[signals.STOP]


@pytest.mark.parametrize(
    ("pulses", "alarm"), [(2047, 0.0), (2048, law.DDA_OVERFLOW), (-2048, law.DDA_OVERFLOW)]
)
def test_mot_05_comes_at_pulse_2048_of_one_interpolation_time(pulses: int, alarm: float) -> None:
    axis = Axis(mill())  # 1.4.1
    axis.interpolate(0.0)
    axis.sample(pulses * 0.001)
    assert axis.alarm == alarm


def alarm_at(feedrate: float) -> float:
    axis = Axis(mill())
    for k in range(2000):
        axis.interpolate(feedrate / 60.0 * TIME * k)
    return axis.alarm


def test_62_472_m_a_minute_passes_and_the_next_pulse_does_not() -> None:
    # 1.4.2: 2047 pulses in 1966 µs, 10000 pulses and 10 mm a turn
    assert alarm_at(62472.0) == 0.0
    assert alarm_at(62503.0) == law.DDA_OVERFLOW


def test_the_pulses_of_one_interpolation_time_leave_the_card_evenly() -> None:
    axis = Axis(mill(GAIN=1.0))
    speeds = axis.interpolate(0.080) + axis.interpolate(0.080)[:1]
    assert speeds == pytest.approx([0.01 * k for k in range(9)])


def test_no_pulse_is_lost_in_rounding() -> None:
    axis, sent = Axis(mill()), 0.0
    for k in range(1001):
        axis.interpolate(0.00037 * k)
        sent += axis.pulses
    assert sent == 370.0


def test_1000_mm_a_minute_at_gain_30_is_followed_555_um_behind() -> None:
    axis, position = Axis(mill()), 0.0  # 1.5.3, printed without its decimals
    for k in range(1500 * law.PARTS):
        position += TIME / law.PARTS * axis.sample(1000.0 / 60.0 * TIME * k / law.PARTS, position)
    error = axis.io[signals.COMMAND] - axis.io[signals.REFERENCE_LAG] - axis.io[signals.POSITION]
    assert error == pytest.approx(0.5556, abs=0.003)


def test_mot_019_and_mot_023_come_beyond_two_and_four_times_the_reasonable_error() -> None:
    # rapid 24000 mm/min at gain 30: 13.333 mm, so 26.667 and 53.333 mm (1.5.3, 1.5.4)
    alarms = []
    for position in (-26.667, -26.668, 26.668, -53.334):
        axis = Axis(mill(LIMIT=26.667, FATAL_LIMIT=53.333))
        axis.sample(0.0, position)
        alarms.append(axis.alarm)
    assert alarms == [0.0, law.EXCESS_ERROR, law.EXCESS_ERROR, law.FATAL_ERROR]


def test_without_steps_the_loop_follows_the_command_of_one_interpolation_time_ago() -> None:
    axis = Axis(mill(WHOLE=0.0, GAIN=1.0))
    speeds = [axis.sample(0.0001 * k) for k in range(12)]
    assert speeds == pytest.approx([0.0] * 8 + [0.0, 0.0001, 0.0002, 0.0003])


def test_velocity_and_output_tests_send_speed_and_output_without_a_loop() -> None:
    axis = Axis(mill())
    axis.io[signals.MODE], axis.io[signals.COMMAND_VELOCITY] = signals.VELOCITY_LOOP, 50.0
    assert axis.sample(0.0, 7.0) == 50.0
    axis.io[signals.MODE] = signals.OUTPUT_TEST
    assert axis.sample(120.0, 7.0) == 2.0
