"""The house keeps its plan: imports point one way, each room introduces itself, and every library is declared."""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
import textwrap
import tomllib
from collections.abc import Iterator
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
from pydantic import TypeAdapter
from ruamel.yaml import YAML

import amp_studio
from amp_studio.schema import Parameter, Rule, load_schema, program
from amp_studio.schema.load import compile_family
from amp_studio.schema.machine_schema import number_of

ROOMS = sorted(path.parent.name for path in Path(amp_studio.__file__).parent.glob("*/__init__.py"))
CATCH_ALL_NAMES = {"utils", "util", "helpers", "helper", "common", "manager", "misc"}


def check_contracts(folder: Path) -> subprocess.CompletedProcess[str]:
    """Run import-linter on the package that is in ``folder``, with the contracts of its pyproject.toml."""
    lint = (
        "import sys; sys.path.insert(0, '.'); from importlinter.cli import lint_imports_command as run; run()"
    )
    return subprocess.run(
        [sys.executable, "-P", "-c", lint, "--no-cache", "--no-logo"],
        cwd=folder,
        env=os.environ | {"NO_COLOR": "1", "COLUMNS": "200", "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )


def test_imports_between_the_rooms_point_one_way(checkout: Path) -> None:
    done = check_contracts(checkout)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("room", "line", "contract"),
    [
        ("schema", "import amp_studio.files", "Imports between the rooms point one way"),
        ("files", "import amp_studio.validate", "Imports between the rooms point one way"),
        ("validate", "import amp_studio.transfer", "Imports between the rooms point one way"),
        ("formats", "import amp_studio.transfer", "Imports between the rooms point one way"),
        ("validate", "import amp_studio.families.num", "Imports between the rooms point one way"),
        ("ui", "import amp_studio.families.num", "A family is reached through its registration only"),
        ("families/num", "import amp_studio.families.syntec", "Families do not see each other"),
        (
            "transfer/links",
            "import amp_studio.transfer.house",
            "The parts of transfer stand one above the other",
        ),
        ("sim", "import amp_studio.report", "Imports between the rooms point one way"),
        ("report", "import amp_studio.ui", "Imports between the rooms point one way"),
        ("files", "from PySide6.QtCore import QObject", "Qt is imported in ui only"),
        ("transfer", "import numba", "numba is imported in sim only"),
        ("sim", "import serial", "The serial port is opened in transfer only"),
    ],
)
def test_an_import_against_the_plan_is_found(
    checkout: Path, tmp_path: Path, room: str, line: str, contract: str
) -> None:
    for module in (checkout / "amp_studio").rglob("*.py"):
        empty = tmp_path / module.relative_to(checkout)
        empty.parent.mkdir(parents=True, exist_ok=True)
        empty.touch()
    (tmp_path / "amp_studio" / room / "astray.py").write_text(f"{line}\n")
    shutil.copy(checkout / "pyproject.toml", tmp_path)

    done = check_contracts(tmp_path)

    assert done.returncode == 1, done.stdout + done.stderr
    assert f"{contract} BROKEN" in done.stdout
    assert f"amp_studio.{room}.astray".replace("/", ".") in done.stdout


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_says_what_it_is_for(checkout: Path, room: str) -> None:
    source = (checkout / "amp_studio" / room / "__init__.py").read_text(encoding="utf-8")
    assert ast.get_docstring(ast.parse(source)), f"amp_studio/{room}/__init__.py has no docstring"


@pytest.mark.parametrize("page", ["docs/architecture.md", "CONTRIBUTING.md"])
def test_every_room_is_in_the_plan(checkout: Path, page: str) -> None:
    text = (checkout / page).read_text(encoding="utf-8")
    assert [
        room
        for room in (*ROOMS, "dossier.py")
        if not re.search(rf"(^      |amp_studio/){room}\b", text, re.MULTILINE)
    ] == []


def test_no_file_is_named_for_everything_and_nothing(checkout: Path) -> None:
    found = [
        path.relative_to(checkout).as_posix()
        for path in (checkout / "amp_studio").rglob("*.py")
        if {path.stem, path.parent.name} & CATCH_ALL_NAMES
    ]
    assert found == []


def imported_libraries(package: Path) -> Iterator[tuple[str, Path]]:
    """Yield the top name of every absolute import of the package, wherever it is in a file."""
    for path in sorted(package.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                yield from ((alias.name.partition(".")[0], path) for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
                yield node.module.partition(".")[0], path


def plain(name: str) -> str:
    """Return a distribution's name in the one spelling in which names are compared (PEP 503)."""
    return re.sub(r"[-_.]+", "-", name).lower()


def test_every_imported_library_is_declared(checkout: Path) -> None:
    project = tomllib.loads((checkout / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    declared = {plain(re.split(r"[^\w.-]", line)[0]) for line in project["dependencies"]}
    distributions = packages_distributions()
    undeclared = {
        f"{path.relative_to(checkout).as_posix()}: {name}"
        for name, path in imported_libraries(checkout / "amp_studio")
        if name not in sys.stdlib_module_names
        and name not in {"amp_studio", "pydantic_core"}  # pydantic_core is pydantic's own other half
        and not declared & {plain(owner) for owner in distributions.get(name, [name])}
    }
    assert undeclared == set()


@pytest.mark.parametrize("lock", ["run", "dev"])
def test_a_lock_file_pins_everything_by_hash_and_names_no_server(checkout: Path, lock: str) -> None:
    text = (checkout / "requirements" / f"{lock}.lock").read_text(encoding="utf-8")
    entries = [block for block in re.split(r"\n(?=\S)", text) if not block.startswith("#")]
    assert [block for block in entries if "==" not in block or "--hash=sha256:" not in block] == []
    assert re.findall(r"https?:|file:|--(?:index|extra|find|trusted)\S*", text) == []


def test_the_lock_of_the_program_is_part_of_the_lock_of_development(checkout: Path) -> None:
    locks = (checkout / "requirements" / name for name in ("run.lock", "dev.lock"))
    run, dev = (set(re.findall(r"^([\w.-]+==\S+)", path.read_text("utf-8"), re.MULTILINE)) for path in locks)
    assert run
    assert run - dev == set()


def contributing_examples(checkout: Path) -> dict[str, str]:
    """Return path -> text of the YAML examples of CONTRIBUTING.md; each names its file in its first line."""
    text = (checkout / "CONTRIBUTING.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^ *```yaml\n(.*?)^ *```$", text, re.DOTALL | re.MULTILINE)
    return {re.match(r"\s*# (\S+)", block)[1]: textwrap.dedent(block) for block in blocks}


def test_the_examples_of_contributing_are_facts_the_program_reads(checkout: Path, tmp_path: Path) -> None:
    examples = contributing_examples(checkout)
    rules = examples.pop("parameter_db/9pc/rules/servo_position.yaml")
    parameter = examples.pop("parameter_db/9pc/groups/zone.yaml")
    for path, text in examples.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")

    (rule,) = TypeAdapter(tuple[Rule, ...]).validate_python(YAML(typ="safe").load(rules))
    assert program(rule.check)
    (written,) = TypeAdapter(tuple[Parameter, ...]).validate_python(YAML(typ="safe").load(parameter))
    assert load_schema("9pc").parameters[written.id].numbers == written.numbers
    assert load_schema("9pc").parameters[written.id].ranges == written.ranges
    compiled = compile_family(tmp_path / "parameter_db" / "57c422b")
    numbers, axes = compiled.groups[0].parameters[0].numbers, compiled.family.scopes["axis"].instances
    assert [number_of(numbers, k, axis) for k, axis in enumerate(axes)] == ["R10", "R2058"]
    shown, held = compiled.groups[0].parameters[0], load_schema("57c422b").parameters
    same = {"name", "scope", "numbers", "type", "quantity", "ranges", "storage", "page"}
    assert held[shown.id].model_dump(include=same) == shown.model_dump(include=same)
    assert load_schema("57c422b").family.title == compiled.family.title


def walks(checkout: Path) -> list[tuple[str, str]]:
    """Return module and function of every step of the walks in docs/architecture.md."""
    text = (checkout / "docs" / "architecture.md").read_text(encoding="utf-8")
    text = text[
        text.index("## A value typed until it is on disk") : text.index("## How a question is answered")
    ]
    return re.findall(r"`([a-z_/]+\.py)`\s+`([\w.]+)`", text)


def test_every_function_of_a_walk_is_where_the_page_says(checkout: Path) -> None:
    steps = walks(checkout)
    assert len(steps) >= 30
    lost = []
    for module, name in steps:
        tree = ast.parse((checkout / "amp_studio" / module).read_text(encoding="utf-8"))
        here: list[ast.stmt] = tree.body
        for part in name.split("."):
            kinds = (ast.FunctionDef, ast.ClassDef)
            found = next((n for n in here if isinstance(n, kinds) and n.name == part), None)
            if found is None:
                lost.append(f"{module} {name}")
                break
            here = found.body
    assert lost == []


def test_a_class_or_alias_has_a_name_that_no_other_has(checkout: Path) -> None:
    """A reader who finds ``State`` knows which one it is; names with an underscore are of one module."""
    places: dict[str, list[str]] = {}
    for path in sorted((checkout / "amp_studio").rglob("*.py")):
        for node in ast.parse(path.read_text("utf-8")).body:
            if isinstance(node, ast.ClassDef):
                name = node.name
            elif isinstance(node, ast.Assign) and isinstance(node.value, ast.Subscript):
                name = ast.unparse(node.targets[0])  # an alias of a type: Literal[…], Callable[…]
            else:
                continue
            if name[0].isupper() and not name.isupper():
                places.setdefault(name, []).append(path.relative_to(checkout).as_posix())
    del places["Setting"]  # what grblHAL calls its parameters, and what a fix sets
    assert {name: where for name, where in places.items() if len(where) > 1} == {}
