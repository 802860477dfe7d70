"""Damaged texts, as many as are wanted, the same for the same seed: for every reader of a file.

Each ``fuzz_…`` takes a seed and a count and returns the violations: what was raised that is not the one
documented error, what took longer than ``SLOWEST``,
and what was taken and could not be written or read back as the same.
"""

import json
import random
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TypeVar
from unittest import mock

from amp_studio.files import (
    Document,
    ParameterFile,
    ParameterFileError,
    Project,
    content_of,
    new_file,
    origin_named,
    read_content,
)
from amp_studio.files.storage import readable_content, save_file
from amp_studio.formats import FormatError, export_file, formats_of, import_file
from amp_studio.schema import (
    Address,
    BuilderRule,
    InvalidValueError,
    Suppression,
    Value,
    family_ids,
    load_schema,
    read_entries,
)
from amp_studio.schema.yaml_reader import YamlError, read_yaml
from amp_studio.transfer.client.record import add_exchange, exchange_now, read_exchanges, record_path
from amp_studio.validate.beside import earlier_beside
from tests.campaigns import CAMPAIGN

Case = TypeVar("Case")
SLOWEST = 5.0
"""Seconds of processor time for one damaged text, checked in ``make faults`` alone: no test depends on a
clock."""
REPOSITORY = Path(__file__).resolve().parents[2]

TOKENS = (
    "<<: 5",
    "foo: 2001-99-99",
    "foo: 2001-12-14T21:59:43.10-05:00",
    "...",
    "---",
    "s: !!int",
    "!!python/object:os.system x",
    "&a",
    "*a",
    "&a [*a]",
    "[" * 900,
    "{" * 900,
    "- " * 900,
    "? " * 60,
    "\t",
    "l | b's\t",
    "|",
    "|+2",
    ">-",
    ">9",
    "%YAML 1.1",
    "%TAG ! tag:x,2000:",
    "# remark",
    " #",
    ": ",
    ":",
    "- ",
    "? ",
    "'",
    '"',
    '"\\u0000"',
    '"\\ud800"',
    '"\\x1b[31m"',
    "\x00",
    "\x1b[2J",
    "\x85",
    "\u2028",
    "\ufeff",
    "\r",
    "\r\n",
    "\ufffe",
    "😀",
    "null",
    "~",
    "true",
    ".nan",
    ".inf",
    "1e999",
    "-1e999",
    "1e300",
    "5e-324",
    "1e-400",
    "0x" + "1" * 52,
    "9" * 30,
    "9" * 5000,
    "1_000",
    "0o17",
    "010",
    "1:30",
    "nan",
    "inf",
    "raw:1",
    "raw:" + "9" * 5000,
    "raw:-0",
    "raw:٣",
    "9007199254740993",
    "1,234",
    "1,5 mm",
    "1 furlong",
    "5 ms",
    "1 mm mm",
    "-0 mm",
    "1e99999999",
    "1e-99999999",
    "X1e99999999",
    "1e-99999999999999999999",
    "0e99999999999999999999",
    "1e99999999999999999999",
    "{a: b}",
    "[a, b]",
    "=",
    "@",
    "@1",
    "x" * 3000,
    "../../etc",
    "family: ../x",
    "\n\n\n",
    " " * 300,
    "a: 1",
    "values:",
    "forced:",
    "machine:",
    "\\",
    "&",
    "#0 0",
    ";FF",
    "\x13",
    "P21N3:t1n3",
    ",",
    '","',
    "REM",
    "PPU X",
    "(" * 500,
    "R0",
    "65536",
    "-32769",
    "0FFFFFH",
    "\\ ",
    "!",
)


def mutants(texts: Sequence[str], seed: int, count: int) -> Iterator[str]:
    """Yield ``count`` texts that were damaged once or a few times."""
    chance = random.Random(seed)
    for _ in range(count):
        text = chance.choice(texts)
        for _ in range(chance.choice((1, 1, 1, 2, 4))):
            text = chance.choice((_insert, _insert, _cut, _twice, _swap, _replace, _line))(
                text, chance, texts
            )
        yield text


def _insert(text: str, chance: random.Random, _texts: Sequence[str]) -> str:
    at = chance.randrange(len(text) + 1)
    return text[:at] + chance.choice(TOKENS) + text[at:]


def _cut(text: str, chance: random.Random, _texts: Sequence[str]) -> str:
    at = chance.randrange(len(text) + 1)
    return text[:at] + text[at + chance.choice((1, 1, 3, 20, 10_000)) :]


def _twice(text: str, chance: random.Random, _texts: Sequence[str]) -> str:
    at, length = chance.randrange(len(text) + 1), chance.choice((1, 10, 80))
    return text[:at] + text[at : at + length] * chance.choice((2, 2, 50)) + text[at + length :]


def _swap(text: str, chance: random.Random, texts: Sequence[str]) -> str:
    other = chance.choice(texts)
    return text[: chance.randrange(len(text) + 1)] + other[chance.randrange(len(other) + 1) :]


def _replace(text: str, chance: random.Random, _texts: Sequence[str]) -> str:
    """Put something else in the place of what comes after a colon, a tab, a comma."""
    places = [n for n, sign in enumerate(text) if sign in ":\t,= #"] or [0]
    at = chance.choice(places) + 1
    end = min(n for n in (text.find("\n", at), len(text)) if n >= 0)
    return f"{text[:at]}{chance.choice(('', ' '))}{chance.choice(TOKENS)}{text[end:]}"


def _line(text: str, chance: random.Random, _texts: Sequence[str]) -> str:
    lines = text.split("\n")
    lines.insert(chance.randrange(len(lines) + 1), " " * chance.choice((0, 2, 4)) + chance.choice(TOKENS))
    return "\n".join(lines)


def violations(
    texts: Iterator[Case], look: Callable[[Case], None], allowed: tuple[type[BaseException], ...]
) -> list[str]:
    """Return what goes wrong when each text is checked: any error that is not allowed,
    and whatever takes long.
    """
    with mock.patch("os.fsync", return_value=None):  # it is about what is read, not about the disk
        return [violation for text in texts for violation in _looked(text, look, allowed)]


def _looked(
    text: Case, look: Callable[[Case], None], allowed: tuple[type[BaseException], ...]
) -> Iterator[str]:
    begun = time.process_time()
    try:
        look(text)
    except allowed as error:
        if "\n" in str(error) or len(str(error)) > 1500:
            yield f"{str(error)[:300]!r} for {text!r:.300}"
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        yield f"{type(error).__name__}: {str(error)[:300]} for {text!r:.2000}"
    if CAMPAIGN and (took := time.process_time() - begun) > SLOWEST:
        yield f"{took:.1f} s for {text!r:.300}"


# -- one for each reader


def examples(pattern: str) -> list[str]:
    """Return the texts of the examples, without their endless tails."""
    return [p.read_text(encoding="utf-8") for p in sorted((REPOSITORY / "examples").glob(pattern))]


SMALL = """\
# a bench
amp_studio: 1
family: 57c422b
name: 'BENCH'
machine: module
made_by: {name: me, parts: [1, 2.50, yes]}
made_from: '../it''s.amp'  # copied
rev: 1.10
lines:
- a
- 'b: c'
values:
  # registers
  setup.encoder@X: '0x1414'    # page 4-48
  gain.proportional@X: 17595
  gain.integral@X: 768 # +-
  other.text@Z: "a\\tb"
forced:
  gain.integral@X: on a day by a test
# the end
...
"""


def fuzz_yaml(seed: int, count: int) -> list[str]:
    """Read damaged YAML of every kind."""
    texts = [SMALL, RULES, PROJECT, *examples("*/project.yaml")]

    def look(text: str) -> None:
        read_yaml(text, spans=True)

    return violations(mutants(texts, seed, count), look, (YamlError,))


def fuzz_parameter_files(seed: int, count: int) -> list[str]:
    """Open damaged parameter files; what opens is saved with a change, which is all that differs
    afterwards.
    """
    return violations(
        mutants([*[SMALL] * 60, *examples("*/*.amp")], seed, count), _open_and_save, (ParameterFileError,)
    )


def _open_and_save(text: str) -> None:
    path, content = Path("x.amp"), text.encode("utf-8", "surrogatepass")
    file = read_content(path, content)
    assert content_of(file, content) == content, "a save without a change changes the file"
    origin_named(content, "")  # by its line alone: of damaged ones it may find less than the reader of files
    again = read_content(path, readable_content(file, path))
    assert (again.values, again.unknown, again.forced) == (file.values, file.unknown, file.forced)
    chance = random.Random(len(text))
    for address in chance.sample(sorted(file.values), min(3, len(file.values))):
        file.set(address, file.default(address) if chance.random() < 0.5 else None)
    for address in chance.sample(sorted(file.addresses()), 3):
        if (default := file.default(address)) is not None:
            file.set(address, default)
    file.header.notes = chance.choice(("", "a: 'b' # c", "two\nlines"))
    before = read_yaml(text).data
    saved = readable_content(file, path, content)
    extra = {key: value for key, value in before.items() if key in file.header.extra}
    after = read_yaml(saved.decode()).data
    assert repr({key: after.get(key) for key in extra}) == repr(extra), "an extra key changed"


PROJECT = """\
# hall 4
amp_studio_project: 1
name: Bench   # the old one
family: 9pc
revision: 1.10
notes: "two\\nlines"
hall: {row: 4, since: 2001-12-14}
"""


def fuzz_projects(folder: Path, seed: int, count: int) -> list[str]:
    """Open damaged projects; what opens is saved with other notes, and opens as that."""

    def look(text: str) -> None:
        (folder / "project.yaml").write_bytes(text.encode("utf-8", "surrogatepass"))
        project = Project.open(folder)
        project.change(notes="changed: by 'this' # test")
        again = Project.open(folder)
        assert again.info == project.info
        assert repr(again.info.extra) == repr(project.info.extra)

    return violations(
        mutants([PROJECT, *examples("*/project.yaml")], seed, count), look, (ParameterFileError,)
    )


RULES = """\
rules:
  - id: builder.soft-limits
    title: Soft limits
    family: 9pc
    severity: error
    reads: {rapid: feedrate.rapid}
    check: rapid < 10000.0
    message: "Rapid {rapid} is too fast."
    page: "1"
suppressions:
  - rule: 9pc.servo.following-error-order
    params: ["1735"]
    reason: looked at
    by: me
"""


def fuzz_rules(folder: Path, seed: int, count: int) -> list[str]:
    """Read damaged rules of a builder's, entry by entry."""
    path = folder / "rules.yaml"

    def look(text: str) -> None:
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
        _, faults = read_entries(path, {"rules": BuilderRule, "suppressions": Suppression})
        assert all("\n" not in str(fault) and len(str(fault)) < 2000 for fault in faults)

    return violations(mutants([RULES], seed, count), look, ())


def fuzz_journals(folder: Path, seed: int, count: int) -> list[str]:
    """Open a file beside which a damaged journal and a damaged history lie."""
    path = folder / "x.amp"
    path.unlink(missing_ok=True)
    digest = save_file(new_file("57c422b", name="X"), path)
    journal = json.dumps(
        {
            "when": "now",
            "who": "me",
            "digest": digest,
            "header": {"notes": "x"},
            "changes": [["gain.integral@X", "5"], ["gain.integral@Y", None], ["setup.encoder@X", "0x1414"]],
        }
    )
    history = json.dumps(["now", "me", "set", "gain.integral@X", "5", "6"]) + "\n"

    def look(text: str) -> None:
        with Document.open(path) as document:
            document.journal_path.write_bytes(text.encode("utf-8", "surrogatepass"))
            document.history_path.write_bytes(text.encode("utf-8", "surrogatepass"))
            document.history()
            left = document.find_unsaved()
            for change in left.changes if left else ():
                document.file.apply(change)
            readable_content(document.file, path)
            document.discard_unsaved()

    deep = ["[" * 200_000, '{"changes": ' * 100_000]
    return violations(mutants([journal, journal, history, *deep], seed, count), look, ())


def fuzz_records(folder: Path, seed: int, count: int) -> list[str]:
    """Read a damaged record of exchanges, add one more to it,
    and compare a file with the last download in it.
    """
    path = folder / "x.amp"
    path.write_bytes(b"")
    file = new_file("9pc")
    entry = exchange_now(
        "download",
        path,
        "9pc",
        "tcp://127.0.0.1:1",
        before="a" * 64,
        after="b" * 64,
        state="new",
        changes=(("home.calibration@1", "0 mm", "1 mm"),),
    )
    record = json.dumps(asdict(entry)) + "\n"

    def look(text: str) -> None:
        record_path(path).write_bytes(text.encode("utf-8", "surrogatepass"))
        for each in read_exchanges(folder):
            assert isinstance(each.line(), str)
        assert earlier_beside(path, file) == ()
        assert add_exchange(path, entry) == ""
        assert read_exchanges(folder)[-1] == entry

    deep = ["[" * 200_000, '{"changes": ' * 100_000]
    return violations(mutants([record + record, *deep], seed, count), look, ())


def fuzz_imports(folder: Path, seed: int, count: int) -> list[str]:
    """Import damaged texts of every format, with and without what is not understood;
    what is taken is saved and read back.
    """
    found, each = [], max(1, count // len(_FORMATS))
    for number, (family, key) in enumerate(_FORMATS):
        ending = next(f.ending for f in formats_of(family) if f.key == key)
        texts = []
        for path in (REPOSITORY / "examples").glob("*/*.amp"):
            file = read_content(path, path.read_bytes())
            if file.schema.family.family == family:
                if key == "bsc":
                    file.set(("ballscrew.table", "X"), Value("X0E.00325 X1E-.00100"))
                export_file(file, folder / f"whole{ending}", key)
                texts.append((folder / f"whole{ending}").read_bytes().decode("latin-1"))
        damaged = folder / f"damaged{ending}"

        def look(text: str, family: str = family, key: str = key, damaged: Path = damaged) -> None:
            damaged.write_bytes(text.encode("utf-8", "surrogatepass"))
            for keep in (False, True):
                try:
                    file = import_file(damaged, family, format_key=key, keep_unknown=keep)
                except FormatError:
                    continue
                readable_content(file, damaged)

        # A refused save is a violation: what was read can be written.
        found += violations(mutants(texts, seed + number, each), look, ())
    return found


_FORMATS = [(family, f.key) for family in family_ids() for f in formats_of(family)]


def fuzz_entries(seed: int, count: int) -> list[str]:
    """Say odd things of every parameter, as a person, a file and a journal do;
    what is taken is written and read back.
    """
    chance = random.Random(seed)
    found = []
    for _ in range(count):
        schema = load_schema(chance.choice(family_ids()))
        file = new_file(schema.family.family)
        address = chance.choice(file.addresses())
        parameter = schema.parameters[address[0]]
        labels = [text for c in parameter.choices or () for text in (c.key, c.label, c.code or "")]
        text = chance.choice([*TOKENS, *labels, *NUMBERS]) + chance.choice(
            ("", "", " ", " mm", " deg", "\n", " %")
        )

        def look(text: str, file: ParameterFile = file, address: Address = address) -> None:
            file.set(address, file.read(address, text))
            readable_content(file, Path("x.amp"))

        found += violations(iter([text]), look, (InvalidValueError,))
    return found


NUMBERS = (
    "0",
    "-0",
    "1",
    "0.1",
    "1.5",
    "-7",
    "65535",
    "4294967295",
    "9007199254740991",
    "9007199254740992",
    "9007199254740993",
    "4503599627370497.5",
    "0x1F",
    "$1F",
    "1F",
    "017",
    "0x" + "F" * 14,
    "1e15",
    "1e16",
    "1e22",
    "123456789012345678",
    "0.1234567890123456789",
    "1'000",
    "3.4",
    "99.99",
    "1e-320",
    "2.2250738585072014e-308",
)
