"""The explanation of a finding as text, for the terminal and the desktop program."""

from __future__ import annotations

from collections.abc import Iterator

from amp_studio.files import ParameterFile
from amp_studio.report.wording import severity_name, state_name
from amp_studio.schema import Address
from amp_studio.validate import Explanation, Finding, SeenValue

from .manual_page import erratum_text

_MANY = 24
"""Most parameters that an explanation lists; a rule over all tools reads hundreds."""


def _seen_text(file: ParameterFile, seen: SeenValue) -> str:
    """Return a value that a rule reads: its name there, the value, why it is inactive, and its label."""
    name = f"{seen.name} = " if seen.name else ""
    state = "" if seen.state.is_active else f" ({state_name(seen.state.state)}: {seen.state.why})"
    here = file.machine_schema
    place = here.instance_label(seen.address)
    return f"{name}{seen.value}{state}: {here.label(seen.address)}{f', {place}' if place else ''}"


def why_parts(
    file: ParameterFile, finding: Finding, why: Explanation
) -> Iterator[tuple[str, str, Address | None]]:
    """Yield title, text and, for a line about a parameter, its address."""
    yield "Rule", f"{why.title} ({finding.rule}, {severity_name(finding.severity)})", None
    if why.when:
        yield "Applies if", why.when, None
    if why.demand:
        yield "Requires", why.demand, None
        yield "With the values", why.with_values, None
    for side, worth in why.sides:
        yield "Result", f"{side} = {worth}", None
    for seen in why.seen[:_MANY]:
        yield "Reads", _seen_text(file, seen), seen.address
    if len(why.seen) > _MANY:
        yield "Reads", f"and {len(why.seen) - _MANY} more", None
    for erratum in why.errata:
        yield "Contradiction", erratum_text(file.schema.errata[erratum]), None
    if why.source:
        yield "Source", why.source, None


def why_text(file: ParameterFile, finding: Finding, why: Explanation) -> str:
    """Return an explanation as indented lines for the terminal."""
    lines, before = [], ""
    for title, text, _ in why_parts(file, finding, why):
        lines.append(f"         {'' if title == before else title:16}{text}")
        before = title
    return "\n".join(lines)
