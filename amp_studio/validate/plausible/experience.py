"""All that is asked of one file out of experience, kept up to date edit by edit."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from amp_studio.files import ParameterFile
from amp_studio.schema import Address
from amp_studio.validate.finding import Finding

from .alike import ALIKE, Alike
from .axis_columns import COUNTED, UNIFORM
from .axis_relations import AMONG, GEAR, PROPORTION, TABLE, TOWARDS, TRAVEL, UPRIGHT
from .axis_words import NO_AXIS, AxisWords
from .earlier import EARLIER, Earlier, EarlierValues
from .relations import ABOVE, LADDER, NEEDS, QUOTIENT, UNEQUAL, Relations
from .rows import ROW, EqualRows
from .seldom import SELDOM, SeldomChanged
from .smooth import JUMP, SmoothTables, TextCurves
from .steps import NOT_CLOSED, STROKE, TURN_BACK, StepTables
from .usual import USUAL, UsualValues
from .within import OUTSIDE, WithinTravel

TITLES = {
    ALIKE: "Like axes that differ in one value",
    USUAL: "A value that is not usual",
    SELDOM: "A value that is seldom changed",
    JUMP: "A value that jumps out of its table",
    ROW: "A row that is not like the others",
    NO_AXIS: "A bit of an axis that is not there",
    NOT_CLOSED: "A motion that does not come back to where it began",
    STROKE: "A motion that is longer than the travel",
    TURN_BACK: "A single step backwards",
    UNEQUAL: "Values that are equal as a rule",
    LADDER: "A value that does not fit between its neighbours",
    QUOTIENT: "Two values far from each other",
    AMONG: "Like axes far from each other",
    UNIFORM: "One axis that is not as the others",
    COUNTED: "A connector out of the order of the axes",
    TABLE: "X and Y of a table that differ",
    UPRIGHT: "An upright axis that is faster than the table, or far slower",
    TOWARDS: "A search that goes to the other end",
    TRAVEL: "Travels that are out of proportion",
    GEAR: "Gears that do not follow each other",
    PROPORTION: "Shares that are not equal",
    NEEDS: "A value without another one that it needs",
    ABOVE: "A speed above the rapid",
    OUTSIDE: "A position outside the travel",
    EARLIER: "A value that was another one by a slip's factor",
}
"""Rule -> its title."""
OF_A_SLIP = frozenset({ALIKE, TABLE, EARLIER, ROW, COUNTED, UNIFORM})
"""Rules that name the one value that a slip explains, and not two of which one is wrong."""


class Experience:
    """The recommendations about one file that no manual prints."""

    def __init__(self, file: ParameterFile, earlier: Sequence[Earlier] = ()) -> None:
        self._file = file
        tables = SmoothTables(file), TextCurves(file), StepTables(file), EqualRows(file)
        words = AxisWords(file), WithinTravel(file), Relations(file), SeldomChanged(file)
        self._parts = (Alike(file), UsualValues(file), *tables, *words)
        self._earlier = EarlierValues(file, earlier)
        self._findings: tuple[Finding, ...] | None = None
        self._is_stale = True

    def compare_with(self, earlier: Sequence[Earlier]) -> None:
        """Compare with other earlier values from now on; all else stays as it is."""
        self._earlier = EarlierValues(self._file, earlier)
        self._findings = None
        # ``findings`` does it where everything is stale, once.
        if not self._is_stale:
            self._earlier.check_all()

    def mark_stale(self) -> None:
        """Look at the whole file, once the findings are asked for: between them there may be many edits."""
        self._findings, self._is_stale = None, True

    def recheck(self, changed: Iterable[Address]) -> None:
        """Look again at the changed addresses; one that decides which values count is a reason
        to check all.
        """
        addresses = list(changed)
        if self._is_stale:
            return
        # Values became active or inactive with it, in any of the tables.
        if any(map(self._file.evaluation.decides_states, addresses)):
            self.mark_stale()
            return
        for address in addresses:
            for part in (*self._parts, self._earlier):
                if part.recheck(address):
                    self._findings = None

    def findings(self) -> tuple[Finding, ...]:
        """Return what there is now, in no order."""
        if self._is_stale:
            for part in (*self._parts, self._earlier):
                part.check_all()
            self._is_stale = False
        if self._findings is None:
            found = [finding for part in self._parts for finding in part.findings()]
            # One value gets one question: what its like say now is a better reason than what it once was.
            asked = {cause for finding in found for cause in finding.causes}
            self._findings = (*found, *self._earlier.findings(asked))
        return self._findings
