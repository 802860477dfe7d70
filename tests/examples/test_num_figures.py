"""What the example of the NUM family takes from the manual, and what follows from it by its formulas."""

from collections.abc import Callable

import pytest

from amp_studio.families.num import formulas as num
from amp_studio.files import ParameterFile
from amp_studio.schema import show_value

Machine = Callable[[str], ParameterFile]

MILL = "num-1060-mill"

PRINTED = [
    # The table of section 13.2.6.
    ("P4N0", "0x00", "13-14"),
    ("P5N0", "0x01", "13-14"),
    ("P5N1", "0x00", "13-14"),
    ("P6N1", "0x00", "13-14"),
    ("P7N0", "0x54", "13-14"),
    ("P7N1", "0x0A", "13-14"),
    ("P9N0", "0x00", "13-14"),
    ("P9N1", "0x01", "13-14"),
    ("P9N2", "0x02", "13-14"),
    ("P9N4", "0xFF", "13-14"),
    ("P9N31", "0xFF", "13-14"),
    ("P10N0", "0x00000000", "13-14"),
    # Worked examples of the chapters.
    ("P65N3", "5000", "4-36"),
    ("P36N2", "40", "5-22"),
    ("P36N34", "1000", "5-22"),
    ("P21N0", "4915", "6-14"),
    ("P56N0", "60 ms", "6-18"),
    ("P23N0", "6600 iu", "6-22"),
    ("P24N64", "600 iu", "6-30"),
    ("P52N0", "50 µm", "6-32"),
    ("P33N0", "3600 mm/min", "6-36"),
    ("P31N1", "1000 mm/min", "6-42"),
    ("P46N0", "10 rpm", "8-16"),
    ("P46N1", "100 rpm", "8-16"),
    ("P46N2", "80 rpm", "8-16"),
    ("P46N3", "500 rpm", "8-16"),
    ("P46N4", "400 rpm", "8-16"),
    ("P46N5", "2000 rpm", "8-16"),
    ("P35N0", "6", "9-8"),
    ("P35N1", "9206", "9-8"),
    ("P35N2", "85", "9-8"),
    ("P35N3", "9285", "9-8"),
    ("P50N0", "5000 µs", "9-10"),
    ("P58N0", "200", "9-14"),
    ("P58N1", "20480", "9-14"),
    ("P80N0", "0x93", "9-20"),
    ("P80N1", "0x2A", "9-20"),
    ("P37N8", "0x1D", "10-2"),
    ("P38N1", "0x001B5B43", "10-4"),
]


@pytest.mark.parametrize(("number", "printed", "page"), PRINTED)
def test_a_figure_of_the_manual_is_what_the_manual_prints(
    machine: Machine, number: str, printed: str, page: str
) -> None:
    file = machine(MILL)
    address = file.evaluation.find(number)
    assert printed == show_value(file.schema.parameters[address[0]], file.get(address)), f"page {page}"


def figure(file: ParameterFile, number: str) -> float:
    """Return a number of the file in canonical units (mm, mm/min, ms)."""
    value = file.evaluation.canonical(file.evaluation.find(number))
    assert isinstance(value, float)
    return value


@pytest.mark.parametrize(
    ("axis", "movement", "periods", "interpolation"),
    [(0, 5000, 2500, 1), (1, 20, 1, 5), (2, 20, 1, 10), (3, 3_600_000, 5000 * 180, 1)],
)
def test_the_conversions_follow_from_the_encoders(
    machine: Machine, axis: int, movement: int, periods: int, interpolation: int
) -> None:
    """Page 5-6; Z is the rule of page 5-22."""
    file = machine(MILL)
    words = (figure(file, f"P11N{2 * axis}"), figure(file, f"P11N{2 * axis + 1}"))
    assert words == num.multi_divi(movement, num.encoder_measurement(periods, interpolation))


def test_the_position_loops_follow_from_speed_and_time_constant(machine: Machine) -> None:
    """Pages 6-14, 6-22 and 6-36."""
    file = machine(MILL)
    units = [num.internal_unit_mm(figure(file, "P4N2"))] * 3 + [num.rotary_unit_deg(figure(file, "P4N4"))]
    for axis, unit in enumerate(units):
        speed, constant = figure(file, f"P30N{axis}"), figure(file, "P56N0")
        assert int(num.loop_gain_coefficient(speed, constant, unit, 9.0)) == figure(file, f"P21N{axis}")
        assert num.max_following_error(speed, constant, unit) == pytest.approx(
            file.get(file.find(f"P23N{axis}")).value
        )
        assert num.approach_speed(figure(file, f"P32N{2 * axis}"), constant) == figure(file, f"P33N{axis}")


def test_rigid_tapping_follows_from_the_periods(machine: Machine) -> None:
    """Page 8-35."""
    file = machine(MILL)
    assert num.position_anticipation(figure(file, "P56N0"), 5000) == figure(file, "P63N1")
    assert int(num.zero_crossing_anticipation(500 * 1.25 / 60, 1000, 5000)) == figure(file, "P63N2")
