"""Help, examples, the man page and shell completion."""

import os
import re
import shlex
import shutil
import socket
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from math import copysign, cos, sin
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.cli import verbs
from amp_studio.cli.candidates import families
from amp_studio.cli.completion import answer
from amp_studio.cli.manual import SECTIONS, sections
from amp_studio.cli.parsing import help_text
from amp_studio.cli.registry import GROUPS, all_verbs, summaries
from amp_studio.cli.verbs.shell.man import man_page
from amp_studio.formats.import_export import all_formats
from amp_studio.scenarios import scenario_names
from amp_studio.schema import family_ids, load_schema
from amp_studio.sim.scenarios import SCENARIOS as SIMULATED
from amp_studio.transfer.links.endpoint import Endpoint
from amp_studio.transfer.links.tcp import TcpLink
from amp_studio.transfer.plain.line import ByteLine
from amp_studio.transfer.plain.receiver import BlockReceiver
from amp_studio.transfer.plain.sender import BlockSender
from amp_studio.transfer.plain.ymodem import PlainFile, send_batch
from tests.campaigns import CAMPAIGN
from tests.docs.pages import lines_of
from tests.docs.stage import Stage, leave_out_what_takes_long

KNOWN = ", ".join(family_ids())

VERBS = all_verbs()
MILL = "MILL_1394.amp"
"""The machine of the examples of every verb."""
EXAMPLE = Path(__file__).parents[2] / "examples" / "mill-1394" / MILL
AT_A_CONTROL = ("emulate", "identify", "status", "download", "verify", "upload", "restore")


def drive_record() -> str:
    """Return what a drive has recorded of an axis that swings."""
    rows = ((n, 80.0 * sin(0.12 * n), 9.6 * cos(0.12 * n)) for n in range(300))
    torques = ((n, v, t + 0.03 * v + copysign(2.0, v)) for n, v, t in rows)
    return "time (s),velocity (mm/s),torque (%)\n" + "".join(
        f"{n / 50},{v:.2f},{t:.2f}\n" for n, v, t in torques
    )


@pytest.fixture(scope="module")
def prepared(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a copy of the example machine, another one that differs, a table of values,
    and a screen's.
    """
    folder = tmp_path_factory.mktemp("examples")
    mill, other = (Path(shutil.copy(EXAMPLE, folder / name)) for name in (MILL, "other.amp"))
    for name in ("ROUTER.amp", "plate.nc"):
        shutil.copy(EXAMPLE.parents[1] / "acromill-router" / name, folder)
    shutil.copy(EXAMPLE.parents[1] / "57c422b-label-press/LABEL_PRESS.amp", folder)
    assert cli.run(["set", str(other), "1300=2"]) == 0
    assert cli.run(["export", str(mill), "-o", str(folder / "values.csv")]) == 0
    for name, text in (
        ("screen.txt", "1300 0.00000\n"),
        ("laser.csv", "position [mm],error [um]\n0,0\n100,4\n200,7\n200,9\n100,6\n0,2\n"),
        ("record.csv", drive_record()),
        ("machine.yaml", "family: 9pc\naxis: X\ntorque: '%'\nmodel: {gravity: 1.5}\n"),
    ):
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.fixture
def here(prepared: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a copy of that folder, which is the present one."""
    shutil.copytree(prepared, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("os.cpu_count", lambda: 1)  # tests/sim/test_sweep.py has more processes
    return tmp_path


# -- help


@pytest.mark.parametrize("arguments", ["--version", "--help", "validate --help", "simulate --help"])
def test_neither_the_version_nor_help_loads_a_schema(arguments: str) -> None:
    code = (
        "import sys; from amp_studio import cli; cli.run(sys.argv[1:]);print([m for m in ('pydantic',"
        " 'ruamel.yaml', 'amp_studio.schema', 'amp_studio.sim') if m in sys.modules])"
    )
    reported = subprocess.run(
        [sys.executable, "-c", code, *arguments.split()], capture_output=True, text=True, check=True
    )
    assert reported.stdout.splitlines()[-1] == "[]"


def test_checking_a_file_loads_nothing_of_printing_saving_and_explaining() -> None:
    names = [
        "typst",
        "jinja2",
        "email",
        "ruamel.yaml",
        "tomllib",
        "amp_studio.report.build",
        "amp_studio.files.yaml_text",
        "amp_studio.files.document",
        "amp_studio.validate.explanation",
        "amp_studio.validate.rule_file",
    ]
    load_schema("9pc")  # compiled by now, as after the first start of a program
    code = (
        f"import atexit, sys; atexit.register(lambda: print([m for m in {names} if m in sys.modules]));"
        "from amp_studio.cli import main; main(['validate', sys.argv[1]])"
    )
    done = subprocess.run([sys.executable, "-c", code, EXAMPLE], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


def test_reading_tables_and_messages_does_not_load_what_checks_facts() -> None:
    """Compiled facts have been checked: checking them again would load pydantic at each start."""
    load_schema("9pc")
    code = (
        "import sys; from amp_studio import cli; from amp_studio.schema import load_schema;"
        "load_schema('9pc').tables; cli.run(['show', '9pc', '1300']); print('pydantic' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "False"


def test_help_names_the_families_and_scenarios_that_there_are() -> None:
    assert tuple(families()) == family_ids()
    assert set(SIMULATED) <= set(scenario_names())


@pytest.mark.parametrize("verb", VERBS)
def test_help_of_every_verb_has_examples_and_exit_codes_and_explains_every_argument(verb: str) -> None:
    printed = help_text(verb, VERBS[verb])
    assert VERBS[verb].examples
    assert all(line in printed for line in VERBS[verb].examples)
    assert "exit codes:\n  0  done" in printed
    assert [each.names for each in VERBS[verb].arguments if not each.help] == []


def test_the_help_of_the_program_has_the_sentence_of_every_verb() -> None:
    listed = {verb: text for group in summaries().values() for verb, text in group.items()}
    assert listed == {name: f"{v.about[0].lower()}{v.about[1:-1]}" for name, v in VERBS.items()}
    assert all(verb.about.endswith(".") for verb in VERBS.values())
    folders = {p.name for p in Path(verbs.__file__).parent.iterdir() if (p / "__init__.py").exists()}
    assert folders == set(GROUPS)
    assert {title for verb in VERBS.values() for title in verb.sections} == set(SECTIONS)


def test_the_file_in_contributing_is_all_that_a_new_verb_needs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    page = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text(encoding="utf-8")
    (text,) = [
        each
        for each in re.findall(r"^```python\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        if "VERB = Verb(" in each
    ]
    for group in GROUPS:
        (tmp_path / group).mkdir()
    (tmp_path / "files/count_axes.py").write_text(text, encoding="utf-8")
    monkeypatch.setattr("amp_studio.cli.registry._FOLDER", str(tmp_path))
    monkeypatch.setattr(verbs.files, "__path__", [str(tmp_path / "files")])
    assert cli.run(["--help"]) == 0
    assert "  count-axes    the axes of a machine, counted\n" in capsys.readouterr().out
    assert cli.run(["count-axes", "--help"]) == 0
    assert "  amp-studio count-axes MILL_1394.amp\n" in capsys.readouterr().out
    assert cli.run(["count-axes", str(EXAMPLE)]) == 0
    assert capsys.readouterr().out == "5\n"
    answer(["count-axes", "--h"], "")
    assert capsys.readouterr().out == "--help\n"


def test_help_names_the_text_formats_that_there_are() -> None:
    displayed = dict(sections(VERBS["import"]))["FORMAT"]
    assert dict(sections(VERBS["export"]))["FORMAT"] == displayed
    formats = sorted(all_formats(), key=lambda each: each.key)
    assert sorted(line.split()[0] for line in displayed) == [each.key for each in formats], (
        "see families.FORMATS"
    )
    for line, each in zip(sorted(displayed), formats, strict=True):
        assert each.title in line
        assert line.endswith(f"({' '.join((each.ending, *each.other_endings))})")


def offline() -> Iterator[str]:
    """Yield the examples that need no control, in their order."""
    yield from (
        line
        for verb in VERBS
        if verb not in (*AT_A_CONTROL, "send", "receive")
        for line in VERBS[verb].examples
    )


def examples_alone() -> list[str]:
    """Return the examples without those that the page of commands has too, where they are run
    (tests/docs/test_commands.py); all of them in a campaign.
    """
    on_the_page = () if CAMPAIGN else {*lines_of("docs/commands.md")}
    files = {MILL: "mill.amp", "ROUTER.amp": "router.amp"}
    as_there = re.compile("|".join(map(re.escape, files)))
    return [
        line
        for line in offline()
        if " demo " not in line
        and (CAMPAIGN or " tune " not in line)  # seconds: docs/howto/tune-an-axis.md does it
        and as_there.sub(lambda found: files[found[0]], line) not in on_the_page
    ]


@pytest.mark.parametrize("line", examples_alone())
def test_an_example_works_word_for_word(
    line: str, here: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    leave_out_what_takes_long(monkeypatch)
    program, *arguments = shlex.split(line)
    differs = arguments[0] in ("diff", "compare")
    assert (program, cli.run(arguments)) == ("amp-studio", 1 if differs else 0), capsys.readouterr().err


def test_the_examples_at_a_control_work_word_for_word_one_after_the_other(here: Path) -> None:
    stage = Stage(here)
    try:
        for line in (line for verb in AT_A_CONTROL for line in VERBS[verb].examples):
            assert stage.run(line) == 0, line
    finally:
        stage.close()


def test_the_examples_of_plain_files_work_word_for_word(here: Path) -> None:
    def receive(line: ByteLine) -> None:
        receiver = BlockReceiver(line)
        assert receiver.receive(None).startswith((here / "MILL_1394.amp").read_bytes())
        receiver.finish()

    def send(line: ByteLine) -> None:
        send_batch(BlockSender(line, long_blocks=True), [PlainFile("received.txt", b"N1")])

    for verb, port, end in (("send", 8194, receive), ("receive", 8195, send)):
        (example,) = VERBS[verb].examples
        try:
            listening = socket.create_server(("127.0.0.1", port))
        except OSError:  # somebody else listens there
            listening = socket.create_server(("127.0.0.1", 0))
        example = example.replace(f":{port} ", f":{listening.getsockname()[1]} ")
        with listening, ThreadPoolExecutor(1) as pool:
            served = pool.submit(lambda: end(ByteLine(TcpLink(Endpoint("tcp"), listening.accept()[0]))))  # noqa: B023  # it ends within the turn
            assert cli.run(shlex.split(example)[1:]) == 0
            served.result(10)
    assert (here / "received.txt").read_bytes() == b"N1"


# -- wrong names


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("vaildate x.amp", "Unknown verb 'vaildate'. Did you mean: validate"),
        ("validate --jsn x.amp", "Unknown option '--jsn'."),
        ("report --outptu x.pdf", "Did you mean: --output"),
        ("--verison", "Unknown option '--verison'. Known: -h, --help, --version. Did you mean: --version"),
        (
            "report a -o b.pdf --sort axes",
            "Unknown sort 'axes'. Known: axis, number, group, steps. Did you mean: axis",
        ),
        ("new 9PC x.amp", f"Unknown family '9PC'. Known: {KNOWN}. Did you mean: 9pc"),
        ("new 9pc x.amp --machine mil", "Unknown machine type 'mil'. Known: lathe, mill. Did you mean: mill"),
        (
            "schema 9pc --group=home-parameters",
            "Unknown group 'home-parameters'. Did you mean: Home Parameters",
        ),
        ("form 9PC -o form.pdf", f"Unknown family '9PC'. Known: {KNOWN}."),
        ("guide nmu", f"Unknown family 'nmu'. Known: {KNOWN}. Did you mean: num"),
        ("form nmu.amp -o form.pdf", "nmu.amp: "),
        ("tables 9pc accdec-code", "Unknown table 'accdec-code'. Did you mean: accdec-codes"),
        (
            "calculate 9pc gain_break_pont",
            "Unknown formula 'gain_break_pont'. Did you mean: gain_break_point",
        ),
        (f"simulate {MILL} setp", "Did you mean: step"),
    ],
)
def test_a_wrong_name_is_answered_with_the_nearest(amp, here: Path, line: str, message: str) -> None:
    refused = amp(*line.split())
    assert (refused.code, message in refused.err) == (2, True), refused.err


def test_all_slips_of_a_set_are_reported_at_once_and_nothing_is_changed(amp, here: Path) -> None:
    before = Path(MILL).read_bytes()
    refused = amp("set", MILL, "1300=abc", "home.calibratio@X=1", "350=drill", "2300=9999999 mm", "3300=1")
    assert refused.code == 2
    for message in ("'abc'", "Unknown parameter 'home.calibratio@X'", "'drill'", "2300"):
        assert message in refused.err, message
    assert Path(MILL).read_bytes() == before
    assert "'1300' is not PARAM=VALUE; '=5' is not PARAM=VALUE" in amp("set", MILL, "1300", "=5").err


# -- findings and counts


def test_what_is_shown_alike_of_several_axes_is_shown_once_and_json_has_each(amp, here: Path) -> None:
    assert amp("set", MILL, "1740=0.1", "2740=0.1", "3740=0.1").code == 0
    reported = amp("validate", MILL)
    found = amp("validate", MILL, "--json").json["findings"]
    rule = found[0]["rule"]
    assert [f["rule"] for f in found].count(rule) == 3
    assert [found.count(f) for f in found] == [1] * 6
    assert (
        len(
            [
                line
                for line in reported.out.splitlines()
                if line.startswith("warning  axes X, Y, Z: 1740, 2740")
            ]
        )
        == 1
    )
    assert reported.out.endswith(f"{MILL}: 0 errors, 6 warnings, 0 recommendations\n")


def test_one_is_one_and_two_are_several(amp, here: Path) -> None:
    assert re.search(r": 0 errors, 0 warnings, 0 recommendations$", amp("validate", MILL).out.strip())
    amp("set", MILL, "1750=0.5")
    assert re.search(r": 1 error, 1 warning, ", amp("validate", MILL).out), amp("validate", MILL).out


# -- man page


def test_the_man_page_has_every_verb_and_troff_finds_nothing_wrong_in_it() -> None:
    page = man_page()
    for verb in VERBS:
        assert f"\n.SS {verb}\n".replace("-", "\\-") in page
    if shutil.which("groff") is None:
        pytest.skip("there is no groff")
    done = subprocess.run(
        ["groff", "-man", "-Tutf8", "-ww"], input=page, capture_output=True, text=True, check=True
    )
    assert (done.stderr, "amp-studio validate MILL_1394.amp" in done.stdout) == ("", True)


# -- completion

LINES = [
    ("amp-studio vali", ["validate"]),
    ("amp-studio validate --js", ["--json"]),
    ("amp-studio new 9", ["9pc"]),
    ("amp-studio simulate MILL_1394.amp st", ["step"]),
    ("amp-studio report MILL_1394.amp --sort nu", ["number"]),
    ("amp-studio get MILL_1394.amp 130", ["1300"]),
    ("amp-studio get MILL_1394.amp home.cal", ["home.calibration"]),
    ("amp-studio set MILL_1394.amp control.ty", ["control.type="]),
    ("amp-studio set MILL_1394.amp 350=La", ["Lathe"]),
    ("amp-studio show 9pc home.cal", ["home.calibration"]),
    ("amp-studio sheet MILL_1394.amp --tick 130", ["1300"]),
    ("amp-studio machine-tests MILL_1394.amp tu", ["tuning"]),
    ("amp-studio migrate MILL_1394.amp --to li", ["linuxcnc"]),
    ("amp-studio form nu", ["num"]),
    ("amp-studio show 9pc servo.ex", ["servo.excess_error"]),
]
"""A line as it is typed, and what bash puts in the place of what comes after its last word break."""


def asked_of_bash(line: str, folder: Path) -> list[str]:
    """Return what bash completes a line with, by the script that the program prints."""
    script = (
        'source <("$PROGRAM" completion bash); COMP_LINE=$1; COMP_POINT=${#1}; COMP_WORDS=("$PROGRAM" x);'
        " COMP_CWORD=1;compopt() { :; }; _amp_studio; printf '%s\\n' \"${COMPREPLY[@]}\""
    )
    return shell(["bash", "--norc", "-c", script, "bash", line], folder).split()


def shell(command: list[str], folder: Path) -> str:
    """Run a shell that finds the program by its name."""
    program = folder / "bin" / "amp-studio"
    program.parent.mkdir(exist_ok=True)
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m amp_studio.cli "$@"\n')
    program.chmod(0o755)
    checkout = str(Path(__file__).parents[2])
    env = {
        **os.environ,
        "PROGRAM": str(program),
        "PATH": f"{program.parent}:{os.environ['PATH']}",
        "PYTHONPATH": checkout,
    }
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, env=env, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")
@pytest.mark.parametrize(("line", "expected"), LINES)
def test_bash_completes(line: str, expected: list[str], here: Path) -> None:
    assert asked_of_bash(line, here) == expected


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")
def test_bash_completes_a_program_that_is_named_by_its_place_at_home(here: Path) -> None:
    script = (
        'source <("$PROGRAM" completion bash); HOME=$PWD; COMP_LINE="~/bin/amp-studio vali";'
        ' COMP_POINT=${#COMP_LINE}; COMP_WORDS=("~/bin/amp-studio" vali); COMP_CWORD=1;'
        " compopt() { :; }; _amp_studio; printf '%s\\n' \"${COMPREPLY[@]}\""
    )
    assert shell(["bash", "--norc", "-c", script], here).split() == ["validate"]


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")
def test_bash_is_left_to_complete_the_name_of_a_file(here: Path) -> None:
    assert asked_of_bash("amp-studio validate MI", here) == []


@pytest.mark.skipif(shutil.which("fish") is None, reason="there is no fish")
@pytest.mark.parametrize(("line", "expected"), [*LINES[:8], ("amp-studio validate MI", [MILL])])
def test_fish_completes(line: str, expected: list[str], here: Path) -> None:
    script = f"amp-studio completion fish | source; complete -C {shlex.quote(line)}"
    assert shell(["fish", "--no-config", "-c", script], here).split() == expected


@pytest.mark.skipif(shutil.which("zsh") is None, reason="there is no zsh")
@pytest.mark.parametrize(("line", "expected"), LINES[:8])
def test_zsh_completes(line: str, expected: list[str], here: Path) -> None:
    words = shlex.join(line.split())
    script = (
        "compdef() { :; }; compadd() { shift; [[ $1 == '' || $1 == -- ]] && shift; [[ $1 == -- ]] &&"
        f" shift; print -l -- $@; }};source <(amp-studio completion zsh); words=({words}); CURRENT=$#words;"
        " _amp_studio"
    )
    assert shell(["zsh", "-f", "-c", script], here).split() == expected


def test_completion_of_what_cannot_be_read_is_silent(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("broken.amp").write_text("family: [", encoding="utf-8")
    capsys.readouterr()
    for line in (
        "get broken.amp x",
        "get none.amp x",
        "nonsense x",
        "show nowhere 1",
        "set MILL_1394.amp zz=1",
    ):
        cli.run(["__complete", *line.split()])
        reported = capsys.readouterr()
        assert (reported.out, reported.err) == ("", ""), line
