"""What a Grbl or grblHAL reports of itself: state, positions, feed, inputs, alarm (report.c)."""

from __future__ import annotations

from collections.abc import Mapping

from amp_studio.transfer import AxisStatus, ControlIdentity, ControlStatus, ProtocolMismatchError, known_fault

_LETTERS = "XYZABCUV"
SWITCH = ("limit switch",)
_NOT_KNOWN = {
    "following_error": "it drives stepper motors without feedback and reports the position that it commanded,"
    " not the one that was reached",
    "velocity": "its report has the feed of the path, not the speed of an axis",
}
"""What no report has (report.c), and why."""
_PINS = {
    "P": "probe",
    "R": "reset",
    "H": "feed hold",
    "S": "cycle start",
    "D": "safety door",
    "E": "E-stop",
    "F": "motor fault",
}
"""Letters of ``Pn:`` that are no axes (report.c)."""


def status_of(identity: ControlIdentity, report: str, alarm: str = "") -> ControlStatus:
    """Return the status of a report such as ``<Run|MPos:1.000,2.000,0.000|FS:500,0|Pn:X>``;
    ``alarm`` is the last ``ALARM:n`` pushed.
    """
    state, *parts = report.strip("<>").split("|")
    fields = dict(part.partition(":")[::2] for part in parts)
    try:
        # $10 decides which of both is in the report.
        places = _numbers(fields.get("MPos") or fields.get("WPos") or "")
        feed, speed, *_ = (*_numbers(fields.get("FS", fields.get("F", ""))), 0.0, 0.0)
    except ValueError:
        raise ProtocolMismatchError(f"the control reports '{report[:60]}'") from None
    pins = fields.get("Pn", "")
    names = identity.axes or tuple(_LETTERS[: len(places)])
    axes = tuple(
        AxisStatus(name, place, unit="mm", states=SWITCH if name in pins else (), known_states=SWITCH)
        for name, place in zip(names, places, strict=False)
    )
    values = {"feed": feed, "spindle speed": speed, **_further(fields, pins)}
    code = alarm or (f"ALARM:{state.partition(':')[2]}" if state.startswith("Alarm:") else "")
    in_alarm = state.startswith("Alarm")
    faults = (known_fault(identity.family, code or "Alarm", "The control is locked"),) if in_alarm else ()
    which = "machine" if "MPos" in fields else "work"
    notes = (f"positions in {which} coordinates, in mm unless $13 is on",)
    return ControlStatus(
        identity.family,
        identity.protocol,
        identity.name,
        state,
        axes,
        faults,
        values,
        notes,
        _NOT_KNOWN,
        report,
    )


def _numbers(text: str) -> list[float]:
    return [float(each) for each in text.split(",") if each]


def _further(fields: Mapping[str, str], pins: str) -> dict[str, float | str]:
    """Return what a report has only at times."""
    values: dict[str, float | str] = {}
    if pins:
        values["inputs"] = ", ".join(_PINS.get(pin, f"limit {pin}") for pin in pins)
    if "WCO" in fields:
        values["work coordinate offset"] = fields["WCO"]
    return values
