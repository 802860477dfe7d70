"""Values from elsewhere that their parameters do not allow."""

from __future__ import annotations

from amp_studio.schema import Address, fault, written

from .parameter_file import ParameterFile


def out_of_range(file: ParameterFile) -> list[tuple[Address, str]]:
    """Return every value of a file that its parameter does not allow, with one sentence each."""
    found = []
    for address in file.addresses():
        value = file.get(address)
        if value is None or file.evaluation.state(address).state == "hidden":
            continue
        said = fault(file.evaluation, address, value)
        if said:
            found.append((address, f"{file.machine_schema.label(address)} ({written(address)}): {said}"))
    return found
