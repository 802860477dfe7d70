"""One file and several controls: which, what to do with them, and a table of how it ended."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QFileDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPlainTextEdit,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from amp_studio.ui.base.questions import ask
from amp_studio.ui.base.task import ProgressDialog, TaskProgress
from amp_studio.ui.base.theme import severity_icon
from amp_studio.ui.base.translated import counted
from amp_studio.ui.base.workspace import Workspace

if TYPE_CHECKING:
    from amp_studio.transfer.client import ExchangeOf, FleetRow


class FleetDialog(QDialog):
    """Downloads a file to several controls, or compares it with them. Stays open beside the table.

    ``guarded`` runs an action and shows its error; ``is_ready`` asks about unsaved changes and errors before a download.
    """

    def __init__(
        self,
        workspace: Workspace,
        addresses: list[str],
        guarded: Callable[[Callable[[], object], str], object],
        is_ready: Callable[[Workspace], bool],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Several Controls — {name}").format(name=workspace.path.name))
        self.resize(900, 480)
        self._workspace, self._is_ready = workspace, is_ready
        self.rows: list[FleetRow] = []
        self.addresses = QPlainTextEdit("\n".join(addresses))
        self.addresses.setPlaceholderText(self.tr("One address a line: tcp://192.168.0.11:9600"))
        self.addresses.setTabChangesFocus(True)
        self.addresses.setAccessibleName(self.tr("Addresses of the controls"))
        self.addresses.setMaximumHeight(110)
        self.stop = QCheckBox(self.tr("One after the other, and &stop at the first failure"))
        self.stop.setChecked(True)
        self.table = QTreeWidget()
        self.table.setHeaderLabels(
            [self.tr("Control"), self.tr("Result"), "SHA-256", self.tr("How it ended")]
        )
        self.table.setRootIsDecorated(False)
        self.table.setAccessibleName(self.tr("Results"))
        for column in range(3):
            self.table.header().setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        self.verify_button, self.download_button = (
            QPushButton(self.tr("&Verify")),
            QPushButton(self.tr("&Download…")),
        )
        self.save_button, close = QPushButton(self.tr("Save &Table…")), QPushButton(self.tr("&Close"))
        self.save_button.setEnabled(False)
        buttons = QHBoxLayout()
        buttons.addWidget(self.save_button)
        buttons.addStretch()
        for button, act in (
            (self.verify_button, lambda: guarded(self.verify, self.tr("Verify"))),
            (self.download_button, lambda: guarded(self.download, self.tr("Download"))),
            (close, self.close),
        ):
            button.clicked.connect(act)
            buttons.addWidget(button)
        self.save_button.clicked.connect(lambda: guarded(self.save, self.tr("Save Table")))
        for each in (self.verify_button, self.download_button, self.save_button, close):
            each.setAutoDefault(False)
        layout = QVBoxLayout(self)
        layout.addWidget(QLabel(self.tr("Controls, one address a line:")))
        layout.addWidget(self.addresses)
        layout.addWidget(self.stop)
        layout.addWidget(self.table)
        layout.addLayout(buttons)
        workspace.closed.connect(self.close)

    def _named(self) -> list[str]:
        """Return the addresses; raises ValueError."""
        from amp_studio.transfer.client import check_addresses

        found = [line.strip() for line in self.addresses.toPlainText().splitlines() if line.strip()]
        if not found:
            raise ValueError(self.tr("Name at least one control: its address, one a line."))
        check_addresses(found)
        return found

    def verify(self) -> None:
        """Compare the file with what each control contains."""
        from amp_studio.transfer.client import verify_each

        named, file = self._named(), self._workspace.file.copy()
        stop_on_failure = self.stop.isChecked()
        self._run(self.tr("Verify"), lambda of: verify_each(file, named, of, stop_on_failure=stop_on_failure))

    def download(self) -> None:
        """Download the file to each control; what each contained is kept beside the file first."""
        from amp_studio.transfer.client import download_each

        named = self._named()
        if not self._is_ready(self._workspace):
            return
        what = self.tr("Download {name} to {count}?").format(
            name=self._workspace.path.name, count=counted(len(named), "control")
        )
        question = self.tr(
            "{what} All parameters of each are replaced; what it contains now is kept beside the file first."
        ).format(what=what)
        if ask(
            self, self.tr("Download"), question, self.tr("&Download"), self.tr("Cancel"), default=1
        ) != self.tr("&Download"):
            return
        file = self._workspace.file.copy()
        stop_on_failure = self.stop.isChecked()
        self._run(
            self.tr("Download"), lambda of: download_each(file, named, of, stop_on_failure=stop_on_failure)
        )

    def _run(self, title: str, exchange_with_all: Callable[[ExchangeOf], list[FleetRow]]) -> None:
        path = self._workspace.path

        def work(progress: TaskProgress, cancel: threading.Event) -> list[FleetRow]:
            from amp_studio.transfer import Exchange

            shown = _of_each(progress)
            return exchange_with_all(lambda address: Exchange(shown(address), cancel, keep=path, record=path))

        self.rows = ProgressDialog(title, work, self, self.tr("Waiting for the controls …")).run()
        self.table.clear()
        for row in self.rows:
            item = QTreeWidgetItem([row.address, row.word, row.sha256[:12], row.text])
            severity = {"well": None, "differs": "warning", "not tried": "warning"}.get(row.ending, "error")
            if severity is not None:
                item.setIcon(1, severity_icon(severity))
            item.setToolTip(3, row.text)
            self.table.addTopLevelItem(item)
        well = sum(row.ending == "well" for row in self.rows)
        self.table.setAccessibleDescription(
            self.tr("{well} of {count} without a failure").format(
                well=well, count=counted(len(self.rows), "control")
            )
        )
        self.save_button.setEnabled(bool(self.rows))

    def save(self) -> None:
        """Ask for a name and write the table of results."""
        from amp_studio.report import results_paper, write_paper
        from amp_studio.transfer.client import HEADS

        near = str(self._workspace.path.with_name("controls.csv"))
        text, _ = QFileDialog.getSaveFileName(
            self, self.tr("Save table"), near, "Tables (*.csv *.html *.pdf *.xlsx)"
        )
        if text:
            write_paper(
                results_paper(self.tr("Controls"), HEADS, [row.cells for row in self.rows]), Path(text)
            )


def _of_each(progress: TaskProgress) -> Callable[[str], TaskProgress]:
    """Return the progress of each control: its stage with its address before it."""

    def of(address: str) -> TaskProgress:
        def show(stage: str, done: int, total: int) -> None:
            if stage != "silent":
                progress(f"{address}: {stage}", done, total)

        return show

    return of
