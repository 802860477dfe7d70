"""A whole program: block after block to the rows of its path.

What a code does and what a word is are facts of the family (``program.yaml``): a code without ``does``, and
whatever no page prints, ends the path at that block with its name. Nothing is guessed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import islice

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.schema import ProgramPath, axis_name

from .block import FED, BlockReader
from .codes import KnownCode
from .coordinates import ProgramCoordinates
from .cycles import CycleRuns
from .flow import TAKES_IN, ProgramFlow
from .modal import BlockCodes, ModalCodes
from .moves import PathMoves
from .single_codes import SingleCodes
from .toolpath import DWELL, EXACT, LINE, MAX_ROWS, RAPID, ProgramFault, ToolPath
from .word_numbers import BlockNumbers, WordNumbers
from .words import ProgramBlockError as BlockError
from .words import in_capitals, without_blanks, without_open_remark, words_of

MAX_REPEATED = 150_000
"""Blocks that are executed more often than once; a program that needs more counts as one without an end."""
_EVERY = 4096
"""Blocks from one report of progress to the next."""

_PLAIN = re.compile(r"(?:[ \t]|[A-Z]\s*[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))*", re.ASCII)
_PAIRS = re.compile(r"([A-Z])\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))", re.ASCII)

BlockProgress = Callable[[int], None]
"""progress(blocks so far); may raise to cancel."""


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
        self._path, self._has_zero = path, zero is not None
        self.axes = tuple(axis for axis in fitted_axes(file) if next(self._letters(axis), None))
        self.letters = tuple(axis_name(file.evaluation, axis) or axis for axis in self.axes)
        self.start = list(start) if start is not None else [0.0] * len(self.axes)
        self.notes: list[str] = list(path.assumed)
        self.parameters = self._kept_variables(path)
        self.blocks = self.line = 0
        codes = self.reader.codes
        self._modal = ModalCodes(file, self.reader, path, self.notes)
        self._numbers = WordNumbers(self.reader, self.axes, self.parameters, self.notes, path)
        self._at = ProgramCoordinates(file, path, self.axes, self.letters, self.start, zero, self.notes)
        for active in self._modal.now.active.values():
            if active in codes.known:
                self._at.start_in(codes.known[active])
        self._moves = PathMoves(file, path, self._at)
        self._cycles = CycleRuns(file, path, codes, self._moves, retract)
        self._single = SingleCodes(path, codes, self._moves)
        self._over = False
        self._has_end = False
        """Whether a % ends the program."""
        self._refused = ""
        """How a line begins that the control refuses in this program."""
        systems = [code for code in codes.known.values() if code.facts.does == "work-system"]
        self._has_offsets = all(code.facts.params for code in systems)

    def _letters(self, axis: str) -> Iterator[str]:
        """Yield the letter of an axis, X to Z and A to W."""
        declared = self.file.schema.family.axes
        if declared and self.file.evaluation.canonical((declared.type, axis)) == declared.types.get("S", "?"):
            return  # a spindle turns, and no word moves it along
        name = axis_name(self.file.evaluation, axis) or axis
        if len(name) == 1 and name.isalpha():
            yield name

    def _kept_variables(self, path: ProgramPath) -> dict[int, float]:
        """Return the program parameters of the file, by number."""
        found = {}
        for named in path.variables:
            for instance in self.file.machine_schema.instances(self.file.schema.parameters[named]):
                value = self.file.evaluation.canonical((named, instance))
                if isinstance(value, float | int):
                    found[int(instance)] = float(value)
        return found

    # -- the program ---------------------------------------------------------------

    def run(
        self, lines: Sequence[str], progress: BlockProgress | None = None, most: int = MAX_ROWS
    ) -> Iterator[ToolPath]:
        """Yield the path of a program, as far as the control can go, whenever there are ``most`` rows of it;
        the last part may have none, and has how the program ended.
        """
        fault = None
        try:
            self._start_up()
            for _ in self._run(lines, progress):
                if len(self._moves.rows) >= most:
                    yield self._taken(None)
            self._note_cycles_taken_in(lines)
            if not self._over and not self._has_end and self._path.note_without_end:
                self.notes.append(self._path.note_without_end)
        except BlockError as error:
            block = lines[self.line - 1] if 0 < self.line <= len(lines) else ""
            code = self._path.faults.get(error.key, "")
            fault = ProgramFault(self.line, block[:80], str(error), code)
        yield self._taken(fault)

    def _taken(self, fault: ProgramFault | None) -> ToolPath:
        known = self._has_zero or self._has_offsets
        # Notes of a long program are alike: those of each block would grow with it.
        self.notes[:] = dict.fromkeys(self.notes)
        return self._moves.rows.take(self.blocks, fault, self.notes, zero_known=known)

    def _start_up(self) -> None:
        """Run the block that the control runs when it starts."""
        if self._path.startup:
            value = self.file.evaluation.canonical((self._path.startup, ""))
            if isinstance(value, str):
                self._block(value.upper())

    def _own_lines(self, lines: Sequence[str]) -> int:
        """Return how many lines the program has: those up to a % that ends it."""
        first, begins, ends = {"/": -1, "%": -1}, -1, -1
        for n, line in enumerate(lines):
            begin = line.lstrip()[:1]
            begins = n if begin and begins < 0 else begins
            if begin in first and first[begin] < 0:
                first[begin] = n
            if begin == "%" and n != begins:
                ends = n
                break
        if first["/"] >= 0:
            self.notes.append("Blocks with / in front are run, as while the control skips none.")
        if self._path.percent == "nothing" or ends < 0:
            return len(lines)
        if self._path.percent == "pair" and begins != first["%"]:
            self._refused = "%"
            return len(lines)
        self._has_end = True
        if any(line.strip() for line in islice(lines, ends + 1, None)):
            self.notes.append(f"The % in line {ends + 1} ends the program: the blocks behind it are not run.")
        return ends

    def _run(self, lines: Sequence[str], progress: BlockProgress | None) -> Iterator[None]:
        """Run the lines, a block from one to the next."""
        count, rows = self._own_lines(lines), self._moves.rows
        flow = ProgramFlow(lines, count, self.parameters, self.reader.codes, self.notes)
        while flow.at < count and not self._over:
            line = in_capitals(lines[flow.at])
            flow.at += 1
            self.line = self._moves.line = flow.at
            self.blocks += 1
            if self.blocks % _EVERY == 0 and progress is not None:
                progress(self.blocks)
            # Only what is repeated counts: a long program without a loop is as long as it is.
            if max(self.blocks - count - MAX_REPEATED, rows.count - MAX_ROWS) > 0:
                raise BlockError(f"The program has no end within {self.blocks - 1} blocks")
            if not flow.take(line):
                before = rows.count
                self._block(line)
                # A dwell is a row and no move: after it nothing is called.
                if flow.calls_after_moves and rows.count > before and rows.last_kind != DWELL:
                    flow.call_after_move()
            yield

    def _note_cycles_taken_in(self, lines: Sequence[str]) -> None:
        missing = self._path.cycles_taken_in
        if self._cycles.has_run and missing and not any(TAKES_IN.match(line) for line in lines):
            self.notes.append(missing)

    # -- one block -----------------------------------------------------------------

    def _block(self, line: str) -> None:
        """Do one block: its codes, then its numbers, then its pause, cycle or move."""
        pairs = self._letters_and_numbers(line)
        if not pairs:
            return
        # Before the block's codes: M3 beside S must not count as a spindle that turns already.
        turns, was_inverse = self._modal.now.turns, self._modal.now.is_inverse
        # Codes first, wherever they are in the block: they decide how its other words are read.
        codes = self._modal.take(tuple([letter + number for letter, number in pairs if letter in "GM"]))
        for code in codes.selects:
            # Before the move of the same block, whose end is in the new coordinates.
            if self._at.is_other_system(code):
                self._moves.rest_at_shift()
            self._at.select(str(code.facts.does), code)
        words = self._numbers.read(pairs, codes)
        if codes.modal.is_inverse != was_inverse:
            self._moves.forget_feed()
        waits = codes.waits or self._waits_for_speed(words.roles, turns=turns)
        self._keep_roles(words.roles, codes)
        if waits:
            self._moves.rest(codes.pauses)
        if codes.zones is not None:
            self._switch_zones(codes.zones, words, {letter for letter, _ in pairs})
        if codes.once:
            self._single.do(codes, words)
        elif words.axes or words.distances or words.centers:
            self._move(words, codes)
        else:
            self._check_alone(codes)
        self._over = codes.is_end

    def _check_alone(self, codes: BlockCodes) -> None:
        """Refuse a code that moves at the feed with no place beside it, where the control does."""
        fed = [code for code in codes.codes if code.facts.does in FED]
        if fed and "no-feed" in self._path.faults:
            self._moves.need_feed(codes.modal)
        if self._path.arcs_need_words and any(code.facts.does != "line" for code in fed):
            raise BlockError("An arc without a place and a center", "no-center")

    def _waits_for_speed(self, roles: dict[str, float], *, turns: bool) -> bool:
        if "spindle" not in roles or not self._path.speed_waits:
            return False
        return self._path.speed_waits == "always" or (turns and roles["spindle"] != self._moves.speed)

    def _letters_and_numbers(self, line: str) -> Sequence[tuple[str, str]]:
        """Return the words of a line as they are written; raises BlockError for one that a control refuses
        whole.
        """
        if 0 < self._path.longest < len(line):
            raise BlockError(f"A block has at most {self._path.longest} characters", "too-long")
        # Most lines are plain words, for which two patterns are faster than the reader of words.
        if _PLAIN.fullmatch(line):
            return _PAIRS.findall(line)
        if self._refused and line.lstrip()[:1] == self._refused:
            raise BlockError("A % in a program that does not begin with one")
        if self._path.plain_delete and re.match(r"[ \t]*/[0-9]", line):
            raise BlockError("A number behind the / in front of a block")
        expressions = self.reader.codes.facts.expressions
        if self._path.joined_blanks:
            line = without_blanks(line)
        if self._path.open_remarks:
            line = without_open_remark(line)
        return [(word.letter, word.number) for word in words_of(line, expressions)]

    def _keep_roles(self, roles: dict[str, float], codes: BlockCodes) -> None:
        """Keep what words set beyond their block: feed, speed, tool and its length, rounding."""
        if roles:
            self._moves.keep(roles)
        if roles.get("tool"):
            self.notes.append(self._path.tools_listed)
        if "length-offset" in roles and codes.once != "set-data":
            self._at.choose_length(int(roles["length-offset"]))
        if codes.sets_rounding:
            self._moves.round_corners(roles)

    def _switch_zones(self, code: KnownCode, words: BlockNumbers, letters: set[str]) -> None:
        for letter, other in code.facts.pairs.items():
            if letter in letters and other not in letters:
                raise BlockError(f"{code.code} with {letter} needs {other} too", "unpaired")
        if words.axes or words.distances or words.centers:
            raise BlockError(f"{code.code} with places beside it is not simulated: {code.facts.meaning}")
        self._moves.rows.guard_by(code.facts.zones)

    def _move(self, words: BlockNumbers, codes: BlockCodes) -> None:
        """Move along a line, an arc or the holes of a cycle, by the code that is active."""
        modal = codes.modal
        motion = codes.motion or modal.motion
        exact = EXACT if codes.is_exact else modal.corner
        if modal.cycle:
            self._cycles.run(words, modal, begins=codes.begins_cycle)
            return
        if motion == "":
            raise BlockError("No code of motion is active (G0, G1, G2 or G3)", "no-motion")
        is_arc = motion in ("arc-cw", "arc-ccw")
        target = self._target(words, codes, is_arc=is_arc)
        if is_arc:
            self._moves.arc(words, target, exact, modal, clockwise=motion == "arc-cw")
        elif words.centers:
            raise BlockError("The center of an arc in a block that is no arc", "unused-words")
        else:
            self._moves.go(target, RAPID if motion == "rapid" else LINE, exact, modal)
        if codes.probes:
            self._forget_probed()

    def _target(self, words: BlockNumbers, codes: BlockCodes, *, is_arc: bool) -> list[float]:
        """Return where a block moves to, in the coordinates of the program."""
        if not codes.in_machine:
            return self._at.target(words, is_absolute=codes.modal.is_absolute)
        if self._path.machine_absolute and not codes.modal.is_absolute:
            raise BlockError("A move in the coordinates of the machine is absolute")
        target = self._at.in_machine(words)
        if is_arc:
            raise BlockError("A move in the coordinates of the machine is straight", "machine-arc")
        return target

    def _forget_probed(self) -> None:
        """Take the values of the parameters that the probe sets: where it meets the part is not known."""
        if self._path.probed:
            first, last = self._path.probed
            for number in range(first, last + 1):
                self.parameters.pop(number, None)


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
) -> ToolPath:
    """Return the path of a program under a file; raises ProgramBlockError for a family of which no page
    prints one.
    """
    # More than there are rows: one part.
    (path,) = Interpreter(file, start, zero, retract).run(lines, most=2 * MAX_ROWS)
    return path


def path_parts(
    file: ParameterFile,
    lines: Sequence[str],
    most: int,
    *,
    start: Sequence[float] | None = None,
    zero: Mapping[str, float] | None = None,
    retract: float | None = None,
    progress: BlockProgress | None = None,
) -> Iterator[ToolPath]:
    """Return the path of `tool_path` in parts of about ``most`` rows."""
    return Interpreter(file, start, zero, retract).run(lines, progress, most)
