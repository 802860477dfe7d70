"""What the 9/PC manual prints is in the examples as it is printed, and its formulas lead to their limits.

The figures are typed here from the manual, not taken from the files.
A page is that on which the section begins.
"""

from collections.abc import Callable

import pytest

from amp_studio.families.ninepc import formulas as ninepc
from amp_studio.files import ParameterFile
from amp_studio.schema import show_value

Machine = Callable[[str], ParameterFile]
MILL, LATHE = "mill-1394", "lathe-ls176"

PRINTED = [
    # The table of page 3-4; its first axis is printed as A, which axis 8 is called too.
    *((MILL, f"36{n}", "linear", "3-4") for n in range(3)),
    (MILL, "363", "rotary", "3-4"),
    (MILL, "364", "spindle", "3-4"),
    *((MILL, f"36{n}", "unfitted", "3-4") for n in (5, 6, 7)),
    *((MILL, f"25{n}", name, "3-4") for n, name in enumerate("YZBSWCA", 1)),
    *((MILL, f"{n}030", "SERCOS Interface", "3-4") for n in range(1, 6)),
    *((MILL, f"{n}031", "Digital or Digital Spindle", "3-4") for n in range(1, 5)),
    (MILL, "5031", "Position or Analog Spindle", "3-4"),
    (MILL, "4207", "360°", "4-6"),
    (MILL, "1310", "6 mm", "5-11"),
    (MILL, "2310", "4 mm", "5-11"),
    # The servo screens.
    (MILL, "97", "4 MHz", "7-1"),
    (MILL, "99", "1 ms", "7-1"),
    (MILL, "1570", "1326HR HIPERFACE Incremental (1326 digital systems only)", "7-1"),
    (MILL, "1575", "2097152 counts", "7-1"),
    (MILL, "1565", "2097152 counts", "7-1"),
    (MILL, "1735", "0.0254 mm", "7-1"),
    (MILL, "1710", "1", "7-1"),
    (MILL, "1720", "1", "7-1"),
    (MILL, "1340", "0 mm", "7-1"),
    (MILL, "1023", "1", "7-1"),
    (MILL, "1012", "200 %", "7-1"),
    (MILL, "1670", "200 %", "7-1"),
    (MILL, "1690", "0 %", "7-1"),
    (MILL, "1700", "Minus", "7-1"),
    (MILL, "1162", "200 Hz", "7-1"),
    (MILL, "1160", "1", "7-1"),
    (MILL, "1810", "0 counts", "7-1"),
    (MILL, "1811", "0 %", "7-1"),
    (MILL, "1504", "HIGH", "7-1"),
    (MILL, "1220", "900 W", "7-1"),
    # Sections and worked examples of chapters 7 and 10.
    (MILL, "5510", "Open Loop", "7-14"),
    (MILL, "1660", "300%", "7-61"),
    (MILL, "3690", "1 %", "7-63"),
    (MILL, "3700", "Plus", "7-64"),
    (MILL, "1550", "4 Poles", "7-73"),
    (MILL, "5040", "spindle 1", "7-82"),
    (MILL, "1000", "10", "10-14"),
    (LATHE, "1000", "10", "10-14"),
    (LATHE, "2575", "1048576 counts", "7-33"),
    # Table B.1 on page B-2, for the Heidenhain LS176.
    (LATHE, "1570", "A Quad B Distance-coded Marker", "B-2"),
    (LATHE, "1575", "20000 counts", "B-2"),
    (LATHE, "1500", "20 mm", "B-2"),
    (LATHE, "1501", "20.02 mm", "B-2"),
    (LATHE, "1502", "0 mm", "B-2"),
    (LATHE, "1026", "1", "B-2"),
    (LATHE, "1027", "1", "B-2"),
]


@pytest.mark.parametrize(("folder", "number", "printed", "page"), PRINTED)
def test_a_figure_of_the_manual_is_what_the_manual_prints(
    machine: Machine, folder: str, number: str, printed: str, page: str
) -> None:
    file = machine(folder)
    address = file.evaluation.find(number)
    assert printed == show_value(file.schema.parameters[address[0]], file.get(address)), f"page {page}"


def figure(file: ParameterFile, number: str) -> float:
    """Return a number of the file in canonical units (mm, mm/min, mm/s2)."""
    value = file.evaluation.canonical(file.evaluation.find(number))
    assert isinstance(value, float)
    return value


@pytest.mark.parametrize("axis", range(1, 5))
def test_excess_error_of_the_mill_is_the_least_of_page_7_20(machine: Machine, axis: int) -> None:
    file = machine(MILL)
    least = ninepc.minimum_excess_error(
        figure(file, f"{axis}203"), figure(file, f"{axis}710"), figure(file, f"{axis}720")
    )
    assert pytest.approx(least) == figure(file, f"{axis}750")


@pytest.mark.parametrize(("folder", "axes"), [(MILL, 4), (LATHE, 2)])
def test_limits_and_ramps_follow_from_feedrates_and_gain(machine: Machine, folder: str, axes: int) -> None:
    file = machine(folder)
    scan = figure(file, "626") * figure(file, "627")
    for axis in range(1, axes + 1):
        cutting, gain = figure(file, f"{axis}201"), figure(file, f"{axis}710")
        break_point = ninepc.gain_break_point(cutting, gain)  # page 7-22
        assert pytest.approx(break_point) == figure(file, f"{axis}730")

        ramp = ninepc.linear_ramp(cutting, ninepc.response_time_ms(gain))  # page 10-2
        for number in ("210", "211", "212", "213"):
            assert pytest.approx(ramp, rel=3e-4) == figure(file, f"{axis}{number}")
            assert ramp >= figure(file, f"{axis}{number}"), "the ramp stays below the response of the servo"

        used = figure(file, f"{axis}212")
        least, _ = ninepc.jerk_limits(used, scan)  # page 10-19
        assert least <= figure(file, f"{axis}215") < least + 2.0
        # The printed example takes 8 scans: 0.16 s at 20 ms.
        jerk = figure(file, f"{axis}214")
        assert pytest.approx(8 * scan / 1000.0, rel=3e-4) == ninepc.scurve_time(used, jerk)


def test_the_lathe_suppresses_the_feedrate_between_rapid_and_excess_error(machine: Machine) -> None:
    file = machine(LATHE)
    for axis in (1, 2):
        lag = ninepc.following_error(figure(file, f"{axis}203"), figure(file, f"{axis}710"))  # page 7-25
        suppression, excess = figure(file, f"{axis}740"), figure(file, f"{axis}750")
        assert suppression == pytest.approx(ninepc.typical_suppression_point(excess))  # page 7-21
        assert lag < suppression < excess


def test_the_counts_of_the_scale_are_those_of_page_7_33(machine: Machine) -> None:
    file = machine(LATHE)
    counts = ninepc.dcm_counts_per_cycle(0.02, 5, figure(file, "1500"))
    assert counts == 20_000 == figure(file, "1575")


@pytest.mark.parametrize(("folder", "number", "lead"), [(MILL, "1575", "1590"), (LATHE, "2575", "2590")])
def test_the_leads_keep_the_counts_per_inch_within_the_limit(
    machine: Machine, folder: str, number: str, lead: str
) -> None:
    file = machine(folder)
    per_inch = ninepc.counts_per_inch(figure(file, number), 1, 1, figure(file, lead))
    assert per_inch <= ninepc.COUNTS_PER_INCH_LIMIT  # page 7-33


def test_the_velocity_gains_are_those_of_table_7_b(machine: Machine) -> None:
    file = machine(MILL)
    # Page 7-55: B430G at 1 : 1 and 1 : 2, B420E at 1 : 1.
    assert [figure(file, f"{axis}801") for axis in range(1, 5)] == [6000, 6000, 9000, 4000]
    for axis in range(1, 5):
        gain = figure(file, f"{axis}710")
        low, high = ninepc.velocity_gain_bounds(gain)  # page 7-54
        assert low <= figure(file, f"{axis}801") <= high
        assert 0 < figure(file, f"{axis}800") < ninepc.integral_gain_limit(gain)  # page 7-56
        assert 5 <= figure(file, f"{axis}801") / figure(file, f"{axis}800") <= 10  # page A-10


@pytest.mark.parametrize(("folder", "axes"), [(MILL, 5), (LATHE, 3)])
def test_the_system_timing_is_that_of_pages_33_20_and_33_22(machine: Machine, folder: str, axes: int) -> None:
    file = machine(folder)
    fine = figure(file, "626")
    assert fine == ninepc.fine_foreground_minimum_ms(axes)
    # The readings printed on page 33-22: fine scan 4.3, block activation 5.8, foreground logic 2.8 ms.
    assert figure(file, "627") == ninepc.fine_scans_per_logic_scan(fine, 4.3, 5.8, 2.8)
    assert figure(file, "628") == ninepc.coarse_scan_ms(fine, figure(file, "627"))
