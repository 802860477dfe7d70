"""The modal state of a control, and what the codes of a block do after it."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

from amp_studio.files import ParameterFile
from amp_studio.schema import ProgramPath

from .block import BlockReader
from .codes import KnownCode
from .formats import NumberFormat
from .toolpath import CUTTING, EXACT, KEPT, ROUNDED, SLOW
from .words import ProgramBlockError as BlockError
from .words import TypedWord, sentence

_T = TypeVar("_T")
_MAX_SHAPES = 1000
"""Combinations of codes and states whose meaning is kept."""
_MOTIONS = ("rapid", "line", "arc-cw", "arc-ccw")
OFF = {"no-scale": "scale", "no-turn": "turn", "no-length": "length"}
_SELECTS = {"work-system", "machine-system", "length-plus", "length-minus", *OFF}
_CORNERS = {"cutting": CUTTING, "slow-corners": SLOW, "exact": EXACT, "exact-path": KEPT, "blend": ROUNDED}
_PLANE_OF = {"plane-xy": 0, "plane-zx": 1, "plane-yz": 2}
_EFFECTS: Mapping[str, Mapping[str, Any]] = {
    "exact-once": {"is_exact": True},
    "cycle": {"begins_cycle": True},
    "blend": {"sets_rounding": True},
    "end": {"is_end": True},
    "machine-once": {"in_machine": True},
    "probe": {"motion": "line", "probes": True},
    "wait-motion": {"waits": True},
}
"""What a code does -> what the block then is."""
_OF_NO_AXIS = {"nothing", "zones", *_SELECTS, *_EFFECTS}
"""Codes without a group that leave the words of the axes to the others."""


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
    form: NumberFormat = field(default_factory=NumberFormat)
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
    turns: bool
    """Whether the spindle turns."""


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
    waits: bool = False
    """Whether it waits until the moves before it have ended."""
    pauses: tuple[str, ...] = ()
    """Parameters with the time that it rests then."""
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
        self._known_blocks: dict[tuple[tuple[str, ...], tuple[str, ...]], BlockCodes] = {}
        self._states: dict[tuple[str, ...], ModalState] = {}
        for key, code in reader.codes.started.items():
            reader.active.setdefault(key, code)
        self.now = self._state_of(reader.active)

    def take(self, written: tuple[str, ...]) -> BlockCodes:
        """Return what the codes of a block do in the present state, which becomes that of the block."""
        # A program has few shapes of blocks: what codes do in a state is worked out once for each.
        codes = self._known_blocks.get((written, self.now.key))
        if codes is None:
            if len(self._known_blocks) > _MAX_SHAPES:
                self._known_blocks.clear()
            codes = self._known_blocks[written, self.now.key] = self._codes_of(written)
        self.now = codes.modal
        return codes

    def _codes_of(self, written: tuple[str, ...]) -> BlockCodes:
        """Return what the codes of a block do in the present modal state."""
        codes: list[KnownCode] = []
        # A copy: the states are kept, and a later block may come back to this one.
        active = dict(self.now.active)
        groups: set[str] = set()
        self._refuse_together(written)
        for each in written:
            if len(each) == 1:
                raise BlockError(f"{each}: a code without its number", "no-digits")
            code = TypedWord(each[0], each[1:], each).code
            known = self._simulated(code, each)
            if known is None:
                continue
            if known.group is not None:
                if known.group.key in groups:
                    fault = "two-motions" if known.group.key == "motion" else "two-codes"
                    raise BlockError(f"{each} and another code of the group {known.group.name}", fault)
                groups.add(known.group.key)
                after = self._switched(active.get(known.group.key, ""), known, code)
                waits = known.facts.waits or known.facts.does == "wait-motion"
                if waits and active.get(known.group.key) == after:
                    continue  # what already is so is not switched
                active[known.group.key] = after
            codes.append(known)
        modal = self._state_of(active)
        self._refuse_motion_in_cycle(codes, modal)
        # Where a control takes the feed before it switches units, the F of that block is in the old one.
        is_inch = self.now.is_inch if self._path.feed_first else modal.is_inch
        return BlockCodes(tuple(codes), modal, is_inch, _sole_effect(codes), **_effects(codes))

    def _refuse_together(self, written: Sequence[str]) -> None:
        """Refuse codes of which a block has one at most, though they are in no group."""
        most = self._path.most_m
        if most and sum(each[0] == "M" for each in written) > most:
            raise BlockError(f"A block has at most {most} M codes", "two-codes")
        codes = {TypedWord(each[0], each[1:], each).code for each in written}
        for apart in self._path.apart:
            if len(found := sorted(codes.intersection(apart))) > 1:
                raise BlockError(f"{found[0]} and {found[1]} in one block", "two-codes")

    def _switched(self, before: str, known: KnownCode, code: str) -> str:
        """Return what is active in the group of a code after it: several of those that add to each other."""
        if not known.facts.adds:
            return code
        adding = {each for each in before.split() if self._reader.codes.known[each].facts.adds}
        return " ".join(sorted({*adding, code}))

    def _simulated(self, code: str, written: str) -> KnownCode | None:
        """Return what a code is; None where it moves nothing, and a BlockError where it is not simulated."""
        known, calls = self._reader.codes.known, self._reader.codes.calls
        if code in calls:
            raise BlockError(f"{written} calls the program {calls[code].program}, which is not here")
        if code not in known and self._path.unknown_m and code[0] == "M":
            self._notes.append(f"{written}, which no page here names, moves no axis.")
            return None
        if code not in known:
            raise BlockError(f"{written} is a code that no page here names", "unknown-code")
        facts = known[code].facts
        if facts.refused or facts.only_amp:
            raise BlockError(f"{written}: the control does not do it, {facts.meaning}")
        if facts.does is None:
            raise BlockError(f"{written} is not simulated: {facts.meaning}")
        if facts.assumed:
            self._notes.append(sentence(facts.assumed))
        return known[code]

    def _refuse_motion_in_cycle(self, codes: Sequence[KnownCode], modal: ModalState) -> None:
        motion = next((code for code in codes if code.facts.does in _MOTIONS), None)
        if motion and modal.cycle and modal.cycle == self.now.cycle:
            raise BlockError(
                f"{motion.code} comes while {self.now.cycle} is active; which one counts is not"
                " printed. End the cycle first"
            )

    def _state_of(self, active: Mapping[str, str]) -> ModalState:
        """Return what codes that are active together select; each set of them is read once."""
        key = tuple(active.values())
        if key in self._states:
            return self._states[key]
        known = self._reader.codes.known
        self._reader.active = dict(active)
        facts = [known[code].facts for code in active.values() if code in known]
        modes, does = {each.mode for each in facts}, {str(each.does): each for each in facts}
        cycle = does["cycle"].code if "cycle" in does else ""
        self._states[key] = ModalState(
            key,
            dict(active),
            _first_of(dict(zip(_MOTIONS, _MOTIONS, strict=True)), does, ""),
            cycle if isinstance(cycle, str) else "",
            _first_of(_PLANE_OF, does, 0),
            self._corner(does),
            int("no-override" in does),
            "incremental" not in modes,
            self._reader.is_inch(),
            "inverse-time" in modes,
            "per-revolution" in modes,
            "level-r" not in does,
            any(each.turns for each in facts),
        )
        return self._states[key]

    def _corner(self, does: Container[str]) -> int:
        """Return how a corner is passed; some controls have a parameter that slows down in all of them."""
        corner, slow = _first_of(_CORNERS, does, CUTTING), self._path.always_slow
        if slow and corner == CUTTING and self._file.evaluation.canonical((slow, "")) is True:
            return SLOW
        return corner


def _first_of(values: Mapping[str, _T], names: Container[str], otherwise: _T) -> _T:
    """Return the value of the first name that is among ``names``."""
    return next((value for name, value in values.items() if name in names), otherwise)


def _effects(codes: Sequence[KnownCode]) -> dict[str, Any]:
    """Return the fields of `BlockCodes` that codes set."""
    does = {str(code.facts.does): code for code in codes}
    selects = tuple(code for code in codes if code.facts.does in _SELECTS)
    pauses = tuple(code.facts.pause for code in codes if code.facts.pause)
    effects: dict[str, Any] = {"zones": does.get("zones"), "selects": selects, "pauses": pauses}
    for each in does:
        effects |= _EFFECTS.get(each, {})
    if any(code.facts.waits for code in codes):
        effects["waits"] = True
    return effects


def _sole_effect(codes: Sequence[KnownCode]) -> str:
    """Return what the one code does that takes the words of the axes for itself; "" without one."""
    taking = [
        code
        for code in codes
        if code.facts.does in ("scale", "turn") or (code.group is None and code.facts.does not in _OF_NO_AXIS)
    ]
    if len(taking) > 1:
        raise BlockError(f"{taking[1].code} and another code that takes the words of the axes", "two-motions")
    moves = [code for code in codes if code.facts.does in _MOTIONS]
    if taking and moves and taking[0].facts.does != "dwell":
        raise BlockError(
            f"{taking[0].code} and {moves[0].code} both take the words of the axes", "two-motions"
        )
    return str(taking[0].facts.does) if taking else ""
