"""Steps that a person has ticked as done, in the head of the file."""

from __future__ import annotations

from amp_studio.files import ParameterFile

from .steps import SetupStep


def tick(file: ParameterFile, step: SetupStep, by: str | None) -> bool:
    """Tick a step as done by somebody at some time (``by``), or take the tick away (None);
    returns whether that is new.
    """
    if (file.header.done.get(step.id) is None) == (by is None):
        return False
    others = {name: who for name, who in file.header.done.items() if name != step.id}
    file.header.done = others if by is None else {**others, step.id: by}
    return True
