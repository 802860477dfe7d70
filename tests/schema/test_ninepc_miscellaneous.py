"""Chapters 33, 34 and 37: the numbers of arrays and processes, the printed password, what is out of use."""

import pytest

from amp_studio.report.parameter.manual_page import facts
from amp_studio.schema import UnknownParameterError

NUMBERS = {
    "password.character": {"1": "101", "2": "102", "3": "103", "4": "104", "5": "105", "6": "106"},
    "oci.background_buffer": {"1": "336", "2": "337", "3": "338", "4": "339"},
    "control.retrace_limit": {"": "9", "1": "20009", "2": "21009"},
    "control.reset_g92": {"": "91", "1": "20091", "2": "21091"},
    "control.scaling_allowed": {str(axis): f"{axis}100" for axis in range(1, 9)},
    "patch.dac_monitor": {"2": "86", "3": "87"},
    "patch.acc_dec_ramp": {str(axis): f"{axis}202" for axis in range(1, 9)},
    "patch.internal": {str(axis): f"{axis}755" for axis in range(1, 9)},
}


@pytest.mark.parametrize("name", NUMBERS)
def test_every_instance_has_the_number_that_is_printed(ninepc, machine, name: str) -> None:
    """Pages 33-10 to 33-13, 34-5, 37-3 and A-5."""
    numbers = {
        i: ninepc.on("mill").number((name, i)) for i in ninepc.on("mill").instances(ninepc.parameter(name))
    }
    assert {i: str(number) for i, number in numbers.items()} == NUMBERS[name]
    assert [(name, i) for i in numbers] == [
        machine(ninepc).evaluation.find(n) for n in NUMBERS[name].values()
    ]


def test_the_factory_password_is_ab_d4_and_a_space(ninepc) -> None:
    default = ninepc.parameter("password.character").default
    codes = [default.instances.get(i, default.value) for i in NUMBERS["password.character"]]
    assert "".join(chr(int(code)) for code in codes) == "AB-D4 "


@pytest.mark.parametrize(("buffer", "state"), [("1", "in-force"), ("2", "ignored"), ("4", "ignored")])
def test_only_the_first_background_buffer_is_in_use(ninepc, machine, buffer: str, state: str) -> None:
    assert machine(ninepc).evaluation.state(("oci.background_buffer", buffer)).state == state


@pytest.mark.parametrize(("kind", "state"), [("lathe", "in-force"), ("mill", "hidden")])
def test_the_threading_word_is_one_of_the_lathe(ninepc, machine, kind: str, state: str) -> None:
    here = machine(ninepc, machine=kind)
    assert here.evaluation.state(("control.threading_word", "")).state == state


def test_chapter_35_adds_no_number(ninepc, machine) -> None:
    assert "35" not in {group.chapter for group in ninepc.groups}
    with pytest.raises(UnknownParameterError):
        machine(ninepc).evaluation.find("340")


def test_a_gain_takes_effect_at_once_where_online_amp_changes_it(ninepc) -> None:
    # Page 7-7: "change gain values real time, without a control restart"; what is downloaded waits for the
    # restart.
    gains = {"servo.initial_gain", "servo.velocity_proportional_gain", "servo.velocity_integral_gain"}
    online = {
        name for name, each in ninepc.parameters.items() if each.effect and each.effect.level == "online"
    }
    assert online == gains
    for name in gains:
        message = dict(facts(ninepc, ninepc.parameters[name]))["Takes effect"]
        assert message == "at once with on-line AMP at the control, else on restart of the control"
