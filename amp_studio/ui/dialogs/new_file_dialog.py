"""The dialog for a new file: control, machine type, axes, units, like what, and where it will be."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QFormLayout,
    QLabel,
    QLineEdit,
    QWidget,
)

from amp_studio.files import (
    ENDING,
    ParameterFile,
    Project,
    axis_letter,
    examples,
    fitted_axes,
    letters_offered,
    new_file,
    new_like,
    of_one_machine,
    open_file,
    parameters_of_axes,
    why_axes_are_fixed,
)
from amp_studio.schema import Schema, family_ids, load_schema
from amp_studio.ui.base.theme import severity_ink

_OTHER = "other"


def read_families() -> None:
    """Read the facts of all families and the list of examples, a third of a second the first time."""
    for family in family_ids():
        load_schema(family)
    examples()


class NewFileDialog(QDialog):
    """Asks for a new file. What a family cannot choose is off, with the reason;
    what is wrong is shown while it is typed.
    """

    def __init__(
        self,
        parent: QWidget | None = None,
        family: str = "",
        *,
        project: Project | None = None,
        recent: list[Path] | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("New parameter file"))
        self.setMinimumWidth(560)
        self._project, self._recent = project, recent or []
        self.family, self.machine, self.units, self.like = (QComboBox() for _ in range(4))
        for each in family_ids():
            self.family.addItem(load_schema(each).family.name, each)
        self.family.setCurrentIndex(max(self.family.findData(family), 0))
        self.axes, self.name = QLineEdit(), QLineEdit("MACHINE_1")
        self.note, self.place, self.fault = QLabel(), QLabel(), QLabel()
        for label in (self.note, self.place, self.fault):
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.create_button = self.buttons.addButton(
            self.tr("Create &File"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self._lay_out()
        self._choose_family()
        self.family.currentIndexChanged.connect(self._choose_family)
        self.like.activated.connect(self._choose_like)
        self.like.currentIndexChanged.connect(self._show_like)
        self.machine.currentIndexChanged.connect(self._check)
        for field in (self.axes, self.name):
            field.textChanged.connect(self._check)

    def _lay_out(self) -> None:
        form = QFormLayout(self)
        for label, field in (
            (self.tr("&Control"), self.family),
            (self.tr("&Machine type"), self.machine),
            (self.tr("&Axes"), self.axes),
        ):
            form.addRow(label, field)
        form.addRow("", self.note)
        for label, field in (
            (self.tr("&Units shown"), self.units),
            (self.tr("&Like"), self.like),
            (self.tr("&Name"), self.name),
        ):
            form.addRow(label, field)
        form.addRow("", self.place)
        form.addRow("", self.fault)
        form.addRow(self.buttons)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)

    # -- what is offered -------------------------------------------------------------

    @property
    def _schema(self) -> Schema:
        return load_schema(str(self.family.currentData()))

    def _choose_family(self, *_: object) -> None:
        """Offer what the chosen family has."""
        family = self._schema.family
        for box, entries, chosen in (
            (self.machine, [(m.name, m.key) for m in family.machines], family.default_machine),
            (self.units, [(self._system(s), s) for s in family.units], "metric"),
            (self.like, self._likes(), None),
        ):
            box.blockSignals(True)
            box.clear()
            for text, key in entries:
                box.addItem(text, key)
            box.setCurrentIndex(max(box.findData(chosen), 0))
            box.blockSignals(False)
        one_system = self.tr("{family} has one system of units").format(family=family.name)
        self.units.setEnabled(len(family.units) > 1)
        self.units.setToolTip("" if len(family.units) > 1 else one_system)
        self._show_like()

    def _system(self, system: str) -> str:
        return {"metric": self.tr("Metric (mm)"), "inch": self.tr("Inch")}.get(system, system)

    def _likes(self) -> list[tuple[str, object]]:
        family = str(self.family.currentData())
        found: list[tuple[str, object]] = [(self.tr("The printed defaults"), None)]
        found += [
            (self.tr("Example: {title}").format(title=e.title), e.path)
            for e in examples()
            if e.family == family
        ]
        return [
            *found,
            *((path.name, path) for path in self._recent),
            (self.tr("Another file of mine…"), _OTHER),
        ]

    def _choose_like(self, index: int) -> None:
        """Ask for the file when another one is wanted."""
        if self.like.itemData(index) != _OTHER:
            return
        text, _ = QFileDialog.getOpenFileName(self, self.tr("Like which file"), "", f"(*{ENDING})")
        if text:
            self.like.insertItem(index, Path(text).name, Path(text))
        self.like.setCurrentIndex(index if text else 0)

    def source(self) -> Path | None:
        """Return the file that the new one is to be like; None for the printed defaults."""
        found = self.like.currentData()
        return found if isinstance(found, Path) else None

    def _show_like(self, *_: object) -> None:
        """A file like another one has its machine type, axes and units."""
        source, fixed = self.source(), why_axes_are_fixed(self._schema)
        self.machine.setEnabled(source is None and self.machine.count() > 1)
        self.axes.setEnabled(source is None and not fixed)
        self.units.setEnabled(source is None and self.units.count() > 1)
        if source is not None:
            self.note.setText(
                self.tr("Machine type, axes and units are those of {name}. Not taken over: {own}.").format(
                    name=source.name, own=", ".join(p.name for p in of_one_machine(self._schema))
                )
            )
        elif fixed:
            self.note.setText(self.tr("{reason}.").format(reason=fixed))
        else:
            self.note.setText(self._axes_note())
        self.axes.setPlaceholderText("" if fixed else self.tr("Leave empty for the default axes"))
        self._check()

    def _axes_note(self) -> str:
        """Return which letters there are, and what they are written to."""
        schema = self._schema
        family, declared = schema.family, schema.family.declared_axes
        letters = letters_offered(schema) or family.scopes["axis"].instances
        names = ", ".join(schema.parameters[p].name for p in parameters_of_axes(schema))
        offered = self.tr("For example X, Y, Z; offered are {letters}.").format(letters=" ".join(letters))
        group = self.tr(" X.2 is X of group 2.") if declared and declared.group else ""
        page = f" ({self.tr('page')} {declared.page})" if declared else ""
        return offered + group + self.tr(" Written to {names}{page}.").format(names=names, page=page)

    # -- what comes of it ------------------------------------------------------------

    def make(self) -> ParameterFile:
        """Return the new file; raises ValueError for axes the family cannot have,
        and for a file that cannot be read.
        """
        name, source = self.name.text().strip(), self.source()
        if source is not None:
            like = open_file(source).file
            if like.schema.family.family != self.family.currentData():
                raise ValueError(
                    self.tr("{file} is a file for {family}.").format(
                        file=source.name, family=like.schema.family.name
                    )
                )
            return new_like(like, name)
        axes = [a.strip() for a in self.axes.text().split(",") if a.strip()] if self.axes.isEnabled() else []
        file = new_file(str(self.family.currentData()), str(self.machine.currentData()), axes, name)
        file.header.units = str(self.units.currentData() or file.header.units)
        return file

    def path(self) -> Path | None:
        """Return where the file will be in the open project; None where the person is asked. Raises
        ValueError for a name that cannot be.
        """
        project = self._project
        if project is None or project.info.family != self.family.currentData():
            return None
        path = project.path(self.name.text().strip())
        if path.exists():
            raise ValueError(
                self.tr("The project already has a file '{name}'. Choose another name.").format(
                    name=path.stem
                )
            )
        return path

    def _check(self, *_: object) -> None:
        """Show what will be written where, or what is wrong."""
        fault, made = "", None
        try:
            path, made = self.path(), self.make()
        except (OSError, ValueError) as error:
            path, fault = None, str(error)
        if path is not None:
            self.place.setText(
                self.tr("{file} in the project folder {folder}").format(file=path.name, folder=path.parent)
            )
        else:
            name = f"{self.name.text().strip() or 'machine'}{ENDING}"
            self.place.setText(self.tr("{file}; the folder is asked for next").format(file=name))
        if made is not None and self.axes.isEnabled() and self.axes.text().strip():
            axes = " ".join(axis_letter(made, a) or a for a in fitted_axes(made))
            self.place.setText(self.place.text() + self.tr("; axes {axes}").format(axes=axes))
        self.fault.setText(fault)
        self.fault.setStyleSheet(f"color: {severity_ink('error').name()}")
        self.fault.setVisible(bool(fault))
        self.create_button.setEnabled(not fault)

    def accept(self) -> None:
        """Close the dialog when the file can be made; what is wrong is shown in it."""
        self._check()
        if self.create_button.isEnabled():
            super().accept()

    def done(self, result: int) -> None:
        """Close the dialog; its input can be read until the next event."""
        super().done(result)
        self.deleteLater()
