"""A sheet as plain data: what to key in, one entry after the other, and what has to be done otherwise."""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.schema import Address

from .keying import Instruction, Keyed, Stage


@dataclass(frozen=True)
class SheetEntry:
    """One value to key in.

    ``was``, ``keyed``  what the control's screen shows now (None if it is not known) and is to show
    ``meaning``  the value as the file gives it, if it is something else than what is keyed in
    ``order``    why it comes after another entry than its stage would have it, with the page; "" where
                 nothing needs that
    ``until``    what is broken from here on, and until which entry
    ``is_label`` whether ``meaning`` is a word of the control
    ``place``    the axis or instance with which ``name`` ends; "" for none
    """

    address: Address
    number: str
    name: str
    was: Keyed | None
    keyed: Keyed
    meaning: str
    page: str
    stage: int
    order: str = ""
    until: tuple[str, ...] = ()
    is_label: bool = False
    place: str = ""

    @property
    def old(self) -> str:
        """What the screen shows now; "" if it is not known."""
        return "" if self.was is None else self.was.text

    @property
    def new(self) -> str:
        """What is keyed in."""
        return self.keyed.text

    @property
    def unit(self) -> str:
        """The unit of what is keyed in, as it is shown."""
        return self.keyed.unit


@dataclass(frozen=True)
class LeftOut:
    """A value that differs and is not on the sheet, and why."""

    number: str
    name: str
    why: str
    place: str = ""
    """The axis or instance with which the name ends."""


@dataclass(frozen=True)
class Sheet:
    """All of a sheet.

    ``present``, ``wanted``  whose values they are: what the control contains now, and the file
    ``warnings``  what a person has to know before he begins: errors that are there afterwards
    ``same``     how many values are equal already
    """

    title: str
    family: str
    machine: str
    present: str
    wanted: str
    entries: tuple[SheetEntry, ...]
    left_out: tuple[LeftOut, ...]
    stages: tuple[Stage, ...]
    before: tuple[Instruction, ...]
    after: tuple[Instruction, ...]
    warnings: tuple[str, ...]
    same: int
    family_id: str = ""
