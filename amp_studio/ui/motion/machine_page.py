"""What the control does not know of its machine: a field for each figure, filled by hand,
from a file or from a record.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtWidgets import QDialog, QLabel, QLineEdit, QPushButton, QWidget

from amp_studio.files import ParameterFile
from amp_studio.sim import SimulationError, machine_for, machine_settings, read_machine
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.modal import run_dialog

from .identify_dialog import IdentifyDialog
from .settings import SettingsForm, scrolled


class MachinePage(QWidget):
    """The figures of one axis' machine; an empty field takes what is assumed or given by parameters."""

    def __init__(
        self,
        run: Callable[[], None],
        present: Callable[[], tuple[ParameterFile, str]],
        fail: Callable[[Exception], None],
    ) -> None:
        """``present`` returns the file and the axis that is moved, ``fail`` shows an error."""
        super().__init__()
        self._run, self._present, self._fail = run, present, fail
        self.form = SettingsForm(run)
        self._filled_in: tuple[str, dict[str, str]] = "", {}
        """Axis whose fields were filled in from a record or a file, and the figures."""
        hint = QLabel(
            self.tr(
                "What the control does not know. An empty field takes what is assumed or given by parameters."
            )
        )
        hint.setWordWrap(True)
        self.record, self.open = (
            QPushButton(self.tr("From a Recor&d…")),
            QPushButton(self.tr("&Open Machine…")),
        )
        self.record.setToolTip(self.tr("Find inertia, friction and weight in a record of the drive (CSV)"))
        self.open.setToolTip(self.tr("Take the figures of a machine file (YAML)"))
        self.record.clicked.connect(self.take_record)
        self.open.clicked.connect(self.take_file)
        in_column(hint, in_row(self.record, self.open, 0), scrolled(self.form), on=self)

    def take_record(self) -> None:
        """Ask for a record, show its fit, and take its figures when they are accepted."""
        file, axis = self._present()
        kinds = self.tr("Records (*.csv *.txt);;All files (*)")
        path = ask_to_open(self, self.tr("Record of a Drive"), "", kinds)
        if path is None:
            return
        dialog = IdentifyDialog(file, axis, path, self)
        if run_dialog(dialog) == QDialog.DialogCode.Accepted and dialog.trace is not None:
            self._fill(machine_settings(dialog.trace))

    def take_file(self) -> None:
        """Ask for the file of a machine and take its figures."""
        file, axis = self._present()
        path = ask_to_open(self, self.tr("Machine"), "", self.tr("Machine (*.yaml)"))
        if path is None:
            return
        try:
            _, settings = machine_for(file, read_machine(path), axis)
        except (SimulationError, OSError) as error:
            self._fail(error)
        else:
            self._fill(settings)

    def _fill(self, settings: Mapping[str, str]) -> None:
        """Fill the fields of a machine and simulate with it."""
        # Before the fields: where one is not used, those already filled can be emptied again.
        self._filled_in = self._present()[1], dict(settings)
        for name, text in settings.items():
            field = self.form.editors.get(name)
            if not isinstance(field, QLineEdit):
                self._fail(SimulationError(f"{name} is not used in the simulation of this axis", name))
                return
            field.setText(text)
        self._run()

    def leave_axis(self, axis: str) -> None:
        """Empty the fields that have the machine of another axis than ``axis``,
        unless the user has changed them.
        """
        of, settings = self._filled_in
        if of == axis:
            return
        for name, text in settings.items():
            field = self.form.editors.get(name)
            # What the user has typed over is his: only what was filled in goes.
            if isinstance(field, QLineEdit) and field.text() == text:
                field.clear()
        self._filled_in = axis, {}
