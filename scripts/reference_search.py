"""What the search of the site knows: every parameter, rule, message, table, step,
page of a manual and heading of a guide.

It is a script and not a JSON file, because a browser lets a page of file:// load scripts only.
``docs/_static/search.js`` asks it. An entry is [kind, title, address, exact names, words of names, words of
texts]; addresses are below that of their family.
"""

import json
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from urllib.parse import quote

from reference_html import (
    every_number,
    first_number,
    group_page,
    heading_id,
    list_pages,
    messages_page,
    printed_tables,
)
from reference_manual import printed_on

from amp_studio.find.synonyms import synonym_table
from amp_studio.guide import steps_of
from amp_studio.schema import Parameter, Schema, family_ids, load_schema
from amp_studio.schema.model import ControlMessage, Messages

Entry = list[str | list[str]]
_WORD = re.compile(r"[0-9]+(?:\.[0-9]+)+|[^\W_]+")


def search_script(guides: list[Entry]) -> str:
    """Return the script with the entries of every family and of the guides."""
    families: list[dict[str, object]] = []
    for family in family_ids():
        schema = load_schema(family)
        own = schema.family
        families.append(
            {
                "family": own.short or own.name,
                "names": [own.family, own.short, own.name],
                "folder": f"reference/{family}/",
                "entries": list(family_entries(schema)),
            }
        )
    families.append({"family": "", "names": [], "folder": "", "entries": guides})
    return f"searchSynonyms({_plain(synonym_table())});searchEntries({_plain(families)});"


def _plain(data: object) -> str:
    return json.dumps(data, ensure_ascii=False, separators=(",", ":"))


def family_entries(schema: Schema) -> Iterator[Entry]:
    """Yield the entries of a family, in the order of its manual."""
    for parameter in schema.parameters.values():
        yield _parameter(schema, parameter)
    for every in schema.message_lists:
        for message in every.messages:
            yield _message(message, every)
    own = schema.family
    yield ["list", own.name, "index.html", [own.family, own.short, own.name], "", _words(own.what)]
    for name, title in (
        list_pages(schema) | {messages_page(m): m.title for m in schema.message_lists}
    ).items():
        yield ["list", title, f"{name}.html", [], "", ""]
    for group in schema.groups:
        title = f"{group.name}: {group.section}" if group.section else group.name
        yield ["group", title, f"{group_page(group)}.html", [group.key], "", ""]
    for printed in printed_tables(schema):
        text = " ".join((*printed.head, printed.note))
        yield [
            "table",
            f"{printed.title} (page {printed.page})",
            _at("tables", printed.id),
            [printed.id, f"table {printed.id}"],
            "",
            _words(text),
        ]
    for rule in schema.rules:
        yield ["rule", rule.title, _at("rules", rule.id), [rule.id], "", _words(rule.message)]
    for step in steps_of(schema) if schema.commissioning is not None else ():
        yield [
            "step",
            f"Step {step.number}: {step.title}",
            _at("commissioning", f"step-{step.number}"),
            [],
            "",
            _words(step.what),
        ]
    for erratum in schema.errata.values():
        text = " ".join((*(reading.says for reading in erratum.readings), erratum.taken))
        yield ["contradiction", erratum.id, _at("errata", erratum.id), [erratum.id], "", _words(text)]
    for page in printed_on(schema):
        yield ["page", f"Page {page}", _at("pages", f"page-{page}"), [page], "", ""]


INTERNALS = ("architecture", "contributing", "described", "family-code", "schema")
"""Pages for those who change the program."""


def guide_entries(folder: Path) -> list[Entry]:
    """Return an entry for each heading of the pages that people wrote."""
    found: list[Entry] = []
    for path in sorted(folder.rglob("*.md")):
        name = path.relative_to(folder).with_suffix("").as_posix()
        if name.startswith("reference/") or name == "changelog":
            continue
        is_decision = name.startswith(
            "decisions/"
        )  # one entry each: their headings are the same on every page
        kind = "internals" if is_decision or name in INTERNALS else "guide"
        known: set[str] = set()
        title = ""
        text = path.read_text(encoding="utf-8").partition("```{toctree}")[0]
        plain_text = re.sub(
            r"^```.*?^```", lambda block: block[0].replace("#", " "), text, flags=re.MULTILINE | re.DOTALL
        )
        _, *sections = re.split(rf"^(?=#{{1,{1 if is_decision else 4}}} )", plain_text, flags=re.MULTILINE)
        for section in sections:
            heading, _, below = section.partition("\n")
            plain = re.sub(r"\[(.*?)\]\(.*?\)|[`*]", r"\1", heading.lstrip("# ")).strip()
            anchor = heading_id(plain)
            if not anchor or anchor in known:  # the second with the same words gets another
                continue
            known.add(anchor)
            title = title or plain
            address = _at(name, anchor) if len(known) > 1 else f"{name}.html"
            more = f"{name} {title}" if plain != title else name
            found.append(
                [kind, plain, address, [], re.sub("[/-]", " ", more), _words(re.sub("<[^>]*>", " ", below))]
            )
    return found


def _parameter(schema: Schema, parameter: Parameter) -> Entry:
    number = first_number(schema, parameter)
    group = schema.group_of[parameter.id]
    labels = [choice.label for choice in parameter.choices or () if parameter.type != "boolean"]
    labels += [bit.label for bit in parameter.bits or () if not bit.unknown]
    helped = parameter.help
    noted = (n.says for n in (*helped.danger, *helped.warning, *helped.note))
    units = schema.units_of(parameter)
    text = " ".join((group.name, group.section, *units, helped.what, helped.find, helped.wrong, *noted))
    return [
        "parameter",
        f"{number} {parameter.name}".strip(),
        _at(group_page(group), parameter.id),
        [parameter.id, *every_number(schema, parameter)],
        "; ".join(labels),
        _words(text),
    ]


def _message(message: ControlMessage, every: Messages) -> Entry:
    codes = [message.code, *message.also, message.id]
    if message.span is not None:
        codes += map(str, range(message.span[0], message.span[1] + 1))
    # A code that is only a number is asked for with a word: error 43.
    codes += [
        f"{kind} {code}" for code in codes if code.isdecimal() for kind in ("error", "message", "alarm")
    ]
    text = " ".join((every.title, message.reaction, message.means, *message.causes, *message.cures))
    return [
        "message",
        message.name,
        _at(messages_page(every), message.id),
        [c for c in codes if c],
        " ".join((*message.also, *message.called)),
        _words(text),
    ]


def _words(text: str) -> str:
    return " ".join(dict.fromkeys(_WORD.findall(text.casefold())))


def _at(page: str, anchor: str) -> str:
    return f"{quote(page)}.html#{quote(anchor)}"


def addresses(script: str) -> Iterable[str]:
    """Return every address of a script of entries, below the folder of the site."""
    for family in json.loads(script.strip().partition("searchEntries(")[2].removesuffix(");")):
        for entry in family["entries"]:
            yield family["folder"] + entry[2]
