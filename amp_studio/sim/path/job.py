"""A program under a file, and under the same file with other values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from amp_studio.files import ParameterFile
from amp_studio.programs import ProgramBlockError, path_letters, path_parts
from amp_studio.schema import Address, Value, fault
from amp_studio.sim.axis_parameters import ParameterValue
from amp_studio.sim.errors import SimulationError

from .program import ProgramRun, home_positions, run_program
from .stretches import STRETCH

JobProgress = Callable[[str, float], None]
"""progress(what, share of it that is done); may raise to cancel."""


@dataclass(frozen=True)
class ProgramJob:
    """What is run: the text of a program and where it begins. Lengths in mm or deg."""

    lines: Sequence[str]
    start: Sequence[float] | None = None
    """Of the axes in their order; None for where they are home."""
    zero: Mapping[str, float] | None = None
    """Axis letter -> place of the program's zero in the machine, instead of the file's work coordinates."""
    retract: float | None = None
    """Of a chip-breaking cycle, where no parameter has it."""
    override: float = 1.0
    rapid_override: float = 1.0
    model: Mapping[str, ParameterValue] = field(default_factory=dict)
    with_contour: bool = True

    def run(self, file: ParameterFile, progress: JobProgress = lambda _what, _share: None) -> ProgramRun:
        """Run it under a file; raises SimulationError, ProgramBlockError."""
        total = max(len(self.lines), 1)
        parts = path_parts(
            file,
            self.lines,
            STRETCH,
            start=home_positions(file, path_letters(file)) if self.start is None else self.start,
            zero=self.zero,
            retract=self.retract,
            progress=lambda done: progress("reads the program", min(done / total, 1.0)),
        )
        return run_program(
            file,
            parts,
            override=self.override,
            rapid_override=self.rapid_override,
            model=self.model,
            with_contour=self.with_contour,
            progress=lambda share: progress("plans the path", share),
        )


@dataclass(frozen=True)
class WhatIf:
    """One try with other values."""

    changes: Mapping[Address, tuple[Value | None, Value]]
    """Address -> value of the file, tried value."""
    run: ProgramRun | None
    why_not: str
    """Why there is none."""
    not_allowed: tuple[str, ...]
    """Values that are not allowed, each a sentence."""


def what_if(
    job: ProgramJob,
    file: ParameterFile,
    tries: Sequence[Mapping[Address, Value]],
    progress: JobProgress = lambda _what, _share: None,
) -> list[WhatIf]:
    """Return the program with each set of other values, computed again each time; the file stays as it is."""
    found = []
    for values in tries:
        tried = file.copy()
        changes = {address: (file.get(address), value) for address, value in values.items()}
        wrong = tuple(
            text for address, value in values.items() if (text := fault(file.evaluation, address, value))
        )
        # A value that is not allowed is tried too, and named: the question may be what the limit costs.
        for address, value in values.items():
            tried.set(address, value)
        try:
            run = job.run(tried, progress)
            run.plan.forget_rows()
            found.append(WhatIf(changes, run, "", wrong))
        except SimulationError as error:
            found.append(WhatIf(changes, None, f"{error}", wrong))
    return found


@dataclass(frozen=True)
class ProgramVersion:
    """The program under another file: an older one, or that of another machine."""

    name: str
    run: ProgramRun | None
    why_not: str
    """Why there is none."""


def versions(
    job: ProgramJob, files: Mapping[str, ParameterFile], progress: JobProgress = lambda _what, _share: None
) -> list[ProgramVersion]:
    """Return the program under other files, by their names."""
    found = []
    for name, file in files.items():
        try:
            run = job.run(file, progress)
            run.plan.forget_rows()
            found.append(ProgramVersion(name, run, ""))
        except (SimulationError, ProgramBlockError) as error:
            found.append(ProgramVersion(name, None, f"{error}"))
    return found


def scaled(file: ParameterFile, address: Address, share: float) -> Value:
    """Return the value of a parameter times a share; raises SimulationError where it has no number."""
    value = file.get(address)
    if value is None or isinstance(value.value, (bool, str)):
        named = file.machine_schema.short(address)
        raise SimulationError(f"{named} has no number that a share could be taken of", address[0])
    # Nine digits: the rounding of a float product is not written into a file.
    number = value.value * share
    return replace(value, value=round(number) if isinstance(value.value, int) else float(f"{number:.9g}"))
