"""Findings as JSON, and as text for the terminal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import groupby
from typing import Any

from amp_studio.files import ParameterFile
from amp_studio.report.wording import severity_name
from amp_studio.schema import MASKED, Address, Parameter, Value, write_value
from amp_studio.validate import AddressedValue, Finding, Suppressed


def finding_json(file: ParameterFile, finding: Finding) -> dict[str, Any]:
    """Return a finding in the form of ``validate --json``."""
    here = file.machine_schema
    return {
        "rule": finding.rule,
        "severity": finding.severity,
        "params": [here.short(a) for a in finding.addresses],
        "compared": [here.short(a) for a in finding.compared],
        "message": finding.message,
        "fix": [_setting_json(file, setting) for setting in finding.fix],
        **({"brings": finding.brings.message} if finding.brings else {}),
        "effective": [_setting_json(file, setting) for setting in finding.effective],
        "source": finding.page or finding.reason or None,
    }


def _setting_json(file: ParameterFile, setting: AddressedValue) -> dict[str, Any]:
    parameter = file.schema.parameters[setting.address[0]]
    param = file.machine_schema.short(setting.address)
    if parameter.secret:
        return {"param": param, "value": None, "secret": True}
    return {"param": param, "value": write_value(parameter, setting.value)}


def finding_text(file: ParameterFile, finding: Finding) -> str:
    """Return a finding as one or two lines for the terminal."""
    first, *others = finding_parts(file, finding)
    lines = [f"{severity_name(finding.severity):8} {first}", *(f"         {line}" for line in others)]
    return "\n".join(lines)


def finding_parts(file: ParameterFile, finding: Finding) -> list[str]:
    """Return what a finding is about with its message and page, then its effective values,
    then its suggested fix.
    """
    names = ", ".join(_names(file, finding.addresses[:8]))
    page = f" ({finding.cited})" if finding.cited else ""
    parts = [f"{names}{': ' if names else ''}{finding.message}{page}"]
    for what, settings in (("effective value", finding.effective), ("suggested fix", finding.fix)):
        if settings:
            values = ", ".join(
                f"{_named(file, s.address)} = {_written(file.schema.parameters[s.address[0]], s.value)}"
                for s in settings
            )
            parts.append(f"{what}: {values}")
    if finding.brings:
        parts[-1] += f" (it brings a warning: {finding.brings.message})"
    return parts


def _names(file: ParameterFile, addresses: Iterable[Address]) -> Iterator[str]:
    """Yield the values, those of a parameter one after the other by their numbers: ``101``,
    ``102 Characters of the Password``.
    """
    here = file.machine_schema
    for param, members in groupby(addresses, key=lambda address: address[0]):
        *others, last = members
        for address in others:
            number = "" if here.is_disputed(param) else here.number(address)
            yield number or _named(file, address)
        yield _named(file, last)


def suppressed_text(file: ParameterFile, left: Suppressed) -> str:
    """Return a suppressed finding as two lines for the terminal."""
    text = finding_text(file, replace(left.finding, fix=(), effective=()))
    return f"suppressed {text}\n         by {left.suppression.by}: {left.suppression.reason}"


def _written(parameter: Parameter, value: Value) -> str:
    return MASKED if parameter.secret else write_value(parameter, value)


def _named(file: ParameterFile, address: Address) -> str:
    """Return what a person can look up: number and name, with the address where the number is not its own."""
    return file.machine_schema.named(address)
