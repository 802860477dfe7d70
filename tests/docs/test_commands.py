"""Every command of README, CONTRIBUTING, the pages of docs and the examples is run here word for word,
one after the other.

Only an address or a device that is not here is replaced: a port that somebody has, a serial line,
a host of a plant.
"""

import json
import os
import re
import shutil
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import jsonschema
import pytest
from page_pictures import BEGINS_WITH, files_of

from amp_studio import cli
from amp_studio.cli import console
from amp_studio.schema.yaml_reader import read_yaml
from amp_studio.sim.scenarios import SCENARIOS
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.opening import listen
from amp_studio.transfer.plain.line import ByteLine, Patience
from amp_studio.transfer.plain.receiver import BlockReceiver
from amp_studio.transfer.plain.sender import BlockSender
from amp_studio.transfer.plain.ymodem import PlainFile, send_batch

from .pages import PROGRAMS, ROOT, documents, is_form, lines_of, text_of, verbs
from .stage import Stage, leave_out_what_takes_long, present_gains

EXAMPLES = ROOT / "examples"
MILL = EXAMPLES / "mill-1394/MILL_1394.amp"

CANNOT_RUN = {
    'pipx install ".[fast]"': "installs from the network",
    "py -m venv .venv": "Windows",
    r".venv\Scripts\python -m pip install --require-hashes --no-deps -r requirements\dev.lock": "Windows",
    r".venv\Scripts\python -m pip install --no-index --no-deps --no-build-isolation --editable .": "Windows",
    r".venv\Scripts\python -m pytest -n 2 --dist worksteal": "Windows",
    ". .venv/bin/activate": "the tests have their own environment; make run has made this one",
    "keyring set amp-studio tls://192.168.0.5:9643": "asks for a password, for the keyring of the person",
    "git mergetool --tool=amp": (
        "a window in which a person settles a conflict; tests/ui/test_merge_program.py"
    ),
    "amp-studio send A.txt B.txt --to rfc2217://192.168.0.9:2217 --protocol ymodem": (
        "a device server; tests/transfer/links/test_rfc2217.py"
    ),
}
"""Command that is not run, and why."""

ROUTER = EXAMPLES / "acromill-router"
PRESS = {"LABEL_PRESS.amp": EXAMPLES / "57c422b-label-press/LABEL_PRESS.amp"}
PROGRAM = {"router.amp": ROUTER / "ROUTER.amp", "plate.nc": ROUTER / "plate.nc"}

COPIES = {
    "docs/commands.md": PROGRAM | PRESS,
    "docs/commissioning.md": {"mill.amp": MILL},
    "docs/reports.md": {
        "mill.amp": MILL,
        "a.amp": MILL,
        "b.amp": MILL,
        "c.amp": MILL,
        "old.amp": MILL,
        "other.amp": MILL,
    },
    "docs/merging.md": {
        "mill.amp": MILL,
        "other.amp": MILL,
        "base.amp": MILL,
        "ours.amp": MILL,
        "theirs.amp": MILL,
    },
    "docs/protocols/acr-terminal.md": {"router.amp": EXAMPLES / "acromill-router/ROUTER.amp"},
    "docs/protocols/num-table.md": {"mill.amp": EXAMPLES / "num-1060-mill/MILL_1060.amp"},
    "docs/protocols/plain-files.md": {"PROGRAM.txt": MILL},
    "docs/protocols/password.md": {
        name: ROOT / "tests/transfer/links/certificates" / source
        for name, source in {
            "control.pem": "control.pem",
            "control.key": "control.key",
            "plant.pem": "authority.pem",
        }.items()
    },
}
"""Document -> the files that are there before its first command."""

CONTROLS = {
    "docs/protocols/acr-terminal.md": {
        "/dev/ttyUSB0": "acromill --listen pty:?protocol=terminal",
        "192.168.0.7:23": "acromill --listen tcp://127.0.0.1:0?protocol=terminal",
    },
    "docs/protocols/grblhal.md": {"/dev/ttyUSB0": "grblhal --listen pty:?protocol=grbl"},
    "docs/protocols/num-table.md": {"/dev/ttyUSB0": "num --listen pty:?protocol=peripheral"},
}
"""Document -> what is used for a device or a host of a plant: an emulated control."""

DIFFERS = ("diff", "compare")
"""Verbs that end with 1 where something differs, which is what documents show."""
FINDS = {
    ("CONTRIBUTING.md", "amp-studio validate try.amp"),
    ("docs/howto/add-rule.md", "amp-studio validate fast.amp"),
    ("docs/tutorial.md", "amp-studio validate mill.amp"),
    ("docs/tutorial.md", "amp-studio fix mill.amp --dry-run"),
    ("docs/commands.md", "amp-studio validate second.amp"),
    ("docs/commands.md", "amp-studio validate second.amp --why"),
    ("docs/commands.md", "amp-studio fix second.amp --dry-run"),
    ("docs/commands.md", "amp-studio fix second.amp --safe"),
    ("docs/merging.md", "amp-studio merge base.amp ours.amp theirs.amp --dry-run"),
}
"""(document, command) that shows errors or conflicts and so may end with 1."""

SEEN = {
    "docs/howto/first-download.md": (
        "0 errors",
        "Download complete and read back equal",
        "0 differ",
        "download .* verify ",
    ),
    "docs/howto/num-table.md": ("0 differ", "0 errors"),
    "docs/howto/grblhal-board.md": ("301.5", "1 differ"),
    "docs/howto/compare-machines.md": ("1 differ",),
    "docs/howto/repository.md": ("line2.amp: 0 errors", "line2.amp: 0 errors"),
    "docs/howto/own-rules.md": ("0 errors, 3 warnings", "0 errors, 0 warnings, 4 rec"),
    "docs/howto/tune-an-axis.md": (
        "steady following error +9.99",
        "bandwidth",
        "steady following error +9.09",
        "0 errors",
    ),
    "docs/howto/identify-friction.md": (
        r"viscous friction +0\.(399|400)\d* ±",
        r"Coulomb friction +3\.\d* ±",
        r"gravity +2\.\d* ±",
    ),
    "docs/howto/add-family.md": (
        "ld2 +LD2 step drive +3 parameters",
        "Travel per Turn",
        "slide.amp: 0 errors, 0 warnings",
    ),
    "docs/howto/add-parameter.md": ("Highest Speed", "20 mm/s", "table.amp: 0 errors, 0 warnings", "P4"),
    "docs/howto/add-rule.md": (
        "the motor gets 64000 steps a second",
        "-> 8437 mm/min",
        "fast.amp: 0 errors, 0 warnings, 0 rec",
    ),
    "docs/howto/write-template.md": ("mill.pdf", "mill.html"),
}
"""Document -> what its commands print, one after the other, as it promises."""


@pytest.fixture
def stage(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Stage]:
    """Return an empty folder with the examples; the desktop program opens no window."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(
        "amp_studio.ui.main", lambda files: int(not all(Path(file).is_file() for file in files))
    )
    monkeypatch.setattr("os.cpu_count", lambda: 1)  # tests/sim/test_sweep.py has more processes
    shutil.copytree(EXAMPLES, "examples")
    if not os.environ.get(
        "AMP_STUDIO_FULL"
    ):  # a second a paper, which tests/report sets; all else of a paper is made
        monkeypatch.setattr("amp_studio.report.output.pdf.set_pdf", lambda source, options: (b"%PDF-", ""))
    stage = Stage(tmp_path)
    yield stage
    stage.close()


def prepare(page: str, stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    """Put there what a document begins with."""
    leave_out_what_takes_long(monkeypatch)
    for name, source in COPIES.get(page, {}).items():
        shutil.copy(source, name)
    for text, words in CONTROLS.get(page, {}).items():
        control, at = stage.control(words.split())
        stage.replaced[text] = at.removeprefix("serial:").removeprefix("tcp://").partition("?")[0]
        if page == "docs/protocols/num-table.md":
            press_what_is_shown(stage.keys_of(control), monkeypatch)
            stage.replaced["baud=9600"] = (
                "baud=115200"  # the program keeps to the rate of a line, also of one that has none
            )
    if page == "docs/reports.md":
        Path("REPORT.pdf").write_bytes(
            b"%PDF-1.7\n<</Type /EmbeddedFile>>\nstream\n" + MILL.read_bytes() + b"\nendstream\n"
        )
    if page.startswith("examples/"):
        os.chdir(Path(page).parent)
    for displayed in (*BEGINS_WITH.get(page, ()), page):
        stage.write(files_of(displayed))
    if page == "docs/merging.md":
        make_sides(stage)
    if page == "docs/protocols/password.md":
        Path("password").write_text("correct horse\n", encoding="utf-8")
        monkeypatch.setenv("AMP_STUDIO_PASSWORD", "correct horse")


def make_sides(stage: Stage) -> None:
    """Make the sides of a merge, in a repository with two commits."""
    for name, value in (("ours.amp", "1300=1"), ("theirs.amp", "1300=2"), ("other.amp", "1300=3")):
        assert cli.run(["set", name, value]) == 0
    who = "-c user.name=a -c user.email=a@b -c commit.gpgsign=false"
    for n in (1, 2):
        assert cli.run(["set", "mill.amp", f"1300={n}"]) == 0
        assert stage.run(f"git init -q && git add mill.amp && git {who} commit -q -m {n}") == 0


def press_what_is_shown(press: Callable[[str], None], monkeypatch: pytest.MonkeyPatch) -> None:
    """Be the person at the keys of a NUM control, who does what the program shows."""
    displayed = console.print_notice

    def read(text: str, end: str = "\n") -> None:
        displayed(text, end=end)
        for item, keys in (("3 UNLOAD", "exit unload enter start"), ("2 LOAD", "exit load enter")):
            if item in text:
                for key in keys.split():
                    press(key)

    monkeypatch.setattr(console, "print_notice", read)


@pytest.mark.parametrize("page", [page for page in documents() if page != "docs/protocols/plain-files.md"])
def test_the_commands_of_a_document_work_word_for_word_one_after_the_other(
    page: str, stage: Stage, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    prepare(page, stage, monkeypatch)
    printed = []
    for line in lines_of(page):
        if line in CANNOT_RUN or is_form(line):
            continue
        may_be_1 = (page, line) in FINDS or line.removeprefix("amp-studio ").startswith(DIFFERS)
        code = stage.run(line)
        displayed = capsys.readouterr()
        assert code == 0 or (code == 1 and may_be_1), (line, code, displayed.err)
        printed.append(displayed.out)
    everything = "".join(printed)
    assert re.search(".*".join(SEEN.get(page, ())), everything, re.DOTALL), everything
    if page == "docs/howto/write-template.md":
        assert "<h2>Service</h2>" in Path("mill.html").read_text(encoding="utf-8")
    if page == "README.md":
        assert [text for text in printed if text][
            -1
        ] == "my-mill.amp: 0 errors, 0 warnings, 0 recommendations\n"


PLAIN = "docs/protocols/plain-files.md"


def receive(line: ByteLine) -> None:
    receiver = BlockReceiver(line)
    assert receiver.receive(None).startswith(MILL.read_bytes())
    receiver.finish()


def read_tape(line: ByteLine) -> None:
    assert line.get(107, 10) == bytes(100) + b"%\nG0 X0", "a leader, the sign, and the text"


def send_one(line: ByteLine) -> None:
    sender = BlockSender(line, long_blocks=False)
    sender.await_start()
    sender.send(b"N1")


def send(name: str) -> Callable[[ByteLine], None]:
    return lambda line: send_batch(BlockSender(line, long_blocks=True), [PlainFile(name, b"N1")])


OTHER_ENDS = (receive, send_one, send("came.txt"), read_tape)
"""What is at the other end of each line of the page, in its order."""


def test_plain_files_go_over_a_line_word_for_word(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    prepare(PLAIN, stage, monkeypatch)
    Path("TAPE.txt").write_text("G0 X0\n", encoding="ascii")
    Path("folder").mkdir()
    for line, end in zip(
        (line for line in lines_of(PLAIN) if line not in CANNOT_RUN and not is_form(line)),
        OTHER_ENDS,
        strict=True,
    ):
        with closing(listen(parse_endpoint("pty:"))) as listener, ThreadPoolExecutor(1) as pool:
            stage.replaced |= dict.fromkeys(("/dev/ttyUSB0", "COM3"), listener.endpoint.device)
            link = listener.accept(10)
            assert link is not None
            served = pool.submit(end, ByteLine(link, Patience(ask=0.1)))
            assert stage.run(line) == 0, line
            served.result(10)
    assert Path("BACK.txt").read_bytes() == b"N1"
    assert Path("folder/came.txt").read_bytes() == b"N1"


def test_what_cannot_be_run_is_a_short_list_of_commands_that_documents_have() -> None:
    written = {line for page in documents() for line in lines_of(page)}
    assert set(CANNOT_RUN) <= written
    assert len(CANNOT_RUN) <= 9
    assert {line for _, line in FINDS} <= written
    assert {*COPIES, *CONTROLS, *SEEN, *BEGINS_WITH} <= set(documents())


def test_forms_name_verbs_and_options_that_there_are() -> None:
    forms = [line.split() for page in documents() for line in lines_of(page) if is_form(line)]
    assert len(forms) > 10
    for _, verb, *words in (form for form in forms if form[0] in PROGRAMS and form[1] != "VERB"):
        known = verbs()[verb].options
        assert [word for word in words if word.startswith("-") and word not in known] == [], (verb, words)


def keys_of(found: object) -> list[str]:
    """Return the keys of a JSON document, those of its parts behind them, in brackets where it is a list."""
    if isinstance(found, list):
        return ["[", *keys_of(found[0]), "]"] if found and isinstance(found[0], dict) else []
    assert isinstance(found, dict)
    return [
        word
        for key, value in found.items()
        for word in (key, *(keys_of(value) if isinstance(value, (list, dict)) else ()))
    ]


def without_empty(found: object, described: str) -> str:
    """Return what the page has of a document without the parts of its lists that are empty here."""
    empty = [key for key, value in found.items() if value in ([], None)] if isinstance(found, dict) else []
    return re.sub(rf"(`(?:{'|'.join(empty)})`) \[[^\]]*\]", r"\1", described) if empty else described


def test_the_page_of_commands_has_the_keys_of_every_json_document(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("amp_studio.sim.motion_check.SCENARIOS", {"step": SCENARIOS["step"]})
    monkeypatch.setattr("amp_studio.sim.tuning.solver.Search.best", present_gains)
    for name, source in {**PROGRAM, **PRESS, "mill.amp": MILL, "second.amp": MILL}.items():
        shutil.copy(source, name)
    Path("plate.nc").write_text("G20 G90 G61\nG1 X-0.2 F100\nM2\n", encoding="utf-8")
    cli.run(["set", "second.amp", "1750=4"])
    cli.run(["note", "second.amp", "1750", "lower"])
    rows = re.findall(
        r"^\| `([^`]+)` \| (.*) \|$",
        text_of("docs/commands.md").partition("with `--json` |")[2],
        re.MULTILINE,
    )
    assert len(rows) >= 20, "the table is found"
    for line, described in rows:
        capsys.readouterr()
        assert cli.run([*line.split(), "--json"]) in (0, 1)
        document = json.loads(capsys.readouterr().out)
        words = keys_of(document)
        listed = iter(words)
        missing = [
            word for word in re.findall(r"`(\w+)`", without_empty(document, described)) if word not in listed
        ]
        assert missing == [], (line, missing, words)


def test_own_rules_of_the_page_find_something(stage: Stage, capsys: pytest.CaptureFixture[str]) -> None:
    stage.write(files_of("docs/howto/own-rules.md"))
    shutil.copy(MILL, "machine.amp")
    cli.run(["validate", "machine.amp"])
    assert "ours have 10 mm at most" in capsys.readouterr().out


@pytest.mark.parametrize(
    "page", ["docs/howto/add-family.md", "docs/howto/add-parameter.md", "docs/howto/add-rule.md"]
)
def test_the_facts_of_a_page_fit_the_schemas_that_they_name(page: str) -> None:
    for name, text in files_of(page).items():
        used = (ROOT / name).parent / text.splitlines()[0].partition("$schema=")[2]
        schema = json.loads(Path(os.path.normpath(used)).read_text(encoding="utf-8"))
        jsonschema.validate(read_yaml(text).data, schema)
