"""Pages of the generated reference that lead from what a control shows to its cause."""

import re
from collections.abc import Iterable, Iterator
from html import escape

from reference_html import (
    facts_list,
    first_number,
    heading,
    listed,
    message_link,
    page,
    page_links,
    paragraph,
    parameter_link,
    rule_link,
    section,
)

from amp_studio.schema import Rule, Schema, read_address
from amp_studio.schema.model import ControlMessage, Messages

ONLY_PRINTED = "Only the message is printed, and no parameter is connected with it."


def messages(schema: Schema, every: Messages) -> str:
    """Return the page of a list of messages, each with the way to its cause."""
    find = f"<code>amp-studio find FILE.amp '{escape(every.messages[0].name)}'</code>"
    parts = [
        (
            f"<p>With the file of a machine, {find} shows the values behind a message and the rules that are"
            " broken.</p>"
        )
    ]
    parts += [paragraph(every.note)] if every.note else []
    parts += [part for message in every.messages for part in _message(schema, message)]
    return page(schema, every.title, *parts)


def all_messages(schemas: Iterable[Schema]) -> str:
    """Return the page that lists the messages of every family."""
    parts = [
        "# Messages of the controls",
        "What it means, and how to find its cause: for every message that the manuals print.",
    ]
    for schema in schemas:
        parts.append(heading(2, schema.family.name))
        for every in schema.message_lists:
            parts.append(f"<p><strong>{escape(every.title)}</strong></p>")
            parts.append(
                listed(
                    message_link(schema, message, f"{schema.family.family}/") for message in every.messages
                )
            )
    return "\n\n".join(parts)


def _message(schema: Schema, message: ControlMessage) -> Iterator[str]:
    yield section(message.id, message.name)
    facts = [("Reaction", escape(message.reaction))]
    if message.also:
        facts.append(("Also printed as", escape("; ".join(message.also))))
    if message.called:
        facts.append(("Also called", escape(", ".join(message.called))))
    if message.means:
        facts.append(("Meaning", escape(message.means)))
    if message.note:
        facts.append(("Note", escape(message.note)))
    facts.append(("Source", f"page {page_links(message.every_page)}"))
    yield facts_list(facts)
    steps = list(cause_steps(schema, message))
    if steps:
        yield "<p><strong>How to find the cause</strong></p>"
        if not message.causes:
            yield "<p>No cause is printed. These are the parameters connected with it, the nearest first.</p>"
        yield listed(steps, "ol")
    elif not message.cures:
        yield f"<p>{ONLY_PRINTED}</p>"
    if message.cures:
        yield f"<p><strong>What helps</strong></p>\n{listed(map(escape, message.cures), 'ol')}"
    if message.scenarios:
        tried = ", ".join(
            f"<code>amp-studio simulate FILE.amp {name} --axis X</code>" for name in message.scenarios
        )
        yield f"<p><strong>Try it without the machine:</strong> {tried}</p>"
    if message.reaction == "symptom" and (shown := list(_messages_about(schema, message))):
        yield f"<p><strong>What the control may show</strong></p>\n{listed(shown)}"


def _messages_about(schema: Schema, symptom: ControlMessage) -> Iterator[str]:
    """Yield the messages of the control about the parameters of a symptom."""
    for message in schema.messages.values():
        if message.reaction != "symptom" and set(message.params) & set(symptom.params):
            yield message_link(schema, message)


def cause_steps(schema: Schema, message: ControlMessage) -> Iterator[str]:
    """Yield what to look at in turn: the printed causes, each parameter with its rules,
    the rules of no parameter.
    """
    yield from map(escape, message.causes)
    every = {rule.id: rule for rule in schema.rules}
    rules = [every[name] for name in message.rules if name in every]
    names = [name for name in message.params if name in schema.parameters]  # a described control has its own
    reading = {name: [rule for rule in rules if _reads(rule, name)] for name in names}
    # A rule is named once: at the one of its parameters that the fewest rules read, which it is most about.
    own = {
        rule.id: min((n for n in names if rule in reading[n]), key=lambda n: len(reading[n]), default="")
        for rule in rules
    }
    for name in names:
        parameter = schema.parameters[name]
        number = first_number(schema, parameter)
        what = re.split(r"(?<=[.;])\s", " ".join(parameter.help.what.split()), maxsplit=1)[0].rstrip(";.")
        step = f"{escape(number)} {parameter_link(schema, parameter)}: {escape(what)}.".lstrip()
        checked = [rule for rule in rules if own[rule.id] == name]
        yield step + (f" A file is checked by: {_rule_links(checked)}." if checked else "")
    left = [rule for rule in rules if not own[rule.id]]
    if left:
        yield f"A file is also checked by: {_rule_links(left)}."


def _reads(rule: Rule, name: str) -> bool:
    return any(read_address(read)[0] == name for read in rule.reads.values())


def _rule_links(rules: Iterable[Rule]) -> str:
    return "; ".join(map(rule_link, rules))
