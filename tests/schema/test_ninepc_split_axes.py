"""Split axes of the real 9/PC: which servo takes its values from which,
and what can be keyed in for each set.
"""

import pytest

from amp_studio.schema import Value
from amp_studio.schema.values import read_value

SETS = {"1": ("deskew.master@1", "deskew.slave@1"), "2": ("deskew.master_2@2", "deskew.slave_2@2")}
NAMES = {"axis.name@1": Value("x"), "axis.name@2": Value("y"), "axis.name@4": Value("u")}

SHARED = (
    "home",
    "zone",
    "jog",
    "feedrate",
    "accdec",
    "css",
    "format",
    "tool",
    "comp",
    "cycle",
    "roughing",
    "cylindrical",
    "virtual_c",
)
"""What the slave takes from its master, by the beginning of the ids (page 32-4)."""


def pair(of: str, master: str | None = "x", slave: str | None = "u") -> dict[str, Value]:
    """Return the two names of a set."""
    return {name: Value(key) for name, key in zip(SETS[of], (master, slave), strict=True) if key is not None}


@pytest.mark.parametrize("kind", ["mill", "lathe"])
@pytest.mark.parametrize("of", SETS)
def test_a_slave_takes_what_page_32_4_lists_from_its_master_and_nothing_else(
    ninepc, machine, kind: str, of: str
) -> None:
    here = machine(ninepc, NAMES | pair(of), machine=kind).evaluation
    copied = {
        address[0]
        for address in ninepc.on(kind).addresses
        if address[1] == "4" and here.state(address).why.startswith("the slave of a split axis")
    }
    shared = {
        name for name, scope in ninepc.on(kind).scopes.items() if scope == "axis" and name.startswith(SHARED)
    }
    hidden = {name for name in shared if here.state((name, "4")).state == "hidden"}
    assert copied == shared - hidden - {"home.calibration"}
    assert copied >= {"home.position", "zone.overtravel_used", "jog.traverse_speed", "accdec.jerk"}
    for axis in ("1", "2"):
        assert here.state(("jog.speed_third", axis)).state == "in-force"


@pytest.mark.parametrize(
    "values",
    [
        pair("1", master="none"),
        pair("1", master=None),
        pair("2", master="none"),
        pair("1", master="u"),
        pair("1", slave=None) | pair("2", master=None),
        pair("1", master="none") | pair("2", slave="none"),
    ],
)
def test_without_another_servo_as_master_of_its_own_set_no_axis_is_a_slave(ninepc, machine, values) -> None:
    here = machine(ninepc, NAMES | values).evaluation
    assert here.state(("feedrate.rapid", "4")).state == "in-force"


@pytest.mark.parametrize("of", SETS)
def test_gain_and_limit_count_for_the_set_that_names_two_servos(ninepc, machine, of: str) -> None:
    other = "2" if of == "1" else "1"
    here = machine(ninepc, pair(of) | pair(other, slave="none")).evaluation
    for name in ("deskew.gain", "deskew.skew_limit"):
        assert here.state((name, of)).state == "in-force"
        assert here.state((name, other)).state == "ignored"


def test_patch_amp_has_codes_for_names_with_dollar_in_set_1_only(ninepc) -> None:
    """Page 37-3, erratum e-640-dollar."""
    codes = {"none": 0, "a": 65, "b": 66, "c": 67, "u": 85, "v": 86, "w": 87, "x": 88, "y": 89, "z": 90}
    dollar = {"dollar-b": 92, "dollar-c": 93, "dollar-x": 94, "dollar-y": 95, "dollar-z": 96}
    for servo in ("master", "slave"):
        first, second = ninepc.parameter(f"deskew.{servo}"), ninepc.parameter(f"deskew.{servo}_2")
        assert {c.key: c.raw for c in first.choices} == codes | dollar
        assert {c.key: c.raw for c in second.choices} == codes | dict.fromkeys(dollar)
        assert [(c.key, c.code, c.label) for c in first.choices] == [
            (c.key, c.code, c.label) for c in second.choices
        ]
        assert read_value(second, "raw:92", "") == Value("raw:92")
        changed = {"id", "numbers", "instances", "choices", "help"}
        assert first.model_dump(exclude=changed) == second.model_dump(exclude=changed)
        assert first.help.model_dump(exclude={"related"}) == second.help.model_dump(exclude={"related"})


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        ("660", ("deskew.master", "1")),
        ("640", ("deskew.master_2", "2")),
        ("661", ("deskew.slave", "1")),
        ("641", ("deskew.slave_2", "2")),
        ("662", ("deskew.gain", "1")),
        ("642", ("deskew.gain", "2")),
        ("663", ("deskew.skew_limit", "1")),
        ("643", ("deskew.skew_limit", "2")),
    ],
)
def test_the_numbers_of_the_sets(ninepc, machine, number: str, expected: tuple[str, str]) -> None:
    """Pages 32-4 to 32-10 and 37-3: set 1 has the higher numbers."""
    assert machine(ninepc).evaluation.find(number) == expected
