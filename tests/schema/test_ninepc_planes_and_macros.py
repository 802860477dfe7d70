"""Planes, macro calls and interrupts of the real 9/PC: arrays whose numbers and states go by the instance."""

import pytest

from amp_studio.schema import Value


@pytest.mark.parametrize(
    ("kind", "number", "expected"),
    [
        ("mill", "541", "plane.primary_1@17"),
        ("mill", "558", "plane.parallel_2_second@19"),
        ("mill", "547", "plane.primary_1@18"),
        ("lathe", "570", "plane.primary_1@17"),
        ("lathe", "581", "plane.parallel_2_second@19"),
        ("lathe", "547", "plane.primary_1@18"),
        ("lathe", "552", "plane.parallel_2_second@18"),
        ("lathe", "55", "macro.type1_g_code@9019"),
        ("mill", "742", "macro.type2_g_code@15"),
        ("mill", "744", "macro.type2_program@15"),
        ("mill", "34", "macro.word_call@S"),
        ("mill", "508", "logic.analog_connector@4"),
        ("lathe", "124", "interrupt.service@0"),
    ],
)
def test_a_number_of_an_array_names_its_instance(
    ninepc, machine, kind: str, number: str, expected: str
) -> None:
    """Pages 17-3 to 17-8, 19-2, 20-3 to 20-11, 25-5."""
    name, _, instance = expected.partition("@")
    assert machine(ninepc, machine=kind).evaluation.find(number) == (name, instance)


def test_behind_a_call_that_is_not_used_all_the_rest_are_not_used(ninepc, machine) -> None:
    """Page 20-9: with call 6 NOT USED the control takes 7 to 15 as NOT USED."""
    values = {f"macro.type2_call@{n}": Value("not-modal") for n in range(1, 16)}
    state = machine(ninepc, values | {"macro.type2_call@6": Value("not-used")}).evaluation.state
    assert state(("macro.type2_call", "6")).state == "in-force"
    for name, unused in (("call", range(7, 16)), ("g_code", range(6, 16)), ("program", range(6, 16))):
        ignored = {n for n in range(1, 16) if state((f"macro.type2_{name}", str(n))).state == "ignored"}
        assert ignored == set(unused)


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({}, "ignored"),
        ({"macro.type1_call@9015": "modal"}, "in-force"),
        ({"macro.type2_call@2": "modal"}, "in-force"),
        ({"macro.type2_call@4": "modal"}, "ignored"),
        ({"macro.type1_call@9015": None}, "in-force"),
    ],
)
def test_the_modality_counts_for_modal_calls_only(ninepc, machine, changes, expected: str) -> None:
    """Page 20-5; call 4 comes after a call that is not used."""
    choices = {f"macro.type1_call@{n}": "not-modal" for n in range(9010, 9020)}
    choices |= {"macro.type2_call@1": "not-modal", "macro.type2_call@2": "not-modal"}
    choices |= {"macro.type2_call@3": "not-used"} | changes
    values = {name: Value(choice) for name, choice in choices.items() if choice is not None}
    assert machine(ninepc, values).evaluation.state(("macro.modality", "")).state == expected


def test_a_type_1_call_that_is_not_used_makes_its_g_code_ignored(ninepc, machine) -> None:
    """Page 20-6."""
    here = machine(ninepc, {"macro.type1_call@9011": Value("not-used")})
    assert here.evaluation.state(("macro.type1_g_code", "9011")).state == "ignored"
    assert here.evaluation.state(("macro.type1_g_code", "9012")).state == "in-force"
