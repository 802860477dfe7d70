"""The emulated module: commands with their handshake,
faults and interrupts as chapter 4 of the manual has them.
"""

from pathlib import Path

import pytest

from amp_studio.families.servo57c422b.emulated.module import (
    ACKNOWLEDGE,
    DEFAULTS,
    DONE,
    ENABLED,
    FEEDBACK_FAULT,
    HOME,
    HOMED,
    ILLEGAL,
    LATCH,
    MOVE,
    PASSIVE,
    SYSTEM,
    Module,
)
from amp_studio.families.servo57c422b.emulated.rack import Rack
from amp_studio.families.servo57c422b.lines.register_line import framed
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory

GAINS = {3: 17595, 4: 768, 5: 78, 6: 8320, 7: 28, 8: 2000, 9: 4000, 10: 10, 31: 1984, 32: 0xFFFF, 33: 0xFFFF}
"""Of the program on page 4-48."""


@pytest.fixture
def module() -> Module:
    """Return a module whose X axis has its loop on, and gains, speed (10000 counts/s)
    and rates (50000 counts/s2) for a move.
    """
    module = Module()
    for register, word in GAINS.items():
        module.write(register, word)
    for register, number in (
        (17, 500),
        (19, round(10000 * 65.536)),
        (21, 3277),
        (23, 3277),
        (15, round(1000 * 65.536)),
    ):
        put(module, register, number)
    module.write(65, 1)
    return module


def put(module: Module, register: int, number: int) -> None:
    """Write a double word."""
    module.write(register, number >> 16 & 0xFFFF)
    module.write(register + 1, number & 0xFFFF)


def double(module: Module, register: int) -> int:
    word = module.read(register) << 16 | module.read(register + 1)
    return word - (1 << 32) if word >> 31 else word


def done(module: Module, command: int) -> int:
    """Give a command, let it be carried out, and return the latched position."""
    for each in (command, LATCH):
        module.write(66, each)
        module.write(66, 0)
        for _ in range(200):
            if module.read(72) & DONE:
                break
            module.advance(0.05)
        module.advance(0.2)
    return double(module, 74)


def test_a_cold_start_sets_the_system_fault_and_the_loops_are_off() -> None:
    module = Module()
    for axis in (0, 2048):
        assert module.read(axis + 73) & SYSTEM  # page 4-38
        assert module.read(axis + 73) & FEEDBACK_FAULT  # page 4-38: register 65, bit 0 is 0


def test_the_loop_toggled_on_resets_the_faults_and_reads_the_setups(module: Module) -> None:
    assert (module.read(73), bool(module.read(72) & ENABLED)) == (0, True)  # page 4-24
    assert module.setups["X"][18] == 500
    module.write(65, 0)
    assert module.read(73) == FEEDBACK_FAULT


def test_a_command_is_acknowledged_until_the_application_clears_it(module: Module) -> None:
    module.write(66, DEFAULTS)
    assert (module.read(72) & ACKNOWLEDGE, module.read(66)) == (ACKNOWLEDGE, DEFAULTS)  # page 4-36
    module.write(66, 0)
    assert module.read(72) & ACKNOWLEDGE == 0


def test_with_auto_acknowledge_the_module_clears_the_command_itself(module: Module) -> None:
    module.write(63, 1)
    module.write(66, DEFAULTS)
    assert (module.read(66), module.read(72) & ACKNOWLEDGE) == (0, 0)  # page 4-22


@pytest.mark.parametrize(
    ("first", "second"), [(DEFAULTS | LATCH, 0), (DEFAULTS, 1 << 3)], ids=["two in 66", "one in each"]
)
def test_two_commands_at_once_are_illegal_until_both_registers_are_zero(
    module: Module, first: int, second: int
) -> None:
    module.write(67, second)
    module.write(67, second)
    module.write(66, 0) if not second else module.write(72, 0)
    if second:  # the first of them is recognised alone, and has to be cleared
        module.words[72] &= ~ACKNOWLEDGE
    module.write(66, first)
    assert module.read(73) & ILLEGAL  # page 4-38
    module.write(66, 0)
    module.write(67, 0)
    assert module.read(73) & ILLEGAL == 0


@pytest.mark.parametrize("register", [22, 24])
def test_a_move_without_a_rate_is_illegal(module: Module, register: int) -> None:
    module.write(register, 0)
    module.write(66, MOVE)
    assert module.read(73) & ILLEGAL  # page 4-38
    assert module.read(72) & ACKNOWLEDGE == 0


def test_the_position_registers_are_updated_by_latch_status_alone(module: Module) -> None:
    module.write(66, MOVE)
    module.write(66, 0)
    assert module.read(72) & DONE == 0
    module.advance(1.0)
    assert (module.read(72) & DONE, double(module, 74)) == (DONE, 0)
    module.write(66, LATCH)
    assert abs(double(module, 74) - 500) <= 10  # page 4-38, and In-Position Tolerance
    assert abs(module.read(80)) <= 10


def test_incremental_moves_add_up(module: Module) -> None:
    module.write(65, 0x21)  # as on page 4-48: index move and position loop
    assert (
        done(module, HOME) == 500
    )  # no switch, no marker: the position is that of 17, 18, and nothing moves (4-29)
    done(module, MOVE)
    assert abs(done(module, MOVE) - 1500) <= 10


def test_homing_with_switch_and_marker_moves_the_axis_and_names_its_place(module: Module) -> None:
    """01DH: negative onto the switch, slowly off it, on to the marker (4-29, 5-6); there it is what 17,
    18 are.
    """
    module.write(2, 0x1D)
    module.write(66, HOME)
    module.write(66, 0)
    places, status = [], []
    for _ in range(120):
        module.advance(0.1)
        module.write(66, LATCH)
        module.write(66, 0)
        places.append(double(module, 74))
        status.append(module.read(72))
    assert min(places) < -2000  # it went to the switch
    assert status[0] & (1 << 2)  # busy
    assert status[-1] & HOMED
    assert abs(places[-1] - 500) < 100  # and stopped a little behind the marker


def test_the_first_marker_gives_the_position_where_passive_homing_is_set(module: Module) -> None:
    """4-33: bit 4 of register 67 (inferred) moves nothing; at the marker, a quarter turn on, it is 500."""
    module.write(2, 1 << 3)
    module.write(67, PASSIVE)
    module.write(67, 0)
    module.advance(0.5)
    assert double(module, 74) == 0
    put(module, 17, 3000)
    module.write(66, MOVE)
    put(module, 17, 500)
    assert done(module, 0) == pytest.approx(3000 - 1000 + 500, abs=10)


def test_an_axis_without_gains_does_not_follow_and_faults(module: Module) -> None:
    module.write(3, 0)
    module.write(66, DEFAULTS)
    module.write(66, 0)
    put(module, 17, 50000)
    module.write(66, MOVE)
    assert module.read(73) & 1 << 4  # the error is above register 8 (4-37)
    assert module.read(72) & ENABLED == 0


def test_a_speed_that_the_loop_cannot_follow_trips_by_register_8(module: Module) -> None:
    """The fault comes over the registers, and bit 0 of 65 off and on takes the axis up again (4-24)."""
    module.write(8, 20)
    module.write(66, DEFAULTS)
    module.write(66, 0)
    put(module, 17, 200000)
    put(module, 19, round(100000 * 65.536))
    put(module, 21, 65536)
    assert done(module, MOVE) < 200000
    assert module.read(73) & 1 << 4
    module.write(65, 0)
    module.write(65, 1)
    assert module.read(73) == 0


def test_velocity_control_stops_at_the_software_limit_and_leaves_it_after_bit_2_was_off(
    module: Module,
) -> None:
    """4-25: at the limit a change of direction alone does nothing; bit 2 off, on with the direction
    changed.
    """
    module.write(2, 1 << 10)
    put(module, 11, 3000)
    put(module, 13, -3000)
    module.write(66, DEFAULTS)
    module.write(66, 0)
    module.write(65, 0b101)
    module.advance(1.0)
    module.advance(1.0)
    at = done(module, LATCH)
    assert 3000 < at < 5000  # it decelerates behind the limit (4-6)
    module.write(65, 0b10101)
    module.advance(0.5)
    assert done(module, LATCH) == pytest.approx(at, abs=10)
    module.write(65, 0b10001)
    module.write(65, 0b10101)
    module.advance(0.3)
    assert done(module, LATCH) < at - 500


def test_a_fault_of_one_axis_switches_its_loop_off_and_not_the_other(module: Module) -> None:
    module.write(2048 + 65, 1)
    module.fault(0, 4)
    assert (module.read(73), module.read(72) & ENABLED) == (1 << 4 | FEEDBACK_FAULT, 0)
    assert module.read(2048 + 72) & ENABLED


def test_an_enabled_bit_causes_an_interrupt_and_another_does_not(module: Module) -> None:
    module.write(69, 1 << 4)
    module.fault(0, 5)
    assert module.read(105) == 0
    module.fault(0, 4)
    assert module.read(105) == 1 << 4  # page 4-45
    module.write(105, 0)
    assert module.read(105) == 0


@pytest.mark.parametrize("register", [72, 73, 74, 99, 2120, 4095])
def test_what_the_module_writes_nothing_else_writes(module: Module, register: int) -> None:
    before = module.read(register)
    module.write(register, before ^ 0xFF)
    assert module.read(register) == before


# -- at the line ---------------------------------------------------------------------


@pytest.fixture
def rack(tmp_path: Path) -> Rack:
    return Rack(DeviceSetup("57c422b", Memory(tmp_path), print))


def message(rack: Rack, data: bytes) -> bytes:
    rack.receive(data)
    return rack.answer()


def test_a_request_is_answered_with_its_number(rack: Rack) -> None:
    assert message(rack, framed(5, "W 3 160")) == framed(5, "W 3 160")
    assert message(rack, framed(6, "R 2 2")) == framed(6, "R 2 0 160")


@pytest.mark.parametrize(
    "line",
    [
        b"\r\n",
        b"R 0 1\r\n",
        framed(1, "R 0 1").replace(b"R", b"r"),
        b"x" * 5_000 + b"\r\n",
        framed(1, "R 0 1")[:-4] + b"0\r\n",
        b"1 R 0 1*ffff\r\n",
    ],
)
def test_a_damaged_line_gets_no_answer_and_the_next_one_does(rack: Rack, line: bytes) -> None:
    assert message(rack, line) == b""
    assert message(rack, framed(2, "R 0 1")) == framed(2, "R 0 0")


@pytest.mark.parametrize("request_", ["R 4096 1", "R 4095 2", "R 0 0", "R 0 33", "W 4096 1", "W 0 65536"])
def test_registers_that_there_are_not_are_refused(rack: Rack, request_: str) -> None:
    assert message(rack, framed(1, request_)).startswith(b"1 E there ")


@pytest.mark.parametrize(
    "line", ["patch R4096=1", "patch 3=1", "fault 16 X", "fault 4 Z", "show R9999", "power off", "jump"]
)
def test_an_odd_word_of_the_operator_is_refused(rack: Rack, line: str) -> None:
    with pytest.raises(ValueError, match="is no command"):
        rack.operate(line)
