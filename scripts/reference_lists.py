"""Pages of the generated reference that list what several parameters share: messages, rules, steps, tables, numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape

from reference_html import (
    anchors,
    facts_list,
    group_page,
    heading,
    link,
    listed,
    page,
    paragraph,
    parameter_link,
    parameter_links,
    rule_link,
    table,
)

from amp_studio.guide import steps_of
from amp_studio.report import cells_of
from amp_studio.report.manual_page import erratum_text
from amp_studio.report.wording import severity_name
from amp_studio.schema import Rule, Schema, read_address
from amp_studio.schema.model import ControlMessage, Messages


def messages(schema: Schema, every: Messages) -> str:
    """Return the page of a list of messages: from what the control shows to the cause."""
    parts = [part for message in every.messages for part in _message(schema, message)]
    return page(schema, every.title, paragraph(every.note) if every.note else "", *parts)


def _message(schema: Schema, message: ControlMessage) -> Iterator[str]:
    yield anchors(message.id)
    yield heading(2, message.name)
    facts = [("Reaction", escape(message.reaction))]
    if message.also:
        facts.append(("Also printed as", escape("; ".join(message.also))))
    if message.means:
        facts.append(("Meaning", escape(message.means)))
    if message.note:
        facts.append(("Note", escape(message.note)))
    parameters = parameter_links(schema, message.params)
    if parameters:
        facts.append(("Parameters, the nearest first", parameters))
    found = {rule.id: rule for rule in schema.rules}
    rules = "; ".join(rule_link(found[name]) for name in message.rules if name in found)
    if rules:
        facts.append(("Rules that find it in a file", rules))
    facts.append(("Source", escape(f"page {', '.join(message.every_page)}")))
    yield facts_list(facts)
    for title, entries in (("Where to look", message.causes), ("What helps", message.cures)):
        if entries:
            yield f"<p><strong>{title}</strong></p>\n{listed(map(escape, entries), 'ol')}"


def rules(schema: Schema) -> str:
    """Return the page of all rules."""
    what = 'What <code>amp-studio validate</code> checks; a condition is written in <a href="../../schema.html">CEL</a>.'
    return page(schema, "Rules", what, *(part for rule in schema.rules for part in _rule(schema, rule)))


def _rule(schema: Schema, rule: Rule) -> Iterator[str]:
    yield anchors(rule.id)
    yield heading(2, rule.title)
    reads = ", ".join(
        f"<code>{escape(name)}</code> {parameter_link(schema, read_address(read)[0])}"
        for name, read in rule.reads.items()
    )
    facts = [
        ("Id", escape(rule.id)),
        ("Severity", escape(severity_name(rule.severity))),
        ("Message", escape(rule.message)),
        ("Reads", reads),
        ("Applies when", f"<code>{escape(rule.when)}</code>"),
        ("Must hold", f"<code>{escape(rule.check)}</code>"),
    ]
    facts += [("Suggested fix", f"<code>{escape(f'{fix.set} = {fix.value}')}</code>") for fix in rule.fix]
    facts += [("In force instead", f"<code>{escape(f'{e.set} = {e.value}')}</code>") for e in rule.effective]
    facts.append(("Source", escape(f"page {rule.page}")))
    yield facts_list(facts)


def commissioning(schema: Schema) -> str:
    """Return the page of the steps in which a machine is commissioned."""
    assert schema.commissioning is not None
    parts = [paragraph(f"{schema.commissioning.why} (page {schema.commissioning.page})")]
    for step in steps_of(schema):
        parts += [
            anchors(f"step-{step.number}"),
            heading(2, f"Step {step.number}: {step.title}"),
            paragraph(f"{step.what} (page {step.page})"),
            listed(parameter_link(schema, parameter) for parameter in step.parameters),
        ]
        if step.again:
            parts.append(f"<p>Looked at again: {parameter_links(schema, [p.id for p in step.again])}</p>")
    return page(schema, "Commissioning", *parts)


def errata(schema: Schema) -> str:
    """Return the page of the contradictions of the manual."""
    parts: list[str] = []
    for erratum in schema.errata.values():
        parts += [
            anchors(erratum.id),
            heading(2, erratum.id),
            paragraph(erratum_text(erratum)),
            f"<p>Parameters: {parameter_links(schema, erratum.params) or 'none'}</p>",
        ]
    return page(schema, "Contradictions in the manual", *parts)


def tables(schema: Schema) -> str:
    """Return the page of the printed tables."""
    parts: list[str] = []
    for printed in schema.tables.values():
        head, *cells = cells_of(printed)
        rows = ([escape(cell) for cell in row] for row in cells)
        parts += [
            anchors(printed.id),
            heading(2, f"{printed.title} (page {printed.page})"),
            table(head, rows),
        ]
        parts += [paragraph(printed.note)] if printed.note else []
        names = parameter_links(schema, printed.params)
        parts += [f"<p>Looked up for: {names}</p>"] if names else []
    return page(schema, "Tables", *parts)


def numbers(schema: Schema) -> str:
    """Return the page of all numbers in their order, each with the parameter that has it."""
    rows: dict[tuple[str, str], str] = {}
    for machine in schema.family.machines:
        here = schema.on(machine.key)
        for parameter in schema.parameters.values():
            for instance, number in here.numbers(parameter).items():
                label = here.instance_label((parameter.id, instance))
                target = link(group_page(schema.group_of[parameter.id]), f"n-{number}", parameter.name)
                rows[number, parameter.id] = f"{target}{escape(f', {label}') if label else ''}"
    ordered = sorted(rows, key=lambda row: (_natural(row[0]), row[1]))
    cells = ((escape(number), rows[number, name], escape(name)) for number, name in ordered)
    return page(schema, "Numbers", table(("Number", "Parameter", "Id"), cells))


def _natural(number: str) -> list[tuple[int, int, str]]:
    """Return by what numbers are ordered as people count: P2 before P10."""
    return [
        (0, int(part), "") if part.isdecimal() else (1, 0, part)
        for part in re.split(r"(\d+)", number)
        if part
    ]
