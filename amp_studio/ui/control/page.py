"""At the control: one page that connects, compares, sends, reads, restores and proves.
Nothing of it asks in a box.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeySequence, QShortcut

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value
from amp_studio.ui.base.theme import scheme
from amp_studio.ui.base.translated import message_in_words, worded
from amp_studio.ui.base.workspace import Workspace

from .conditions import conditions_of
from .next_step import BarAnswer, ExchangeDirection, PageState, bar_message, primary_button
from .page_parts import ControlPageParts
from .session import ControlSession, SentChanges
from .session_words import ControlBackup, text_of_cancel, text_of_content, text_of_proof, text_of_reading
from .value_ends import counts_in_words

if TYPE_CHECKING:
    from amp_studio.transfer.client import ImageComparison

DIRECTIONS: dict[str, ExchangeDirection] = {"send": "send", "read": "read", "hand": "hand"}
"""What the directions are called at the switch; any other name is comparing."""
ASK_MS = 2000
"""Milliseconds after which a control that must be in E-stop is asked again."""


class ControlPage(ControlPageParts):
    """The exchanges of the file in front. What is chosen here stays while the page is left."""

    left = Signal()
    """The page was left: the values are to be shown again."""
    chosen = Signal(str)
    """Another control was chosen, by its address."""
    state_changed = Signal()
    read_requested = Signal(object)
    """The content of the control is to become a new file."""
    restore_requested = Signal(Path)
    """A backup is to be put back."""

    def __init__(self, save: Callable[[], bool]) -> None:
        super().__init__(save)
        self._save = save
        self.workspace: Workspace | None = None
        self.session: ControlSession | None = None
        self.backup: ControlBackup | None = None
        """The backup that is to be restored, in the place of the file."""
        self.direction: ExchangeDirection = "compare"
        self.name = ""
        self._accepted_errors = False
        self._needs_sheet = False
        """Whether the control is being read to make the sheet of values against it."""
        self._connect()
        self._asking = QTimer(self)
        self._asking.setInterval(ASK_MS)
        self._asking.timeout.connect(self._ask_again)
        self.hide()

    def _connect(self) -> None:
        self.known.chosen.connect(self.chosen)
        self.known.several_chosen.connect(self.show_several)
        self.several.changed.connect(self.state_changed)
        self.history.restore_requested.connect(self.restore_requested)
        self.directions.chosen.connect(self.turn)
        self.password.returnPressed.connect(self._enter_password)
        self.filter.textChanged.connect(self.table.show_only)
        self.table.sides_changed.connect(self.refresh)
        self.table.currentItemChanged.connect(lambda *_: self._show_row())
        self.steps.chosen.connect(self.table.select)
        self.row.asked.connect(self.refresh)
        self.checked.toggled.connect(self.refresh)
        self.cancel.clicked.connect(self._cancel)
        self.proof.clicked.connect(self._save_proof)
        self.again.clicked.connect(self.connect_again)
        self.as_new.clicked.connect(self._save_as_new)
        self.primary.clicked.connect(self._act)
        self.back.clicked.connect(self.left)
        self.past.clicked.connect(self.show_history)
        scheme().changed.connect(self.refresh)
        for keys, act in (
            ("Esc", self._escape),
            ("Alt+Down", lambda: self.table.select_danger(1)),
            ("Alt+Up", lambda: self.table.select_danger(-1)),
        ):
            shortcut = QShortcut(QKeySequence(keys), self)
            shortcut.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
            shortcut.activated.connect(act)

    # -- what is shown -------------------------------------------------------------

    def show_file(
        self, workspace: Workspace | None, direction: ExchangeDirection, only: Iterable[Address] | None = None
    ) -> None:
        """Show the exchanges of a file in a direction; without one a control is read into a new file."""
        if workspace is not self.workspace:
            self.workspace, self.backup = workspace, None
            self._accepted_errors = False
            self.table.show_nothing()
        self.table.begin_with(only)
        self.turn(direction)

    def turn(self, direction: str) -> None:
        """Change the direction; what was read stays."""
        wanted = DIRECTIONS.get(direction, "compare")
        # Without a file there is nothing to send or to compare with.
        self.direction = wanted if self.workspace is not None or self.backup is not None else "read"
        # A backup can only be put back.
        self.backup = self.backup if self.direction == "send" else None
        if self.direction in ("read", "hand") or self.workspace is None:
            self.known.several.setChecked(False)
        self.past.setChecked(False)
        self.directions.show_choice(self.direction)
        self._show_state()
        self._fill()

    def _show_state(self) -> None:
        """Bring to the front what fits the direction: one control, several, the sheet or what was
        recorded.
        """
        workspace = self.workspace
        if self.past.isChecked() and workspace is not None:
            self.history.show_file(workspace)
            self.states.setCurrentWidget(self.history)
        elif self.known.several.isChecked():
            self.several.show_file(workspace, sends=self.direction == "send")
            self.states.setCurrentWidget(self.several)
        elif self.direction == "hand" and workspace is not None:
            self.hand.show_file(workspace)
            self.states.setCurrentWidget(self.hand)
            seen = self.session.seen if self.session is not None and self.session.phase == "ready" else None
            # A sheet against a file stays: it was asked for, and its ticks go with it.
            is_of_control = self.hand.sheet is None or self.hand.seen is not None
            if seen is not None and is_of_control and self.hand.seen is not seen:
                self.hand.control_requested.emit()
        else:
            self.states.setCurrentWidget(self.one_control)

    def show_several(self, wanted: bool) -> None:
        """Show several controls at once, or the chosen one again."""
        self.known.several.setChecked(wanted and self.workspace is not None)
        self.turn(self.direction if self.direction in ("send", "compare") else "compare")

    def show_history(self, wanted: bool) -> None:
        """Show what was exchanged before, or the control again."""
        self.past.setChecked(wanted)
        self._show_state()

    def use(self, session: ControlSession, name: str) -> None:
        """Take another control, which is read at once."""
        self.known.several.setChecked(False)
        self._show_state()
        if self.session is not session:
            self.table.show_nothing()  # its rows and the sides chosen there are of another control
        if self.session is not None:
            # The one before may still be at work: its end must not be shown as that of the new one.
            self.session.changed.disconnect(self._follow)
            self.session.progressed.disconnect(self._follow_progress)
        self.session, self.name = session, name
        session.changed.connect(self._follow)
        session.progressed.connect(self._follow_progress)
        if session.phase == "away" and not session.is_busy:
            session.read()
        session.go_on()  # what was proven there was read before the page was left
        self._fill()

    def show_backup(self, backup: ControlBackup) -> None:
        """Offer to put back a backup, in the place of the file."""
        self.backup = backup
        self.direction = "send"
        self.known.several.setChecked(False)
        self.past.setChecked(False)
        self.directions.show_choice("send")
        self._show_state()
        if self.session is not None and self.session.phase in ("done", "failed"):
            self.connect_again()  # what it contains now is what would be replaced
        self._fill()

    def rename(self, name: str) -> None:
        """Take the name by which the control is known now."""
        if name != self.name:
            self.name = name
            self.table.show_sides(name.partition(" (")[0], self.title)
            self.refresh()

    @property
    def file(self) -> ParameterFile | None:
        """The side that is not the control: the file in front, or the backup that is to be restored."""
        if self.backup is not None:
            return self.backup.copy.file
        return self.workspace.file if self.workspace is not None else None

    def _state(self) -> PageState:
        """Return what is chosen now, and how far the exchange is."""
        return PageState(
            self.direction,
            self.workspace,
            self.backup,
            self.session,
            self.file,
            to_send=len(self.table.rows_taking(file=True)),
            kept=len(self.table.kept()),
            has_rows=bool(self.table.rows),
            has_dangers=self.direction == "send" and bool(self.table.dangers()),
            is_checked=self.checked.isChecked(),
            accepted_errors=self._accepted_errors,
            asks_one=self.row.question,
        )

    @property
    def title(self) -> str:
        """The name of that side."""
        if self.backup is not None:
            return self.backup.path.name
        return self.workspace.path.name if self.workspace is not None else self.tr("a new file")

    def read_for_sheet(self) -> None:
        """Read the control, and make the sheet of values against it."""
        self._needs_sheet = True
        self.hand.bar.say(self.tr("Reading what {name} contains …").format(name=self.name))
        self.connect_again()

    def _sheet_after_reading(self, session: ControlSession) -> None:
        self._needs_sheet = False
        if session.phase == "ready":
            self.hand.control_requested.emit()
        elif session.lacks_password:
            self.turn("compare")  # which has the field for it
        else:
            again = (self.tr("Try Again"), self.read_for_sheet)
            self.hand.bar.say(message_in_words(session.error), "warning", again)

    def _follow(self) -> None:
        session = self.session
        assert session is not None
        if self._needs_sheet and not session.is_busy:
            self._sheet_after_reading(session)
        # Asked before the parts follow the new state: then the button is gone, and with it the keyboard.
        was_running = not self.cancel.isHidden()
        if session.phase in ("ready", "done") and not session.is_busy:
            self._fill()
        else:
            self.refresh()
        if not session.is_busy and self.isVisible():
            self.take_keyboard(session, is_lost=was_running)
        # Pressed at the machine, E-stop is seen here without a click.
        needs = session.phase == "ready" and session.in_estop is False and self.direction == "send"
        self._asking.start() if needs and self.isVisible() else self._asking.stop()
        self.state_changed.emit()

    def _follow_progress(self, stage: str, done: int, total: int) -> None:
        self.show_progress(stage, done, total)
        self.cancel.setText(text_of_cancel(self.session))  # what it leaves is another thing after the commit
        self._show_bar(self._state())  # what is to be done at the control

    def _ask_again(self) -> None:
        if self.session is not None:
            self.session.ask()

    def _fill(self) -> None:
        """List the differences again."""
        file, session = self.file, self.session
        found = (
            session.comparison(file)
            if session is not None and file is not None and session.seen is not None
            else None
        )
        secrets = self.workspace.secrets if self.workspace is not None else False
        if found is not None and file is not None:
            to_control = self.direction != "read"
            self.table.show_differences(
                file,
                found.values.differences,
                to_control=to_control,
                secrets=secrets,
                returns=session.backup_return() if session is not None and self.backup is not None else None,
            )
        self.table.show_sides(self.name.partition(" (")[0], self.title)
        self._show_all(found)

    # -- everything follows the state ------------------------------------------------

    def refresh(self, *_: object) -> None:
        """Show the state in every part of the page."""
        session, file = self.session, self.file
        self._show_all(session.comparison(file) if session and session.seen and file is not None else None)

    def _show_all(self, found: ImageComparison | None) -> None:
        """Show the state, with the file compared with what the control contains where it was read."""
        session, file = self.session, self.file
        arrow = "←" if self.direction == "read" else "→"
        control = self.tr("several controls") if self.known.several.isChecked() else self.name
        self.heading.show_sides(self.title, arrow, control or self.tr("no control chosen"))
        self.enable_choices(has_file=self.workspace is not None)
        own = file or (self.workspace.file if self.workspace is not None else None)
        self.conditions.setVisible(own is not None)
        if own is not None:
            self.conditions.show_conditions(conditions_of(session, own))
        is_listed = found is not None and session is not None and session.phase != "done"
        self._show_counts(found.values.same if found else 0, is_listed)
        self._show_middle(message_in_words(found.summary()) if found else "")
        self.checked.forget_others()
        state = self._state()
        self._show_bar(state)
        self._show_row()
        self._show_hint(state)
        dangers = self.table.dangers() if self.direction == "send" else ()
        is_begun = session is not None and session.phase in ("running", "done", "failed")
        count = len(session.sent.lines) if session is not None and is_begun else state.to_send
        self.steps.show_plan(self.direction, session, count, dangers)

    def _show_counts(self, same: int, is_read: bool) -> None:
        fixed = sum(row.stays for row in self.table.rows.values())
        differ, kept = len(self.table.rows) - fixed, len(self.table.kept())
        parts = [self.tr("{differ} differ, {same} are the same").format(differ=differ, same=same)]
        if kept and self.direction != "read":
            parts.append(self.tr("{kept} kept").format(kept=kept))
        if fixed:
            parts.append(self.tr("%n on one side only: stay", "", fixed))
        session, text = self.session, ", ".join(parts)
        if session is not None and session.seen is not None and session.phase == "away":
            text = f"{text_of_reading(session.seen.when)}: {text}"  # it may contain something else by now
        ends = self.table.show_ends(session) if session is not None and not is_read else []
        self.ends.show_ends(ends)
        self.counts.setText(text if is_read else counts_in_words(ends))
        self.filter.setVisible(bool(self.table.rows) and is_read)

    def _show_middle(self, summary: str) -> None:
        session = self.session
        if session is not None and session.phase == "done":
            self.show_text(text_of_proof(session, self.name), is_proof=True)
            return
        if self.table.rows and session is not None and session.seen is not None:
            self.middle.setCurrentWidget(self.table)
            return
        text = text_of_content(session, self.name, summary)
        family = self.workspace.file.schema.family if self.workspace is not None else None
        only = family.by_hand if family is not None else ""
        if family is not None and only and (session is None or session.seen is None):
            words = worded(only, family.family)
            text += "\n\n" + self.tr("{only}: “By Hand” makes the sheet for that.").format(only=words)
        self.show_text(text.strip())

    def _show_bar(self, state: PageState) -> None:
        session = self.session
        is_needed = session is not None and session.lacks_password
        self.ask_password(needed=is_needed, is_busy=session is not None and session.is_busy)
        message = bar_message(state)
        if message is None:
            self.bar.hide()
        # Not shown again while it is there: screen readers would read it out at every change.
        elif self.bar.isHidden() or self.bar.text.text() != message.text:
            acts: dict[BarAnswer, Callable[[], object]] = {
                "ask": self._ask_again,
                "accept errors": self._accept_errors,
                "write one": self._write_one,
            }
            answers = ((text, acts[answer]) for text, answer in message.answers)
            self.bar.say(message.text, message.kind, *answers)

    def _accept_errors(self) -> None:
        self._accepted_errors = True
        self.refresh()

    def _show_row(self) -> None:
        """Show what the current row is about, and whether all that can be dangerous is checked."""
        state, session = self._state(), self.session
        self.row.show_state(state, is_listed=self.middle.currentWidget() is self.table)
        count = len(self.table.dangers()) if state.direction == "send" else 0
        self.checked.show_count(count, can_send=session is not None and session.phase == "ready")

    def _show_hint(self, state: PageState) -> None:
        session = self.session
        phase = session.phase if session is not None else ""
        is_busy = session is not None and session.is_busy
        is_under_way = phase in ("running", "connecting")
        self.progress.setVisible(is_under_way)
        self.cancel.setVisible(is_busy and is_under_way)
        self.cancel.setText(text_of_cancel(session))
        self.proof.setVisible(phase == "done")
        self.again.setVisible(not is_busy and phase in ("ready", "done"))
        button = primary_button(state)
        takes = self.direction == "read" and phase == "ready" and state.kept > 0 and not is_busy
        self.as_new.setVisible(takes and state.workspace is not None)
        self.primary.setVisible(bool(button.text))
        self.primary.setText(button.text)
        self.primary.setEnabled(not button.why_off)
        tied = self.tr("Tied to what you see: if the control changes before, nothing is replaced.")
        is_tied = self.direction == "send" and phase == "ready" and bool(button.text)
        self.hint.setText(button.why_off or (tied if is_tied else ""))

    # -- the one button ----------------------------------------------------------------

    def _act(self) -> None:
        session = self.session
        assert session is not None
        if session.phase in ("away", "failed"):
            session.read()
        elif session.phase == "done":
            self.left.emit()
        elif self.direction == "compare":
            self.turn("send")
        elif self.direction == "read":
            self._accept_values()
        else:
            self._send()

    def press(self) -> None:
        """Do what the primary button does, if it is on: the key that opened the page, again."""
        if self.states.currentWidget() is self.several:
            self.several.press()
        elif self.primary.isVisible() and self.primary.isEnabled():
            self.primary.click()

    def _send(self) -> None:
        session, workspace = self.session, self.workspace
        assert session is not None
        lines = map(self.table.change_in_words, self.table.rows_taking(file=True))
        sent = SentChanges(tuple(lines), tuple(map(self.table.name_of, self.table.kept())))
        if self.backup is not None:
            session.restore(self.backup.copy, self.backup.path, sent)
            return
        assert workspace is not None
        if workspace.is_dirty and workspace.may_edit and not self._save():
            return  # what is sent is on disk
        # The thread sends this while the file may be edited on.
        file = workspace.file.copy()
        kept = {row.difference.address: row.difference.b for row in self.table.kept()}
        if kept:
            # Forced: what the control contains may lie outside the limits of the schema, and stays.
            file.set_checked(kept, force=self.tr("kept at the control"))
        session.send(file, workspace.path, sent)

    def _write_one(self) -> None:
        row, session, workspace = self.table.current(), self.session, self.workspace
        self.row.ask(wanted=False)
        if row is not None and session is not None and workspace is not None:
            line = self.table.change_in_words(row)
            session.write_one(row.difference.address, workspace.file.copy(), workspace.path, line)

    def _accept_values(self) -> None:
        workspace, session = self.workspace, self.session
        assert session is not None
        rows = self.table.kept() if workspace is not None else []
        if workspace is None or session.present(workspace.file) is None or not rows:
            self._save_as_new()
            return
        values: dict[tuple[str, str], Value | None] = {
            row.difference.address: row.difference.b for row in rows
        }
        workspace.edit(self.tr("Read from {name}").format(name=self.name), values)
        self._fill()

    def _save_as_new(self) -> None:
        seen = self.session.seen if self.session is not None else None
        self.read_requested.emit(seen.file.copy() if seen is not None and seen.file is not None else None)

    def _save_proof(self) -> None:
        """Write what the control contains, by what that is proven, and each value that was sent."""
        session, workspace = self.session, self.workspace
        if session is None or session.outcome is None or workspace is None:
            return
        lines = [text_of_proof(session, self.name), "", *session.sent.lines]
        self.write_proof(workspace.path.with_name(f"{workspace.path.stem}-proof.txt"), lines)

    def _cancel(self) -> None:
        if self.session is not None:
            self.session.cancel()
            self.cancel.setEnabled(False)
            self.hint.setText(self.tr("Stopping at the next safe point …"))

    def _escape(self) -> None:
        # Escape stops before it leaves: the page must not be left while something is being written.
        if self.several.is_busy:
            self.several.stop_all()
        elif self.session is not None and self.session.phase == "running":
            self._cancel()
        elif self.row.question:
            self.row.ask(wanted=False)
        else:
            self.left.emit()

    def connect_again(self) -> None:
        """Read the control again."""
        if self.session is not None and not self.session.is_busy:
            self.session.read()

    def _enter_password(self) -> None:
        if self.session is not None:
            text = self.password.text()
            # Before the connection is tried: it is not left in a field while a thread waits.
            self.password.clear()
            self.session.enter_password(text)
