"""What a family brings so that its axes can be simulated, found by its registration.

A law is two functions at most, at the top of a module of the family, over flat float64 arrays, so that they
run as plain Python and as machine code with equal results:

    from math import floor
    from amp_studio.sim.engine.signals import COMMAND, FEED_SHARE, MONITOR, MOTOR, OUTPUT, POSITION, STOP

    GAIN, LIMIT = 0, 1            # indices into p
    LAST = 0                      # index into s

    def position_sample(p, s, io):      # every servo period
        error = io[COMMAND] - io[POSITION]
        if abs(error) > p[LIMIT]:
            io[STOP] = 1.0              # alarms[1] ends the run
        s[LAST] = p[GAIN] * error       # what the velocity loop shall do
        io[MONITOR] = s[LAST]           # an own column, named in AxisLaw.monitors

    def velocity_sample(p, s, io):      # every velocity period, at once after position_sample when both are
    due
        io[OUTPUT] = ...

They may call other functions at the top of a module and use its constants; ``math`` is fine, objects,
strings, exceptions, default arguments and numpy are not. ``s`` is all zeros at rest and belongs to the law
alone: what a law needs of earlier samples (a position to take a difference of) it keeps there. ``math.floor``
and ``int`` give integers: multiply by 1.0 where a float is meant. Divide by nothing that can be 0. The modes
of `signals.MODE` are served by the law too: the scenario
``velocity`` and the tuning procedures need VELOCITY_LOOP, the commands of a tune OUTPUT_TEST.

Units: the axis unit u (mm or deg) and s everywhere inside; the parameters p are the law's own business.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.schema import (
    NO_MOTION,
    MotionFacts,
    load_part,
    load_schema,
    registered_families,
    registration_of,
    why_not_simulated,
)

from .command.events import RAMPS, Ramp
from .errors import SimulationError

if TYPE_CHECKING:
    # A picture of the loops binds an axis and runs nothing: it loads neither numpy nor the scenarios.
    import numpy as np
    import numpy.typing as npt

    from .axis_parameters import AxisParameters, ParameterValue
    from .cam import CamForm
    from .command.events import Handwheel, Homing, Jogging, Travel
    from .engine.compiled import Sample
    from .engine.machine import Machine
    from .machine_test import MachineTest
    from .probing import Probing
    from .scenario import Scenario
    from .spindle import Gear, Spindle, Tapping
    from .trace import Recommendation, Trace
    from .zones import Zone

FAULTS = ("drive", "feedback")
"""Faults of a machine: a drive that has tripped, and a position device that is lost."""
Leader = Callable[["AxisLaw"], "Mapping[str, npt.NDArray[np.float64]]"]


@dataclass(frozen=True)
class Source:
    """The parameter behind a figure of the axis."""

    parameter: str
    scale: float = 1.0
    """Factor from this figure to the value in the file."""
    unit: str | None = None
    """Unit of the value in the file if it differs from the unit of the figure."""
    whole: bool = False
    """Whether the value in the file is a whole number."""
    largest: float = math.inf
    """Upper bound in the file."""
    page: str = ""
    """Page of the manual."""


@dataclass(frozen=True)
class LoopFilter:
    """A filter of the control inside of its loops, which the solver sets with the gains."""

    frequency: str
    """Figure of ``sources``: the cutoff, or the middle of a notch, in Hz."""
    highest: float
    """Hz: the most that the manual has a use for. A cutoff there takes nothing out."""
    lowest: float = 0.0
    """Hz: the least that is tried."""
    width: str = ""
    """Figure of ``sources``: the width of a notch in Hz; "" for a low-pass."""


@dataclass(frozen=True)
class AlarmText:
    """An alarm of the control."""

    code: str
    """As the control shows it; after a colon at its end comes the name of the axis."""
    message: str
    """One sentence with the limit and its parameter."""


@dataclass(frozen=True)
class Prediction:
    """A figure that the manual's own equation gives, to compare with the motion."""

    value: float | None
    """None where it is never reached."""
    unit: str
    page: str
    """Page of the equation."""


@dataclass(frozen=True)
class AxisLaw:
    """One axis of a family, bound from the values of a file. Lengths in u, times in s, velocities in u/s."""

    axis: str
    unit: str
    """mm or deg."""
    title: str
    """The control and its loops in one line."""
    position_sample: Sample
    velocity_sample: Sample | None
    parameters: Sequence[float]
    """The ``p`` of the sample functions."""
    state_size: int
    """Length of ``s``."""
    servo_period: float
    """s"""
    velocity_period: float
    """s; the servo period where there is no faster loop. The servo period is a whole multiple of it."""
    machine: Machine
    output_unit: str
    """Unit of the output: %, V, points ..."""
    position_rate: float
    """1/s: commanded velocity for a following error at rest; what times to wait and settle are measured
    by."""
    feedrate: float | None
    """u/s of a move when none is given: the rapid feedrate. None where it is not set."""
    inposition_band: float = 0.0
    """u"""
    rest_band: float = 0.0
    """u: how far from the end dry friction may keep the axis for ever; a move is over within it."""
    ramps: Mapping[str, Ramp] = field(default_factory=lambda: {"none": Ramp()})
    """The ramps that a move can have by kind; the first is the axis' own for positioning."""
    monitors: Sequence[tuple[str, str]] = ()
    """Name and unit of the columns that the law writes from MONITOR on."""
    alarms: Mapping[int, AlarmText] = field(default_factory=dict)
    """Number in STOP -> the alarm."""
    faults: Mapping[str, AlarmText] = field(default_factory=dict)
    """One of FAULTS -> what the control shows when it is informed of it; without it no page prints how."""
    predict: Callable[[float], Mapping[str, Prediction]] = lambda _feedrate: {}
    """predict(feedrate in u/s) -> figures by name;
    ``steady_following_error`` and others that the motion is compared with."""
    circle_feedrate: Callable[[float], float | None] = lambda _radius: None
    """circle_feedrate(radius in u) -> the highest feedrate in u/s that the control allows on a circle;
    None for no limit."""
    manual_ramp: Callable[[bool], Ramp] | None = None
    """manual_ramp(whether the axis is being homed) -> the ramp of homing and jogging;
    None for that of positioning."""
    homing: Callable[[], Homing] | None = None
    jogging: Callable[[], Jogging] | None = None
    travel: Callable[[], Travel] | None = None
    handwheel: Callable[[str], Handwheel] | None = None
    """handwheel(number of one, "" for the first) -> how it moves the axis.
    Read when a scenario asks for it; raises SimulationError naming what is missing.
    None where no manual prints it."""
    undamped: str = ""
    """What to do first if the loop is not stable, a sentence;
    "" where the law knows nothing better than lower gains."""
    ordered_by: tuple[str, str] | None = None
    """The axis whose orders move this one too, and the page; None for an axis that has its own orders."""
    brakes: float = 0.0
    """s for which the drive brakes at an emergency stop, before it is without torque; 0 where it has none at
    once."""
    limits: Mapping[str, float] = field(default_factory=dict)
    """Limits of the following error in u, to draw beside the curves."""
    stops_at: str = ""
    """The one of ``limits`` at which the control ends a motion in an alarm; "" where none does."""
    sources: Mapping[str, Source] = field(default_factory=dict)
    """Figure -> its parameter."""
    follow: Callable[[AxisLaw], Sequence[Recommendation]] = lambda _axis: ()
    """follow(axis) -> what has to follow other gains: feed-forward, limits of the following error."""
    gains: Sequence[str] = ("position_gain",)
    """Figures of ``sources`` that close the loops, from the inner loop outwards: what the solver seeks."""
    filters: Sequence[LoopFilter] = ()
    """Filters in the loops that the solver may set beside them."""
    assumptions: tuple[str, ...] = ()
    """What is assumed about the control, each a sentence with its page."""
    assumed: Mapping[str, str] = field(default_factory=dict)
    """Figure of the machine that no parameter gives -> why it has its value;
    dropped when it is set by ``model.*``."""
    settled: Callable[[AxisLaw], AxisLaw] | None = None
    """settled(axis) -> the axis with what follows from its parameters and its machine together: position
    rate, rest band, predicted figures. Asked for whenever the machine is another; None where nothing does."""
    after: Callable[[AxisLaw, Leader], AxisLaw] | None = None
    """after(axis, run) -> the axis, for one that goes by the motion of another: run(other) moves that one
    first under the same command, and returns its columns at the servo samples."""
    push: Sequence[float] = ()
    """Torque on the load at each servo sample, from outside of the axis; the last one goes on. () for
    none."""
    sweep_parameters: Sequence[float] | None = None
    """The ``p`` of a swept sine, without the faults that its start would raise; None for the same."""
    linear_parameters: Sequence[float] | None = None
    """The ``p`` of the linear model (without quantisation, deadband, stiction terms); None for the same."""

    def refuse_unknown_fault(self, kind: str) -> None:
        """Raise SimulationError for a fault that cannot be simulated: an unknown one, or lost feedback where
        no page prints what the control does.
        """
        if kind not in FAULTS:
            raise SimulationError(f"move.fault is '{kind}'; it must be {' or '.join(FAULTS)}", "move.fault")
        if kind != "drive" and kind not in self.faults:
            raise SimulationError(
                f"What axis {self.axis} does without its feedback is in no manual here", "move.fault"
            )


def _no_recommendation(_law: AxisLaw, _trace: Trace) -> Sequence[Recommendation]:
    return ()


@dataclass(frozen=True)
class Law:
    """The record of a family (``law="module:LAW"``).

    ``bind``       one axis from a file; raises SimulationError naming the parameter
    ``axes``       the axes of a file that can be simulated
    ``advise``     the family's own recommendations after a scenario
    ``own``        own() -> scenarios of the family alone, by name; they are loaded when one is asked for
    ``spindle``    spindle(values of the machine, its number) -> the spindle; None where no output to one is
                   printed
    ``tapping``    tapping(machine, spindle, gear, axis, pitch) -> how both follow each other; None where it
                   is not printed
    ``probing``    probing(values of the machine, axis, which cycle) -> how a probe is met
    ``machine_tests``  machine_tests(machine, axis) -> programs and procedures that try an axis out
    ``motion``     the facts of ``motion.yaml``, which `law_of` puts here
    ``zones``      zones(machine, axes) -> areas that axes must not enter or leave
    ``cam``        how files contain cam profiles; None where no page prints one
    ``path``       ``module:function`` of path(machine) -> how a program goes along its path, loaded when a
                   program is run; "" where no page prints enough
    """

    bind: Callable[[AxisParameters], AxisLaw]
    axes: Callable[[ParameterFile], Sequence[str]] = fitted_axes
    advise: Callable[[AxisLaw, Trace], Sequence[Recommendation]] = _no_recommendation
    own: Callable[[], Mapping[str, Scenario]] = dict
    spindle: Callable[[AxisParameters, str], Spindle] | None = None
    tapping: Callable[[BoundMachine, Spindle, Gear, AxisLaw, float], Tapping] | None = None
    probing: Callable[[AxisParameters, AxisLaw, str], Probing] | None = None
    zones: Callable[[BoundMachine, Sequence[str]], Iterable[Zone]] | None = None
    machine_tests: Callable[[BoundMachine, AxisLaw], Sequence[MachineTest]] | None = None
    path: str = ""
    cam: CamForm | None = None
    motion: MotionFacts = NO_MOTION


@dataclass(frozen=True)
class BoundMachine:
    """A machine of a file for scenarios that are not about one axis: its axes, made when they are asked for,
    and its other values.
    """

    law: Law
    chosen: tuple[str, ...]
    """Axes that were asked for, by themselves; () for none."""
    fitted: tuple[str, ...]
    bind: Callable[[str | None, Mapping[str, ParameterValue]], AxisLaw]
    """bind(axis, further values by parameter id) -> the axis; raises SimulationError."""
    read: Callable[[str], AxisParameters]
    """The values of an axis, or of the machine for ""."""
    letter: Callable[[str], str]

    @property
    def parameters(self) -> AxisParameters:
        """The values that belong to no axis."""
        return self.read("")

    def axis(self, name: str | None = None) -> AxisLaw:
        """Return an axis: that of the name or letter, else the first one that was asked for,
        else the first of the machine.
        """
        chosen = name or (self.chosen[0] if self.chosen else None)
        if chosen is not None and chosen not in self.fitted:
            chosen = next((each for each in self.fitted if self.letter(each) == chosen.upper()), chosen)
        return self.bind(chosen, {})

    def one_chosen(self, scenario: str) -> str | None:
        """Return the axis that was asked for, None for none; raises SimulationError for several."""
        if len(self.chosen) > 1:
            raise SimulationError(f"{scenario} takes one axis, not {', '.join(self.chosen)}")
        return self.chosen[0] if self.chosen else None


def simulated_families() -> tuple[str, ...]:
    """Return the families whose law is known."""
    return tuple(family for family in registered_families() if registration_of(family).law)


def law_of(family: str) -> Law:
    """Return the law of a family's axes; raises SimulationError where there is none."""
    place = registration_of(family).law
    if not place:
        known = ", ".join(sorted(simulated_families()))
        raise SimulationError(f"{why_not_simulated(load_schema(family).family)} Simulated are: {known}")
    found = load_part(place)
    assert isinstance(found, Law)
    return replace(found, motion=load_schema(family).motion)


__all__ = [
    "RAMPS",
    "AlarmText",
    "AxisLaw",
    "BoundMachine",
    "Law",
    "LoopFilter",
    "Prediction",
    "Ramp",
    "Source",
    "law_of",
    "simulated_families",
]
