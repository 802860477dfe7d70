"""The simulation: how an axis moves with its parameters, before the machine moves.

`bind.axis_servo` reads the data of an axis from a parameter file (any callable that returns values by parameter id),
`step.run_step` simulates a move, `write` writes the trace to files. `SCENARIOS` contains one entry for each scenario, a
single call from file to trace. Ids of a control family are in that family's law only. Every modelling assumption is
documented where it is made, is part of each trace, and is
listed in docs/simulation.md.
"""

from __future__ import annotations

from .axis_parameters import MotorGains, ParameterValue, ReadParameter
from .bind import axis_servo
from .law import Law, law_of, simulated_families
from .scenarios import SCENARIOS, Scenario
from .servo import AxisServo, SimulationError, Source
from .simulate import simulate
from .step import StepMove, default_move, run_step
from .svg import plot_svg
from .trace import Alarm, Figure, Recommendation, Trace
from .write import plot_png, trace_csv, trace_summary, trace_text, write_trace

__all__ = [
    "SCENARIOS",
    "Alarm",
    "AxisServo",
    "Figure",
    "Law",
    "MotorGains",
    "ParameterValue",
    "ReadParameter",
    "Recommendation",
    "Scenario",
    "SimulationError",
    "Source",
    "StepMove",
    "Trace",
    "axis_servo",
    "default_move",
    "law_of",
    "plot_png",
    "plot_svg",
    "run_step",
    "simulate",
    "simulated_families",
    "trace_csv",
    "trace_summary",
    "trace_text",
    "write_trace",
]
