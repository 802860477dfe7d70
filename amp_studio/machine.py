"""One machine: its parameter file, what is wrong with it, how it moves, its papers and texts.
The public library begins here.

``amp_studio`` gives what is in this module and in ``control``;
the verbs of the command line are made of the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from amp_studio.assignments import AssignmentError, MachineError, need_name, read_assignments, refused, typed
from amp_studio.files import ENDING, ParameterFileError, open_file
from amp_studio.given import checked_types
from amp_studio.schema import Value
from amp_studio.value_rows import entry_of, value_row

if TYPE_CHECKING:
    from amp_studio.files import Change, Comparison, Difference, Document, Notify, ParameterFile
    from amp_studio.formats import Account
    from amp_studio.schema import Address, ResolvedAddress, Schema
    from amp_studio.sim import MotionCheck, SweepWay, Trace
    from amp_studio.validate import BuilderRules, Finding, Fixed, Validator

    from .assignments import NewValue, NewValues
    from .value_rows import ParameterEntry

# Every verb that opens a file loads this module, and most need little of it: a function imports what it
# needs, so that a check starts as fast as without the library.


class MachineParameters:
    """The parameters of one machine, by any address that a user types: ``machine["1300@X"] = "5 mm"``.

    Every error that it raises on purpose is an AmpStudioError with one sentence for the user, and changes
    nothing. ``file`` is the parameter file in memory, for what this class does not have; what is below it in
    the program may change without notice.
    """

    def __init__(self, file: ParameterFile, path: Path | None = None, digest: str | None = None) -> None:
        self.file = file
        self.path = path
        """Where it was opened, or saved last; None for one that was never saved."""
        self.source = path
        """What it was read from: ``path``, or a control's own text, which is never saved in place."""
        self.account: Account | None = None
        """What became of each entry of an imported text; None for any other machine."""
        self.notes: list[str] = []
        """What the last save could not keep or do, each in one sentence."""
        self._digest = digest
        self.document: Document | None = None
        """The open document of a machine that ``edit`` has opened, until its ``with`` ends."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Let other programs edit the file again, where ``edit`` has opened it."""
        if self.document is not None:
            self.document.close()
            self.document = None

    def __repr__(self) -> str:
        name = self.path.name if self.path else self.file.header.name or "not saved"
        return (
            f"<MachineParameters {name}: {self.schema.family.name}, {self.file.machine}, {len(self)} values>"
        )

    def __reduce__(self) -> tuple[object, ...]:
        """Return what makes an independent one, by ``copy`` and in another process, without a lock."""
        from amp_studio.files import content_of

        return _made_again, (content_of(self.file), self.path, self.source, self._digest, self.account)

    @property
    def schema(self) -> Schema:
        """The typed schema of its family: every parameter with its range, unit, help and page."""
        return self.file.schema

    # -- values ------------------------------------------------------------------

    @checked_types
    def __getitem__(self, address: str) -> ParameterEntry:
        """Return one value by number, id or label, with ``@`` and the axis where there are several;
        ``.BIT`` is a field of a word.

        Raises UnknownParameterError.
        """
        from amp_studio.schema import resolve_address

        return entry_of(self.file, resolve_address(self.file.evaluation, address))

    def __contains__(self, address: object) -> bool:
        """Return whether this machine has a parameter of this address, set or not."""
        from amp_studio.schema import UnknownParameterError

        try:
            return isinstance(address, str) and bool(self[address])
        except UnknownParameterError:
            return False

    def __iter__(self) -> Iterator[str]:
        """Yield the address of every value that is set, in the order of the manual."""
        return (entry.param for entry in self.values())

    def __len__(self) -> int:
        """Return how many values are set."""
        return len(self.file.values)

    def row(self, resolved: ResolvedAddress, *, secrets: bool = False) -> dict[str, Any]:
        """Return a value, or one field of a word of bits, as ``get --json`` gives it.

        A secret that is set has neither ``value`` nor ``raw`` unless ``secrets`` asks for them.
        """
        return value_row(self.file, resolved, secrets=secrets)

    @checked_types
    def __setitem__(self, address: str, value: NewValue | ParameterEntry) -> None:
        """Set one value; raises AssignmentError, RangeError."""
        self.set({address: value})

    @checked_types
    def set(
        self, values: NewValues, *, force: str = "", notify: Notify = lambda _message: None
    ) -> list[Change]:
        """Set several values, all or none, and return what changed.

        ``force`` (a text that names by whom and why) takes values out of range and marks them. ``notify`` is
        called with which parameter a number means that is printed for several.
        Raises AssignmentError, RangeError.
        """
        return self.file.set_checked(self._read(values, notify), force=force)

    @checked_types
    def with_values(self, values: NewValues, *, notify: Notify = lambda _message: None) -> MachineParameters:
        """Return a copy with these values, to try them: they may be out of range, and this machine and its
        file stay as they are. Raises AssignmentError.
        """
        tried = MachineParameters(self.file.copy())
        tried.source = self.source
        for address, value in self._read(values, notify).items():
            tried.file.set(address, value)
        return tried

    def _read(self, values: NewValues, notify: Notify) -> dict[Address, Value | None]:
        """Return the values by address, each read in the light of those before it; raises AssignmentError."""
        pairs = list(
            values.items()
            if isinstance(values, Mapping)
            else values
            if isinstance(values, Iterable)
            else [values]
        )
        if not all(
            isinstance(pair, (tuple, list)) and len(pair) == 2 and isinstance(pair[0], str) for pair in pairs
        ):
            raise AssignmentError("values are {'1300@X': '5 mm'}, or pairs of an address and a value")
        return read_assignments(self.file, [(name, typed(value)) for name, value in pairs], notify)

    def values(self) -> tuple[ParameterEntry, ...]:
        """Return every value that is set, in the order of the manual."""
        from amp_studio.schema import ResolvedAddress

        addresses = (address for address in self.file.addresses() if address in self.file.values)
        return tuple(entry_of(self.file, ResolvedAddress(address)) for address in addresses)

    @checked_types
    def axis(self, text: str) -> str:
        """Return the axis that is named by itself or by its letter (``1``, ``X``); raises
        UnknownParameterError.
        """
        from amp_studio.files import axis_instances
        from amp_studio.schema import resolve_axis

        known = axis_instances(self.file)
        if not known:
            from amp_studio.sim import simulated_axes

            known = simulated_axes(self.file)
        return resolve_axis(self.file.evaluation, known, text)

    # -- what is wrong -------------------------------------------------------------

    def check(self, *, as_delivered: bool = False) -> tuple[Finding, ...]:
        """Return the findings, errors first; the builder's rules beside the file count too.

        Those about printed defaults of steps that are not reached are left out, as ``validate`` does,
        unless ``as_delivered``: a download asks for them.
        """
        from amp_studio.guide import found_in

        validator = self.validator()
        return validator.run() if as_delivered else found_in(validator)

    @checked_types
    def validator(self, rules: str | Path | None = None) -> Validator:
        """Return what finds the findings, where they are asked for more than once; ``run`` it first.

        ``rules`` is a file of a builder's own rules instead of the one beside the machine. One that
        cannot be used is a finding too.
        """
        from amp_studio.validate import validator_of

        return validator_of(self.file, self.source, self.builder_rules(rules))

    @checked_types
    def builder_rules(self, rules: str | Path | None = None) -> BuilderRules:
        """Return a builder's own rules: those beside the machine, or of the file ``rules``."""
        if rules is not None:
            from amp_studio.validate import axes_by_letter, read_builder_rules

            return read_builder_rules(Path(rules), self.schema, axes_by_letter(self.file))
        from amp_studio.validate import NO_RULES, rules_beside

        return rules_beside(self.source, self.file) if self.source else NO_RULES

    @checked_types
    def fix(
        self,
        rule: str | None = None,
        *,
        param: str | None = None,
        safe: bool = False,
        validator: Validator | None = None,
    ) -> list[Fixed]:
        """Make the suggested fixes of all findings, of one rule, or those that set one parameter, and return
        what changed; with ``safe`` only what moves nothing. A fix whose cause is likely another value, one
        that is wrong itself or by a slip, is made only where its rule or parameter is named.

        ``validator`` is one of this machine, which has the findings that are left afterwards.
        Raises MachineError for a rule that does not exist, UnknownParameterError.
        """
        from amp_studio.schema import resolve_addresses, unknown_name
        from amp_studio.validate import GENERAL_RULES, apply_fixes

        validator = validator or self.validator()
        if validator.file is not self.file:
            raise MachineError(f"the validator is one of another machine than {self!r}")
        rules = {*GENERAL_RULES, *(each.id for each in (*self.schema.rules, *validator.own.rules))}
        if rule is not None and rule not in rules:
            raise MachineError(unknown_name("rule", rule, sorted(rules)))
        named = resolve_addresses(self.file.evaluation, param) if param is not None else None

        def is_chosen(finding: Finding) -> bool:
            return (
                rule in (None, finding.rule)
                and (finding.safe or not safe)
                and (named is None or any(setting.address in named for setting in finding.fix))
            )

        validator.run()
        return apply_fixes(validator, is_chosen, even_doubtful=rule is not None or param is not None)

    @checked_types
    def diff(self, other: MachineParameters | str | Path) -> tuple[Difference, ...]:
        """Return what differs from another machine of the same family, or from a file; raises
        MachineError, ParameterFileError.
        """
        return self.compare(
            other if isinstance(other, MachineParameters) else open_machine(other)
        ).differences

    @checked_types
    def compare(self, other: MachineParameters) -> Comparison:
        """Return what differs from another machine of the same family, with how much is the same or not set.

        Where both have their schema from their control, the other one is read by the schema of this machine;
        what this schema does not have comes last. Raises MachineError.
        """
        from amp_studio.files import by_schema, compare, of_other_schema

        mine, its = self.schema, other.schema
        if its.family.family != mine.family.family:
            raise MachineError(f"one machine is for {mine.family.name}, the other for {its.family.name}")
        by_mine = by_schema(other.file, mine)
        found = compare(mine, self.file.values, by_mine.values)
        return replace(found, differences=(*found.differences, *of_other_schema(other.file, by_mine)))

    # -- what it does --------------------------------------------------------------

    @checked_types
    def simulate(
        self,
        scenario: str,
        axis: str | None = None,
        *,
        units: str | None = None,
        like: Trace | None = None,
        way: SweepWay | None = None,
        **settings: float | str,
    ) -> Trace:
        """Run a scenario (``step``, ``circle``, ``home``, …) with these values;
        ``move_feedrate=2000`` is the setting move.feedrate.

        ``units`` (``metric``, ``inch``) is the system of settings and trace, None for that of the file;
        ``like`` a trace whose move is made again; ``way`` the cores or the cluster of a sweep.
        Raises SimulationError, and MachineError for an empty axis.
        """
        from amp_studio.scenarios import setting_of_keyword
        from amp_studio.sim import simulate, sweep

        need_name(axis)
        given = {setting_of_keyword(name): value for name, value in settings.items()}
        if way is not None:
            return sweep(self.file, axis, given, units, way=way)
        return simulate(self.file, scenario, axis, given, units, like=like)

    @checked_types
    def check_motion(self, axis: str | None = None) -> tuple[MotionCheck, ...]:
        """Run every scenario that the machine allows, on one axis, by itself or its letter, or on all, and
        return the verdicts; raises UnknownParameterError, SimulationError.
        """
        from amp_studio.sim import check_motion

        return tuple(check_motion(self.file, None if axis is None else self.axis(axis)))

    @checked_types
    def report(self, path: str | Path, *, notify: Notify = lambda _note: None, **contents: Any) -> bool:
        """Write the documentation as the ending of ``path`` names it (.pdf, .html, .xlsx, .csv, .json, .txt);
        ``contents`` are ``sort``, ``changed_only``, ``inactive``, ``units``, ``language``, ``without``,
        ``paper``, ``check`` and ``programs``, as the verb ``report`` has them.

        Returns False where the project's own template failed and the standard report was written; ``notify``
        is called with the reason. Raises MachineError, SaveError.
        """
        from amp_studio.dossier import write_report
        from amp_studio.report import ReportNotMadeError, contents_of

        try:
            chosen, own = contents_of(contents), self.builder_rules()
            return write_report(self.file, path, chosen, source=self.source, own=own, notify=notify)
        except ReportNotMadeError as error:
            raise MachineError(str(error)) from None
        except (OSError, TypeError, ValueError) as error:
            raise refused(error) from None

    # -- files -----------------------------------------------------------------------

    @checked_types
    def save(self, path: str | Path | None = None, *, verb: str = "library") -> None:
        """Save in place, keeping the file before as its backup, or under a new name that no file has.

        ``verb`` is what the history calls the change. Raises MachineError, InUseError, ChangedOnDiskError,
        SaveError.
        """
        from amp_studio.files import Document, same_file

        target = Path(path) if path is not None else self.path
        if target is None:
            raise MachineError("a machine that was never saved needs a path: save('NAME.amp')")
        try:
            # By the file and not by its name: a link to the same file is saved in place.
            if self.path is None or not same_file(target, self.path):
                document = Document.create(self.file, target)
                document.close()
            elif self.document is not None:
                document = self.document
                document.save(verb)
            else:
                # By the digest a save is refused over what another program has written since.
                with Document(self.file, self.path, self._digest) as document:
                    document.save(verb)
        except OSError as error:
            raise refused(error) from None
        self.path = self.source = target
        self.notes, self._digest = document.notes, document.digest

    @checked_types
    def save_new(self, path: str | Path) -> None:
        """Save under a name that no file has, which the machine is called by from then on; raises
        MachineError and SaveError.
        """
        from amp_studio.files import text_of_name

        # Without a path the file is created, and refused where the name is taken.
        self.path = None
        self.file.header.name = text_of_name(Path(path).stem)
        self.save(path)

    @checked_types
    def export(
        self,
        path: str | Path,
        format_key: str | None = None,
        *,
        secrets: bool = False,
        notify: Notify = lambda _message: None,
    ) -> Account:
        """Write the values in a text format of the family, by the ending of ``path``;
        returns what became of each value.

        ``notify`` is called with what of the file before could not be kept. Raises FormatError, SaveError.
        """
        from amp_studio.formats import export_file

        return export_file(self.file, path, format_key, notify, secrets=secrets).account


@checked_types
def open_machine(
    path: str | Path, *, family: str | None = None, machine: str = "", notify: Notify = lambda _message: None
) -> MachineParameters:
    """Open a parameter file, or a control's own text; changes nothing.

    ``family`` and ``machine`` are those of a text that shall not decide by itself; ``notify`` is called with
    what a person should know of a text that was taken. Raises ParameterFileError, UnknownFamilyError.
    """
    path = Path(path)
    if path.suffix.casefold() != ENDING and _is_text_of_control(path):
        from amp_studio.formats import open_for_reading

        read = MachineParameters(open_for_reading(path, notify, family=family, machine=machine))
        read.source = path
        return read
    opened = open_file(path)
    return MachineParameters(opened.file, path, opened.digest)


def _is_text_of_control(path: Path) -> bool:
    from amp_studio.formats import is_text_of_control

    return is_text_of_control(path)


@checked_types
def edit_machine(path: str | Path, *, only_view: bool = False) -> MachineParameters:
    """Open a parameter file so that no other program edits it until the ``with`` of the machine ends.

    With ``only_view`` nothing is locked, and it cannot be saved in place; a control's own text is
    only viewed.
    Raises ParameterFileError, and InUseError while another program edits it.
    """
    from amp_studio.files import Document

    path = Path(path)
    if path.suffix.casefold() != ENDING and _is_text_of_control(path):
        if only_view:
            return open_machine(path)
        what = "a report" if path.suffix.lower() == ".pdf" else "a control's own text"
        raise ParameterFileError(path, None, f"is {what}, which is not changed: import it first")
    document = Document.view(path) if only_view else Document.open(path)
    edited = MachineParameters(document.file, document.path, document.digest)
    edited.document = document
    return edited


@checked_types
def family_schema(family: str) -> Schema:
    """Return the typed schema of a family; raises UnknownFamilyError, and DatabaseError for a bad fact."""
    from amp_studio.schema import load_schema

    return load_schema(family)


@checked_types
def new_machine(
    family: str, machine: str | None = None, axes: Iterable[str] = (), name: str = ""
) -> MachineParameters:
    """Return a machine with the printed defaults of a family and axes of these names; raises
    UnknownFamilyError, MachineError.
    """
    from amp_studio.files import AxisError, new_file

    try:
        names = list(axes)
        if not all(isinstance(axis, str) for axis in names):
            raise TypeError(f"axes are names such as X, not {names!r:.80}")
        return MachineParameters(new_file(family, machine, names, name))
    except AxisError as error:
        raise MachineError(str(error)) from None
    except (KeyError, TypeError, ValueError) as error:
        raise refused(error) from None


@checked_types
def import_text(
    path: str | Path,
    family: str | None = None,
    *,
    format_key: str | None = None,
    keep_unknown: bool = False,
    machine: str = "",
    listing: int = 0,
    notify: Notify = lambda _message: None,
) -> MachineParameters:
    """Return the machine of a control's own text, in any format of the family.

    Its ``account`` has what became of each entry; values out of range are in it too.

    ``machine`` is the machine type where the text shall not decide, ``listing`` which of several listings in
    the text, counted from 1 (0 is the last one); ``notify`` is called with what a person should know of a
    text that was taken. Raises FormatError, UnknownFamilyError, and MachineError for a file that cannot be
    read.
    """
    from amp_studio.formats import import_file

    accounts: list[Account] = []
    try:
        file = import_file(
            path,
            family,
            format_key=format_key,
            keep_unknown=keep_unknown,
            machine=machine,
            listing=listing,
            notify=notify,
            take_account=accounts.append,
        )
    except OSError as error:
        raise refused(error) from None
    imported = MachineParameters(file)
    (imported.account,) = accounts
    return imported


def _made_again(
    content: bytes, path: Path | None, source: Path | None, digest: str | None, account: Account | None
) -> MachineParameters:
    from amp_studio.files import read_content

    # The name is only for messages: nothing is read from there.
    machine = MachineParameters(read_content(path or Path("machine.amp"), content), path, digest)
    machine.source, machine.account = source, account
    return machine
