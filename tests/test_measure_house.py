"""What ``scripts/measure_house.py`` counts, on sources of a few lines."""

import ast
from pathlib import Path

import measure_house
import pytest

PAGE = "if TYPE_CHECKING:\n    from .{} import {}\nelse:\n    __getattr__ = front_page(__name__)\n"


@pytest.mark.parametrize(
    ("line", "taken"),
    [
        ("from amp_studio.files import open_file", [("files", "open_file", False)]),
        (
            "from amp_studio.files.lock import Lock, locked",
            [("files", "Lock", True), ("files", "locked", True)],
        ),
        ("from ..files.lock import Lock", [("files", "Lock", True)]),
        ("from amp_studio.files import lock", [("files", "", True)]),
        ("from amp_studio.files import diff", [("files", "diff", False)]),
        ("import amp_studio.files.lock", [("files", "", True)]),
        ("import amp_studio.files", [("files", "", False)]),
        ("from amp_studio.errors import AmpStudioError", [("errors", "AmpStudioError", False)]),
        ("from amp_studio.sim.law import Law", []),
        ("from .law import Law", []),
        ("import json", []),
        ("from amp_studio.transfer.links import Link", [("transfer.links", "Link", False)]),
        ("from amp_studio.transfer.links.link import Link", [("transfer.links", "Link", True)]),
        ("from amp_studio.transfer.client.drift import drift", [("transfer", "drift", True)]),
        ("def late():\n    from amp_studio.files.lock import Lock", [("files", "Lock", True)]),
    ],
)
def test_a_name_that_is_taken_past_a_front_page_counts(
    tmp_path: Path, line: str, taken: list[tuple[str, str, bool]]
) -> None:
    sources = {
        "files/__init__.py": f"{PAGE.format('diff', 'diff')}\ndef open_file(): ...\n",
        "files/diff.py": "def diff(): ...\n",
        "files/lock.py": "class Lock: ...\n",
        "errors.py": "",
        "transfer/__init__.py": "",
        "transfer/client/__init__.py": "",
        "transfer/client/drift.py": "",
        "transfer/links/__init__.py": PAGE.format("link", "Link"),
        "transfer/links/link.py": "class Link: ...\n",
        "sim/__init__.py": "",
        "sim/law.py": "",
        "sim/here.py": f"{line}\n",
    }
    for name, text in sources.items():
        path = tmp_path / "amp_studio" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    found = [name for name in measure_house.imported_names(tmp_path / "amp_studio") if name.room == "sim"]
    assert [(name.given_by, name.name, name.is_past) for name in found] == taken


@pytest.mark.parametrize(
    ("body", "count"),
    [
        ("return 1", 1),
        ("return 1 if a else 2", 2),
        ("if a and b or c:\n        return 1", 4),
        ("for x in a:\n        assert x", 3),
        ("return [x for x in a if x if b]", 4),
        ("try:\n        pass\n    except ValueError:\n        pass", 2),
        ("match a:\n        case 1:\n            pass\n        case _:\n            pass", 3),
        ("def inner():\n        if a:\n            pass", 1),
    ],
)
def test_each_way_in_which_code_can_part_counts(body: str, count: int) -> None:
    assert measure_house.branches(ast.parse(f"def f(a, b, c):\n    {body}\n").body[0]) == count


def test_bodies_are_counted_without_heads_and_docstrings() -> None:
    source = (
        'X = 1\n\ndef f(\n    a,\n):\n    """What."""\n    if a:\n        return 1\n\n    def g():\n       '
        " return 2\n"
    )
    assert measure_house.body_lines(ast.parse(source)) == 5


def test_the_functions_that_part_too_often_are_listed_with_their_place(tmp_path: Path) -> None:
    package = tmp_path / "amp_studio"
    package.mkdir()
    plain, hard = (
        f"def {name}(a):\n" + "    if a:\n        a()\n" * ifs for name, ifs in (("f", 9), ("g", 10))
    )
    (package / "both.py").write_text(plain + hard, encoding="utf-8")
    assert measure_house.complex_functions(package) == [(11, "amp_studio/both.py:20", "g")]
