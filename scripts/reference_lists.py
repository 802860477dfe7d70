"""Pages of the generated reference that list what several parameters share: rules, steps, tables, numbers."""

from collections.abc import Iterator
from html import escape

from reference_html import (
    contradiction,
    facts_list,
    group_page,
    link,
    listed,
    message_link,
    natural,
    number_anchor,
    page,
    page_links,
    paragraph,
    parameter_link,
    parameter_links,
    printed_tables,
    rule_source,
    section,
    table,
)

from amp_studio.guide import steps_of
from amp_studio.report import cells_of
from amp_studio.report.wording import severity_name
from amp_studio.schema import Rule, Schema, read_address


def rules(schema: Schema) -> str:
    """Return the page of all rules."""
    what = (
        "What <code>amp-studio validate</code> checks; a condition is written in <a"
        ' href="../../schema.html">CEL</a>.'
    )
    return page(schema, "Rules", what, *(part for rule in schema.rules for part in _rule(schema, rule)))


def _rule(schema: Schema, rule: Rule) -> Iterator[str]:
    yield section(rule.id, rule.title)
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
    facts += [("Effective value", f"<code>{escape(f'{e.set} = {e.value}')}</code>") for e in rule.effective]
    finds = [message_link(schema, m) for m in schema.messages.values() if rule.id in m.rules]
    facts += [("Message of the control", ", ".join(finds))] if finds else []
    facts.append(("Source", rule_source(rule)))
    yield facts_list(facts)


def commissioning(schema: Schema) -> str:
    """Return the page of the steps in which a machine is commissioned."""
    assert schema.commissioning is not None
    parts = [paragraph(f"{schema.commissioning.why} (page {schema.commissioning.page})")]
    for step in steps_of(schema):
        parts += [
            section(f"step-{step.number}", f"Step {step.number}: {step.title}"),
            f"<p>{escape(' '.join(step.what.split()))} (page {page_links([step.page])})</p>",
            listed(parameter_link(schema, parameter) for parameter in step.parameters),
        ]
        if step.again:
            parts.append(f"<p>Looked at again: {parameter_links(schema, [p.id for p in step.again])}</p>")
    return page(schema, "Commissioning", *parts)


def motion(schema: Schema) -> str:
    """Return the page of what the law of the axes takes from facts."""
    facts = schema.motion
    figures = (
        (
            f'<span id="{escape(name)}">{escape(name.replace("_", " "))}</span>',
            escape(f"{figure.value:.9g} {figure.unit}".rstrip()),
            escape(figure.why),
            page_links([figure.page] if figure.page else []),
        )
        for name, figure in facts.assumed.items()
    )
    settings = ((f"<code>{escape(name)}</code>", escape(what)) for name, what in facts.settings.items())
    parts = [
        paragraph(f"Scenarios of amp-studio simulate: {', '.join(facts.scenarios)}."),
        section("assumed", "Assumed"),
        paragraph("Figures that no parameter gives. A result names those that it was made with."),
        table(("Figure", "Value", "Why", "Page"), figures),
    ]
    if facts.settings:
        parts += [section("settings", "Settings of the machine"), table(("Setting", "What it is"), settings)]
    read = (p for p in schema.parameters.values() if p.id in set(facts.params.values()))
    parts += [
        section("read", "Parameters that are read"),
        listed(parameter_link(schema, parameter) for parameter in read),
    ]
    return page(schema, "Simulation", *parts)


def errata(schema: Schema) -> str:
    """Return the page of the contradictions of the manual."""
    parts: list[str] = []
    for erratum in schema.errata.values():
        parts += [
            section(erratum.id, erratum.id),
            contradiction(erratum),
            f"<p>Parameters: {parameter_links(schema, erratum.params) or 'none'}</p>",
        ]
    return page(schema, "Contradictions in the manual", *parts)


def tables(schema: Schema) -> str:
    """Return the page of the printed tables."""
    parts: list[str] = []
    for printed in printed_tables(schema):
        head, *cells = cells_of(printed)
        rows = ([escape(cell) for cell in row] for row in cells)
        parts += [section(printed.id, f"{printed.title} (page {printed.page})"), table(head, rows)]
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
                target = link(
                    group_page(schema.group_of[parameter.id]),
                    number_anchor(schema, parameter, number),
                    parameter.name,
                )
                rows[number, parameter.id] = f"{target}{escape(f', {label}') if label else ''}"
    ordered = sorted(rows, key=lambda row: (natural(row[0]), row[1]))
    cells = ((escape(number), rows[number, name], escape(name)) for number, name in ordered)
    return page(schema, "Numbers", table(("Number", "Parameter", "Id"), cells))
