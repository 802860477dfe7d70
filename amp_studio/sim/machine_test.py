"""Programs and procedures that try a machine out, made from its file, with what must be seen."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class MachineTestStep:
    """One thing to do at the machine, and what must be seen."""

    do: str
    see: str


@dataclass(frozen=True)
class MachineTest:
    """One program, or a procedure without one; ``refusal`` is why the file does not allow it."""

    name: str
    title: str
    page: str
    lines: tuple[str, ...] = ()
    """The program, as the control reads it."""
    steps: tuple[MachineTestStep, ...] = ()
    notes: tuple[str, ...] = ()
    refusal: str = ""
