"""Values from elsewhere that their parameters do not allow, and the walk through them: keep, edit or quit."""

from __future__ import annotations

from typing import Literal, Protocol

from amp_studio.schema import Address, InvalidValueError, fault, written

from .lock import now
from .parameter_file import ParameterFile, RangeError

RangeDecision = Literal["keep", "edit", "quit"]


class RangePrompt(Protocol):
    """Who decides about a value out of range: at a terminal, in dialogs, or an option of the command line."""

    def decide(self, problem: str) -> RangeDecision:
        """Return what happens with the value that has this problem."""
        ...

    def new_value(self, file: ParameterFile, address: Address, problem: str) -> str | None:
        """Return another value as text, None for none."""
        ...

    def refused(self, problem: str) -> None:
        """Read why the other value cannot be taken either."""
        ...


def out_of_range(file: ParameterFile) -> list[tuple[Address, str]]:
    """Return every value of a file that its parameter does not allow, with one sentence each."""
    found = []
    for address in file.addresses():
        value = file.get(address)
        if value is None or file.evaluation.state(address).state == "hidden":
            continue
        message = fault(file.evaluation, address, value)
        if message:
            found.append((address, f"{file.machine_schema.label(address)} ({written(address)}): {message}"))
    return found


def settle(file: ParameterFile, by: str, prompt: RangePrompt) -> bool:
    """Go through the values out of range; each is kept and marked as forced, edited, or ends the walk.

    ``by`` is what brought them (``an upload``). Returns False when the person quits.
    """
    return all(_settled(file, address, problem, by, prompt) for address, problem in out_of_range(file))


def _settled(file: ParameterFile, address: Address, problem: str, by: str, prompt: RangePrompt) -> bool:
    """Ask about one value until it is kept, or edited to one that is allowed; False ends the walk."""
    while (decision := prompt.decide(problem)) == "edit":
        text = prompt.new_value(file, address, problem)
        if text is None:
            continue
        try:
            file.set_checked({address: file.read(address, text)})
        except (InvalidValueError, RangeError) as error:
            prompt.refused(str(error))
        else:
            return True
    if decision == "keep":
        keep(file, [address], by)
    return decision == "keep"


def keep(file: ParameterFile, addresses: list[Address], by: str) -> None:
    """Mark values out of range as forced, with when and by what."""
    file.forced.update({address: f"on {now()} by {by}" for address in addresses})
