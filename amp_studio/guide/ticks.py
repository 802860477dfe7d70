"""Steps that a person has ticked as done, in the head of the file."""

from __future__ import annotations

from amp_studio.files import ParameterFile

from .steps import SetupStep


def tick(file: ParameterFile, step: SetupStep | str, by: str | None) -> bool:
    """Tick a step, or a test at the machine by its id, as done by a person at some time (``by``), or take the
    tick away (None); returns whether that is new.
    """
    key = step if isinstance(step, str) else step.id
    if (file.header.done.get(key) is None) == (by is None):
        return False
    others = {name: who for name, who in file.header.done.items() if name != key}
    file.header.done = others if by is None else {**others, key: by}
    return True
