"""Texts from files reach a terminal as text: no sign in them can steer it."""

import json
import re
import subprocess
import sys
from pathlib import Path

from amp_studio.schema.visible_text import visible

HEAD = "amp_studio: 1\nfamily: 9pc\n"
STARTS = """
import json, os, sys
from amp_studio.cli import program

os._exit = sys.exit  # one process for all starts
for number, arguments in enumerate(json.load(sys.stdin)):
    print(f"<{number}>", flush=True)
    try:
        program.start(arguments)
    except SystemExit:
        sys.stdout.flush()
"""
"""One start of the program after the other on the streams of one process, each named by its number."""


def outputs_of(*runs: tuple[object, ...]) -> list[str]:
    """Return all that each run of the program writes on both of its streams."""
    starts = json.dumps([[str(argument) for argument in run] for run in runs])
    ended = subprocess.run(
        [sys.executable, "-c", STARTS],
        input=starts.encode(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=True,
    )
    written = ended.stdout.decode("utf-8")
    assert "Traceback" not in written
    found = re.split(r"^<\d+>\n", written, flags=re.MULTILINE)
    assert len(found) == len(runs) + 1
    return found[1:]


def test_no_sign_of_a_file_steers_the_terminal(tmp_path: Path) -> None:
    sign = "\x1b]0;owned\x07 \x9b2J \r0 errors \x08\x7f \u202e\u2028"
    escaped = json.dumps(sign)
    path = tmp_path / "mill.amp"
    path.write_text(
        f'{HEAD}name: {escaped}\nvalues:\n  "axis.type@1": linear\n  "no.such{escaped[1:-1]}@1": {escaped}\n'
        f"  axis.name@1: {escaped}\n...\n",
        encoding="utf-8",
    )
    other = tmp_path / "other.amp"
    other.write_text(f"{HEAD}family: {escaped}\n...\n", encoding="utf-8")
    named = tmp_path / f"x{sign}.amp"
    runs: tuple[tuple[object, ...], ...] = (
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
    )
    for arguments, written in zip(runs, outputs_of(*runs), strict=True):
        assert written, arguments
        assert set(written).isdisjoint("\x1b\x07\x9b\r\x08\x7f\u202e\u2028"), arguments


def test_a_json_document_shows_the_same_with_its_signs_made_visible() -> None:
    document = {"\u202e": ["\x9b", "\U000e0001", "ü\n\t"]}
    displayed = visible(json.dumps(document, ensure_ascii=False), keep="\n\t")
    assert json.loads(displayed) == document
    assert displayed.isprintable()


def test_what_does_not_steer_stays_as_it_is() -> None:
    assert (
        visible("0,5 mm/s² · 10° – Fräse Nº 4 主軸 \u00a0\u202f")
        == "0,5 mm/s² · 10° – Fräse Nº 4 主軸 \u00a0\u202f"
    )
    assert visible("a\nb\x1b") == "a\\nb\\u001b"
