"""On-line AMP at the screen of the emulated 9/PC: what counts at once, what needs E-Stop,
and its messages (chapter 36).
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from rule_machines import sound

from amp_studio.families.ninepc.emulated.panel import NinePcPanel
from amp_studio.schema import Value
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.house.message import Flags
from amp_studio.transfer.image import decode_image, encode_image


@pytest.fixture
def at(tmp_path: Path) -> Iterator[Callable[[str], str | None]]:
    """Return what gives a command at a control in E-stop that contains a sound mill;
    ``at.control`` is the control.
    """
    file = sound("9pc", "mill")
    control = Control(
        tmp_path / "state", Identity("9pc", file.schema.signature), encode_image(file), accept=decode_image
    )
    panel = NinePcPanel(8)
    panel.started(control)

    def give(line: str) -> str | None:
        verb, _, rest = line.partition(" ")
        return panel.operate(control, verb, rest)

    give.control = control
    yield give
    control.close()


def value(at, name: str, instance: str) -> Value | None:
    return decode_image(at.control.image).get((name, instance))


def test_a_reversal_error_is_replaced_and_added_to_in_estop_and_needs_no_restart(at) -> None:
    at.control.set_estop(True)
    assert at("axis-param 1340 0.005") == "1340 0.005 mm"
    assert at("axis-param 1340 add 0.0015") == "1340 0.0065 mm"
    assert not at.control.flags & Flags.CHANGED_AT_CONTROL  # that is Patch AMP (page 37-3)
    assert value(at, "servo.reversal_error", "1") == Value(0.0065, "mm")
    at.control.set_estop(False)
    with pytest.raises(Exception, match="E-stop"):
        at("axis-param 1340 0.001")
    assert value(at, "servo.reversal_error", "1") == Value(0.0065, "mm")


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("axis-param 1340 10", "PARAM VALUE OUT OF RANGE"),
        ("axis-param 1340 add 10", "PARAM VALUE OUT OF RANGE"),
        ("axis-param 1801 2.5", "INVALID INPUT VALUE"),
        ("axis-param 1750 10", "on no screen of the axis parameters"),
        ("axis-calib 1 insert 100 3", "deviation 0"),
        ("axis-calib 1 explode", "axis-calib takes"),
    ],
)
def test_the_screen_refuses_with_its_messages(at, line: str, message: str) -> None:
    at.control.set_estop(True)
    before = at.control.image
    with pytest.raises(ValueError, match=message):
        at(line)
    assert at.control.image == before


def test_a_gain_goes_up_step_by_step_out_of_estop_and_the_motor_table_goes_off(at) -> None:
    at.control.set_estop(False)
    before = value(at, "servo.velocity_proportional_gain", "1")
    at("axis-param 1801 increase")
    at("axis-param 1801 increase")
    at("axis-param 1801 decrease")
    after = value(at, "servo.velocity_proportional_gain", "1")
    assert (before is not None, after is not None) == (True, True)
    assert after.value == before.value + 1
    assert value(at, "servo.standard_motor_values", "") == Value(False)


def test_points_are_put_in_and_unhome_the_axis(at) -> None:
    assert at("axis-calib 1 begin deviation - 0") == "points: 1; the axis is not homed"
    at("axis-calib 1 insert 100 0.004")
    at("axis-calib 1 insert 50 0.001")
    at("axis-calib 1 replace 50 0.002")
    assert value(at, "calibration.table", "1") == Value("deviation - mm 0:0 50:0.002 100:0.004")
    with pytest.raises(ValueError, match="PARAMETER OUT OF RANGE"):
        at("axis-calib 1 insert 150 2")
    at("axis-calib 1 delete 50")
    assert value(at, "calibration.table", "1") == Value("deviation - mm 0:0 100:0.004")
    with pytest.raises(ValueError, match="off until it is homed"):
        at("cal-status 1")
    assert at("home 1") == "homed, calibration on"
    assert at("cal-status 1") == "calibration off until the axis is homed"
