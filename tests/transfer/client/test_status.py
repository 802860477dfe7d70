"""The status of a control over its own protocol: positions,
states and faults with what the manual has about them.
"""

from amp_studio.families.grblhal.status import status_of as grbl_status
from amp_studio.families.servo57c422b.lines.status import AxisRegisters
from amp_studio.families.servo57c422b.lines.status import status_of as module_status
from amp_studio.transfer.driver import ControlIdentity

MODULE = ControlIdentity("57c422b", "registers", "rack")
GRBL = ControlIdentity("grblhal", "grbl", "grblHAL", axes=("X", "Y", "Z"))


def registers(mode: int, status: int, fault: int, position: int = 0, error: int = 0) -> AxisRegisters:
    pair = (position >> 16 & 0xFFFF, position & 0xFFFF)
    words = (status, fault, *pair, 0, 0, 0xFFFF, 0xFF9C, error & 0xFFFF, 0, 0, 1)
    return AxisRegisters("X", True, {65: (mode,), 72: words})


def test_registers_are_signed_counts_and_the_velocity_is_by_the_second() -> None:
    axis = module_status(MODULE, [registers(1, 0x81, 0, -70000, -12)]).axes[0]
    assert (axis.position, axis.following_error) == (-70000.0, -12.0)
    assert axis.velocity == -100 / 0.00125  # counts in one scan of 1.25 ms (4-39)
    assert axis.states == ("axis done", "control loop enabled")


def test_a_fault_has_its_cause_cure_parameters_and_page() -> None:
    fault = module_status(MODULE, [registers(1, 0, 1 << 4)]).faults[0]
    assert (fault.axis, fault.code, fault.page) == ("X", "R73 bit 4", "4-37")
    assert fault.causes
    assert fault.cures
    assert "setup.max_position_error" in fault.params


def test_what_is_inferred_is_called_so_and_a_loop_that_is_off_is_no_fault() -> None:
    status = module_status(MODULE, [registers(0, 1, 1 << 6)])
    assert status.faults == ()
    assert any(note.startswith("inferred") for note in status.assumptions)


def test_a_report_of_grbl_is_read() -> None:
    status = grbl_status(GRBL, "<Alarm|MPos:1.500,-2.000,0.000|FS:500,1200|Pn:XP>", "ALARM:9")
    assert [axis.position for axis in status.axes] == [1.5, -2.0, 0.0]
    assert status.axes[0].states == ("limit switch",)
    assert (status.state, status.values["feed"], status.values["spindle speed"]) == ("Alarm", 500.0, 1200.0)
    assert status.faults[0].code == "ALARM:9"
    assert status.faults[0].means or status.faults[0].cures
