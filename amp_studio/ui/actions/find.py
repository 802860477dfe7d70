"""Finding: the box of the tool bar, what it knows of the file in front, and where each hit leads."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from PySide6.QtGui import QAction, QGuiApplication
from PySide6.QtWidgets import QMessageBox

from amp_studio.find import Entry, Finder, Hit, SearchIndex, elsewhere, index_of, prepare_synonyms
from amp_studio.report import facts
from amp_studio.schema import Schema, family_ids, load_schema
from amp_studio.ui.base.menu_commands import commands
from amp_studio.ui.base.modal import is_alive
from amp_studio.ui.base.questions import show_message
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.translated import Translated, tr, worded
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.table.cell_look import prepare_labels
from amp_studio.ui.window.studio_window import StudioWindow
from amp_studio.validate import Validator
from amp_studio.version import __version__

from .find_box import COMMANDS, FindBox
from .find_rows import FindRow, rows_of, title_in_words

_SOON_MS = 1_000
"""Milliseconds after a file was opened until its family is indexed, so that it is painted first."""
_VALUE_LENGTH = 40
"""Characters of a value beside its parameter."""
_MAX_HITS = 30
"""Hits in the file that are worth showing."""
_COMMAND = 0.8
"""What a command is worth among parameters whose words match as well."""


class FindSearch(Translated):
    """Builds the box; the words of a family are indexed in a thread when its first file is opened."""

    def __init__(self, window: StudioWindow) -> None:
        self.window = window
        self.box = FindBox(self.rows, window)
        self.box.chosen.connect(self._go)
        self.box.left.connect(self._focus_table)
        self._finders: dict[FilePage, Finder] = {}
        self._indexed: set[tuple[int, str]] = set()
        self._indexing: set[tuple[int, str]] = set()
        self._soon = single_shot(window, self._index, _SOON_MS)
        """Indexes a family while nothing else is to do; who comes to the box before has it at once."""
        self.box.entered.connect(self._index)
        self._commands: dict[str, QAction] = {}
        self._menu = SearchIndex(())
        self._families: tuple[Finder, ...] | None = None
        """The families without a file, once a message was asked for without one."""
        self._is_read = False
        """Whether the commands are those of the present menus; they are read at the first key,
        as Qt gives the focus at odd moments."""
        self.box.entered.connect(self._forget_menus)

    # -- the files ---------------------------------------------------------------------

    def add(self, page: FilePage) -> None:
        """Know the values of a file, and the words of its family soon."""
        file = page.workspace.file
        self._finders[page] = Finder(file.schema, file.machine, file)
        page.workspace.changed.connect(lambda *_: self._changed(page))
        # The page is the key: without this every file that was closed would stay in memory with its index.
        page.destroyed.connect(lambda: self._finders.pop(page, None))
        page.detail.message_requested.connect(
            lambda message: self._show_message(page.workspace.file.schema, message, page)
        )
        self._soon.start()

    def _changed(self, page: FilePage) -> None:
        file, finder = page.workspace.file, self._finders[page]
        if finder.machine != file.machine:
            self._finders[page] = Finder(file.schema, file.machine, file)
            self._soon.start()
        else:
            finder.forget_values()

    def _index(self) -> None:
        """Index the words of the families of the open files in threads;
        a question that waits for one is asked again.

        What the first edit of a machine type needs is worked out there too.
        """
        for page, finder in self._finders.items():
            key = (id(finder.schema), finder.machine)
            if key not in self._indexed | self._indexing:
                self._indexing.add(key)
                task = Task(partial(_make_ready, finder, page.workspace.validator))
                task.done.connect(partial(self._take_index, key))
                task.begin()

    def _take_index(self, key: tuple[int, str], _: object) -> None:
        self._indexed.add(key)
        if self.box.is_open:
            self.box.search()

    # -- asking --------------------------------------------------------------------------

    def _rows_of_commands(self, query: str) -> list[FindRow]:
        """Return the commands that are found, all of them without a question."""
        hits = self._among(query) if query else [self._hit(entry, 1.0) for entry in self._menu.entries]
        return rows_of(hits, self._commands) or [FindRow(self.box.tr("Nothing found"))]

    def rows(self, query: str) -> list[FindRow]:
        """Return what a question finds: in the file in front and among the commands, or among these alone."""
        self._read_menus()
        own = query.removeprefix(COMMANDS).strip()
        if query.startswith(COMMANDS):
            return self._rows_of_commands(own)
        if self.window.page is None:
            found = self._messages(own) + self._among(own)
            return rows_of(sorted(found, key=lambda hit: -hit.score), self._commands) or self._ways_on_rows(
                own, ""
            )
        finder = self._finder()
        if finder is None:
            return [FindRow(self.box.tr("Preparing the search …"), waits=True)]
        hits = finder.find(own, _MAX_HITS)
        found = [self._with_value(hit, self.window.page) for hit in hits]
        found = sorted(found + self._among(own), key=lambda hit: -hit.score)
        if found:
            family = self.window.page.workspace.file.schema.family.family
            return rows_of(found, self._commands, family) + self._show_all_row(found)
        return self._ways_on_rows(own, finder.nearest(own))

    def _finder(self) -> Finder | None:
        """Return the finder of the file in front once its family is indexed."""
        finder = self._finders.get(self.window.page) if self.window.page is not None else None
        is_ready = finder is not None and (id(finder.schema), finder.machine) in self._indexed
        return finder if is_ready else None

    @staticmethod
    def _with_value(hit: Hit, page: FilePage) -> Hit:
        """Return a parameter that was found with its value, in the current axis where it has one there;
        a value as its cell has it.
        """
        if hit.kind not in ("parameter", "value"):
            return hit
        file, here = page.workspace.file, page.table_view.address()
        instances = file.machine_schema.instances(file.schema.parameters[hit.key])
        instance = here[1] if here is not None and here[1] in instances else instances[0]
        address = hit.address or (hit.key, instance)
        found = file.get(address)
        # A list of points has lines; a row has one.
        value = tr("not set") if found is None else " ".join(page.table.values.text(address, found).split())
        if hit.kind == "value":
            return replace(hit, title=value)
        value = f"{value[:_VALUE_LENGTH]}…" if len(value) > _VALUE_LENGTH else value
        return replace(hit, detail=f"{value}   {hit.detail}")

    def _messages(self, query: str) -> list[Hit]:
        """Return messages of the controls of every family, for who has no file open;
        loaded in a thread at the first question.
        """
        messages = []
        for finder in self._every_finder():
            family = finder.schema.family
            for hit in finder.find(query, _MAX_HITS):
                if hit.kind == "message":
                    detail = f"{family.name}, {hit.detail}"
                    messages.append(replace(hit, key=f"{family.family}:{hit.key}", detail=detail))
        return messages

    def _every_finder(self) -> tuple[Finder, ...]:
        """Return a finder of each family; loaded in a thread at the first question,
        which is asked again then.
        """
        if self._families is None:
            # Empty at once: the next key must not begin the same work again.
            self._families = ()
            task = Task(lambda *_: _every_family())
            task.done.connect(self._take_families)
            task.begin()
        return self._families

    def _take_families(self, finders: tuple[Finder, ...]) -> None:
        self._families = finders
        if self.box.is_open:
            self.box.search()

    def _forget_menus(self) -> None:
        self._is_read = False

    def _read_menus(self) -> None:
        """Learn which commands can be used now, again if a menu was filled again meanwhile:
        its old commands are deleted.
        """
        if self._is_read and all(is_alive(action) for action in self._commands.values()):
            return
        self._is_read = True
        able = [(name, action) for name, action in commands(self.window.menuBar()) if action.isEnabled()]
        self._commands = {str(n): action for n, (_, action) in enumerate(able)}
        self._menu = SearchIndex(
            Entry("command", name, str(n), (("name", name),)) for n, (name, _) in enumerate(able)
        )

    def _among(self, query: str) -> list[Hit]:
        return [self._hit(match.entry, match.score * _COMMAND) for match in self._menu.search(query, 12)]

    @staticmethod
    def _hit(entry: Entry, score: float) -> Hit:
        return Hit("command", entry.title, "", "name", entry.key, score)

    def _show_all_row(self, hits: list[Hit]) -> list[FindRow]:
        """Return the row that shows in the table all parameters that were found, where there are several."""
        ids = tuple(
            dict.fromkeys(hit.key for hit in hits if hit.kind in ("parameter", "value", "choice", "note"))
        )
        # One parameter alone is what Enter on its row shows.
        if len(ids) < 2:
            return []
        text = self.box.tr("Show %n parameters in the table", "", len(ids))
        return [FindRow(text, icon="table", every=ids)]

    def _ways_on_rows(self, query: str, nearest: str) -> list[FindRow]:
        """Return the ways on from a question without an answer: the nearest one, other families,
        where everything is.
        """
        rows = [FindRow(self.box.tr("Nothing found"))]
        if nearest:
            text = self.box.tr("Did you mean “{words}”?").format(words=nearest)
            rows.append(FindRow(text, icon="magnifying-glass", instead=nearest))
        own = self.window.workspace.file.schema.family.family if self.window.workspace is not None else ""
        others = [finder for finder in self._every_finder() if finder.schema.family.family != own]
        for schema, hit in elsewhere(query, others):
            title = title_in_words(hit, schema.family.family)
            text = self.box.tr("In {family}: {title}").format(family=schema.family.name, title=title)
            rows.append(FindRow(text, icon="cpu", hit=hit, family=schema.family.family))
        if self.window.page is not None:
            every = tuple(self.window.page.workspace.file.schema.parameters)
            rows.append(FindRow(self.box.tr("Show all parameters in the table"), icon="table", every=every))
        ask = QAction(self.window)
        ask.triggered.connect(partial(self._copy_question, query, own))
        rows.append(
            FindRow(self.box.tr("Copy this question, to report the word"), icon="note-pencil", action=ask)
        )
        return rows

    def _copy_question(self, query: str, family: str, *_: object) -> None:
        """Put what is needed to report a word that is missing onto the clipboard."""
        text = f"AMP Studio {__version__}, {family or 'no file'}: find {query!r} has no answer"
        QGuiApplication.clipboard().setText(text)
        self.window.show_status(self.box.tr("Copied: {text}").format(text=text))

    # -- going there -----------------------------------------------------------------------

    def _trigger(self, action: QAction) -> None:
        # A menu that is filled when it opens deletes its old actions.
        if not is_alive(action):
            self.box.search()  # its menu was filled again
            return
        self.box.clear()
        self._focus_table()
        action.trigger()

    def _go(self, row: FindRow) -> None:
        if row.action is not None:
            self._trigger(row.action)
        elif row.family and row.hit is not None:
            self._show_fact(row.family, row.hit)
        elif row.hit is not None and self.window.page is None:
            family, _, message = row.hit.key.partition(":")
            self._show_message(load_schema(family), message)
        elif row.every and self.window.page is not None:
            self.window.guarded(
                partial(self.window.page.show_found, self.box.text().strip(), row.every), self.tr("Find")
            )
        elif row.hit is not None and self.window.page is not None:
            self.window.guarded(partial(self._follow, row.hit, self.window.page), self.tr("Find"))

    def _follow(self, hit: Hit, page: FilePage) -> None:
        if hit.kind == "message":
            self._show_message(page.workspace.file.schema, hit.key, page)
            return
        if hit.kind == "group":
            group = next(g for g in page.workspace.file.schema.groups if g.key == hit.key)
            page.left.show_side("groups")
            page.groups.choose_group_of(group.parameters[0].id)
        elif hit.address is not None:
            page.go_to(hit.address)
        else:
            page.follow(hit.key)
        page.table_view.setFocus()

    def _show_fact(self, family: str, hit: Hit) -> None:
        """Show what another family has: a message on its page, a parameter as the manual pages have it."""
        schema = load_schema(family)
        if hit.kind == "message":
            self._show_message(schema, hit.key)
        else:
            parameter = schema.parameters.get(hit.key)
            listed = facts(schema, parameter) if parameter is not None else []
            text = "\n".join(f"{worded(title)}: {fact}" for title, fact in listed) or hit.detail
            show_message(self.window, hit.title, text, QMessageBox.Icon.Information)

    def _show_message(self, schema: Schema, message: str, page: FilePage | None = None) -> None:
        from amp_studio.ui.page.message_page import MessageWindow

        file, beside = page.workspace if page is not None else None, self.window.beside
        asked = (schema.family.family, message)
        if beside.again(MessageWindow, file, asked) is None:
            beside.show(MessageWindow(self.window, schema, message, page), file, asked)

    def _focus_table(self) -> None:
        if self.window.table_view is not None:
            self.window.table_view.setFocus()
        else:
            self.box.clearFocus()


def _every_family() -> tuple[Finder, ...]:
    """Return a finder of each family, with its words indexed."""
    finders = []
    for name in family_ids():
        schema = load_schema(name)
        index_of(schema, schema.family.default_machine)
        finders.append(Finder(schema, schema.family.default_machine))
    return tuple(finders)


def _make_ready(finder: Finder, validator: Validator, *_: object) -> None:
    index_of(finder.schema, finder.machine)
    prepare_synonyms()
    validator.prepare_edits()
    prepare_labels(finder.schema)
