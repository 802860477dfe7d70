"""A family's parameters, ready to be asked: instances, numbers, groups, signature."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from functools import cache, cached_property
from operator import attrgetter
from typing import Any

from .address import Address, UnknownParameterError, read_address, whole_of
from .load import Compiled, FurtherFacts, load_compiled
from .machine_schema import MachineSchema
from .model import (
    Choice,
    Commissioning,
    ControlMessage,
    Erratum,
    Family,
    Group,
    Guide,
    Messages,
    MotionFacts,
    Parameter,
    PictureRoles,
    Plausible,
    ProgramWords,
    Rule,
    Storage,
    Table,
)
from .model.compiled_json import text_record
from .units import angular


# Equal by identity: schemas are keys of caches everywhere, and one loaded family is one object
# (load_schema).
@dataclass(frozen=True, eq=False, repr=False)
class Schema:
    """One family. Built by ``load_schema``, once; never changed."""

    family: Family
    groups: tuple[Group, ...]
    rules: tuple[Rule, ...]
    parameters: dict[str, Parameter]
    group_of: dict[str, Group]
    plausible: Plausible
    further_text: str = ""
    """``FurtherFacts`` as they were compiled, until one of them is asked for."""
    description: bytes = b""
    """The description that a control gave of itself, from which this schema was made;
    empty for the facts of the database."""

    def __repr__(self) -> str:
        return f"Schema({self.family.family!r})"

    def on(self, machine: str) -> MachineSchema:
        """Return the schema on one machine type: its instances, numbers and scopes are worked out once."""
        found = self._on.get(machine)
        if found is None:
            found = self._on[machine] = MachineSchema(self.family, self.parameters, machine)
        return found

    @cached_property
    def _further(self) -> FurtherFacts:
        # Facts of a control that describes itself, or of a test, may have none.
        if not self.further_text:
            return FurtherFacts.model_construct()
        facts: FurtherFacts = text_record(self.further_text)
        return facts

    @cached_property
    def errata(self) -> dict[str, Erratum]:
        """The errors of the manuals, by id."""
        return {erratum.id: erratum for erratum in self._further.errata}

    @cached_property
    def tables(self) -> dict[str, Table]:
        """The printed tables, by id."""
        further = self._further
        # A message is looked up as a printed table is, by its id.
        listed = (*further.tables, *(table for m in further.messages for table in m.tables()))
        return {table.id: table for table in listed}

    @property
    def guides(self) -> tuple[Guide, ...]:
        """Procedures of the manuals."""
        return self._further.guides

    @property
    def message_lists(self) -> tuple[Messages, ...]:
        """What the controls show, as the manuals list it."""
        return self._further.messages

    @property
    def commissioning(self) -> Commissioning | None:
        """The order in which its machines are commissioned, where there is one."""
        return self._further.commissioning

    @property
    def pictures(self) -> PictureRoles:
        """What each picture is drawn from."""
        return self._further.pictures

    @property
    def program(self) -> ProgramWords:
        """How the words of its part programs are read."""
        return self._further.program

    @property
    def motion(self) -> MotionFacts:
        """What the law of its axes takes from facts."""
        return self._further.motion

    @cached_property
    def _on(self) -> dict[str, MachineSchema]:
        return {}

    @cached_property
    def machines(self) -> frozenset[str]:
        """The keys of the machine types."""
        return frozenset(m.key for m in self.family.machines)

    @cached_property
    def messages(self) -> dict[str, ControlMessage]:
        """What the controls of the family show, by id."""
        return {message.id: message for listed in self.message_lists for message in listed.messages}

    def messages_of(self, parameter_id: str) -> tuple[ControlMessage, ...]:
        """Return the messages that point to a parameter, in the manual's order."""
        return tuple(message for message in self.messages.values() if parameter_id in message.params)

    # -- words -----------------------------------------------------------------

    def parameter(self, parameter_id: str) -> Parameter:
        """Return a parameter by id; raises UnknownParameterError."""
        try:
            return self.parameters[parameter_id]
        except (KeyError, TypeError):  # no text at all
            raise UnknownParameterError(f"Unknown parameter '{parameter_id}' of {self.family.name}") from None

    def page(self, address: Address) -> str:
        """Return the page on which the manual describes an instance."""
        parameter = self.parameters[address[0]]
        # The instance, then the whole that it is a part of, then the parameter.
        return parameter.pages.get(address[1]) or parameter.pages.get(whole_of(address[1])) or parameter.page

    def unit(self, parameter: Parameter, system: str, turns: bool) -> str:
        """Return the unit of entry in a unit system (``metric``, ``inch``); degrees where the axis turns."""
        if parameter.unit is not None:
            return parameter.unit
        unit = self.family.units.get(system, {}).get(parameter.quantity) or _PLAIN_UNITS.get(
            parameter.quantity, ""
        )
        return angular(unit) if turns else unit

    def angular_when(self, parameter: Parameter) -> str | None:
        """Return the condition under which the lengths of a parameter are angles."""
        return parameter.angular_when or self.family.angular_when

    @cached_property
    def turning_parameters(self) -> frozenset[str]:
        """Ids of the parameters that decide whether an axis turns."""
        conditions = {self.angular_when(parameter) for parameter in self.parameters.values()} - {None}
        return frozenset(
            read_address(text)[0]
            for name in conditions
            for text in self.family.conditions[str(name)].reads.values()
        )

    def units_of(self, parameter: Parameter) -> tuple[str, ...]:
        """Return every unit a parameter can be entered in, in any unit system, straight or turning."""
        if parameter.id not in self._unit_table:
            systems = tuple(self.family.units) or ("",)
            units = [self.unit(parameter, system, turns) for turns in (False, True) for system in systems]
            self._unit_table[parameter.id] = tuple(dict.fromkeys(units))
        return self._unit_table[parameter.id]

    @cached_property
    def _unit_table(self) -> dict[str, tuple[str, ...]]:
        return {}

    @cached_property
    def signature(self) -> str:
        """Checksum over instances, numbers, names, types, units, storage, choices and bits;
        travels with every file.
        """
        lines = []
        machines = [m.key for m in self.family.machines if m.in_signature]
        for parameter in filter(attrgetter("in_signature"), self.parameters.values()):
            instances = {m: self.on(m).instances(parameter) for m in machines}
            numbers = {m: self.on(m).numbers(parameter) for m in machines}
            choices, bits = _codes(parameter.choices), _signed_bits(parameter)
            storage = _signed_storage(parameter.storage) if parameter.storage else None
            named = [parameter.id, parameter.name, parameter.type, parameter.quantity, parameter.unit]
            lines.append([*named, instances, numbers, choices, bits, storage])
        # Keys sorted and no blanks: the text must not depend on the version of Python. Another checksum makes
        # every file and control in the field one of another schema (tests/schema/test_signatures.py).
        text = json.dumps([self.family.family, lines], sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(text.encode()).hexdigest()


def _signed_storage(storage: Storage) -> dict[str, Any]:
    """Return a storage as signatures have it: what was added later is there only where it is used,
    so that files of a family without it keep their checksum.
    """
    signed: dict[str, Any] = storage.model_dump()
    later = [word for word in ("code", "command") if signed[word] is None]
    for word in (*later, *([] if signed["single"] else ["single"])):
        del signed[word]
    if "command" in signed:
        signed["command"] = signed["command"].replace("{k}", "{n}")  # as the place was written once
    return signed


def _signed_bits(parameter: Parameter) -> list[tuple[int, int, str, list[tuple[str, str, int | None]]]]:
    """Return the bits that every control of the family has."""
    bits = (b for b in parameter.bits or () if not b.needs)
    return [(b.bit, b.width, b.was or b.label, _codes(b.choices)) for b in bits]


def _codes(choices: tuple[Choice, ...] | None) -> list[tuple[str, str, int | None]]:
    return [(c.key, c.label, c.raw) for c in choices or ()]


_PLAIN_UNITS = {
    "angle": "deg",
    "time": "ms",
    "percent": "%",
    "voltage": "V",
    "current": "A",
    "frequency": "Hz",
    "rotation": "rpm",
    "counts": "counts",
    "power": "W",
}


@cache
def load_schema(family_id: str) -> Schema:
    """Return a family's schema; raises UnknownFamilyError, and DatabaseError for a bad fact."""
    return schema_of(load_compiled(family_id))


def schema_of(compiled: Compiled, description: bytes = b"") -> Schema:
    """Return the schema of compiled facts, which were made from the ``description``
    of a control where there is one.
    """
    return Schema(
        family=compiled.family,
        groups=compiled.groups,
        rules=compiled.rules,
        parameters={p.id: p for group in compiled.groups for p in group.parameters},
        group_of={p.id: group for group in compiled.groups for p in group.parameters},
        plausible=compiled.plausible,
        further_text=compiled.further,
        description=description,
    )
