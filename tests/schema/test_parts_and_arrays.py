"""Instances that are parts of another one (gear 3 of spindle 1), arrays with names of their own,
and their pages.
"""

import pytest

from amp_studio.files import new_file
from amp_studio.schema import Rule, Schema, Value, fault, load_schema
from amp_studio.schema.address import part_of
from amp_studio.validate.plan import checks_of

SPINDLES = """
  - id: spindle.gears
    name: Number of Gears Used
    scope: spindle
    numbers: {listed: {"1": "860", "2": "866"}}
    type: integer
    ranges: {"": [1, 3]}
    help: {what: How many gears there are.}
    page: "12-7"
    pages: {"2": "13-7"}
  - id: spindle.max_speed
    name: Max. Spindle Speed
    scope: spindle
    instances: &gears ["1.1", "1.2", "1.3", "2.1", "2.2", "2.3"]
    each: "Spindle {i}, Gear {j}"
    numbers: {listed: {"1.1": "910", "1.2": "911", "1.3": "912", "2.1": "930", "2.2": "931", "2.3": "932"}}
    type: real
    quantity: rotation
    states: [{state: ignored, when: gear_unused}]
    help: {what: The most of the gear.}
    page: "12-8"
    pages: {"2": "13-8", "2.3": "13-9"}
  - id: spindle.min_speed
    name: Min. Spindle Speed
    scope: spindle
    instances: *gears
    each: "Spindle {i}, Gear {j}"
    type: real
    quantity: rotation
    ranges: {rpm: [0, {param: spindle.max_speed}]}
    help: {what: The least of the gear.}
    page: "12-8"
  - id: macro.g_code
    name: G-code for Macro Call
    instances: ["1", "2"]
    each: "Macro call {i}"
    numbers: {start: 700, step: 3}
    type: real
    needs: [{what: paramacro option, page: "20-1"}]
    help: {what: The G-code that calls a macro.}
    page: "20-7"
"""
SCOPE = '  spindle: {instances: ["1", "2"], label: "Spindle {i}"}\nunits:'
UNUSED = """
conditions:
  gear_unused: {reads: {gears: spindle.gears}, when: part > gears, why: the gear is not used}
"""


@pytest.fixture
def spindles(facts, head) -> Schema:
    """Return a family with two spindles of three gears, and two macro calls."""
    return facts.schema(SPINDLES, head.replace("units:", SCOPE) + UNUSED)


def test_the_number_of_a_gear_finds_it_and_its_label_names_it(spindles, machine) -> None:
    here = machine(spindles)
    assert here.evaluation.find("931") == ("spindle.max_speed", "2.2")
    assert here.evaluation.find("spindle.max_speed@2.2") == ("spindle.max_speed", "2.2")
    assert spindles.on("mill").instance_label(("spindle.max_speed", "2.2")) == "Spindle 2, Gear 2"
    assert spindles.on("mill").instance_label(("spindle.gears", "2")) == "Spindle 2"
    assert spindles.on("mill").instance_label(("macro.g_code", "2")) == "Macro call 2"


def test_a_gear_reads_the_values_of_its_own_spindle(spindles, machine) -> None:
    here = machine(spindles, {"spindle.gears@1": Value(1), "spindle.gears@2": Value(2)})

    def ignored() -> list[str]:
        every = spindles.on("mill").instances(spindles.parameters["spindle.max_speed"])
        return [i for i in every if here.evaluation.state(("spindle.max_speed", i)).state == "ignored"]

    assert ignored() == ["1.2", "1.3", "2.3"]
    here.set("spindle.gears@1", Value(2))
    assert ignored() == ["1.3", "2.3"]


def test_a_bound_is_that_of_the_same_gear(spindles, machine) -> None:
    here = machine(
        spindles, {"spindle.max_speed@1.1": Value(900.0, "rpm"), "spindle.max_speed@2.1": Value(90.0, "rpm")}
    )
    assert None is fault(here.evaluation, ("spindle.min_speed", "1.1"), Value(900.0, "rpm"))
    assert "(set by 930 Max. Spindle Speed, 90 rpm)" in str(
        fault(here.evaluation, ("spindle.min_speed", "2.1"), Value(91.0, "rpm"))
    )


def test_a_rule_may_read_the_gears_of_its_spindle(spindles, machine) -> None:
    evaluation = machine(spindles).evaluation
    of_one = evaluation.reference("spindle.max_speed@.", "1", "spindle")
    assert [instance for _, instance in of_one.addresses] == ["1.1", "1.2", "1.3"]
    assert of_one == evaluation.reference("spindle.max_speed@.", "1.2", "spindle")
    assert of_one.is_list


def test_a_rule_over_gears_runs_once_a_gear_and_one_over_spindles_once_a_spindle(spindles, machine) -> None:
    def runs(reads: dict[str, str], check: str) -> list[str]:
        plain = {"id": "own.rule", "title": "Ours", "severity": "error", "message": "{part} no", "page": "1"}
        rule = Rule.model_validate({**plain, "reads": reads, "check": check})
        return [c.instance for c in checks_of(machine(spindles).evaluation, (rule,))]

    assert runs({"most": "spindle.max_speed", "gears": "spindle.gears"}, "part <= gears && most > 0.0") == [
        "1.1",
        "1.2",
        "1.3",
        "2.1",
        "2.2",
        "2.3",
    ]
    assert runs({"all": "spindle.max_speed@.", "gears": "spindle.gears"}, "gears <= double(size(all))") == [
        "1",
        "2",
    ]


@pytest.mark.parametrize(("instance", "part"), [("1.3", 3.0), ("2.12", 12.0), ("1", None), ("", None)])
def test_a_part_is_what_is_behind_the_point(instance: str, part: float | None) -> None:
    assert part == part_of(instance)


def test_a_page_may_be_that_of_the_second_spindle_or_of_one_gear(spindles) -> None:
    pages = [spindles.page(("spindle.max_speed", i)) for i in ("1.1", "2.1", "2.3")]
    assert pages == ["12-8", "13-8", "13-9"]
    assert spindles.page(("macro.g_code", "2")) == "20-7"


def test_every_label_of_an_instance_is_its_own() -> None:
    """Two instances of one parameter that were called alike could be mistaken for each other."""
    schema = load_schema("9pc")
    for parameter in schema.parameters.values():
        for machine in ("mill", "lathe"):
            names = [
                schema.on(machine).instance_label((parameter.id, i))
                for i in schema.on(machine).instances(parameter)
            ]
            assert len(set(names)) == len(names), parameter.id


def test_the_picture_of_what_is_read_in_docs_is_what_is_read() -> None:
    evaluation = new_file("9pc").evaluation
    seen = {
        sign: evaluation.reference(f"feedrate.rapid{sign}", "2", "axis")
        for sign in ("", "@3", "@*", "@<", "@>")
    }
    axes = {sign: [address[1] for address in found.addresses] for sign, found in seen.items()}
    assert axes["@*"] == ["1", "2", "3", "4", "5", "6", "7", "8"]
    assert (axes[""], axes["@3"], axes["@<"], axes["@>"]) == (
        ["2"],
        ["3"],
        ["1"],
        ["3", "4", "5", "6", "7", "8"],
    )
    assert [seen[sign].is_list for sign in seen] == [False, False, True, True, True]
    gears = evaluation.reference("spindle.max_speed@.", "2", "spindle").addresses
    assert [gear for _, gear in gears][:2] == ["2.1", "2.2"]
    assert evaluation.reference("spindle.gear_count", "2.3", "spindle").addresses == (
        ("spindle.gear_count", "2"),
    )


@pytest.mark.parametrize(("mode", "points"), [(1, 0), (1, 33), (1, 4000), (2, 7), (5, 1), (0, 12)])
def test_parts_of_an_array_are_active_as_each_is_by_itself(mode: int, points: int) -> None:
    """Thousands of points are asked about in halves, and come to what each of them comes to."""
    module = new_file("57c422b")
    module.set(("cam.mode", "X"), Value(mode))
    module.set(("cam.points", "X"), Value(points))
    addresses = module.schema.on(module.machine).addresses[::5]
    evaluation = module.evaluation
    together = evaluation.active(evaluation.groups(addresses))
    assert sorted(together) == sorted(a for a in addresses if evaluation.state(a).is_active)
