"""Opens the Tuning window on the file in front, and connects it to a control."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from amp_studio.ui.control.exchange import ControlExchange
from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from amp_studio.transfer.client import LiveTuning
    from amp_studio.ui.base.workspace import Workspace


def tune(window: StudioWindow, exchanges: ControlExchange) -> None:
    """Show the pages of the file in front; raises ValueError for a family that has nothing to tune."""
    from amp_studio.calibration import compensation_of
    from amp_studio.ui.motion.tuning_window import TuningWindow

    workspace = window.workspace_in_front
    if window.beside.again(TuningWindow, workspace) is not None:
        return
    offered = compensation_of(workspace.file.schema.family.family)
    if not offered.pages and not offered.reversal:
        raise ValueError(
            f"The manual of {workspace.file.schema.family.name} names nothing that is tuned on line."
        )
    made = TuningWindow(workspace, partial(_connect, workspace, exchanges), window)
    window.beside.show(made, workspace)


def _connect(workspace: Workspace, exchanges: ControlExchange) -> LiveTuning | None:
    address = exchanges.chosen_address()
    if address is None:
        return None
    from amp_studio.transfer.client import LiveTuning, open_driver

    path = workspace.path
    driver = open_driver(address, workspace.file.schema.family.family)
    return LiveTuning(driver, path, address=address, record=path)
