"""What the edit menu does with the selected cells: copy, paste, fill, set to default, clear.
One step to undo each.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from itertools import pairwise

from PySide6.QtCore import QMimeData, Qt
from PySide6.QtGui import QCursor, QGuiApplication
from PySide6.QtWidgets import QMenu

from amp_studio.files import (
    BlockEntry,
    alike_axes,
    axis_instances,
    describe,
    fitted_axes,
    plan_entry,
    plan_values,
)
from amp_studio.formats import BlockCell, block_html, block_text, read_block, two_ways
from amp_studio.schema import Address, InvalidValueError, Value, quoted, write_value
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.translated import tr
from amp_studio.ui.table.block_preview import BlockPreview
from amp_studio.ui.table.parameter_table import ParameterTable
from amp_studio.ui.window.studio_window import StudioWindow

AddressBlock = Sequence[Sequence[Address | None]]
_LISTED = 4
"""Refusals that a message lists."""


class RangeEdits:
    """The actions on the selected cells of the table in front."""

    def __init__(self, window: StudioWindow) -> None:
        self.window = window

    def _selected(self) -> list[Address]:
        found = self.window.page_in_front.table_view.cells.addresses()
        if not found:
            raise ValueError(tr("Select a value in the table first."))
        return found

    # -- copy --------------------------------------------------------------------

    def copy(self) -> None:
        """Copy the selected values, exact and with their units; raises ValueError where there are none."""
        self._selected()
        self._put(self.window.page_in_front.table_view.cells.block(), [])

    def copy_with_names(self) -> None:
        """Copy the selected values with the numbers and names of parameters and the heads of the axes."""
        page = self.window.page_in_front
        table, view = page.table, page.table_view
        block = view.cells.block()
        block = [row for row in block if any(row)]
        if not block:
            raise ValueError(tr("Select a value in the table first."))
        places = [table.index_of(next(filter(None, row))) for row in block]
        chosen = [(n, table.index_of(a).column()) for row in block for n, a in enumerate(row) if a]
        left, first = (min(column) for column in zip(*chosen, strict=True))
        columns = range(first - left, first - left + len(block[0]))
        heads = [tr("No."), tr("Parameter"), *(" ".join(filter(None, table.column_head(c))) for c in columns)]
        names = [[table.number(i.row()), table.row_name(i.row())] for i in places]
        self._put(block, [heads, *names])

    def _put(self, block: AddressBlock, names: list[list[str]]) -> None:
        """Put a block into the clipboard; a secret alone is refused, among others it is left out."""
        self._leave_out_secrets([address for row in block for address in row if address is not None])
        cells = [[self._cell(address) for address in row] for row in block]
        if names:
            heads = [[BlockCell(text) for text in names[0]]]
            cells = heads + [
                [*map(BlockCell, name), *row] for name, row in zip(names[1:], cells, strict=True)
            ]
        data = QMimeData()
        is_one = len(cells) == 1 and len(cells[0]) == 1
        data.setText(cells[0][0].text if is_one else block_text(cells))
        one = cells[0][0]
        # To a German spreadsheet 2.5 is a text, or 2 May.
        if not is_one or (one.number is not None and not one.unit):
            data.setHtml(block_html(cells, heads=bool(names)))
        QGuiApplication.clipboard().setMimeData(data)

    def _leave_out_secrets(self, chosen: list[Address]) -> None:
        """Show that secrets are left out; raises ValueError for one alone."""
        workspace = self.window.page_in_front.workspace
        masked = [*filter(workspace.is_masked, chosen)]
        if masked and len(chosen) == 1:
            name = describe(workspace.file, masked[0])
            raise ValueError(
                tr("{name} is secret. To copy it, first switch on Show Secrets.").format(name=name)
            )
        if masked:
            self.window.show_status(tr("Secrets are left out; Show Secrets takes them along."))

    def _cell(self, address: Address | None) -> BlockCell:
        page = self.window.page_in_front
        workspace = page.workspace
        if address is None or workspace.is_masked(address):
            return BlockCell("")
        value = page.table.values.in_units(address, workspace.file.get(address))
        if value is None:
            return BlockCell("not set")
        text = page.table.typed_value(address)
        is_number = not isinstance(value.value, (str, bool)) and not text.startswith("0x")
        return BlockCell(text, value.value if is_number else None, value.unit)  # type: ignore[arg-type]  # a number

    # -- paste -------------------------------------------------------------------

    def paste(self) -> None:
        """Set values from the clipboard; a block is shown first, with what would change and what is
        refused.
        """
        data = QGuiApplication.clipboard().mimeData()
        # A clipboard that nothing was ever copied into has no content at all.
        rows = read_block(data.text(), data.html() if data.hasHtml() else "") if data else []
        if not any(cell.strip() for row in rows for cell in row):
            raise ValueError(tr("There is no text to paste."))
        self._selected()
        texts, left_out = self._targets(rows)
        doubtful = two_ways(rows)
        entry = self._planned(texts, doubtful)
        if len(entry.cells) == 1 and not left_out:
            self._apply(entry)
        elif run_dialog(BlockPreview(self.window.page_in_front.workspace, entry, left_out, self.window)):
            self.window.page_in_front.workspace.take(entry)

    def _planned(self, texts: Mapping[Address, str], doubtful: set[str]) -> BlockEntry:
        page = self.window.page_in_front
        workspace = page.workspace

        def read(address: Address, text: str) -> Value | None:
            if text in doubtful:
                raise InvalidValueError(
                    f"{quoted(text)} can be read two ways, as other cells have a decimal comma: write it"
                    " without groups"
                )
            if text == page.table.typed_value(address):
                return workspace.file.get(address)  # in another unit what is shown is rounded to nine digits
            return workspace.read_plain(address, text)

        return plan_entry(workspace.file, texts, read)

    def _targets(self, rows: list[list[str]]) -> tuple[dict[Address, str], list[str]]:
        """Return the text for each address, and what of the block has no place in the table."""
        view = self.window.page_in_front.table_view
        if [cell.strip() for cell in rows[0][:2]] == [tr("No."), tr("Parameter")] and len(rows[0]) > 2:
            return self._by_name(rows)
        chosen = view.cells.block()
        height, width = len(rows), len(rows[0])
        if len(chosen) % height == 0 and len(chosen[0]) % width == 0 and chosen:
            block: AddressBlock = chosen  # the range is filled with the block, as often as it fits
        else:
            block = view.cells.block_from(height, width)
        below = max(0, height - len(block)) * width
        right = max(0, width - max(map(len, block), default=0)) * len(block)
        return _texts_of(block, rows), _beyond_the_table(below + right)

    def _by_name(self, rows: list[list[str]]) -> tuple[dict[Address, str], list[str]]:
        """Return the text for each address of a block that has numbers and heads, wherever its rows are
        now.
        """
        table = self.window.page_in_front.table
        columns, numbers = _columns_by_head(table), _rows_by_name(table)
        found, left_out = {}, []
        for row_texts in rows[1:]:
            number, name = row_texts[0].strip(), row_texts[1].strip()
            place = numbers.get((number, name))
            if place is None:
                left_out.append(tr("{name} is not in this list.").format(name=f"{number} {name}".strip()))
                continue
            for head, text in zip(rows[0][2:], row_texts[2:], strict=False):
                column = _column(columns, head)
                address = table.address_at(place, column) if column is not None else None
                if text.strip() and address is not None:
                    found[address] = text.strip()
        unknown = [h.strip() for h in rows[0][2:] if h.strip() and _column(columns, h) is None]
        return found, left_out + [tr("There is no column {head}.").format(head=head) for head in unknown]

    # -- fill --------------------------------------------------------------------

    def fill_down(self) -> None:
        """Give every selected cell the value of the top one; a single row gets that of the row above."""
        self._fill_lines(self.window.page_in_front.table_view.cells.block_to_fill(down=True))

    def fill_across(self) -> None:
        """Give every selected cell the value of the leftmost one;
        a single column gets that of the axis before it.
        """
        block = self.window.page_in_front.table_view.cells.block_to_fill(down=False)
        self._fill_lines([list(column) for column in zip(*block, strict=True)])

    def _fill_lines(self, lines: AddressBlock) -> None:
        pairs: dict[Address, Address] = {}
        for before, line in pairwise(lines):
            for source, target in zip(before, line, strict=True):
                if source is not None and target is not None:
                    pairs[target] = pairs.get(source, source)
        if not pairs:
            raise ValueError(tr("Select the cell with the value and those to fill."))
        self.fill_from(pairs)

    def fill_from(self, pairs: Mapping[Address, Address]) -> None:
        """Give each target the value of its source, all or none: what is refused is listed,
        and nothing is changed.
        """
        workspace = self.window.page_in_front.workspace
        file, texts = workspace.file, {}
        for target, source in pairs.items():
            parameter = file.schema.parameters[source[0]]
            if parameter.secret and source[0] != target[0]:
                raise ValueError(tr("{name} is secret.").format(name=describe(file, source)))
            texts[target] = write_value(parameter, file.get(source)) or "not set"
        self._apply(self._planned(texts, set()))

    def _apply(self, entry: BlockEntry) -> None:
        """Make a planned change where nothing of it is refused; else list what is."""
        page = self.window.page_in_front
        if not entry.refused:
            page.workspace.take(entry)
            return
        listed = [f"{page.workspace.name_of(c.address)}: {c.problem}" for c in entry.refused[:_LISTED]]
        more = len(entry.refused) - _LISTED
        lines = [*listed, tr("and %n more", "", more)] if more > 0 else listed
        page.bar.say(tr("Nothing was changed. {reasons}.").format(reasons="; ".join(lines)), "error")

    # -- default, not set, other axes ----------------------------------------------

    def offer_defaults(self, addresses: list[Address]) -> None:
        """Offer the way back to the default for each of these values and for all of them, at the pointer."""
        page = self.window.page_in_front
        menu = QMenu(page.table_view)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        way = tr("Back to default: {value}")
        ways = {way.format(value=page.table.values.against_default(a)): [a] for a in addresses}
        if len(addresses) > 1:
            ways[tr("All %n back to their defaults", "", len(addresses))] = addresses
        for text, chosen in ways.items():
            act = partial(self.window.guarded, partial(self.to_default, chosen), tr("Back to Default"))
            menu.addAction(text.replace("&", "&&")).triggered.connect(lambda _=False, act=act: act())
        menu.popup(QCursor.pos())

    def to_default(self, chosen: Sequence[Address] = ()) -> None:
        """Set these values, or the selected ones, to their printed defaults; those without one stay as they
        are.
        """
        workspace, chosen = self.window.page_in_front.workspace, chosen or self._selected()
        wanted = {a: d for a in chosen if (d := workspace.file.default(a)) is not None}
        if not wanted:
            name = describe(workspace.file, chosen[0])
            raise ValueError(
                tr("No default is printed for {name}. Press Delete to clear the value.").format(name=name)
            )
        self._apply(plan_values(workspace.file, wanted))
        if missing := len(chosen) - len(wanted):
            self.window.show_status(tr("%n values have no printed default and are as before.", "", missing))

    def to_saved(self) -> None:
        """Set the selected values to what they are in the saved file, as one step."""
        workspace, chosen = self.window.page_in_front.workspace, self._selected()
        saved = workspace.document.saved
        wanted = {a: saved.get(a) for a in chosen if saved.get(a) != workspace.file.get(a)}
        if not wanted:
            raise ValueError(tr("What is selected is as in the saved file."))
        self._apply(plan_values(workspace.file, wanted))

    def clear(self) -> None:
        """Clear the selected values: they are not set, and the control keeps its own."""
        workspace = self.window.page_in_front.workspace
        self._apply(plan_values(workspace.file, dict.fromkeys(self._selected())))

    def to_all_axes(self) -> None:
        """Copy the selected value to every fitted axis of the same type."""
        page = self.window.page_in_front
        workspace, address = page.workspace, page.table_view.address()
        file = workspace.file
        fitted = fitted_axes(file) or axis_instances(file)
        if address is None or file.evaluation.scope(address) != "axis" or address[1] not in fitted:
            raise ValueError(tr("Select a value of a fitted axis first."))
        same = [a for a in alike_axes(file, address[1]) if a != address[1]]
        self.fill_from({(address[0], axis): address for axis in same})


def _column(columns: Mapping[str, int], head: str) -> int | None:
    """Return the column of a head as it was copied: the same, or that of the same letter."""
    return columns.get(head.strip(), columns.get(head.strip().partition(" ")[0]))


def _beyond_the_table(count: int) -> list[str]:
    """Return how many cells of a block have no place, in words; nothing where all have one."""
    if not count:
        return []
    return [
        tr("1 cell is beyond the table.") if count == 1 else tr("%n cells are beyond the table.", "", count)
    ]


def _texts_of(block: AddressBlock, rows: list[list[str]]) -> dict[Address, str]:
    """Return the text for each address of a block, which is filled with rows as often as they fit."""
    found: dict[Address, str] = {}
    for r, row in enumerate(block):
        for c, address in enumerate(row):
            text = rows[r % len(rows)][c % len(rows[0])].strip()
            if address is not None and text:
                found[address] = text
    return found


def _columns_by_head(table: ParameterTable) -> dict[str, int]:
    """Return the columns by the letter of their axis, as another file may have X as axis 2, and by their
    whole head.
    """
    heads = [table.column_head(c) for c in range(len(table.columns))]
    columns = {letter: c for c, (letter, _) in enumerate(heads) if letter}
    return columns | {" ".join(filter(None, head)): c for c, head in enumerate(heads)}


def _rows_by_name(table: ParameterTable) -> dict[tuple[str, str], int]:
    """Return the rows by number and name."""
    rows = (n for n, row in enumerate(table.rows) if not row.section)
    return {(table.number(n), table.row_name(n)): n for n in rows}
