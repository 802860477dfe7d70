"""The modal state of a control, and what the codes of a block do after it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, ProgramPath

from .block import BlockReader
from .codes import KnownCode
from .toolpath import CUTTING, EXACT, KEPT, ROUNDED, SLOW
from .words import ProgramBlockError as BlockError
from .words import TypedWord, sentence

MOST_SHAPES = 1000
"""Combinations of codes and states whose meaning is kept."""
MOTIONS = ("rapid", "line", "arc-cw", "arc-ccw")
OFF = {"no-scale": "scale", "no-turn": "turn", "no-length": "length"}
SELECTS = {"work-system", "machine-system", "length-plus", "length-minus", *OFF}
_CORNERS = {"cutting": CUTTING, "slow-corners": SLOW, "exact": EXACT, "exact-path": KEPT, "blend": ROUNDED}
_PLANE_OF = {"plane-xy": 0, "plane-zx": 1, "plane-yz": 2}


@dataclass(frozen=True)
class WordReading:
    """How a letter is read under some codes."""

    place: int = -1
    """Of the axis; -1 for a word of another kind."""
    is_center: bool = False
    is_distance: bool = False
    """A letter that always is a distance."""
    role: str = ""
    scale: float = 1.0
    plain: bool = True
    """Whether the number is what is written."""
    form: Address | None = None
    whole: bool = False
    bounds: tuple[float, float] | None = None
    """The least and the largest value, scaled."""


@dataclass(frozen=True)
class ModalState:
    """The modal state of the control."""

    key: tuple[str, ...]
    active: Mapping[str, str]
    """Key of a group -> its code."""
    motion: str
    cycle: str
    plane: int
    corner: int
    free: int
    is_absolute: bool
    is_inch: bool
    is_inverse: bool
    is_per_turn: bool
    to_initial: bool
    """Whether a cycle returns to its first level."""


@dataclass
class BlockCodes:
    """What the codes of a block do, and how its letters are read, after one modal state."""

    codes: tuple[KnownCode, ...]
    modal: ModalState
    """The state from this block on."""
    feed_in_inch: bool = False
    """Whether a feed is read in inch."""
    once: str = ""
    """Action of a code that takes the words of the axes for itself; "" without one."""
    motion: str = ""
    is_exact: bool = False
    probes: bool = False
    """Whether the move ends at the contact of a probe."""
    begins_cycle: bool = False
    is_end: bool = False
    sets_rounding: bool = False
    """Whether its words set how far corners are rounded."""
    zones: KnownCode | None = None
    """The code that switches zones."""
    in_machine: bool = False
    """Whether its positions are those of the machine."""
    selects: tuple[KnownCode, ...] = ()
    """Codes that change the coordinates."""
    readings: dict[str, WordReading] = field(default_factory=dict)


class ModalCodes:
    """The modal state from block to block."""

    def __init__(self, file: ParameterFile, reader: BlockReader, path: ProgramPath, notes: list[str]) -> None:
        """``notes`` gets what is assumed."""
        self._file, self._reader, self._path, self._notes = file, reader, path, notes
        self._kept: dict[tuple[tuple[str, ...], tuple[str, ...]], BlockCodes] = {}
        self._states: dict[tuple[str, ...], ModalState] = {}
        for key, code in reader.codes.started.items():
            reader.active.setdefault(key, code)
        self.now = self._state_of(reader.active)

    def take(self, written: tuple[str, ...]) -> BlockCodes:
        """Return what the codes of a block do in the present state, which becomes that of the block."""
        codes = self._kept.get((written, self.now.key))
        if codes is None:
            codes = self._kept[written, self.now.key] = self._codes_of(written)
        self.now = codes.modal
        return codes

    def _codes_of(self, written: tuple[str, ...]) -> BlockCodes:
        """Return what the codes of a block do in the present modal state."""
        if len(self._kept) > MOST_SHAPES:
            self._kept.clear()
        found: list[KnownCode] = []
        known, calls = self._reader.codes.known, self._reader.codes.calls
        active = dict(self.now.active)
        groups: set[str] = set()
        for each in written:
            code = TypedWord(each[0], each[1:], each).code
            if code in calls:
                raise BlockError(f"{each} calls the program {calls[code].program}, which is not here")
            if code not in known and self._path.unknown_m and code[0] == "M":
                self._notes.append(f"{each}, which no page here names, moves no axis.")
                continue
            if code not in known:
                raise BlockError(f"{each} is a code that no page here names", "unknown-code")
            facts, group = known[code].facts, known[code].group
            if facts.refused or facts.only_amp:
                raise BlockError(f"{each}: the control does not do it, {facts.meaning}")
            if facts.does is None:
                raise BlockError(f"{each} is not simulated: {facts.meaning}")
            if facts.assumed:
                self._notes.append(sentence(facts.assumed))
            if group is not None:
                if group.key in groups:
                    raise BlockError(f"{each} and another code of the group {group.name}", "two-codes")
                groups.add(group.key)
                active[group.key] = code
            found.append(known[code])
        modal = self._state_of(active)
        feed_in_inch = self.now.is_inch if self._path.feed_first else modal.is_inch
        codes_here = BlockCodes(tuple(found), modal, feed_in_inch)
        if codes_here.modal.cycle and codes_here.modal.cycle == self.now.cycle:
            for code_ in found:
                if code_.facts.does in MOTIONS:
                    raise BlockError(
                        f"{code_.code} comes while {self.now.cycle} is active; which one counts is not"
                        " printed. End the cycle first"
                    )
        for code_ in found:
            does = str(code_.facts.does)
            if does in SELECTS:
                codes_here.selects += (code_,)
            elif does == "exact-once":
                codes_here.is_exact = True
            elif does == "cycle":
                codes_here.begins_cycle = True
            elif does == "blend":
                codes_here.sets_rounding = True
            elif does == "zones":
                codes_here.zones = code_
            elif does == "end":
                codes_here.is_end = True
            elif does == "machine-once":
                codes_here.in_machine = True
            elif does == "probe":
                codes_here.motion, codes_here.probes = "line", True
            elif does in ("scale", "turn") or (code_.group is None and does != "nothing"):
                if codes_here.once:
                    raise BlockError(f"{code_.code} and another code that takes the words of the axes")
                codes_here.once = does
        return codes_here

    def _state_of(self, active: Mapping[str, str]) -> ModalState:
        key = tuple(active.values())
        if key in self._states:
            return self._states[key]
        known = self._reader.codes.known
        self._reader.active = dict(active)
        facts = [known[code].facts for code in active.values() if code in known]
        modes, does = {each.mode for each in facts}, {str(each.does): each for each in facts}
        corner = next((n for name, n in _CORNERS.items() if name in does), CUTTING)
        slow = self._path.always_slow
        if slow and corner == CUTTING and self._file.evaluation.canonical((slow, "")) is True:
            corner = SLOW
        cycle = does["cycle"].code if "cycle" in does else ""
        self._states[key] = ModalState(
            key,
            dict(active),
            next((name for name in MOTIONS if name in does), ""),
            cycle if isinstance(cycle, str) else "",
            next((n for name, n in _PLANE_OF.items() if name in does), 0),
            corner,
            int("no-override" in does),
            "incremental" not in modes,
            self._reader.is_inch(),
            "inverse-time" in modes,
            "per-revolution" in modes,
            "level-r" not in does,
        )
        return self._states[key]
