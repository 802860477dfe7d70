"""The dialog for a new file: control, machine type, axes, units, like what, and where it will be."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QLineEdit, QWidget

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
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.translated import message_in_words, tr, worded
from amp_studio.ui.forms.form import Field, FormDialog

from .file_dialogs import family_choices

_OTHER = "other"


def read_families() -> None:
    """Read the facts of all families and the list of examples, a third of a second the first time."""
    for family in family_ids():
        load_schema(family)
    examples()


class NewFileDialog(FormDialog):
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
        self._project, self._recent = project, recent or []
        fields = (
            Field("family", tr("&Control"), "choice", family, family_choices()),
            Field("machine", tr("&Machine type"), "choice"),
            Field("axes", tr("&Axes")),
            Field("hint", "", "words"),
            Field("units", tr("&Units shown"), "choice"),
            Field("like", tr("&Like"), "choice"),
            Field("name", tr("&Name"), default="MACHINE_1"),
            Field("place", "", "words"),
        )
        super().__init__(tr("New parameter file"), fields, tr("Create &File"), parent, width=560)
        self.form.entered.connect(self._choose)
        self._choose_family()

    # -- what is offered -------------------------------------------------------------

    @property
    def _schema(self) -> Schema:
        return load_schema(self.form.answer("family"))

    def _choose(self, key: str) -> None:
        if key == "family":
            self._choose_family()
        elif key == "like":
            self._choose_like()

    def _choose_family(self) -> None:
        """Offer what the chosen family has."""
        family = self._schema.family
        machines = [(machine.key, machine.name) for machine in family.machines]
        self.form.offer_choices("machine", machines, family.default_machine)
        self.form.offer_choices("units", [(each, self._system(each)) for each in family.units], "metric")
        self.form.offer_choices("like", self._likes(), None)
        one_system = self.tr("{family} has one system of units").format(family=family.name)
        self.form.enable("units", len(family.units) > 1, one_system)
        self._show_like()

    def _system(self, system: str) -> str:
        return {"metric": self.tr("Metric (mm)"), "inch": self.tr("Inch")}.get(system, system)

    def _likes(self) -> list[tuple[object, str]]:
        family = self.form.answer("family")
        title = self.tr("Example: {title}")
        return [
            (None, self.tr("The printed defaults")),
            *(
                (e.path, title.format(title=worded(e.title, family)))
                for e in examples()
                if e.family == family
            ),
            *((path, path.name) for path in self._recent),
            (_OTHER, self.tr("Another file of mine…")),
        ]

    def _choose_like(self) -> None:
        """Ask for the file when another one is wanted."""
        if self.form.answer("like") == _OTHER:
            path = ask_to_open(self, self.tr("Like which file"), "", f"(*{ENDING})")
            if path:
                self._recent.append(path)
            # Nothing chosen goes back to the defaults: "Another file" itself is no source.
            self.form.offer_choices("like", self._likes(), path)
        self._show_like()

    def source(self) -> Path | None:
        """Return the file that the new one is to be like; None for the printed defaults."""
        found = self.form.answer("like")
        return found if isinstance(found, Path) else None

    def _show_like(self) -> None:
        """A file like another one has its machine type, axes and units."""
        source, fixed, family = self.source(), why_axes_are_fixed(self._schema), self._schema.family
        self.form.enable("machine", source is None and len(family.machines) > 1)
        self.form.enable("axes", source is None and not fixed)
        if source is not None:
            self.form.enable("units", False)
            hint = self.tr("Machine type, axes and units are those of {name}. Not taken over: {own}.").format(
                name=source.name, own=", ".join(p.name for p in of_one_machine(self._schema))
            )
        elif fixed:
            hint = self.tr("{reason}.").format(reason=message_in_words(fixed))
        else:
            hint = self._hint_of_axes()
        self.form.set_answer("hint", hint)
        hint = "" if fixed else self.tr("Leave empty for the default axes")
        self.form.editor("axes", QLineEdit).setPlaceholderText(hint)
        self.check()

    def _hint_of_axes(self) -> str:
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
        name, source = self.form.answer("name"), self.source()
        # Its own facts decide: axes and machine type of the form are off.
        if source is not None:
            like = open_file(source).file
            if like.schema.family.family != self.form.answer("family"):
                raise ValueError(
                    self.tr("{file} is a file for {family}.").format(
                        file=source.name, family=like.schema.family.name
                    )
                )
            return new_like(like, name)
        given = self.form.answers()
        file = new_file(given["family"], given["machine"], self._axes(), name)
        file.header.units = given["units"] or file.header.units
        return file

    def path(self) -> Path | None:
        """Return where the file will be in the open project; None where the person is asked. Raises
        ValueError for a name that cannot be.
        """
        project = self._project
        if project is None or project.info.family != self.form.answer("family"):
            return None
        path = project.path(self.form.answer("name"))
        if path.exists():
            raise ValueError(
                self.tr("The project already has a file '{name}'. Choose another name.").format(
                    name=path.stem
                )
            )
        return path

    def _axes(self) -> list[str]:
        # What was typed before a family with fixed axes was chosen does not count.
        if not self.form.editors["axes"].isEnabled():
            return []
        return [axis.strip() for axis in self.form.answer("axes").split(",") if axis.strip()]

    def problem(self) -> str:
        """Show what will be written where, and return what is wrong."""
        fault, made, path = "", None, None
        try:
            path, made = self.path(), self.make()
        except (OSError, ValueError) as error:
            fault = str(error)
        if path is not None:
            place = self.tr("{file} in the project folder {folder}").format(
                file=path.name, folder=path.parent
            )
        else:
            name = f"{self.form.answer('name') or 'machine'}{ENDING}"
            place = self.tr("{file}; the folder is asked for next").format(file=name)
        if made is not None and self._axes():
            axes = " ".join(axis_letter(made, a) or a for a in fitted_axes(made))
            place += self.tr("; axes {axes}").format(axes=axes)
        self.form.set_answer("place", place)
        return fault
