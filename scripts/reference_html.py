"""What all pages of the generated reference are made of: anchors, links, lists of facts.

A page is Markdown with HTML inside: an anchor is the id or the number of a parameter exactly as the program
writes it, which a label of Sphinx cannot be (it makes ``servo-excess-error`` of ``servo.excess_error``).
"""

import re
from collections.abc import Iterable
from functools import cache
from html import escape
from urllib.parse import quote

from amp_studio.schema import Group, Parameter, Rule, Schema
from amp_studio.schema.model import ControlMessage, Erratum, Messages, Table


def heading(level: int, text: str) -> str:
    """Return a heading; what means something to Markdown is escaped."""
    return "#" * level + " " + re.sub(r"([\\`*_\[\]<>#|${}~&!^:])", r"\\\1", " ".join(text.split()))


def anchors(*names: str) -> str:
    """Return places to which links may go."""
    return "".join(f'<a id="{escape(name)}"></a>' for name in dict.fromkeys(names))


def heading_id(text: str) -> str:
    """Return the anchor that Sphinx makes of a heading, the first of its page with these words."""
    return re.sub("^[-0-9]+|-+$", "", re.sub("[^a-z0-9]+", "-", text.casefold()))


def section(name: str, text: str, *more: str) -> str:
    """Return a heading of the second level and its anchors; one that Sphinx makes too is not made twice."""
    own = anchors(*(one for one in (name, *more) if one != heading_id(text)))
    return f"{own}\n\n{heading(2, text)}".lstrip()


def link(page: str, anchor: str, text: str) -> str:
    """Return a link to an anchor of a page of the same family."""
    return f'<a href="{quote(page)}.html#{quote(anchor)}">{escape(text)}</a>'


def page_link(page: str, text: str) -> str:
    """Return a link to a page of the same family."""
    return f'<a href="{quote(page)}.html">{escape(text)}</a>'


def facts_list(facts: Iterable[tuple[str, str]]) -> str:
    """Return facts (title, HTML) as a table; a title that repeats is written once."""
    rows, before = [], ""
    for title, text in facts:
        rows.append(f"<tr><th>{escape(title) if title != before else ''}</th> <td>{text}</td></tr>")
        before = title
    return '<table class="facts">\n' + "\n".join(rows) + "\n</table>"


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table of HTML cells; the index leaves out bare numbers, so cells touch: 2750excess is
    found.
    """
    lines = ["<table>", "<tr>" + " ".join(f"<th>{escape(cell)}</th>" for cell in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows]
    return "\n".join([*lines, "</table>"])


def listed(items: Iterable[str], tag: str = "ul") -> str:
    """Return a list of HTML entries, nothing without any."""
    entries = "\n".join(f"<li>{item}</li>" for item in items)
    return f"<{tag}>\n{entries}\n</{tag}>" if entries else ""


def paragraph(text: str, strong: str = "") -> str:
    """Return a paragraph of plain text, behind a word in bold where there is one."""
    lead = f"<strong>{escape(strong)}.</strong> " if strong else ""
    return f"<p>{lead}{escape(' '.join(text.split()))}</p>"


def admonition(kind: str, title: str, text: str) -> str:
    """Return HTML in a frame with a title: ``danger``, ``warning``, ``note``, ``caution``."""
    return f'<div class="admonition {kind}"><p class="admonition-title">{escape(title)}</p>{text}</div>'


def page(schema: Schema, title: str, *parts: str) -> str:
    """Return a page of a family.

    It is in no list of Sphinx: with every group of every family in the list beside each page, the site would
    take three times as long and be twice as large. What leads here is the page of the family.
    """
    short = schema.family.short or schema.family.name
    above = (
        '<p><a href="../index.html">Reference</a> › <a'
        f' href="index.html">{escape(schema.family.name)}</a></p>'
    )
    head = "---\norphan: true\n---"
    return "\n\n".join([head, heading(1, f"{short}: {title}"), above, *filter(None, parts)])


def natural(number: str) -> list[tuple[int, int, str]]:
    """Return by what numbers are ordered as people count: P2 before P10."""
    return [
        (0, int(part), "") if part.isdecimal() else (1, 0, part)
        for part in re.split(r"(\d+)", number)
        if part
    ]


# -- where things are ----------------------------------------------------------


def group_page(group: Group) -> str:
    """Return the page of a group."""
    return f"group-{group.key}"


def messages_page(messages: Messages) -> str:
    """Return the page of a list of messages."""
    return f"messages-{messages.id}"


def list_pages(schema: Schema) -> dict[str, str]:
    """Return the pages that list something of the whole family, with their titles."""
    titles = {
        "numbers": "Every number, in order",
        "pages": "Pages of the manual, and what is taken from each",
        "rules": f"Rules ({len(schema.rules)})",
    }
    if schema.commissioning is not None:
        titles["commissioning"] = "Steps of commissioning"
    if schema.motion.scenarios:
        titles["motion"] = "What a simulation reads and assumes"
    if printed := printed_tables(schema):
        titles["tables"] = f"Tables ({len(printed)})"
    if schema.errata:
        titles["errata"] = f"Contradictions in the manual ({len(schema.errata)})"
    return titles


def parameter_link(schema: Schema, parameter: Parameter | str) -> str:
    """Return a link to a parameter."""
    found = schema.parameters[parameter] if isinstance(parameter, str) else parameter
    return link(group_page(schema.group_of[found.id]), found.id, found.name)


def parameter_links(schema: Schema, ids: Iterable[str]) -> str:
    """Return links to parameters, those that the family has."""
    return ", ".join(parameter_link(schema, name) for name in ids if name in schema.parameters)


def rule_link(rule: Rule) -> str:
    """Return a link to a rule."""
    return link("rules", rule.id, rule.title)


def message_link(schema: Schema, message: ControlMessage, folder: str = "") -> str:
    """Return a link to a message of the control."""
    page = next(messages_page(m) for m in schema.message_lists if message in m.messages)
    return link(folder + page, message.id, message.name)


def printed_tables(schema: Schema) -> list[Table]:
    """Return the printed tables; messages of the control, which are tables too, have pages of their own."""
    own = {every.id for every in schema.message_lists} | set(schema.messages)
    return [printed for printed in schema.tables.values() if printed.id not in own]


def rule_source(rule: Rule) -> str:
    """Return the page of a rule, with its link, or why it is so where no page states it."""
    return f"page {page_links([rule.page])}" if rule.page else escape(rule.source)


def page_links(pages: Iterable[str]) -> str:
    """Return links to the pages of the manual."""
    return ", ".join(link("pages", f"page-{page}", page) for page in dict.fromkeys(pages))


def contradiction(erratum: Erratum) -> str:
    """Return the readings of a contradiction of the manual, which of them is used, and why."""
    readings = listed(
        f"page {page_links([r.page])}: {escape(' '.join(r.says.split()))}" for r in erratum.readings
    )
    used = escape(" ".join(erratum.taken.split()).rstrip("."))
    return f"{readings}\n<p><strong>Used here:</strong> {used}.</p>\n{paragraph(erratum.why)}"


def every_number(schema: Schema, parameter: Parameter) -> list[str]:
    """Return the numbers of a parameter on all machine types, each once."""
    here = [schema.on(machine.key).numbers(parameter) for machine in schema.family.machines]
    return list(dict.fromkeys(number for numbers in here for number in numbers.values()))


@cache
def _owners(schema: Schema) -> dict[tuple[str, str], str]:
    owners: dict[tuple[str, str], str] = {}
    for group in schema.groups:
        for parameter in group.parameters:
            for number in every_number(schema, parameter):
                owners.setdefault((group.key, number), parameter.id)
    return owners


def number_anchor(schema: Schema, parameter: Parameter, number: str) -> str:
    """Return where a number leads on the page of its group; what several parameters share,
    to the parameter itself.
    """
    group = schema.group_of[parameter.id].key
    return f"n-{number}" if _owners(schema)[group, number] == parameter.id else parameter.id


def first_number(schema: Schema, parameter: Parameter) -> str:
    """Return the number by which a parameter with many is known; empty where it has none."""
    return next(iter(every_number(schema, parameter)), "")
