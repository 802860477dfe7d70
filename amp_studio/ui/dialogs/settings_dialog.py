"""The settings of the user on one page: language, theme and units, keys, passwords, folders."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QDesktopServices, QKeySequence
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QTabWidget,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from amp_studio.files import real_path
from amp_studio.report import OWN
from amp_studio.schema import database_folder
from amp_studio.trouble import log_folder
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.menu_commands import commands
from amp_studio.ui.base.theme import apply_style, as_choice, scheme
from amp_studio.ui.base.translated import LANGUAGES, tr
from amp_studio.ui.forms.form import Field, FieldForm
from amp_studio.ui.window.studio_window import StudioWindow

PAGES = ("general", "keys", "passwords", "folders")
_PLACE = Qt.ItemDataRole.UserRole


class SettingsDialog(QDialog):
    """The settings; each takes effect at once, or its page names when."""

    def __init__(self, window: StudioWindow) -> None:
        super().__init__(window)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(tr("Settings"))
        self.resize(640, 520)
        self._window = window
        self.form = FieldForm(self._fields())
        self.form.entered.connect(self._change)
        self.keys, self.passwords, self.folders = (
            _list(tr("Keys"), tr("Command"), tr("Keys")),
            _list(tr("Passwords"), tr("Control"), tr("Kept")),
            _list(tr("Folders"), tr("What is in it"), tr("Folder")),
        )
        self.search = QLineEdit()
        self.search.setPlaceholderText(tr("Search the commands and their keys"))
        self.search.setAccessibleName(tr("Search the keys"))
        self.search.setClearButtonEnabled(True)
        self.search.textChanged.connect(self._list_keys)
        self.forget = self._button(tr("F&orget the Password"), self._forget)
        show = self._button(tr("&Open the Folder"), self._open_folder)
        self.tabs = QTabWidget()
        self.tabs.setDocumentMode(True)
        general = tr("Theme and units change at once, the language when AMP Studio is started again.")
        kept = tr(
            "Passwords are in the keyring of the system, or known until AMP Studio ends."
            " One that is forgotten is asked for at the next connection."
        )
        for title, hint, widgets in (
            (tr("General"), general, (self.form,)),
            (tr("Keys"), tr("The keys are fixed."), (self.search, self.keys)),
            (tr("Passwords"), kept, (self.passwords, self.forget)),
            (tr("Folders"), tr("Backups and templates are beside the file in front."), (self.folders, show)),
        ):
            self.tabs.addTab(_page(hint, widgets), title)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        in_column(self.tabs, buttons, on=self)
        self._list_keys()
        self._list_folders()
        self.tabs.currentChanged.connect(self._turn)

    def show_page(self, page: str) -> None:
        """Turn to one of the ``PAGES``."""
        self.tabs.setCurrentIndex(PAGES.index(page))

    def _button(self, text: str, act: Callable[[], object]) -> QPushButton:
        button = QPushButton(text)
        button.setAutoDefault(False)
        button.clicked.connect(lambda *_: self._window.guarded(act, self.windowTitle()))
        return button

    # -- general -----------------------------------------------------------------

    def _fields(self) -> tuple[Field, ...]:
        settings, workspace = self._window.settings, self._window.workspace
        languages = (("system", tr("System")), *LANGUAGES.items())
        themes = (("system", tr("System")), ("light", tr("Light")), ("dark", tr("Dark")))
        names = {"metric": tr("Metric (mm)"), "inch": tr("Inch")}
        units = [
            (each, names.get(each, each))
            for each in (workspace.file.schema.family.units if workspace else ())
        ]
        return (
            Field("language", tr("&Language"), "choice", settings.language(), languages),
            Field("theme", tr("&Theme"), "choice", scheme().choice, themes),
            Field(
                "units",
                tr("&Units shown"),
                "choice",
                workspace.file.header.units if workspace else "",
                units,
                tip=tr("Of the file in front"),
                enabled=len(units) > 1,
            ),
        )

    def _change(self, key: str) -> None:
        answer = self.form.answer(key)
        if key == "language":
            self._window.settings.keep_language(answer)
        elif key == "theme":
            _choose_theme(self._window, answer)
        elif self._window.workspace is not None and answer in self._window.workspace.file.schema.family.units:
            self._window.workspace.show_in(answer)

    # -- keys --------------------------------------------------------------------

    def _list_keys(self, *_: object) -> None:
        """List the commands that have keys, with every search word."""
        words, native = self.search.text().casefold().split(), QKeySequence.SequenceFormat.NativeText
        self.keys.clear()
        for path, action in commands(self._window.menuBar()):
            keys = ", ".join(each.toString(native) for each in action.shortcuts())
            if keys and all(word in f"{path} {keys}".casefold() for word in words):
                self.keys.addTopLevelItem(QTreeWidgetItem([path, keys]))
        _choose_first(self.keys)

    # -- passwords ---------------------------------------------------------------

    def _turn(self, page: int) -> None:
        if PAGES[page] == "passwords":  # the keyring may be slow, or ask
            self._window.guarded(self._list_passwords, tr("Passwords"))
        elif PAGES[page] == "folders":
            self.folders.doItemsLayout()  # rows of a list that was not seen have not their height yet

    def _list_passwords(self) -> None:
        """List the known controls whose password is kept, and where."""
        from amp_studio.transfer.links import kept_password, parse_endpoint

        where = {
            "entered": tr("until AMP Studio ends"),
            "environment": tr("in the environment"),
            "keyring": tr("in the keyring"),
        }
        self.passwords.clear()
        for control in self._window.settings.controls():
            kept = kept_password(parse_endpoint(control.address))
            if kept is not None:
                row = QTreeWidgetItem([control.name or control.address, where[kept]])
                row.setData(0, _PLACE, control.address)
                row.setToolTip(0, control.address)
                self.passwords.addTopLevelItem(row)
        self.forget.setEnabled(self.passwords.topLevelItemCount() > 0)
        if not self.passwords.topLevelItemCount():
            self.passwords.addTopLevelItem(QTreeWidgetItem([tr("No password is kept."), ""]))
        _choose_first(self.passwords)

    def _forget(self) -> None:
        from amp_studio.transfer.links import forget_password, parse_endpoint

        row = self.passwords.currentItem()
        if row is not None and (address := row.data(0, _PLACE)):
            forget_password(parse_endpoint(address))
            self._list_passwords()

    # -- folders -----------------------------------------------------------------

    def _folders(self) -> Iterator[tuple[str, Path]]:
        if (workspace := self._window.workspace) is not None:
            beside = real_path(workspace.path).parent
            yield tr("Backups and the builder's own rules"), beside
            yield tr("Templates of reports"), beside / OWN
        yield tr("Facts of the families"), database_folder()
        yield tr("Details of faults (log)"), log_folder()

    def _list_folders(self) -> None:
        for title, folder in self._folders():
            row = QTreeWidgetItem([title, str(folder)])
            row.setData(0, _PLACE, str(folder))
            row.setToolTip(1, str(folder))
            self.folders.addTopLevelItem(row)
        _choose_first(self.folders)

    def _open_folder(self) -> None:
        row = self.folders.currentItem()
        if row is None:
            return
        folder = Path(row.data(0, _PLACE))
        if not folder.is_dir():
            raise ValueError(tr("The folder {folder} does not exist yet.").format(folder=folder))
        QDesktopServices.openUrl(QUrl.fromLocalFile(str(folder)))


def _choose_theme(window: StudioWindow, choice: str) -> None:
    """Show every window in a theme at once, and keep the choice."""
    theme = as_choice(choice)
    apply_style(theme)
    window.settings.keep_theme(theme)


def _list(name: str, *heads: str) -> QTreeWidget:
    made = QTreeWidget()
    made.setAccessibleName(name)
    made.setHeaderLabels(list(heads))
    made.setRootIsDecorated(False)
    made.header().setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
    return made


def _choose_first(rows: QTreeWidget) -> None:
    rows.setCurrentIndex(rows.model().index(0, 0))


def _page(hint: str, widgets: Sequence[QWidget]) -> QWidget:
    page, label = QWidget(), QLabel(hint)
    label.setWordWrap(True)
    column = in_column(*widgets, label, on=page)
    if not any(isinstance(widget, QTreeWidget) for widget in widgets):
        column.addStretch(1)
    return page
