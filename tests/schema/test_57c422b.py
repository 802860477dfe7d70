"""The registers of the 57C422B, compared with chapter 4 and the printed programs of the manual."""

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Schema, Value, fault, field_value, load_schema
from amp_studio.schema.bit_fields import field_at
from amp_studio.schema.storage import stored_number


@pytest.fixture(scope="module")
def schema() -> Schema:
    return load_schema("57c422b")


@pytest.fixture
def file() -> ParameterFile:
    return new_file("57c422b")


SINGLE = [
    0,
    1,
    2,
    3,
    4,
    5,
    6,
    7,
    8,
    9,
    10,
    27,
    28,
    31,
    32,
    33,
    38,
    41,
    63,
    65,
    66,
    67,
    68,
    69,
    72,
    73,
    80,
    81,
    82,
    83,
    104,
    105,
    125,
    128,
    129,
    130,
    131,
]
"""Sections 4.2 to 4.50 with one register."""
DOUBLE = [11, 13, 15, 17, 19, 21, 23, 25, 29, 34, 36, 39, 74, 76, 78, 84, 86, 126]
"""Sections with a pair of registers, separated by a comma."""


def registers(schema: Schema, axis: str) -> dict[int, int]:
    """Return register -> how many of them a parameter of an axis has, without the cam table."""
    found: dict[int, int] = {}
    for parameter in schema.parameters.values():
        if parameter.scope == "axis":
            number = int(schema.on("module").numbers(parameter)[axis].removeprefix("R"))
            found[number] = max(found.get(number, 0), parameter.storage.words)
    return found


@pytest.mark.parametrize(("axis", "above"), [("X", 0), ("Y", 2048)])
def test_every_register_of_chapter_4_is_there_for_both_axes(schema: Schema, axis: str, above: int) -> None:
    found = registers(schema, axis)
    assert found.pop(26 + above) == 1, "the denominator of the gear ratio, page 4-15"
    assert found.pop(99 + above) == 5, "ten characters, page 4-42"
    assert {n - above for n, words in found.items() if words == 1} == set(SINGLE)
    assert {n - above for n, words in found.items() if words == 2} == set(DOUBLE)


def test_two_registers_are_there_once_for_the_module(schema: Schema) -> None:
    """Page 4-1: registers 64 and 4095 are used for both axes."""
    once = {
        p.id: schema.on("module").numbers(p)[""] for p in schema.parameters.values() if p.scope == "global"
    }
    assert once == {"control.interrupt_reset": "R64", "interrupt.control": "R4095"}


@pytest.mark.parametrize(
    ("register", "address"),
    [
        ("R3", ("gain.proportional", "X")),
        ("R2051", ("gain.proportional", "Y")),
        ("R10", ("setup.in_position_tolerance", "X")),
        ("R2058", ("setup.in_position_tolerance", "Y")),
        ("R2075", ("command.leds", "Y")),
        ("R2114", ("control.command_66", "Y")),
        ("R2120", ("status.status", "Y")),
        ("R2121", ("status.fault", "Y")),
        ("R2176", ("cam.points", "Y")),
    ],
)
def test_registers_of_the_y_axis_are_2048_higher(file: ParameterFile, register: str, address) -> None:
    """Pages 4-1, 4-15, 4-16, 4-43 and 4-57 print these."""
    assert file.find(register) == address


STORED = [
    # Page 4-48: the move, speed and acceleration of the index program, its output and gear ratio.
    ("command.position@X", "80000 counts", 80000),
    ("command.velocity@X", "160000 counts/s", 10485760),
    ("command.acceleration@X", "50000 counts/s2", 3277),
    ("output.max_voltage@X", "10 V", 1984),
    ("command.direct_reference@X", "-10 V", -1984),
    ("command.gear_ratio@X", "1", 16777216),
    ("command.gear_ratio@X", "0", 0),
    ("output.feedback_unwind@X", "1600000 counts", 1600000),
    ("setup.max_velocity_error@X", "3200000 counts/s", 4000),
    # Page 5-5.
    ("setup.max_velocity_error@X", "6400 counts/s", 8),
    # Page 5-6: a hundredth of the speed.
    ("command.home_speed_low@X", "1600 counts/s", 104858),
    # Page 4-15: 127:1.
    ("command.gear_ratio@X", "127", 2130706432),
    # Pages 4-41 and 4-54: scans of 1.25 ms.
    ("status.velocity_period@X", "1.25 ms", 1),
    ("cam.time@X", "12.5 ms", 10),
    ("cam.time@X", "0.0125 s", 10),
]


@pytest.mark.parametrize(("name", "text", "stored"), STORED)
def test_engineering_units_become_register_numbers(
    file: ParameterFile, name: str, text: str, stored: int
) -> None:
    address = file.find(name)
    value = file.read(address, text)
    assert fault(file.evaluation, address, value) is None
    assert stored_number(file.schema.parameters[address[0]], value, turns=False) == stored


REFUSED = [
    ("command.velocity@X", Value(32768000.0, "counts/s")),  # 2 to the 31 in the register, erratum e-r19-limit
    ("command.acceleration@X", Value(3.28e10, "counts/s2")),  # erratum e-r21-limit
    ("command.direct_reference@X", Value(10.1, "V")),
    ("output.max_voltage@X", Value(-0.1, "V")),
    ("command.gear_ratio@X", Value(127.1)),
    ("command.gear_ratio@X", Value(-0.1)),
    ("command.gear_denominator@X", Value(0)),
    ("cam.position_increment@X", Value(-1, "counts")),
    ("cam.position_increment@X", Value(32768, "counts")),
    ("cam.time@X", Value(0.0, "ms")),
    ("cam.time_points@X.0", Value(32768, "counts")),
    ("cam.position_points@X.0", Value(2**31, "counts")),
    ("gain.proportional@X", Value(32768)),
    ("setup.encoder@X", Value(65536)),
    ("control.interrupt_reset", Value(1)),
    ("status.fault@X", Value(0)),
]


@pytest.mark.parametrize(("name", "value"), REFUSED)
def test_what_a_register_cannot_hold_or_may_not_is_refused(
    file: ParameterFile, name: str, value: Value
) -> None:
    assert fault(file.evaluation, file.find(name), value) is not None


@pytest.mark.parametrize(("mode", "most"), [("0x0000", 3830), ("0x0001", 1915), ("0x0100", 956)])
def test_a_cam_table_has_so_many_points(file: ParameterFile, mode: str, most: int) -> None:
    """Page 4-57: bytes, words, positions."""
    file.set(file.find("R130"), file.read(file.find("R130"), mode))
    assert fault(file.evaluation, file.find("R128"), Value(most)) is None
    assert fault(file.evaluation, file.find("R128"), Value(most + 1)) is not None


def points_in_force(file: ParameterFile) -> dict[str, int]:
    """Return how many entries of each form of the table of X exist."""
    forms = ("cam.time_points", "cam.byte_points", "cam.position_points")
    state = file.evaluation.state
    return {
        form: sum(state(a).state == "in-force" for a in file.addresses() if a[0] == form and a[1][0] == "X")
        for form in forms
    }


@pytest.mark.parametrize(
    ("mode", "points", "there", "last"),
    [
        ("0x0009", 1915, ("cam.time_points", 1915), "R2046"),
        ("0x0008", 3830, ("cam.byte_points", 1915), "R2046"),
        ("0x0008", 3, ("cam.byte_points", 2), "R133"),
        ("0x0100", 956, ("cam.position_points", 956), "R2042"),
    ],
)
def test_the_table_is_there_in_the_form_and_length_that_two_registers_give_it(
    file: ParameterFile, mode: str, points: int, there: tuple[str, int], last: str
) -> None:
    assert set(points_in_force(file).values()) == {0}
    file.set(file.find("R130"), file.read(file.find("R130"), mode))
    file.set(file.find("R128"), Value(points))
    assert {form: n for form, n in points_in_force(file).items() if n} == dict([there])
    assert file.find(last) == (there[0], f"X.{there[1] - 1}")


def test_the_numbers_of_a_table_mean_its_own_form_even_behind_its_end(file: ParameterFile) -> None:
    for mode, form in (("0x0009", "time"), ("0x0008", "byte"), ("0x0108", "position")):
        file.set(file.find("R130"), file.read(file.find("R130"), mode))
        file.set(file.find("R128"), Value(3))
        assert file.find("R140")[0] == f"cam.{form}_points"


def test_two_bytes_of_a_table_are_set_one_by_one(file: ParameterFile) -> None:
    """Page 4-49: the lower numbered byte is the least significant one."""
    parameter = file.schema.parameters["cam.byte_points"]
    assert [field_value(field_at(parameter, n), 0x80FF) for n in (0, 8)] == [-1, -128]
    file.set(file.find("R130"), Value(8))
    file.set(file.find("R128"), Value(4))
    assert file.evaluation.find_bit("R133.8") == (("cam.byte_points", "X.1"), 8)


def test_gear_ratio_is_one_pair_or_two_numbers(file: ParameterFile) -> None:
    """Page 4-15: by register 38, bit 2."""
    assert file.find("R25") == ("command.gear_ratio", "X")
    file.set(file.find("R38"), Value(4))
    assert file.find("R25") == ("command.gear_numerator", "X")
    assert file.evaluation.state(("command.gear_denominator", "X")).state == "in-force"
    assert file.evaluation.state(("command.gear_ratio", "X")).state == "hidden"


@pytest.mark.parametrize(
    ("encoder", "ignored"),
    [
        (0x0000, {"output.feedback_unwind", "output.gearing_unwind"}),
        (0x0010, {"setup.overtravel_positive", "setup.overtravel_negative", "output.gearing_unwind"}),
        (0x1000, {"output.feedback_unwind"}),
        (0x1010, {"setup.overtravel_positive", "setup.overtravel_negative"}),
    ],
)
def test_what_is_linear_has_limits_and_what_is_rotary_unwinds(
    file: ParameterFile, encoder: int, ignored: set[str]
) -> None:
    """Pages 4-10, 4-11, 4-19 and 4-20, by bits 4 and 12 of register 0."""
    file.set(file.find("R0"), Value(encoder))
    out = {a[0] for a in file.addresses() if a[1] == "X" and file.evaluation.state(a).state == "ignored"}
    assert out == ignored


def test_the_module_writes_its_status_itself(schema: Schema) -> None:
    """Pages 4-34, 4-37 and 4-43: registers 72 and 73 are read only; 74 to 87 are what the module reports."""
    found = {
        schema.on("module").numbers(p).get("X", "R4095")
        for p in schema.parameters.values()
        if p.access == "read"
    }
    assert found == {f"R{n}" for n in (72, 73, 74, 76, 78, 80, 81, 82, 84, 86, 99, 4095)}


COMMANDS = {
    "change default setups": {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 31, 34, 36, 83},
    "home axis": {15, 17, 19, 21, 23, 34, 36},
    "enable feedback": {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 31, 34, 36},
    "define sync position": {17, 29},
    "update LEDs": {27},
    "latch status": {74, 76, 78, 80, 81},
    "do cam profile": {126, 128, 129, 130, 131, 132},
    "change gear ratio": {25, 26},
    "change velocity": {19},
    "output volts": {28},
}
"""Page 4-32 for the default setups (registers 0-14, 31, 34-37 and 83), 4-24 for enable feedback, which reads
the set-up data too; the pages of the registers for the rest."""


@pytest.mark.parametrize("command", COMMANDS)
def test_a_register_shows_which_command_makes_the_module_read_it(schema: Schema, command: str) -> None:
    found = set()
    for parameter in schema.parameters.values():
        effect = parameter.effect or schema.family.effect
        if effect.level == "command" and command in str(effect.command):
            found.add(int(next(iter(schema.on("module").numbers(parameter).values())).removeprefix("R")))
    assert found == COMMANDS[command]


@pytest.mark.parametrize(
    ("parameter", "bits"),
    [
        ("setup.encoder", (0, 1, 2, 3, 8, 9, 10, 11)),
        ("setup.drive", (0, 1)),
        ("setup.switches", (0, 1, 2, 3, 4, 5, 8, 9, 10, 11)),
        ("control.mode", (3, 6, 7, 8, 10, 11)),
    ],
)
def test_a_bit_whose_figure_is_lost_is_called_inferred_and_counts_as_unknown(
    schema: Schema, parameter: str, bits: tuple[int, ...]
) -> None:
    """Errata e-r0-bits, e-r1-bits, e-r2-bits and e-r65-bits have the evidence (4-3, 4-48, 5-5 to 5-7)."""
    found = {each.bit: each for each in schema.parameters[parameter].bits or ()}
    assert all(found[bit].label.endswith("(inferred)") and found[bit].unknown for bit in bits)
    assert sum("(inferred)" in each.label for each in found.values()) == len(bits)
