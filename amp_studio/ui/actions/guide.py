"""What the guide menu does: the next value that is not set, steps ticked as done, the check list."""

from __future__ import annotations

from functools import partial

from amp_studio.files import now, user
from amp_studio.guide import SetupStep, next_open, step_of, tick
from amp_studio.schema import Address
from amp_studio.ui.base.translated import tr, worded
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.window.studio_window import StudioWindow


def connect_page(window: StudioWindow, page: FilePage) -> None:
    """Follow the buttons of a page."""
    page.left.next_requested.connect(lambda: window.guarded(partial(go_to_next, window)))
    page.left.tick_requested.connect(lambda step: window.guarded(lambda: tick_step(window, step)))
    page.left.defaults_requested.connect(lambda step: window.guarded(lambda: keep_defaults(window, step)))
    page.left.print_requested.connect(lambda: window.guarded(partial(save_check_list, window)))


def go_to_next(window: StudioWindow) -> None:
    """Put the cursor on the next value that is not set, and show what has been passed."""
    page = window.page_in_front
    workspace = page.workspace
    here = page.table_view.address()
    found = next_open(workspace.progress, here)
    if found is None:
        window.show_status(tr("Every active value is set."))
        return
    page.left.show_side("steps")
    page.left.steps.choose_step(step_of(workspace.file.schema)[found[0]])
    page.go_to(found)
    window.show_panel("Parameter")  # with its help and what calculates it
    page.table_view.setFocus()
    _show_passed(window, page, here, found)


def _show_passed(window: StudioWindow, page: FilePage, here: Address | None, address: Address) -> None:
    """Name the steps between two values in which nothing is open but the user has not been either."""
    steps = step_of(page.workspace.file.schema)
    first = steps[here[0]].number if here else 0
    family = page.workspace.file.schema.family.family
    passed = [
        worded(each.step.title, family)
        for each in page.workspace.progress.steps[first : steps[address[0]].number - 1]
        if each.state == "not begun"
    ]
    if passed:
        text = tr("All at their defaults, check them too: {steps}")
        window.show_status(text.format(steps=", ".join(passed)))


def _step(window: StudioWindow) -> SetupStep:
    """Return the step of the selected value; without one that of the first open value."""
    page = window.page_in_front
    address = page.table_view.address()
    if address is not None:
        return step_of(page.workspace.file.schema)[address[0]]
    now_at = page.workspace.progress
    return (now_at.current or now_at.steps[0]).step


def tick_step(window: StudioWindow, step: SetupStep | None = None) -> None:
    """Tick a step as done, that of the selected value by default, or take the tick away;
    it is saved with the file.
    """
    workspace, step = window.page_in_front.workspace, step or _step(window)
    is_ticked = bool(workspace.progress.of(step).ticked)
    by = None if is_ticked else tr("{now} by {user}").format(now=now(), user=user())
    text = tr("Step {number} not done") if is_ticked else tr("Step {number} done")
    workspace.do(text.format(number=step.number), lambda: tick(workspace.file, step, by))
    each = workspace.progress.of(step)
    if each.ticked and each.state != "done":
        left = tr("{title} is ticked. Left: {open} values not set, {errors} errors.")
        window.show_status(
            left.format(
                title=worded(step.title, workspace.file.schema.family.family),
                open=len(each.open),
                errors=each.count("error"),
            )
        )


def keep_defaults(window: StudioWindow, step: SetupStep | None = None) -> None:
    """Set what is not set in a step, that of the selected value by default, to the printed defaults,
    as one step to undo.
    """
    workspace, step = window.page_in_front.workspace, step or _step(window)
    wanted = {a: workspace.file.default(a) for a in workspace.progress.of(step).open}
    known = {a: value for a, value in wanted.items() if value is not None}
    if not known:
        raise ValueError(tr("The manual prints no default for any open value of this step."))
    workspace.edit(tr("Keep defaults"), known)


def show_later(window: StudioWindow) -> None:
    """List the findings of steps that have not been reached too, or leave them out."""
    workspace = window.page_in_front.workspace
    workspace.show_later(not workspace.shows_later)


def save_check_list(window: StudioWindow) -> None:
    """Ask where to, and write the check list."""
    from amp_studio.ui.dialogs.check_list_dialog import write_check_list_of

    write_check_list_of(window, window.page_in_front.workspace)
