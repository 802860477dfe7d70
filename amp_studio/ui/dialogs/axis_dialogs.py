"""The dialogs of the axis menu: which axis, which name, which type, which servo, which place."""

from __future__ import annotations

from functools import partial

from PySide6.QtWidgets import QWidget

from amp_studio.files import (
    are_alike,
    axis_instances,
    axis_letter,
    axis_title,
    fitted_axes,
    letters_offered,
    places_offered,
    shown_axes,
)
from amp_studio.schema import Address, write_value
from amp_studio.ui.base.translated import tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.choice_box import ChoiceBox
from amp_studio.ui.forms.form import Field, FormDialog


class AxisDialog(FormDialog):
    """Asks for an axis and then for its choices and texts, its letter, or a second axis."""

    def __init__(
        self, workspace: Workspace, title: str, axis: str, parent: QWidget | None = None, hint: str = ""
    ) -> None:
        self._workspace = workspace
        self._axis = Field("axis", tr("&Axis"), "choice", axis, self._axes())
        self._asked_ids: list[str] = []
        super().__init__(title, (self._axis,), title, parent, hint=hint, width=380)
        self.form.entered.connect(self._choose)

    def _axes(self) -> list[tuple[str, str]]:
        file = self._workspace.file
        # An axis that is not there can be given a type; where axes have no types there is nothing to do with
        # it.
        axes = axis_instances(file) if file.schema.family.axes else fitted_axes(file)
        return [(axis, axis_title(file, axis)) for axis in axes]

    def ask_for(self, parameter_ids: list[str]) -> None:
        """Show a field for each of these parameters of the chosen axis; choices are lists."""
        self._asked_ids = parameter_ids
        self.form.offer((self._axis, *(self._field((p, self.axis())) for p in parameter_ids)))

    def _field(self, address: Address) -> Field:
        file, parameter = self._workspace.file, self._workspace.file.schema.parameters[address[0]]
        if parameter.choices:
            editor = partial(ChoiceBox, self._workspace, address)
            return Field(address[0], parameter.name, "choice", None, editor=editor)
        return Field(address[0], parameter.name, default=write_value(parameter, file.get(address)))

    def ask_for_letter(self) -> None:
        """Show a field for the letter of the chosen axis."""
        file = self._workspace.file
        letter = axis_letter(file, self.axis())
        letters = [(each, each) for each in letters_offered(file.schema)]
        self.form.offer((self._axis, Field("letter", tr("&Letter"), "choice", letter, letters)))

    def ask_for_target(self, label: str) -> None:
        """Show a field for another axis."""
        file, own, axes = self._workspace.file, self.axis(), self._axes()
        alike = [axis for axis, _ in axes if axis != own and are_alike(file, axis, own)]
        self.form.offer((self._axis, Field("target", label, "choice", alike[0] if alike else own, axes)))

    def _choose(self, key: str) -> None:
        if key != "axis":
            return
        if self._asked_ids:
            self.ask_for(self._asked_ids)
        elif "letter" in self.form.editors:
            self.form.set_answer("letter", axis_letter(self._workspace.file, self.axis()))

    def axis(self) -> str:
        """Return the chosen axis."""
        return str(self.form.answer("axis"))

    def texts(self) -> dict[Address, str]:
        """Return the chosen label, or the text, of each parameter."""
        given = {parameter_id: self.form.answer(parameter_id) for parameter_id in self._asked_ids}
        return {(key, self.axis()): str(text) for key, text in given.items() if text is not None}


class AddAxisDialog(FormDialog):
    """Asks for the letter and the place of one more axis."""

    def __init__(self, workspace: Workspace, parent: QWidget | None = None) -> None:
        file = workspace.file
        before = tr("Before {axis}")
        places = [
            (place, before.format(axis=axis_title(file, place)) if place in shown_axes(file) else place)
            for place in places_offered(file)
        ]
        letters = letters_offered(file.schema) or [places[0][0]]
        used = {axis_letter(file, axis) for axis in fitted_axes(file)}
        free = next((letter for letter in letters if letter not in used), letters[0])
        fields = (
            Field("letter", tr("&Letter"), "choice", free, [(each, each) for each in letters]),
            Field("place", tr("&Place"), "choice", choices=places),
        )
        super().__init__(tr("Add axis"), fields, tr("A&dd Axis"), parent, width=380)
