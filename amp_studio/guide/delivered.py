"""What is as delivered: findings about printed defaults of steps that nobody has reached. A state of a file, and no fault in it.

In a file in which nobody has set anything but its axes no step is reached; in any other the guide decides (``progress``).
A download and its preview ask the validator alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from amp_studio.files import ParameterFile
from amp_studio.schema import Family
from amp_studio.validate import NOT_SET, Finding, Validator

from .steps_done import belongs_to, progress


class Delivered(NamedTuple):
    """Findings about values as delivered."""

    findings: tuple[Finding, ...] = ()
    steps: tuple[int, ...] = ()
    """The numbers of the steps in which they are to be set."""


def as_delivered(validator: Validator, findings: Sequence[Finding]) -> Delivered:
    """Return which of the present findings are a state: none in a file in which no value is missing."""
    file, real = validator.file, [finding for finding in findings if finding.rule != NOT_SET]
    if not real or not validator.not_set:
        return Delivered()
    if _is_fresh(file):
        steps = [(finding, *belongs_to(file, finding)) for finding in real]
        deferred = tuple(finding for finding, number, is_own in steps if number and not is_own)
    else:
        deferred = progress(validator, findings).deferred
    return Delivered(deferred, tuple(sorted({belongs_to(file, finding)[0] for finding in deferred})))


def _is_fresh(file: ParameterFile) -> bool:
    """Return whether a file contains printed defaults and its axes only."""
    given = _axis_parameters(file.schema.family)
    return all(address[0] in given or file.is_default(address) for address in file.values)


def _axis_parameters(family: Family) -> frozenset[str]:
    """Return the parameters that a new file has values of besides the printed defaults."""
    named: list[str | None] = [family.machine_parameter, family.unit_parameter]
    if family.axes is not None:
        named += [family.axes.name, family.axes.type, family.axes.fitted_by]
    declared = family.declared_axes
    if declared is not None:
        named += [*declared.flags, declared.count, declared.letters, declared.group_count]
        named += [field.param for field in (declared.name, declared.group) if field is not None]
    return frozenset(filter(None, named))
