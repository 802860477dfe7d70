"""The emulated 9/PC at its own screen: what it shows at power-up, why it stays in E-Stop,
password and Patch AMP.
"""

from collections.abc import Callable, Iterator
from pathlib import Path
from unittest import mock

import pytest
from rule_machines import sound

from amp_studio.families.ninepc.emulated.panel import NinePcPanel, axes_supported
from amp_studio.families.ninepc.emulated.power_up import corrected_limits, estop_reasons
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.emulator import Emulator
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.image import decode_image, encode_image, patch_image


@pytest.fixture(scope="module")
def sound_mill() -> ParameterFile:
    """Return a mill without a finding; to be copied."""
    return sound("9pc", "mill")


@pytest.fixture
def mill(sound_mill: ParameterFile) -> ParameterFile:
    """Return a mill that can be changed, with the password as delivered."""
    file = sound_mill.copy()
    for n in "123456":
        file.set(("password.character", n), None)
    return file


class Operator:
    """Somebody at the keys: gives a command and reads the lines that come."""

    def __init__(self, emulator: Emulator, control: Control, displayed: list[str]) -> None:
        self.control, self._emulator, self._displayed = control, emulator, displayed
        self.at_power_up = list(displayed)

    def keys(self, line: str) -> str:
        """Give one command and return what is shown."""
        self._displayed.clear()
        self._emulator.operate(line)
        self._emulator._execute()
        if line == "restart":
            self._emulator._restart_due = False
            self._emulator._report(self._emulator._restarted)
            self._emulator._started()
        return "\n".join(self._displayed)


@pytest.fixture
def at(tmp_path: Path) -> Iterator[Callable[..., Operator]]:
    """Return what switches a control on that contains a file that was changed at it."""
    controls = []

    def switch_on(file: ParameterFile, axes: int = 8) -> Operator:
        displayed: list[str] = []
        identity = Identity("9pc", file.schema.signature)
        control = Control(tmp_path / "state", identity, encode_image(file), accept=decode_image)
        controls.append(control)
        control._record.changed_at_control = True
        emulator = Emulator(
            control, mock.Mock(), patch=patch_image, panel=NinePcPanel(axes), say=displayed.append
        )
        emulator._started()
        return Operator(emulator, control, displayed)

    yield switch_on
    for control in controls:
        control.close()


def logged_on(operator: Operator) -> Operator:
    assert operator.keys("password AB-D4") == "access level 0"  # page 33-11, as delivered
    assert operator.keys("patch-amp LOCK") == "patch AMP"  # page 37-2
    return operator


# -- why it stays in E-stop ----------------------------------------------------------------------


def test_a_sound_machine_comes_out_of_estop(mill, at) -> None:
    assert list(estop_reasons(mill, 8)) == []
    assert at(mill).keys("estop off") == "estop off"


def test_too_many_axes_stay_in_estop(mill, at) -> None:
    """Page 3-1: more axes than the control was ordered with."""
    operator = at(mill, axes=3)
    assert (
        operator.at_power_up[-1]
        == "kept in E-stop: 7 axes are configured and the control supports 3 (page 3-1)"
    )
    assert operator.keys("estop off").startswith(
        "refused: the control stays in E-stop: 7 axes are configured"
    )
    assert operator.keys("status").startswith("status estop=on")


@pytest.mark.parametrize(
    ("address", "value", "reason"),
    [
        (("servo.loop_type", "2"), "none", "axis 2 has a type and no Servo Loop Type (page 3-7)"),
        (
            ("patch.dac_monitor", "2"),
            209,
            "parameter 86 contains 209, which is no function and axis (page A-6)",
        ),
        (
            ("patch.dac_monitor", "3"),
            100,
            "parameter 87 contains 100, which is no function and axis (page A-6)",
        ),
    ],
)
def test_what_the_manual_names_contains_it_in_estop(mill, address, value, reason) -> None:
    mill.set(address, Value(value))
    assert list(estop_reasons(mill, 8)) == [reason]


def test_tool_offset_modes_that_do_not_go_together_hold_it_with_the_printed_message(mill) -> None:
    mill.set(("tool.geometry_mode", ""), Value("shift-move"))
    mill.set(("tool.wear_mode", ""), Value("shift-delayed-move"))
    assert list(estop_reasons(mill, 8)) == ["INCOMPATIBLE TOOL ACTIVATION MODES (page 21-4)"]
    mill.set(("tool.wear_mode", ""), Value("delayed"))
    assert list(estop_reasons(mill, 8)) == []


@pytest.mark.parametrize("code", [0, 204, 504, 608])  # page A-6
def test_a_code_of_the_dac_monitor_that_is_a_function_and_an_axis_stops_nothing(mill, code) -> None:
    mill.set(("patch.dac_monitor", "2"), Value(code))
    assert list(estop_reasons(mill, 8)) == []


def test_a_control_as_it_is_delivered_is_not_configured_and_shows_nothing(mill, tmp_path: Path) -> None:
    mill.set(("servo.loop_type", "2"), Value("none"))
    control = Control(tmp_path, Identity("9pc", mill.schema.signature), encode_image(mill))
    assert NinePcPanel(3).started(control).estop_reason == ""
    control.close()


@pytest.mark.parametrize("image", [b"garbage", encode_image(new_file("num"))])
def test_an_amp_that_cannot_be_read_keeps_it_and_ends_nothing(mill, tmp_path: Path, image: bytes) -> None:
    control = Control(tmp_path, Identity("9pc", mill.schema.signature), image)
    control._record.changed_at_control = True
    assert NinePcPanel().started(control).estop_reason == "its AMP cannot be read"
    control.close()


# -- following-error limits -----------------------------------------------------------------------


def test_limits_in_the_wrong_order_are_corrected_at_power_up_with_the_printed_message(mill, at) -> None:
    """Page 7-20: Inposition Band < Gain Break Point < Feedrate Suppression Point <= Excess Error."""
    mill.set(("servo.feedrate_suppression", "1"), Value(16.0, "mm"))
    operator = at(mill)
    assert operator.at_power_up[1].startswith("SERVO AMP FE LIMITS CORRECTED: axis 1 works with 1740 = 15 ")
    assert "1740 = 16" not in operator.keys("messages")
    assert logged_on(operator).keys("search 1740") == "1740 16.00000"  # what is stored stays (assumed)


def test_equal_limits_are_corrected_only_where_the_manual_asks_for_less(mill) -> None:
    for name in ("feedrate_suppression", "excess_error"):
        mill.set((f"servo.{name}", "1"), Value(15.0, "mm"))
    assert corrected_limits(mill) == {}
    mill.set(("servo.gain_break_point", "1"), Value(15.0, "mm"))
    (found,) = corrected_limits(mill)["1"].items()
    assert (found[0][0], float(found[1])) == ("servo.gain_break_point", 14.99999)


# -- the screen ---------------------------------------------------------------------------------------


def test_patch_amp_is_behind_two_passwords(mill, at) -> None:
    operator = at(mill)
    assert "not visible" in operator.keys("patch-amp LOCK")
    assert operator.keys("password ABCD") == "refused: this is not the password of the control"
    assert operator.keys("password AB-D4") == "access level 0"
    assert "second password" in operator.keys("patch-amp lock")
    assert operator.keys("patch-amp LOCK") == "patch AMP"


def test_the_master_password_is_that_of_the_amp(mill, at) -> None:
    for n, sign in enumerate("MILL 7", 1):
        mill.set(("password.character", str(n)), Value(ord(sign)))
    operator = at(mill)
    assert operator.keys("password AB-D4").startswith("refused")
    assert operator.keys("password MILL 7") == "access level 0"


def test_what_is_replaced_is_stored_all_at_once_by_update_and_current_after_a_restart(mill, at) -> None:
    operator = logged_on(at(mill))
    before = operator.control.image
    assert operator.keys("replace 1750 20") == "1750 20.00000"
    assert operator.keys("replace 1740 19.5") == "1740 19.50000"
    assert operator.control.image == before
    assert operator.keys("update") == "updated: switch the control off and on (restart)"
    assert decode_image(operator.control.image).get(("servo.excess_error", "1")) == Value(20.0, "mm")
    assert operator.keys("restart").splitlines()[1:] == ["restarted 2", "AMP HAS BEEN MODIFIED BY PATCH AMP"]
    assert operator.keys("can") == "cleared"
    assert operator.keys("messages") == "no message"
    assert "AMP HAS BEEN MODIFIED" in operator.keys("restart"), "at every power-up (page 37-3)"


def test_what_is_searched_for_is_shown_on_one_line(mill, at) -> None:
    (line,) = logged_on(at(mill)).keys("search 1750\n@1").splitlines()
    assert line.startswith("1750")


def test_who_leaves_without_update_has_changed_nothing(mill, at) -> None:
    operator = logged_on(at(mill))
    before = operator.control.image
    operator.keys("replace 1750 20")
    assert operator.keys("leave") == "left; nothing is changed"
    assert operator.control.image == before
    assert "not on the screen" in operator.keys("update")


def test_update_needs_estop(mill, at) -> None:
    operator = logged_on(at(mill))
    operator.keys("replace 1750 20")
    operator.keys("estop off")
    assert "E-stop" in operator.keys("update")
    assert decode_image(operator.control.image).get(("servo.excess_error", "1")) == Value(15.0, "mm")


def test_what_patch_amp_does_not_offer_is_not_found(mill, at) -> None:
    operator = logged_on(at(mill))
    for line in ("search 1030", "search 99999", "search x", "replace 2030 1", "search servo.hardware_type@1"):
        assert operator.keys(line) == "refused: PARAMETER NUMBER NOT FOUND", line  # page 37-2


def test_illegal_values_are_taken_because_patch_amp_checks_no_range(mill, at) -> None:
    assert logged_on(at(mill)).keys("replace 1750 999") == "1750 999.00000"  # page 37-1


def test_an_odd_word_at_the_screen_is_refused(mill, at) -> None:
    operator = logged_on(at(mill))
    for line in (
        "replace 1750",
        "replace",
        "replace 1750 x",
        "replace 1750 1 mm",
        "update now",
        "password",
        "patch-amp",
    ):
        assert operator.keys(line).startswith("refused: "), line


@pytest.mark.parametrize(
    ("given", "refused"), [({"axes": "9"}, "no number of axes"), ({"axis": "1"}, "Unknown option")]
)
def test_an_option_that_no_9pc_has_is_refused(given, refused) -> None:
    with pytest.raises(ValueError, match=refused):
        axes_supported(given)
    assert axes_supported({"axes": "3"}) == 3


# -- the sheet at this screen -----------------------------------------------------------------------


def test_a_sheet_keyed_in_line_by_line_and_read_back_from_this_screen_is_the_file(mill, at) -> None:
    from amp_studio.sheet import compare_screen, make_sheet, read_screen_readings

    wanted = mill.copy()
    for number, text in (
        ("1750", "1 in"),
        ("1740", "0.9 in"),
        ("399", "b"),
        ("4750", "20"),
        ("2350", "12.34567 ipm"),
    ):
        address = wanted.find(number)
        wanted.set(address, wanted.read(address, text))
    sheet = make_sheet(wanted, mill)
    operator = logged_on(at(mill))
    for entry in sheet.entries:
        assert operator.keys(f"search {entry.number}").split()[1:] == [
            f"{float(entry.old):.5f}"
        ] or entry.number in ("399", "2350")
        assert not operator.keys(f"replace {entry.number} {entry.new}").startswith("refused")
    operator.keys("update")
    operator.keys("restart")
    logged_on(operator)
    screen = "\n".join(operator.keys(f"search {entry.number}") for entry in sheet.entries)
    assert {each.state for each in compare_screen(sheet, wanted, read_screen_readings(screen))} == {"same"}
    again = make_sheet(wanted, decode_image(operator.control.image))
    assert (again.entries, again.left_out) == ((), ())
