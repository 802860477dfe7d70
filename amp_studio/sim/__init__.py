"""The simulation: how an axis moves with its parameters, before the machine moves.

`simulate.simulate` is the single call from an open file to a trace. A family brings its law (`law.py`: two sample functions and
the figures of an axis, bound from a file); the rest knows no family: the machine (`machine.py`, `plant.py`), the command
(`profiles.py`, `ramps.py`), the loop over both (`kernel.py`, `compiled.py`, `motion.py`), the scenarios, and what is written
(`write.py`). Every assumption is documented where it is made, is part of each trace, and is listed in docs/simulation.md.
"""

from __future__ import annotations

from . import one_thread as one_thread
from .axis_parameters import AxisParameters, ParameterValue, ReadParameter
from .errors import SimulationError
from .identify import identified_text, identify, machine_settings
from .law import AlarmText, AxisLaw, Law, Prediction, Ramp, Source, law_of, simulated_families
from .listing import SimulationListing, listing
from .machine import Machine
from .machine_file import machine_for, machine_text, read_machine, write_machine
from .model import model_settings
from .scenarios import SCENARIOS, Scenario
from .simulate import bind_axis, simulate, simulated_axes
from .svg import plot_svg
from .trace import Alarm, Figure, Recommendation, Trace, titled
from .trial import address_of, named_parameter
from .write import plot_png, trace_csv, trace_summary, trace_text, write_trace

__all__ = [
    "SCENARIOS",
    "Alarm",
    "AlarmText",
    "AxisLaw",
    "AxisParameters",
    "Figure",
    "Law",
    "Machine",
    "ParameterValue",
    "Prediction",
    "Ramp",
    "ReadParameter",
    "Recommendation",
    "Scenario",
    "SimulationError",
    "SimulationListing",
    "Source",
    "Trace",
    "address_of",
    "bind_axis",
    "identified_text",
    "identify",
    "law_of",
    "listing",
    "machine_for",
    "machine_settings",
    "machine_text",
    "model_settings",
    "named_parameter",
    "plot_png",
    "plot_svg",
    "read_machine",
    "simulate",
    "simulated_axes",
    "simulated_families",
    "titled",
    "trace_csv",
    "trace_summary",
    "trace_text",
    "write_machine",
    "write_trace",
]
