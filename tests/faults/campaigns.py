"""The fault campaigns: each does a thing many times under faults that a seed chooses,
and names every violation.

``make faults`` runs them whole and prints one table; the tests run a short part of each.
"""

import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import fix_campaign

from amp_studio import cli
from amp_studio.files import new_file
from amp_studio.transfer.image import encode_image
from tests.cli.stopped import set_while_stopped
from tests.cli.stopped_exchanges import control_while_stopped, download_while_stopped
from tests.transfer import image_mutations
from tests.transfer.hostile_clients import clients_beside_hostile_ones
from tests.transfer.hostile_controls import exchange_with_hostile_control
from tests.ui.killed import kill_editor

from . import (
    answers,
    descriptions,
    editor,
    exchanges,
    folders,
    grbl_lines,
    measured_points,
    monkey,
    own_contents,
    own_protocols,
    part_programs,
    persons,
    planted,
    racks,
    records,
    saves,
    sheets,
    stored,
    texts,
    wire,
)
from .command_lines import fuzz_command_lines
from .lines import download_over_bad_lines
from .verbs import VERBS, fail_calls

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"


@dataclass(frozen=True)
class Campaign:
    """One kind of fault.

    ``run`` gets a seed, how many runs it is to make, and an empty folder; it returns one sentence a
    violation.
    ``whole`` and ``short`` are the runs of ``make faults`` and of the tests (0: it has no part that takes
    seconds, or tests/cli, tests/transfer and tests/ui have it), ``at_once`` those made with one seed.
    """

    name: str
    run: Callable[[int, int, Path], list[str]]
    whole: int
    short: int
    at_once: int


def _stopped(seed: int, runs: int, folder: Path) -> list[str]:
    path = folder / "mill.amp"
    cli.run(["new", "9pc", str(path), "--machine", "mill"])
    return set_while_stopped(path, seed=seed, rounds=runs)


def _killed(seed: int, runs: int, folder: Path) -> list[str]:
    path = folder / "mill.amp"
    shutil.copy(EXAMPLE, path)
    return [fault for n in range(runs) for fault in kill_editor(path, seed=seed * 1_000 + n)]


def _images(seed: int, runs: int, folder: Path) -> list[str]:
    file = new_file("9pc", "mill", ["X"])
    for address in list(file.values)[60:]:
        del file.values[address]
    file.evaluation.forget()
    damaged = image_mutations.mutants(encode_image(file), seed, runs)
    return texts.violations(damaged, image_mutations.fault_of, ())


def _damaged(fuzz: Callable[[int, int], list[str]], seed: int, runs: int, folder: Path) -> list[str]:
    return fuzz(seed, runs)


def _damaged_in(fuzz: Callable[[Path, int, int], list[str]], seed: int, runs: int, folder: Path) -> list[str]:
    return fuzz(folder, seed, runs)


def _clicked(seed: int, runs: int, folder: Path) -> list[str]:
    """Click and type in the window of one family for as many seconds as there are runs;
    a seed after another goes through the families.
    """
    family = monkey.RUNS[seed % len(monkey.RUNS)]
    log = folder / f"{family}.jsonl"
    command = [sys.executable, "-m", "tests.faults.monkey", family, str(seed), str(runs), str(log)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, errors="replace")
    if done.returncode == 0:
        return []
    kept = Path(tempfile.gettempdir()) / f"amp-studio-monkey-{family}-{seed}.jsonl"
    shutil.copy(log, kept)
    return [
        (
            f"{family}: {done.stdout}{done.stderr[-2000:]}done again by:"
            f" python -m tests.faults.monkey {family} --replay {kept}"
        )
    ]


def _stopped_downloads(seed: int, runs: int, folder: Path) -> list[str]:
    path = folder / "mill.amp"
    shutil.copy(EXAMPLE, path)
    return download_while_stopped(path, folder, seed=seed, rounds=runs)


def _stopped_controls(seed: int, runs: int, folder: Path) -> list[str]:
    return control_while_stopped(folder, seed=seed, rounds=runs)


def _fixes(seed: int, runs: int, folder: Path) -> list[str]:
    return fix_campaign.campaign(seed * 10_000, runs)[1]


def _own(run: own_protocols.Run) -> Callable[[int, int, Path], list[str]]:
    return partial(own_protocols.repeated, run)


def _hostile(exchange: Callable[[int, Path], list[str]], seed: int, runs: int, folder: Path) -> list[str]:
    found = []
    for n in range(runs):
        place = folder / str(n)
        place.mkdir()
        found += exchange(seed * 1_000 + n, place)
        shutil.rmtree(place)
    return found


MANY = 100_000

CAMPAIGNS = (
    Campaign("a call of the system that fails, in every verb", fail_calls, len(VERBS), 1, len(VERBS)),
    Campaign(
        "a call of the system that fails, in every exchange",
        exchanges.fail_calls_of_exchanges,
        len(exchanges.VERBS),
        0,
        1,
    ),
    Campaign("power off after a verb has written", saves.power_off_after_saves, len(VERBS), 1, 2),
    Campaign(
        "defects planted for the checks above",
        planted.unnoticed,
        3 * len(planted.DEFECTS),
        planted.SHORT_RUNS,
        3 * len(planted.DEFECTS),
    ),
    Campaign("Ctrl-C at any moment of a change", _stopped, 400, 2, 20),
    Campaign("kill -9 of the editor", _killed, 60, 0, 5),
    Campaign("Ctrl-C and SIGTERM at any moment of a download", _stopped_downloads, 100, 0, 5),
    Campaign("Ctrl-C at any moment of an emulated control", _stopped_controls, 100, 0, 10),
    Campaign("download over a bad line, TCP, TLS and pty", download_over_bad_lines, 300, 1, 10),
    Campaign(
        "NUM table over a bad line, power off in the load", _own(own_protocols.table_run), 2_000, 3, 100
    ),
    Campaign(
        "ACR terminal over a bad line, power off in the save", _own(own_protocols.terminal_run), 2_000, 3, 100
    ),
    Campaign("57C422B registers over a bad line", _own(own_protocols.registers_run), 2_000, 1, 100),
    Campaign(
        "house protocol over a bad line, power off in the commit",
        _own(own_protocols.house_run),
        2_000,
        4,
        100,
    ),
    Campaign("configuration of a LinuxCNC onto a disk that fails", _own(folders.folder_run), 2_000, 6, 100),
    Campaign(
        "damaged contents and racks of the 57C422B", partial(_damaged_in, racks.fuzz_racks), MANY, 18, 2_000
    ),
    Campaign(
        "grblHAL settings over a bad line, power off in the save",
        grbl_lines.settings_under_faults,
        2_000,
        1,
        100,
    ),
    Campaign("hostile control", partial(_hostile, exchange_with_hostile_control), 1_000, 0, 50),
    Campaign("hostile clients", partial(_hostile, clients_beside_hostile_ones), 500, 0, 50),
    Campaign("damaged YAML", partial(_damaged, texts.fuzz_yaml), MANY, 70, 5_000),
    Campaign("damaged parameter file", partial(_damaged, texts.fuzz_parameter_files), MANY, 21, 2_000),
    Campaign(
        "damaged descriptions of a control", partial(_damaged, descriptions.fuzz_descriptions), MANY, 3, 2_000
    ),
    Campaign("damaged project.yaml", partial(_damaged_in, texts.fuzz_projects), MANY, 10, 2_000),
    Campaign("damaged rules.yaml", partial(_damaged_in, texts.fuzz_rules), MANY, 35, 5_000),
    Campaign("damaged record of exchanges", partial(_damaged_in, texts.fuzz_records), MANY, 10, 2_000),
    Campaign("damaged journal and history", partial(_damaged_in, texts.fuzz_journals), MANY, 10, 2_000),
    Campaign("damaged texts of controls", partial(_damaged_in, texts.fuzz_imports), MANY, 10, 2_000),
    Campaign("odd values", partial(_damaged, texts.fuzz_entries), MANY, 28, 5_000),
    Campaign("damaged control image", _images, MANY, 35, 5_000),
    Campaign(
        "damaged contents of NUM, ACR and LinuxCNC",
        partial(_damaged, own_contents.fuzz_contents),
        MANY,
        35,
        5_000,
    ),
    Campaign("damaged reports", partial(_damaged, own_contents.fuzz_reports), MANY, 35, 5_000),
    Campaign("damaged pins of LinuxCNC", partial(_damaged, own_contents.fuzz_pins), MANY, 35, 5_000),
    Campaign(
        "damaged unloads of a NUM control", partial(_damaged, own_contents.fuzz_unloads), MANY, 70, 5_000
    ),
    Campaign(
        "odd keys and bytes at emulated NUM and ACR controls",
        partial(_damaged_in, own_contents.fuzz_devices),
        MANY,
        18,
        2_000,
    ),
    Campaign("damaged copies of Grbl settings", partial(_damaged, grbl_lines.fuzz_contents), 20_000, 10, 300),
    Campaign(
        "damaged answers of a Grbl control", partial(_damaged, grbl_lines.fuzz_answers), 20_000, 10, 300
    ),
    Campaign(
        "odd bytes at an emulated Grbl control",
        partial(_damaged_in, grbl_lines.fuzz_devices),
        MANY,
        35,
        5_000,
    ),
    Campaign("damaged frames", partial(_damaged, wire.fuzz_frames), MANY, 175, 5_000),
    Campaign("damaged messages", partial(_damaged, wire.fuzz_messages), MANY, 350, 5_000),
    Campaign("damaged telnet", partial(_damaged, wire.fuzz_telnet), MANY, 35, 5_000),
    Campaign("hostile ends of a password", partial(_damaged, wire.fuzz_passwords), MANY, 35, 2_000),
    Campaign("hostile ends of plain files", partial(_damaged, wire.fuzz_plain_files), MANY, 10, 1_000),
    Campaign("damaged addresses of controls", partial(_damaged, persons.fuzz_endpoints), MANY, 175, 5_000),
    Campaign("damaged digests", partial(_damaged, persons.fuzz_digests), MANY, 175, 5_000),
    Campaign("damaged practice faults", partial(_damaged, persons.fuzz_practice_faults), MANY, 105, 5_000),
    Campaign("odd names of parameters", partial(_damaged, persons.fuzz_names), MANY, 7, 5_000),
    Campaign("odd arguments of formulas", partial(_damaged, persons.fuzz_formulas), MANY, 175, 5_000),
    Campaign("damaged expressions", partial(_damaged, persons.fuzz_expressions), MANY, 105, 5_000),
    Campaign(
        "damaged expressions in rules",
        partial(_damaged_in, persons.fuzz_builders_expressions),
        MANY,
        18,
        5_000,
    ),
    Campaign(
        "odd commands at an emulated control", partial(_damaged_in, persons.fuzz_commands), MANY, 70, 5_000
    ),
    Campaign(
        "odd commands at the screen of a 9/PC", partial(_damaged_in, persons.fuzz_panel), MANY, 4, 1_000
    ),
    Campaign("command lines to be completed", partial(_damaged_in, persons.fuzz_completion), MANY, 7, 5_000),
    Campaign("odd command lines", partial(_damaged_in, fuzz_command_lines), MANY, 7, 2_000),
    Campaign("damaged suppressions", partial(_damaged_in, stored.fuzz_suppressions), MANY, 18, 5_000),
    Campaign(
        "damaged memory of an emulated control", partial(_damaged_in, stored.fuzz_memories), MANY, 35, 5_000
    ),
    Campaign("damaged copies of a control", partial(_damaged_in, stored.fuzz_copies), MANY, 18, 5_000),
    Campaign("damaged lists of a control's screen", partial(_damaged, sheets.fuzz_screens), MANY, 35, 5_000),
    Campaign("damaged answers of a migration", partial(_damaged_in, answers.fuzz_answers), MANY, 35, 5_000),
    Campaign("damaged points of a laser", partial(_damaged, measured_points.fuzz_points), MANY, 52, 5_000),
    Campaign("damaged part programs", partial(_damaged, part_programs.fuzz_programs), MANY, 7, 5_000),
    Campaign("damaged records of a drive", partial(_damaged, records.fuzz_records), MANY, 105, 5_000),
    Campaign("damaged frequency responses", partial(_damaged, records.fuzz_responses), MANY, 105, 5_000),
    Campaign("damaged tunings and recordings", partial(_damaged_in, records.fuzz_tunings), MANY, 70, 5_000),
    Campaign("damaged parts of a sweep", partial(_damaged_in, records.fuzz_sweep_parts), MANY, 70, 3_000),
    Campaign("damaged machines of an axis", partial(_damaged_in, records.fuzz_machines), MANY, 4, 2_000),
    Campaign("damaged ticks of a sheet", partial(_damaged_in, sheets.fuzz_ticks), MANY, 35, 5_000),
    Campaign("pasted blocks of cells", partial(_damaged, editor.fuzz_blocks), MANY, 70, 5_000),
    Campaign("odd expressions in cells", partial(_damaged, editor.fuzz_cell_expressions), MANY, 70, 5_000),
    Campaign("hostile templates of a project", partial(_damaged_in, editor.fuzz_templates), 20_000, 10, 300),
    Campaign("damaged backups", partial(_damaged_in, stored.fuzz_backups), MANY, 18, 5_000),
    Campaign("damaged results of checks", partial(_damaged_in, stored.fuzz_check_caches), 20_000, 10, 2_000),
    Campaign("damaged cache", partial(_damaged_in, stored.fuzz_caches), MANY, 70, 5_000),
    Campaign("damaged lock notes", partial(_damaged_in, stored.fuzz_locks), MANY, 105, 5_000),
    Campaign(
        "damaged notes of begun downloads",
        partial(_damaged_in, stored.fuzz_begun_downloads),
        MANY,
        105,
        5_000,
    ),
    Campaign("damaged facts", partial(_damaged_in, stored.fuzz_facts), MANY, 18, 5_000),
    Campaign("damaged settings", partial(_damaged_in, stored.fuzz_settings), MANY, 35, 5_000),
    Campaign("every offered fix, machines of random values", _fixes, 1_000, 1, 50),
    Campaign("clicks and keys at random, seconds", _clicked, 600 * len(monkey.RUNS), 0, 600),
)
