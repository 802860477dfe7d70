"""Findings by their rule: what is wrong in plain words, on which axes, and what its fixes do,
for a list or a terminal.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import chain

from amp_studio.files import ParameterFile, axis_letter
from amp_studio.report.axes import scope_of
from amp_studio.schema import MASKED, Severity, Value, show_value
from amp_studio.validate import NOT_SET, AddressedValue, Finding, Validator, rule_title


@dataclass(frozen=True, slots=True)
class FindingGroup:
    """The findings of one rule, or of one parameter where no rule but its own range is broken."""

    key: str
    """What stays the same while values change."""
    severity: Severity
    title: str
    """The name of the rule."""
    message: str
    """What is wrong: in the words of all of them, else of the first."""
    findings: tuple[Finding, ...]
    axes: tuple[str, ...]
    """The letters of the axes that cause it; empty where it is of the control as a whole."""

    @property
    def fixable(self) -> tuple[Finding, ...]:
        """Those that have a suggested fix."""
        return tuple(finding for finding in self.findings if finding.fix)

    @property
    def cited(self) -> str:
        """The source in words."""
        return self.findings[0].cited


def finding_groups(validator: Validator, findings: Iterable[Finding]) -> tuple[FindingGroup, ...]:
    """Return findings by their rule, in the order of the first of each;
    values that are not set are no finding.
    """
    found: dict[str, list[Finding]] = {}
    for finding in findings:
        if finding.rule != NOT_SET:
            found.setdefault(_key(finding), []).append(finding)
    return tuple(_group(validator, key, same) for key, same in found.items())


def _key(finding: Finding) -> str:
    """Return the rule; where it is a range or a choice the parameter too,
    and for a fault of a builder's rules its words.
    """
    # One rule of the schema is about every parameter: without its name the whole file would be one group.
    if finding.rule.startswith("schema.") and finding.causes:
        return f"{finding.severity} {finding.rule} {finding.causes[0][0]}"
    is_single = finding.rule.startswith(("schema.", "rules."))
    return f"{finding.severity} {finding.rule} {finding.message if is_single else ''}"


def _group(validator: Validator, key: str, same: list[Finding]) -> FindingGroup:
    axes = dict.fromkeys(axis for finding in same for axis in finding_axes(validator.file, finding))
    return FindingGroup(
        key, same[0].severity, rule_title(validator, same[0]), same[0].message, tuple(same), tuple(axes)
    )


def finding_axes(file: ParameterFile, finding: Finding) -> tuple[str, ...]:
    """Return the letters of the axes whose values cause a finding, in their order, once each."""
    axes = {a[1] for a in finding.causes if scope_of(file, a) == "axis"}
    # By length first: axis 10 comes after axis 9.
    in_order = sorted(axes, key=lambda axis: (len(axis), axis))
    return tuple(dict.fromkeys(axis_letter(file, axis) or axis for axis in in_order))


def fix_text(file: ParameterFile, findings: Sequence[Finding]) -> str:
    """Return what the fixes of findings do, as a button has it: ``Set Excess Error to 13.2 mm``;
    empty without one.
    """
    settings = list(dict.fromkeys(chain.from_iterable(finding.fix for finding in findings)))
    if not settings:
        return ""
    name = file.schema.parameters[settings[0].address[0]].name
    # As they are shown: 10 mm and 10.0 mm are one new value on a button.
    values = {(s.address[0], _value_text(file, s)) for s in settings}
    if len(values) == 1:
        return f"Set {name} to {values.pop()[1]}"
    is_one = len({parameter for parameter, _ in values}) == 1
    if is_one and (axes := _letters(file, settings)):
        return f"Set {name} on {', '.join(axes)}"
    return f"Set {len(settings)} Values"


def _letters(file: ParameterFile, settings: Iterable[AddressedValue]) -> list[str]:
    """Return the letters of the axes that are set; empty where one has none."""
    letters = [axis_letter(file, s.address[1]) for s in settings if scope_of(file, s.address) == "axis"]
    return letters if all(letters) else []


def fix_lines(file: ParameterFile, finding: Finding) -> tuple[str, ...]:
    """Return each value that a fix sets, before and after: ``1750 Excess Error (X): 11 mm → 13.2 mm``."""
    here = file.machine_schema
    return tuple(
        f"{here.label(s.address)}{_axis_suffix(file, s)}: {_value(file, s, file.get(s.address))} → "
        f"{_value_text(file, s)}"
        for s in finding.fix
    )


def _axis_suffix(file: ParameterFile, setting: AddressedValue) -> str:
    axis = setting.address[1]
    return f" ({axis_letter(file, axis) or axis})" if scope_of(file, setting.address) == "axis" else ""


def _value_text(file: ParameterFile, setting: AddressedValue) -> str:
    return _value(file, setting, setting.value)


def _value(file: ParameterFile, setting: AddressedValue, value: Value | None) -> str:
    parameter = file.schema.parameters[setting.address[0]]
    return MASKED if parameter.secret else show_value(parameter, value)
