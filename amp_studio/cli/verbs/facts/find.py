"""Find parameters, values, choices and messages of the control by what one remembers of them; typing errors
are forgiven.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from amp_studio.cli import candidates
from amp_studio.cli.arguments import JSON, count
from amp_studio.cli.console import family, print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio import MachineParameters
    from amp_studio.find import Hit, MessagePage
    from amp_studio.schema import Schema
    from amp_studio.validate import Finding

VERB = Verb(
    __doc__,
    VerbArgument(
        "words",
        nargs="+",
        metavar="FAMILY|FILE WORDS",
        help="where to look (every family), and what for",
        completes=candidates.family_first,
    ),
    VerbArgument("--family", help="look in this family", completes=candidates.families),
    VerbArgument("--limit", type=count, metavar="N", default=20, help="most hits (default: 20)"),
    JSON,
    sections=("families",),
    examples=(
        'amp-studio find 9pc "exess error"',
        'amp-studio find "SERVO AMP FE LIMITS"',
        "amp-studio find MILL_1394.amp 12.7 mm --json",
    ),
)


_NAMED = {
    "parameter": "",
    "value": "value",
    "choice": "choice",
    "message": "message",
    "group": "group",
    "note": "note",
}


class _Source:
    """A family, or a file of it, that is searched."""

    def __init__(self, schema: Schema, opened_machine: MachineParameters | None = None) -> None:
        from amp_studio.find import Finder

        file = opened_machine.file if opened_machine else None
        self.schema, self.file, self._opened = schema, file, opened_machine
        self.machine = file.machine if file is not None else schema.family.default_machine
        self.finder = Finder(schema, self.machine, file)
        self._findings: tuple[Finding, ...] | None = None

    def page(self, hit: Hit) -> MessagePage:
        """Return the page of a message; its rules are checked in the file, where there is one."""
        from amp_studio.find import message_page

        # Only a message has rules to check: a search for a name does not wait for a check of the whole file.
        if self._findings is None:
            self._findings = self._checked()
        message = self.schema.messages[hit.key]
        return message_page(self.schema, self.machine, message, self.file, self._findings)

    def _checked(self) -> tuple[Finding, ...]:
        return self._opened.validator().run() if self._opened else ()


def run(options: Options) -> int:
    """Find what has the words, or nearly; print the best first, with the reason."""
    from amp_studio.schema import quoted

    sources, words = _sources(options)
    query = " ".join(words)
    if not query.strip():
        raise UsageError("Nothing to find: give a number, a word, a value or a message of the control")
    found = _best(sources, query, options.limit)
    nearest = "" if found else _nearest(sources, query)
    # The other families are loaded only for a question that would end here without an answer.
    others = () if found or len(sources) > 1 else _hits_of_other_families(query, sources[0].schema)
    if options.json:
        hits = [_as_json(hit, source) for hit, source in found]
        print_json({"query": query, "hits": hits, "nearest": nearest} | _elsewhere_json(others))
    elif found:
        _print(found, named=len(sources) > 1)
    else:
        print(f"Nothing found for {quoted(query)}" + (f". Nearest: {nearest}" if nearest else ""))
        for way in _ways_on(others, sources):
            print_remark(way)
    return 0


def _best(sources: Sequence[_Source], query: str, most: int) -> list[tuple[Hit, _Source]]:
    """Return the best matches of all sources, the best first."""
    found = [(hit, source) for source in sources for hit in source.finder.find(query, most)]
    found.sort(key=lambda each: -each[0].score)
    if len(sources) > 1:  # what one family has exactly is not buried by what five have nearly
        found = [each for each in found if each[0].score >= found[0][0].score / 3]
    return found[:most]


def _nearest(sources: Sequence[_Source], query: str) -> str:
    return next(filter(None, (source.finder.nearest(query) for source in sources)), "")


def _hits_of_other_families(query: str, schema: Schema) -> Sequence[tuple[Schema, Hit]]:
    """Return the best hit of each other family."""
    from amp_studio import family_ids, load_schema
    from amp_studio.find import Finder, elsewhere

    schemas = [load_schema(name) for name in family_ids() if name != schema.family.family]
    return elsewhere(query, (Finder(s, s.family.default_machine) for s in schemas))


def _ways_on(others: Sequence[tuple[Schema, Hit]], sources: list[_Source]) -> Iterator[str]:
    """Yield what can be done about a question without an answer."""
    for schema, hit in others:
        yield f"In another family: {schema.family.family}: {hit.title}"
    if len(sources) == 1:
        name = sources[0].schema.family.family
        yield f"Everything there is: amp-studio guide {name}, by step; amp-studio schema {name}, by group"
    yield (
        "A word that is missing: add it to synonyms.yaml of the parameter database, or report it"
        " (CONTRIBUTING.md)"
    )


def _sources(options: Options) -> tuple[list[_Source], list[str]]:
    """Return what is searched and for which words: the first may be a family or a file;
    else it is every family.
    """
    from amp_studio import family_ids
    from amp_studio.files import ENDING

    first, *words = options.words
    if options.family is not None:
        return [_Source(family(options.family))], options.words
    if first in family_ids():
        return [_Source(family(first))], words
    path = Path(first)
    # Any file counts only with words behind it: ``find X`` alone is a question about X, even beside a file X.
    if path.suffix.casefold() == ENDING or (words and path.is_file()):
        machine = opened(path)
        return [_Source(machine.schema, machine)], words
    return [_Source(family(name)) for name in family_ids()], options.words


def _elsewhere_json(others: Sequence[tuple[Schema, Hit]]) -> dict[str, list[dict[str, str]]]:
    named = [{"family": s.family.family, "id": hit.key, "title": hit.title} for s, hit in others]
    return {"elsewhere": named} if named else {}


def _as_json(hit: Hit, source: _Source) -> dict[str, Any]:
    """Return one hit as ``--json`` lists it; a message with all that is known of it."""
    from amp_studio.schema import written

    schema = source.schema
    data: dict[str, Any] = {
        "family": schema.family.family,
        "kind": hit.kind,
        "id": hit.key,
        "title": hit.title,
        "detail": hit.detail,
        "why": hit.why,
        "score": round(hit.score, 2),
    }
    if hit.address is not None:
        data["param"] = schema.on(source.machine).short(hit.address)
        data["instance"] = hit.address[1]
    if hit.others:
        data["others"] = [written(address) for address in hit.others]
    if hit.key in schema.parameters:
        data["source"] = schema.parameters[hit.key].page
    if hit.kind == "message":
        data |= _message_json(source.page(hit))
    return data


def _message_json(page: MessagePage) -> dict[str, Any]:
    """Return what is known of a message, with the values and the broken rules of the file."""
    from amp_studio.schema import written

    message = page.message
    return {
        "code": message.code,
        "text": message.text,
        "reaction": message.reaction,
        "means": message.means,
        "causes": message.causes,
        "cures": message.cures,
        "called": message.called,
        "scenarios": message.scenarios,
        "note": message.note,
        "params": [
            {
                "id": p.id,
                "name": p.name,
                "number": p.number,
                "values": [{"param": written(v.address), "value": v.text} for v in p.values],
            }
            for p in page.parameters
        ],
        "rules": [
            {
                "rule": linked.rule.id,
                "title": linked.rule.title,
                "broken": bool(linked.findings),
                "messages": [finding.message for finding in linked.findings],
            }
            for linked in page.rules
        ],
        "source": message.page,
        "pages": message.pages,
    }


def _print(found: list[tuple[Hit, _Source]], named: bool) -> None:
    """Print the hits, the best first; one that is a message with its whole page."""
    best, source = found[0]
    # An alarm is looked up at a machine that has stopped: its whole page, not a line that leads to it.
    if best.kind == "message":
        print(_family_prefix(source, named) + best.title)
        print(*_page_lines(source.page(best), best), sep="\n")
        found = found[1:]
        if found:
            print()
    for hit, source in found:
        kind = f"{_NAMED.get(hit.kind, hit.kind)} " if _NAMED.get(hit.kind, hit.kind) else ""
        print(f"{_family_prefix(source, named)}{kind}{hit.title}: {hit.detail} ({hit.why})")


def _family_prefix(source: _Source, named: bool) -> str:
    return f"{source.schema.family.family:8} " if named else ""


def _page_lines(page: MessagePage, hit: Hit) -> Iterator[str]:
    """Yield a message as a person reads it: what it means, where to look, what helps."""
    message = page.message
    if message.means:
        yield f"  {message.means}"
    if hit.detail.startswith("axis"):
        yield f"  Here: {hit.detail.partition(',')[0]}"
    yield from _listed("Causes", message.causes)
    yield from _listed("What helps", message.cures)
    yield from _listed("Try it", (f"amp-studio simulate FILE {name}" for name in message.scenarios))
    yield from _listed("Parameters", (_parameter_line(page, n) for n in range(len(page.parameters))))
    yield from _rule_lines(page)
    if message.note:
        yield f"  {' '.join(message.note.split())}"
    yield f"  Page {', '.join(message.every_page)}"


def _rule_lines(page: MessagePage) -> Iterator[str]:
    """Yield what the rules of a message find in this file, or which they are where they find nothing."""
    from amp_studio.report import counted

    for linked in page.rules:
        for finding in linked.findings:
            yield f"  Broken in this file: {finding.message}"
    if page.rules and page.broken == ():
        rules = ", ".join(linked.rule.id for linked in page.rules)
        yield f"  Checked by {counted(len(page.rules), 'rule')}: {rules}"


def _parameter_line(page: MessagePage, n: int) -> str:
    linked = page.parameters[n]
    values = ", ".join(f"{v.place} {v.text}".lstrip() for v in linked.values)
    return f"{linked.number} {linked.name}".strip() + (f" = {values}" if values else "")


def _listed(title: str, texts: Iterable[str]) -> Iterator[str]:
    lines = tuple(texts)
    if lines:
        yield f"  {title}:"
        yield from (f"    - {line}" for line in lines)
