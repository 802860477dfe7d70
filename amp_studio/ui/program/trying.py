"""A program with other values, and under earlier versions of the file: what each try brings."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from amp_studio.files import ParameterFile, SavedVersion
from amp_studio.schema import Address, Value, read_address
from amp_studio.sim import (
    JobProgress,
    ProgramJob,
    ProgramRun,
    ProgramVersion,
    SimulationError,
    WhatIf,
    limit_tries,
    run_against,
    try_summary,
    typed_values,
    versions,
    what_if,
)
from amp_studio.ui.base.figures import show_value
from amp_studio.ui.base.time_words import stored_in_words
from amp_studio.ui.base.translated import tr

from .what_if_panel import WhatIfPanel

Apply = Callable[[Mapping[Address, Value]], bool]
EarlierFiles = Callable[[], Sequence[SavedVersion]]


class TriedProgram(Protocol):
    """The page whose program is tried."""

    file: ParameterFile
    job: ProgramJob | None
    outcome: ProgramRun | None

    def begin(self, work: Callable[[JobProgress], object], show: Callable[..., None]) -> None:
        """Do work in a thread."""

    def say(self, text: str) -> None:
        """Show a sentence."""

    def worded(self, text: str) -> str:
        """Return a sentence in the language of the window."""

    def run_again(self) -> None:
        """Run the program under the file of now."""


class ProgramTries:
    """Computes the rows of a panel of tries."""

    def __init__(self, page: TriedProgram, panel: WhatIfPanel, apply: Apply, earlier: EarlierFiles) -> None:
        self._page, self.panel, self._apply, self._earlier = page, panel, apply, earlier
        panel.limits_button.clicked.connect(self._try_limits)
        panel.earlier_button.clicked.connect(self._try_earlier)
        panel.ticked.connect(self._try_together)
        panel.applied.connect(self._apply_ticked)

    def attempt(self, text: str) -> None:
        """Run the program with other values."""
        before, job = self._page.outcome, self._page.job
        if before is None or job is None:
            self._page.say(tr("Open a part program first."))
            return
        try:
            values = typed_values(self._page.file, text.split(";"))
        except SimulationError as error:
            self._page.say(self._page.worded(str(error)))
            return
        self._compute([values], is_ticked=True)

    def _compute(self, tries: Sequence[Mapping[Address, Value]], *, is_ticked: bool) -> None:
        job = self._page.job
        assert job is not None
        self._page.begin(
            lambda show: what_if(job, self._page.file, tries, show),
            lambda found: self._show_tries(tries, found, is_ticked=is_ticked),
        )

    def _try_limits(self) -> None:
        """Run the program with more of each parameter that limits it."""
        if self._page.outcome is None:
            self._page.say(tr("Open a part program first."))
            return
        tries = list(limit_tries(self._page.file, self._page.outcome))
        if tries:
            # Not ticked: they show what each would save; the user chooses.
            self._compute(tries, is_ticked=False)
        else:
            self._page.say(tr("No parameter with a number limits this program."))

    def _try_earlier(self) -> None:
        """Run the program under the file as it was before its last saves."""
        job, before = self._page.job, self._page.outcome
        if before is None or job is None:
            self._page.say(tr("Open a part program first."))
            return
        earlier = self._earlier()
        if not earlier:
            self._page.say(tr("The file has no earlier versions: its history is empty."))
            return
        named = {self._version_name(each): each.file for each in earlier}
        self._page.begin(lambda show: versions(job, named, show), self._show_versions)

    def _version_name(self, version: SavedVersion) -> str:
        label = self._page.file.machine_schema.label
        changed = ", ".join(label(read_address(each)) for each in version.changed[:3])
        more = ", …" if len(version.changed) > 3 else ""
        return tr("Before {time}").format(time=stored_in_words(version.when)) + f" ({changed}{more})"

    def _show_versions(self, found: Sequence[ProgramVersion]) -> None:
        assert self._page.outcome is not None
        for each in found:
            if each.run is None:
                self._page.say(self._page.worded(each.why_not))
                continue
            self.panel.add(each.name, None, run_against(self._page.outcome, each.run), is_ticked=False)
        self._page.say(tr("{count} earlier versions").format(count=len(found)))

    def _try_together(self) -> None:
        """Run the program with all ticked changes: they are computed together, not added."""
        job = self._page.job
        # One change alone has been computed already.
        if job is None or len(self.panel.chosen()) < 2:
            return
        values = self.panel.values()
        self._page.begin(lambda show: what_if(job, self._page.file, [values], show)[0], self._show_together)

    def _show_together(self, tried: WhatIf) -> None:
        assert self._page.outcome is not None
        if tried.run is None:
            self._page.say(self._page.worded(tried.why_not))
            return
        self.panel.show_together(try_summary(self._page.file, self._page.outcome, tried))
        self._page.say("; ".join(map(self._page.worded, tried.not_allowed)))

    def _show_tries(
        self, values: Sequence[Mapping[Address, Value]], tries: Sequence[WhatIf], *, is_ticked: bool
    ) -> None:
        assert self._page.outcome is not None
        notes = []
        for each, tried in zip(values, tries, strict=True):
            if tried.run is None:
                notes.append(tried.why_not)
                continue
            found = try_summary(self._page.file, self._page.outcome, tried)
            changes = "\n".join(self._change_in_words(*change) for change in tried.changes.items())
            self.panel.add(changes, each, found, is_ticked=is_ticked)
            notes += tried.not_allowed
        self._page.say("; ".join(map(self._page.worded, notes)))
        self._try_together()

    def _change_in_words(self, address: Address, change: tuple[Value | None, Value]) -> str:
        parameter = self._page.file.schema.parameters[address[0]]
        before, after = (show_value(parameter, each) for each in change)
        if change[0] is not None and change[0].unit == change[1].unit:
            before = show_value(parameter, Value(change[0].value))  # the unit once: there is little room
        return f"{self._page.file.machine_schema.label(address)}\n{before} → {after}"

    def _apply_ticked(self) -> None:
        if self._apply(self.panel.values()):
            self._page.run_again()
