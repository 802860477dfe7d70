"""The pulse loop of a Syntec axis in one interpolation time, against what the slides print."""

from __future__ import annotations

import pytest

from amp_studio.families.syntec import law_sample as law
from amp_studio.sim import signals

TIME = 1966e-6  # s: Pr3203 = 2000 on a Super series
PARTS = 8


def mill(**figures: float) -> list[float]:
    """Return the axis of page 1.4.2, 10000 pulses and 10 mm a turn, with the loop gain of 1.5.3; no limits."""
    p = [0.0] * law.PARAMETERS
    p[law.PULSE], p[law.GAIN], p[law.MOST_PULSES], p[law.PARTS] = 0.001, 30.0, 2047.0, PARTS
    p[law.WHOLE] = 1.0
    p[law.LIMIT] = p[law.FATAL_LIMIT] = 1e9
    for name, figure in figures.items():
        p[getattr(law, name)] = figure
    return p


class Axis:
    """A law and its signals."""

    def __init__(self, p: list[float]) -> None:
        self.p, self.s, self.io = p, [0.0] * law.STATES, [0.0] * 24

    def sample(self, command: float, position: float = 0.0) -> None:
        self.io[signals.COMMAND], self.io[signals.POSITION] = command, position
        law.position_sample(self.p, self.s, self.io)

    def drive(self, position: float) -> float:
        self.io[signals.MOTOR] = position
        law.velocity_sample(self.p, self.s, self.io)
        return self.io[signals.OUTPUT]

    @property
    def alarm(self) -> float:
        return self.io[signals.STOP]


@pytest.mark.parametrize(
    ("pulses", "alarm"), [(2047, 0.0), (2048, law.DDA_OVERFLOW), (-2048, law.DDA_OVERFLOW)]
)
def test_mot_05_comes_at_pulse_2048_of_one_interpolation_time(pulses: int, alarm: float) -> None:
    axis = Axis(mill())  # 1.4.1
    axis.sample(0.0)
    axis.sample(pulses * 0.001)
    assert axis.alarm == alarm


def alarm_at(feedrate: float) -> float:
    axis = Axis(mill())
    for k in range(2000):
        axis.sample(feedrate / 60.0 * TIME * k)
    return axis.alarm


def test_62_472_m_a_minute_passes_and_the_next_pulse_does_not() -> None:
    # 1.4.2: 2047 pulses in 1966 µs, 10000 pulses and 10 mm a turn
    assert alarm_at(62472.0) == 0.0
    assert alarm_at(62503.0) == law.DDA_OVERFLOW


def test_the_pulses_of_one_interpolation_time_leave_the_card_evenly() -> None:
    axis = Axis(mill(GAIN=1.0))
    axis.sample(0.0)
    axis.sample(0.080)
    speeds = [axis.drive(0.0) for _ in range(PARTS + 1)]
    assert [s / 60.0 for s in speeds] == pytest.approx([0.01 * k for k in range(PARTS + 1)])


def test_no_pulse_is_lost_in_rounding() -> None:
    axis = Axis(mill())
    sent = 0.0
    for k in range(1001):
        axis.sample(0.00037 * k)
        sent += axis.io[signals.MONITOR + law.PULSES]
    assert sent == 370.0


def test_1000_mm_a_minute_at_gain_30_is_followed_555_um_behind() -> None:
    axis, position = Axis(mill()), 0.0  # 1.5.3, printed without its decimals
    for k in range(1500):
        axis.sample(1000.0 / 60.0 * TIME * k, position)
        for _ in range(PARTS):
            position += TIME / PARTS * axis.drive(position) / 60.0
    error = axis.io[signals.COMMAND] - axis.io[signals.REFERENCE_LAG] - axis.io[signals.POSITION]
    assert error == pytest.approx(0.5556, abs=0.003)


def test_mot_019_and_mot_023_come_beyond_two_and_four_times_the_reasonable_error() -> None:
    # rapid 24000 mm/min at gain 30: 13.333 mm, so 26.667 and 53.333 mm (1.5.3, 1.5.4)
    limits = {"LIMIT": 26.667, "FATAL_LIMIT": 53.333}
    alarms = []
    for position in (-26.667, -26.668, 26.668, -53.334):
        axis = Axis(mill(**limits))
        axis.sample(0.0, position)
        alarms.append(axis.alarm)
    assert alarms == [0.0, law.EXCESS_ERROR, law.EXCESS_ERROR, law.FATAL_ERROR]


def test_the_scale_closes_the_loop_where_it_is_said_so() -> None:
    axis = Axis(mill(BY_SCALE=1.0, GAIN=1.0))
    axis.sample(0.0, 0.5)
    assert axis.drive(0.1) == pytest.approx(-30.0)


def test_the_velocity_test_sends_the_speed_without_a_loop() -> None:
    axis = Axis(mill())
    axis.io[signals.MODE], axis.io[signals.COMMAND_VELOCITY] = signals.VELOCITY_LOOP, 50.0
    axis.sample(0.0, 7.0)
    assert axis.drive(7.0) == 3000.0
