"""What would be found about the result of a merge, kept up to date choice by choice,
before anything is changed.
"""

from __future__ import annotations

from collections.abc import Sequence

from amp_studio.files import Merge, MergeChoice, Row, Typed
from amp_studio.schema import same_value

from .builder_rules import NO_RULES, BuilderRules
from .finding import NOT_SET, Finding
from .findings_between import new_findings
from .validator import Validator


class ResultCheck:
    """Checks a copy of the result. ``before`` are the findings of the file that the result goes into."""

    def __init__(self, merge: Merge, before: Sequence[Finding], own: BuilderRules = NO_RULES) -> None:
        self._before = before
        self._result = merge.result()
        self._validator = Validator(self._result, own)
        self.new: list[Finding] = new_findings(before, self._validator.run())
        """Errors, warnings and recommendations that the file does not have now."""

    def update(self, merge: Merge, most: int | None = None) -> bool:
        """Follow the choices of a merge of the same sources; returns False, with nothing done,
        if over ``most`` values changed.
        """
        wanted, file = merge.result(), self._result
        changed = [a for a in {*wanted.values, *file.values} if wanted.get(a) != file.get(a)]
        if most is not None and len(changed) > most:
            return False
        for address in changed:
            file.set(address, wanted.get(address))
        # A mark that comes or goes changes no value, and still decides whether an inactive value is
        # checked.
        marked = {a for a, _ in wanted.forced.items() ^ file.forced.items()}
        file.forced.clear()
        file.forced.update(wanted.forced)
        if wanted.header != file.header or wanted.unknown != file.unknown:
            file.header, file.unknown = wanted.header, wanted.unknown
            file.evaluation.forget()
            found = self._validator.run()
        else:
            found = self._validator.update({*changed, *marked})
        self.new = new_findings(self._before, found)
        return True

    def with_choice(self, row: Row, choice: MergeChoice) -> list[Finding]:
        """Return the findings about a parameter in the result if that were chosen for it."""
        if row.id.part != "value":
            return []
        value = choice.value if isinstance(choice, Typed) else row.of(choice)
        address, kept = row.address, self._result.get(row.address)
        mark = self._result.forced.get(address)
        try:
            if not same_value(kept, value):
                self._result.set(address, value)
            return [
                f for f in self._validator.update([address]) if address in f.addresses and f.rule != NOT_SET
            ]
        finally:
            self._result.set(address, kept)
            # Setting a value takes its mark away.
            if mark is not None:
                self._result.forced[address] = mark
            self._validator.update([address])
