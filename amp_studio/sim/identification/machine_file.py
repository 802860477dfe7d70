"""The machine of one axis as a YAML file: what ``model.*`` settings describe, kept for the next simulation.

    family: 9pc
    axis: X
    torque: "%"                  # the unit of the torques below
    model:
      acceleration_per_output: 41.5 mm/s2
      viscous_friction: "0.35"

Each entry of ``model`` is a setting as ``--set model.NAME=`` takes it;
``identified`` is where they come from, and is not read.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from amp_studio.files import Notify, ParameterFile, scalar_text, text_of_name, write_atomic
from amp_studio.schema import FileError, axis_name, read_yaml_file
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import law_of
from amp_studio.sim.model import torque_unit
from amp_studio.sim.rounding import value_text
from amp_studio.sim.trace import Trace

from .identify import figure_text, machine_settings

_KEYS = ("family", "axis", "torque", "model", "identified")
_MAX_BYTES = 2**18
_LONGEST = 60
"""Characters of a value."""


@dataclass(frozen=True)
class MachineFile:
    """What a file describes: the settings of one axis of a family, torques in a unit."""

    name: str
    family: str
    axis: str
    torque: str
    settings: dict[str, str] = field(default_factory=dict)
    """``model.*`` -> value."""


def read_machine(path: Path) -> MachineFile:
    """Read the description of a machine; raises SimulationError for what is none,
    OSError where it cannot be read.
    """
    try:
        data = read_yaml_file(path, FileError, most=_MAX_BYTES).data
    except FileError as error:
        raise SimulationError(str(error)) from None
    name = text_of_name(path.name)
    if not isinstance(data, dict) or not isinstance(data.get("model"), dict):
        raise SimulationError(f"{name} describes no machine: it has no 'model'")
    for key in data:
        if key not in _KEYS:
            raise SimulationError(
                f"{name}: '{str(key)[:40]}' is no entry of a machine. Known: {', '.join(_KEYS)}"
            )
    texts = {key: _text(name, key, data.get(key)) for key in ("family", "axis", "torque")}
    settings = {f"model.{key}": _text(name, str(key), value) for key, value in data["model"].items()}
    return MachineFile(name, **texts, settings=settings)


def _text(name: str, key: str, value: Any) -> str:
    text = str(value)
    # A bool is an int in Python, and YAML reads "yes" as one.
    is_scalar = isinstance(value, (str, int, float)) and not isinstance(value, bool)
    if not is_scalar or len(text) > _LONGEST or not text.isprintable():
        raise SimulationError(f"{name}: '{' '.join(key.split())[:40]}' must be a number or a short text")
    return text


def machine_for(file: ParameterFile, machine: MachineFile, axis: str | None) -> tuple[str, dict[str, str]]:
    """Return the axis that a machine is of and its settings;
    raises SimulationError for a machine that does not fit.
    """
    family = file.schema.family.family
    if machine.family != family:
        raise SimulationError(f"{machine.name} is of family {machine.family}, and the file of {family}")
    bound = bind_axis(file, law_of(family), axis or machine.axis)
    letter = axis_name(file.evaluation, bound.axis) or bound.axis
    if machine.axis.upper() not in (bound.axis.upper(), letter.upper()):
        raise SimulationError(
            f"{machine.name} is of axis {machine.axis}, not of {letter}: identify that axis too"
        )
    if machine.torque != torque_unit(bound):
        raise SimulationError(
            f"{machine.name} has torques in {machine.torque}, and axis {letter} has them in"
            f" {torque_unit(bound)}: identify it again"
        )
    return bound.axis, machine.settings


def machine_text(trace: Trace, family: str) -> str:
    """Return what `identify` found as the text of a file."""
    axis, torque = trace.letter or trace.axis, trace.result["viscous_friction"][1]
    figures = [(name.removeprefix("model."), text) for name, text in machine_settings(trace).items()]
    result = dict(trace.result)
    found = [
        ("record", trace.model),
        *((name, figure_text(result, name)) for name in result if f"{name}_standard_error" in result),
        *(
            (name, value_text(result[name][0] or 0.0, digits=5))
            for name in ("r_squared", "misfit")
            if name in result
        ),
    ]
    return "\n".join(
        [
            f"# The machine of axis {axis}, as the record of its drive shows it, to simulate with.",
            f"family: {scalar_text(family)}",
            f"axis: {scalar_text(axis)}",
            f"torque: {scalar_text(torque)}",
            "model:",
            *(f"  {name}: {scalar_text(text)}" for name, text in figures),
            "identified:  # with standard errors",
            *(f"  {name}: {scalar_text(text)}" for name, text in found),
            "",
        ]
    )


def write_machine(trace: Trace, family: str, path: Path, notify: Notify = lambda _note: None) -> None:
    """Write what `identify` found, whole or not at all; raises SaveError where it cannot."""
    write_atomic(path, machine_text(trace, family).encode(), keep_backup=False, notify=notify)
