"""How a download or a restore begins and ends at the command line: the errors of the file, and the result."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.cli.console import print_remark, progress
from amp_studio.cli.exit_codes import AT_CONTROL, CHANGED, FAULT
from amp_studio.cli.screen import end_results, flush_results
from amp_studio.cli.verb import Options

if TYPE_CHECKING:
    from amp_studio import MachineParameters
    from amp_studio.transfer import Exchange, Stop
    from amp_studio.transfer.client import Outcome


def exchange_of(options: Options, path: Path, stop: Stop) -> Exchange:
    """Return the exchange of a verb that replaces what a control contains."""
    from amp_studio.transfer import Exchange

    keep = options.keep / path.name if options.keep else path
    return Exchange(progress(), stop, keep, record=path, notify=print_remark)


def print_errors(machine: MachineParameters) -> str:
    """List the errors of a machine, by the rules beside it too; returns how many there are, "" for none."""
    from amp_studio.report import alike, counted, same_finding_text

    findings = machine.validator().run()
    errors = [finding for finding in findings if finding.severity == "error"]
    for same in alike(errors):
        print_remark(same_finding_text(machine.file, same))
    return counted(len(errors), "error") if errors else ""


def way_to_know(at_control: str) -> str:
    """Return by which verb a user finds out what the control contains, if it is not known."""
    return " (amp-studio verify FILE --with ADDRESS)" if at_control == "unknown" else ""


def print_outcome(outcome: Outcome) -> int:
    """Print how an exchange ended and return the exit code; where it cannot be printed,
    that is no full success.

    A reader that has gone wanted no more: the exchange is as complete as it was.
    """
    code = 0 if outcome.verified else AT_CONTROL[outcome.at_control]
    try:  # a terminal takes each line at once, and may be gone
        print(outcome.text + way_to_know(outcome.at_control))
        if outcome.verified:
            print(f"sha256 {outcome.sha256}")
        flush_results()
    except BrokenPipeError:
        end_results()
        print_remark(f"amp-studio: nobody reads the results any more; {outcome.text}")
    except (OSError, ValueError):
        end_results()
        print_remark(f"amp-studio: the result cannot be printed; {outcome.text}")
        code = max(code, CHANGED if outcome.written else FAULT)
    return code
