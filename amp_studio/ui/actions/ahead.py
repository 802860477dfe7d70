"""What the pages of a file are made with, loaded while the window has nothing to do: the first page that is
opened waits for its values alone.
"""

from __future__ import annotations

from PySide6.QtCore import QObject

from amp_studio.ui.base.loading import is_loaded, load, load_beside
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import Task
from amp_studio.ui.window.studio_window import StudioWindow

PIECES = {
    "amp_studio.sim": "path_rules axis.motion scenario tuning.linear scenarios.circle tuning.levels"
    " tuning.solver run path.planner path.limits_met path.planned path.program",
    "amp_studio.programs": "codes block modal coordinates cycles flow single_codes",
    "amp_studio.sim.path": "job result",
    "amp_studio.ui": "forms.form base.plot program.block_list program.page dialogs.file_dialogs",
    "amp_studio.sim.identification": "recording response identify",
    "amp_studio.ui.motion": "check_list scene_view machine_cards results check_page settings tests_page"
    " identify_dialog recorder run saving view tuning_values tuning_page calibration_page",
    "amp_studio.transfer": "links driver house.frame client.exchange",
    "amp_studio.ui.control": "session conditions session_words rows danger_check hand_sheet"
    " history known_list page",
}
"""Room -> its modules, what others need first, so that each takes a few milliseconds."""
WAIT_MS, PAUSE_MS = 2500, 40
"""Milliseconds after a file came to the front until the first is loaded, and from one to the next."""


class LoadedAhead(QObject):
    """Loads one piece at a time in the window's thread: a thread that imports parts of a package while the
    window asks for another part can be given one that is not ready (see ``loading``).
    """

    def __init__(self, window: StudioWindow) -> None:
        super().__init__(window)
        self._left = [f"{room}.{module}" for room, modules in PIECES.items() for module in modules.split()]
        self._timer = single_shot(self, self.step, PAUSE_MS)
        window.tabs.current_changed.connect(lambda _: self._timer.start(WAIT_MS))

    def step(self) -> None:
        """Load the next piece, unless a thread is at work that may load too."""
        if not self._left:
            return
        if not is_loaded("numpy"):  # the largest, of no package here
            load_beside("numpy")
        elif not Task.running:
            load(self._left.pop(0))
        self._timer.start(PAUSE_MS)
