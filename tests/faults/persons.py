"""What a person writes where there is no file: addresses, digests, names, formulas, commands;
odd and damaged, by a seed.
"""

import json
import random
from collections.abc import Iterator
from pathlib import Path
from unittest import mock

from amp_studio.cli.completion import answer
from amp_studio.families.ninepc.emulated.panel import NinePcPanel
from amp_studio.files import new_file
from amp_studio.schema import UnknownParameterError, family_ids, resolve_addresses
from amp_studio.schema.visible_text import visible
from amp_studio.transfer.client.drivers import open_driver
from amp_studio.transfer.client.parameters import read_digest
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.emulator import Emulator
from amp_studio.transfer.emulated.faults import Faults, read_faults
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.image import decode_image, encode_image, patch_image
from amp_studio.transfer.links.endpoint import is_endpoint, parse_endpoint
from amp_studio.validate import Validator, read_builder_rules
from amp_studio.validate.calculator import calculate, calculators
from amp_studio.validate.expression_tree import ExpressionError, read_expression

from .texts import NUMBERS, TOKENS, mutants, violations

ENDPOINTS = (
    "tcp://192.168.0.5:7090",
    "tcp://[fe80::1%eth0]:7090",
    "tcp://host:65535?protocol=house",
    "serial:/dev/ttyUSB0?baud=9600",
    "serial:COM3?baud=115200&protocol=house",
    "/dev/ttyUSB0?baud=9600",
    "COM12",
    "pty:",
    "tcp://h:1/?protocol=steps",
    "serial:/dev/ttyUSB0?baud=9600&bits=7&parity=even&stop=2&flow=xonxoff&protocol=house",
    "rfc2217://h:2217?flow=rtscts&parity=mark",
    "tls://h:1?fingerprint=sha256:" + "ab:" * 31 + "AB&protocol=house",
    "tls://h:1?ca=/etc/a%20b%26.pem",
    "pty:?protocol=house",
)


def fuzz_endpoints(seed: int, count: int) -> list[str]:
    """Read damaged addresses of controls; what is taken means the same when it is written again,
    and opens nothing.
    """

    def look(text: str) -> None:
        is_endpoint(text)
        place = parse_endpoint(text)
        assert parse_endpoint(str(place)) == place, f"{place} is another address"
        open_driver(text).close()

    return violations(mutants(ENDPOINTS, seed, count), look, (ValueError,))


def fuzz_digests(seed: int, count: int) -> list[str]:
    """Read damaged digests."""

    def look(text: str) -> None:
        found = read_digest(text)
        assert found is not None
        assert found.hex() == text.strip().casefold()

    return violations(mutants(["0123456789abcdef" * 4, "F" * 64], seed, count), look, (ValueError,))


FAULTS = (
    '{"drop_after_bytes": 9000, "drops": 0}',
    '{"silent": true}',
    '{"lose_every": 4001, "disk_full_at": 100}',
    '{"die_at_commit_step": 3, "corrupt_every": 7}',
)


def fuzz_practice_faults(seed: int, count: int) -> list[str]:
    """Read damaged faults of ``emulate --faults``."""

    def look(text: str) -> None:
        assert isinstance(read_faults(text), Faults)

    deep = ["[" * 200_000, '{"drops": ' * 100_000, '{"drops": ' + "9" * 5000 + "}"]
    return violations(mutants([*FAULTS * 60, *deep], seed, count), look, (ValueError,))


def fuzz_names(seed: int, count: int) -> list[str]:
    """Look up odd and damaged names of parameters."""
    chance = random.Random(seed)
    files = [new_file(family) for family in family_ids()]
    found = []
    for _ in range(count):
        file = chance.choice(files)
        address = chance.choice(file.addresses())
        number = file.machine_schema.number(address) or "1300"
        name = chance.choice((number, "@".join(address), f"{number}.3", f"{number}n1", f"{number}@X"))
        (text,) = mutants([name], chance.getrandbits(32), 1)

        def look(text: str, file: object = file) -> None:
            file.evaluation.find_bit(text)
            resolve_addresses(file.evaluation, text)

        found += violations(iter([text]), look, (UnknownParameterError,))
    return found


def fuzz_formulas(seed: int, count: int) -> list[str]:
    """Give odd arguments to every formula."""
    chance = random.Random(seed)
    every = [(family, c) for family in family_ids() for c in calculators(family).values()]
    odd = (
        *TOKENS,
        *NUMBERS,
        "1, 2, 3",
        "[1, 2], [3, 4]",
        "yes",
        "mm",
        "X0E.001",
        "[" * 2000,
        "1e308, 1e308",
        "[[1e999, 2]]",
    )

    def cases() -> Iterator[tuple[str, str, dict[str, str]]]:
        for _ in range(count):
            family, calculator = chance.choice(every)
            texts = {
                a.name: chance.choice(NUMBERS if chance.random() < 0.7 else odd) for a in calculator.arguments
            }
            yield family, calculator.name, texts

    def look(case: tuple[str, str, dict[str, str]]) -> None:
        calculate(*case)

    return violations(cases(), look, (ValueError,))


EXPRESSIONS = (
    "rapid < 10000.0",
    "gains.all(g, g > 0.0 && g < 65535.0)",
    "field(word, 0.0, 4.0) == 3.0 || bit(word, 2.0)",
    "gains.filter(g, g != null).map(g, g * 2.0).exists(g, g > 5.0)",
    "int(rapid / 1e300) > 3",
    "min([a, b]) <= max([1.0, 2.0])",
    "kind == 'x' ? rapid > 1.0 : !(rapid > 2.0)",
    "round(rapid, 2.0) % 7 == 1",
    "rapid in [1.0, 2.5, 0x1F]",
    "string(rapid) == '1'",
    "size(gains) > 0 && gains[0] > 1.0",
    "double(int(rapid) * 9223372036854775807) > 0.0",
    "'a' + \"b\\n\" == 'ab'",
)
PARTS = (
    "&&",
    "||",
    "!",
    "?",
    ":",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ".",
    ",",
    "<",
    ">=",
    "==",
    "+",
    "-",
    "*",
    "/",
    "%",
    "in",
    "null",
    "true",
    "int(",
    "double(",
    "string(",
    "size(",
    "has(",
    ".map(g, ",
    ".all(g, ",
    ".filter(g, ",
    "g",
    "rapid",
    "gains",
    "1e300",
    "-1e300",
    "9223372036854775807",
    "0.0",
    "1e-320",
    "'",
    '"',
    "\\",
    "type(",
    "timestamp(",
    "duration('1s')",
    "b'x'",
    "1u",
    "matches('(a+)+$')",
    "dyn(",
    "sqrt(",
    "pow(",
    "(" * 300,
    "[" * 300,
    "!" * 3000,
    "-" * 3000,
    "a.b.c",
    "1 / 0",
    "rapid / 0.0",
)


def _expressions(chance: random.Random) -> str:
    text = chance.choice(EXPRESSIONS)
    for _ in range(chance.choice((1, 1, 2, 5))):
        at = chance.randint(0, len(text))
        part = chance.choice(PARTS) if chance.random() < 0.8 else chance.choice(TOKENS)
        end = at if chance.random() < 0.5 else at + chance.choice((1, 3, 10))
        text = f"{text[:at]} {part} {text[end:]}" if chance.random() < 0.5 else text[:at] + part + text[end:]
    return text


def fuzz_expressions(seed: int, count: int) -> list[str]:
    """Read damaged expressions."""
    chance = random.Random(seed)

    def look(text: str) -> None:
        read_expression(text)

    return violations((_expressions(chance) for _ in range(count)), look, (ExpressionError,))


def fuzz_builders_expressions(folder: Path, seed: int, count: int) -> list[str]:
    """Check a file with rules whose expressions are damaged: what cannot be used is a finding,
    the others run.
    """
    chance, path = random.Random(seed), folder / "rules.yaml"
    file = new_file("57c422b", "module")
    at_once = 5

    def cases() -> Iterator[list[dict[str, object]]]:
        for start in range(0, count, at_once):
            yield [_rule(n, chance) for n in range(start, min(start + at_once, count))]

    def look(rules: list[dict[str, object]]) -> None:
        path.write_text(json.dumps({"rules": rules}), encoding="utf-8")
        read = read_builder_rules(path, file.schema)
        findings = Validator(file, read).run()
        odd = [f.message for f in findings if "\n" in f.message or len(f.message) > 3000]
        assert not odd, f"{odd!r:.600}"
        used = {rule.id for rule in read.rules}
        told = " ".join(fault.message for fault in read.faults)
        is_yaml = "builder.r" in told or not read.faults  # a sign that no file can hold spoils the whole file
        lost = [
            rule["id"] for rule in rules if is_yaml and not (rule["id"] in used or str(rule["id"]) in told)
        ]
        assert not lost, f"{lost} are neither used nor told"

    return violations(cases(), look, ())


def _rule(number: int, chance: random.Random) -> dict[str, object]:
    return {
        "id": f"builder.r{number}",
        "title": "T",
        "severity": "error",
        "page": "1",
        "reads": {
            "rapid": "gain.proportional",
            "gains": "gain.integral@X",
            "word": "setup.encoder",
            "a": "gain.integral",
        },
        "check": _expressions(chance),
        **({"applies": _expressions(chance)} if chance.random() < 0.3 else {}),
        **({"fix": {"rapid": _expressions(chance)}} if chance.random() < 0.3 else {}),
        "message": chance.choice(
            ("Rapid {rapid} is too fast.", "{rapid!r:>99999999}", "{rapid.__class__}", "{", "{a} {b}", "x")
        ),
    }


COMMANDS = (
    "estop on",
    "estop off",
    "autostart on",
    "restart",
    "status",
    "patch 1300=5",
    "patch 1=2",
    "patch 1001=1e5",
    "patch R0 = 3",
)


def fuzz_commands(folder: Path, seed: int, count: int) -> list[str]:
    """Give damaged commands to an emulated control: it answers each with one line and goes on;
    its image can be read.
    """
    file = new_file("57c422b", "module")
    for address in list(file.values)[12:]:
        del file.values[address]
    file.evaluation.forget()
    identity = Identity("57c422b", file.schema.signature)
    control = Control(folder / "control", identity, encode_image(file), accept=decode_image)
    message: list[str] = []
    emulator = Emulator(control, mock.Mock(), patch=patch_image, say=message.append)

    def look(text: str) -> None:
        message.clear()
        before = control.image
        emulator.operate(text)
        emulator._execute()
        assert len(message) <= 1
        assert all(line == visible(line) and len(line) < 1500 for line in message), message
        if control.image != before:
            decode_image(control.image)

    try:
        return violations(mutants(COMMANDS, seed, count), look, ())
    finally:
        control.close()


def fuzz_panel(folder: Path, seed: int, count: int) -> list[str]:
    """Give damaged commands at the screen of an emulated 9/PC: it answers each with one line;
    its AMP can be read.
    """
    file = new_file("9pc", "mill")
    keep = {("axis.type", "1"), ("servo.excess_error", "1"), ("axis.machine", "")}
    for address in [a for a in file.values if a not in keep]:
        del file.values[address]
    file.evaluation.forget()
    control = Control(
        folder / "control", Identity("9pc", file.schema.signature), encode_image(file), accept=decode_image
    )
    shown: list[str] = []
    emulator = Emulator(control, mock.Mock(), patch=patch_image, panel=NinePcPanel(), say=shown.append)

    def look(text: str) -> None:
        before = control.image
        for line in ("password AB-D4", "patch-amp LOCK", text, "update"):
            shown.clear()
            emulator.operate(line)
            emulator._execute()
            assert len(shown) <= 1
            assert all(line == visible(line) and len(line) < 1500 for line in shown), shown
        if control.image != before:
            decode_image(control.image)

    try:
        return violations(mutants(PANEL, seed, count), look, ())
    finally:
        control.close()


PANEL = (
    "axis-param 1750 0.005",
    "axis-param 1340 add 0.001",
    "axis-param 1801 increase",
    "axis-calib 1 begin deviation - 0",
    "axis-calib 1 insert 100 0.004",
    "axis-calib 1 delete 0",
    "cal-status 1",
    "home 1",
    "search 1750",
    "replace 1750 40.5",
    "replace 1750 -1e3",
    "password AB-D4",
    "patch-amp LOCK",
    "can",
    "messages",
    "leave",
)


def fuzz_completion(folder: Path, seed: int, count: int) -> list[str]:
    """Complete damaged command lines."""
    path = folder / "a.amp"
    path.write_bytes(b"damaged")
    lines = [
        f"amp-studio set {path} 13",
        "amp-studio show 9pc hom",
        "amp-studio report x --sort ",
        "amp-studio ",
        "amp-studio get 'a b",
        "amp-studio calculate num ",
        "amp-studio fix x --rule 9",
    ]

    def look(text: str) -> None:
        with mock.patch("builtins.print"):
            answer(["--line", text], " =:")

    return violations(mutants(lines, seed, count), look, ())
