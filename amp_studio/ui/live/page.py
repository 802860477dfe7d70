"""The page Live of a file: the machine while a value is tried. Few rows, file beside control, one frame that
writes a single value, and at the right what the control states of itself, asked at most five times a second.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from datetime import UTC, datetime
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QShortcut

from amp_studio.files import Difference, ParameterFile, RangeError, axis_instances, axis_letter
from amp_studio.pictures import LiveLimits, axis_limits
from amp_studio.report import dangers_of_change
from amp_studio.schema import Address, Group, Parameter, Value, same_value
from amp_studio.ui.base.figures import sentence, show_value
from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.translated import facts_in_words
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.control.readings import EventReadings, StatusReadings
from amp_studio.ui.control.session import ControlSession
from amp_studio.ui.control.session_words import text_of_failure
from amp_studio.ui.forms.form import fill_choices

from .asking import LiveAsking, sentence_of
from .rows import TurnedValue
from .write_frame import ShownValue

if TYPE_CHECKING:
    from amp_studio.transfer import AxisStatus, ControlStatus
    from amp_studio.ui.base.emulated_control import EmulatedControl


class LiveView(LiveAsking):
    """Everything reads only but the frame. An exchange ends it; what was turned is asked about once."""

    linked = Signal(str)
    """A parameter is wanted by its id."""
    noted = Signal(str)
    """What has come to its end after the page was left."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__(workspace, self._present)
        self._emulated: EmulatedControl | None = None
        self.name = self._seen = ""
        self._parameters: Sequence[Parameter] = ()
        self._listed: Sequence[Parameter] = ()
        """What the table listed when Live was begun."""
        self.turned: dict[Address, TurnedValue] = {}
        self.happened = EventReadings()
        self._limits: dict[tuple[str, str], LiveLimits] = {}
        """Axis and unit -> its limits in the file as it is."""
        self._begun = time.monotonic()
        self._asked: set[Address] = set()
        """Values that a person has agreed to have written from here."""
        self._writing: tuple[Address, Value | None] | None = None
        self._queue: list[tuple[Address, Value]] = []
        """Values that are still to be put back."""
        self._connect()
        workspace.changed.connect(self._follow_values)

    def _connect(self) -> None:
        self.read.clicked.connect(self._read_values)
        self.axes.chosen.connect(lambda _: self._choose_axis())
        self.groups.currentIndexChanged.connect(lambda _: self._choose_group())
        self.rows.chosen.connect(lambda _: self._show_frame())
        self.frame.write_requested.connect(self.write)
        self.frame.back_requested.connect(self.put_back)
        self.frame.take_requested.connect(self.take)
        self.panel.linked.connect(self.linked)
        self.panel.keys_pressed.connect(self._press)
        self.panel.end.clicked.connect(self.escape)
        for keys, act in (
            ("Ctrl+Return", self.frame.press),
            ("Ctrl+Backspace", self.frame.put_back),
            ("F2", self.frame.field.setFocus),
        ):
            shortcut = QShortcut(QKeySequence(keys), self, act)
            shortcut.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)

    # -- whom it asks ----------------------------------------------------------------

    def use(
        self,
        session: ControlSession,
        seen: str,
        name: str,
        emulated: EmulatedControl | None = None,
        readings: StatusReadings | None = None,
    ) -> None:
        """Take a control: its exchanges, the address where it shows its status, what it is called, and the
        keys of an emulated one.
        """
        if self.session is not session:
            if self.session is not None:
                self.session.changed.disconnect(self._follow_session)
                self.session.value_written.disconnect(self._written)
            session.changed.connect(self._follow_session)
            session.value_written.connect(self._written)
            self.turned.clear()
            self._asked.clear()
            self.happened = EventReadings()
            # Nothing of another control may be read as this one's.
            self._status = self._answers.last = None
            self.panel.show_nothing("")
        self.session, self.name = session, name
        # Readings from the same address go on: a control may take one client only.
        if self.readings is None or seen != self._seen:
            self._take_readings(readings or StatusReadings(seen, self._family))
            self._seen = seen
        if self._emulated is not None:
            self._emulated.line_shown.disconnect(self._answer)
        self._emulated = emulated
        if emulated is not None:
            emulated.line_shown.connect(self._answer)
        self.frame.use(is_emulated=emulated is not None)
        self.panel.show_keys(emulated is not None)
        self.panel.place.setText(session.address)
        self._show_control()

    def _take_readings(self, readings: StatusReadings) -> None:
        if self.readings is not None:
            self.readings.read.disconnect(self.show_status)
            self.readings.failed.disconnect(self._over)
            self.readings.stop()
        self.readings = readings
        readings.read.connect(self.show_status)
        readings.failed.connect(self._over)

    def show_parameters(self, title: str, parameters: Sequence[Parameter], axis: str) -> None:
        """List parameters, with those of an axis by its instance."""
        self._parameters = self._listed = parameters
        schema = self._workspace.file.schema
        fill_choices(self.groups, [("", title), *((each.key, _name_of(each)) for each in schema.groups)], "")
        letter = axis_letter(self._workspace.file, axis) or axis
        if not self.axes.buttons:
            file = self._workspace.file
            # Of the file, until the control itself names its axes.
            names = [axis_letter(file, each) or each for each in axis_instances(file)]
            self._offer_axes(names[:8], letter)
        elif letter in self.axes.buttons:
            self.axes.show_choice(letter)
        self._choose_axis()

    def _offer_axes(self, names: Sequence[str], wanted: str) -> None:
        if list(self.axes.buttons) != list(names):
            self.axes.offer([(name, name, "") for name in names])
        choice = wanted if wanted in names else next(iter(names), None)
        self.axes.show_choice(choice)
        self.axes.setVisible(len(names) > 1)

    def _instance(self) -> str:
        """Return the axis of the file that is called as the chosen one of the control."""
        file, name = self._workspace.file, self.axes.choice or ""
        found = (each for each in axis_instances(file) if name in (each, axis_letter(file, each)))
        return next(found, "")

    def _choose_group(self) -> None:
        """List the values of another group, or those that the table listed."""
        key = self.groups.currentData()
        groups = self._workspace.file.schema.groups
        found = next((each.parameters for each in groups if each.key == key), self._listed)
        self._parameters = tuple(found)
        self._choose_axis()

    def _choose_axis(self) -> None:
        self.rows.show_parameters(self._parameters, self._instance())
        self.recorder.show_axis(self.axes.choice or "")
        self._show_frame()
        if self._status is not None:
            self._show_axis(self._status)

    # -- a reading -------------------------------------------------------------------

    def show_status(self, status: ControlStatus, at: float | None = None) -> None:
        """Show a reading of a time, by default of now."""
        if not self.is_live:
            return
        at = time.monotonic() if at is None else at
        self._answers.take(at)
        is_first = self._status is None
        self._status = status
        if self.bar.isVisible() and self.panel.readings.isEnabled() is False:
            self.bar.hide()
        if self.session is not None:
            self.session.note_answer()
        if self._is_silent:
            self._is_silent = False
            self.changed.emit()
        if names := [axis.axis for axis in status.axes]:
            self._offer_axes(names, self.axes.choice or names[0])
        is_new = self.happened.take(status)
        # Limits and values are looked up again where something has happened, not five times a second.
        if is_first or is_new:
            self._choose_axis()
        self._show_axis(status)
        if (axis := self._axis_of(status)) is not None:
            self.recorder.take(at - self._begun, axis, is_fault=is_new, reasons=status.not_known)
        self.panel.show_happened(self.happened)
        self._answers.show_age()
        states = (status.state, tuple(axis.states for axis in status.axes), tuple(status.faults))
        # The state in which it refused has ended: it may take the value now.
        if states != self._refused_in:
            self._refused_in = states
            self.frame.allow()

    def _show_axis(self, status: ControlStatus) -> None:
        axis = self._axis_of(status)
        if axis is not None and (axis.axis, axis.unit) not in self._limits:
            found = axis_limits(self._workspace.file, axis.axis, axis.unit)
            self._limits[axis.axis, axis.unit] = found
        limits = self._limits[axis.axis, axis.unit] if axis is not None else LiveLimits()
        self.panel.show_status(status, axis, limits)

    def _axis_of(self, status: ControlStatus) -> AxisStatus | None:
        return next((each for each in status.axes if each.axis == self.axes.choice), None)

    def _press(self, command: str) -> None:
        """Give a command of the keys of the emulated control; an axis that is moved is to be seen."""
        if self._emulated is not None:
            self._emulated.send(command)
            self.start()

    def _answer(self, line: str) -> None:
        self.happened.record_act(line)
        self.panel.show_happened(self.happened)

    # -- values ------------------------------------------------------------------------

    def _present(self) -> ParameterFile | None:
        session = self.session
        if session is None or session.is_seen_old:
            return None
        return session.present(self._workspace.file)

    def _follow_values(self, *_: object) -> None:
        self._limits.clear()
        self.rows.refresh()
        self._show_frame()

    def _show_control(self) -> None:
        """Show what the control contains, as it was read last."""
        self.rows.show_control(self._present(), self.turned)
        self._show_frame()

    def _show_frame(self) -> None:
        """Show the frame for the current row, or why nothing can be written here."""
        address, present = self.rows.address, self._present()
        seen = self.session.seen if self.session is not None else None
        why = ""
        if present is None or seen is None:
            why = self.tr("What the control contains now was not read.")
            if self.session is not None and self.session.is_refused:
                why = sentence_of(self.session.error)
        elif not seen.takes_one:
            why = self.tr("Reads only: this control takes no single values. Send the file (F5).")
        elif address is None or self._workspace.is_masked(address):
            why = self.tr("No value here can be written alone.")
        self.reason.setText(why)
        self.reason_row.setVisible(bool(why))
        self.read.setVisible(present is None)
        self.framed.setVisible(not why)
        if why or address is None or present is None:
            self.frame.show_value(None)
            return
        turned = self.turned.get(address)
        self.frame.show_value(
            ShownValue(
                address, present.get(address), turned.before if turned else None, is_turned=turned is not None
            )
        )

    def _read_values(self) -> None:
        """Read what the control contains; one that needs a person at its keys is read At the Control."""
        if self.session is None or self.session.is_busy:
            return
        if self._is_keyed():
            self.control_requested.emit()
        else:
            self._with_line(self.session.read)

    def _is_keyed(self) -> bool:
        """Return whether a person has to begin each exchange at the control itself."""
        from amp_studio.transfer.links import parse_endpoint

        assert self.session is not None
        return not self._takes_one() and parse_endpoint(self.session.address).protocol not in ("", "house")

    def write(self, address: Address, value: Value) -> None:
        """Write a value into the control, asked once for each; it is read back and recorded."""
        file = self._present()
        if file is None or self.session is None:
            return
        file = file.copy()
        try:
            file.set_checked({address: value})
        except RangeError as error:
            self.frame.refuse(sentence(str(error)))
            return
        if address not in self._asked and not self._is_agreed(address, value, file):
            return
        self._asked.add(address)
        before = self._present()
        self._writing = address, before.get(address) if before is not None else None
        self._with_line(partial(self.session.write_one, address, file, self._workspace.path))

    def _is_agreed(self, address: Address, value: Value, wanted: ParameterFile) -> bool:
        """Ask before the first time that a value is written, with what can be dangerous about it."""
        present = self._present()
        assert present is not None
        change = Difference(address, value, present.get(address))
        dangers = dangers_of_change(wanted, [change], facts_in_words(wanted.schema))
        parameter = wanted.schema.parameters[address[0]]
        text = self.tr("Write {name} = {value} into {control} now?").format(
            name=self._workspace.name_of(address), value=show_value(parameter, value), control=self.name
        )
        text = "\n\n".join((text, *dict.fromkeys(danger.line for danger in dangers)))
        yes = self.tr("&Write Now")
        return ask(self, self.tr("Live"), text, yes, self.tr("Cancel"), default=1) == yes

    def put_back(self, address: Address) -> None:
        """Have the control contain again what it contained before the value was turned."""
        turned = self.turned.get(address)
        if turned is not None and turned.before is not None:
            self._asked.add(address)
            self.write(address, turned.before)

    def take(self, address: Address) -> bool:
        """Take a value of the control into the file, as one step of undo; the bar has why it cannot."""
        present = self._present()
        why = ""
        if not self._workspace.may_edit:
            why = self.tr("The file is read-only: nothing was taken into it.")
        elif present is None:
            why = self.tr("What the control contains now was not read: nothing was taken into the file.")
        if present is None or why:
            self.bar.say(why, "error")
            return False
        self._workspace.edit(self.tr("Take from Live"), {address: present.get(address)})
        self.turned.pop(address, None)
        self._show_control()
        return True

    def _written(self, address: object) -> None:
        """Remember what a value was before it was turned here; one that is back is not turned."""
        if self._writing is None or self._writing[0] != address:
            return
        place, before = self._writing
        self._writing = None
        now = datetime.now(UTC).astimezone()
        old = self.turned.pop(place, TurnedValue(before, now))
        present = self._present()
        theirs = present.get(place) if present is not None else None
        if not same_value(old.before, theirs):
            self.turned[place] = old
        parameter = self._workspace.file.schema.parameters[place[0]]
        text = f"{show_value(parameter, before)} → {show_value(parameter, theirs)}"
        self._answer(
            self.tr("{name} written: {change}").format(name=self._workspace.name_of(place), change=text)
        )

    def _follow_session(self) -> None:
        session = self.session
        assert session is not None
        if session.is_busy:
            if not self._is_own and self.is_live:
                self.stop(self.tr("Live has ended: an exchange is under way."))
            return
        self._show_control()
        if not self._is_own:
            return
        self._is_own = False
        if session.phase == "failed":
            self._failed(session)
            if self._is_own:  # it is being read
                return
        elif self._queue:
            self._put_next_back()
            return
        if session.phase == "away" and session.error and not session.is_refused:
            again = (self.tr("Try Again"), self.start)
            self.bar.say(sentence_of(session.error), "error", again, self._to_control())
            return
        self._ask()

    def _failed(self, session: ControlSession) -> None:
        """Show why a value was not written; what the control contains is read where it is not known then."""
        self._writing = None
        self._queue.clear()
        failure = session.failure
        is_open = failure is not None and failure.at_control != "old"
        text = text_of_failure(session) if is_open else sentence_of(session.error)
        self.frame.refuse(text)
        if self._is_away:
            self.noted.emit(text)
        self._refused_in = None
        if session.failure is None or session.failure.at_control != "old":
            self._is_own = True
            session.read()

    # -- leaving -------------------------------------------------------------------------

    def may_turn_away(self) -> bool:
        """Ask once about the values that were turned: put back, into the file, or left as they are."""
        if not self.turned or self.session is None:
            return True
        lines = "\n".join(self._workspace.name_of(address) for address in self.turned)
        back, keep, leave = (
            self.tr("&Put Back"),
            self.tr("&Take into the File"),
            self.tr("&Leave in the Control"),
        )
        answer = ask(
            self,
            self.tr("Live"),
            self.tr(
                "The control contains %n values that were turned here:\n{lines}", "", len(self.turned)
            ).format(lines=lines),
            back,
            keep,
            leave,
            self.tr("Cancel"),
        )
        if answer == back:
            self._queue = [(a, t.before) for a, t in self.turned.items() if t.before is not None]
            self._put_next_back()
        elif answer == keep:
            return all(map(self.take, list(self.turned)))
        elif answer == leave:
            self.turned.clear()
            self._show_control()
        return answer in (back, keep, leave)

    def _put_next_back(self) -> None:
        address, value = self._queue.pop(0)
        self._asked.add(address)
        self.write(address, value)

    def may_leave(self) -> bool:
        """Ask as for another page; while values are put back the file stays open."""
        if not self.may_turn_away():
            return False
        is_busy = self.session is not None and self.session.is_busy
        if is_busy or self._queue or self._then is not None:
            self.bar.say(self.tr("The values are being put back: close the file after that."))
            return False
        return True

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Space that no part of the page takes starts and stops the recorder."""
        if event.key() == Qt.Key.Key_Space:
            self.recorder.start_or_stop()
        else:
            super().keyPressEvent(event)

    def escape(self) -> None:
        """Go back to the values."""
        self.left.emit()


def _name_of(group: Group) -> str:
    return f"{group.name.removesuffix(' Parameters')}, {group.section}" if group.section else group.name
