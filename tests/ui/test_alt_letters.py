"""No two controls that are seen together have the same Alt letter: dialogs and the window as a whole.

The entries of each menu are in ``test_commands.py`` and, in German, in ``test_translations.py``.
"""

import ast
import importlib
import inspect
import pkgutil
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from PySide6.QtWidgets import QDialog

import amp_studio.ui
from amp_studio.files import Project, ProjectInfo, compare, new_file
from amp_studio.ui.main_window import MainWindow
from tests.source_trees import nodes_of

from .alt_letters import doubled, texts_of

# -- the window


@pytest.mark.parametrize("has_file", [True, False], ids=["with a file", "without a file"])
def test_nothing_in_the_window_has_the_letter_of_a_menu(
    open_window: Callable[..., MainWindow], path: Path, has_file: bool
) -> None:
    window = open_window(path if has_file else None)
    if not has_file:
        window.files.last_session = [path]
        window.welcome.show_recent([path])
    top = [a.text() for a in window.menuBar().actions() if a.isVisible()]
    assert doubled([*top, *texts_of(window)]) == {}


def test_a_message_about_the_disk_has_letters_that_no_menu_has(window: MainWindow) -> None:
    window.page.conflict.emit()
    assert len(window.page.bar.buttons) == 2
    top = [a.text() for a in window.menuBar().actions() if a.isVisible()]
    assert doubled([*top, *texts_of(window)]) == {}


# -- dialogs


def dialogs() -> list[type[QDialog]]:
    """Return every dialog of the program."""
    modules = [
        importlib.import_module(m.name)
        for m in pkgutil.walk_packages(amp_studio.ui.__path__, "amp_studio.ui.")
    ]
    kinds = {kind for module in modules for kind in vars(module).values() if isinstance(kind, type)}
    own = [
        kind for kind in kinds if issubclass(kind, QDialog) and kind.__module__.startswith("amp_studio.ui")
    ]
    return sorted((kind for kind in own if not kind.__name__.startswith("_")), key=lambda kind: kind.__name__)


def given(window: MainWindow, tmp_path: Path) -> dict[str, Any]:
    """Return what the parts of a dialog are made of, by the names of their parameters."""
    page, workspace = window.page, window.workspace
    assert page is not None
    assert workspace is not None
    file, other = workspace.file, new_file("9pc", "mill", ["X", "Y"])
    return {
        "parent": window,
        "window": window,
        "page": page,
        "workspace": workspace,
        "file": file,
        "title": "Title",
        "axis": "1",
        "first": "1",
        "header": file.header,
        "path": workspace.path,
        "address": ("home.calibration", "1"),
        "found": compare(file.schema, file.values, other.values),
        "other": "another file",
        "finding": None,
        "info": ProjectInfo("name", "9pc"),
        "project": Project(tmp_path, ProjectInfo("name", "9pc")),
        "family": "9pc",
        "go_to": page.go_to,
        "work": lambda *_: None,
        "schema": file.schema,
        "text": "text",
        "parameter": file.schema.parameters["home.calibration"],
        "findings": list(workspace.findings),
        "settings": window.settings,
        "menu": window.menuBar(),
        "bar": window.menuBar(),
        "notes": [],
        "paths": [],
        "control": SimpleNamespace(window=window),
        "secrets": False,
        "values": dict(file.values),
        "name": "name",
    }


@pytest.mark.parametrize("kind", dialogs(), ids=lambda kind: kind.__name__)
def test_every_dialog_has_each_letter_once(window: MainWindow, tmp_path: Path, kind: type[QDialog]) -> None:
    known = given(window, tmp_path)
    wanted = [
        p
        for p in list(inspect.signature(kind.__init__).parameters.values())[1:]
        if p.default is p.empty and p.name != "args"
    ]
    if missing := [p.name for p in wanted if p.name not in known]:
        pytest.skip(f"it needs {', '.join(missing)}, which its own tests have")
    try:
        dialog = kind(**{p.name: known[p.name] for p in wanted})
    except (TypeError, AttributeError, KeyError, ValueError) as error:
        pytest.skip(f"it is made of more than its parameters: {error}")
    dialog.ensurePolished()
    try:
        assert doubled(texts_of(dialog)) == {}
    finally:
        dialog.deleteLater()


# -- questions and menus that are made when they are asked for


def literals(node: ast.AST) -> Iterator[str]:
    """Yield the texts written in an expression, also those that are translated."""
    for inner in ast.walk(node):
        if isinstance(inner, ast.Constant) and isinstance(inner.value, str):
            yield inner.value


def called(node: ast.Call) -> str:
    """Return the name of the function that is called."""
    return node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")


def sources(checkout: Path) -> Iterator[tuple[str, ast.FunctionDef]]:
    """Yield every function of the window's room."""
    for path in sorted((checkout / "amp_studio" / "ui").rglob("*.py")):
        for node in nodes_of(path):
            if isinstance(node, ast.FunctionDef):
                yield f"{path.name}: {node.name}", node


def test_every_question_and_message_has_each_letter_once(checkout: Path) -> None:
    asked = 0
    for place, function in sources(checkout):
        for node in ast.walk(function):
            if isinstance(node, ast.Call) and called(node) in ("ask", "say"):
                asked += 1
                answers = [text for argument in node.args for text in literals(argument)]
                assert (place, doubled(answers)) == (place, {})
    assert asked > 15


def test_every_menu_at_the_pointer_has_each_letter_once(checkout: Path) -> None:
    seen = 0
    for place, function in sources(checkout):
        menus: dict[str, list[str]] = {}
        for node in ast.walk(function):
            if (
                isinstance(node, ast.Call)
                and called(node) == "addAction"
                and isinstance(node.func, ast.Attribute)
                and node.args
            ):
                text = next(literals(node.args[0]), "")
                menus.setdefault(ast.unparse(node.func.value), []).append(text)
        for name, texts in menus.items():
            seen += 1
            if not any(isinstance(n, ast.IfExp) for n in ast.walk(function)):
                assert (place, name, doubled(texts)) == (place, name, {})
    assert seen > 5
