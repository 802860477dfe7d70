"""One open file in the window: its table in the middle,
and the panels that the docks show while it is in front.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial

from PySide6.QtCore import Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

from amp_studio.files import axis_letter, describe
from amp_studio.schema import Address, Parameter
from amp_studio.ui.base.figures import write_figure
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.modal import is_alive
from amp_studio.ui.base.places import place_in_words
from amp_studio.ui.base.translated import counted, unit_in_words
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.findings.panel import FindingsPanel
from amp_studio.ui.forms.front_stack import FrontStack
from amp_studio.ui.forms.list_title import ListTitle
from amp_studio.ui.forms.message_bar import MessageBar
from amp_studio.ui.pictures.split import PictureSplit, SidePage
from amp_studio.ui.table.detail_panel import DetailPanel
from amp_studio.ui.table.filter_bar import FilterBar
from amp_studio.ui.table.parameter_table import ParameterTable
from amp_studio.ui.table.value_table import ValueTable
from amp_studio.validate import Finding, addresses_not_set

from .left_panel import LeftPanel
from .page_of_file import PageOfFile

CommitValue = Callable[[Workspace, Address, str], bool]
"""Sets a value of a file from typed text; returns whether it was set."""


class FilePage(QWidget):
    """The views of one workspace. Values go to that workspace alone, whichever page is in front."""

    front_requested = Signal(object)
    """Something in this page was asked for: bring it to the front."""
    changed = Signal(object)
    """Values, findings or the state on disk of this page's file are new."""
    selected = Signal(object)
    """The address of the current cell."""
    listed = Signal()
    """The table shows another group, step or search."""
    turned = Signal()
    """A page in the place of the values was shown, or left."""
    noted = Signal(str)
    """A short text for the status bar."""
    conflict = Signal()
    """A save was refused because another program has changed the file on disk."""

    def __init__(
        self,
        workspace: Workspace,
        commit: CommitValue,
        cell_actions: Iterable[QAction] = (),
        parent: QWidget | None = None,
        places: Mapping[str, QWidget] | None = None,
    ) -> None:
        """Make the page in the widget that will show it, and each panel in its place by the name of its
        dock: Qt applies the style sheet again to all that gets another parent.
        """
        super().__init__(parent)
        places = places or {}
        self.workspace = workspace
        commit_here = partial(commit, workspace)
        self.table = ParameterTable(workspace)
        self.table_view = ValueTable(self.table, cell_actions)
        self.left = LeftPanel(workspace, places.get("Groups"))
        self.groups = self.left.groups
        self.detail = DetailPanel(workspace, commit_here, places.get("Parameter"))
        self.findings = FindingsPanel(workspace, places.get("Findings"))
        self.findings.withhold(workspace.is_deferred)
        self.bar = MessageBar()
        self._title = ""
        self.pictures: SidePage | None = None
        """Beside the table or in its place, once they were asked for."""
        self.pages: dict[str, PageOfFile] = {}
        """Name -> page in the place of the values (motion, tuning, check, program), once it was asked for."""
        self.list_title = ListTitle()
        self.filters = FilterBar(self.list_title, self.table)
        sheet = QWidget()
        in_column(self.filters, self.table_view, on=sheet, margins=0, gap=0)
        self.middle = PictureSplit(sheet)
        self.middle.rearranged.connect(self._focus_front)
        self.middle.rearranged.connect(lambda: self.changed.emit(self))
        self._stack = FrontStack()
        self._stack.addWidget(self.middle)
        in_column(self.bar, (self._stack, 1), on=self, margins=0, gap=0)
        self.setFocusProxy(self.table_view)
        self.left.chosen.connect(self._show_parameters)
        self.left.value_requested.connect(self.go_to)
        self.table_view.selected.connect(self.detail.show_address)
        self.table_view.selected.connect(self.selected)
        self.table_view.range_changed.connect(lambda: self.selected.emit(self.table_view.address()))
        self.table.modelReset.connect(self._update_title)
        self.detail.linked.connect(self.follow)
        self.detail.axis_requested.connect(self.go_to)
        self.findings.activated.connect(self._show_finding)
        self.findings.current_changed.connect(self._outline)
        self.findings.model.modelReset.connect(
            self._outline
        )  # a finding that is gone is no longer the current one
        self.findings.not_set_requested.connect(self.show_not_set)
        self.table.modelReset.connect(self._follow_table)
        self.table_view.selected.connect(self._follow_table)
        workspace.changed.connect(self._follow_values)
        workspace.saved.connect(self._emit_state)
        workspace.undo_stack.indexChanged.connect(
            self._emit_state
        )  # a step is on the stack only after it was made
        self.left.choose()

    def _follow_values(self, *_: object) -> None:
        if not self.workspace.is_stepping:  # else the undo stack has the step, and its signal, in a moment
            self._emit_state()

    def _emit_state(self, *_: object) -> None:
        self.changed.emit(self)

    @property
    def panels(self) -> dict[str, QWidget]:
        """Name of a dock -> what it shows while this page is in front."""
        return {"Groups": self.left, "Parameter": self.detail, "Findings": self.findings}

    @property
    def title(self) -> str:
        """The name on the tab, with a star while there are unsaved changes."""
        return self.workspace.path.name + ("*" if self.workspace.is_dirty else "")

    # -- what the table shows ----------------------------------------------------

    def _show_parameters(self, title: str, parameters: list[Parameter]) -> None:
        self._title = title
        if parameters == self.table.asked:
            self._update_title()
        else:
            self.table.show_parameters(parameters)
            self.listed.emit()

    @property
    def listed_title(self) -> str:
        """The name of what the table shows: a group, a step, a search."""
        return self._title

    def show_list(self, title: str, parameters: list[Parameter], address: Address) -> None:
        """Show again what the table showed before, at one of its cells."""
        self.uncover()
        if parameters != self.table.asked:
            self.left.show_place_of(address[0])
        if parameters != self.table.asked:
            self.groups.show_none()
            self._show_parameters(title, parameters)
        self.select(address)
        self.table_view.setFocus()

    def _outline(self, *_: object) -> None:
        """Outline the cells that the selected finding reads besides those at fault,
        which are coloured anyway.
        """
        found = self.findings.current_findings()
        causes = {a for finding in found for a in finding.causes}
        read = {a for finding in found for a in finding.addresses} - causes
        self.table.outline(frozenset(read), found[0].severity if found else "")

    def show_not_set(self) -> None:
        """Show the active parameters that are not set."""
        self.front_requested.emit(self)
        self.uncover()
        ids = dict.fromkeys(address[0] for address in addresses_not_set(self.workspace.findings))
        self._show_parameters(self.tr("Not set"), [self.workspace.file.schema.parameters[i] for i in ids])

    def show_found(self, words: str, ids: Iterable[str]) -> None:
        """Show the parameters that were found for some words."""
        self.front_requested.emit(self)
        self.uncover()
        self.groups.show_none()
        title = self.tr("Found: {words}").format(words=words)
        self._show_parameters(title, [self.workspace.file.schema.parameters[i] for i in ids])
        self.table_view.setFocus()

    def _follow_table(self, *_: object) -> None:
        """Let the findings know what the table shows, and the axis of its current cell."""
        address, file = self.table_view.address(), self.workspace.file
        is_of_axis = address is not None and file.evaluation.scope(address) == "axis"
        axis = axis_letter(file, address[1]) or address[1] if address is not None and is_of_axis else ""
        name = self.tr("Step") if self.left.side == "steps" else self.tr("Group")
        self.findings.follow(frozenset(parameter.id for parameter in self.table.asked), axis, name)

    def _update_title(self) -> None:
        count, hidden = self.table.count, self.table.hidden_rows
        more = self.tr(", {hidden} hidden (Ctrl+H shows them)").format(hidden=hidden) if hidden else ""
        if self.filters.active:
            more += self.tr(", filtered (Ctrl+0 shows all)")
        what = counted(count, "parameter", none="no")
        if self.table.common_command:
            more += self.tr(", read by {command}").format(command=self.table.common_command)
        self.list_title.show_title(self._title, f"{what}{more}")
        self.filters.fit()

    def show_columns(self, shows_every_axis: bool, hidden_too: bool) -> None:
        """Show unfitted axes and hidden parameters, or leave them out."""
        if (self.table.shows_every_axis, self.table.hidden_too) != (shows_every_axis, hidden_too):
            self.table.shows_every_axis, self.table.hidden_too = shows_every_axis, hidden_too
            self.table.show_again()
            self.changed.emit(self)

    # -- pictures beside it --------------------------------------------------------

    @property
    def shows_pictures(self) -> bool:
        """Whether the pictures are shown."""
        return self.middle.is_shown

    def take_pictures(self, pictures: SidePage) -> None:
        """Take the page of pictures in, hidden."""
        self.pictures = pictures
        self.middle.take(pictures)

    def show_pictures(self, wanted: bool) -> None:
        """Show the pictures, or the table alone."""
        if self.pictures is not None and wanted != self.shows_pictures:
            self.middle.show_pictures(wanted)

    # -- pages in the place of the values ------------------------------------------

    @property
    def turned_to(self) -> str:
        """The name of the page in the place of the values; empty for the values."""
        front = self._stack.currentWidget()
        return next((name for name, page in self.pages.items() if page is front), "")

    def take_page(self, name: str, page: PageOfFile) -> None:
        """Take a page in, hidden."""
        self.pages[name] = page
        self._stack.addWidget(page)

    def show_page(self, name: str) -> None:
        """Show a page that was taken in, or the values again (``""``)."""
        before = self.pages.get(self.turned_to)
        if name != self.turned_to and (before is None or before.may_turn_away()):
            if before is not None:
                before.turned_away()
            self._stack.setCurrentWidget(self.pages[name] if name else self.middle)
            self.turned.emit()
            self._focus_front()

    def may_leave(self) -> bool:
        """Ask the pages that have work which would be lost; returns whether the file may be closed."""
        return all(page.may_leave() for page in self.pages.values())

    def uncover(self) -> None:
        """Show the table where the pictures or a page are in its place."""
        self.show_page("")
        if self.middle.covers:
            self.show_pictures(False)

    def _focus_front(self) -> None:
        """Give the keyboard to what is seen."""
        values = self.pictures if self.middle.covers and self.pictures is not None else self.table_view
        front = self.pages.get(self.turned_to, values)
        if self.focusProxy() is not front:
            self.setFocusProxy(front)
            front.setFocus()

    # -- selection -------------------------------------------------------------

    def address_text(self) -> str:
        """Return the selected value for the status bar: what it is, and where."""
        address, file = self.table_view.address(), self.workspace.file
        if address is None:
            return ""
        if len(chosen := self.table_view.cells.addresses()) > 1:
            return self._range_text(chosen)
        place = place_in_words(file, address)
        return "   ".join(text for text in (describe(file, address), place) if text)

    def _count_text(self, chosen: list[Address]) -> str:
        """Return how many cells are selected, and of which parameter where it is one."""
        if len({a[0] for a in chosen}) > 1:
            return self.tr("%n cells", "", len(chosen))
        ends = [axis_letter(self.workspace.file, a[1]) for a in (chosen[0], chosen[-1])]
        name = describe(self.workspace.file, chosen[0])
        span = self.tr("{first} to {last}").format(first=ends[0], last=ends[1]) if all(ends) else ""
        of = ", ".join(filter(None, (name, span)))
        return self.tr("%n cells of {name}", "", len(chosen)).format(name=of)

    def _range_text(self, chosen: list[Address]) -> str:
        """Return how many cells are selected, and the least and largest number where all have one unit."""
        values = [
            v for a in chosen if (v := self.table.values.in_units(a, self.workspace.file.get(a))) is not None
        ]
        numbers = [v.value for v in values if not isinstance(v.value, (str, bool))]
        parts = [self._count_text(chosen)]
        if numbers and len(numbers) == len(values) and len({v.unit for v in values}) == 1:
            unit = f" {unit_in_words(values[0].unit)}" if values[0].unit else ""
            parts.append(self.tr("min {number}").format(number=f"{write_figure(min(numbers))}{unit}"))
            parts.append(self.tr("max {number}").format(number=f"{write_figure(max(numbers))}{unit}"))
        return "   ".join(parts)

    def go_to(self, address: Address) -> None:
        """Select an address and come to the front; shows its group when the table does not contain it."""
        if not is_alive(self):  # asked by an explanation that is still open
            return
        self.front_requested.emit(self)
        self.uncover()
        self.select(address)

    def select(self, address: Address) -> None:
        """Select an address in the table, wherever the focus is;
        shows its group when the table does not contain it.
        """
        if not self.table.index_of(address).isValid() and self.filters.active:
            self.filters.clear()
        if not self.table.index_of(address).isValid():
            self.left.show_place_of(address[0])
        if not self.table.values.exists(address):
            self.show_columns(self.table.shows_every_axis, hidden_too=True)
        if not self.table.index_of(address).isValid():
            self.show_columns(True, self.table.hidden_too)
        index = self.table.index_of(address)
        if index.isValid():
            self.table_view.setCurrentIndex(index)
            self.table_view.scrollTo(index)
        else:
            self.noted.emit(
                self.tr("{describe} is not available on this machine type").format(
                    describe=describe(self.workspace.file, address)
                )
            )

    def follow(self, parameter_id: str) -> None:
        """Go to a parameter, in the selected axis if it exists there."""
        file, here = self.workspace.file, self.table_view.address()
        instances = file.machine_schema.instances(file.schema.parameters[parameter_id])
        if instances:
            self.go_to((parameter_id, here[1] if here and here[1] in instances else instances[0]))
        else:
            name = file.schema.parameters[parameter_id].name
            self.noted.emit(self.tr("{name} is not available on this machine type").format(name=name))

    def _show_finding(self, finding: Finding) -> None:
        if finding.addresses:
            self.go_to(finding.addresses[0])
            self.table_view.setFocus()
