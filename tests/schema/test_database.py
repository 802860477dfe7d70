"""The facts themselves: every family in the database is whole, and agrees with itself."""

from collections import defaultdict
from collections.abc import Iterator

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import (
    Address,
    Evaluation,
    Parameter,
    Schema,
    Value,
    canonical,
    dimension,
    family_ids,
    fault,
    load_schema,
    program,
    read_address,
)
from amp_studio.schema.model import BoundRef, Range
from amp_studio.schema.units import UNITS

SHARED_NUMBERS = {
    "57c422b": {
        frozenset(
            {"command.gear_ratio", "command.gear_numerator"}
        ): "R25 by the format of register 38, page 4-15",
        frozenset(
            {"cam.time_points", "cam.byte_points"}
        ): "the cam table by the format of register 130, page 4-57",
        frozenset({"cam.time_points", "cam.byte_points", "cam.position_points"}): "and its pairs, page 4-57",
    },
    "9pc": {
        frozenset(
            {"servo.velocity_gear_teeth", "servo.spindle_motor_teeth"}
        ): "1013 by axis type, pages 7-52 and 7-82",
        frozenset(
            {"servo.velocity_screw_teeth", "servo.spindle_shaft_teeth"}
        ): "1018 by axis type, pages 7-53 and 7-83",
        frozenset(
            {"zone.overtravel_used", "servo.velocity_port"}
        ): "1020 is misprinted on page 7-46 (erratum e-1020-number)",
        frozenset(
            {"tool.max_wear_change", "tool.max_radius_offset"}
        ): "244 on a mill is printed on 21-16 and again on 21-22 (erratum e-244-number)",
        frozenset(
            {"tool.max_geometry_change", "tool.max_radius_change"}
        ): "245 on a mill is printed on 21-17 and again on 21-21 (erratum e-244-number)",
    },
    "num": {
        frozenset(
            {"servo.acceleration_work", "servo.spindle_acceleration"}
        ): "P32N48, N50, N52 and N54 by address, axis or spindle, page 6-11"
    },
}
"""Parameters that share a number, with the reason; all other numbers are unique on a machine."""

RANGES_ARE_RARE = {"syntec": {"limit.first_positive", "limit.first_negative", "mpg.simulation_handwheel"}}
"""Family -> the parameters for which its manual prints a range;
a family that is not here prints them throughout."""

DEFAULTS_OUT_OF_RANGE: dict[str, dict[str, str]] = {}
"""Family -> parameter -> why its printed default lies outside its printed range; there is none at present."""


@pytest.fixture(params=family_ids())
def schema(request) -> Schema:
    """Return each family of the database in turn."""
    return load_schema(request.param)


def ranges_of(parameter: Parameter) -> Iterator[tuple[str, Range]]:
    """Yield every printed range of a parameter, whatever its condition."""
    yield from (parameter.ranges or {}).items()
    for variant in parameter.range_variants:
        yield from variant.ranges.items()


def machines_of(schema: Schema) -> list[str]:
    """Return the machine types of a family."""
    return [machine.key for machine in schema.family.machines]


def test_every_parameter_has_help_and_a_page(schema: Schema) -> None:
    assert [
        p.id
        for p in schema.parameters.values()
        if not p.help.what.strip() or not p.page or not p.name.strip()
    ] == []


def test_every_group_is_in_the_order_of_the_family_and_not_empty(schema: Schema) -> None:
    assert list(schema.family.groups) == [group.key for group in schema.groups]
    assert [group.key for group in schema.groups if not group.parameters] == []


def test_every_related_parameter_exists_and_is_another(schema: Schema) -> None:
    pairs = [(p.id, related) for p in schema.parameters.values() for related in p.help.related]
    assert [
        (name, related) for name, related in pairs if related not in schema.parameters or related == name
    ] == []


def test_every_table_and_every_guide_leads_to_parameters_that_exist(schema: Schema) -> None:
    named = {(table.id, p) for table in schema.tables.values() for p in table.params}
    named |= {(guide.id, p) for guide in schema.guides for step in guide.steps for p in step.params}
    assert [(where, name) for where, name in sorted(named) if name not in schema.parameters] == []


def test_every_erratum_that_is_cited_exists_and_every_erratum_is_cited(schema: Schema) -> None:
    cited = {(p.id, erratum) for p in schema.parameters.values() for erratum in p.errata}
    assert [(name, erratum) for name, erratum in sorted(cited) if erratum not in schema.errata] == []
    assert set() == set(schema.errata) - {erratum for _, erratum in cited}
    assert [
        e.id for e in schema.errata.values() if [name for name in e.params if name not in schema.parameters]
    ] == []


def test_an_erratum_gives_at_least_two_readings_and_the_choice(schema: Schema) -> None:
    assert [
        e.id for e in schema.errata.values() if not e.readings or not e.taken.strip() or not e.why.strip()
    ] == []


def test_every_condition_that_is_used_exists(schema: Schema) -> None:
    used = {(p.id, rule.when or rule.unless) for p in schema.parameters.values() for rule in p.states}
    used |= {(p.id, variant.when) for p in schema.parameters.values() for variant in p.range_variants}
    assert [
        (name, condition) for name, condition in sorted(used) if condition not in schema.family.conditions
    ] == []


def test_every_condition_reads_what_exists_and_uses_what_it_reads(schema: Schema) -> None:
    for name, condition in schema.family.conditions.items():
        assert set() == set(condition.reads) - set(program(condition.when).variables()), name
        for machine in machines_of(schema):
            evaluation = Evaluation(schema, lambda _: None, lambda machine=machine: machine)
            for text in condition.reads.values():
                parameter = schema.parameter(read_address(text)[0])
                for instance in schema.on(machine).instances(parameter):
                    assert evaluation.reference(text, instance).addresses is not None, (name, text)
        assert condition.why.strip(), name


def filled(schema: Schema) -> Iterator[ParameterFile]:
    """Yield a file for each machine type, its axes of every type there is."""
    for machine in machines_of(schema):
        file = new_file(schema.family.family, machine)
        if profile := schema.family.axes:
            types = [c.key for c in schema.parameter(profile.type).choices or ()]
            for n, axis in enumerate(schema.on(machine).instances(schema.parameter(profile.type))):
                file.set((profile.type, axis), Value(types[n % len(types)]))
        yield file


def test_every_state_can_be_reported_on_every_machine_with_every_axis_type(schema: Schema) -> None:
    for file in filled(schema):
        for address in file.addresses():
            found = file.evaluation.state(address)
            assert (found.state == "in-force") == (found.why == ""), address
            assert file.evaluation.unit(address, "metric") in UNITS


def test_every_range_runs_from_low_to_high_in_a_unit_of_its_quantity(schema: Schema) -> None:
    for parameter in schema.parameters.values():
        units = {dimension(unit) for unit in schema.units_of(parameter)}
        for unit, (low, high) in ranges_of(parameter):
            assert unit in UNITS, parameter.id
            assert dimension(unit) in units, (
                f"{parameter.id}: {unit} does not measure what {schema.units_of(parameter)} does"
            )
            if isinstance(low, float) and isinstance(high, float):
                assert low <= high, parameter.id


def test_inch_and_metric_ranges_say_the_same_to_the_last_printed_digit(schema: Schema) -> None:
    for parameter in schema.parameters.values():
        for unit, pair in (parameter.ranges or {}).items():
            metric = unit.replace("in", "mm", 1)
            if not unit.startswith("in") or metric not in (parameter.ranges or {}):
                continue
            for inch, other in zip(pair, (parameter.ranges or {})[metric], strict=True):
                assert isinstance(inch, BoundRef) == isinstance(other, BoundRef), parameter.id
                if isinstance(inch, float) and isinstance(other, float):
                    digit = canonical(10.0 ** -(parameter.decimals or 4), unit) + 1e-7 * abs(
                        canonical(inch, unit)
                    )
                    assert abs(canonical(inch, unit) - canonical(other, metric)) <= digit, parameter.id


def test_every_bound_by_another_parameter_exists_for_the_same_axis(schema: Schema) -> None:
    for machine in machines_of(schema):
        for parameter in schema.parameters.values():
            for _, pair in ranges_of(parameter):
                for bound in pair:
                    if isinstance(bound, BoundRef):
                        source = schema.parameter(bound.param)
                        assert schema.on(machine).instances(parameter) == schema.on(machine).instances(
                            source
                        ), parameter.id


def test_every_number_parameter_has_a_printed_range(schema: Schema) -> None:
    numbers = [p for p in schema.parameters.values() if p.type in ("real", "integer")]
    printed = RANGES_ARE_RARE.get(schema.family.family, {p.id for p in numbers})
    assert {p.id for p in numbers if p.ranges} == printed


def test_every_printed_default_is_in_its_printed_range(schema: Schema) -> None:
    known = DEFAULTS_OUT_OF_RANGE.get(schema.family.family, {})
    for file in filled(schema):
        faults = {
            a[0]: message
            for a in file.addresses()
            if (d := file.default(a)) and (message := fault(file.evaluation, a, d))
        }
        assert set(known) == set(faults), faults


def test_every_default_is_in_a_unit_of_its_quantity(schema: Schema) -> None:
    for parameter in schema.parameters.values():
        if parameter.default and not parameter.choices and parameter.type in ("real", "integer"):
            assert dimension(parameter.default.unit) in {dimension(u) for u in schema.units_of(parameter)}, (
                parameter.id
            )


def test_no_two_choices_of_a_parameter_are_stored_as_the_same_code(schema: Schema) -> None:
    for parameter in schema.parameters.values():
        codes = [choice.raw for choice in parameter.choices or () if choice.raw is not None]
        assert sorted(set(codes)) == sorted(codes), parameter.id


def test_what_is_patched_by_number_shows_how_it_is_stored(schema: Schema) -> None:
    for parameter in schema.parameters.values():
        if parameter.patchable:
            stored = [c.raw for c in parameter.choices or () if c.raw is not None] or parameter.storage
            assert stored, f"{parameter.id} can be keyed in at the control, but in what form?"


def test_fields_of_a_word_do_not_overlap_and_fit_it(schema: Schema) -> None:
    for parameter in schema.parameters.values():
        taken = [n for field in parameter.bits or () for n in range(field.bit, field.bit + field.width)]
        assert sorted(set(taken)) == sorted(taken), parameter.id
        if parameter.word_width and taken:
            assert max(taken) < parameter.word_width, parameter.id


def test_every_number_is_unique_on_its_machine_except_the_known_ones(schema: Schema) -> None:
    shared = set()
    for machine in machines_of(schema):
        claims: dict[str, list[Address]] = defaultdict(list)
        for address in schema.on(machine).addresses:
            if number := schema.on(machine).number(address):
                claims[number.casefold()].append(address)
        shared |= {frozenset(a[0] for a in found) for found in claims.values() if len(found) > 1}
    assert set(SHARED_NUMBERS.get(schema.family.family, {})) == shared


def test_every_rule_reads_what_exists_and_mends_what_it_reads(schema: Schema) -> None:
    for rule in schema.rules:
        assert [
            text for text in rule.reads.values() if read_address(text)[0] not in schema.parameters
        ] == [], rule.id
        assert set() == {fix.set for fix in rule.fix} - set(rule.reads), rule.id
        assert set() == {*rule.optional, *rule.any_state} - set(rule.reads), rule.id
        program(rule.when), program(rule.check)
    assert len({rule.id for rule in schema.rules}) == len(schema.rules)


def test_the_axis_operations_act_on_parameters_that_exist(schema: Schema) -> None:
    profile = schema.family.axes
    if profile is not None:
        names = [
            profile.name,
            profile.type,
            *filter(None, [profile.hardware, profile.loop, profile.fitted_by]),
        ]
        assert [name for name in names if name not in schema.parameters] == []
        types = {choice.key for choice in schema.parameter(profile.type).choices or ()}
        used = {profile.unfitted, profile.usual_type, *profile.types.values()}
        assert used - {None} <= types
