"""The machine of an axis out of its frequency response,
as a trace with a Bode picture and as settings of the simulator.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from amp_studio.files import ParameterFile
from amp_studio.scenarios import IDENTIFY
from amp_studio.schema import axis_name
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw, law_of
from amp_studio.sim.model import AT_SPEED, torque_unit
from amp_studio.sim.rounding import value_text
from amp_studio.sim.series import Response
from amp_studio.sim.trace import Figure, Recommendation, Trace
from amp_studio.sim.unit_system import in_unit, length_unit

from .drive_record import read_drive_record, speed_factor, torque_figure
from .friction import even_record
from .identify import record_scale
from .plant_fit import QUANTITIES, Pair, PlantFit, fit_plant
from .response import FrequencyResponse, is_response, read_response, response_of_record

DOUBTFUL_ERROR, DOUBTFUL_MISFIT = 0.1, 0.12
"""Share of a figure that its standard deviation is, and Np or rad that are left, from which there is a
doubt."""
SEEN = 2.0
"""Standard deviations from which a friction is there."""
_DRY = (
    "Viscous friction and damping have the dry friction in them, which a response does not show and which"
    " takes up to a tenth off the acceleration: take the friction from a record of moves"
)
_NOT_LINEAR = (
    "Noise does that, and so does an axis that is not linear: backlash makes resonance and inertia ratio"
    " depend on the amplitude"
)
NOTCH_DAMPING = 0.5
"""Damping ratio of the poles of a notch: an octave wide, usual."""


def identify_response(
    file: ParameterFile,
    path: Path,
    axis: str | None = None,
    scale: str | None = None,
    system: str | None = None,
    quantity: str | None = None,
    turn: str | None = None,
) -> Trace:
    """Return the figures of an axis' machine out of a response (CSV of frequency, gain, phase, coherence)
    or the record of a chirp.

    A gain is motion in u/s or u (u/s² for an acceleration) for 1 of the torque; ``scale`` is the torque of
    the response for 1 of the simulator's unit. Raises SimulationError, OSError.
    """
    law = law_of(file.schema.family.family)
    if "velocity" not in law.motion.scenarios:
        raise SimulationError(
            f"{file.schema.family.name} has stepper motors without a servo loop: it has no torque to identify"
        )
    if quantity is not None and quantity not in QUANTITIES:
        raise SimulationError(f"'{quantity}' is no motion of a response: {', '.join(QUANTITIES)}")
    bound = bind_axis(file, law, axis)
    if is_response(path):
        found = read_response(path)
        if scale is not None:
            found = FrequencyResponse(
                found.frequency, found.response * torque_figure(scale)[0], found.coherence, found.left_out
            )
    else:
        found, quantity = _of_record(path, bound, scale, turn)
    fitted = fit_plant(found, quantity)
    letter = axis_name(file.evaluation, bound.axis)
    return in_unit(_trace(found, fitted, bound, path, letter), length_unit(file, system))


def _of_record(
    path: Path, bound: AxisLaw, scale: str | None, turn: str | None
) -> tuple[FrequencyResponse, str]:
    """Return the response in the record of a chirp, and of which quantity it is."""
    record = read_drive_record(path)
    torque, factor = (
        record.torque / record_scale(record, bound, scale),
        speed_factor(record, bound.unit, turn),
    )
    motion = record.velocity if record.velocity is not None else record.position
    assert motion is not None
    time, (moved, driven) = even_record(record.time, motion * factor, torque)
    by = ("velocity", 1) if record.velocity is not None else ("position", 2)
    return response_of_record(float(time[1] - time[0]), driven, moved, by[1]), by[0]


def _trace(response: FrequencyResponse, fitted: PlantFit, bound: AxisLaw, path: Path, letter: str) -> Trace:
    """Return the measured and the fitted response as a trace, with the figures of the machine."""
    columns = {
        "frequency_hz": response.frequency,
        "plant_gain_db": _db(response.response),
        "plant_phase_deg": _phase(response.response),
        "plant_gain_db_model": _db(fitted.model),
        "plant_phase_deg_model": _phase(fitted.model),
    }
    units = {"frequency_hz": "Hz", **{name: "dB" if "gain" in name else "deg" for name in list(columns)[1:]}}
    if response.coherence is not None:
        columns["coherence"], units["coherence"] = response.coherence, ""
    side = "the load" if fitted.at_load else "the motor"
    return Trace(
        scenario=IDENTIFY,
        axis=bound.axis,
        letter=letter,
        model=(
            f"{path.name}: {len(response.frequency)} frequencies from"
            f" {value_text(float(response.frequency[0]), 'Hz', 3)} to "
            f"{value_text(float(response.frequency[-1]), 'Hz', 3)},"
            f" the {fitted.quantity} of {side}"
        ),
        columns=columns,
        units=units,
        result=_result(response, fitted, bound),
        recommendations=_notches(fitted.pairs),
        assumptions=_assumed(fitted, bound),
        doubts=tuple(_doubts(response, fitted)),
    )


def _db(response: Response) -> np.ndarray:
    return np.asarray(20.0 * np.log10(np.abs(response)))


def _phase(response: Response) -> np.ndarray:
    phase = np.degrees(np.unwrap(np.angle(response)))
    # An unwrapped phase is open by whole turns: the lowest frequency is put between -270° and 90°.
    return np.asarray(phase - 360.0 * round((float(phase[0]) + 90.0) / 360.0))


def _result(response: FrequencyResponse, fitted: PlantFit, bound: AxisLaw) -> dict[str, Figure]:
    """Return the fitted figures in the units of the settings, each with its standard error."""
    torque = torque_unit(bound)
    scales = {
        "acceleration_per_output": (1.0, f"{bound.unit}/s2"),
        "viscous_friction": (1.0 / AT_SPEED, torque),
        "delay": (1e3, "ms"),
        "resonance": (1.0, "Hz"),
        "damping": (1.0, ""),
        "inertia_ratio": (1.0, ""),
    }
    result: dict[str, Figure] = {}
    for name, (value, error) in fitted.figures.items():
        factor, unit = scales[name]
        result[name], result[f"{name}_standard_error"] = (value * factor, unit), (error * factor, unit)
    for n, pair in enumerate(fitted.pairs, 1):
        result[f"resonance_{n}"], result[f"resonance_{n}_damping"] = (
            (pair.resonance, "Hz"),
            (pair.damping, ""),
        )
        result[f"antiresonance_{n}"] = (pair.antiresonance, "Hz")
    result["misfit"] = (100.0 * fitted.misfit, "%")
    result["frequencies"] = (float(len(response.frequency)), "")
    result["left_out"] = (float(response.left_out), "")
    if response.coherence is not None:
        result["least_coherence"] = (float(response.coherence.min()), "")
    return result


def _notches(pairs: tuple[Pair, ...]) -> tuple[Recommendation, ...]:
    """Return a notch for each resonance that rings: zeros on its poles."""
    return tuple(
        Recommendation(
            "notch",
            round(pair.resonance, 1),
            "Hz",
            f"a resonance with a damping ratio of {value_text(pair.damping, digits=2)}: zeros with "
            "this damping,"
            f" poles with {NOTCH_DAMPING:g}, where the control or its drive has a notch.",
            f"Phase is lost below it: {value_text(_lost(pair), 'deg', 2)} at half of its frequency.",
        )
        for pair in pairs
        if pair.damping < NOTCH_DAMPING
    )


def _lost(pair: Pair) -> float:
    """Return the phase in deg that a notch takes at half of its frequency."""
    x = 0.5
    zeros, poles = (math.atan2(2.0 * each * x, 1.0 - x * x) for each in (pair.damping, NOTCH_DAMPING))
    return math.degrees(poles - zeros)


def _assumed(fitted: PlantFit, bound: AxisLaw) -> tuple[str, ...]:
    """Return what the fit takes for given."""
    unit = {"position": bound.unit, "velocity": f"{bound.unit}/s", "acceleration": f"{bound.unit}/s2"}[
        fitted.quantity
    ]
    notes = [
        (
            f"The gain is taken as {unit} for 1 {torque_unit(bound)} of torque; its slope and phase are those"
            f" of a {fitted.quantity}."
        )
    ]
    if fitted.figures["delay"][0] > 0.0:
        notes.append(
            "Whatever lags in proportion to the frequency is in the delay: computing, current loop, filters"
            " of the measurement."
        )
    if fitted.at_load and fitted.pairs:
        notes.append(
            "The motion is that of the load behind its resonance: the inertia ratio cannot be seen in it."
        )
    if len(fitted.pairs) > 1:
        notes.append("The machine of the simulator has one resonance: the first one goes to model.resonance.")
    return tuple(notes)


def _doubts(response: FrequencyResponse, fitted: PlantFit) -> list[str]:
    doubts = []
    if not fitted.sure:
        doubts.append(f"Another motion than the {fitted.quantity} would fit about as well: give the motion")
    if response.left_out:
        doubts.append(f"{response.left_out} frequencies were left out, their coherence is below 0.8")
        doubts.append(_NOT_LINEAR)
    friction, error = fitted.figures["viscous_friction"]
    if friction > SEEN * error:
        doubts.append(_DRY)
    if fitted.misfit > DOUBTFUL_MISFIT:
        doubts.append(
            f"{value_text(100.0 * fitted.misfit, '%', 2)} of the response are left on average; look "
            "at the picture"
            " of the fit"
        )
    for name, (value, error) in fitted.figures.items():
        if name != "viscous_friction" and error > DOUBTFUL_ERROR * abs(value):
            doubts.append(
                f"{name.replace('_', ' ').capitalize()} is known to"
                f" {value_text(100.0 * error / abs(value) if value else 100.0, '%', 2)} only"
            )
    return doubts
