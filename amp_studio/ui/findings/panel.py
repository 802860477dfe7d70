"""The findings below the table: one row for each rule, what is wrong, on which axes, and the suggested
fix.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QModelIndex, QPoint, QRect, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QKeyEvent, QPainter, QPalette, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QLabel,
    QMenu,
    QPushButton,
    QStackedWidget,
    QStyleOptionViewItem,
    QToolButton,
    QTreeView,
    QWidget,
)

from amp_studio.report import delivered_text, finding_axes
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.modal import pop_up
from amp_studio.ui.base.model_index import ModelIndex
from amp_studio.ui.base.places import finding_text
from amp_studio.ui.base.theme import FINDING_ROW, GAP2, colour, font, icon, paint_icon, scheme, severity_icon
from amp_studio.ui.base.translated import counted, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.elided_label import ElidedLabel
from amp_studio.ui.forms.segment import Segment, chip
from amp_studio.validate import NOT_SET, SEVERITIES, Finding, Suppressed, addresses_not_set

from .delegate import FindingsDelegate, Part
from .model import FindingsModel


class _View(QTreeView):
    """The list: Enter shows the finding, and the row height fits the text."""

    entered_on = Signal()
    menu_requested = Signal(QPoint)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setHeaderHidden(True)
        self.setMouseTracking(True)
        self.setExpandsOnDoubleClick(False)
        self.setIndentation(22)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setTabKeyNavigation(False)

    def drawRow(self, painter: QPainter, option: QStyleOptionViewItem, index: ModelIndex) -> None:
        if index == self.currentIndex():
            painter.fillRect(option.rect, colour("selbg" if self.hasFocus() else "selidle"))
        if not index.internalId() and index.row():
            painter.setPen(colour("line"))
            painter.drawLine(option.rect.topLeft(), option.rect.topRight())
        super().drawRow(painter, option, index)

    def drawBranches(self, painter: QPainter, rect: QRect, index: QModelIndex) -> None:  # type: ignore[override]  # Qt gives no other index here
        if not index.internalId():
            place = QRect(0, self.visualRect(index).top(), self.indentation(), FINDING_ROW)
            name = "caret-down" if self.isExpanded(index) else "caret-right"
            paint_icon(painter, place.adjusted(5, 9, -5, -9), name, colour("dim"))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        # The heights of the rows depend on the width; Qt asks for them once and keeps them.
        self.scheduleDelayedItemsLayout()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        self.menu_requested.emit(event.globalPos())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.entered_on.emit()
        else:
            super().keyPressEvent(event)


class FindingsPanel(QWidget):
    """The list of findings, with its filters in the head of its dock."""

    activated = Signal(object)
    """A finding was double-clicked, or Enter was pressed."""
    fix_requested = Signal(object)
    """The suggested fixes of some findings, a tuple, are to be applied."""
    several_requested = Signal()
    """A list of fixes is wanted, to choose several."""
    explanation_requested = Signal(object)
    """A finding is to be explained."""
    suppression_requested = Signal(object)
    """A finding is to be suppressed."""
    not_set_requested = Signal()
    """The values that are not set are to be shown."""
    fold_requested = Signal(bool)
    """The head was clicked: True to show it alone, False to open the list."""
    current_changed = Signal(object)
    """The selected finding, or None."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self._shown_ids: frozenset[str] = frozenset()
        self._axis = ""
        self._is_withheld: Callable[[Finding], bool] = lambda _: False
        self.shown_name = self.tr("Group")
        """What the table shows one of."""
        self._pages = QStackedWidget(self)
        in_column(self._pages, on=self, margins=0)
        self.model = FindingsModel(workspace)
        self.view = _View(self._pages)
        self.view.setModel(self.model)
        self.view.setAccessibleName(self.tr("Findings"))
        self._delegate = FindingsDelegate(self.view, self.model, self._act)
        self.view.setItemDelegate(self._delegate)
        self.view.doubleClicked.connect(self._activate)
        self.view.entered_on.connect(self._activate)
        self.view.menu_requested.connect(self._menu)
        self.view.selectionModel().currentChanged.connect(
            lambda *_: self.current_changed.emit(self.current())
        )
        self.empty = QLabel(self._pages)
        self.empty.setAutoFillBackground(True)
        self.empty.setBackgroundRole(QPalette.ColorRole.Base)
        self.empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.empty.linkActivated.connect(self._follow)
        self.empty.setTextInteractionFlags(
            Qt.TextInteractionFlag.LinksAccessibleByMouse | Qt.TextInteractionFlag.LinksAccessibleByKeyboard
        )
        self.empty.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._pages.addWidget(self.view)
        self._pages.addWidget(self.empty)
        self.is_folded = False
        self.head = self._make_head()
        workspace.changed.connect(self._refresh)
        self._refresh()

    def _make_head(self) -> QWidget:
        head = QWidget()
        self.fold = QToolButton()
        self.fold.setAutoRaise(True)
        self.fold.clicked.connect(lambda: self.fold_requested.emit(not self.is_folded))
        title = QLabel(self.tr("Findings"))
        title.setObjectName("title")
        title.setFont(font("text", own=True))
        self.summary = QLabel()
        self.summary.setFont(font("small"))
        self.summary.linkActivated.connect(self._follow)
        scheme().changed.connect(self._show_summary)
        self.chips: dict[str, QToolButton] = {}
        for severity in SEVERITIES:
            self.chips[severity] = made = chip("0")
            made.setIcon(severity_icon(severity))
            made.setChecked(True)
            made.clicked.connect(self._refresh)
        self.scope = Segment(self.tr("Findings of"))
        self.scope.chosen.connect(self._refresh)
        self._offer_scopes()
        self.scope.show_choice("file")
        self.suppressed = chip("")
        self.suppressed.clicked.connect(self._refresh)
        self.hint = ElidedLabel()
        self.hint.setFont(font("small"))
        self.hint.setForegroundRole(self.hint.palette().ColorRole.PlaceholderText)
        self.several = QPushButton(self.tr("Fi&x Several…"))
        self.several.setIcon(icon("magic-wand"))
        self.several.clicked.connect(self.several_requested)
        in_row(
            self.fold,
            title,
            self.summary,
            *self.chips.values(),
            self.scope,
            self.suppressed,
            self.hint,
            1,
            self.several,
            on=head,
            margins=(GAP2, 0, GAP2, 0),
            gap=GAP2,
        )
        return head

    @property
    def has_findings(self) -> bool:
        """Whether the file has findings of steps that are reached, besides values that are not set."""
        return any(f.rule != NOT_SET and not self._is_withheld(f) for f in self._workspace.findings)

    def follow_fold(self, is_folded: bool) -> None:
        """Show in the head what there is, where it is all that is seen; the filters come with the list."""
        self.is_folded = is_folded
        self.fold.setIcon(icon("caret-right" if is_folded else "caret-down", "dim"))
        text = self.tr("Open the findings") if is_folded else self.tr("Show the head of the findings alone")
        self.fold.setToolTip(text)
        self.fold.setAccessibleName(text)
        self.scope.setVisible(not is_folded)
        self.several.setVisible(not is_folded)
        self._show_summary()

    def _show_summary(self, *_: object) -> None:
        """Say in one line what there is where nothing is found."""
        dim, link = colour("dim").name(), colour("sel").name()
        text = f'<span style="color:{dim}">{self.tr("none in this file")}'
        if count := len(addresses_not_set(self._workspace.findings)):
            text += " · " + self.tr("{number} active parameters are not set").format(number=count)
            text += f'</span> <a style="color:{link}" href="unset">{self.tr("Show")}</a>'
        self.summary.setText(text)
        self.summary.setVisible(self.is_folded and not self.has_findings)

    # -- which findings are listed ---------------------------------------------------

    def _offer_scopes(self) -> None:
        axis = self.tr("Axis {letter}").format(letter=self._axis) if self._axis else self.tr("Axis")
        kept = self.scope.choice
        self.scope.offer([("file", self.tr("File"), ""), ("shown", self.shown_name, ""), ("axis", axis, "")])
        self.scope.buttons["shown"].setToolTip(self.tr("Findings of the parameters that the table shows"))
        self.scope.buttons["axis"].setEnabled(bool(self._axis))
        self.scope.show_choice(kept)

    def follow(self, shown_ids: frozenset[str], axis: str, name: str = "") -> None:
        """Take what the table shows, and the letter of the axis of its current cell,
        as what the filters mean.

        ``name`` is what the table shows one of: a step, or a group.
        """
        name = name or self.shown_name
        if (shown_ids, axis, name) == (self._shown_ids, self._axis, self.shown_name):
            return
        self.shown_name = name
        # A cell of no axis leaves the last one, so that the filter does not empty the list.
        self._shown_ids, self._axis = shown_ids, axis or self._axis
        self._offer_scopes()
        if self.scope.choice != "file":
            self._refresh()

    def withhold(self, is_early: Callable[[Finding], bool]) -> None:
        """Leave out the findings of which ``is_early`` is true, such as those of steps not yet reached;
        they are counted.
        """
        self._is_withheld = is_early
        self._refresh()

    def _is_listed(self, finding: Finding) -> bool:
        if not self.chips[finding.severity].isChecked():
            return False
        if self.scope.choice == "shown":
            return any(address[0] in self._shown_ids for address in finding.addresses)
        if self.scope.choice == "axis":
            return self._axis in finding_axes(self._workspace.file, finding)
        return True

    def _suppressed_finding(self, suppressed: Suppressed) -> Finding:
        """Return a suppressed finding as it is listed: without its fix, and with the reason."""
        message = self.tr("{message} Suppressed by {name}: {reason}").format(
            message=finding_text(self._workspace.file, suppressed.finding),
            name=suppressed.suppression.by,
            reason=suppressed.suppression.reason,
        )
        # Without figures the message is taken as it is, not made again from the words of the rule.
        return replace(suppressed.finding, fix=(), figures=None, message=message)

    def _refresh(self, *_: object) -> None:
        """List the findings that there are now; the same row stays selected and open,
        or the one that took its place.
        """
        workspace = self._workspace
        reached = [finding for finding in workspace.findings if not self._is_withheld(finding)]
        suppressed = workspace.validator.suppressed
        listed = [*filter(self._is_listed, reached)]
        if self.suppressed.isChecked():
            listed += map(self._suppressed_finding, suppressed)
        self._count(reached, len(workspace.findings) - len(reached), len(suppressed))
        self._show_summary()
        self._delegate.may_edit = workspace.may_edit
        opened = self._opened()
        current = self.view.currentIndex()
        group, finding = ("", None)
        if current.isValid():
            group, finding = self.model.group(current).key, self.model.finding(current)
        row = (current.parent() if current.parent().isValid() else current).row()
        # Read before the reset, which sets it to 0.
        scrolled = self.view.verticalScrollBar().value()
        if self.model.show_findings(listed):
            self._restore(opened, group, finding, row, current.row())
            self.view.verticalScrollBar().setValue(scrolled)
        self._pages.setCurrentIndex(0 if self.model.groups else 1)
        self.setFocusProxy(self.view if self.model.groups else self.empty)
        if not self.model.groups:
            self._show_why_empty(len(reached))

    def _opened(self) -> set[str]:
        """Return the keys of the groups that are folded out."""
        groups = enumerate(self.model.groups)
        return {group.key for n, group in groups if self.view.isExpanded(self.model.index(n, 0))}

    def _expand(self, opened: set[str]) -> None:
        for n, group in enumerate(self.model.groups):
            if group.key in opened:
                self.view.setExpanded(self.model.index(n, 0), True)

    def _restore(self, opened: set[str], group: str, finding: Finding | None, row: int, place: int) -> None:
        """Open and select the same rows again; a finding that has ended leaves its place to the next one."""
        groups = [each.key for each in self.model.groups]
        if not groups:
            return
        self._expand(opened)
        found = groups.index(group) if group in groups else None
        index = self.model.index(min(max(row, 0), len(groups) - 1) if found is None else found, 0)
        if found is not None and finding is not None:
            keys = [each.key for each in self.model.groups[found].findings]
            child = keys.index(finding.key) if finding.key in keys else min(place, len(keys) - 1)
            index = self.model.index(child, 0, index)
        self.view.setCurrentIndex(index)

    def _count(self, reached: list[Finding], waiting: int, suppressed: int) -> None:
        for severity, made in self.chips.items():
            number = sum(f.severity == severity for f in reached) - (
                # The finding of values that are not set has its own line, and is not counted as a
                # recommendation.
                severity == "advice" and bool(addresses_not_set(reached))
            )
            made.setText(str(number))
            made.setVisible(number > 0)
            text = counted(number, severity, none="no")
            made.setAccessibleName(text)
            made.setToolTip(self.tr("{count}; press to leave them out or list them again").format(count=text))
        self.suppressed.setText(self.tr("{number} suppressed").format(number=suppressed))
        self.suppressed.setVisible(suppressed > 0)
        now = self._workspace.progress
        steps = ", ".join(map(str, now.deferred_to))
        text = self.tr("{number} as delivered, to be set in steps {steps}", "", len(now.deferred_to))
        self.hint.setText(text.format(number=waiting, steps=steps) if waiting else "")
        self.hint.setToolTip(worded(delivered_text(now.deferred, now.deferred_to)))
        self.several.setEnabled(self._workspace.may_edit and any(finding.fix for finding in reached))

    def _show_why_empty(self, number: int) -> None:
        shade, link = colour("dim").name(), colour("sel").name()
        count = len(addresses_not_set(self._workspace.findings))
        if number > (1 if count else 0):
            text = self.tr("No findings with these filters.")
            text += f' <a style="color:{link}" href="all">{self.tr("Show all")}</a>'
        else:
            text = self.tr("No findings.")
            if count:
                more = self.tr("{number} active parameters are not set.").format(number=count)
                text += f' <span style="color:{shade}">{more}</span>'
                text += f' <a style="color:{link}" href="unset">{self.tr("Show them")}</a>'
        self.empty.setText(text)

    def _follow(self, link: str) -> None:
        if link == "unset":
            self.not_set_requested.emit()
            return
        self.show_all()

    def show_all(self) -> None:
        """List the findings of the whole file, of every severity."""
        for made in self.chips.values():
            made.setChecked(True)
        self.scope.show_choice("file")
        self._refresh()

    # -- the selected row --------------------------------------------------------------

    def current(self) -> Finding | None:
        """Return the selected finding; the first one of a selected rule."""
        found = self.current_findings()
        return found[0] if found else None

    def current_findings(self) -> tuple[Finding, ...]:
        """Return the selected finding, or all of the selected rule."""
        index = self.view.currentIndex()
        return self.model.findings_of(index) if index.isValid() else ()

    def select(self, finding: Finding) -> None:
        """Select the row of a finding, if it is listed."""
        for n, group in enumerate(self.model.groups):
            if finding in group.findings:
                rule = self.model.index(n, 0)
                own = self.model.index(group.findings.index(finding), 0, rule)
                # Of a rule with one finding the row of the rule has all of it.
                self.view.setCurrentIndex(own if len(group.findings) > 1 else rule)

    def step(self, by: int) -> None:
        """Go to the next rule that is not met, or to the one before, and to the value that causes it."""
        current = self.view.currentIndex()
        row = (current.parent() if current.parent().isValid() else current).row()
        if self.model.groups:
            self.view.setCurrentIndex(self.model.index((row + by) % len(self.model.groups), 0))
            self._activate()

    def fix(self) -> None:
        """Ask to apply the suggested fixes of the selected row."""
        able = tuple(finding for finding in self.current_findings() if finding.fix)
        if able and self._workspace.may_edit:
            self.fix_requested.emit(able)

    def explain(self) -> None:
        """Ask for the explanation of the selected finding."""
        if (finding := self.current()) is not None:
            self.explanation_requested.emit(finding)

    def suppress(self) -> None:
        """Ask to suppress the selected finding."""
        if (finding := self.current()) is not None and self._may_suppress(finding):
            self.suppression_requested.emit(finding)

    def _may_suppress(self, finding: Finding) -> bool:
        # A finding about rules.yaml itself cannot be suppressed in that file.
        return finding in self._workspace.findings and not finding.rule.startswith("rules.")

    def _activate(self, *_: object) -> None:
        if (finding := self.current()) is not None:
            self.activated.emit(finding)

    def _act(self, part: Part, index: QModelIndex) -> None:
        """Do what was clicked in a row, which is the selected one then."""
        self.view.setCurrentIndex(index)
        {"fix": self.fix, "why": self.explain, "go": self._activate, "more": self._menu_below}[part]()

    def _menu_below(self) -> None:
        place = self.view.visualRect(self.view.currentIndex()).bottomRight()
        self._menu(self.view.viewport().mapToGlobal(place))

    def menu(self) -> QMenu:
        """Return what can be done with the selected row."""
        menu, finding = QMenu(self), self.current()
        able = bool(finding and self._workspace.may_edit and any(f.fix for f in self.current_findings()))
        for text, act, keys, can in (
            (self.tr("&Go to"), self._activate, self.tr("Enter"), bool(finding and finding.addresses)),
            (self.tr("&Why"), self.explain, "Shift+F1", finding is not None),
            (self.tr("Fi&x"), self.fix, "F8", able),
            (self.tr("&Suppress…"), self.suppress, "", bool(finding and self._may_suppress(finding))),
        ):
            action = menu.addAction(f"{text}\t{keys}" if keys else text, act)
            action.setEnabled(can)
        return menu

    def _menu(self, place: QPoint) -> None:
        if self.current() is not None:
            menu = self.menu()
            pop_up(menu, place)
