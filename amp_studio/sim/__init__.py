"""The simulation: how an axis moves with its parameters, before the machine moves.

`run.simulate` is the single call from an open file to a trace. A family brings its law (`law.py`: two sample functions and
the figures of an axis, bound from a file); the rest knows no family: the machine (`machine.py`, `plant.py`), the command
(`profiles.py`, `ramps.py`), the loop over both (`kernel.py`, `compiled.py`, `motion.py`), the scenarios, and what is written
(`write.py`). Every assumption is documented where it is made, is part of each trace, and is listed in docs/simulation.md.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from . import one_thread as one_thread
from .errors import SimulationError

if TYPE_CHECKING:
    from .axis_parameters import AxisParameters, ParameterValue, ReadParameter
    from .identification import identified_text, identify, machine_settings
    from .law import AlarmText, AxisLaw, Law, Prediction, Ramp, Source, law_of, simulated_families
    from .listings import SimulationListing, listing
    from .machine import Machine
    from .machine_file import machine_for, machine_text, read_machine, write_machine
    from .model import model_settings
    from .run import bind_axis, simulate, simulated_axes
    from .scenarios import SCENARIOS, Scenario
    from .svg import plot_svg
    from .trace import Alarm, Figure, Recommendation, Trace, titled
    from .trial import address_of, named_parameter
    from .write import plot_png, trace_csv, trace_summary, trace_text, write_trace

_PLACES = {
    "Alarm": "trace",
    "AlarmText": "law",
    "AxisLaw": "law",
    "AxisParameters": "axis_parameters",
    "Figure": "trace",
    "Law": "law",
    "Machine": "machine",
    "ParameterValue": "axis_parameters",
    "Prediction": "law",
    "Ramp": "law",
    "ReadParameter": "axis_parameters",
    "Recommendation": "trace",
    "SCENARIOS": "scenarios",
    "Scenario": "scenarios",
    "SimulationListing": "listings",
    "Source": "law",
    "Trace": "trace",
    "address_of": "trial",
    "bind_axis": "run",
    "identified_text": "identification",
    "identify": "identification",
    "law_of": "law",
    "listing": "listings",
    "machine_for": "machine_file",
    "machine_settings": "identification",
    "machine_text": "machine_file",
    "model_settings": "model",
    "named_parameter": "trial",
    "plot_png": "write",
    "plot_svg": "svg",
    "read_machine": "machine_file",
    "simulate": "run",
    "simulated_axes": "run",
    "simulated_families": "law",
    "titled": "trace",
    "trace_csv": "write",
    "trace_summary": "write",
    "trace_text": "write",
    "write_machine": "machine_file",
    "write_trace": "write",
}
"""Name -> its module; loaded when it is first asked for: a drawn ramp needs no numpy."""


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    found = globals()[name] = getattr(import_module(f".{_PLACES[name]}", __name__), name)
    return found


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
