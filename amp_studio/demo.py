"""The whole job on the example machine: open, validate, print, download, verify, upload, compare.

With a display the desktop program opens on the example project, its emulated
control already running; without one the same job runs here in the terminal.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import platformdirs

from amp_studio.files import examples_folder
from amp_studio.ui import has_display

EXAMPLE = "mill-1394"


def run_demo(terminal: bool = False) -> int:
    """Run the demonstration; returns the exit code."""
    if terminal or not has_display():
        return _in_terminal()
    return _in_window()


def _in_window() -> int:
    """Open the studio on a copy of the example that belongs to the user and keeps what he does to it."""
    from amp_studio.ui import main

    own = Path(platformdirs.user_data_dir("amp-studio")) / "examples" / EXAMPLE
    if not own.is_dir():
        shutil.copytree(examples_folder() / EXAMPLE, own)
    return main([str(_file_in(own))], emulate=True)


def _file_in(folder: Path) -> Path:
    return next(iter(sorted(folder.glob("*.amp"))))


def _in_terminal() -> int:
    """Do the main job step by step and print what happens; 0 when nothing differs at the end."""
    from amp_studio.dossier import write_report
    from amp_studio.files import Document, compare, open_file
    from amp_studio.report import counted
    from amp_studio.transfer import Exchange
    from amp_studio.transfer.client import download_file, fetch_file
    from amp_studio.validate import Validator

    begin = time.monotonic()
    folder = Path(tempfile.mkdtemp(prefix="amp-studio-demo-"))
    shutil.copytree(examples_folder() / EXAMPLE, folder, dirs_exist_ok=True)
    path = _file_in(folder)
    file = open_file(path).file
    _print_step(
        1, f"opened {path.name}: {file.schema.family.name}, {file.machine}, {len(file.values)} values"
    )
    findings = Validator(file).run()
    counts = {s: sum(f.severity == s for f in findings) for s in ("error", "warning", "advice")}
    _print_step(2, f"validated: {', '.join(counted(count, severity) for severity, count in counts.items())}")
    report = folder / f"{path.stem}.pdf"
    write_report(file, report, source=path)
    _print_step(3, f"printed {report} ({report.stat().st_size // 1024} KiB)")
    control = _start_control(folder / "control", file.schema.family.family, file.machine)
    try:
        address = _address_of(control)
        _print_step(4, f"emulated control at {address}, in E-stop")
        outcome = download_file(file, address, Exchange(_percent, keep=path))
        _print_step(5, outcome.text)
        fetched = fetch_file(address, Exchange(_percent), family=file.schema.family.family)
        upload = folder / "from-control.amp"
        fetched.header.name = upload.stem
        Document.create(fetched, upload).close()
        _print_step(6, f"uploaded under a new name: {upload}")
    finally:
        _stop(control)
    found = compare(file.schema, file.values, open_file(upload).file.values)
    _print_step(7, f"compared: {len(found.differences)} values differ, {found.same} are the same")
    print(f"Done in {time.monotonic() - begin:.1f} s. Everything is in {folder}")
    program = (
        sys.argv[0] if Path(sys.argv[0]).stem == "amp-studio" else "amp-studio"
    )  # need not be on the path
    print(f"Next: {program} --help, or {program} on a machine with a display.")
    return 0 if outcome.verified and not found.differences and not counts["error"] else 1


def _print_step(step: int, text: str) -> None:
    print(f"{step}. {text}", flush=True)


def _percent(stage: str, done: int, total: int) -> None:
    if sys.stdout.isatty():
        percent = 100 if total == 0 else done * 100 // total
        print(f"\r   {stage} {percent:3d} %", end="\n" if percent == 100 else "", flush=True)


def _start_control(state: Path, family: str, machine: str) -> subprocess.Popen[str]:
    """Return the process of an emulated control, at a port that the system chooses."""
    command = [
        sys.executable,
        "-m",
        "amp_studio.cli",
        "emulate",
        family,
        "--listen",
        "tcp://127.0.0.1:0",
        "--state",
        str(state),
        "--machine",
        machine,
    ]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def _address_of(control: subprocess.Popen[str]) -> str:
    assert control.stdout is not None
    # Which port it is, only this line gives.
    for line in control.stdout:
        if line.startswith("listening on "):
            return line.removeprefix("listening on ").strip()
    raise RuntimeError("the emulated control did not start")


def _stop(control: subprocess.Popen[str]) -> None:
    try:
        control.communicate("quit\n", timeout=5)
    except (OSError, subprocess.TimeoutExpired):
        control.kill()
        control.communicate()
