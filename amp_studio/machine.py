"""One machine: its parameter file, what is wrong with it, how it moves, its papers and texts.
The public library begins here.

``amp_studio`` gives what is in this module and in ``control``;
the verbs of the command line are made of the same.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from amp_studio.errors import AmpStudioError
from amp_studio.files import Document, ParameterFile, compare, new_file, open_file, same_file
from amp_studio.guide import found_in
from amp_studio.schema import (
    Address,
    Parameter,
    Schema,
    UnknownParameterError,
    Value,
    fault,
    field_at,
    field_value,
    labels_of_word,
    real_value,
    resolve_address,
    show_value,
    stored_number,
    with_field,
    write_number,
    write_value,
)
from amp_studio.validate import (
    NO_RULES,
    BuilderRules,
    Finding,
    Fixed,
    Validator,
    apply_fixes,
    earlier_beside,
    enter,
    rules_beside,
)

if TYPE_CHECKING:
    from amp_studio.files import Change, Difference
    from amp_studio.formats import Account
    from amp_studio.sim import Trace

NOT_SET = "not-set"
"""The text of an assignment that clears a parameter."""
_OF_SCENARIOS = ("move", "model", "tune", "sweep", "gear", "cam")
"""First words of the settings of a scenario that are no parameters."""

NewValue = str | float | bool | Value | None
"""What can be set: a text as a user types it (``5 mm``), a number in the unit of the file, yes or no,
a Value, None to clear."""


class MachineError(AmpStudioError, ValueError):
    """What was asked of a machine cannot be done; nothing was changed, and nothing was written."""


class AssignmentError(MachineError):
    """Values that cannot be set; the text names each of them, and nothing was changed."""


@dataclass(frozen=True)
class ParameterEntry:
    """One value of a machine, as it was when it was read."""

    param: str
    """Its number, or its address where it has none."""
    id: str
    instance: str
    value: float | bool | str | None
    """A number in ``unit``, the label of a choice, a text, yes or no; None where it is not set,
    and for a secret."""
    unit: str
    raw: float | str | None
    """What the control stores; None where it is unknown."""
    default: bool
    """Whether it is the printed default."""
    state: str
    """``in-force``, ``ignored``, ``unusable`` or ``hidden``."""
    forced: bool
    """Whether it is out of range on purpose."""
    text: str
    """Value and unit as a report prints them."""

    def __str__(self) -> str:
        return self.text


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
        self._digest = digest

    def __repr__(self) -> str:
        name = self.path.name if self.path else self.file.header.name or "not saved"
        return (
            f"<MachineParameters {name}: {self.schema.family.name}, {self.file.machine},"
            f" {len(self.file.values)} values>"
        )

    @property
    def schema(self) -> Schema:
        """The typed schema of its family: every parameter with its range, unit, help and page."""
        return self.file.schema

    # -- values ------------------------------------------------------------------

    def __getitem__(self, address: str) -> ParameterEntry:
        """Return one value by number, id or label, with ``@`` and the axis where there are several;
        ``.BIT`` is a field of a word.

        Raises UnknownParameterError.
        """
        found = resolve_address(self.file.evaluation, address)
        if found.bit is not None:
            row = bit_row(self.file, found.address, found.bit)
            shown = "not set" if row["value"] is None else str(row["value"])
            return ParameterEntry(**{k: v for k, v in row.items() if k not in ("bit", "label")}, text=shown)
        return _entry(self.file, found.address)

    def __setitem__(self, address: str, value: NewValue | ParameterEntry) -> None:
        """Set one value; raises AssignmentError, RangeError."""
        self.set({address: value})

    def set(self, values: Mapping[str, NewValue | ParameterEntry], *, force: str = "") -> list[Change]:
        """Set several values, all or none, and return what changed.

        ``force`` (a text that names by whom and why) takes values out of range and marks them.
        Raises AssignmentError, RangeError.
        """
        wanted = read_assignments(self.file, ((name, _typed(value)) for name, value in values.items()))
        return self.file.set_many(wanted, force=force)

    def values(self) -> tuple[ParameterEntry, ...]:
        """Return every value that is set, in the order of the manual."""
        return tuple(
            _entry(self.file, address) for address in self.file.addresses() if address in self.file.values
        )

    # -- what is wrong -------------------------------------------------------------

    def check(self, *, as_delivered: bool = False) -> tuple[Finding, ...]:
        """Return the findings, errors first; the builder's rules beside the file count too.

        Those about printed defaults of steps that nobody has reached are left out, as ``validate`` does,
        unless
        ``as_delivered``: a download asks for them.
        """
        validator = self._validator()
        return validator.run() if as_delivered else found_in(validator)

    def fix(self, rule: str = "", *, safe: bool = False) -> list[Fixed]:
        """Make the suggested fixes of all findings, or of one rule, and return what changed;
        with ``safe`` only what moves nothing.
        """
        return apply_fixes(self._validator(), lambda f: rule in ("", f.rule) and (f.safe or not safe))

    def diff(self, other: MachineParameters | str | Path) -> tuple[Difference, ...]:
        """Return what differs from another machine of the same family, or from a file; raises
        MachineError.
        """
        there = other if isinstance(other, MachineParameters) else open_machine(other)
        if there.schema.family.family != self.schema.family.family:
            raise MachineError(f"{there!r} is of another family than {self!r}")
        return compare(self.schema, self.file.values, there.file.values).differences

    def _validator(self) -> Validator:
        earlier = earlier_beside(self.path, self.file) if self.path else ()
        return Validator(self.file, self._rules(), earlier)

    def _rules(self) -> BuilderRules:
        return rules_beside(self.path, self.file) if self.path else NO_RULES

    # -- what it does --------------------------------------------------------------

    def simulate(self, scenario: str, axis: str | None = None, **settings: float | str) -> Trace:
        """Run a scenario (``step``, ``circle``, ``home``, …) with these values;
        ``move_feedrate=2000`` is the setting move.feedrate.

        Raises SimulationError.
        """
        from amp_studio.sim import simulate

        return simulate(
            self.file, scenario, axis, {_setting(name): value for name, value in settings.items()}
        )

    def report(self, path: str | Path, **contents: Any) -> None:
        """Write the documentation as the ending of ``path`` names it (.pdf, .html, .xlsx, .csv, .json, .txt);
        ``contents`` are those of Contents.

        Raises MachineError, SaveError.
        """
        from amp_studio.dossier import write_report
        from amp_studio.report import Contents

        try:
            write_report(self.file, path, Contents(**contents), source=self.path, own=self._rules())
        except (TypeError, ValueError) as error:
            raise error if isinstance(error, AmpStudioError) else MachineError(str(error)) from None

    # -- files -----------------------------------------------------------------------

    def save(self, path: str | Path | None = None) -> None:
        """Save in place, keeping the file before as its backup, or under a new name that no file has.

        Raises MachineError, InUseError, ChangedOnDiskError, SaveError.
        """
        target = Path(path) if path is not None else self.path
        if target is None:
            raise MachineError("a machine that was never saved needs a path: save('NAME.amp')")
        try:
            if self.path is not None and same_file(target, self.path):
                with Document(self.file, self.path, self._digest) as document:
                    document.save("library")
            else:
                document = Document.create(self.file, target)
                document.close()
        except OSError as error:
            raise MachineError(str(error)) from None
        self.path, self._digest = target, document.digest

    def export(self, path: str | Path, format_key: str | None = None, *, secrets: bool = False) -> Account:
        """Write the values in a text format of the family, by the ending of ``path``;
        returns what became of each value.

        Raises FormatError, SaveError.
        """
        from amp_studio.formats import export_file

        return export_file(self.file, path, format_key, secrets=secrets).account


def open_machine(path: str | Path) -> MachineParameters:
    """Open a parameter file, or a control's own text; raises ParameterFileError and changes nothing."""
    from amp_studio.formats import is_text_of_control, open_for_reading

    path = Path(path)
    if is_text_of_control(path):
        return MachineParameters(open_for_reading(path))
    opened = open_file(path)
    return MachineParameters(opened.file, path, opened.digest)


def new_machine(
    family: str, machine: str | None = None, axes: Iterable[str] = (), name: str = ""
) -> MachineParameters:
    """Return a machine with the printed defaults of a family and axes of these names; raises MachineError."""
    try:
        return MachineParameters(new_file(family, machine, list(axes), name))
    except (KeyError, ValueError) as error:
        raise error if isinstance(error, AmpStudioError) else MachineError(str(error)) from None


def import_text(
    path: str | Path, family: str | None = None, *, keep_unknown: bool = False
) -> MachineParameters:
    """Return the machine of a control's own text, in any format of the family; raises FormatError."""
    from amp_studio.formats import import_file

    return MachineParameters(import_file(path, family, keep_unknown=keep_unknown))


def _setting(name: str) -> str:
    """Return the setting of a scenario that a name of Python means: ``move_feedrate``, ``servo__p_gain``."""
    first, _, rest = name.partition("_")
    return f"{first}.{rest}" if first in _OF_SCENARIOS and "." not in name else name.replace("__", ".")


def _typed(value: NewValue | ParameterEntry) -> str | Value:
    """Return a new value as a user types it."""
    if isinstance(value, ParameterEntry):
        return NOT_SET if value.value is None else f"{_plain(value.value)} {value.unit}".rstrip()
    if isinstance(value, (str, Value)):
        return value
    return NOT_SET if value is None else _plain(value)


def _plain(value: float | bool | str) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else write_number(value)


# -- what a user types, and what he gets


def read_assignments(
    file: ParameterFile,
    wanted: Iterable[tuple[str, str | Value]],
    notify: Callable[[str], object] = lambda _message: None,
) -> dict[Address, Value | None]:
    """Read assignments in order, each in the light of those before it; the file itself is not changed.

    Raises AssignmentError that names everything that cannot be set. ``notify`` is called with which parameter
    a number means that is printed for several. A value is cleared by ``NOT_SET`` only:
    an empty text may be a variable without a value.
    """
    trial = file.copy()
    found: dict[Address, Value | None] = {}
    slips: list[str] = []
    for param, text in wanted:
        try:
            found_here = resolve_address(trial.evaluation, param)
            address, bit = found_here.address, found_here.bit
            if isinstance(text, Value):
                found[address] = text
                trial.set(address, text)
                continue
            if not text:
                raise ValueError(
                    f"no value is given ({param}={NOT_SET} clears it)" if bit is None else "no value is given"
                )
            if bit is not None:
                value: Value | None = _with_bit(trial, address, bit, text)
            else:
                value = None if _clears(text) else _entered(trial, address, text)
                if address in found and found[address] != value:
                    raise ValueError("it is given two values")
            found[address] = value
        except UnknownParameterError as error:
            slips.append(str(error))
            continue
        except ValueError as error:
            slips.append(f"{param}: {error}")
            continue
        if message := found_here.remark(trial.schema):
            notify(message)
        trial.set(address, found[address])
    if slips:
        faults = ((a, fault(trial.evaluation, a, v)) for a, v in found.items() if v is not None)
        slips += [f"{trial.machine_schema.short(a)}: {bad}" for a, bad in faults if bad]
        raise AssignmentError("; ".join(slips))
    return found


def _entered(file: ParameterFile, address: Address, text: str) -> Value | None:
    """Read a value, or an expression behind ``=``; raises InvalidValueError.

    Nobody sees the result before it is set, so that what only looks like one (``10-5``) is none.
    """
    if not text.lstrip().startswith("="):
        return file.read(address, text)
    return enter(file, address, text, lambda a: file.evaluation.unit(a, file.header.units)).value


def _clears(text: str) -> bool:
    """Return whether a text is ``NOT_SET``, also as ``get`` prints it: not set."""
    return "-".join(text.casefold().split()) == NOT_SET


def _with_bit(file: ParameterFile, address: Address, bit: int, text: str) -> Value:
    """Return the value of a word of bits with one field changed;
    a word that is not set counts as its default, or 0.
    """
    field = field_at(file.schema.parameters[address[0]], bit)
    word = file.get(address) or file.default(address) or Value(0)
    return Value(with_field(field, int(word.value), text), word.unit)


def bit_row(file: ParameterFile, address: Address, bit: int) -> dict[str, Any]:
    """Return one field of a word of bits as ``get`` shows it."""
    field = field_at(file.schema.parameters[address[0]], bit)
    words = (file.get(address), file.default(address))
    word, default = (None if v is None else field_value(field, int(v.value)) for v in words)
    labels = {c.raw: c.label for c in field.choices or ()}
    return {
        "param": f"{file.machine_schema.short(address)}.{bit}",
        "id": address[0],
        "instance": address[1],
        "bit": bit,
        "label": field.label,
        "value": labels.get(word, word),
        "unit": "",
        "raw": word,
        "default": word == default,
        "state": file.evaluation.state(address).state,
        "forced": address in file.forced,
    }


def value_row(file: ParameterFile, address: Address, secrets: bool) -> dict[str, Any]:
    """Return a value as ``get --json`` gives it;
    a secret that is set has neither value nor raw unless asked for.
    """
    parameter, value = file.schema.parameters[address[0]], file.get(address)
    masked = parameter.secret and not secrets
    plain = None if value is None or masked else value.value
    if isinstance(plain, (str, bool)):
        plain = write_value(parameter, value)
    raw = None
    if value is not None and not masked:
        raw = stored_number(parameter, value, turns=file.evaluation.turns(address))
    return (
        {
            "param": file.machine_schema.short(address),
            "id": address[0],
            "instance": address[1],
            "value": plain,
            "unit": value.unit if value else file.evaluation.unit(address, file.header.units),
            "raw": raw,
            "default": file.is_default(address),
            "state": file.evaluation.state(address).state,
            "forced": address in file.forced,
        }
        | _labels(parameter, value)
        | ({"secret": True, "set": value is not None} if parameter.secret else {})
        | _real_figure(file, address)
    )


def _labels(parameter: Parameter, value: Value | None) -> dict[str, str]:
    """Return what is set in a word of bits by its labels."""
    if not parameter.bits or value is None or not isinstance(value.value, int):
        return {}
    return {"labels": labels_of_word(parameter, value.value)}


def _real_figure(file: ParameterFile, address: Address) -> dict[str, Any]:
    """Return what a value in internal units is in mm or degrees."""
    real = real_value(file.evaluation, address, file.get(address))
    return {} if real is None else {"real": {"value": real.value, "unit": real.unit}}


def _entry(file: ParameterFile, address: Address) -> ParameterEntry:
    row = value_row(file, address, secrets=False)
    shown = show_value(file.schema.parameters[address[0]], file.get(address))
    known = {
        name: row[name]
        for name in ("param", "id", "instance", "value", "unit", "raw", "default", "state", "forced")
    }
    return ParameterEntry(**known, text=shown)
