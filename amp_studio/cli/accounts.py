"""What an import or an export brought across, printed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.verb import Options

if TYPE_CHECKING:
    from amp_studio import MachineParameters
    from amp_studio.formats import Account


def print_account(
    options: Options, machine: MachineParameters, account: Account, written: str, named: str = ""
) -> None:
    """Print what went across, and name what did not."""
    from amp_studio.formats import account_json, account_lines

    if options.json:
        print_json(account_json(machine.file, account))
        return
    for line in account_lines(machine.file, account, named):
        print_remark(line)
    print(f"{options.output}: {written}")
