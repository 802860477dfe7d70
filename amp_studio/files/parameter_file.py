"""A parameter file in memory: values, changes, and what follows from them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import NamedTuple

from amp_studio.errors import AmpStudioError
from amp_studio.schema import (
    UNITS,
    Address,
    Evaluation,
    InvalidValueError,
    MachineSchema,
    Parameter,
    Schema,
    Scope,
    UnitError,
    UnknownParameterError,
    Value,
    angular,
    checked,
    dimension,
    fault,
    read_real,
    read_value,
    same_value,
    unit_named,
    unit_text,
    unknown,
)

from .printed_defaults import default_value, is_printed

_SHOWN = 40
"""Instances that a message about an unknown one lists."""


class Change(NamedTuple):
    """One value replaced by another; None means not set."""

    address: Address
    old: Value | None
    new: Value | None

    def reversed(self) -> Change:
        """Return the change that takes this one back."""
        return Change(self.address, self.new, self.old)


class RangeError(AmpStudioError, ValueError):
    """A value that its parameter does not allow; ``faults`` contains one message for each address."""

    def __init__(self, faults: dict[Address, str]) -> None:
        self.faults = faults
        super().__init__("; ".join(faults.values()))


@dataclass
class Header:
    """The header of a parameter file."""

    name: str = ""
    application: str = ""
    revision: str = ""
    """Control software revision."""
    machine: str = ""
    """Machine type, for a family that has no parameter for it."""
    units: str = "metric"
    """Unit system of display and entry; values keep the unit they were entered in."""
    notes: str = ""
    signature: str = ""
    value_notes: Mapping[str, str] = field(default_factory=dict)
    """Address as files write it -> what a person noted about the value."""
    group_notes: Mapping[str, str] = field(default_factory=dict)
    """Key of a group of parameters -> what a person noted about it."""
    done: Mapping[str, str] = field(default_factory=dict)
    """Steps of commissioning that a person has ticked, and when; replaced and never changed in place."""
    extra: dict[str, object] = field(default_factory=dict)
    """Keys this program does not know, kept as they are."""


_KEPT_APART = ("units", "signature")
"""Header entries that no step changes: display settings, and what the program writes itself."""


@dataclass(frozen=True)
class HeaderSnapshot:
    """The forced marks, the header and the entries that the schema does not know, of a file at one moment."""

    forced: dict[Address, str]
    header: dict[str, object]
    unknown: dict[str, str]

    @classmethod
    def of(cls, file: ParameterFile) -> HeaderSnapshot:
        header = {k: v for k, v in vars(file.header).items() if k not in _KEPT_APART}
        return cls(dict(file.forced), header, dict(file.unknown))

    def put_back(self, file: ParameterFile) -> None:
        """Give a file these marks and this header."""
        decided_by = file.machine, file.header.application
        file.forced.clear()
        file.forced.update(self.forced)
        file.unknown.clear()
        file.unknown.update(self.unknown)
        for key, value in self.header.items():
            setattr(file.header, key, value)
        # Conditions depend on both; only then is all forgotten, which is slow.
        if (file.machine, file.header.application) != decided_by:
            file.evaluation.forget()


class ParameterFile:
    """The values of one machine, in the light of its family's schema."""

    def __init__(self, schema: Schema, header: Header | None = None) -> None:
        self.schema = schema
        self.header = header or Header()
        self.values: dict[Address, Value] = {}
        self.forced: dict[Address, str] = {}
        """Addresses set out of range on purpose, and when."""
        self.unknown: dict[str, str] = {}
        """Entries of the file that name no parameter of this schema, kept as they are."""
        self.evaluation = Evaluation(
            schema, self.values.get, lambda: self.machine, lambda: self.header.application
        )
        self._listeners: list[Callable[[Change], None]] = []
        self.revision = 0
        """Counts the changes of values: what was worked out at another revision is no longer true."""

    @property
    def machine(self) -> str:
        """The machine type: the value of the family's machine parameter, or the header's entry."""
        family = self.schema.family
        if family.machine_parameter:
            value = self.values.get((family.machine_parameter, ""))
            if value is not None and value.value in self.schema.machines:
                return str(value.value)
            return family.default_machine
        return self.header.machine or family.default_machine

    @property
    def machine_schema(self) -> MachineSchema:
        """The schema on the file's machine type: instances, numbers and labels."""
        return self.schema.on(self.machine)

    # -- reading ---------------------------------------------------------------

    def get(self, address: Address) -> Value | None:
        """Return a value, or None when it is not set.

        Raises TypeError for what is no address, UnknownParameterError for an address
        that the family does not have.
        """
        value = self.values.get(address)
        # A value that is there needs no check of its address: most calls end here.
        if value is None and address not in self.machine_schema.places:
            self._check_address(address)
        return value

    def addresses(self) -> tuple[Address, ...]:
        """Return every addressable value of this machine type, in the manual's order."""
        return self.machine_schema.addresses

    def find(self, text: str) -> Address:
        """Return the instance a person means; raises UnknownParameterError."""
        return self.evaluation.find(text)

    def default(self, address: Address) -> Value | None:
        """Return the printed default of an instance, in the unit system of the file where it is metric."""
        return default_value(self.schema, self.evaluation, address)

    def is_default(self, address: Address) -> bool:
        """Return whether a value equals the printed default, whatever the unit.

        A secret of several instances does as a whole or not at all: which character of a password is the
        printed one would give the rest of it away.
        """
        parameter = self.schema.parameters[address[0]]
        if not parameter.secret:
            turns = self.evaluation.turns(address)
            return is_printed(self.schema, address[0], address[1], turns, self.values.get(address))
        every = ((address[0], instance) for instance in self.machine_schema.instances(parameter))
        own = [address, *(a for a in every if a in self.values)]
        return all(same_value(self.get(a), self.default(a)) for a in own)

    def read(self, address: Address, text: str) -> Value:
        """Read a value a person wrote for an instance; raises InvalidValueError.

        A length for a parameter in internal units is counted in them.
        """
        unit = self.evaluation.unit(address, self.header.units)
        counted = read_real(self.evaluation, address, text, unit)
        if counted is not None:
            return counted
        return read_value(self.schema.parameters[address[0]], text, unit)

    # -- changing --------------------------------------------------------------

    def set(self, address: Address, value: Value | None) -> Change | None:
        """Set one value without asking whether it is in range; returns the change,
        or None if it was so already.

        Raises TypeError for what is no address or no value, UnknownParameterError for an address that the
        family does not have, UnitError for an unknown unit, InvalidValueError for a value that no file of the
        parameter can contain. A text that a user types is read by ``find`` and ``read``.
        """
        value = self._usable(address, value)
        old = self.values.get(address)
        if old == value:
            return None
        change = Change(address, old, value)
        self.apply(change)
        return change

    def _check_address(self, address: Address) -> None:
        """Raise TypeError for what is no address, UnknownParameterError for one that no machine type has."""
        if not (
            isinstance(address, tuple) and len(address) == 2 and all(isinstance(p, str) for p in address)
        ):
            raise TypeError(
                f"an address is a parameter id and an instance, as ('home.calibration', '1'), not {address!r}"
            )
        if address not in self.machine_schema.places:
            self._check_known(address)

    def _usable(self, address: Address, value: Value | None) -> Value | None:
        """Return a value as a file contains it; raises what ``set`` does."""
        self._check_address(address)
        if value is None:
            return None
        if not (
            isinstance(value, Value)
            and isinstance(value.value, (int, float, str))
            and isinstance(value.unit, str)
        ):
            raise TypeError(f"a value is a Value, as Value(5.0, 'mm'), or None, not {value!r:.80}")
        if value.unit and value.unit not in UNITS:
            unit_named(value.unit)  # raises UnitError for what is none
            raise UnitError(f"{value.unit!r} is written {unit_named(value.unit)!r} in a Value")
        parameter = self.schema.parameters[address[0]]
        if parameter.type in ("integer", "real", "bits"):
            self._check_dimension(parameter, value.unit)
        return checked(parameter, value)

    def _check_dimension(self, parameter: Parameter, unit: str) -> None:
        """Refuse a unit that measures something else than the parameter, on a straight axis or a turning
        one: no file could contain it.
        """
        units = self.schema.units_of(parameter)
        if unit not in units and dimension(unit) not in map(dimension, units):
            usual = unit_text(units[0]) or "a bare number"
            raise InvalidValueError(
                f"{parameter.name} is given in {usual}, not in {unit_text(unit) or 'a bare number'}"
            )

    def _check_known(self, address: Address) -> None:
        """Refuse an address that no machine type of the family has; raises UnknownParameterError."""
        parameter = self.schema.parameters.get(address[0])
        if parameter is None:
            raise UnknownParameterError(*unknown(self.schema, address[0]))
        machines = [self.schema.on(m.key) for m in self.schema.family.machines]
        if not any(address in each.places for each in machines):
            every = [repr(i) for i in self.machine_schema.instances(parameter)]
            if len(every) > _SHOWN:  # the points of a table
                every[_SHOWN - 1 : -1] = ["…"]
            there = ", ".join(every) or "no instance here"
            raise UnknownParameterError(f"{parameter.name} has no instance {address[1]!r}; it has {there}")

    def apply(self, change: Change) -> None:
        """Make a change and notify all listeners."""
        if change.new is None:
            self.values.pop(change.address, None)
        else:
            self.values[change.address] = change.new
        # The mark was of one value: another one out of range has to be forced again.
        self.forced.pop(change.address, None)
        self.revision += 1
        # Before the listeners, which ask for states and units.
        self.evaluation.forget_dependents(change.address)
        self._notify(change)

    def _notify(self, change: Change) -> None:
        # A copy, as a listener may end itself.
        for listener in list(self._listeners):
            listener(change)

    def set_checked(self, wanted: Mapping[Address, Value | None], force: str = "") -> list[Change]:
        """Set several values, all or none.

        Ranges are checked after all of them are in, so that a pair that bounds each other can move together;
        an axis that changes its type takes its values along as angles or lengths. With ``force`` (a text that
        names by whom and when) values out of range are taken and marked; without it they raise RangeError and
        nothing is changed.
        """
        marks = dict(self.forced)
        with self.step() as changes:
            for address, value in wanted.items():
                self.set(address, value)
            self.refit_turned(changes)
            faults = self._out_of_range(wanted)
            if faults and not force:
                raise RangeError(faults)
        changed = {change.address for change in changes}
        for address, value in wanted.items():
            self.forced.pop(address, None)
            if address in faults:
                self.forced[address] = force
            if address not in changed and self.forced.get(address) != marks.get(address):
                self._notify(Change(address, value, value))  # the value is unchanged, its mark is not
        return changes

    def _out_of_range(self, values: Mapping[Address, Value | None]) -> dict[Address, str]:
        """Return why each of these values is not allowed, of those that are not."""
        faults = {a: fault(self.evaluation, a, v) for a, v in values.items() if v is not None}
        return {a: message for a, message in faults.items() if message}

    def refit_turned(self, changes: Iterable[Change]) -> list[Change]:
        """Refit the units of each axis that these changes made turn, or move straight; returns the
        changes.
        """
        return [change for place in self._turned(changes) for change in self.refit_units(*place)]

    def _turned(self, changes: Iterable[Change]) -> Iterable[tuple[str, Scope | None]]:
        """Return the axes, or motors, that changes may have made turn, or move straight, with their scope."""
        turning, scopes = self.schema.turning_parameters, self.machine_schema.scopes
        changed = [(c.address[1], scopes[c.address[0]]) for c in changes if c.address[0] in turning]
        own: dict[tuple[str, Scope | None], None] = dict.fromkeys(place for place in changed if place[0])
        family = self.schema.family
        axes = family.scopes["axis"].instances if "axis" in family.scopes else ()
        whole = axes if any(scope != "axis" for _, scope in changed) else ()
        return own | dict.fromkeys((axis, "axis") for axis in whole)

    @contextmanager
    def step(self) -> Iterator[list[Change]]:
        """Make changes as one step and collect them; an error takes all of them back, with marks and header.

        This is the only place that takes an edit back: ``set_checked``, the desktop's steps
        and the trial of a fix are made of it.
        """
        before, changes = HeaderSnapshot.of(self), list[Change]()
        stop = self.listen(changes.append)
        try:
            yield changes
        except BaseException:
            stop()
            self.take_back(changes, before)
            raise
        stop()

    def take_back(self, changes: Iterable[Change], before: HeaderSnapshot) -> None:
        """Undo changes, the last one first, and put marks and header back."""
        self.replay([change.reversed() for change in reversed(list(changes))], before)

    def replay(self, changes: Iterable[Change], after: HeaderSnapshot) -> None:
        """Make changes again, with the marks and the header that were there after them."""
        for change in changes:
            self.apply(change)
        after.put_back(self)

    def take(self, values: Mapping[Address, Value]) -> None:
        """Take values as they were read, in range or not, and forget what followed from the old ones;
        raises as ``set`` does.
        """
        usable = {address: self._usable(address, value) for address, value in values.items()}
        self.take_read({address: value for address, value in usable.items() if value is not None})

    def take_read(self, values: Mapping[Address, Value]) -> None:
        """Take values that ``read_stored`` has returned for addresses of this machine type:
        they are checked already.
        """
        self.values.update(values)
        self.revision += 1
        self.evaluation.forget()

    def differing(self, other: ParameterFile) -> AbstractSet[Address]:
        """Return the addresses of which another file of the same schema and machine type has another value or
        mark.

        Values are compared by identity: equal ones that were written otherwise (1 and 1.0) count as
        different, and most values of files that were read are one object.
        """
        old, new = self.values, other.values
        found = {address for address, value in new.items() if old.get(address) is not value}
        if len(old.keys() & new.keys()) != len(old):
            found |= old.keys() - new.keys()
        if self.forced or other.forced:
            both = {*self.forced, *other.forced}
            found |= {a for a in both if self.forced.get(a) != other.forced.get(a)}
        return found

    def take_over(self, other: ParameterFile, differing: Iterable[Address]) -> None:
        """Take the content of another file of the same schema and machine type, and forget what followed from
        what is ``differing``. Listeners are not notified.
        """
        self.values.clear()
        self.values.update(other.values)
        self.forced.clear()
        self.forced.update(other.forced)
        self.unknown.clear()
        self.unknown.update(other.unknown)
        self.header = other.header
        self.revision += 1
        for address in differing:
            self.evaluation.forget_dependents(address)

    def set_machine(self, machine: str) -> None:
        """Set the machine type in the header, for a family that has no parameter for it."""
        self.header.machine = machine
        self.evaluation.forget()

    def refit_units(self, axis: str, scope: Scope | None = "axis") -> list[Change]:
        """Give each value of an axis, or of an instance of another scope, a unit that fits the way it moves;
        returns the changes.
        """
        changes = []
        scopes = self.machine_schema.scopes
        for address in self.addresses():
            if address[1] != axis or scopes[address[0]] != scope:
                continue
            value = self.get(address)
            if value is None or not value.unit:
                continue
            metric = self.evaluation.unit(address, "metric")
            unit = _refitted(value.unit, self.evaluation.turns(address), metric)
            mark = self.forced.get(address)
            if unit != value.unit and (change := self.set(address, Value(value.value, unit))):
                changes.append(change)
                if mark is not None:
                    self.forced[address] = mark
        return changes

    def listen(self, listener: Callable[[Change], None]) -> Callable[[], None]:
        """Call ``listener`` after every change; returns the function that ends it."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def copy(self) -> ParameterFile:
        """Return an independent copy."""
        twin = ParameterFile(self.schema, Header(**{**vars(self.header), "extra": dict(self.header.extra)}))
        twin.values.update(self.values)
        twin.forced.update(self.forced)
        twin.unknown.update(self.unknown)
        return twin


def _refitted(unit: str, turns: bool, metric: str) -> str:
    """Return the unit that corresponds to ``unit`` on an axis that turns, or moves straight."""
    if turns:
        return angular(unit) if "deg" in metric else unit
    if unit.endswith("/deg") and metric.endswith("/mm"):
        return unit[:-3] + "mm"
    return "mm" + unit[3:] if unit.startswith("deg") and metric.startswith("mm") else unit


def fill_defaults(
    file: ParameterFile, instances: Iterable[str] | None = None, *, existing_only: bool = False
) -> list[Change]:
    """Set every value that is not set to its printed default; returns the changes.

    With ``existing_only`` what is hidden stays out: a setting that the control does not have.
    """
    only = None if instances is None else set(instances)
    changes = []
    for address in file.addresses():
        if (only is None or address[1] in only) and address not in file.values:
            if existing_only and file.evaluation.state(address).state == "hidden":
                continue
            default = file.default(address)
            if default is not None and (change := file.set(address, default)):
                changes.append(change)
    return changes


def secret_values(file: ParameterFile) -> list[Address]:
    """Return the addresses of set secrets (passwords), which are shown on request only."""
    return [a for a in file.values if file.schema.parameters[a[0]].secret]


def without_secrets(file: ParameterFile) -> ParameterFile:
    """Return a file without its secret values, itself where it has none."""
    secret = secret_values(file)
    if not secret:
        return file
    copy = file.copy()
    for address in secret:
        copy.set(address, None)
    return copy


def describe(file: ParameterFile, address: Address) -> str:
    """Return ``1300 Home Calibration`` for messages."""
    return file.machine_schema.label(address)
