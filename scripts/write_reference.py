"""Writes the reference of every parameter of every family, in Markdown, into a folder: one page a group.

All of it comes from the schema and from the functions behind ``amp-studio show``, so that the pages are never
another opinion than the program. Sphinx makes the site of them (``make docs``).
"""

import sys
from collections.abc import Iterator
from html import escape
from pathlib import Path

from reference_html import (
    admonition,
    contradiction,
    every_number,
    facts_list,
    group_page,
    heading,
    link,
    list_pages,
    listed,
    message_link,
    messages_page,
    number_anchor,
    page,
    page_link,
    page_links,
    paragraph,
    parameter_link,
    parameter_links,
    printed_tables,
    rule_link,
    rule_source,
    section,
    table,
)
from reference_lists import commissioning, errata, motion, numbers, rules, tables
from reference_manual import manual_pages
from reference_messages import all_messages, messages
from reference_search import guide_entries, search_script

from amp_studio.guide import step_of, steps_of
from amp_studio.report import facts, help_parts
from amp_studio.report.parameter.manual_page import formula_lines
from amp_studio.report.wording import severity_name
from amp_studio.schema import Group, Parameter, Schema, family_ids, load_schema, read_address

LEGEND = """## How to read it

- The number before a name is that of the first axis, where each axis has its own.
- A range is given in each unit in which a file can have the value; a choice with its letter in the manual and
  the code that is stored.
- *Hidden*, *Ignored* and *Not available* are the reasons for which a parameter may have no effect on a
  machine; while none applies it is active.
- *Danger*, *Warning* and *Note* are what the manual warns of. *Contradiction* is where it has several
  readings, with the one that is used here and why.
- Each page number leads to all that is taken from that page of the manual."""


def reference() -> dict[str, str]:
    """Return the text of every page by its path below ``reference/``."""
    schemas = [load_schema(family) for family in family_ids()]
    pages = {"index.md": overview(), "messages.md": all_messages(schemas)}
    for schema in schemas:
        pages |= {f"{schema.family.family}/{name}.md": text for name, text in family_pages(schema).items()}
    return pages


def overview() -> str:
    """Return the page that leads to the families."""
    schemas = [load_schema(family) for family in family_ids()]
    rows = (
        (
            f'<a href="{s.family.family}/index.html">{escape(s.family.name)}</a>',
            f'<a href="{s.family.family}/numbers.html">{len(s.parameters)}</a>',
            f'<a href="{s.family.family}/rules.html">{len(s.rules)}</a>',
            str(len(s.messages)),
            f'<a href="{s.family.family}/pages.html">{escape(s.family.title)}</a>',
        )
        for s in schemas
    )
    return "\n\n".join(
        [
            heading(1, "Reference"),
            (
                "Every parameter, rule and message of every control family, made from the same facts as the"
                " program."
            ),
            table(("Family", "Parameters", "Rules", "Messages", "Manual"), rows),
            LEGEND,
            "\n".join(
                ["```{toctree}", ":hidden:", "", *(f"{s.family.family}/index" for s in schemas), "```"]
            ),
        ]
    )


def family_pages(schema: Schema) -> dict[str, str]:
    """Return the pages of one family by name."""
    lists = {
        "numbers": numbers,
        "pages": manual_pages,
        "commissioning": commissioning,
        "motion": motion,
        "rules": rules,
        "tables": tables,
        "errata": errata,
    }
    pages = {"index": family_index(schema)}
    pages |= {group_page(group): group_text(schema, group) for group in schema.groups}
    pages |= {messages_page(listed): messages(schema, listed) for listed in schema.message_lists}
    return pages | {name: lists[name](schema) for name in list_pages(schema)}


def family_index(schema: Schema) -> str:
    """Return the page that leads to all others of a family."""
    groups = [f"{page_link(group_page(g), group_title(g))} ({len(g.parameters)})" for g in schema.groups]
    shown = [f"{page_link(messages_page(m), m.title)} ({len(m.messages)})" for m in schema.message_lists]
    parts = [
        heading(1, schema.family.name),
        paragraph(f"{schema.family.title} ({schema.family.document}). {schema.family.what}"),
        heading(2, "Look up"),
        listed(page_link(name, title) for name, title in list_pages(schema).items()),
        heading(2, "Parameters by group"),
        listed(groups),
    ]
    if shown:
        parts += [heading(2, "Messages of the control"), listed(shown)]
    return "\n\n".join(parts)


def group_title(group: Group) -> str:
    """Return what a group is called, with its section."""
    return f"{group.name}: {group.section}" if group.section else group.name


def group_text(schema: Schema, group: Group) -> str:
    """Return the page of a group: its parameters in the order of the manual."""
    parts = [part for parameter in group.parameters for part in parameter_parts(schema, parameter)]
    return page(schema, group_title(group), paragraph(f"Chapter {group.chapter} of the manual."), *parts)


def parameter_parts(schema: Schema, parameter: Parameter) -> Iterator[str]:
    """Yield the parts of the section of one parameter."""
    every = every_number(schema, parameter)
    places = (number_anchor(schema, parameter, number) for number in every)
    yield section(parameter.id, " ".join([*every[:1], parameter.name]), *places)
    source = page_links((parameter.page, *parameter.pages.values()))
    yield facts_list(
        (title, f"{escape(schema.family.title)}, page {source}" if title == "Source" else escape(text))
        for title, text in facts(schema, parameter)
    )
    for title, text in help_parts(schema, parameter):
        if title == "Related":
            yield f"<p><strong>Related.</strong> {parameter_links(schema, parameter.help.related)}</p>"
        elif title in ("Danger", "Warning", "Note"):
            yield admonition(title.lower(), title, paragraph(text))
        elif not title.startswith("Contradiction"):
            yield paragraph(text, title)
    for name in parameter.errata:
        if name in schema.errata:
            yield admonition("caution", "Contradiction in the manual", contradiction(schema.errata[name]))
    for title, entries in linked(schema, parameter):
        shown = listed(entries)
        if shown:
            yield f"<p><strong>{title}</strong></p>\n{shown}"


def linked(schema: Schema, parameter: Parameter) -> Iterator[tuple[str, list[str]]]:
    """Yield what leads away from a parameter: (title, entries)."""
    yield "Formulas", [escape(line) for line in formula_lines(schema, parameter)]
    if schema.commissioning is not None:
        steps, own = steps_of(schema), step_of(schema)[parameter.id]
        yield (
            "Commissioning",
            [
                link("commissioning", f"step-{s.number}", f"Step {s.number} of {len(steps)}: {s.title}")
                + f" (page {page_links([s.page])})"
                for s in steps
                if s is own or parameter in s.again
            ],
        )
    yield (
        "Messages of the control",
        [
            f"{message_link(schema, m)} (page {page_links(m.every_page)})"
            for m in schema.messages_of(parameter.id)
        ],
    )
    yield (
        "Rules that read it",
        [
            f"{severity_name(rule.severity)}: {rule_link(rule)} ({rule_source(rule)})"
            for rule in schema.rules
            if any(read_address(read)[0] == parameter.id for read in rule.reads.values())
        ],
    )
    yield (
        "Tables",
        [
            link("tables", t.id, t.title) + f" (page {page_links([t.page])})"
            for t in printed_tables(schema)
            if parameter.id in t.params
        ],
    )
    yield (
        "Named by",
        [
            parameter_link(schema, other)
            for other in schema.parameters.values()
            if parameter.id in other.help.related and other.id not in parameter.help.related
        ],
    )


def main() -> None:
    """Write the pages and what the search knows into the folder of the site's sources that is named."""
    folder = Path(sys.argv[1])
    pages = {f"reference/{name}": text for name, text in reference().items()}
    pages["_static/search-entries.js"] = search_script(guide_entries(folder))
    for name, text in pages.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
