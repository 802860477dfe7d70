"""The values that differ between a file and a control: which side each row takes, and what to mind about
it.
"""

from __future__ import annotations

import html
from collections.abc import Iterable
from dataclasses import dataclass

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics, QIcon, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QTreeWidget, QTreeWidgetItem

from amp_studio.files import Difference, ParameterFile, shown_axes
from amp_studio.report import Danger, dangers_of_change, takes_effect
from amp_studio.schema import Address
from amp_studio.ui.base.figures import show_value
from amp_studio.ui.base.places import short_place
from amp_studio.ui.base.theme import GAP2, GAP3, ROW, SMALL_ICON, colour, font, icon, scheme, severity_icon
from amp_studio.ui.base.translated import facts_in_words, worded

from .session import BackupReturn, ControlSession
from .value_ends import ValueEnd, ends_of

NUMBER, NAME, AXIS, CONTROL, FILE, REMARK = range(6)
_NAME, _MIN_NAME, _SIDE, _MIN_SIDE = 260, 130, 150, 96
_MAX_NUMBER, _MAX_REMARK = 84, 200
"""Widths in pixels of the names and of a side, where there is room and where there is not; and of a number
and of what is to be minded at most. A side whose name needs more has more where there is room."""
_ADDRESS = Qt.ItemDataRole.UserRole + 1


@dataclass
class SideRow:
    """One value that differs."""

    difference: Difference
    """``a`` is the file's side, ``b`` the control's."""
    takes_file: bool
    dangers: tuple[Danger, ...] = ()
    is_fixed: bool = False
    """Whether there is no choice: the control's value stays where the file does not set it, and a backup is
    put back with all its values.
    """
    is_chosen: bool = False
    """Whether the side was taken by hand."""

    @property
    def stays(self) -> bool:
        """Whether the control's value stays whatever is chosen."""
        return self.is_fixed and not self.takes_file


class DifferenceTable(QTreeWidget):
    """Groups with their rows; axes that are not fitted and what only the control has are folded.
    Space changes the side of a row.
    """

    sides_changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName(self.tr("Differences"))
        self.setHeaderLabels(
            [self.tr("No."), self.tr("Parameter"), self.tr("Axis"), "A", "B", self.tr("Mind")]
        )
        self.setRootIsDecorated(True)
        self.setIndentation(14)
        self.setUniformRowHeights(True)
        self.setAllColumnsShowFocus(True)
        self.setIconSize(QSize(SMALL_ICON, SMALL_ICON))
        self.rows: dict[Address, SideRow] = {}
        self._items: dict[Address, QTreeWidgetItem] = {}
        self._file: ParameterFile | None = None
        self._secrets = self._is_narrow = False
        self._to_control = True
        self._wanted: frozenset[Address] | None = None
        self.itemClicked.connect(self._click)
        self.header().setStretchLastSection(True)
        self.header().setTextElideMode(Qt.TextElideMode.ElideRight)
        scheme().changed.connect(self._colour)

    def _colour(self) -> None:
        """Show every row in the colours of the moment."""
        for address in self._items:
            self._show_side(address)

    def show_short_words(self, is_narrow: bool) -> None:
        """Show in few words what is to be minded about a row, where there is little room."""
        if is_narrow != self._is_narrow:
            self._is_narrow = is_narrow
            self._colour()

    def show_sides(self, control: str, file: str) -> None:
        """Name the two sides in the head."""
        self.headerItem().setText(CONTROL, f"A  {control}")
        self.headerItem().setText(FILE, f"B  {file}")
        self._share_room()

    def begin_with(self, only: Iterable[Address] | None) -> None:
        """Take the file's side of these values alone, of all with None; another beginning forgets what
        was chosen before.
        """
        wanted = None if only is None else frozenset(only)
        if wanted != self._wanted:
            self._wanted = wanted
            self.show_nothing()

    def show_nothing(self) -> None:
        """Forget what differed, and the choices."""
        self.clear()
        self.rows, self._items = {}, {}

    def show_differences(
        self,
        file: ParameterFile,
        differences: Iterable[Difference],
        *,
        to_control: bool,
        secrets: bool,
        returns: BackupReturn | None = None,
    ) -> None:
        """List what differs; the side that gives is taken, unless it does not have the value,
        and a choice made before stays. There is no choice where a backup ``returns``: all of it is put back.
        """
        has_choice = returns is None
        # A choice is kept over a new reading and in another direction.
        before = {
            address: row.takes_file for address, row in self.rows.items() if row.is_chosen and has_choice
        }
        self._file, self._secrets, self._to_control = file, secrets, to_control
        found = list(differences)
        self.show_nothing()
        schema = file.schema
        for difference in found:
            # The side that gives has no value: nothing can be sent or taken, so the other side stays. A
            # whole backup replaces that too.
            only = difference.a is None if to_control else difference.b is None
            only = only and returns != "whole"
            dangers = dangers_of_change(file, [difference], facts_in_words(file.schema))
            begun = to_control and (self._wanted is None or difference.address in self._wanted)
            takes = not only and before.get(difference.address, begun)
            self.rows[difference.address] = SideRow(
                difference, takes, dangers, only or not has_choice, difference.address in before
            )
        screen_text = set(shown_axes(file)) if schema.family.fits_axes else None
        blocks: dict[str, list[Address]] = {}
        for address in self.rows:
            blocks.setdefault(self._block_of(address, screen_text), []).append(address)
        # The sort is stable: only the folded ones move to the end, the others stay in the order of the
        # file.
        for title, addresses in sorted(blocks.items(), key=lambda block: block[0].startswith("\0")):
            self._add_block(title, addresses)
        self._share_room()
        first = next(iter(self._items.values()), None)
        if first is not None:
            self.setCurrentItem(first)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._share_room()

    def _share_room(self) -> None:
        """Give numbers and axes what they need, and both sides their room before the names;
        a side is never beyond the edge.
        """
        metrics = QFontMetrics(font("text", own=True))
        for column, least in ((NUMBER, 2 * self.indentation() + 2 * GAP2), (AXIS, 2 * GAP3)):
            texts = [self.headerItem().text(column), *(item.text(column) for item in self._items.values())]
            self.setColumnWidth(
                column, min(_MAX_NUMBER, max(map(metrics.horizontalAdvance, set(texts))) + least)
            )
        room = self.viewport().width() - self.columnWidth(NUMBER) - self.columnWidth(AXIS)
        names = [self.header().sectionSizeHint(column) for column in (CONTROL, FILE)]
        side = min(max(_SIDE, *names), max(_MIN_SIDE, room // 4))
        words = {item.text(REMARK) for item in self._items.values()}
        needed = SMALL_ICON + 2 * GAP2 + max(map(metrics.horizontalAdvance, words), default=0)
        remark = max(_MIN_SIDE, self.header().sectionSizeHint(REMARK), min(needed, _MAX_REMARK, room // 3))
        widths = {NAME: max(_MIN_NAME, min(_NAME, room - 2 * side - remark)), CONTROL: side, FILE: side}
        spare = max(0, room - remark - sum(widths.values()))
        for column in (FILE, CONTROL, NAME):  # what is to spare goes to texts that would be cut
            own = {item.text(column) for item in self._items.values()}
            wide = SMALL_ICON + 2 * GAP3 + max(map(metrics.horizontalAdvance, own), default=0)
            more = min(spare, max(0, wide - widths[column]))
            spare -= more
            self.setColumnWidth(column, widths[column] + more)

    def _block_of(self, address: Address, screen_text: set[str] | None) -> str:
        """Return the title of the block of a value; those that begin with a NUL are folded, at the end."""
        assert self._file is not None
        if self.rows[address].stays:
            return "\0" + self.tr("On one side only, kept as they are")
        if (
            screen_text is not None
            and self._file.evaluation.scope(address) == "axis"
            and address[1].partition(".")[0] not in screen_text
        ):
            return "\0" + self.tr("Axes that are not fitted")
        group = self._file.schema.group_of[address[0]]
        return group.own_name

    def _add_block(self, title: str, addresses: list[Address]) -> None:
        assert self._file is not None
        head = QTreeWidgetItem([f"{title.lstrip(chr(0))}   {len(addresses)}"])
        head.setFont(0, font("text", own=True))
        head.setSizeHint(0, QSize(0, ROW))
        head.setFlags(Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable)
        machine = self._file.machine_schema
        for address in addresses:
            row = self.rows[address]
            place = short_place(self._file, address)
            item = QTreeWidgetItem(
                [
                    machine.number(address) or "",
                    self._file.schema.parameters[address[0]].name,
                    place,
                    *reversed([self.text_of(address, value) for value in row.difference.in_one_unit()]),
                    "",
                ]
            )
            item.setData(0, _ADDRESS, address)
            item.setSizeHint(0, QSize(0, ROW))
            head.addChild(item)
            self._items[address] = item
            self._show_side(address)
        # With all its rows: in the tree each of their texts, icons and fonts would be a change to be shown.
        self.addTopLevelItem(head)
        # Only an item that is in the tree takes this.
        head.setFirstColumnSpanned(True)
        head.setExpanded(not title.startswith("\0"))

    def text_of(self, address: Address, value: object) -> str:
        assert self._file is not None
        if value is None:
            return self.tr("not set")
        return show_value(self._file.schema.parameters[address[0]], value, secrets=self._secrets)  # type: ignore[arg-type]  # a value of the difference

    def _show_side(self, address: Address) -> None:
        row, item = self.rows[address], self._items[address]
        for column, is_taken in ((CONTROL, not row.takes_file), (FILE, row.takes_file)):
            left = icon("circle", "grid" if row.is_fixed else "dim")
            item.setIcon(column, icon("check-circle-fill", "sel") if is_taken else left)
            item.setFont(column, font("text", own=is_taken))
            item.setForeground(column, colour("text" if is_taken else "dim"))
        # What is read goes the other way: the side that gives needs no remark.
        is_given = row.takes_file is self._to_control
        if row.stays:
            item.setText(REMARK, self._by_width(self.tr("stays"), self.tr("stays as it is")))
        elif not is_given:
            stays = (
                self.tr("the control's value stays")
                if self._to_control
                else self.tr("the file's value stays")
            )
            item.setText(REMARK, self._by_width(self.tr("kept"), stays))
            item.setIcon(REMARK, icon("circle", "panel"))
        elif row.dangers and self._to_control:
            danger = row.dangers[0]
            item.setText(REMARK, danger.brief or self.tr("danger, page {page}").format(page=danger.page))
            item.setToolTip(REMARK, "\n".join(each.says for each in row.dangers))
            item.setIcon(REMARK, severity_icon("error"))
        else:
            item.setText(REMARK, "")
        spoken = self.tr("the file's value") if row.takes_file else self.tr("the control's value")
        item.setData(
            0, Qt.ItemDataRole.AccessibleTextRole, f"{item.text(NUMBER)} {item.text(NAME)}, {spoken}"
        )

    def _by_width(self, short: str, whole: str) -> str:
        return short if self._is_narrow else whole

    # -- sides -------------------------------------------------------------------

    def current(self) -> SideRow | None:
        """Return the selected row."""
        item = self.currentItem()
        return self.rows.get(item.data(0, _ADDRESS)) if item is not None and item.data(0, _ADDRESS) else None

    def current_in_words(self, *, with_dangers: bool) -> str:
        """Return the selected value as HTML: its name, and its dangers or when it takes effect."""
        row = self.current()
        if row is None or self._file is None:
            return ""
        address, schema = row.difference.address, self._file.schema
        dangers = row.dangers if with_dangers else ()
        effect = takes_effect(schema, schema.parameters[address[0]])
        lines = [f"{each.says} ({self.tr('page {page}').format(page=each.page)})" for each in dangers]
        if not dangers:
            lines = [self.tr("Takes effect: {when}.").format(when=worded(effect))]
        return f"<b>{html.escape(self.name_of(row))}</b><br>{html.escape(' '.join(lines))}"

    def take(self, addresses: Iterable[Address], *, file: bool) -> None:
        """Take one side for some rows."""
        for address in addresses:
            row = self.rows[address]
            if not row.is_fixed:
                row.takes_file, row.is_chosen = file, True
                self._show_side(address)
        self.sides_changed.emit()

    def _click(self, item: QTreeWidgetItem, column: int) -> None:
        address = item.data(0, _ADDRESS)
        if column in (CONTROL, FILE) and address:
            self.take([address], file=column == FILE)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Space changes the side of a row, with Ctrl that of its group."""
        item = self.currentItem()
        if event.key() != Qt.Key.Key_Space or item is None:
            super().keyPressEvent(event)
            return
        whole = event.modifiers() & Qt.KeyboardModifier.ControlModifier or item.parent() is None
        head = (item.parent() or item) if whole else None
        items = [head.child(n) for n in range(head.childCount())] if head is not None else [item]
        addresses = [each.data(0, _ADDRESS) for each in items]
        if addresses:
            self.take(addresses, file=not self.rows[addresses[0]].takes_file)

    def select(self, address: Address) -> None:
        """Select the row of a value, in a group that is open then."""
        item = self._items.get(address)
        if item is not None:
            item.parent().setExpanded(True)
            self.setCurrentItem(item)
            self.scrollToItem(item)

    def select_danger(self, by: int) -> None:
        """Select the next row (``by`` 1) or the one before (-1) that would be sent and can be dangerous."""
        marked = [address for address, row in self.rows.items() if row.dangers and row.takes_file]
        row = self.current()
        # From no marked row the first step goes to the first one, or backwards to the last.
        before_first = -1 if by > 0 else 0
        is_marked = row is not None and row.difference.address in marked
        here = marked.index(row.difference.address) if row is not None and is_marked else before_first
        if marked:
            self.select(marked[(here + by) % len(marked)])

    def show_only(self, words: str) -> None:
        """Leave out the rows whose number, name or values have none of the words."""
        wanted = words.casefold().strip()
        for n in range(self.topLevelItemCount()):
            head = self.topLevelItem(n)
            texts = [
                (c, " ".join(c.text(k) for k in range(REMARK)).casefold())
                for c in map(head.child, range(head.childCount()))
            ]
            for child, text in texts:
                child.setHidden(wanted not in text)
            head.setHidden(all(wanted not in text for _, text in texts))

    # -- what is sent --------------------------------------------------------------

    def rows_taking(self, *, file: bool) -> list[SideRow]:
        """Return the rows that take the file's side, or those that take the control's."""
        return [row for row in self.rows.values() if row.takes_file is file]

    def change_in_words(self, row: SideRow) -> str:
        """Return what a value is at the control, and what it is then."""
        assert self._file is not None
        address, difference = row.difference.address, row.difference
        old, new = (self.text_of(address, value) for value in (difference.b, difference.a))
        return f"{self.name_of(row)}: {old} → {new}"

    def name_of(self, row: SideRow) -> str:
        """Return the number and the name of a value, and its axis."""
        assert self._file is not None
        address, schema = row.difference.address, self._file.machine_schema
        name = schema.parameters[address[0]].name
        return " ".join(filter(None, (schema.number(address), name, short_place(self._file, address))))

    def kept(self) -> list[SideRow]:
        """Return the rows whose value of the control stays, or goes into the file when it is read;
        without those that the control does not contain, which stay as they are in the file.
        """
        return [row for row in self.rows_taking(file=False) if not row.is_fixed]

    def show_ends(self, session: ControlSession) -> list[ValueEnd]:
        """Show beside each value that was sent what the control has of it, as far as that is known."""
        ends = ends_of(session, [row.difference for row in self.rows_taking(file=True)])
        for address, end in ends.items():
            self._items[address].setText(REMARK, end.text)
            self._items[address].setIcon(REMARK, QIcon())
        return list(ends.values())

    def dangerous_changes(self) -> frozenset[object]:
        """Return the changes that would be sent and can be dangerous, with both values."""
        rows = (row.difference for row in self.rows_taking(file=True) if row.dangers)
        return frozenset((each.address, each.a, each.b) for each in rows)

    def dangers(self) -> tuple[Danger, ...]:
        """Return what the manual calls dangerous about the values that change, each statement once."""
        if self._file is None:
            return ()
        return dangers_of_change(
            self._file,
            [row.difference for row in self.rows_taking(file=True)],
            facts_in_words(self._file.schema),
        )
