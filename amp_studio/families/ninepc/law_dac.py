"""The DAC monitor of a 9/PC: signals of a servo as voltages for a chart recorder (appendix A).

Two channels, parameters 86 and 87. The manual prints what they show (Table A.B), the voltage at full scale
(820, 830) and what the signal is divided by (910, 930), but not what the control counts a signal in. So a
channel is a column of the result as soon as that unit is set.
"""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.sim import AxisParameters, SimulationError

from . import law_samples as samples
from .formulas.tuning import DAC_PITCHES, dac_monitor_function, dac_starting_scale
from .law_facts import ids
from .law_reading import above_zero, demand

VOLTS = 10.0
"""V: the end of a DAC output (12-2)."""


@dataclass(frozen=True)
class Channel:
    """One output: number of its parameter, its instance,
    and that of gear 1 of the spindle that scales it (A-5).
    """

    number: str
    place: str
    gear: str

    @property
    def unit(self) -> str:
        """The setting that makes it a column."""
        return f"model.dac_unit_{self.number}"


CHANNELS = (Channel("86", "2", "1.1"), Channel("87", "3", "2.1"))
_SIGNALS = {
    100: samples.VELOCITY_FEEDBACK,
    200: samples.FOLLOWING_ERROR,
    300: samples.INTEGRAL_TORQUE,
    400: samples.VELOCITY_ERROR,
    500: samples.COMMAND_SPEED,
    600: samples.FINAL_VELOCITY,
}
"""Function code (Table A.B, A-6) -> column."""
INFERRED = {
    500: (
        "INFERRED: coarse IPCs (500) are increments of the position command (IPC in Figure 7.4), as the"
        " velocity of the command: the time of an increment is in the unit."
    ),
    600: (
        "INFERRED: final velocity (600) is the velocity command that velocity error and feedback (400, 100)"
        " belong to; the manual has its name alone (A-6)."
    ),
}
_OF_ANALOG = (200, 500)
"""Those that an analog servo has, too (A-6)."""

NOTE = (
    "DAC monitor {0}: {1} V x {2} / ({3} x {4}), at most {5} V (A-5, A-7, 12-2). INFERRED: full scale at {3}"
    " (A-4); ASSUMED: renewed at each sample of the loop. The manual does not print the unit of the signal:"
    " {4} is that of {6}."
)


def columns(read: AxisParameters, drive: str, p: list[float], notes: list[str]) -> list[tuple[str, str]]:
    """Return the columns of the channels whose unit is set, and set their figures in ``p``.

    Raises SimulationError for a code that selects no signal, and for an impossible scale.
    """
    found: list[tuple[str, str]] = []
    for channel in CHANNELS:
        if read.optional(channel.unit) is None:
            continue
        unit = above_zero(read, channel.unit)
        signal = _signal(read, channel, drive, notes)
        if signal is None:
            continue
        volts = read.number(ids.voltage_at_max, at=channel.gear)
        divisor = read.number(ids.spindle_max_speed, at=channel.gear)
        demand(
            read, ids.voltage_at_max, volts, abs(volts) <= VOLTS, "must be from -10 to 10 V", everywhere=True
        )
        demand(read, ids.spindle_max_speed, divisor, divisor > 0.0, "must be above 0", everywhere=True)
        # By the channels found, not by their number: an output that shows another axis takes no place.
        first = samples.DAC + samples.DAC_FIGURES * len(found)
        p[first : first + samples.DAC_FIGURES] = [float(signal), volts / (divisor * unit), abs(volts)]
        found.append((f"dac_{channel.number}", "V"))
        name = "command_velocity" if signal == samples.COMMAND_SPEED else samples.MONITORS[signal][0]
        texts = f"{volts:g}", name, f"{divisor:g}", f"{unit:g}"
        notes.append(NOTE.format(channel.number, *texts, f"{abs(volts):g}", channel.unit))
        notes += _about(read, channel)
    p[samples.CHANNELS] = float(len(found))
    return found


def _about(read: AxisParameters, channel: Channel) -> list[str]:
    """Return what is inferred of the signal, and the scale that is printed to begin with."""
    function, _ = dac_monitor_function(read.number(ids.dac_monitor, at=channel.place))
    small, large = (dac_starting_scale(function, pitch) for pitch in DAC_PITCHES)
    return [
        *([INFERRED[function]] if function in INFERRED else []),
        (
            f"Scale to begin with for the signal {function:g} (Table A.C, A-7): {small:g} at a pitch of"
            f" 0.1 in, {large:g} at 0.5 in, for 10 V; other pitches are not printed."
        ),
    ]


def _signal(read: AxisParameters, channel: Channel, drive: str, notes: list[str]) -> int | None:
    """Return the column that a channel shows: function code + axis number (A-6);
    None where it shows another axis.
    """
    code = read.number(ids.dac_monitor, at=channel.place)
    place = f"DAC monitor {channel.number} ({read.called(ids.dac_monitor, at=channel.place)}) is {code:g}"
    if code == 0.0:
        raise SimulationError(
            f"{place}. Set it to a function code plus the axis number, as 101 (A-6)", ids.dac_monitor
        )
    try:
        function, axis = dac_monitor_function(code)
    except ValueError:
        why = "no function code plus axis number; the control stays in E-STOP (A-6)"
        raise SimulationError(f"{place}, {why}", ids.dac_monitor) from None
    if str(axis) != read.axis:
        notes.append(f"{place}: it shows axis {axis}, so it is no column of axis {read.axis}.")
        return None
    if drive == "analog" and function not in _OF_ANALOG:
        raise SimulationError(
            f"{place}: an analog servo has no such signal (A-6). Take 200 or 500", ids.dac_monitor
        )
    return _SIGNALS[function]
