"""Whatever is in a file of any family: nothing raises, and edit by edit the findings are those of a full
run.
"""

import contextlib
import math
import struct
from collections.abc import Callable
from functools import cache
from pathlib import Path
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from amp_studio.files import Change, ParameterFile, axis_instances, open_file, retype_axis
from amp_studio.report import finding_json, finding_text, why_text
from amp_studio.schema import (
    Address,
    InvalidValueError,
    Limits,
    Parameter,
    Schema,
    Value,
    load_schema,
    read_address,
    same_value,
)
from amp_studio.schema.units import UNITS
from amp_studio.validate import Validator, apply_all_safe, explain, ranges
from tests.campaigns import CAMPAIGN, examples, some

EXAMPLES = {
    "57c422b": "57c422b-label-press/LABEL_PRESS.amp",
    "acromill": "acromill-router/ROUTER.amp",
    "num": "num-1060-mill/MILL_1060.amp",
    "syntec": "syntec-mill/SYNTEC_MILL.amp",
}
MACHINES = ["mill", "lathe", "router", *EXAMPLES]
"""Three sound 9/PC machines, and the example of each other family."""

NUMBERS = [0, -1, 1, 8, 0.5, 1e-300, 5e-324, 1e300, -1e300, 2.0**53, 2**70, math.inf, -math.inf]
TEXTS = [
    "",
    "raw:999",
    "raw:",
    "raw:x",
    "yes",
    "none",
    "s",
    "spindle",
    "unfitted",
    "digital",
    "3.4",
    "3.4.5",
    "∞",
    "{x}",
]


@pytest.fixture(scope="session")
def a_machine(machine: Callable[[str], ParameterFile], checkout: Path) -> Callable[[str], ParameterFile]:
    """Return what gives a separate machine, by name."""

    @cache
    def found(name: str) -> ParameterFile:
        return open_file(checkout / "examples" / EXAMPLES[name]).file if name in EXAMPLES else machine(name)

    return lambda name: found(name).copy()


@cache
def often(schema: Schema, machine: str) -> list[Address]:
    """Return what much else depends on: whatever a condition reads."""
    read = {read_address(text)[0] for c in schema.family.conditions.values() for text in c.reads.values()}
    return [a for a in schema.on(machine).addresses if a[0] in read]


def anything(random: Random) -> Value:
    """Return a value of any kind, in any unit."""
    kind = random.randrange(4)
    if kind == 0:
        return Value(random.choice(TEXTS))
    if kind == 1:
        return Value(random.random() < 0.5)
    (double,) = struct.unpack("d", random.getrandbits(64).to_bytes(8, "little"))
    number = random.choice(
        [*NUMBERS, double if math.isfinite(double) else 0.0, random.randrange(-(10**7), 10**7)]
    )
    return Value(number, random.choice(list(UNITS)))


def fitting(schema: Schema, parameter: Parameter, random: Random) -> Value:
    """Return a value that the parameter takes, or that is at least near to it."""
    if parameter.type == "boolean":
        return Value(random.random() < 0.5)
    if parameter.choices:
        return Value(random.choice([choice.key for choice in parameter.choices]))
    if parameter.type == "bits":
        return Value(random.choice([0, 1 << random.randrange(32), random.getrandbits(8)]))
    bounds = [
        bound for pair in (parameter.ranges or {}).values() for bound in pair if isinstance(bound, float)
    ]
    number = random.choice([*bounds, round(random.uniform(0, 20), 3), round(random.uniform(0, 10000), 1)])
    unit = random.choice(schema.units_of(parameter))
    return Value(int(number) if parameter.type == "integer" else number, unit)


def set_if_possible(file: ParameterFile, address: Address, value: Value | None) -> None:
    """Set a value; one that no file can contain is refused, and nothing has changed."""
    old, revision = file.get(address), file.revision
    try:
        file.set(address, value)
    except InvalidValueError:
        assert (file.get(address), file.revision) == (old, revision)


def edit(file: ParameterFile, history: list[Change], random: Random) -> None:
    """Make one edit of any kind."""
    schema = file.schema
    addresses, much = schema.on(file.machine).addresses, often(schema, file.machine)
    address = random.choice([random.choice(addresses), random.choice(much), random.choice(list(file.values))])
    parameter = schema.parameters[address[0]]
    match random.choice(
        ["any", "any", "fit", "fit", "fit", "fit", "unset", "undo", "retype", "force", "units", "machine"]
    ):
        case "any":
            set_if_possible(file, address, anything(random))
        case "fit":
            set_if_possible(file, address, fitting(schema, parameter, random))
        case "unset":
            file.set(address, None)
        case "undo" if history:
            file.apply(history.pop().reversed())
        case "retype" if schema.family.axes is not None and axis_instances(file):
            axis = random.choice(axis_instances(file))
            types = schema.parameters[schema.family.axes.type].choices or ()
            retype_axis(file, axis, random.choice([choice.key for choice in types]))
        case "force":
            with contextlib.suppress(InvalidValueError):
                file.set_checked({address: fitting(schema, parameter, random)}, force="by a test")
        case "units":
            file.header.units = random.choice(list(schema.family.units))
        case "machine" if schema.family.machine_parameter:
            file.set((schema.family.machine_parameter, ""), Value(random.choice(schema.family.machines).key))


class Edited:
    """A machine that is edited at random, with its findings kept up to date."""

    def __init__(self, file: ParameterFile) -> None:
        self.file = file
        self.validator = Validator(file)
        self.findings = self.validator.run()
        self._history: list[Change] = []
        self._changed: list[Address] = []
        file.listen(lambda change: self._changed.append(change.address))
        file.listen(self._history.append)

    def edit(self, random: Random, times: int) -> None:
        """Make edits, and then check again what they touched."""
        for _ in range(times):
            edit(self.file, self._history, random)
        self.findings = self.validator.update(self._changed)
        self._changed.clear()

    def agree(self) -> bool:
        """Return whether the findings are those of a full run, here and in a copy that remembers nothing."""
        assert self.findings == self.validator.findings()
        full = [Validator(self.file).run(), Validator(self.file.copy()).run()]
        # Compared as texts, for True is equal to 1.
        return all(list(map(repr, self.findings)) == list(map(repr, findings)) for findings in full)


@given(random=st.randoms(use_true_random=False), name=st.sampled_from(MACHINES))
@settings(max_examples=examples(15), suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
def test_edit_by_edit_or_all_at_once_the_findings_are_the_same(random: Random, name: str, a_machine) -> None:
    edited = Edited(a_machine(name))
    for _ in range(random.randint(1, 4)):
        edited.edit(random, random.randint(1, 4))
    assert edited.agree()


@pytest.mark.parametrize("name", some(MACHINES, 2))
def test_after_many_edits_too(name: str, a_machine) -> None:
    edited, random = Edited(a_machine(name)), Random(name)
    for _ in range(500 if CAMPAIGN else 1):
        for _ in range(25):
            edited.edit(random, random.choice([1, 1, 1, 5]))
        assert edited.agree()


def nasty(parameter: Parameter, schema: Schema) -> list[Value]:
    """Return values that nobody should write into a parameter: any number in its units,
    some in those of others.
    """
    numbers = [0, -1, 2**70, 1e300, -1e300, 5e-324, 0.1, math.inf, -math.inf]
    own = schema.units_of(parameter)
    others = {"", "mm", "in/min", "deg", "%"}.difference(own)
    return [
        *(Value(number, unit) for number in numbers for unit in (own if CAMPAIGN else own[:1])),
        *(
            Value(number, unit)
            for number in (numbers if CAMPAIGN else (1e300, 0.1))
            for unit in sorted(others)
        ),
        *(Value(text) for text in TEXTS),
        Value(True),
        Value(False),
    ]


@pytest.mark.parametrize("name", some(name for name in MACHINES if name != "router"))
def test_no_value_whatever_makes_it_raise(name: str, a_machine) -> None:
    file = a_machine(name)
    validator = Validator(file)
    validator.run()
    on_the_mill = {parameter_id for parameter_id, _ in load_schema("9pc").on("mill").addresses}
    one_of_each: dict[str, list[Address]] = {}
    for address in file.addresses():
        if CAMPAIGN or name != "lathe" or address[0] not in on_the_mill:
            one_of_each.setdefault(address[0], []).append(address)
    for n, addresses in enumerate(one_of_each.values()):
        address = addresses[min(3, len(addresses) - 1)]
        before = file.get(address)
        values = nasty(file.schema.parameters[address[0]], file.schema)
        for value in values if CAMPAIGN else values[n % 20 :: 20]:  # each in its turn
            set_if_possible(file, address, value)
            assert all(finding.message for finding in validator.update([address]))
        file.set(address, before)
        validator.update([address])


@given(seed=st.integers(0, 2**32), name=st.sampled_from(MACHINES))
@settings(max_examples=examples(6), suppress_health_check=[HealthCheck.too_slow])
def test_a_file_of_chance_is_told_explained_and_fixed(seed: int, name: str, a_machine) -> None:
    """As after an upload from a control in which anything was keyed: nearly every value at once."""
    file, random = a_machine(name), Random(seed)
    for address in list(file.values):
        if random.random() < 0.7:
            parameter = file.schema.parameters[address[0]]
            set_if_possible(
                file, address, random.choice([anything(random), fitting(file.schema, parameter, random)])
            )
    validator = Validator(file)
    findings = validator.run()
    for finding in random.sample(findings, min(30, len(findings))):
        assert finding.message in finding_text(file, finding)
        assert finding_json(file, finding)["message"] == finding.message
        assert why_text(file, finding, explain(validator, finding))
    apply_all_safe(validator)
    assert list(map(repr, validator.findings())) == list(map(repr, Validator(file).run()))


def test_a_speed_that_is_zero_in_its_canonical_unit_has_fixes(a_machine) -> None:
    """The least number of all in deg/min/s is no deg/s2: the part of it that a fix leaves was divided by
    0.
    """
    file = a_machine("mill")
    file.values["jog.speed_third", "3"] = Value(5e-324, "deg/min/s")
    assert any(("jog.speed_third", "3") in finding.addresses for finding in Validator(file).run())


@pytest.mark.parametrize("name", some(MACHINES, 2))
def test_a_fix_of_a_range_is_allowed_itself(name: str, a_machine) -> None:
    file = a_machine(name)
    validator = Validator(file)
    validator.run()
    random = Random(name)
    addresses = list(file.values) if CAMPAIGN else random.sample(list(file.values), min(25, len(file.values)))
    for address in addresses:
        before = file.get(address)
        if file.schema.parameters[address[0]].type not in ("integer", "real", "bits"):
            continue
        for value in (Value(1e9, unit) for unit in file.schema.units_of(file.schema.parameters[address[0]])):
            file.set(address, value)
            said = [
                f
                for f in validator.update([address])
                if f.rule.startswith("schema.") and f.causes == (address,)
            ]
            for setting in (setting for finding in said for setting in finding.fix):
                assert not same_value(setting.value, value)
                file.set(setting.address, setting.value)
                left = validator.update([address])
                assert not [
                    f for f in left if f.rule in ("schema.range", "schema.choice") and f.causes == (address,)
                ]
        file.set(address, before)
        validator.update([address])


def test_a_bound_of_three_hundred_digits_is_no_reason_to_stop() -> None:
    """One parameter sets the bound of the other; a file may contain any figure for it."""
    parameter = load_schema("9pc").parameters["zone.limit2_min"]
    bound = Value(-3.9e298, "in")
    allowed = Limits(low=-39370.07835, high=-3.9e298, unit="in")
    assert ranges._rounded_inwards(parameter, bound, allowed) == bound
    allowed = Limits(low=None, high=1.23456789, unit="in")
    assert ranges._rounded_inwards(parameter, Value(1.23456789, "in"), allowed).value < 1.23456789
