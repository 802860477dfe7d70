"""The facts of commissioning: every parameter of every family has its step, with its page."""

import re
from dataclasses import replace
from itertools import pairwise

import pytest

from amp_studio.families.grblhal.described import schema_of
from amp_studio.guide import find_step, step_of, steps_of
from amp_studio.schema import family_ids, load_schema
from tests.families.grblhal.recorded import HELP, with_lines

FAMILIES = family_ids()

REST = {
    "57c422b": {"commands", "status", "interrupt"},  # the application program writes them
    "9pc": {"patch_only"},  # no page of the AMP editor has them (37-3)
    "acromill": {"p_parameters", "offsets", "memory", "messages"},  # operators and programs fill them
    # settings of plugins
    "grblhal": {
        "aux_ports",
        "bluetooth",
        "can_bus",
        "encoders",
        "kinematics",
        "modbus",
        "modbus_tcp",
        "networking",
        "plasma",
        "user_settings",
        "vfd",
        "wifi",
    },
    "num": {"reserved"},  # "not documented" or "invalid" (2-1 to 2-3)
    "syntec": set(),
}
"""The groups of what is in no step, on purpose."""


def chapter(page: str) -> int:
    """Return the chapter of a page of the 9/PC manual; appendices come behind."""
    head = page.partition("-")[0]
    return int(head) if head.isdigit() else 100


@pytest.mark.parametrize("family", FAMILIES)
def test_every_parameter_is_in_exactly_one_step(family: str) -> None:
    schema = load_schema(family)
    listed = [p.id for step in steps_of(schema) for p in step.parameters]
    assert sorted(listed) == sorted(schema.parameters)
    assert len(listed) == len(set(listed))
    assert {name: step_of(schema)[name].number for name in listed} == {
        p.id: step.number for step in steps_of(schema) for p in step.parameters
    }


@pytest.mark.parametrize("family", [f for f in FAMILIES if load_schema(f).commissioning is not None])
def test_only_what_has_a_reason_is_left_to_the_last_step(family: str) -> None:
    schema = load_schema(family)
    rest = [p for step in steps_of(schema) if step.id == "rest" for p in step.parameters]
    assert {schema.group_of[p.id].key for p in rest} == REST.get(family, set())
    assert schema.commissioning is not None
    assert len(schema.commissioning.rest.what) > 40


@pytest.mark.parametrize("family", FAMILIES)
def test_every_step_has_a_separate_title_and_a_page_where_an_order_is_printed(family: str) -> None:
    schema = load_schema(family)
    steps = steps_of(schema)
    assert len({step.title for step in steps}) == len({step.id for step in steps}) == len(steps)
    assert [step.title for step in steps if len(step.title) > 40] == []
    assert schema.commissioning is None or all(step.page for step in steps)
    assert [step.number for step in steps] == list(range(1, len(steps) + 1))


def test_the_order_of_the_9pc_is_that_of_its_chapters_but_for_what_chapter_3_sets_first() -> None:
    steps = steps_of(load_schema("9pc"))
    assert [p.id for p in steps[0].parameters] == [
        "control.type",
        "control.mill_type",
        "control.lathe_type",
        "axis.name",
        "axis.type",
        "servo.hardware_type",
        "servo.loop_type",
    ]
    behind = [(p.id, chapter(p.page)) for step in steps[1:] for p in step.parameters]
    late = [(b, a) for a, b in pairwise(behind) if b[1] < a[1]]
    # the DAC monitor, of appendix A, is set for the tuning of chapter 36; Patch AMP (37) comes last
    assert late == [(("calibration.table", 36), ("patch.dac_monitor", 100))]
    assert [chapter(step.page) for step in steps] == sorted(chapter(step.page) for step in steps)


@pytest.mark.parametrize("family", ["num", "syntec"])
def test_the_steps_of_a_manual_follow_its_pages(family: str) -> None:
    pages = [
        [int(n) for n in re.findall(r"\d+", step.page)]
        for step in steps_of(load_schema(family))
        if step.id != "rest"
    ]
    assert pages == sorted(pages)


def test_what_the_guides_of_num_have_by_parameter_is_in_the_step_of_the_same_section() -> None:
    schema = load_schema("num")
    sections = {
        "3-1": "axes",
        "3-2": "measurements",
        "3-3": "servo",
        "3-4": "travels",
        "3-5-1": "spindles",
        "3-5-2": "spindles",
        "3-6": "miscellaneous",
        "3-7": "communication",
        "3-8": "disc",
    }
    odd = [
        (guide.id, name)
        for guide in schema.guides
        if guide.id.startswith("step-")
        for step in guide.steps
        for name in step.params
        if step_of(schema)[name].id != sections[guide.id.removeprefix("step-")]
    ]
    assert odd == [("step-3-8", "servo.loop_gain")]
    assert [p.id for p in find_step(schema, "disc").again] == ["servo.loop_gain"]


def test_a_family_without_an_order_has_its_groups_as_steps() -> None:
    schema = replace(load_schema("syntec"), further_text="")
    assert [step.id for step in steps_of(schema)] == [group.key for group in schema.groups]
    assert sum(len(step.parameters) for step in steps_of(schema)) == len(schema.parameters)


def test_a_step_is_found_by_its_number_and_by_its_id_and_a_wrong_one_names_the_nearest() -> None:
    schema = load_schema("9pc")
    assert find_step(schema, "9") is find_step(schema, "jog")
    with pytest.raises(
        ValueError, match=r"^Unknown step 'jogg'\. Did you mean: jog. The steps have the numbers 1 to 23$"
    ):
        find_step(schema, "jogg")


def test_what_a_plugin_adds_to_a_control_that_describes_itself_is_in_the_last_step() -> None:
    plugin = "[SETTINGGROUP:20|0|Plasma]", "[SETTING:350|20|Arc voltage|V|6|##0.00|10|300|0|0]"
    schema = schema_of(with_lines(*plugin) + HELP)
    listed = [p.id for step in steps_of(schema) for p in step.parameters]
    assert sorted(listed) == sorted(schema.parameters)
    last = steps_of(schema)[-1]
    assert last.id == "rest"
    assert "Arc voltage" in [p.name for p in last.parameters]
    assert step_of(schema)["axis.steps"].id == "steps"


def test_a_control_that_lacks_settings_leaves_the_others_in_their_steps() -> None:
    from dataclasses import replace

    known = load_schema("grblhal")
    few = tuple(g for g in known.groups if g.key in ("axis", "stepper"))
    schema = replace(
        known,
        groups=few,
        parameters={p.id: p for g in few for p in g.parameters},
        group_of={p.id: g for g in few for p in g.parameters},
    )
    listed = [p.id for step in steps_of(schema) for p in step.parameters]
    assert sorted(listed) == sorted(schema.parameters)
    assert step_of(schema)["axis.steps"].id == "steps"
