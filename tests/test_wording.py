"""The words of messages, help, docstrings, comments and documents: the terms of the field, no private idiom.

Every room of the program is checked, every document listed here, the docstrings and comments of the tests,
and the texts of ``parameter_db``. Names in backquotes and the values in braces of a message are not checked,
and neither is a text of a single word (a key); identifiers are checked where they are defined.
"""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from amp_studio.schema import family_ids
from amp_studio.schema.load import load_compiled
from amp_studio.schema.model.compiled_json import text_record

ROOT = Path(__file__).parent.parent

FORBIDDEN = {
    "told": "shown, listed, reported",
    "tell": "return, show",
    "tells": "returns, shows",
    "said": "message, text",
    "says": "is, contains",
    "held": "contained, stored, constant",
    "holds": "contains, is stored",
    "stands": "is",
    "wants": "needs, requires",
    "out of force": "inactive",
    "in force": "active",
    "advice": "recommendation",
    "repair": "suggested fix",
    "repairs": "suggested fixes",
    "unset": "not set",
    "absent": "not set",
    "of its own": "separate",
    "where that is": "if",
    "gives way": "has lower precedence",
    "given up": "cancelled",
    "all the same": "anyway",
    "the other way round": "in the opposite direction",
    "born": "default",
    "looked at": "checked",
    "stand": "are",
    "stood": "was",
    "speaks of": "names",
    "anew": "again",
    "whoever": "the person who",
    "is none of": "is not one of",
}
"""Word or phrase -> what to write instead."""

ALLOWED: dict[tuple[str, str], str] = {
    ("e-201-status", "unset"): "as the control's screen has it",
    ("resolution.encoder_type", "unset"): "as the control's screen has it",
    ("amp_studio/ui/page/steps_panel.py", "held"): "findings are held back",
    ("tests/validate/test_builder_rules.py", "advice"): "the key of a rule in a file",
}
"""(file or id of a fact, word) -> why it may stay there."""

OF_A_MACHINE = {"says", "stands", "stand", "holds", "held", "of its own"}
"""Not in a message or a title; in help and errata, for what manuals, axes and brakes do."""

ROOMS = sorted(
    p.name
    for p in (ROOT / "amp_studio").iterdir()
    if p.suffix == ".py" or (p.is_dir() and p.name != "__pycache__")
)
DOCUMENTS = (
    "README.md",
    "CONTRIBUTING.md",
    "docs/architecture.md",
    "docs/commands.md",
    "docs/commissioning.md",
    "docs/described.md",
    "docs/family-code.md",
    "docs/formats.md",
    "docs/rules.md",
    "docs/schema.md",
    "docs/simulation.md",
    "docs/sheet.md",
    "docs/protocols/registers.md",
    "docs/protocols/image.md",
    "docs/protocols/exchange.md",
    "docs/protocols/exchange-client.md",
    "docs/protocols/num-table.md",
    "docs/protocols/acr-terminal.md",
    "docs/protocols/grblhal.md",
    "Makefile",
    *sorted(p.relative_to(ROOT).as_posix() for p in ROOT.glob("examples/*/README.md")),
    *sorted(
        p.relative_to(ROOT).as_posix()
        for folder in ("formats", "schema", "simulation")
        for p in ROOT.glob(f"docs/{folder}/*.md")
    ),
    *sorted(p.relative_to(ROOT).as_posix() for p in ROOT.glob("docs/decisions/*.md")),
)

_PATTERN = re.compile(rf"\b({'|'.join(map(re.escape, FORBIDDEN))})\b", re.IGNORECASE)
_NAMES = re.compile(r"``.*?``|`[^`\n]*`|\{[^{}]*\}|[\w-]+\.[\w.-]+|\"[^\"\n]*\"")


_COMMENT_OR_STRING = re.compile(
    r'''#[^\n]*|(?:\b[bfru]{1,2})?(?:"""(?:\\.|[^\\])*?"""|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')''',
    re.IGNORECASE | re.DOTALL,
)
"""``tokenize`` finds the same in fifteen times the time: seconds, for all modules."""

_CODE = re.compile(r"^```.*?^```|(?<=\n\n)(?:    [^\n]*\n|\n)+", re.MULTILINE | re.DOTALL)
"""Blocks of a document that are no text. Lines that go on with an entry of a list are indented, too,
but follow a line."""


def comments_and_strings(source: str) -> Iterator[tuple[int, str]]:
    """Yield the place and the text of every comment and string of a module, with its quotes and prefix."""
    yield from ((found.start(), found[0]) for found in _COMMENT_OR_STRING.finditer(source))


def texts_of(path: Path) -> Iterator[tuple[int, str]]:
    """Yield line and text of every docstring, message and comment of a module."""
    source = path.read_text(encoding="utf-8")
    for at, text in comments_and_strings(source):
        if text.startswith("#") or " " in text:
            yield source.count("\n", 0, at) + 1, text.strip("frb").strip("\"'")


def modules_of(room: Path) -> list[Path]:
    """Return the modules of a folder, or the one module."""
    return sorted(room.rglob("*.py")) if room.is_dir() else [room]


def words_in(text: str) -> list[str]:
    """Return the forbidden words of a text, without those in names and values."""
    return [found.casefold() for found in _PATTERN.findall(_NAMES.sub(" ", text))]


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_uses_the_words_of_the_field(room: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: '{word}' ({FORBIDDEN[word]}) in: {text.strip()[:90]}"
        for path in modules_of(ROOT / "amp_studio" / room)
        for line, text in texts_of(path)
        for word in words_in(text)
        if (path.relative_to(ROOT).as_posix(), word) not in ALLOWED
    ]
    assert not found, "\n".join(found)


NAME_WORDS = {
    *("told", "tell", "tells", "said", "says", "held", "holds", "stands", "unset", "absent", "wants", "anew"),
    *("meant", "dress", "wear", "ink", "inks", "ground", "incarnation", "nobody", "somebody", "person"),
    *("born", "situation", "conversation", "fetching", "hang"),
    *("obey", "deaf", "hopeless", "restless", "wish", "wished", "unheld", "lingers"),
}
"""Words that no identifier has as a part: what is defined with one was renamed after the field's word."""
NAME_PARTS = ("answer_once", "no_more")
NAME_STARTS = ("MOST_", "LEAST_", "FEWEST_")
"""A bound is MAX_ or MIN_."""
WHOLE_NAMES = {"shown", "set_many", "all_axes", "Index", "Place", "Cell", "Setting"}
"""No identifier has one of these as its whole name: each had several meanings."""
FUNCTION_NAMES = {"take", "look", "leave"}
"""No private function has one of these as its whole name: it names what it does or returns."""
ALLOWED_NAMES = {
    ("amp_studio/families/acromill/formulas/geometry.py", "wear"): "the wear offset of a tool",
    ("amp_studio/families/ninepc/formulas/tools.py", "wear"): "the wear offset of a tool",
    ("amp_studio/families/ninepc/formulas/tools.py", "geometry_as_wear"): "the wear offset of a tool",
    ("amp_studio/report/chapters.py", "says"): "templates of builders read it",
    ("amp_studio/schema/model/documents.py", "says"): "a key of the facts",
    ("amp_studio/schema/model/parameter.py", "says"): "a key of the facts",
    ("amp_studio/schema/model/family.py", "absent_when"): "a key of the facts",
    ("amp_studio/schema/model/family.py", "shown"): "a key of the facts",
    ("amp_studio/transfer/emulated/record.py", "incarnation"): "a key of control.json",
    ("amp_studio/transfer/house/message.py", "incarnation"): "the frozen protocol names it so",
}
"""(file, identifier) -> why it may stay there."""


def names_of(source: str) -> Iterator[str]:
    """Yield the identifiers that a module defines: functions, classes, parameters, variables, attributes."""
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
                yield f"{name}()"
            case ast.ClassDef(name=name) | ast.arg(arg=name):
                yield name
            case ast.Name(id=name, ctx=ast.Store()) | ast.Attribute(attr=name, ctx=ast.Store()):
                yield name


def banned_names_in(source: str) -> set[str]:
    """Return the identifiers that a module defines and that the glossary has another word for."""
    code = _COMMENT_OR_STRING.sub(" ", source)
    if not any(is_banned(name) for name in set(re.findall(r"\w+", code))):
        return set()  # parsing all modules takes seconds
    names = ((defined, defined.removesuffix("()")) for defined in names_of(source))
    return {name for defined, name in names if is_banned(name, is_function=name != defined)}


@cache
def is_banned(name: str, *, is_function: bool = True) -> bool:
    """Return whether the glossary has another word for an identifier, which may be that of a function."""
    words = {word.casefold() for word in re.findall("[A-Z]?[a-z0-9]+|[A-Z]+", name)}
    is_private = is_function and name.startswith("_") and name.strip("_") in FUNCTION_NAMES
    is_vague = is_private or name.strip("_") in WHOLE_NAMES
    is_vague = is_vague or name.strip("_").startswith(NAME_STARTS)
    return is_vague or not words.isdisjoint(NAME_WORDS) or any(part in name for part in NAME_PARTS)


def test_an_identifier_uses_the_words_of_the_field() -> None:
    found = {
        (path.relative_to(ROOT).as_posix(), name)
        for path in sorted((ROOT / "amp_studio").rglob("*.py"))
        for name in banned_names_in(path.read_text("utf-8"))
    }
    assert found == ALLOWED_NAMES.keys()


NAMED_AS_THE_FACTS = {
    "says": "a key of the facts",
    "incarnation": "the frozen protocol names it so",
    "as_wear": "the wear offset of a tool",
    "test_wear_is_added_to_the_radius": "the wear offset of a tool",
}
HELPERS_LEFT = {
    *("conversation.py", "faulty_grbl.py", "bench.py", "small_module.py", "own_contents.py", "persons.py"),
    *("stored.py", "verbs.py", "wire.py", "family.py", "patch_9pc.py", "statements.py", "checks_57c422b.py"),
    *("checks_9pc.py", "checks_acromill.py", "checks_num.py", "checks_syntec.py", "hostile_clients.py"),
    *("hostile_controls.py", "steps.py"),
}
"""Helpers of several tests whose names are as they were."""


def test_a_test_uses_the_words_of_the_field_for_its_names() -> None:
    """Not in a module that generates its cases: they are made of its text, and another name makes others."""
    found = {
        (path.relative_to(ROOT).as_posix(), name)
        for path in sorted((ROOT / "tests").rglob("*.py"))
        if path.name not in HELPERS_LEFT and "hypothesis" not in (text := path.read_text("utf-8"))
        for name in banned_names_in(text)
        if name not in NAMED_AS_THE_FACTS
    }
    assert not found, "\n".join(f"{path}: {name}" for path, name in sorted(found))


@pytest.mark.parametrize(
    ("source", "found"),
    [
        ("axis_meant = 1", {"axis_meant"}),
        ("class MeantFigure: ...", {"MeantFigure"}),
        ("def no_more(held): ...", {"no_more", "held"}),
        ("def _take(self): ...", {"_take"}),
        ("class Place: ...", {"Place"}),
        ("for _shown, is_shown in rows: ...", {"_shown"}),
        ("self._ink, take = 1, 2", {"_ink"}),
        ("MOST_ROWS = _LEAST_WIDTH = 1", {"MOST_ROWS", "_LEAST_WIDTH"}),
        ("why_not = taken('what is meant')", set()),
    ],
)
def test_a_planted_name_is_found(source: str, found: set[str]) -> None:
    assert banned_names_in(source) == found


@pytest.mark.parametrize("document", DOCUMENTS)
def test_a_document_uses_the_words_of_the_field(document: str) -> None:
    text = _CODE.sub("", (ROOT / document).read_text("utf-8"))
    found = [
        f"{document}:{n}: '{word}' ({FORBIDDEN[word]}) in: {line.strip()[:90]}"
        for n, line in enumerate(text.splitlines(), 1)
        for word in words_in(line)
        if (document, word) not in ALLOWED
    ]
    assert not found, "\n".join(found)


def prose_of(path: Path) -> Iterator[tuple[int, str]]:
    """Yield line and text of every docstring and comment of a module."""
    source = path.read_text(encoding="utf-8")
    for at, text in comments_and_strings(source):
        begins = source.rfind("\n", 0, at) + 1
        if text.startswith("#") or (text.startswith('"""') and not source[begins:at].strip()):
            yield source.count("\n", 0, begins) + 1, text.strip('"')


@pytest.mark.parametrize("folder", ["tests", "bench", "scripts"])
def test_the_prose_of_tests_and_scripts_uses_the_words_of_the_field(folder: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: '{word}' ({FORBIDDEN[word]}) in: {text.strip()[:90]}"
        for path in modules_of(ROOT / folder)
        for line, text in prose_of(path)
        for word in words_in(text)
        if (path.relative_to(ROOT).as_posix(), word) not in ALLOWED
    ]
    assert not found, "\n".join(found)


_COMMAND_LINE = re.compile(r"(?<![\w-])--[a-z]|\bamp-studio [a-z]")
_WINDOW = re.compile(r"\b[A-Z]\w+ > [A-Z]|\b(?:in|of) the window\b|\btool bar\b|\bclick\b")
AT_ITS_PLACE = {
    "amp_studio/demo.py": "is run in a terminal",
    "amp_studio/ui/base/display.py": "is printed in a terminal, where no window can be",
}
"""Modules whose sentences are shown in one place only -> which."""


def messages_of(path: Path) -> Iterator[tuple[int, str]]:
    """Yield line and text of every string of a module that is neither a docstring nor a word alone."""
    prose = set(prose_of(path))
    yield from (each for each in texts_of(path) if each not in prose and not each[1].startswith("#"))


def shared_texts() -> Iterator[tuple[str, int, str]]:
    """Yield file, line and text of what command line, window and library all show."""
    for path in sorted((ROOT / "amp_studio").rglob("*.py")):
        name = path.relative_to(ROOT).as_posix()
        if not name.startswith("amp_studio/cli/") and name not in AT_ITS_PLACE:
            yield from ((name, line, text) for line, text in messages_of(path))
    texts = [*(ROOT / "amp_studio/languages").glob("*.toml"), *(ROOT / "parameter_db").rglob("*.yaml")]
    for path in sorted(texts):
        for n, line in enumerate(path.read_text("utf-8").splitlines(), 1):
            yield path.relative_to(ROOT).as_posix(), n, re.sub(r"(^| +)#.*", "", line)


def test_what_all_show_names_no_option_or_verb_of_the_command_line() -> None:
    """A setting is named by its own name, which all three take; the command line adds its option."""
    found = [
        f"{name}:{n}: {text.strip()[:120]}" for name, n, text in shared_texts() if _COMMAND_LINE.search(text)
    ]
    assert not found, "\n".join(found)


def test_what_command_line_and_library_show_names_no_menu_of_the_window() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{n}: {text.strip()[:120]}"
        for path in sorted((ROOT / "amp_studio").rglob("*.py"))
        if path.relative_to(ROOT).parts[1] != "ui"
        for n, text in messages_of(path)
        if _WINDOW.search(text)
    ]
    assert not found, "\n".join(found)


def facts_of(node: object, key: str = "", place: str = "") -> Iterator[tuple[str, str, str]]:
    """Yield the texts of some facts, each with the id of its entry and the key that it is under."""
    if isinstance(node, dict):
        place = str(node.get("id", place))
        for name, value in node.items():
            yield from facts_of(value, str(name), place)
    elif isinstance(node, (list, tuple)):
        for value in node:
            yield from facts_of(value, key, place)
    elif isinstance(node, str) and " " in node:
        yield place, key, node


def compiled(family: str) -> dict[str, object]:
    """Return all facts of a family."""
    found = load_compiled(family)
    return found.model_dump(exclude={"further"}) | text_record(found.further).model_dump()


@pytest.mark.parametrize("family", family_ids())
def test_the_facts_use_the_words_of_the_field(family: str) -> None:
    """A message and a title are the program's own text; other texts may describe what a machine does."""
    found = [
        f"{family}: {place}: {key}: '{word}' ({FORBIDDEN[word]}) in: {text[:120]}"
        for place, key, text in facts_of(compiled(family))
        for word in words_in(text)
        if key in ("message", "title") or word not in OF_A_MACHINE
        if (place, word) not in ALLOWED
    ]
    assert not found, "\n".join(found)


def test_an_exception_is_still_needed() -> None:
    facts: dict[str, list[str]] = {}
    for family in family_ids():
        for place, _, text in facts_of(compiled(family)):
            facts.setdefault(place, []).append(text)
    for name, word in ALLOWED:
        texts = [text for _, text in texts_of(ROOT / name)] if name.endswith(".py") else facts[name]
        assert any(word in words_in(text) for text in texts), f"{name} has no '{word}' any more"


def test_the_check_finds_a_word_and_leaves_names_alone() -> None:
    assert words_in("The parameter is unset and out of force") == ["unset", "out of force"]
    assert words_in("the rule schema.unset, the option `advice`, {told}") == []
