"""Bring the texts of the window up to date: code's new texts get an id in ``en.toml``
and a place in the others; what is gone goes.

``--check`` changes nothing, and fails where something is new, gone or has no translation.
"""

import ast
import json
import re
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

from amp_studio.languages.catalogue import language_codes, texts_of
from amp_studio.schema import family_ids
from amp_studio.schema.load import folder_of
from amp_studio.schema.translation.texts import missing_texts

ROOT = Path(__file__).parents[1]
UI = ROOT / "amp_studio" / "ui"
FOLDER = ROOT / "amp_studio" / "languages"
Text = str | list[str]


def texts_in_code() -> dict[str, bool]:
    """Return each text that the window translates, and whether it has a number in it."""
    found: dict[str, bool] = {}
    for module in sorted(UI.rglob("*.py")):
        for text, has_number in calls(ast.parse(module.read_text("utf-8"))):
            found[text] = found.get(text, False) or has_number
    return found


def calls(tree: ast.AST) -> Iterator[tuple[str, bool]]:
    """Yield the text of each call of ``tr``, and whether it is given a number."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and node.args:
            name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            text = node.args[0]
            if name == "tr" and isinstance(text, ast.Constant) and isinstance(text.value, str):
                yield text.value, len(node.args) > 2


def source_of(text: Text) -> str:
    """Return what code writes for a text: of several forms the one for several."""
    return text if isinstance(text, str) else text[-1]


def new_id(text: str, taken: Iterable[str]) -> str:
    """Return an id for a text: its first words, more of them or a number where another text has these."""
    words = re.findall(r"[a-z0-9]+", re.sub(r"\{[^}]*\}|%n", " ", text).replace("&", "").lower()) or ["sign"]
    taken = set(taken)
    tries = ["_".join(words[:most]) for most in (6, 10, len(words))]
    tries += [f"{tries[0]}_{number}" for number in range(2, len(taken) + 3)]
    return next(each for each in tries if each not in taken)


def updated(code: str, english: dict[str, Text], kept: dict[str, Text]) -> str:
    """Return the file of a language with the texts of the window that there are now."""
    content = (FOLDER / f"{code}.toml").read_text("utf-8")
    head, _, rest = content.partition("[window]\n")
    _, gap, after = rest.partition("\n\n")
    own = {key: kept.get(key, text if code == "en" else "") for key, text in english.items()}
    lines = [f"{key} = {json.dumps(own[key], ensure_ascii=False)}" for key in sorted(own)]
    return f"{head}[window]\n" + "\n".join(lines) + gap + after


def main(arguments: list[str]) -> int:
    """Update the files, or check them."""
    is_check, code = "--check" in arguments, 0
    in_code = texts_in_code()
    known = {source_of(text): key for key, text in texts_of("en", "window").items()}
    english: dict[str, Text] = {k: t for k, t in texts_of("en", "window").items() if source_of(t) in in_code}
    for source, has_number in in_code.items():
        if source not in known:
            english[new_id(source, english)] = [source, source] if has_number else source
    before = texts_of("en", "window")
    same = {key for key, text in english.items() if before.get(key) == text}
    for language in language_codes():
        # an id that was free again for another text must not bring its old words back
        kept = {key: text for key, text in texts_of(language, "window").items() if key in same}
        content, path = updated(language, english, kept), FOLDER / f"{language}.toml"
        is_fresh = content == path.read_text("utf-8")
        missing = [] if language == "en" else [text for key, text in english.items() if not kept.get(key)]
        for text in missing:
            print(f"{path.name}: no translation of {source_of(text)!r}")
        if is_check:
            print(f"{path.name}: {'up to date' if is_fresh else 'not up to date, run make translations'}")
            code |= not is_fresh or bool(missing)
        else:
            path.write_text(content, "utf-8")
            print(f"{path.name}: {len(missing)} without a translation")
    for family in family_ids():
        for language in sorted({path.parent.name for path in folder_of(family).glob("??/*.yaml")}):
            for place in missing_texts(family, language):
                print(f"{family}/{language}: no translation of {'.'.join(map(str, place))}")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
