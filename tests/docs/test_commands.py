"""Every command of README and of the pages of docs is run here word for word, or is in the list of those that cannot be."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.cli.parser import parser as parser_of
from amp_studio.cli.parser import verbs_of

ROOT = Path(__file__).parents[2]
MILL = ROOT / "examples/mill-1394/MILL_1394.amp"

RUN = {
    "docs/tutorial.md": (),
    "docs/howto/first-download.md": ("mill.amp",),
    "docs/howto/num-table.md": (),
    "docs/howto/grblhal-board.md": (),
    "docs/howto/compare-machines.md": (),
    "docs/howto/own-rules.md": ("machine.amp",),
    "docs/howto/tune-an-axis.md": ("machine.amp",),
    "docs/howto/identify-friction.md": (),
    "docs/commissioning.md": ("mill.amp",),
    "docs/reports.md": ("mill.amp",),
}
"""Page whose commands are run one after the other -> the files that are there before, copies of the example mill."""

SLOW = {"docs/reports.md"}
"""Five papers take ten seconds; the tests of the report print each of them."""

ONLY_READ = {
    "README.md": "an overview: files of several machines, and controls at addresses that are examples",
    "docs/formats.md": "files that a control has sent",
    "docs/merging.md": "three states of a file that people have worked on",
    "docs/protocols/acr-terminal.md": "a card at a serial port",
    "docs/protocols/grblhal.md": "a board at a serial port",
    "docs/protocols/num-table.md": "a control at a serial port, and a person at its keys",
    "docs/protocols/password.md": "certificates of a plant",
    "docs/protocols/plain-files.md": "a control at a serial port",
    "docs/sheet.md": "a control at which somebody keys in",
}
"""Page whose commands are excused from being run, and why; that the program understands them is checked."""

UNEQUAL = {"diff": 1, "compare": 1}
"""Verb -> its exit code where something differs, which is what the pages show; 0 is right as well."""


def commands(page: str) -> list[str]:
    """Return the command lines of a page, without what is behind them as a comment."""
    lines = (ROOT / page).read_text(encoding="utf-8").splitlines()
    return [line.strip() for line in lines if line.startswith("    amp-studio ")]


def words(line: str) -> list[str]:
    return shlex.split(line, comments=True)[1:]


def pages() -> Iterator[str]:
    for path in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        page = path.relative_to(ROOT).as_posix()
        if commands(page):
            yield page


def test_every_page_with_commands_is_run_or_excused() -> None:
    assert set(pages()) <= set(RUN) | set(ONLY_READ)
    assert not set(RUN) & set(ONLY_READ)
    assert all(commands(page) for page in RUN)


@pytest.mark.parametrize("page", sorted(ONLY_READ))
def test_the_program_understands_every_command_of_a_page_that_is_not_run(page: str, here: Path) -> None:
    Path("machines").mkdir()
    verbs = verbs_of(parser_of())
    for line in commands(page):
        verb, *arguments = words(line.replace(" | ", " # "))
        if verb in verbs:
            verbs[verb].parse_args(arguments)
        else:
            assert Path(verb).suffix == ".amp", line


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("page", sorted(RUN))
def test_the_commands_of_a_page_work_word_for_word_one_after_the_other(
    page: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if page in SLOW and not os.environ.get("AMP_STUDIO_FULL"):
        pytest.skip("AMP_STUDIO_FULL=1 runs it")
    for name in RUN[page]:
        shutil.copy(MILL, name)
    if page == "docs/howto/own-rules.md":
        text = (ROOT / page).read_text(encoding="utf-8")
        Path("rules.yaml").write_text(text.partition("```yaml\n")[2].partition("```")[0], encoding="utf-8")
    controls: list[subprocess.Popen[str]] = []
    try:
        for line in commands(page):
            verb, *arguments = words(line)
            if verb == "emulate":
                controls.append(emulated(arguments))
                continue
            code = cli.run([verb, *arguments])
            unfinished = page == "docs/tutorial.md" and line.endswith(
                "--dry-run"
            )  # errors are left; its last check has none
            assert code in (0, UNEQUAL.get(verb, int(unfinished))), (line, capsys.readouterr().err)
    finally:
        for control in controls:
            control.kill()
            control.communicate()


def emulated(arguments: list[str]) -> subprocess.Popen[str]:
    """Start a control, and return it when it listens."""
    command = [sys.executable, "-m", "amp_studio.cli", "emulate", *arguments]
    control = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert control.stdout is not None
    if not control.stdout.readline():
        pytest.skip(f"the port of the page is taken: {control.communicate()[1]}")
    return control


def test_own_rules_of_the_page_find_something(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (ROOT / "docs/howto/own-rules.md").read_text(encoding="utf-8")
    Path("rules.yaml").write_text(text.partition("```yaml\n")[2].partition("```")[0], encoding="utf-8")
    shutil.copy(MILL, "machine.amp")
    cli.run(["validate", "machine.amp"])
    assert "ours have 10 mm at most" in capsys.readouterr().out
