"""The guide menu: the next value that is not set, steps ticked as done, the check list."""

from __future__ import annotations

from amp_studio.files import now, user
from amp_studio.guide import SetupStep, next_open, step_of, tick
from amp_studio.schema import Address
from amp_studio.ui.base.translated import Translated, tr, worded
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.window.studio_window import StudioWindow


class GuideActions(Translated):
    """Leads through commissioning."""

    def __init__(self, window: StudioWindow) -> None:
        self.window = window
        act = window.action
        self.next = act(tr("&Next Not Set"), self.go_on, "Ctrl+.")
        self.done = act(tr("Mark Step as &Done"), self.mark, "Ctrl+Shift+.", "edit")
        self.keep = act(tr("Keep De&faults of This Step"), self.keep_defaults, None, "edit")
        self.later = act(tr("&Show Later Findings"), self.show_later)
        self.check_list = act(tr("&Check List…"), self.save_check_list)
        self.later.setCheckable(True)
        menu = window.menuBar().addMenu(tr("&Guide"))
        menu.addActions([self.next, self.done, self.keep])
        menu.addSeparator()
        menu.addActions([self.later, self.check_list])

    def connect_page(self, page: FilePage) -> None:
        """Follow the buttons of a page."""
        page.left.steps.next_wanted.connect(lambda: self.window.guarded(self.go_on))
        page.left.steps.mark_wanted.connect(lambda step: self.window.guarded(lambda: self.mark(step)))
        page.left.steps.defaults_wanted.connect(
            lambda step: self.window.guarded(lambda: self.keep_defaults(step))
        )
        page.left.steps.print_wanted.connect(lambda: self.window.guarded(self.save_check_list))

    def _page(self) -> FilePage:
        page = self.window.page
        assert page is not None
        return page

    def go_on(self) -> None:
        """Put the cursor on the next value that is not set, and show what has been passed."""
        page = self._page()
        workspace = page.workspace
        here = page.table_view.address()
        found = next_open(workspace.progress, here)
        if found is None:
            self.window.show_status(tr("Every active value is set."))
            return
        page.left.show_side("steps")
        page.left.steps.choose_step(step_of(workspace.file.schema)[found[0]])
        page.go_to(found)
        self.window.show_panel("Parameter")  # with its help and what calculates it
        page.table_view.setFocus()
        self._show_passed(page, here, found)

    def _show_passed(self, page: FilePage, here: Address | None, found: Address) -> None:
        """Name the steps between two values in which nothing is open but nobody has been either."""
        steps = step_of(page.workspace.file.schema)
        first = steps[here[0]].number if here else 0
        passed = [
            worded(each.step.title)
            for each in page.workspace.progress.steps[first : steps[found[0]].number - 1]
            if each.state == "not begun"
        ]
        if passed:
            text = tr("All at their defaults, check them too: {steps}")
            self.window.show_status(text.format(steps=", ".join(passed)))

    def _step(self) -> SetupStep:
        """Return the step of the selected value; without one that of the first open value."""
        page = self._page()
        address = page.table_view.address()
        if address is not None:
            return step_of(page.workspace.file.schema)[address[0]]
        now_at = page.workspace.progress
        return (now_at.current or now_at.steps[0]).step

    def mark(self, step: SetupStep | None = None) -> None:
        """Tick a step as done, that of the selected value by default, or take the tick away; it is saved with the file."""
        workspace, step = self._page().workspace, step or self._step()
        is_ticked = bool(workspace.progress.of(step).ticked)
        by = None if is_ticked else self.tr("{now} by {user}").format(now=now(), user=user())
        text = tr("Step {number} not done") if is_ticked else tr("Step {number} done")
        workspace.do(text.format(number=step.number), lambda: tick(workspace.file, step, by))
        each = workspace.progress.of(step)
        if each.ticked and each.state != "done":
            left = tr("{title} is ticked. Left: {open} values not set, {errors} errors.")
            self.window.show_status(
                left.format(title=worded(step.title), open=len(each.open), errors=each.count("error"))
            )

    def keep_defaults(self, step: SetupStep | None = None) -> None:
        """Set what is not set in a step, that of the selected value by default, to the printed defaults, as one step to undo."""
        workspace, step = self._page().workspace, step or self._step()
        wanted = {a: workspace.file.default(a) for a in workspace.progress.of(step).open}
        known = {a: value for a, value in wanted.items() if value is not None}
        if not known:
            raise ValueError(tr("The manual prints no default for any open value of this step."))
        workspace.edit(tr("Keep defaults"), known)

    def show_later(self) -> None:
        """List the findings of steps that have not been reached too, or leave them out."""
        workspace = self._page().workspace
        workspace.show_later(not workspace.shows_later)

    def save_check_list(self) -> None:
        """Ask where to, and write the check list."""
        from amp_studio.ui.dialogs.check_list_dialog import write_check_list_of

        write_check_list_of(self.window, self._page().workspace)

    def show_state(self) -> None:
        """Check what is on in the file in front."""
        page = self.window.page
        self.later.setChecked(page is not None and page.workspace.shows_later)
