"""Bring the translations of the window up to date: new texts are added as unfinished, texts that are gone are dropped.

Runs lupdate of PySide6 over the window's modules. ``--check`` changes nothing, and fails where a file is not up to date or a
text has no translation.
"""

from __future__ import annotations

import ast
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

ROOT = Path(__file__).parents[1]
UI = ROOT / "amp_studio" / "ui"
FILES = sorted((UI / "translations").glob("*.ts"))


def updated(path: Path) -> bytes:
    """Return a translation file with the texts that the window has now."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(shutil.copy(path, folder))
        tool = Path(sys.executable).with_name("pyside6-lupdate")
        modules = sorted(str(module) for module in UI.rglob("*.py"))
        unseen = Path(folder) / "in_f_strings.py"
        unseen.write_text("".join(f"{call}\n" for call in calls_in_f_strings()), encoding="utf-8")
        modules.append(str(unseen))
        options = ["-no-obsolete", "-locations", "none", "-silent"]
        if path.stem.endswith("_en"):  # the texts are English: only the forms of numbers are missing
            options.append("-pluralonly")
        subprocess.run([tool, *options, *modules, "-ts", copy], check=True, capture_output=True)
        return with_known(copy.read_bytes(), path.read_bytes())


def calls_in_f_strings() -> list[str]:
    """Return the calls of ``tr`` within f-strings, where lupdate does not look, as calls of their own."""
    found = set()
    for module in UI.rglob("*.py"):
        for node in ast.walk(ast.parse(module.read_text("utf-8"))):
            if isinstance(node, ast.JoinedStr):
                for call in ast.walk(node):
                    if isinstance(call, ast.Call) and ast.unparse(call.func) in ("tr", "self.tr"):
                        several = ', "", 1' if len(call.args) > 2 else ""
                        found.add(f"tr({ast.unparse(call.args[0])}{several})")
    return sorted(found)


def with_known(content: bytes, before: bytes) -> bytes:
    """Return a file in which a text that only moved to another class keeps its translation: a word has one, wherever it is."""
    known = {
        (m.findtext("source"), m.get("numerus")): m.find("translation")
        for m in ET.fromstring(before).iter("message")  # noqa: S314  # a file of the program itself
        if is_finished(m)
    }
    root = ET.fromstring(content)  # noqa: S314  # a file of the program itself
    for message in root.iter("message"):
        old = known.get((message.findtext("source"), message.get("numerus")))
        if not is_finished(message) and old is not None:
            place = message.find("translation")
            if place is not None:
                message.remove(place)
            message.append(old)
    ET.indent(root, "    ")
    text: str = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n{text}\n'.encode()


def is_finished(message: ET.Element) -> bool:
    """Return whether a text has a translation."""
    translation = message.find("translation")
    return (
        translation is not None
        and translation.get("type") is None
        and bool("".join(translation.itertext()).strip())
    )


def unfinished(content: bytes) -> list[str]:
    """Return the texts without a translation."""
    messages = ET.fromstring(content).iter("message")  # noqa: S314  # a file of the program itself
    return [m.findtext("source") or "" for m in messages if not is_finished(m)]


def main(arguments: list[str]) -> int:
    """Update the files, or check them."""
    code = 0
    for path in FILES:
        content = updated(path)
        missing = unfinished(content)
        for text in missing:
            print(f"{path.name}: no translation of {text!r}")
        if "--check" in arguments:
            is_fresh = content == path.read_bytes()
            print(f"{path.name}: {'up to date' if is_fresh else 'not up to date, run make translations'}")
            code |= not is_fresh or bool(missing)
        else:
            path.write_bytes(content)
            print(f"{path.name}: {len(missing)} without a translation")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
