"""A block, typed: each word, the number it becomes, and what it does under a parameter file."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeGuard

from amp_studio.files import ParameterFile, fitted_axes
from amp_studio.schema import Address, WordUse, axis_name

from .codes import Call, ControlCodes
from .formats import Justified, NumberFormat, WordNumber, digits_of, number_of
from .words import TypedWord, without_blanks, without_open_remark, words_of

FED = ("line", "arc-cw", "arc-ccw")
"""What a code does that moves at the feed."""


@dataclass(frozen=True)
class BlockWord:
    """A word as the control reads it."""

    word: str
    letter: str
    number: float | None
    """None without one, for an expression, and for one that is no number to the control."""
    unit: str
    meaning: str
    params: tuple[Address, ...] = ()
    """The parameters that decide it."""
    page: str = ""
    fault: str = ""
    assumed: str = ""
    is_known: bool = True
    """False for a code that no page here names."""


@dataclass(frozen=True)
class ReadBlock:
    """One block."""

    text: str
    words: tuple[BlockWord, ...]

    @property
    def faults(self) -> tuple[str, ...]:
        """What the control cannot use."""
        return tuple(f"{word.word}: {word.fault}" for word in self.words if word.fault)

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What no source states."""
        return tuple(dict.fromkeys(f"assumed: {word.assumed}" for word in self.words if word.assumed))


class BlockReader:
    """Reads blocks one after the other; a modal code stays active for the blocks after it, as on the
    control.
    """

    def __init__(self, file: ParameterFile) -> None:
        self.file = file
        self.codes = ControlCodes(file)
        self.active = {
            group.key: code
            for group in self.codes.groups
            if (code := code_at_power_up(self.codes, group.key)) is not None
        }
        """Key of a group -> code without zeros."""

    def read(self, block: str) -> ReadBlock:
        """Return the words of a block in their order.
        Raises ProgramBlockError for a block that cannot be read at all.
        """
        line = block.strip()
        if (statement := self._statement(line)) is not None:
            return ReadBlock(line, (statement,))
        words = tuple(words_of(self._as_read(block), self.codes.facts.expressions))
        if (call := self._macro_call(words)) is not None:
            return ReadBlock(line, call)
        # All codes before any word: a G behind a word decides how that word is read too.
        here = {word.code for word in words if word.letter in "GM"}
        for code in sorted(here):
            known = self.codes.known.get(code)
            # A code that calls a program of the builder is no more the control's own: it switches nothing.
            if known and known.group and code not in self.codes.calls and not known.facts.only_amp:
                self.active[known.group.key] = code
        return ReadBlock(line, tuple(self._read_words(words, here)))

    def _as_read(self, block: str) -> str:
        """Return a block as the control takes its blanks and remarks."""
        path = self.codes.facts.path
        block = without_blanks(block) if path and path.joined_blanks else block
        return without_open_remark(block) if path and path.open_remarks else block

    def _statement(self, line: str) -> BlockWord | None:
        """Return a whole line as one word where it is a statement of the control."""
        for each in self.codes.facts.statements:
            if re.match(each.pattern, line.upper()):
                params = self.codes.whole(each.params)
                return BlockWord(line, "", None, "", each.meaning, params, each.page, assumed=each.assumed)
        return None

    def _read_words(self, words: Sequence[TypedWord], here: set[str]) -> Iterator[BlockWord]:
        """Yield each word as it is read, with what is wrong about it beside the others of its block."""
        seen: set[str] = set()
        letters = {word.letter for word in words}
        for word in words:
            read = self._word(word, here)
            if not read.fault and (fault := self._fault_beside(word.letter, letters, here)):
                read = replace(read, fault=fault)
            if word.letter in seen and word.letter not in "GM" and not read.fault:
                read = replace(read, assumed=f"which {word.letter}-word counts where a block has two")
            seen.add(word.letter)
            yield read

    def _fault_beside(self, letter: str, letters: set[str], here: set[str]) -> str:
        """Return what is wrong with a word beside the others of its block; "" for nothing."""
        if self.is_unused(letter, here):
            return "no code of the block uses this word"
        for code in here & self.codes.known.keys():
            facts = self.codes.known[code].facts
            if facts.pairs.get(letter, letter) not in letters:
                return f"{facts.unpaired}: {facts.code} with {letter} needs {facts.pairs[letter]} too"
        return ""

    def is_unused(self, letter: str, here: set[str]) -> bool:
        """Return whether the control refuses a letter, as it has no code beside it that uses it."""
        path = self.codes.facts.path
        needed = path.needs.get(letter) if path else None
        # Arcs and cycles go on as long as their code is active; each other code needs its words beside it.
        continues = (self.active.get(key) for key in ("motion", "cycle"))
        return needed is not None and not {*here, *continues}.intersection(needed)

    def _macro_call(self, words: tuple[TypedWord, ...]) -> tuple[BlockWord, ...] | None:
        """Return a call whose other words are values of variables; None for another block."""
        numbers = self.codes.facts.variables
        # Only the first word behind the block number: a call whose words are variables begins its block.
        begin = 1 if words and words[0].letter == "N" else 0
        head = self.codes.known.get(words[begin].code) if begin < len(words) else None
        if head is None or head.facts.does not in ("subroutine", "modal-subroutine"):
            return None
        found = [self._word(word, {words[begin].code}) for word in words[: begin + 1]]
        for word in words[begin + 1 :]:
            if word.letter not in numbers:
                found.append(self._word(word, {words[begin].code}))
                continue
            # Without a format: the values of variables have none of a word.
            number = self.number(word, None, False)
            meaning = f"value of #{numbers[word.letter]} in the subroutine"
            found.append(
                BlockWord(
                    word.text,
                    word.letter,
                    number.value,
                    "",
                    meaning,
                    (),
                    head.facts.page,
                    number.fault,
                    number.assumed,
                )
            )
        return tuple(found)

    # -- codes -------------------------------------------------------------------

    def _word(self, word: TypedWord, here: set[str]) -> BlockWord:
        """Return a word as code, number with a use, coordinate of an axis, or call of a program."""
        if word.letter in ("G", "M"):
            return self._code(word)
        use = self.use(word.letter, here)
        read = self._of_use(word, use, here) if use else self._of_axis(word)
        calls = self.codes.facts.word_calls
        if calls and word.letter in calls.programs:
            address = (calls.param, word.letter)
            if self.file.evaluation.canonical(address) is True:
                meaning = f"calls the program {calls.programs[word.letter]} with its number"
                number, unit = (read.number, read.unit) if read else (None, "")
                fault = read.fault if read else ""
                return BlockWord(word.text, word.letter, number, unit, meaning, (address,), calls.page, fault)
        return read or BlockWord(
            word.text, word.letter, None, "", "not known", fault="no page here names such a word"
        )

    def _code(self, word: TypedWord) -> BlockWord:
        """Return what a G or M code of a block means, and why it may have no effect."""
        number = float(word.number) if word.number and not word.is_expression else None
        if number is None:
            return BlockWord(word.text, word.letter, None, "", "no number", fault="a code without its number")
        # First: a call of the builder takes the place of the control's own code.
        if (call := self.codes.calls.get(word.code)) is not None:
            return self._call(word, number, call)
        known = self.codes.known.get(word.code)
        if known is None:
            return BlockWord(word.text, word.letter, number, "", "no page here names it", is_known=False)
        group, facts = known.group, known.facts
        named = (*((group.power_up,) if group and group.power_up else ()), *facts.params)
        fault = "the control knows this code and does not do it" if facts.refused else ""
        if facts.only_amp:
            fault = "a parameter can make it active, a program cannot"
        return BlockWord(
            word.text,
            word.letter,
            number,
            "",
            facts.meaning,
            self.codes.whole(named),
            facts.page,
            fault,
            facts.assumed,
        )

    def _call(self, word: TypedWord, number: float, call: Call) -> BlockWord:
        kind = {None: "", True: ", modal", False: ", not modal"}[call.modal]
        also = self.codes.known.get(word.code)
        instead = f", in place of: {also.facts.meaning}" if also else ""
        meaning = f"calls the program {call.program}{kind}{instead}"
        return BlockWord(word.text, word.letter, number, "", meaning, call.params, call.facts.page)

    # -- words -------------------------------------------------------------------

    def use(self, letter: str, here: set[str]) -> WordUse | None:
        """Return how a letter is read now: the first of its uses whose conditions are true."""
        now, modes = {*here, *self.active.values()}, self._modes(here)
        uses = (use for listed in self.codes.facts.letters if listed.letter == letter for use in listed.uses)
        return next((use for use in uses if self._applies(use, here if use.in_block else now, modes)), None)

    def _applies(self, use: WordUse, codes: set[str], modes: set[str]) -> bool:
        """Return whether a letter has this use with these codes, in these modes."""
        return (
            (not use.codes or any(TypedWord(code[0], code[1:], code).code in codes for code in use.codes))
            and (not use.mode or use.mode in modes)
            and (not use.systems or self.codes.system in use.systems)
        )

    def _modes(self, here: set[str]) -> set[str]:
        """Return the modes of the codes of a block and of those that are active."""
        known = self.codes.known
        return {known[code].facts.mode for code in (*here, *self.active.values()) if code in known}

    def is_inch(self) -> bool:
        """Return whether lengths are in inch now."""
        for code in self.active.values():
            if (known := self.codes.known.get(code)) and known.facts.mode in ("inch", "metric"):
                return known.facts.mode == "inch"
        # No code of the unit is active: the parameter of power-up decides.
        units = self.codes.facts.units
        return units is not None and self.file.evaluation.canonical((units.param, "")) in units.inch

    def _of_use(self, word: TypedWord, use: WordUse, here: set[str]) -> BlockWord:
        """Return a word whose number has a use, as F or S, with its unit and what speaks against it."""
        unit = use.unit if isinstance(use.unit, str) else use.unit["in" if self.is_inch() else "mm"]
        number = self.number(word, (use.format, "") if use.format else None, use.whole)
        if use.bounds and number.value is not None and not use.bounds[0] <= number.value <= use.bounds[1]:
            number = replace(number, fault=f"{use.bounds[0]:g} to {use.bounds[1]:g} are printed")
        if use.role == "feed" and number.value is not None and self._is_no_feed(number.value, here):
            number = replace(number, fault="it is no feed: it must be above 0")
        named = (*((use.format,) if use.format else ()), *use.params)
        params = (*self.codes.whole(named), *self._justifying(word, use.format is None))
        return BlockWord(
            word.text,
            word.letter,
            number.value,
            unit,
            use.meaning,
            params,
            use.page,
            number.fault,
            number.assumed,
        )

    def _is_no_feed(self, feed: float, here: set[str]) -> bool:
        """Return whether a feed is below 0, or 0 in a block that moves at it."""
        moves = (self.codes.known[code].facts.does in FED for code in here if code in self.codes.known)
        return feed < 0.0 or (feed == 0.0 and any(moves))

    def _of_axis(self, word: TypedWord) -> BlockWord | None:
        """Return a word of an axis, as X or I; None where the letter is that of no axis."""
        axes = self.codes.facts.axes
        found = next(iter(self.axis_words(word.letter)), None)
        if axes is None or found is None:
            return None
        axis, meaning, named = found
        number = self.number(word, (axes.format, axis) if axes.format else None, False)
        params = (*self.codes.whole(named, axis), *self._justifying(word, axes.format is None))
        return BlockWord(
            word.text,
            word.letter,
            number.value,
            self.unit_of(axis),
            meaning,
            params,
            axes.page,
            number.fault,
            number.assumed,
        )

    def axis_words(self, letter: str) -> Iterator[tuple[str, str, tuple[str, ...]]]:
        """Yield axis, meaning and parameters of a letter that names an axis, its distance or its arc
        center.
        """
        axes = self.codes.facts.axes
        if axes is None:
            return
        form = (axes.format,) if axes.format else ()
        for axis in fitted_axes(self.file):
            name = axis_name(self.file.evaluation, axis) or axis
            if name.upper() == letter:
                yield axis, f"{self._way()} {name}", (*form, *self._name_parameter())
            if self.codes.system in axes.incremental_systems and self._names(axes.incremental, axis, letter):
                yield axis, f"distance of a move along {name}", (*form, axes.incremental)
            if self._names(axes.integrand, axis, letter):
                yield axis, f"center of an arc along {name}", (*form, axes.integrand)
            if axes.integrands.get(letter) == name:
                yield axis, f"center of an arc along {name}", axes.integrand_params

    def _way(self) -> str:
        """Return what a number of an axis is in the active mode."""
        return "distance of a move along" if "incremental" in self._modes(set()) else "position on"

    def _name_parameter(self) -> tuple[str, ...]:
        """Return the parameter that names the axes, where there is one."""
        declared = self.file.schema.family.axes
        return (declared.name,) if declared and declared.name else ()

    def _names(self, parameter: str | None, axis: str, letter: str) -> TypeGuard[str]:
        """Return whether a choice of an axis is a letter."""
        return (
            parameter is not None
            and str(self.file.evaluation.canonical((parameter, axis)) or "").upper() == letter
        )

    def unit_of(self, axis: str) -> str:
        family, evaluation = self.file.schema.family, self.file.evaluation
        if family.angular_when and evaluation.is_true(family.angular_when, axis, "axis"):
            return "deg"
        return "in" if self.is_inch() else "mm"

    # -- numbers -------------------------------------------------------------------

    def number(self, word: TypedWord, form: Address | None, whole: bool) -> WordNumber:
        """Return the number of a word by its format."""
        if word.is_expression:
            return WordNumber(
                None, assumed="that the control works out the expression as it is printed for it"
            )
        return self.number_in(word.number, self.number_format(form, whole))

    def number_in(self, typed: str, form: NumberFormat) -> WordNumber:
        """Return the number that is typed in a word, which may be missing."""
        return number_of(typed, form) if typed else self._without_number()

    def number_format(self, form: Address | None, whole: bool) -> NumberFormat:
        """Return how a number is read by the format of a parameter, in the present unit."""
        if whole and form is None:
            return NumberFormat(justified=self.justified(), is_whole=True)
        digits, assumed = None, ""
        choice = self.file.evaluation.canonical(form) if form else ""
        if choice is None:
            assert form is not None
            parameter_name = self.file.schema.parameters[form[0]].name
            assumed = f"any number of digits, as {parameter_name} is not set"
        elif isinstance(choice, str) and choice[:1].isdigit():
            digits = digits_of(choice, self.is_inch())
        return NumberFormat(digits, self.justified(), assumed)

    def _without_number(self) -> WordNumber:
        facts = self.codes.facts.no_number
        is_error = self.file.evaluation.canonical((facts.param, "")) if facts else None
        if is_error is False:
            return WordNumber(0.0)
        if is_error is True:
            return WordNumber(None, "a letter without a number")
        return WordNumber(None, "a letter without a number", assumed="that it is an error" if facts else "")

    def justified(self) -> Justified:
        zeros = self.codes.facts.zeros
        if zeros is None:
            return ""
        leading = self.file.evaluation.canonical((zeros.leading, "")) is True
        trailing = self.file.evaluation.canonical((zeros.trailing, "")) is True
        return "both" if leading and trailing else "right" if leading else "left" if trailing else ""

    def _justifying(self, word: TypedWord, without_format: bool) -> tuple[Address, ...]:
        """Return the parameters that place the digits of a number without a point."""
        facts = self.codes.facts
        if not word.number:
            return ((facts.no_number.param, ""),) if facts.no_number else ()
        if facts.zeros is None or without_format or "." in word.number:
            return ()
        return (facts.zeros.leading, ""), (facts.zeros.trailing, "")


def code_at_power_up(codes: ControlCodes, key: str) -> str | None:
    """Return the code of a group that is active after power-up, without zeros; None where none is,
    or it is not set.
    """
    group = next(group for group in codes.groups if group.key == key)
    if group.power_up is None:
        return codes.started.get(key)
    address = codes.whole((group.power_up,))[0]
    if not codes.file.evaluation.state(address).is_active:
        return None
    choice = codes.file.evaluation.canonical(address)
    if choice is None:  # not set; codes that power-up cannot choose have None too
        return None
    for code, known in codes.known.items():
        if known.group is group and known.facts.choice == choice:
            return code
    return None
