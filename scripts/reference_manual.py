"""The page of the generated reference that leads from the pages of a printed manual
to what is taken from them.
"""

import re
from collections.abc import Iterable
from html import escape

from reference_html import (
    heading,
    link,
    listed,
    message_link,
    natural,
    page,
    paragraph,
    parameter_link,
    printed_tables,
    rule_link,
)

from amp_studio.guide import steps_of
from amp_studio.report import facts, help_parts
from amp_studio.report.wording import state_name
from amp_studio.schema import Parameter, Schema

_ONE = r"(?:[A-Z]?[0-9]+(?:-[0-9]+)?(?:\.[0-9]+)*[a-z]?|[A-Z]-[0-9]+)\b"
_CITED = re.compile(rf"\bpages? ({_ONE}(?:(?:, | and ){_ONE})*)")


def cited_pages(text: str) -> list[str]:
    """Return the pages that a text cites: ``(pages 3-5 and 3-6)``."""
    return [one for found in _CITED.findall(text) for one in re.findall(_ONE, found)]


def pages_of(schema: Schema, parameter: Parameter) -> list[str]:
    """Return every page of which something in the reference of a parameter is, but for when it is active."""
    states = {state_name(state.state).capitalize() for state in parameter.states}
    texts = [text for title, text in facts(schema, parameter) if title not in states]
    texts += [text for _, text in help_parts(schema, parameter)]
    cited = [one for text in texts for one in cited_pages(text)]
    return list(dict.fromkeys((parameter.page, *parameter.pages.values(), *cited)))


def _shape(page: str) -> str:
    return re.sub("[0-9]+", "0", page)


def printed_on(schema: Schema) -> dict[str, dict[str, list[str]]]:
    """Return what is taken from each page, in the order of the manual: page -> title -> links."""
    found: dict[str, dict[str, list[str]]] = {}

    def add(pages: Iterable[str], title: str, target: str) -> None:
        for one in dict.fromkeys(pages):
            found.setdefault(one, {}).setdefault(title, []).append(target)

    main = {p.id: {p.page, *p.pages.values()} for p in schema.parameters.values()}
    for parameter in schema.parameters.values():
        add(main[parameter.id], "Parameters", parameter_link(schema, parameter))
    for message in schema.messages.values():
        add(message.every_page, "Messages", message_link(schema, message))
    for printed in printed_tables(schema):
        add([printed.page], "Tables", link("tables", printed.id, printed.title))
    for step in steps_of(schema) if schema.commissioning is not None else ():
        add(
            [step.page],
            "Commissioning",
            link("commissioning", f"step-{step.number}", f"Step {step.number}: {step.title}"),
        )
    for name, figure in schema.motion.assumed.items():
        target = link("motion", name, name.replace("_", " "))
        add(filter(None, [figure.page]), "Assumed in a simulation", target)
    for rule in schema.rules:
        add(filter(None, [rule.page]), "Rules", rule_link(rule))
    for erratum in schema.errata.values():
        readings = (reading.page for reading in erratum.readings)
        add(readings, "Contradictions", link("errata", erratum.id, erratum.id))
    # What a text cites as a page may be a chapter or a list: a page is written as those of the facts are.
    shapes = {_shape(one) for one in {rule.page for rule in schema.rules if rule.page}.union(*main.values())}
    for parameter in schema.parameters.values():
        cited = (
            one
            for one in pages_of(schema, parameter)
            if one not in main[parameter.id] and _shape(one) in shapes
        )
        add(cited, "Also for", parameter_link(schema, parameter))
    return {one: found[one] for one in sorted(found, key=natural)}


def manual_pages(schema: Schema) -> str:
    """Return the page of the pages of a manual."""
    chapters: dict[str, list[str]] = {}
    for one, titles in printed_on(schema).items():
        shown = [f"<strong>{title}</strong> {', '.join(links)}" for title, links in titles.items()]
        chapter, dash, _ = one.partition("-")
        chapters.setdefault(f"Chapter {chapter}" if dash else "", []).append(
            f'<div class="printed" id="{escape(f"page-{one}")}"><div>{escape(one)}</div>{listed(shown)}</div>'
        )
    parts = [
        paragraph(
            f"{schema.family.title}: what each page says of which parameter. A page that is not listed only"
            " goes on with what the one before it began, or has nothing of a parameter."
        )
    ]
    for chapter, entries in chapters.items():
        parts += [heading(2, chapter)] if chapter and len(chapters) > 1 else []
        parts.append("\n".join(entries))
    return page(schema, "Pages of the manual", *parts)
