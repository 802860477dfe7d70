"""A whole program: block after block to the rows of its path, with the modal state of the control.

What a code does and what a word is are facts of the family (``program.yaml``): a code without ``does``, and
whatever no page prints, ends the path at that block with its name. Nothing is guessed.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.schema import Address, axis_name

from .arcs import Arc, arc_by_center, arc_by_radius
from .block import BlockReader
from .codes import KnownCode
from .cycles import CycleWords, cycle_moves
from .expression import worth
from .toolpath import (
    ARC,
    CUTTING,
    DWELL,
    EXACT,
    LINE,
    PLANES,
    RAPID,
    SLOW,
    ProgramFault,
    RowsWriter,
    ToolPath,
)
from .words import ProgramBlockError as BlockError
from .words import TypedWord, words_of

MOST_REPEATED = 150_000
"""Blocks that are executed more often than once; a program that needs more counts as one without an end."""
MOST_ROWS = 4_000_000
MOST_REPEATS = 10_000
LARGEST = 1e7
"""mm or deg: no machine is larger, and every figure below keeps its decimals."""
MOST_SHAPES = 1000
"""Combinations of codes and states whose meaning is kept."""
EVERY = 4096
"""Blocks from one report of progress to the next."""
INCH = 25.4

_PLAIN = re.compile(r"(?:\s|[A-Z]\s*[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))*")
_PAIRS = re.compile(r"([A-Z])\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))")
_LABEL = re.compile(r"\s*N\s*([0-9]+)")
_SETS = re.compile(r"(?:N[0-9]+\s*)?[P#]\s*([0-9]+)\s*=(.*)")
_BRANCH = re.compile(r"(?:N[0-9]+\s*)?(?:IF\b(.*)\bTHEN\s*)?(GOTO|GOSUB)\s+([0-9]+)\s*")
_RETURN = re.compile(r"(?:N[0-9]+\s*)?RET\s*")
_INCLUDE = re.compile(r"\$I\b.*")
_CORNERS = {"cutting": CUTTING, "slow-corners": SLOW, "exact": EXACT}
_MOTIONS = ("rapid", "line", "arc-cw", "arc-ccw")
_OFF = {"no-scale": "scale", "no-turn": "turn", "no-length": "length"}
_SELECTS = {"work-system", "machine-system", "length-plus", "length-minus", *_OFF}
_PLANE_OF = {"plane-xy": 0, "plane-zx": 1, "plane-yz": 2}

BlockProgress = Callable[[int], None]
"""progress(blocks so far); may raise to cancel."""


@dataclass(frozen=True)
class _Reading:
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


@dataclass(frozen=True)
class _Modal:
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
class _Shape:
    """What the codes of a block do, and how its letters are read, after one modal state."""

    codes: tuple[KnownCode, ...]
    modal: _Modal
    """The state from this block on."""
    once: str = ""
    """Action of a code that takes the words of the axes for itself; "" without one."""
    motion: str = ""
    is_exact: bool = False
    is_end: bool = False
    in_machine: bool = False
    """Whether its positions are those of the machine."""
    selects: tuple[KnownCode, ...] = ()
    """Codes that change the coordinates."""
    readings: dict[str, _Reading] = field(default_factory=dict)


@dataclass
class _Words:
    """The numbers of a block."""

    axes: dict[int, float] = field(default_factory=dict)
    distances: dict[int, float] = field(default_factory=dict)
    centers: dict[int, float] = field(default_factory=dict)
    roles: dict[str, float] = field(default_factory=dict)


class Interpreter:
    """Executes one program."""

    def __init__(
        self,
        file: ParameterFile,
        start: Sequence[float] | None = None,
        zero: Mapping[str, float] | None = None,
        retract: float | None = None,
    ) -> None:
        """``start``: where the axes are at first; ``zero``: where the zero of the program is, by axis letter,
        in the place of work coordinates of the file; ``retract``: of a chip-breaking cycle. All in mm or deg.
        """
        self.file, self.reader = file, BlockReader(file)
        path = file.schema.program.path
        if path is None:
            raise BlockError(f"{file.schema.family.name}: no page here prints how its programs move the axes")
        if path.machines and file.machine not in path.machines:
            raise BlockError(f"Programs of a {file.machine} are not run: its words are read as of one block")
        self.facts, self._retract, self._zero = path, retract, zero
        self.axes = tuple(axis for axis in fitted_axes(file) if next(self._letters(axis), None))
        self.letters = tuple(axis_name(file.evaluation, axis) or axis for axis in self.axes)
        count = len(self.axes)
        self.start = list(start) if start is not None else [0.0] * count
        self.position = list(self.start)
        """In the coordinates of the machine."""
        self.rows = RowsWriter(self.letters)
        self.notes: list[str] = list(path.assumed)
        self.parameters: dict[int, float] = {}
        self.blocks = self.line = 0
        self._feed, self._speed = 0.0, 0.0
        self._cycle_words = CycleWords()
        self._centers = self._center_mode()
        self._length, self._length_sign = 0, 0.0
        self._work: dict[str, list[float]] = {
            name: [0.0] * count for name in ("system", "local", "set", "length")
        }
        self._system = ""
        self._systems: dict[str, list[float]] = {}
        self._shift = [0.0] * count
        self._scale, self._around = [1.0] * count, [0.0] * count
        self._turn, self._turn_around, self._has_map = 0.0, (0.0, 0.0), False
        self._middle: list[float | None] = [None] * count
        self._shapes: dict[tuple[tuple[str, ...], tuple[str, ...]], _Shape] = {}
        self._modals: dict[tuple[str, ...], _Modal] = {}
        self._over = False
        systems = [code for code in self.reader.codes.known.values() if code.facts.does == "work-system"]
        self._has_offsets = all(code.facts.params for code in systems)
        for code in path.first:
            group = self.reader.codes.known[TypedWord(code[0], code[1:], code).code].group
            assert group is not None  # the facts are checked
            self.reader.active.setdefault(group.key, code)
        self._modal = self._modal_of(self.reader.active)
        if zero is not None:
            self._set_shift("system", [zero.get(letter, 0.0) for letter in self.letters])
        self._programmed = self._to_program(self.position)

    def _letters(self, axis: str) -> Iterator[str]:
        """Yield the letter of an axis, X to Z and A to W."""
        declared = self.file.schema.family.axes
        if declared and self.file.evaluation.canonical((declared.type, axis)) == declared.types.get("S", "?"):
            return  # a spindle turns, and no word moves it along
        name = axis_name(self.file.evaluation, axis) or axis
        if len(name) == 1 and name.isalpha():
            yield name

    # -- the program ---------------------------------------------------------------

    def run(self, lines: Sequence[str], progress: BlockProgress | None = None) -> ToolPath:
        """Return the path of a program, as far as the control can go."""
        fault = None
        try:
            self._run(lines, progress)
        except BlockError as error:
            block = lines[self.line - 1] if 0 < self.line <= len(lines) else ""
            code = self.facts.faults.get(error.key, "")
            fault = ProgramFault(self.line, block[:80], str(error), code)
        return self.rows.path(
            self.start, self.blocks, fault, self.notes, zero_known=self._zero is not None or self._has_offsets
        )

    def _run(self, lines: Sequence[str], progress: BlockProgress | None) -> None:
        labels: dict[int, int] | None = None
        returns: list[int] = []
        at, statements = 0, bool(self.reader.codes.facts.statements)
        while at < len(lines) and not self._over:
            line = lines[at].upper()
            at += 1
            self.line = at
            self.blocks += 1
            if self.blocks % EVERY == 0 and progress is not None:
                progress(self.blocks)
            if self.blocks > len(lines) + MOST_REPEATED or len(self.rows.kind) > MOST_ROWS:
                raise BlockError(f"The program has no end within {self.blocks - 1} blocks")
            if statements and ("=" in line or "GO" in line or "RET" in line or "$" in line):
                target = self._statement(line, returns, at)
                if target is not None:
                    if labels is None:
                        labels = _labels(lines)
                    at = self._place(labels, target) if target >= 0 else returns.pop()
                    continue
                if _SETS.fullmatch(line) or _BRANCH.fullmatch(line) or _INCLUDE.fullmatch(line):
                    continue
            self._block(line)

    def _place(self, labels: Mapping[int, int], label: int) -> int:
        if label not in labels:
            raise BlockError(f"No block has the number N{label}")
        return labels[label]

    def _statement(self, line: str, returns: list[int], after: int) -> int | None:
        """Execute a branch or an assignment; return the label to go on at, -1 to return, None to go on."""
        if _RETURN.fullmatch(line):
            if not returns:
                raise BlockError("RET comes without a GOSUB before it", "return-without-call")
            return -1
        if (found := _BRANCH.fullmatch(line)) is not None:
            if found[1] is not None and worth(found[1], self.parameters) == 0.0:
                return None
            if found[2] == "GOSUB":
                if len(returns) >= self.facts.depth:
                    raise BlockError(f"Subroutines are more than {self.facts.depth} levels deep")
                returns.append(after)
            return int(found[3])
        if (found := _SETS.fullmatch(line)) is not None:
            self.parameters[int(found[1])] = worth(found[2], self.parameters)
        return None

    # -- one block -----------------------------------------------------------------

    def _block(self, line: str) -> None:
        if _PLAIN.fullmatch(line):
            pairs = _PAIRS.findall(line)
        else:
            expressions = self.reader.codes.facts.expressions
            pairs = [(word.letter, word.number) for word in words_of(line, expressions)]
        if not pairs:
            return
        codes = tuple([letter + number for letter, number in pairs if letter in "GM"])
        shape = self._shapes.get((codes, self._modal.key))
        if shape is None:
            shape = self._shapes[codes, self._modal.key] = self._shape(codes)
        self._modal = shape.modal
        for code in shape.selects:
            self._select(str(code.facts.does), code)
        words = self._numbers(pairs, shape)
        if words.roles:
            self._keep(words.roles, shape)
        if shape.once:
            self._do_once(shape, words)
        elif words.axes or words.distances or words.centers:
            self._move(words, shape)
        self._over = shape.is_end

    def _shape(self, written: tuple[str, ...]) -> _Shape:
        """Return what the codes of a block do in the present modal state."""
        if len(self._shapes) > MOST_SHAPES:
            self._shapes.clear()
        found: list[KnownCode] = []
        known, calls = self.reader.codes.known, self.reader.codes.calls
        active = dict(self._modal.active)
        groups: set[str] = set()
        for each in written:
            code = TypedWord(each[0], each[1:], each).code
            if code in calls:
                raise BlockError(f"{each} calls the program {calls[code].program}, which is not here")
            if code not in known and self.facts.unknown_m and code[0] == "M":
                self.notes.append(f"{each}, which no page here names, moves no axis.")
                continue
            if code not in known:
                raise BlockError(f"{each} is a code that no page here names", "unknown-code")
            facts, group = known[code].facts, known[code].group
            if facts.refused or facts.only_amp:
                raise BlockError(f"{each}: the control does not do it, {facts.meaning}")
            if facts.does is None:
                raise BlockError(f"{each} is not simulated: {facts.meaning}")
            if group is not None:
                if group.key in groups:
                    raise BlockError(f"{each} and another code of the group {group.name}", "two-codes")
                groups.add(group.key)
                active[group.key] = code
            found.append(known[code])
        shape = _Shape(tuple(found), self._modal_of(active))
        if shape.modal.cycle and shape.modal.cycle == self._modal.cycle:
            for code_ in found:
                if code_.facts.does in _MOTIONS:
                    raise BlockError(
                        f"{code_.code} comes while {self._modal.cycle} is active; which one counts is not"
                        " printed. End the cycle first"
                    )
        for code_ in found:
            does = str(code_.facts.does)
            if does in _SELECTS:
                shape.selects += (code_,)
            elif does == "exact-once":
                shape.is_exact = True
            elif does == "end":
                shape.is_end = True
            elif does == "machine-once":
                shape.in_machine = True
            elif does == "line" and code_.group is None:
                shape.motion = does
            elif does in ("scale", "turn") or (code_.group is None and does != "nothing"):
                if shape.once:
                    raise BlockError(f"{code_.code} and another code that takes the words of the axes")
                shape.once = does
        return shape

    def _modal_of(self, active: Mapping[str, str]) -> _Modal:
        key = tuple(active.values())
        if key in self._modals:
            return self._modals[key]
        known = self.reader.codes.known
        self.reader.active = dict(active)
        facts = [known[code].facts for code in active.values() if code in known]
        modes, does = {each.mode for each in facts}, {str(each.does): each for each in facts}
        corner = next((n for name, n in _CORNERS.items() if name in does), CUTTING)
        slow = self.facts.always_slow
        if slow and corner == CUTTING and self.file.evaluation.canonical((slow, "")) is True:
            corner = SLOW
        cycle = does["cycle"].code if "cycle" in does else ""
        self._modals[key] = _Modal(
            key,
            dict(active),
            next((name for name in _MOTIONS if name in does), ""),
            cycle if isinstance(cycle, str) else "",
            next((n for name, n in _PLANE_OF.items() if name in does), 0),
            corner,
            int("no-override" in does),
            "incremental" not in modes,
            self.reader.is_inch(),
            "inverse-time" in modes,
            "per-revolution" in modes,
            "level-r" not in does,
        )
        return self._modals[key]

    def _numbers(self, pairs: Sequence[tuple[str, str]], shape: _Shape) -> _Words:
        words = _Words()
        readings = shape.readings
        for letter, text in pairs:
            if letter in "GMN":
                continue
            reading = readings.get(letter)
            if reading is None:
                reading = readings[letter] = self._reading(letter, shape)
            if reading.plain and text and "(" not in text:
                value = float(text) * reading.scale
            else:
                value = self._number(letter, text, reading) * reading.scale
            if not -LARGEST < value < LARGEST:
                raise BlockError(f"{letter}{text[:20]} is beyond every machine", "out-of-range")
            if reading.place < 0:
                into: dict[int, float] = {}
                if reading.role:
                    if reading.role in words.roles:
                        raise BlockError(f"{letter} is given twice in a block", "repeated")
                    words.roles[reading.role] = value
                continue
            into = (
                words.centers if reading.is_center else words.distances if reading.is_distance else words.axes
            )
            if reading.place in into:
                raise BlockError(f"{letter} is given twice in a block", "repeated")
            into[reading.place] = value
        return words

    def _number(self, letter: str, text: str, reading: _Reading) -> float:
        if "(" in text:
            sign = -1.0 if text.startswith("-") else 1.0
            return sign * worth(text.lstrip("+-"), self.parameters)
        word = TypedWord(letter, text, letter + text)
        number = self.reader.number(word, reading.form, reading.whole)
        if number.assumed:
            self.notes.append(f"That {number.assumed.removeprefix('that ')}.")
        if number.value is None:
            raise BlockError(f"{letter}{text}: {number.fault or 'no number'}", "no-number")
        return number.value

    def _reading(self, letter: str, shape: _Shape) -> _Reading:
        facts = self.reader.codes.facts
        self.reader.active = dict(self._modal.active)
        here = {TypedWord(code.code[0], code.code[1:], "").code for code in shape.codes}
        use = self.reader.use(letter, here)
        if use is not None:
            unit = use.unit if isinstance(use.unit, str) else use.unit["in" if self._modal.is_inch else "mm"]
            scale = (
                INCH if unit.startswith("in") else 1e-3 if unit == "ms" else 60.0 if unit == "min" else 1.0
            )
            form = (use.format, "") if use.format else None
            plain = form is None and facts.zeros is None and not use.whole
            return _Reading(role=use.role or "", scale=scale, plain=plain, form=form, whole=use.whole)
        for axis, meaning, _ in self.reader.axis_words(letter):
            if axis not in self.axes:
                break
            scale = INCH if self.reader.unit_of(axis) == "in" else 1.0
            form = (facts.axes.format, axis) if facts.axes and facts.axes.format else None
            return _Reading(
                self.axes.index(axis),
                meaning.startswith("center"),
                meaning.startswith("distance") and self._modal.is_absolute,
                scale=scale,
                plain=form is None and facts.zeros is None,
                form=form,
            )
        raise BlockError(f"{letter}: this control has no such word", "unknown-word")

    def _keep(self, roles: dict[str, float], shape: _Shape) -> None:
        """Take the words that stay active."""
        feed = roles.get("feed")
        if roles.get("move-time", 0.0) > 0.0:
            feed = 60.0 / roles["move-time"]  # as moves a minute, in which other controls count it
        if feed is not None:
            if feed <= 0.0:
                raise BlockError(f"F{feed:g} is no feed: it must be above 0", "no-feed")
            self._feed = feed
        self._speed = roles.get("spindle", self._speed)
        if "length-offset" in roles and shape.once != "set-data":
            self._length = int(roles["length-offset"])
            self._apply_length()

    # -- coordinates ----------------------------------------------------------------

    def _set_shift(self, name: str, shift: Sequence[float]) -> None:
        self._work[name] = list(shift)
        self._shift = [sum(parts) for parts in zip(*self._work.values(), strict=True)]
        self._programmed = self._to_program(self.position)

    def _select(self, does: str, code: KnownCode) -> None:
        if does.startswith("length"):
            self._length_sign = 1.0 if does == "length-plus" else -1.0
            self._apply_length()
            return
        if does in _OFF:
            self._switch_off(_OFF[does])
            return
        if self._zero is not None:
            return
        self._system = code.code if does == "work-system" else ""
        if not self._system:
            shift = [0.0] * len(self.axes)
        elif self._system in self._systems or not code.facts.params:
            shift = self._systems.get(self._system, [0.0] * len(self.axes))
        else:
            shift = self._positions(code.facts.params[:1], "work coordinate")
        self._work["local"] = [0.0] * len(self.axes)
        self._set_shift("system", shift)

    def _apply_length(self) -> None:
        if self._length_sign == 0.0 or not self._length:
            return
        third = self._axis("Z")
        total = 0.0
        for part in self.facts.length_offsets:
            value = self.file.evaluation.canonical((part, str(self._length)))
            if not isinstance(value, float | int):
                title = self.file.schema.parameters[part].name
                raise BlockError(f"{title} {self._length} is not set")
            total += value
        shift = [0.0] * len(self.axes)
        shift[third] = self._length_sign * total
        self._set_shift("length", shift)

    def _switch_off(self, what: str) -> None:
        if what == "length":
            self._length_sign = 0.0
            self._set_shift("length", [0.0] * len(self.axes))
        elif what == "scale":
            self._scale = [1.0] * len(self.axes)
        else:
            self._turn = 0.0
        self._has_map = self._turn != 0.0 or any(scale != 1.0 for scale in self._scale)
        self._programmed = self._to_program(self.position)

    def _positions(self, params: Sequence[str], what: str) -> list[float]:
        """Return the values of the axes of one parameter; an axis without one counts as 0."""
        found = []
        for axis, letter in zip(self.axes, self.letters, strict=True):
            value = self.file.evaluation.canonical((params[0], axis)) if params else None
            if not isinstance(value, float | int):
                self.notes.append(f"The {what} of {letter} is not set: 0 is taken.")
                value = 0.0
            found.append(float(value))
        return found

    def _to_machine(self, point: Sequence[float]) -> list[float]:
        if self._has_map:
            point = [
                middle + (value - middle) * scale
                for value, middle, scale in zip(point, self._around, self._scale, strict=True)
            ]
            if self._turn:
                a, b = self._axis("X"), self._axis("Y")
                u, v = point[a] - self._turn_around[0], point[b] - self._turn_around[1]
                cosine, sine = math.cos(self._turn), math.sin(self._turn)
                point[a] = self._turn_around[0] + u * cosine - v * sine
                point[b] = self._turn_around[1] + u * sine + v * cosine
        return [value + shift for value, shift in zip(point, self._shift, strict=True)]

    def _to_program(self, point: Sequence[float]) -> list[float]:
        found = [value - shift for value, shift in zip(point, self._shift, strict=True)]
        if self._has_map:
            if self._turn:
                a, b = self._axis("X"), self._axis("Y")
                u, v = found[a] - self._turn_around[0], found[b] - self._turn_around[1]
                cosine, sine = math.cos(self._turn), math.sin(self._turn)
                found[a] = self._turn_around[0] + u * cosine + v * sine
                found[b] = self._turn_around[1] - u * sine + v * cosine
            found = [
                middle + (value - middle) / scale
                for value, middle, scale in zip(found, self._around, self._scale, strict=True)
            ]
        return found

    def _axis(self, letter: str) -> int:
        if letter not in self.letters:
            raise BlockError(f"The machine has no axis {letter}")
        return self.letters.index(letter)

    def _target(self, words: _Words) -> list[float]:
        """Return the programmed end of a block."""
        target = list(self._programmed)
        for place, value in words.axes.items():
            target[place] = value if self._modal.is_absolute else target[place] + value
        for place, value in words.distances.items():
            target[place] += value
        return target

    def _in_machine(self, words: _Words) -> list[float]:
        """Return the programmed end of a block whose words are places of the machine."""
        end = list(self.position)
        for place, value in words.axes.items():
            end[place] = value
        return self._to_program(end)

    # -- moves ------------------------------------------------------------------------

    def _move(self, words: _Words, shape: _Shape) -> None:
        motion = shape.motion or self._modal.motion
        exact = EXACT if shape.is_exact else self._modal.corner
        if self._modal.cycle:
            self._run_cycle(words)
            return
        if motion == "":
            raise BlockError("No code of motion is active (G0, G1, G2 or G3)", "no-motion")
        target = self._in_machine(words) if shape.in_machine else self._target(words)
        if shape.in_machine and motion not in ("rapid", "line"):
            raise BlockError("A move in the coordinates of the machine is straight", "machine-arc")
        if motion in ("arc-cw", "arc-ccw"):
            self._arc(words, target, exact, clockwise=motion == "arc-cw")
        elif words.centers:
            raise BlockError("The center of an arc in a block that is no arc", "unused-words")
        elif motion == "rapid":
            self._go(target, RAPID, exact)
        else:
            self._go(target, LINE, exact)

    def _go(self, target: list[float], kind: int, corner: int) -> None:
        """Go in a straight line to a programmed point."""
        end = self._to_machine(target)
        self._programmed = target
        if end == self.position:
            return
        feed = 0.0
        if kind == LINE:
            feed = (
                self._feed_of(math.dist(end, self.position)) if self._modal.is_inverse else self._feed_of(0.0)
            )
        self.rows.add(end, kind, self.line, feed, corner, self._modal.free)
        self.position = end

    def _feed_of(self, way: float) -> float:
        """Return the programmed feed in u/s."""
        if self._modal.is_inverse:
            if not self._feed:
                raise BlockError("A block of G93 has no F", "no-feed")
            feed = self._feed
            self._feed = 0.0
            return way * feed / 60.0
        if not self._feed and self.facts.feed:
            value = self.file.evaluation.canonical((self.facts.feed, ""))
            if isinstance(value, float | int) and value > 0.0:
                self._feed = float(value)
        if not self._feed:
            raise BlockError("No feed is programmed, and the file has none", "no-feed")
        if self._modal.is_per_turn:
            if not self._speed:
                raise BlockError("A feed for a turn of the spindle, and no S before it", "no-spindle")
            return self._feed * self._speed / 60.0
        return self._feed / 60.0

    def _arc(self, words: _Words, target: list[float], corner: int, *, clockwise: bool) -> None:
        first, second, _ = (self._axis("XYZ"[n]) for n in PLANES[self._modal.plane])
        if self._has_map and (
            len({self._scale[first], self._scale[second]}) > 1 or self._scale[first] <= 0.0
        ):
            raise BlockError("An arc under different scales of its axes is no arc")
        begin, end = self.position, self._to_machine(target)
        ends = begin[first], begin[second], end[first], end[second]
        if "radius" in words.roles:
            if not self.facts.arcs_by_radius:
                raise BlockError("No page prints arcs by R for this control")
            arc = arc_by_radius(*ends, words.roles["radius"] * self._scale[first], clockwise=clockwise)
        else:
            if not self.facts.arcs_by_radius and "level" in words.roles:
                raise BlockError("No page prints arcs by R for this control: give the center")
            arc = self._arc_by_center(words, ends, first, second, clockwise=clockwise)
        along = math.hypot(
            arc.radius * arc.sweep, *(end[n] - begin[n] for n in range(len(end)) if n not in (first, second))
        )
        self._programmed = target
        feed = self._feed_of(along)
        center = (arc.first, arc.second, arc.sweep)
        self.rows.add(end, ARC, self.line, feed, corner, self._modal.free, center, self._modal.plane)
        self.position = end

    def _arc_by_center(
        self,
        words: _Words,
        ends: tuple[float, float, float, float],
        first: int,
        second: int,
        *,
        clockwise: bool,
    ) -> Arc:
        if not {first, second} & set(words.centers):
            raise BlockError("An arc without its center in the plane", "no-center")
        if set(words.centers) - {first, second}:
            raise BlockError("The center of an arc is outside of its plane", "unused-words")
        given = [words.centers.get(place, 0.0) for place in (first, second)]
        if self._centers == "absolute":
            point = list(self._programmed)
            for place, value in words.centers.items():
                point[place] = value
            machine = self._to_machine(point)
            center = machine[first], machine[second]
        else:
            sign = -1.0 if self._centers == "incremental_negative" else 1.0
            point = list(self._programmed)
            point[first] += sign * given[0]
            point[second] += sign * given[1]
            machine = self._to_machine(point)
            center = machine[first], machine[second]
        return arc_by_center(*ends, *center, self.facts.arc_tolerance, clockwise=clockwise)

    def _center_mode(self) -> str:
        if self.facts.centers is None:
            return "incremental_positive"
        return str(self.file.evaluation.canonical((self.facts.centers, "")) or "absolute")

    # -- cycles -------------------------------------------------------------------------

    def _run_cycle(self, words: _Words) -> None:
        known = self.reader.codes.known[TypedWord(self._modal.cycle[0], self._modal.cycle[1:], "").code]
        plane = tuple(self._axis("XYZ"[n]) for n in PLANES[self._modal.plane])
        third = plane[2]
        repeats = int(words.roles.get("repeats", 1.0))
        if not 1 <= repeats <= MOST_REPEATS:
            raise BlockError(f"L{repeats}: a cycle is repeated 1 to {MOST_REPEATS} times")
        stored = self._cycle_words
        if third in words.axes:
            stored.depth = words.axes[third]
        for role in ("level", "peck", "dwell"):
            if role in words.roles:
                setattr(stored, role, words.roles[role])
        if stored.depth is None or stored.level is None:
            raise BlockError(
                f"{self._modal.cycle} needs the depth and R, in its block or before it", "no-depth"
            )
        initial = self._programmed[third]
        level = stored.level if self._modal.is_absolute else initial + stored.level
        depth = stored.depth if self._modal.is_absolute else level + stored.depth
        if not depth < level:
            raise BlockError(f"{self._modal.cycle}: the depth {depth:g} is not below R, {level:g}")
        moves = tuple(
            cycle_moves(
                known.facts.steps,
                initial,
                level,
                depth,
                stored,
                self._length_of(self.facts.peck_clearance, None, "D of the cycle"),
                self._length_of(self.facts.retract, self._retract, "retract distance of the cycle"),
                to_initial=self._modal.to_initial,
            )
        )
        for _ in range(repeats):
            target = list(self._programmed)
            for place, value in words.axes.items():
                if place != third:
                    target[place] = value if self._modal.is_absolute else target[place] + value
            self._go(target, RAPID, self._modal.corner)
            for move in moves:
                if move.seconds is not None:
                    self._dwell(move.seconds)
                    continue
                target = list(self._programmed)
                if move.shift is not None:
                    target[self._axis("X")] += move.shift
                if move.to is not None:
                    target[third] = move.to
                self._go(target, RAPID if move.is_rapid else LINE, self._modal.corner)
            if len(self.rows.kind) > MOST_ROWS:
                raise BlockError(f"The program has more than {MOST_ROWS} moves")

    def _length_of(self, parameter: str | None, given: float | None, what: str) -> float | str:
        """Return a length of a cycle, or why there is none."""
        if given is not None:
            return given
        if parameter is None:
            return f"the {what} is printed nowhere: give it"
        value = self.file.evaluation.canonical((parameter, ""))
        if isinstance(value, float | int):
            return float(value)
        return f"{self.file.schema.parameters[parameter].name} is not set"

    # -- codes of one block ----------------------------------------------------------------

    def _dwell(self, seconds: float) -> None:
        if seconds < 0.0:
            raise BlockError("A dwell cannot be negative", "out-of-range")
        self.rows.add(self.position, DWELL, self.line, 0.0, EXACT, 1, seconds=seconds)

    def _do_once(self, shape: _Shape, words: _Words) -> None:
        does = shape.once
        if does == "dwell":
            if "dwell" not in words.roles:
                raise BlockError("A dwell without its time", "no-number")
            self._dwell(words.roles["dwell"])
        elif does in ("reference", "reference-check", "reference-other", "reference-return"):
            self._reference(does, words)
        elif does == "set-position":
            shift = list(self._work["set"])
            for place, value in words.axes.items():
                shift[place] += self._programmed[place] - value
            self._set_shift("set", shift)
        elif does == "local-shift":
            local = list(self._work["local"])
            for place, value in words.axes.items():
                local[place] = value
            self._set_shift("local", local)
        elif does == "set-data":
            self._set_data(words)
        elif does == "centers":
            modes = ("incremental_negative", "incremental_positive", "absolute")
            number = int(words.roles.get("centers", -1.0))
            if not 0 <= number < len(modes):
                raise BlockError("G200 takes F0, F1 or F2")
            self._centers = modes[number]
        elif does in ("scale", "turn"):
            self._map(does, words)
        else:
            raise BlockError(f"{shape.codes[0].code} is not simulated: {shape.codes[0].facts.meaning}")

    def _map(self, does: str, words: _Words) -> None:
        if does == "turn":
            if self._modal.plane != 0:
                raise BlockError("A turn is printed with other axes than those of this plane: not simulated")
            a, b = self._axis("X"), self._axis("Y")
            self._turn_around = words.axes.get(a, self._programmed[a]), words.axes.get(b, self._programmed[b])
            self._turn = math.radians(words.roles.get("turn", 0.0))
        else:
            self._around = [words.axes.get(n, here) for n, here in enumerate(self._programmed)]
            factor = words.roles.get("scale", 1.0)
            unit = (
                INCH if self._modal.is_inch else 1.0
            )  # a factor has no unit, but I, J and K are read as lengths
            self._scale = [
                words.centers[n] / unit if n in words.centers else factor for n in range(len(self.axes))
            ]
            if not all(1e-6 < abs(scale) < 1e6 for scale in self._scale):
                raise BlockError("A scale must not be 0, and below a million", "out-of-range")
        self._has_map = self._turn != 0.0 or any(scale != 1.0 for scale in self._scale)
        self._programmed = self._to_program(self.position)

    def _set_data(self, words: _Words) -> None:
        kind, number = words.roles.get("set-kind"), int(words.roles.get("set-number", 0.0))
        systems = [code for code in self.reader.codes.known.values() if code.facts.does == "work-system"]
        if kind != 2.0 or not 1 <= number <= len(systems):
            raise BlockError("G10 is printed for L2 and the work coordinates alone: not simulated")
        code = systems[number - 1]
        shift = self._systems.get(code.code) or self._positions(code.facts.params[:1], "work coordinate")
        for place, value in words.axes.items():
            shift[place] = value
        self._systems[code.code] = shift
        if self._system == code.code and self._zero is None:
            self._set_shift("system", shift)

    def _reference(self, does: str, words: _Words) -> None:
        number = int(words.roles.get("reference", 2.0)) if does == "reference-other" else 1
        if not 1 <= number <= len(self.facts.references):
            raise BlockError(f"P{number}: there are reference points 2 to {len(self.facts.references)}")
        point = self._positions([self.facts.references[number - 1]], f"reference point {number}")
        if does in ("reference", "reference-check", "reference-other") and any(self._work["length"]):
            raise BlockError("The reference point is not reached with an offset: cancel it first")
        target = self._target(words)
        if does == "reference-check":
            self._go(self._to_program(point), RAPID, EXACT)
            self._go(target, RAPID, EXACT)
            return
        if does == "reference-return":
            middle = [
                here if found is None else found
                for found, here in zip(self._middle, self.position, strict=True)
            ]
            self._go(self._to_program(middle), RAPID, EXACT)
            self._go(target, RAPID, EXACT)
            return
        through = self._to_machine(target)
        for place in range(len(self.axes)):
            remembered = self._middle[place]
            if place in words.axes or place in words.distances or remembered is None:
                self._middle[place] = through[place]
            else:
                through[place] = remembered
        self._go(self._to_program(through), RAPID, EXACT)
        self._go(self._to_program(point), RAPID, EXACT)


def _labels(lines: Sequence[str]) -> dict[int, int]:
    """Return number of a block -> its line from 0, the first of each number."""
    found: dict[int, int] = {}
    for n, line in enumerate(lines):
        if (label := _LABEL.match(line.upper())) is not None and len(label[1]) < 12:
            found.setdefault(int(label[1]), n)
    return found


def path_letters(file: ParameterFile) -> tuple[str, ...]:
    """Return the letters of the axes of a path in their order; raises ProgramBlockError."""
    return Interpreter(file).letters


def tool_path(
    file: ParameterFile,
    lines: Sequence[str],
    *,
    start: Sequence[float] | None = None,
    zero: Mapping[str, float] | None = None,
    retract: float | None = None,
    progress: BlockProgress | None = None,
) -> ToolPath:
    """Return the path of a program under a file; raises ProgramBlockError for a family of which no page
    prints one.
    """
    return Interpreter(file, start, zero, retract).run(lines, progress)
