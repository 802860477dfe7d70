"""One German word for one thing, in every text that a person reads: of the program and of the facts."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import pytest
import yaml

from amp_studio.files import new_file, open_file
from amp_studio.languages.catalogue import TextSection
from amp_studio.report import language_of
from amp_studio.schema import family_ids, load_schema, program_texts
from amp_studio.sim import listing
from amp_studio.sim.unit_system import described

ROOT = Path(__file__).resolve().parents[2]
FACTS = ROOT / "parameter_db"


def leaves(part: Any) -> Iterator[str]:
    """Yield every text of a document."""
    if isinstance(part, str):
        yield part
    elif isinstance(part, dict):
        for value in part.values():
            yield from leaves(value)


def program_pairs() -> list[tuple[str, str]]:
    """Return every English text of the program with its German one, each form of those with a number."""
    return [
        (english, form)
        for section in get_args(TextSection)
        for english, own in program_texts("de", section).items()
        for form in ([own] if isinstance(own, str) else own)
    ]


def pairs() -> list[tuple[str, str]]:
    """Return English and German of every text; where the English one is elsewhere, it is empty."""
    found = [(english.replace("&", ""), own.replace("&", "")) for english, own in program_pairs()]
    for path in sorted(FACTS.glob("*/de/**/*.yaml")):
        document = yaml.safe_load(path.read_text("utf-8"))
        phrases = document.pop("phrases", {})
        found += phrases.items()
        found += [("", text) for text in leaves(document)]
    return found


@pytest.mark.parametrize(
    ("english", "german"),
    [
        (r"\b[Ss]av(e|ed|ing)\b", r"\b[Ss]icher[nt]\b|gesichert"),  # Sicherung is a backup
        (r"\b[Ee]xchanges?\b", "Austausch"),
        ("", r"Gangstufe|Kennwort|Software-Endlage|Umkehrfehler|Dualgruppe|Ablesung der|referiert\b"),
        ("", r"\bEnter\b(?! Second)|\bEscape\b|Ctrl|Shift\+"),
        ("", r"\d in(?=[,.;:)/]|$)|\binch(es)?\b"),
    ],
)
def test_a_german_text_has_no_other_word_than_the_one_of_its_thing(english: str, german: str) -> None:
    allowed = re.compile(r"austauschen|\{[A-Z ,&]+\}|\[ENTER\]")
    wrong = [
        (source, own) for source, own in pairs() if re.search(english, source) and re.search(german, own)
    ]
    assert [pair for pair in wrong if not allowed.search(pair[1])] == []


def test_tuning_is_one_word() -> None:
    """It was Abgleichen, Abstimmen and Einstellen, which is what is done to every value."""
    tuning = [pair for pair in pairs() if re.search(r"\btun(e|ed|ing)\b", pair[0], re.IGNORECASE)]
    own = re.compile(r"[Aa]b(ge|zu)?stimm|Regler|\btune\b|^Tune ")
    assert [pair for pair in tuning if not own.search(pair[1])] == []


def test_the_default_alone_is_a_vorgabe() -> None:
    """The command of a move was one too."""
    wrong = [pair for pair in program_pairs() if "Vorgabe" in pair[1].replace("&", "")]
    assert [pair for pair in wrong if "efault" not in pair[0].replace("&", "")] == []


def test_an_order_of_the_program_has_no_sie() -> None:
    """Most orders had none, and one window had both ways."""
    asks = re.compile(r"\b\w+en Sie\b")
    assert [own for _, own in program_pairs() if asks.search(own.replace("&", ""))] == []


@pytest.mark.parametrize(
    "wrong",
    [
        r"\"\w|(?<!install )'[^' ]\S*'",  # „…“, but what is typed at a shell
        r"(?<![=+-])\b\d+%",
        r"\b(das|dem|vom|zum) [^.;]*-fachen?\b",
        r"(?<!  ) — ",
        r"(?<![\w)\]=+-])-\d(?![\d.]*%)",
    ],
    ids=["quotes", "per cent", "times", "dash", "minus"],
)
def test_german_signs(wrong: str) -> None:
    assert [own for _, own in pairs() if re.search(wrong, own)] == []


@pytest.mark.parametrize("family", family_ids())
def test_every_place_of_a_value_has_its_german_name(family: str) -> None:
    """A German form had columns with the heads network number and port number."""
    words = language_of("de", family)
    machines = (new_file(family, name).machine_schema for name in load_schema(family).machines)
    places = {machine.instance_label(address) for machine in machines for address in machine.places}
    named = {place.rstrip(" 0123456789") for place in places if words.text(place) == place}
    assert {name for name in named if re.search("[a-z]{2}", name)} <= {"Skip", "Interrupt"}


@pytest.mark.parametrize("length", ["mm", "in"])
@pytest.mark.parametrize("example", sorted(path.name for path in (ROOT / "examples").iterdir()))
def test_every_setting_of_a_simulation_is_described_in_german(example: str, length: str) -> None:
    """Those of a machine in inches were English."""
    file = open_file(next((ROOT / "examples" / example).glob("*.amp"))).file
    found, words = listing(file), language_of("de", file.schema.family.family)
    settings = {**found.model, **{n: m for each in found.scenarios for n, m in each.settings.items()}}
    own = {
        described(meaning, length): words.sentence(described(meaning, length))
        for meaning in settings.values()
    }
    english = re.compile(r"\b(default|or|the|of|with)\b")
    assert [pair for pair in own.items() if english.search(pair[1])] == []


def refusals() -> Iterator[str]:
    """Yield each sentence that a control, its line or an exchange refuses with, and 7 for what changes."""
    packages = (
        "client",
        "links",
        "image.py",
        "house",
        "plain",
        "emulated/control.py",
        "emulated/responder.py",
    )
    roots = [ROOT / "amp_studio/transfer" / name for name in packages]
    families = ROOT / "amp_studio/families"
    roots += [*families.glob("*/emulated"), *families.glob("*/lines"), families / "linuxcnc/control"]
    roots += [
        families / "grblhal" / f"{name}.py" for name in ("content", "driver", "kind", "line", "reading")
    ]
    typed = (
        "schema/values.py",
        "schema/bit_fields.py",
        "validate/cell_expression.py",
        "validate/expression_tree.py",
    )
    roots += [ROOT / "amp_studio" / name for name in typed]
    for path in (each for root in roots for each in (root.rglob("*.py") if root.is_dir() else [root])):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            arguments = (
                node.exc.args if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call) else []
            )
            for text in arguments:
                if isinstance(text, ast.JoinedStr):
                    yield "".join(map(_piece, text.values))
                elif isinstance(text, ast.Constant) and " " in str(text.value):
                    yield str(text.value)


def _piece(part: ast.expr) -> str:
    """Return the words of a text, or a figure, in quotes where it has some, in the place of a name."""
    if isinstance(part, ast.Constant):
        return str(part.value)
    return "'7'" if "quoted(" in ast.unparse(part) else "7"


def test_what_a_control_or_its_line_refuses_with_is_german() -> None:
    """It was English in the window but for some twenty sentences."""
    of_a_shell = re.compile(
        r"option|keyring|PASSWORD|first line|certificate|passphrase|listen|pseudo|folder is no line|memory of"
        r"|is damaged|number of axes|emulated control writes|Unknown|of 7 bytes|no fingerprint|(a|type) 7"
        r"|^(has|names|sets|this address|7 is not what) |which this program cannot|twice"
    )
    of_its_own = re.compile(
        r"PARAMETER|Axis expected|Syntax error|belong|packed|given|neither|too short|7:? 7"
        r"|^'7' 7$|7; 7|^7, not in|takes 7$|missing7|a name for the items|^the (file|copy)$"
    )
    words = language_of("de")
    english = {text for text in refusals() if words.message(text) == text}
    assert {text for text in english if not (of_a_shell.search(text) or of_its_own.search(text))} == set()
