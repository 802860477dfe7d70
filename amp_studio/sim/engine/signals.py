"""The signals between the kernel and a law: indices into the array ``io`` of a sample function.

The kernel writes those marked "in" before it calls a sample function, the law writes those marked "out".
Lengths are in the unit u of the axis (mm or deg), times in s.
An "out" keeps its value until the law writes another.
"""

from __future__ import annotations

TIME = 0
"""in: s since the start of the run."""
COMMAND = 1
"""in: commanded position at this sample, u; in the mode OUTPUT_TEST the output itself."""
COMMAND_VELOCITY = 2
"""in: u/s; in the mode VELOCITY_LOOP the commanded velocity itself."""
COMMAND_ACCELERATION = 3
"""in: u/s2."""
POSITION = 4
"""in: measured by the position device at the last servo sample, u, in whole counts of that device."""
MOTOR = 5
"""in: measured by the motor's device at this sample, u, in whole counts of that device."""
OUTPUT = 6
"""out: what the drive gets, in the output unit of the law (% of rated torque, V ...)."""
FEED_SHARE = 7
"""out: share of the programmed feedrate with which the command goes on, 0 to 1; 1 at the start."""
STOP = 8
"""out: 0, or the number of an alarm of the law (1, 2 ...), which ends the run."""
MODE = 9
"""in: what is commanded: POSITION_LOOP, VELOCITY_LOOP or OUTPUT_TEST."""
TORQUE = 10
"""in: torque of the motor now, in the output unit (a velocity drive: in % of rated torque)."""
REFERENCE_LAG = 11
"""out: u by which the position that the control takes as its reference is behind COMMAND (a filter,
an interpolation time)."""
MONITOR = 16
"""out: the first of the columns that the law names in ``AxisLaw.monitors``."""

POSITION_LOOP = 0.0
"""The normal mode: the command is a position."""
VELOCITY_LOOP = 1.0
"""The velocity loop alone: the law takes COMMAND_VELOCITY in the place of its position loop."""
OUTPUT_TEST = 2.0
"""No loop: the law sets OUTPUT to COMMAND (within its limits)."""

EMERGENCY_STOP = -2.0
"""STOP of the kernel itself: the emergency stop that a scenario asked for."""
DIVERGED = -1.0
"""STOP of the kernel itself: positions without bounds."""
