"""Measure how much there is to know, and print one table: lines, names, imports past a front page, starts,
installed size.

    python scripts/measure_house.py                  the table
    python scripts/measure_house.py --past find      every name that the room "find" imports past a front page
    python scripts/measure_house.py --complex        every function over complexity 10, the highest first
    python scripts/measure_house.py --no-starts      without the starts, which take some seconds

The same script before and after a change of the structure:
what it prints is written into the decision about that change.
"""

import argparse
import ast
import os
import re
import subprocess
import sys
import tomllib
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "amp_studio"
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
MAX_BRANCHES = 10
"""The cyclomatic complexity up to which a function is easy to read."""
STARTS = 7
"""Processes of each kind, one after the other in turn; the least processor time counts,
for the machine does other work too."""


@dataclass(frozen=True)
class ImportedName:
    """One name that a room takes from another one."""

    room: str
    """Who imports."""
    given_by: str
    """The room that it is imported from."""
    module: str
    name: str
    where: str
    """File and line of the import."""
    is_past: bool
    """Taken from a module inside the other room, not from its front page."""


@cache
def tree_of(path: Path) -> ast.Module:
    """Return the syntax tree of a file, which must not be changed."""
    return ast.parse(path.read_text("utf-8"))


@cache
def room_of(module: str, package: Path = PACKAGE) -> str:
    """Return the room of a module: the folder or single module directly below the package,
    or a folder in it that has a front page.
    """
    parts = module.split(".")[1:]
    for end in range(len(parts), 1, -1):
        if is_front_page(package.joinpath(*parts[:end], "__init__.py")):
            return ".".join(parts[:end])
    return "".join(parts[:1])


@cache
def is_front_page(path: Path) -> bool:
    """Return whether a file is there and makes a front page (amp_studio/front_pages.py)."""
    return path.is_file() and "= front_page(__name__)" in path.read_text("utf-8")


def imported_names(package: Path = PACKAGE) -> Iterator[ImportedName]:
    """Yield every name that a room of ``package`` imports from another room that it is not in;
    those for types alone too.
    """
    top = package.name
    for path in sorted(package.rglob("*.py")):
        inside = path.relative_to(package.parent).with_suffix("").parts
        module = ".".join(inside).removesuffix(".__init__")
        for node in all_statements(tree_of(path)):
            if not isinstance(node, (ast.Import, ast.ImportFrom)):
                continue
            for base, name in _asked_for(node, inside[:-1], package.parent):
                given_by = room_of(base, package)
                if not f"{base}.".startswith(f"{top}.") or f"{module}.".startswith(f"{top}.{given_by}."):
                    continue
                where = f"{path.relative_to(package.parent).as_posix()}:{node.lineno}"
                is_past = base.count(".") > 1 and base != f"{top}.{given_by}"
                yield ImportedName(room_of(module, package), given_by, base, name, where, is_past)


def statements_in(statement: ast.AST) -> Iterator[ast.AST]:
    """Yield the statements directly inside of one or of a module, and the handlers and cases that have some:
    imports are found without the expressions, which are most of the nodes.
    """
    for field in ("body", "orelse", "handlers", "finalbody", "cases"):
        yield from getattr(statement, field, ())


def all_statements(tree: ast.Module) -> Iterator[ast.AST]:
    """Yield every statement of a module."""
    open_ones: list[ast.AST] = [tree]
    while open_ones:
        node = open_ones.pop()
        yield node
        open_ones += statements_in(node)


def _asked_for(
    node: ast.Import | ast.ImportFrom, folder: Sequence[str], root: Path
) -> Iterator[tuple[str, str]]:
    """Yield module and name of each thing that an import takes; a module that is taken whole has no name."""
    if isinstance(node, ast.Import):
        yield from ((alias.name, "") for alias in node.names)
    else:
        above = folder[: len(folder) - node.level + 1] if node.level else ()
        base = ".".join([*above, *filter(None, [node.module])])
        for alias in node.names:
            if is_module(root.joinpath(*base.split("."), alias.name)) and alias.name not in names_given(
                root.joinpath(*base.split("."), "__init__.py")
            ):
                yield f"{base}.{alias.name}", ""
            else:
                yield base, alias.name


@cache
def is_module(path: Path) -> bool:
    """Return whether a module is there: ``path`` as a folder, or with ``.py`` behind it."""
    return path.is_dir() or path.with_suffix(".py").is_file()


@cache
def names_given(page: Path) -> frozenset[str]:
    """Return the names that a front page gives: what it imports, also for type checkers alone,
    and what it makes.
    """
    given: set[str] = set()
    open_nodes: list[ast.stmt] = [*tree_of(page).body]
    for node in open_nodes:
        if isinstance(node, ast.If):
            open_nodes += node.body
        elif isinstance(node, ast.ImportFrom):
            given.update(alias.asname or alias.name for alias in node.names if node.level)
        elif isinstance(node, (*FUNCTIONS, ast.ClassDef)):
            given.add(node.name)
        elif isinstance(node, ast.Assign):
            given.update(target.id for target in node.targets if isinstance(target, ast.Name))
    return frozenset(name for name in given if not name.startswith("_"))


def pages(package: Path = PACKAGE) -> list[Path]:
    """Return the front pages of the rooms."""
    return sorted(filter(is_front_page, package.rglob("*/__init__.py")))


def line_count(path: Path) -> int:
    """Return the lines of a file."""
    return path.read_bytes().count(b"\n")


def body_lines(tree: ast.Module) -> int:
    """Return the lines inside of functions, without their heads and docstrings."""
    lines: set[int] = set()
    for node in ast.walk(tree):
        if isinstance(node, FUNCTIONS):
            body = node.body[1:] if ast.get_docstring(node) is not None else node.body
            if body:
                lines.update(range(body[0].lineno, (node.end_lineno or 0) + 1))
    return len(lines)


def public_names(tree: ast.Module) -> list[str]:
    """Return the names of a module that begin with a letter."""
    found: list[str] = []
    for node in tree.body:
        if isinstance(node, (*FUNCTIONS, ast.ClassDef)):
            found.append(node.name)
        elif isinstance(node, ast.Assign):
            found += [target.id for target in node.targets if isinstance(target, ast.Name)]
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            found.append(node.target.id)
    return [name for name in found if not name.startswith("_")]


def code_figures() -> Iterator[tuple[str, str]]:
    """Yield name and figure of what the sources are."""
    sources = sorted(PACKAGE.rglob("*.py"))
    trees = [tree_of(path) for path in sources]
    nodes = [node for tree in trees for node in ast.walk(tree)]
    functions = [branches(node) for node in nodes if isinstance(node, FUNCTIONS)]
    hard = sum(count > MAX_BRANCHES for count in functions)
    tests = sum(map(line_count, (ROOT / "tests").rglob("*.py")))
    yield "lines of the program", f"{sum(map(line_count, sources)):,}"
    yield "of them in bodies of functions", f"{sum(map(body_lines, trees)):,}"
    yield "lines of the tests", f"{tests:,}"
    yield "modules", f"{sum(path.name != '__init__.py' for path in sources):,}"
    folder, most = Counter(path.parent for path in sources if path.name != "__init__.py").most_common(1)[0]
    yield "modules of the fullest folder", f"{most} ({folder.relative_to(ROOT).as_posix()})"
    yield "classes", f"{sum(isinstance(node, ast.ClassDef) for node in nodes):,}"
    yield "public names of modules", f"{sum(len(public_names(tree)) for tree in trees):,}"
    yield ("names on the front pages of the rooms", f"{sum(len(names_given(page)) for page in pages()):,}")
    yield "functions", f"{len(functions):,}"
    yield f"functions over complexity {MAX_BRANCHES}", f"{hard:,} ({hard / len(functions):.1%})"
    taken = list(imported_names())
    past = sum(name.is_past for name in taken)
    yield "names imported between rooms", f"{len(taken):,}"
    yield "of them past a front page", f"{past:,} ({past / len(taken):.0%})"


def branches(function: ast.AST) -> int:
    """Return the cyclomatic complexity of a function, counted as radon does: 1,
    and 1 for each way the code can part.
    """
    count = 1
    for node in own_nodes(function):
        match node:
            case (
                ast.If()
                | ast.For()
                | ast.While()
                | ast.IfExp()
                | ast.ExceptHandler()
                | ast.Assert()
                | ast.match_case()
            ):
                count += 1
            case ast.BoolOp():
                count += len(node.values) - 1
            case ast.comprehension():
                count += 1 + len(node.ifs)
    return count


def complex_functions(package: Path = PACKAGE) -> list[tuple[int, str, str]]:
    """Return complexity, place and name of every function that is not easy to read, the highest first."""
    rows = [
        (branches(node), f"{path.relative_to(package.parent).as_posix()}:{node.lineno}", node.name)
        for path in sorted(package.rglob("*.py"))
        for node in ast.walk(tree_of(path))
        if isinstance(node, FUNCTIONS)
    ]
    return sorted((row for row in rows if row[0] > MAX_BRANCHES), key=lambda row: (-row[0], row[1]))


def own_nodes(function: ast.AST) -> Iterator[ast.AST]:
    """Yield what is in a function, without what is in functions and classes inside of it."""
    open_ones = [*ast.iter_child_nodes(function)]
    while open_ones:
        node = open_ones.pop()
        yield node
        if not isinstance(node, (*FUNCTIONS, ast.ClassDef)):
            open_ones += ast.iter_child_nodes(node)


def concepts(glossary: Path) -> int:
    """Return the rows of the tables of a glossary."""
    tables = re.findall(r"^\|.*\n\|[-| :]+\n((?:\|.*\n)+)", glossary.read_text("utf-8"), re.MULTILINE)
    return sum(table.count("\n") for table in tables)


def start_figures() -> Iterator[tuple[str, str]]:
    """Yield the processor time of starts, in processor times of a Python that does nothing."""
    example = ROOT / "examples" / "mill-1394" / "MILL_1394.amp"
    program = (sys.executable, "-m", "amp_studio")
    commands = {
        "import amp_studio": (sys.executable, "-c", "import amp_studio"),
        "--version": (*program, "--version"),
        "--help": (*program, "--help"),
        "validate": (*program, "validate", str(example)),
        "simulate": (*program, "simulate", str(example), "step"),
        "import of the window": (sys.executable, "-c", "import amp_studio.ui.main_window"),
    }
    bare = (sys.executable, "-c", "pass")
    seconds: dict[str, list[float]] = {name: [] for name in ("", *commands)}
    for _ in range(STARTS):
        for name, command in {"": bare, **commands}.items():
            seconds[name].append(processor_time(command))
    yield "Python that does nothing", f"{min(seconds['']) * 1000:.0f} ms"
    for name in commands:
        yield f"start: {name}", f"{min(seconds[name]) / min(seconds['']):.1f} x"


def processor_time(command: Sequence[str]) -> float:
    """Return the seconds of processor time of a process that was run to its end; not on Windows,
    which does not count them.
    """
    import resource

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    environment = os.environ | {"QT_QPA_PLATFORM": "offscreen", "PYTHONPATH": str(ROOT)}
    subprocess.run(command, env=environment, stdin=subprocess.DEVNULL, capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def install_figures() -> Iterator[tuple[str, str]]:
    """Yield the size of what is installed with the program, and of each extra beyond it."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    needed = distributions(project["dependencies"])
    yield "installed with the program", megabytes(needed)
    for extra, lines in project["optional-dependencies"].items():
        yield f"more with the extra {extra}", megabytes(distributions(lines) - needed)
    largest = sorted(needed, key=size_of_distribution, reverse=True)[:4]
    yield "largest of them", ", ".join(f"{name} {megabytes({name})}" for name in largest)


def distributions(requirements: Iterable[str]) -> set[str]:
    """Return the names of what is installed for some requirements, and for what those require."""
    from packaging.requirements import Requirement

    found: set[str] = set()
    open_ones = [(Requirement(line), "") for line in requirements]
    while open_ones:
        requirement, extra = open_ones.pop()
        name = re.sub(r"[-_.]+", "-", requirement.name).lower()
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": extra}):
            continue
        try:
            further = distribution(name).requires or ()
        except PackageNotFoundError:
            continue
        if name not in found or requirement.extras:
            found.add(name)
            for line in further:
                open_ones += [(Requirement(line), wanted) for wanted in ("", *requirement.extras)]
    return found


def size_of_distribution(name: str) -> int:
    """Return the bytes of the files of an installed distribution."""
    files = (Path(str(file.locate())) for file in distribution(name).files or ())
    return sum(file.stat().st_size for file in files if file.is_file() and file.suffix != ".pyc")


def megabytes(names: Collection[str]) -> str:
    """Return the size of some distributions together."""
    if not names:
        return "not installed"
    return f"{sum(map(size_of_distribution, names)) / 1e6:.0f} MB"


def main() -> None:
    """Print the table, or the imports of one room."""
    parser = argparse.ArgumentParser(description=str(__doc__).partition("\n")[0])
    parser.add_argument("--past", metavar="ROOM", help="list the names that a room imports past a front page")
    parser.add_argument(
        "--complex", action="store_true", help=f"list the functions over complexity {MAX_BRANCHES}"
    )
    parser.add_argument("--no-starts", action="store_true", help="leave out the starts of the program")
    parser.add_argument("--glossary", type=Path, help="count the concepts of this table of words too")
    options = parser.parse_args()
    if options.past:
        for name in imported_names():
            if name.is_past and name.room == options.past:
                print(f"{name.where}: {name.module} {name.name}")
        return
    if options.complex:
        for count, where, function in complex_functions():
            print(f"{count:3} {where} {function}")
        return
    rows = [*code_figures(), *install_figures()]
    if options.glossary:
        rows.append(("concepts of the glossary", str(concepts(options.glossary))))
    if not options.no_starts:
        rows += start_figures()
    for title, figure in rows:
        print(f"{title:40} {figure}")
    past = Counter(name.room for name in imported_names() if name.is_past)
    print(
        "past a front page, by room:              "
        + ", ".join(f"{room} {n}" for room, n in past.most_common())
    )


if __name__ == "__main__":
    main()
