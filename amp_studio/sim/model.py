"""The settings of the machine, ``model.*``, that every simulated axis has."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from .axis_parameters import AxisParameters
from .engine.machine import Machine
from .errors import SimulationError
from .law import AxisLaw
from .rounding import value_text

AT_SPEED = 60.0 / 1000.0
"""1 unit of torque at 1000 u/min as torque for 1 u/s."""

_FIGURES: dict[str, tuple[str, float, str, str]] = {
    "model.acceleration_per_output": (
        "acceleration_per_output",
        1.0,
        "{u}/s2 for 1 {torque}",
        "acceleration for one unit of torque (mm/s2 or deg/s2 per torque)",
    ),
    "model.inertia_ratio": (
        "inertia_ratio",
        1.0,
        "",
        "inertia of the load / inertia of the motor; with model.resonance or model.backlash",
    ),
    "model.viscous_friction": (
        "viscous_friction",
        AT_SPEED,
        "{torque} at 1000 {u}/min",
        "friction at 1000 mm/min or deg/min (torque)",
    ),
    "model.coulomb_friction": ("coulomb_friction", 1.0, "{torque}", "dry friction in motion (torque)"),
    "model.static_friction": ("static_friction", 1.0, "{torque}", "dry friction at rest (torque)"),
    "model.motor_friction": ("motor_friction", 1.0, "", "share of the friction on the motor's side, 0 to 1"),
    "model.backlash": ("backlash", 1.0, "{u}", "backlash (mm or deg)"),
    "model.resonance": ("resonance", 1.0, "Hz", "resonance of motor and load (Hz); 0 for a rigid axis"),
    "model.damping": ("damping", 1.0, "", "damping ratio of the resonance"),
    "model.gravity": (
        "gravity",
        1.0,
        "{torque}",
        "torque that balances the weight (torque); above 0 it falls to -",
    ),
    "model.brake": ("brake", 1.0, "{torque}", "torque of a brake that closes at an alarm (torque)"),
    "model.spring": (
        "spring",
        1.0,
        "{torque} for 1 {u}",
        "torque for 1 mm or 1 deg away from the start (torque)",
    ),
    "model.current_bandwidth": (
        "bandwidth",
        1.0,
        "Hz",
        "bandwidth of the current loop (Hz); 0 for an ideal one",
    ),
    "model.velocity_bandwidth": (
        "velocity_bandwidth",
        1.0,
        "Hz",
        "bandwidth of the velocity loop in the drive (Hz)",
    ),
    "model.velocity_integral": (
        "velocity_integral",
        1.0,
        "1/s",
        "reciprocal of the integral time of the velocity loop in the drive (1/s); 0 for none",
    ),
    "model.delay": ("delay", 1e-3, "ms", "time from a sample to its effect on the drive (ms)"),
}
"""Setting -> figure of the machine, factor to it, its unit ({u} the axis' own, {torque} that of its torque),
what it is."""


def model_settings() -> dict[str, str]:
    """Return setting -> what it is."""
    return {name: text for name, (_, _, _, text) in _FIGURES.items()}


def with_model(axis: AxisLaw, read: AxisParameters) -> AxisLaw:
    """Return the axis with the machine as the settings have it; what is set is no longer assumed."""
    given = {name: value for name in _FIGURES if (value := read.optional(name)) is not None}
    changes = {_FIGURES[name][0]: value * _FIGURES[name][1] for name, value in given.items()}
    _refuse_of_velocity(axis, changes)
    assumed = {figure: why for figure, why in axis.assumed.items() if figure not in changes}
    machine = replace(axis.machine, **changes)  # type: ignore[arg-type]  # none of them is the flag
    # Refused, not passed over: without a second mass the ratio has no effect, and that looks like a result.
    if "inertia_ratio" in changes and not machine.two_masses:
        name = "model.inertia_ratio"
        raise SimulationError(
            f"{name} divides an axis in motor and load, and axis {axis.axis} is one rigid mass: give"
            " model.resonance or model.backlash too",
            name,
        )
    if machine.two_masses:
        machine = _coupled(machine, assumed)
    found = replace(axis, machine=machine, assumed=assumed)
    # Rates and predicted figures depend on gains and machine together: those of the old machine are wrong
    # now.
    return found if axis.settled is None else axis.settled(found)


def _refuse_of_velocity(axis: AxisLaw, changes: Iterable[str]) -> None:
    """Refuse figures of a drive with a velocity loop where it gives a torque."""
    for own in ("velocity_bandwidth", "velocity_integral"):
        if own in changes and axis.machine.velocity_per_output == 0.0:
            name = f"model.{own}"
            raise SimulationError(f"{name} does not fit axis {axis.axis}: its drive gives a torque", name)


def _coupled(machine: Machine, assumed: dict[str, str]) -> Machine:
    """Return a machine of two masses with the figures that it is simulated with;
    those that are not given go to ``assumed``.
    """
    frequency, damping, ratio = machine.coupling
    if machine.resonance == 0.0:
        assumed["resonance"] = (
            "Backlash without a resonance: motor and load in contact are taken as that stiff."
        )
        assumed["damping"] = "The contact adds no further oscillation."
    if machine.damping is None and machine.resonance > 0.0:
        assumed["damping"] = "The damping ratio of the resonance is not given."
    if machine.damping is not None:
        assumed.pop("damping", None)
    if machine.inertia_ratio == 0.0:
        assumed["inertia_ratio"] = "Motor and load are taken as equal masses."
    return replace(machine, resonance=frequency, damping=damping, inertia_ratio=ratio)


def present_setting(axis: AxisLaw, name: str) -> tuple[float, str]:
    """Return the value and the unit of a setting of the machine as the axis has it."""
    figure, factor, unit, _ = _FIGURES[name]
    value = getattr(axis.machine, figure)
    return (0.0 if value is None else value / factor), unit.format(u=axis.unit, torque=torque_unit(axis))


def torque_unit(axis: AxisLaw) -> str:
    """Return the unit of a torque of the machine: that of the output,
    % of rated torque behind a drive with a velocity loop.
    """
    return "%" if axis.machine.velocity_per_output > 0.0 else axis.output_unit


def assumptions(axis: AxisLaw) -> tuple[str, ...]:
    """Return all that is assumed about an axis: the control,
    then the figures of its machine with the way to set them.
    """
    return (*axis.assumptions, *(_assumption(axis, figure, why) for figure, why in axis.assumed.items()))


def _assumption(axis: AxisLaw, figure: str, why: str) -> str:
    torque = torque_unit(axis)
    for name, (own, factor, unit, _) in _FIGURES.items():
        if own == figure:
            given = unit.format(u=axis.unit, torque=torque)
            value = value_text(getattr(axis.machine, figure) / factor, given, 6)
            return f"ASSUMED: {name} = {value}. {why}"
    return f"ASSUMED: {why}"
