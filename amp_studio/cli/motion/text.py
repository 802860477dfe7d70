"""The check of a machine in motion as text and as data, for ``check`` and ``validate --motion``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.sim import MotionCheck


def as_json(file: ParameterFile, checks: Sequence[MotionCheck]) -> dict[str, object]:
    """Return the checks as other programs read them."""
    return {
        "checks": [
            {
                "scenario": check.scenario,
                "axis": check.axis,
                "letter": check.letter,
                "verdict": check.verdict,
                "figures": {
                    name: {"value": None if value is None else float(value), "unit": unit}
                    for name, (value, unit) in check.figures.items()
                },
                "alarms": [
                    {"code": alarm.code, "time_s": float(alarm.time_s), "message": alarm.message}
                    for alarm in check.alarms
                ],
                "why": check.why,
                "params": [_number(file, parameter, check.axis) for parameter in check.params],
                "assumptions": list(check.assumptions),
            }
            for check in checks
        ],
        **{verdict.replace(" ", "_"): count for verdict, count in counts(checks).items()},
    }


def _number(file: ParameterFile, parameter: str, axis: str) -> str:
    from amp_studio.sim import named_parameter

    return named_parameter(file, parameter, axis)


def _called(file: ParameterFile, parameter: str, axis: str) -> str:
    """Return the number of a parameter and its name."""
    number, name = _number(file, parameter, axis), file.schema.parameters[parameter].name
    return name if number == parameter else f"{number} {name}"


def counts(checks: Sequence[MotionCheck]) -> dict[str, int]:
    """Return verdict -> how many there are."""
    verdicts = ("good", "doubtful", "bad", "not possible")
    return {verdict: sum(check.verdict == verdict for check in checks) for verdict in verdicts}


def text(file: ParameterFile, checks: Sequence[MotionCheck]) -> str:
    """Return the checks as a person reads them, with the parameters to look at where one is not good."""
    lines = []
    for check in checks:
        figures = ", ".join(_figure_text(name, value, unit) for name, (value, unit) in check.figures.items())
        lines.append(f"{check.verdict:12} {check.scenario:9} {check.letter:3} {figures}".rstrip())
        if check.why:
            lines.append(f"{'':13}{check.why}")
        lines += [
            f"{'':13}{alarm.code}: {alarm.message}" for alarm in check.alarms if alarm.message != check.why
        ]
        if check.params:
            named = ", ".join(_called(file, parameter, check.axis) for parameter in check.params)
            lines.append(f"{'':13}look at {named}")
    return "\n".join((*lines, ", ".join(f"{count} {verdict}" for verdict, count in counts(checks).items())))


def _figure_text(name: str, value: float | None, unit: str) -> str:
    from amp_studio.sim import value_text

    words = name.replace("_", " ")
    return f"{words} –" if value is None else f"{words} {value_text(float(value), unit)}"
