"""Where a value is, as a person calls it."""

from __future__ import annotations

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, axis_name


def place_of(file: ParameterFile, address: Address) -> str:
    """Return the letter of the axis, or what else an instance is called;
    empty for the only one of the control.
    """
    here = file.machine_schema
    if address[1] and here.kin(here.scopes[address[0]], "axis"):
        name = axis_name(file.evaluation, address[1])
        if name:
            return name
    return here.instance_label(address)
