"""Findings of a report: equal messages about several axes become one printed finding."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import chain, groupby
from typing import TypeVar

from amp_studio.files import ParameterFile, axis_letter
from amp_studio.report.axes import axis_label, scope_of
from amp_studio.report.data_values import data_of
from amp_studio.report.language import ENGLISH, Language
from amp_studio.report.wording import joined_places, severity_name
from amp_studio.schema import Address, show_value
from amp_studio.validate import AddressedValue, Finding, Suppressed

from .lines import finding_text
from .printed_finding import PrintedFinding

_T = TypeVar("_T")
_NAMED = 6
"""Number of values that one lists; a finding about more names only the first ones in its message."""


def printed_findings(
    file: ParameterFile, findings: Iterable[Finding], printed: set[str], language: Language = ENGLISH
) -> tuple[PrintedFinding, ...]:
    """Return the findings as they are printed, in their order;
    ``printed`` contains the anchors of the values in the report.
    """
    return tuple(_printed(file, same, printed, language) for same in alike(findings))


def alike(findings: Iterable[Finding]) -> list[list[Finding]]:
    """Return findings in their order, those together that report the same of several axes."""
    found: dict[tuple[str, str, str], list[Finding]] = {}
    for finding in findings:
        # By the message, which has the values in it: axes with other values are not the same finding.
        found.setdefault((finding.severity, finding.rule, finding.message), []).append(finding)
    return list(found.values())


def same_finding_text(file: ParameterFile, same: Sequence[Finding]) -> str:
    """Return what several findings have in common, in a line or more for the terminal: ``axes X, Y: …``."""
    if len(same) == 1:
        return finding_text(file, same[0])
    finding = _printed(file, same, set())
    every = (a for f in same for a in (f.addresses if len(f.addresses) <= _NAMED else f.causes[:_NAMED]))
    names = ", ".join(label for _, label in _links(file, list(dict.fromkeys(every)), set()))
    first = ": ".join(filter(None, (_axes_text(file, same), names, finding.message)))
    cited = f" ({same[0].cited})" if same[0].cited else ""
    fix = f"\n         suggested fix: {finding.fix}" if finding.fix else ""
    return f"{severity_name(finding.severity):8} {first}{cited}{fix}"


def _axes_text(file: ParameterFile, same: Sequence[Finding]) -> str:
    axes = [axis_letter(file, axis) or axis for axis in _axes(file, same)]
    return f"{'axes' if len(axes) > 1 else 'axis'} {', '.join(axes)}" if axes else ""


def _axes(file: ParameterFile, findings: Iterable[Finding]) -> list[str]:
    """Return the axes that findings are about, in their order."""
    axes = {a[1] for finding in findings for a in finding.addresses if scope_of(file, a) == "axis"}
    # By length first: axis 10 comes after axis 9.
    return sorted(axes, key=lambda axis: (len(axis), axis))


def printed_suppressed(
    file: ParameterFile, left: Iterable[Suppressed], printed: set[str], language: Language = ENGLISH
) -> tuple[PrintedFinding, ...]:
    """Return the suppressed findings as they are printed, with name and reason."""
    alike: dict[tuple[str, str, str], list[Finding]] = {}
    for suppressed in left:
        # What was accepted for good is not offered to be changed.
        finding = replace(suppressed.finding, fix=(), effective=())
        by = f"{language.text('Suppressed by')} {suppressed.suppression.by}: {suppressed.suppression.reason}"
        alike.setdefault((finding.rule, finding.message, by), []).append(finding)
    with_reasons = [(_printed(file, same, printed, language), by) for (_, _, by), same in alike.items()]
    return tuple(
        replace(each, message=f"{each.message} {by}", severity="suppressed") for each, by in with_reasons
    )


def _printed(
    file: ParameterFile, same: Sequence[Finding], printed: set[str], language: Language = ENGLISH
) -> PrintedFinding:
    """Return findings that report the same as one, with all their axes, values and fixes."""
    first, few = same[0], [finding.addresses for finding in same if len(finding.addresses) <= _NAMED]
    addresses, fix = _unique(few), _unique(finding.fix for finding in same)
    brings = next(filter(None, (finding.brings for finding in same)), None)
    brought = f" ({language.text('it brings a warning:')} {language.finding(brings)})" if brings else ""
    return PrintedFinding(
        severity=first.severity,
        count=len(same),
        place=_places(file, addresses),
        about=tuple(_links(file, addresses, printed, language)),
        message=language.finding(first) + _effective(file, same, language),
        fix="; ".join(_settings(file, fix, language)) + brought,
        page=first.page or language.title(first.reason),
        rule=first.rule,
        addresses=tuple(_unique(finding.addresses for finding in same)),
        changes=tuple((s.address, _new_value(file, s), s.value.unit) for s in fix),
        is_own=first.is_own or bool(first.reason),
    )


def _effective(file: ParameterFile, same: Sequence[Finding], language: Language) -> str:
    used = "; ".join(_settings(file, _unique(finding.effective for finding in same), language))
    return f" {language.text('Effective value in the control:')} {used}." if used else ""


def _unique(lists: Iterable[Iterable[_T]]) -> list[_T]:
    """Return what is in several lists, each once."""
    return list(dict.fromkeys(chain.from_iterable(lists)))


def _new_value(file: ParameterFile, setting: AddressedValue) -> float | bool | str | None:
    parameter = file.schema.parameters[setting.address[0]]
    return None if parameter.secret else data_of(parameter, setting.value)


def _places(file: ParameterFile, addresses: Sequence[Address]) -> str:
    # By length first, as in ``_axes``.
    axes = sorted({a[1] for a in addresses if scope_of(file, a) == "axis"}, key=lambda i: (len(i), i))
    if not axes:
        return "Control" if addresses else ""
    return joined_places([axis_label(file, axis) for axis in axes])


def _links(
    file: ParameterFile, addresses: Sequence[Address], printed: set[str], language: Language = ENGLISH
) -> Iterable[tuple[str, str]]:
    """Yield anchor and label of each value, for example ``1300``, ``2300`` and ``3300 Home Calibration``."""
    order = [a[0] for a in addresses]
    # Stable: parameters come in the order in which the finding names them, with all their axes together.
    for _, members in groupby(sorted(addresses, key=lambda a: order.index(a[0])), key=lambda a: a[0]):
        same = list(members)
        for n, address in enumerate(same):
            anchor = f"{address[0]}@{address[1]}"
            label = _label(file, address, n == 0, n == len(same) - 1)
            yield (anchor if anchor in printed else "", language.text(label))


def _label(file: ParameterFile, address: Address, is_first: bool, is_last: bool) -> str:
    """Return number and name for the last value of a parameter, the number alone for the others.

    Without a number: name and axis for the first value, the axis alone for the others.
    """
    here = file.machine_schema
    number = here.number(address)
    if number and not here.is_disputed(address[0]):
        return here.label(address) if is_last else number
    return here.label(address) if is_first else here.instance_label(address)


def _settings(
    file: ParameterFile, settings: Sequence[AddressedValue], language: Language = ENGLISH
) -> Iterable[str]:
    """Yield ``1300, 2300 Home Calibration = 0 mm`` for each parameter and new value."""
    wanted: dict[tuple[str, str], list[Address]] = {}
    for setting in settings:
        parameter = file.schema.parameters[setting.address[0]]
        text = show_value(parameter, setting.value)
        text = text if parameter.choices else language.quantity(text)
        wanted.setdefault((setting.address[0], text), []).append(setting.address)
    for (_, text), addresses in wanted.items():
        yield ", ".join(label for _, label in _links(file, addresses, set(), language)) + f" = {text}"
