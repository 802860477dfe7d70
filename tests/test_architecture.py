"""The house keeps its plan: imports point one way, each room introduces itself,
and every library is declared.
"""

import ast
import builtins
import itertools
import os
import re
import shutil
import string
import subprocess
import sys
import textwrap
import threading
import tomllib
from collections import Counter
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from importlib.metadata import PackageNotFoundError, files
from pathlib import Path

import measure_house
import pytest
from pydantic import TypeAdapter
from ruamel.yaml import YAML

import amp_studio
from amp_studio import schema
from amp_studio.formats import all_formats, formats_of
from amp_studio.front_pages import listed
from amp_studio.schema import Parameter, Rule, family_ids, load_schema, program

from .source_trees import nodes_of, text_of

ROOMS = sorted(path.parent.name for path in Path(amp_studio.__file__).parent.glob("*/__init__.py"))


@pytest.fixture(scope="module", autouse=True)
def _trees_of_these_tests_alone() -> Iterator[None]:
    """Forget the syntax trees: a million objects, which every later collection of garbage would go
    through.
    """
    yield
    nodes_of.cache_clear()
    measure_house.tree_of.cache_clear()


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


ASTRAY = [
    ("schema", "import amp_studio.files", "Imports between the rooms point one way"),
    ("files", "import amp_studio.validate", "Imports between the rooms point one way"),
    ("validate", "import amp_studio.transfer", "Imports between the rooms point one way"),
    ("formats", "import amp_studio.transfer", "Imports between the rooms point one way"),
    ("validate", "import amp_studio.families.num", "Imports between the rooms point one way"),
    ("ui", "import amp_studio.families.num", "A family is reached through its registration only"),
    ("families/num", "import amp_studio.families.syntec", "Families do not see each other"),
    ("transfer/links", "import amp_studio.transfer.house", "The parts of transfer stand one above the other"),
    ("sim", "import amp_studio.report", "Imports between the rooms point one way"),
    ("report", "import amp_studio.ui", "Imports between the rooms point one way"),
    ("files", "from PySide6.QtCore import QObject", "Qt is imported in ui only"),
    ("transfer", "import numba", "numba is imported in sim only"),
    ("sim", "import serial", "The serial port is opened in transfer only"),
]
"""Room, an import that it must not have, and the contract that it breaks."""


@pytest.fixture(scope="module")
def lint_of_astray_imports(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> str:
    """Return the output of import-linter for the package with every import of ``ASTRAY``,
    each in a separate module.
    """
    folder = tmp_path_factory.mktemp("astray")
    for module in (checkout / "amp_studio").rglob("*.py"):
        empty = folder / module.relative_to(checkout)
        empty.parent.mkdir(parents=True, exist_ok=True)
        empty.touch()
    for n, (room, line, _) in enumerate(ASTRAY):
        (folder / "amp_studio" / room / f"astray_{n}.py").write_text(f"{line}\n")
    shutil.copy(checkout / "pyproject.toml", folder)
    done = check_contracts(folder)
    assert done.returncode == 1, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize("n", range(len(ASTRAY)), ids=[f"{room} {line}" for room, line, _ in ASTRAY])
def test_an_import_against_the_plan_is_found(lint_of_astray_imports: str, n: int) -> None:
    room, _, contract = ASTRAY[n]
    assert f"{contract} BROKEN" in lint_of_astray_imports
    reported = lint_of_astray_imports.partition(f"\n{contract}\n---")[2]
    reported = re.split(r"\n[^\n]+\n-{4,}\n", reported)[0]
    assert re.search(rf"amp_studio\.{room}\.astray_{n}\b".replace("/", r"\."), reported), reported


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_shows_what_it_is_for(checkout: Path, room: str) -> None:
    source = (checkout / "amp_studio" / room / "__init__.py").read_text(encoding="utf-8")
    assert ast.get_docstring(ast.parse(source)), f"amp_studio/{room}/__init__.py has no docstring"


@pytest.mark.parametrize("page", ["docs/architecture.md", "CONTRIBUTING.md"])
def test_every_room_is_in_the_plan(checkout: Path, page: str) -> None:
    text = (checkout / page).read_text(encoding="utf-8")
    assert [
        room
        for room in (*ROOMS, "dossier.py", "motion_paper.py")
        if not re.search(rf"(^      |amp_studio/){room}\b", text, re.MULTILINE)
    ] == []


def test_no_file_is_named_for_everything_and_nothing(checkout: Path) -> None:
    found = [
        path.relative_to(checkout).as_posix()
        for path in (checkout / "amp_studio").rglob("*.py")
        if {path.stem, path.parent.name} & CATCH_ALL_NAMES
    ]
    assert found == []


def test_no_folder_has_more_modules_than_a_reader_takes_in(checkout: Path) -> None:
    counts = Counter(
        path.parent.relative_to(checkout).as_posix()
        for path in (checkout / "amp_studio").rglob("*.py")
        if path.name != "__init__.py"
    )
    assert {folder: count for folder, count in counts.items() if count > 30} == {}


@cache
def imported_libraries(package: Path) -> list[tuple[str, Path]]:
    """Return the top name of every absolute import of the package, wherever it is in a file,
    by a statement or by name.
    """
    found: list[tuple[str, Path]] = []
    for path in sorted(package.rglob("*.py")):
        for node in imports_of(path, at_loading=False, for_types=True):
            if isinstance(node, ast.Import):
                found += ((alias.name.partition(".")[0], path) for alias in node.names)
            elif node.level == 0 and node.module:
                found.append((node.module.partition(".")[0], path))
        by_name = re.compile(r"\b(import_module|find_spec)$")
        for node in nodes_of(path) if re.search(r"import_module|find_spec", text_of(path)) else ():
            if isinstance(node, ast.Call) and by_name.search(ast.unparse(node.func)):
                names = (each.value for each in node.args[:1] if isinstance(each, ast.Constant))
                found += ((name.partition(".")[0], path) for name in names if not name.startswith("."))
    return found


def plain(name: str) -> str:
    """Return a distribution's name in the one spelling in which names are compared (PEP 503)."""
    return re.sub(r"[-_.]+", "-", name).lower()


def declared_libraries(pyproject: str) -> set[str]:
    """Return the distributions that the program requires, and those of its extras."""
    project = tomllib.loads(pyproject)["project"]
    extras = project["optional-dependencies"].values()
    lines = [*project["dependencies"], *(line for extra in extras for line in extra)]
    return {plain(re.split(r"[^\w.-]", line)[0]) for line in lines}


def modules_of(distribution: str) -> set[str]:
    """Return the top names of the modules that an installed distribution brings; its own name where it is not
    here.
    """
    try:
        found = files(distribution) or ()
    except PackageNotFoundError:
        return {distribution}
    return {file.parts[0].partition(".")[0] for file in found if file.suffix in (".py", ".so", ".pyd")}


def test_every_imported_library_is_declared_and_every_declared_one_imported(checkout: Path) -> None:
    declared = declared_libraries((checkout / "pyproject.toml").read_text("utf-8"))
    brought = {distribution: modules_of(distribution) for distribution in declared}
    imported = {
        (name, path.relative_to(checkout).as_posix())
        for name, path in imported_libraries(checkout / "amp_studio")
        if name not in sys.stdlib_module_names
        and name not in {"amp_studio", "pydantic_core"}  # pydantic_core is pydantic's own other half
    }
    assert {each for each in imported if each[0] not in set().union(*brought.values())} == set()
    names = {name for name, _ in imported}
    assert {distribution for distribution, modules in brought.items() if not modules & names} == set()


def without_reason(pyproject: str) -> list[str]:
    """Return the lines of the requirements of the program and its extras that have no comment above them."""
    lines = pyproject[
        pyproject.index("\ndependencies = [") : pyproject.index("[project.scripts]")
    ].splitlines()
    requires = re.compile(r'^  "|^\w+ = \["')
    return [
        line
        for above, line in itertools.pairwise(lines)
        if requires.match(line) and not above.lstrip().startswith("#")
    ]


def test_every_declared_library_has_its_reason(checkout: Path) -> None:
    text = (checkout / "pyproject.toml").read_text("utf-8")
    assert without_reason(text) == []
    planted = text.replace("\ndependencies = [\n", '\ndependencies = [\n  "rich>=14",\n')
    assert without_reason(planted) == ['  "rich>=14",']


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


def test_the_examples_of_contributing_are_facts_the_program_reads(checkout: Path) -> None:
    examples = contributing_examples(checkout)
    rules = examples.pop("parameter_db/9pc/rules/servo_position.yaml")
    parameter = examples.pop("parameter_db/9pc/groups/zone.yaml")
    (rule,) = TypeAdapter(tuple[Rule, ...]).validate_python(YAML(typ="safe").load(rules))
    assert program(rule.check)
    (written,) = TypeAdapter(tuple[Parameter, ...]).validate_python(YAML(typ="safe").load(parameter))
    assert load_schema("9pc").parameters[written.id].numbers == written.numbers
    assert load_schema("9pc").parameters[written.id].ranges == written.ranges


def walks(checkout: Path) -> list[tuple[str, str]]:
    """Return module and function of every step of the walks in docs/architecture.md."""
    text = (checkout / "docs" / "architecture.md").read_text(encoding="utf-8")
    return re.findall(r"`([a-z_/]+\.py)`\s+`([\w.]+)`", text.partition("## Four walks")[2])


def test_every_function_of_a_walk_is_where_the_page_shows(checkout: Path) -> None:
    steps = walks(checkout)
    assert len(steps) >= 30
    lost = []
    for module, name in steps:
        here: list[ast.stmt] = measure_house.tree_of(checkout / "amp_studio" / module).body
        for part in name.split("."):
            kinds = (ast.FunctionDef, ast.ClassDef)
            found = next((n for n in here if isinstance(n, kinds) and n.name == part), None)
            if found is None:
                lost.append(f"{module} {name}")
                break
            here = found.body
    assert lost == []


EXAMPLES_OF_FAMILIES = {"demo.py"}
"""The job that is shown is about some machine, as are the lines to type (``amp-studio new …``)
in the help of verbs."""
ORDINARY_WORDS = {"NT", "basic", "num", "patch", "registers"}
"""Parts of such names that are words of the language too."""


def texts_of_program(path: Path) -> Iterator[tuple[int, str]]:
    """Yield line and text of every string of a module that is no docstring."""
    nodes = nodes_of(path)
    prose = {
        id(node.value)
        for node in nodes
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    }
    for node in nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in prose:
            yield node.lineno, node.value


def names_of_families() -> re.Pattern[str]:
    """Return what finds the id, the first words of the name or a format of a family."""
    formats = {each.key for each in all_formats() if each not in formats_of("")}
    words = {word for family in family_ids() for word in load_schema(family).family.name.split()[:2]}
    titles = {word for word in words if not word.islower()}
    names = {*family_ids(), *formats, *titles} - ORDINARY_WORDS
    return re.compile(rf"(?<![\w.-])({'|'.join(map(re.escape, sorted(names)))})(?![\w-])")


def test_nothing_generic_names_a_family_or_its_formats(checkout: Path) -> None:
    named, package = names_of_families(), checkout / "amp_studio"
    assert [
        f"{path.relative_to(package).as_posix()}:{line}: {text}"
        for path in sorted(package.rglob("*.py"))
        if path.relative_to(package).parts[0] != "families"
        and path.relative_to(package).as_posix() not in EXAMPLES_OF_FAMILIES
        and named.search(text_of(path))
        for line, text in texts_of_program(path)
        if named.search(text) and not text.startswith("amp-studio ")
    ] == []


def test_a_class_or_alias_has_a_name_that_no_other_has(checkout: Path) -> None:
    """A reader who finds ``State`` knows which one it is; names with an underscore are of one module."""
    places: dict[str, list[str]] = {}
    for path in sorted((checkout / "amp_studio").rglob("*.py")):
        for node in measure_house.tree_of(path).body:
            if isinstance(node, ast.ClassDef):
                name = node.name
            elif isinstance(node, ast.Assign) and isinstance(node.value, ast.Subscript):
                name = ast.unparse(node.targets[0])  # an alias of a type: Literal[…], Callable[…]
            else:
                continue
            if name[0].isupper() and not name.isupper():
                places.setdefault(name, []).append(path.relative_to(checkout).as_posix())
    assert {name: where for name, where in places.items() if len(where) > 1} == {}


def modules_below(package: Path) -> dict[str, Path]:
    """Return name -> file of every module; a package's page has the package's name."""
    return {
        ".".join(path.relative_to(package.parent).with_suffix("").parts).removesuffix(".__init__"): path
        for path in sorted(package.rglob("*.py"))
    }


def asked_for(node: ast.Import | ast.ImportFrom, name: str, modules: dict[str, Path]) -> Iterator[str]:
    """Yield the modules that an import names; for a name of a front page the page,
    and the module that it is loaded from.
    """
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names if alias.name in modules)
        return
    parts = name.split(".") if modules[name].name == "__init__.py" else name.split(".")[:-1]
    base = ".".join(
        [*parts[: len(parts) - node.level + 1], *filter(None, [node.module])] if node.level else []
    )
    base = base or node.module or ""
    for alias in node.names:
        inner = f"{base}.{alias.name}"
        given = dict(given_by(modules[base])) if base in modules else {}
        if alias.name in given:
            yield from {base, f"{base}.{given[alias.name]}"} & modules.keys()
        elif inner in modules:
            yield inner
        elif base in modules:
            yield base


@cache
def given_by(page: Path) -> tuple[tuple[str, str], ...]:
    """Return name and module of what a page takes from its modules, without modules that keep their name."""
    nodes = [*measure_house.tree_of(page).body] if page.name == "__init__.py" else []
    nodes += [inner for node in nodes if isinstance(node, ast.If) for inner in node.body]
    return tuple(
        (alias.asname or alias.name, node.module)
        for node in nodes
        if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module
        for alias in node.names
    )


def imports_of(path: Path, *, at_loading: bool, for_types: bool = False) -> list[ast.Import | ast.ImportFrom]:
    """Return the imports of a file, those for types alone if ``for_types``;
    ``at_loading`` leaves out those in functions.
    """
    found: list[ast.Import | ast.ImportFrom] = []
    open_nodes: list[ast.AST] = [measure_house.tree_of(path)]
    while open_nodes:
        node = open_nodes.pop()
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            found.append(node)
        elif at_loading and isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            continue
        elif not for_types and isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            open_nodes += node.orelse
        else:
            open_nodes += measure_house.statements_in(node)
    return found


def own_pages(package: Path) -> list[str]:
    """Return "module -> page" of every module that imports the page of a package in which it is."""
    modules = modules_below(package)
    return [
        f"{name} -> {page}"
        for name, path in modules.items()
        if path.name not in {"__init__.py", "__main__.py"}
        for node in imports_of(path, at_loading=False)
        for page in dict.fromkeys(asked_for(node, name, modules))
        if "." in page and name.startswith(f"{page}.")
    ]


def circles(package: Path) -> list[list[str]]:
    """Return the modules that import each other when they are loaded, each circle once."""
    modules = modules_below(package)
    asked = {
        name: (
            {m for node in imports_of(path, at_loading=True) for m in asked_for(node, name, modules)} - {name}
        )
        for name, path in modules.items()
    }
    reached = {name: set(direct) for name, direct in asked.items()}
    grows = True
    while grows:
        grows = False
        for known in reached.values():
            more = set().union(*(reached[each] for each in known)) - known
            grows = grows or bool(more)
            known.update(more)
    found = {
        tuple(sorted(other for other in reached[name] if name in reached[other]))
        for name in modules
        if name in reached[name]
    }
    return [list(each) for each in sorted(found)]


def test_no_module_imports_the_page_of_its_own_room(checkout: Path) -> None:
    """The page imports it: two threads that begin at either end get a module that is not ready."""
    assert own_pages(checkout / "amp_studio") == []


def test_no_modules_import_each_other_when_they_are_loaded(checkout: Path) -> None:
    assert circles(checkout / "amp_studio") == []


@cache
def names_between_rooms() -> tuple[measure_house.ImportedName, ...]:
    """Return every name that a room takes from another."""
    return tuple(measure_house.imported_names())


def test_no_room_takes_a_name_past_a_front_page() -> None:
    past = [name for name in names_between_rooms() if name.is_past]
    assert [f"{name.where}: {name.module} {name.name}" for name in past] == []


def test_a_front_page_gives_what_another_room_takes_and_nothing_else(checkout: Path) -> None:
    """What no other room asks for is private to its room, and a test takes it from its module."""
    taken: dict[str, set[str]] = {}
    for name in names_between_rooms():
        taken.setdefault(name.given_by, set()).add(name.name)
    pages = {
        ".".join(page.relative_to(checkout / "amp_studio").parts[:-1]): page
        for page in measure_house.pages(checkout / "amp_studio")
    }
    assert {"schema", "transfer.links", "ui"} <= pages.keys()
    idle = {
        room: {name for name, _, _ in listed(page.read_text("utf-8"))} - taken.get(room, set())
        for room, page in pages.items()
    }
    assert {room: names for room, names in idle.items() if names} == {}


def test_no_name_of_a_front_page_is_a_module_below_it_too(checkout: Path) -> None:
    """Python sets a loaded module on its package:
    a name that is loaded when it is asked for would be the module then.
    """
    assert [
        f"{page.parent.name}.{name}"
        for page in measure_house.pages(checkout / "amp_studio")
        for name, _, _ in listed(page.read_text("utf-8"))
        if (page.parent / f"{name}.py").is_file() or (page.parent / name).is_dir()
    ] == []


def test_a_name_of_a_module_that_another_thread_is_loading_is_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A window asked for one while pictures were loaded beside it: an internal error, once in many runs."""
    room = tmp_path / "slow_room"
    room.mkdir()
    (room / "__init__.py").write_text(
        "from amp_studio.front_pages import front_page\nTYPE_CHECKING = False\nif TYPE_CHECKING:\n"
        "    from .slow import LAST\nelse:\n    __getattr__ = front_page(__name__)\n"
    )
    (room / "slow.py").write_text("import threading\nBEGUN.set()\nGO_ON.wait(20)\nLAST = 1\n")
    monkeypatch.syspath_prepend(tmp_path)
    begun, go_on = threading.Event(), threading.Event()
    monkeypatch.setattr(builtins, "BEGUN", begun, raising=False)
    monkeypatch.setattr(builtins, "GO_ON", go_on, raising=False)
    beside = threading.Thread(target=import_module, args=("slow_room.slow",))
    beside.start()
    assert begun.wait(20)
    threading.Timer(0.05, go_on.set).start()
    assert import_module("slow_room").LAST == 1
    beside.join()


def test_a_name_that_is_not_on_a_front_page_is_an_attribute_error() -> None:
    assert schema.load_schema is load_schema
    with pytest.raises(AttributeError, match=r"amp_studio\.schema has no nothing on its front page"):
        schema.nothing  # noqa: B018  # asking is what is tried


@pytest.mark.parametrize(
    ("line", "pages", "circle"),
    [
        ("import amp_studio.sim", True, True),
        ("from amp_studio.sim import Trace", True, True),
        ("from . import Trace", True, True),
        ("from . import trace", False, False),
        ("from .trace import Trace", False, False),
        ("def late():\n    from . import Trace", True, False),
        ("from .listing import listing", False, True),
    ],
)
def test_a_planted_circle_is_found(tmp_path: Path, line: str, pages: bool, circle: bool) -> None:
    room = tmp_path / "amp_studio" / "sim"
    room.mkdir(parents=True)
    (tmp_path / "amp_studio" / "__init__.py").touch()
    (room / "__init__.py").write_text("from .law import Law\nfrom .trace import Trace\n")
    (room / "trace.py").write_text("class Trace: ...\n")
    (room / "listing.py").write_text("from .law import Law\n")
    (room / "law.py").write_text(f"{line}\nclass Law: ...\n")
    assert bool(own_pages(tmp_path / "amp_studio")) == pages
    assert bool(circles(tmp_path / "amp_studio")) == circle


LOOPS = {"amp_studio.ui.base.modal": {"dialog.exec"}, "amp_studio.ui.base.task": {"loop.exec"}}
"""Module -> where an event loop may run inside another one; each checks that who waited still exists."""


def test_an_event_loop_runs_inside_another_one_in_two_places_alone(checkout: Path) -> None:
    found: dict[str, set[str]] = {}
    for name, path in modules_below(checkout / "amp_studio").items():
        for node in nodes_of(path) if re.search(r"\.\s*(exec|processEvents)", text_of(path)) else ():
            if isinstance(node, ast.Attribute) and node.attr in {"exec", "exec_", "processEvents"}:
                found.setdefault(name, set()).add(ast.unparse(node))
    assert {
        name: loops - {"application.exec"} for name, loops in found.items() if loops - {"application.exec"}
    } == LOOPS


def test_the_window_loads_the_simulator_by_its_loader_alone(checkout: Path) -> None:
    """An import in a function of ui that brings the simulator comes after a call of the loader
    in that function.
    """
    modules = modules_below(checkout / "amp_studio")
    brings = {"amp_studio.dossier"} | {name for name in modules if f"{name}.".startswith("amp_studio.sim.")}
    asked = {
        name: {m for node in imports_of(path, at_loading=True) for m in asked_for(node, name, modules)}
        for name, path in modules.items()
    }
    while more := {name for name, direct in asked.items() if direct & brings} - brings:
        brings |= more
    beside = []
    for name, path in modules.items():
        if not name.startswith("amp_studio.ui.") or name in brings:
            continue
        for function in nodes_of(path):
            if not isinstance(function, ast.FunctionDef):
                continue
            if not any(isinstance(node, (ast.Import, ast.ImportFrom)) for node in function.body):
                continue
            loaded = [
                call.lineno
                for call in ast.walk(function)
                if isinstance(call, ast.Call) and ast.unparse(call.func) in {"load", "_load_plots"}
            ]
            beside += [
                f"{name}:{node.lineno}"
                for node in function.body
                if isinstance(node, (ast.Import, ast.ImportFrom))
                and set(asked_for(node, name, modules)) & brings
                and not any(line < node.lineno for line in loaded)
            ]
    assert beside == []
    assert "amp_studio.ui.motion.step_answer" in brings


def test_no_test_is_longer_than_a_screen(checkout: Path) -> None:
    """40 lines from its name to its end; what several tests need is a fixture, long texts are constants."""
    test = re.compile(r"^( *)def (test\w*)\(.*?(?=^(?!\1 |\1\)|\s*$))", re.MULTILINE | re.DOTALL)
    long = [
        f"{path.relative_to(checkout)}: {found[2]}: {lines} lines"
        for path in sorted((checkout / "tests").rglob("test_*.py"))
        for found in test.finditer(path.read_text("utf-8") + "\nend")
        if (lines := found[0].rstrip().count("\n") + 1) > 40
    ]
    assert long == []


SILENCED = re.compile(r"#\s*(?:noqa|type:\s*ignore|pragma:\s*no cover)\b(?P<rest>.*)$")
"""A comment that silences a check, in a line of code."""
REASON = re.compile(r"(?:: [A-Z]+\d+(?:, ?[A-Z]+\d+)*|\[[a-z-]+(?:, ?[a-z-]+)*\])(?:  # | -- )\S+")
"""What it names, and why."""


def silenced_without_reason(text: str) -> list[str]:
    """Return the lines in which a check is silenced without its name and a reason beside it."""
    return [
        line.strip()
        for line in text.splitlines()
        if (found := SILENCED.search(line)) and not REASON.match(found["rest"])
    ]


def test_every_silenced_check_has_its_reason_beside_it(checkout: Path) -> None:
    folders = ("amp_studio", "tests", "scripts", "bench", "docs")
    paths = [path for folder in folders for path in sorted((checkout / folder).rglob("*.py"))]
    found = {
        path.relative_to(checkout).as_posix(): lines
        for path in paths
        if path.name != "test_architecture.py"
        and (lines := silenced_without_reason(path.read_text(encoding="utf-8")))
    }
    assert found == {}


@pytest.mark.parametrize(
    ("line", "is_fine"),
    [
        ("import x  # noqa: F401  # others take it from here", True),
        ("import x  # noqa: F401", False),
        ("import x  # noqa", False),
        ("y = f()  # type: ignore[arg-type]  # Qt gives one of this kind", True),
        ("y = f()  # type: ignore[arg-type, misc]", False),
    ],
)
def test_a_check_that_is_silenced_without_a_reason_is_found(line: str, is_fine: bool) -> None:
    assert (silenced_without_reason(line) == []) is is_fine


def test_every_rule_that_is_switched_off_has_its_reason(checkout: Path) -> None:
    """In the tables of ruff and mypy: beside the rule, or in the line above it."""
    lines = (checkout / "pyproject.toml").read_text(encoding="utf-8").splitlines()
    start = lines.index("ignore = [")
    end = lines.index("[tool.ruff.lint.isort]")
    rules = [n for n in range(start + 1, end) if re.search(r'^\s*"[A-Z]+\d*",|= \["', lines[n])]
    assert len(rules) > 30
    missing = [lines[n].strip() for n in rules if not re.search(r"# +\S+|= \[$", lines[n])]
    assert missing == [f'"D10{n}",' for n in (2, 3, 4, 5, 7)], "D100 gives the reason of all of them"


@pytest.mark.parametrize("folder", ["amp_studio", "tests", "scripts", "bench"])
def test_the_formatter_decides(checkout: Path, folder: str) -> None:
    pragma = re.compile("# fmt" + ": (skip|off)")
    paths = sorted((checkout / folder).rglob("*.py"))
    assert [str(path) for path in paths if pragma.search(path.read_text("utf-8"))] == []


def _texts_of(node: ast.expr) -> Iterator[str]:
    """Yield the texts that a ``format`` is asked of, in the window inside ``tr(...)``."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] == "tr":
        yield from (text for argument in node.args for text in _texts_of(argument))
    elif isinstance(node, ast.IfExp):
        yield from _texts_of(node.body)
        yield from _texts_of(node.orelse)


def test_every_place_of_a_text_is_filled_in(checkout: Path) -> None:
    """A ``format`` whose argument has another name than the place in the text ends in a KeyError on the
    screen.
    """
    empty = [
        f"{path.relative_to(checkout)}:{node.lineno}: {text}"
        for path in sorted((checkout / "amp_studio").rglob("*.py"))
        if "format(" in text_of(path)
        for node in nodes_of(path)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "format"
        if all(keyword.arg for keyword in node.keywords)
        for text in _texts_of(node.func.value)
        for _, place, _, _ in string.Formatter().parse(text)
        if place and place.isidentifier() and place not in {keyword.arg for keyword in node.keywords}
    ]
    assert empty == []
