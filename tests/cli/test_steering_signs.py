"""Texts from files reach a terminal as text: no sign in them can steer it."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from amp_studio.schema.visible import visible

HEAD = "amp_studio: 1\nfamily: 9pc\n"
PROGRAM = [sys.executable, "-m", "amp_studio.cli"]


def output_of(*arguments: object) -> bytes:
    """Return all that the program writes on both of its streams."""
    ended = subprocess.run([*PROGRAM, *map(str, arguments)], capture_output=True, check=False)
    assert b"Traceback" not in ended.stderr
    return ended.stdout + ended.stderr


def test_no_sign_of_a_file_steers_the_terminal(tmp_path: Path) -> None:
    sign = "\x1b]0;owned\x07 \x9b2J \r0 errors \x08\x7f \u202e\u2028"
    escaped = json.dumps(sign)
    path = tmp_path / "mill.amp"
    path.write_text(
        f'{HEAD}name: {escaped}\nvalues:\n  "axis.type@1": linear\n  "no.such{escaped[1:-1]}@1": {escaped}\n'
        f'  axis.name@1: {escaped}\n...\n',
        encoding="utf-8",
    )  # fmt: skip
    other = tmp_path / "other.amp"
    other.write_text(f"{HEAD}family: {escaped}\n...\n", encoding="utf-8")
    named = tmp_path / f"x{sign}.amp"
    for arguments in (
        ("get", path, "--all"),
        ("get", path, "--all", "--json"),
        ("validate", path, "--why"),
        ("validate", path, "--json"),
        ("get", path, sign),
        ("set", path, f"axis.name@1={sign}"),
        ("report", path, "-o", tmp_path / f"r.{sign}"),
        ("validate", other),
        ("get", named),
        (sign,),
    ):
        written = output_of(*arguments).decode("utf-8")
        assert set(written).isdisjoint("\x1b\x07\x9b\r\x08\x7f\u202e\u2028"), arguments


def test_a_json_document_says_the_same_with_its_signs_made_visible() -> None:
    document = {"\u202e": ["\x9b", "\U000e0001", "ü\n\t"]}
    shown = visible(json.dumps(document, ensure_ascii=False), keep="\n\t")
    assert json.loads(shown) == document
    assert shown.isprintable()


def test_what_does_not_steer_stays_as_it_is() -> None:
    assert (
        visible("0,5 mm/s² · 10° – Fräse Nº 4 主軸 \u00a0\u202f")
        == "0,5 mm/s² · 10° – Fräse Nº 4 主軸 \u00a0\u202f"
    )
    assert visible("a\nb\x1b") == "a\\nb\\u001b"
