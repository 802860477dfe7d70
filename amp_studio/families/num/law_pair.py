"""Synchronised axis pairs: a driven axis that is kept in step with its drive axis (4-30, 6-30)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from amp_studio.sim import AlarmText, AxisLaw, AxisParameters, Leader, Prediction, SimulationError

from . import law_sample as sample
from .law_facts import ids

_BASIC_CORRECTION = 250.0
"""Thousandths of the error that are given back, the basic value (6-30)."""


def drive_axis(read: AxisParameters) -> str | None:
    """Return the address of the drive axis of a driven one (P27), None for an axis on its own."""
    leader = read.value(ids.drive_axis)
    return None if leader in (None, "none") else str(leader).removeprefix("axis-")


def is_synchronised(read: AxisParameters) -> bool:
    """Return whether P28 has a driven axis corrected."""
    return int(read.optional(ids.axes_synchronised, everywhere=True) or 0.0) >> int(read.axis) & 1 == 1


def synchronised(law: AxisLaw, read: AxisParameters, leader: AxisLaw, length: float) -> AxisLaw:
    """Return the driven axis with correction and threshold 1; ``length`` is the internal unit in u.

    It gets the reference of its drive axis, whose motion is simulated first, and the correction (4-30).
    """
    if leader.unit != law.unit:
        raise SimulationError(
            f"Drive axis {leader.axis} moves in {leader.unit}, driven axis {read.axis} in {law.unit}: they"
            " cannot be synchronised",
            ids.drive_axis,
        )
    correction, threshold = read.optional(ids.sync_correction), read.optional(ids.sync_error)
    p = list(law.parameters)
    p[sample.CORRECTION] = (_BASIC_CORRECTION if correction is None else correction) / 1000.0
    p[sample.SYNC_LIMIT] = math.inf if threshold is None else threshold * length
    text = AlarmText(
        "39", f"The synchronisation error is above threshold 1 (P24N{read.axis}); CN_PRET falls (6-30)."
    )
    note = (
        f"The axis is synchronised with drive axis {leader.axis}, which is simulated first under the same"
        " command and does not feel it; the machine joins the two with no force. ASSUMED: the error is"
        " measured position less measured position (6-30)."
    )
    return replace(
        law,
        ordered_by=(leader.axis, "4-32"),
        parameters=p,
        predict=lambda feedrate: _predicted(law, leader, p[sample.CORRECTION], feedrate),
        feedrate=leader.feedrate,
        ramps=leader.ramps,
        alarms={**law.alarms, int(sample.SYNCHRONISATION): text},
        assumptions=(*law.assumptions, note),
        after=partial(_with_leader, leader),
    )


def _predicted(law: AxisLaw, leader: AxisLaw, share: float, feedrate: float) -> Mapping[str, Prediction]:
    """Return the figures of the driven axis: the correction leaves 1 / (1 + share)
    of the difference of both errors (6-30).
    """
    found = dict(law.predict(feedrate))
    own, other = found["steady_following_error"], leader.predict(feedrate)["steady_following_error"]
    if own.value is not None and other.value is not None:
        apart = (own.value - other.value) / (1.0 + share)
        found["steady_following_error"] = replace(own, value=own.value - share * apart, page="6-30")
        found["synchronisation_error"] = Prediction(apart, law.unit, "6-30")
    return found


def refuse_chain(read: AxisParameters, leader: AxisParameters) -> None:
    """Raise SimulationError for a drive axis that is a driven one or the axis itself."""
    # A table as delivered has 0 in every word: axis 0 "driven" by itself is not coupled (P28).
    if leader.axis == read.axis or drive_axis(leader) not in (None, leader.axis):
        raise SimulationError(
            f"Drive axis {leader.axis} of axis {read.axis} is a driven axis itself (P27)", ids.drive_axis
        )


def _with_leader(leader: AxisLaw, axis: AxisLaw, run: Leader) -> AxisLaw:
    """Return the axis with the measured positions of its drive axis, sample by sample."""
    # Measured ones: the driven axis compares encoders, not references (6-30).
    positions = run(leader)["measured_position"]
    # The kernel takes flat arrays alone, so the motion of the leader goes behind the parameters.
    p = [*axis.parameters[: sample.PARAMETERS], *positions]
    p[sample.LEADER] = float(len(positions))
    return replace(axis, parameters=p, after=None)
