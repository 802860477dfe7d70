"""The wheel is all a user needs: it is built,
installed into an empty environment and used far from the checkout.
"""

import json
import os
import re
import subprocess
import sys
import sysconfig
import venv
import zipfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.campaigns import CAMPAIGN


@dataclass(frozen=True)
class Installed:
    """An environment that contains the wheel and reaches the libraries, but not the checkout."""

    folder: Path

    def program(self, name: str) -> Path:
        """Return a program of the environment."""
        return self.folder / ("Scripts" if os.name == "nt" else "bin") / name

    def run(self, *command: str, cwd: Path) -> subprocess.CompletedProcess[str]:
        """Run a program of the environment in ``cwd``, as a user without any of our settings would."""
        cache = os.environ["XDG_CACHE_HOME"]  # facts of the same content are compiled by now
        private = {"XDG_CACHE_HOME": cache, "HOME": str(cwd), "LOCALAPPDATA": cache}
        env = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "COV_"))}
        return subprocess.run(
            [self.program(command[0]), *command[1:]],
            cwd=cwd,
            env=env | private,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            encoding="utf-8",
            check=False,
        )


def files_below(folder: Path, *, within: Path) -> Iterable[str]:
    """Yield the files of a folder as a wheel names them."""
    for path in folder.rglob("*"):
        if path.is_file() and "__pycache__" not in path.parts:
            yield path.relative_to(within).as_posix()


@pytest.fixture(scope="module")
def wheel(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the wheel from the checkout without the network; in a campaign from the source archive, which
    takes as long again.
    """
    out = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(out), str(checkout)]
    if not CAMPAIGN:
        command.append("--wheel")
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (found,) = out.glob("*.whl")
    return found


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installed:
    """Install the wheel into a new environment; the libraries come by a path file,
    which leaves editable installs out.
    """
    folder = tmp_path_factory.mktemp("empty") / "venv"
    venv.create(folder, with_pip=False, symlinks=os.name != "nt")
    environment = Installed(folder)
    packages = Path(sysconfig.get_path("purelib", "venv", {"base": str(folder)}))
    libraries = [line for line in sys.path if Path(line).name in {"site-packages", "dist-packages"}]
    (packages / "libraries.pth").write_text("\n".join(libraries), encoding="utf-8")
    pip = [sys.executable, "-m", "pip", "--python", str(environment.program("python"))]
    command = [*pip, "install", "--no-deps", "--no-index", "--no-compile", str(wheel)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return environment


def for_users(name: str) -> bool:
    """Return whether a file of the documents is part of the manual in the window."""
    parts = name.split("/")[1:]
    return parts[0].endswith(".md") or parts[0] in ("howto", "simulation", "protocols", "images")


def test_the_wheel_contains_the_package_the_facts_and_the_examples(checkout: Path, wheel: Path) -> None:
    expected = {
        *files_below(checkout / "amp_studio", within=checkout),
        *(f"amp_studio/{name}" for name in files_below(checkout / "parameter_db", within=checkout)),
        *(f"amp_studio/{name}" for name in files_below(checkout / "examples", within=checkout)),
        *(
            f"amp_studio/{name}"
            for name in files_below(checkout / "docs", within=checkout)
            if for_users(name)
        ),
    }
    names = zipfile.ZipFile(wheel).namelist()
    assert expected == {name for name in names if not re.search(r"\.(dist-info|data)/", name)}
    shared = {name.partition(".data/data/")[2] for name in names if ".data/" in name}
    assert shared == {
        "share/man/man1/amp-studio.1",
        "share/bash-completion/completions/amp-studio",
        "share/zsh/site-functions/_amp-studio",
        "share/fish/vendor_completions.d/amp-studio.fish",
    }


def test_the_installed_program_reads_the_facts_of_the_wheel(installed: Installed, tmp_path: Path) -> None:
    where = "from amp_studio.schema import database_folder; print(database_folder())"
    done = installed.run("python", "-c", where, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    folder = Path(done.stdout.strip()).resolve()
    assert folder.is_relative_to(installed.folder.resolve()), f"{folder} is not in the new environment"
    assert (folder / "9pc" / "family.yaml").is_file()


def test_the_installed_program_knows_its_families(
    checkout: Path, installed: Installed, tmp_path: Path
) -> None:
    done = installed.run("amp-studio", "families", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    known = {row["id"] for row in json.loads(done.stdout)["families"]}
    assert {path.parent.name for path in checkout.glob("parameter_db/*/family.yaml")} == known


def test_a_new_file_is_made_and_printed_far_from_the_checkout(installed: Installed, tmp_path: Path) -> None:
    made = installed.run("amp-studio", "new", "9pc", "machine.amp", cwd=tmp_path)
    assert made.returncode == 0, made.stderr
    assert (tmp_path / "machine.amp").stat().st_size > 0

    starts = {".html": b"<", ".pdf": b"%PDF-"}
    report = "'report', 'machine.amp', '--changed-only', '--without', 'motion', '-o'"
    reports = "; ".join(f"assert run([{report}, 'machine{ending}']) == 0" for ending in starts)
    done = installed.run("python", "-c", f"from amp_studio.cli import run; {reports}", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    for ending, start in starts.items():
        document = (tmp_path / f"machine{ending}").read_bytes()
        assert document
        assert document.startswith(start)


def test_the_installed_program_refuses_in_one_line(installed: Installed, tmp_path: Path) -> None:
    done = installed.run("amp-studio", "new", "no-such-family", "machine.amp", cwd=tmp_path)
    assert done.returncode == 2
    assert len(done.stderr.strip().splitlines()) == 1
    assert list(tmp_path.glob("*.amp")) == []
