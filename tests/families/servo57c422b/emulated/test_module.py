"""The emulated module: commands with their handshake, faults and interrupts as chapter 4 of the manual has them."""

from __future__ import annotations

from pathlib import Path

import pytest

from amp_studio.families.servo57c422b.emulated.module import (
    ACKNOWLEDGE,
    DEFAULTS,
    DONE,
    ENABLED,
    FEEDBACK_FAULT,
    HOME,
    ILLEGAL,
    LATCH,
    MOVE,
    SYSTEM,
    Module,
)
from amp_studio.families.servo57c422b.emulated.rack import Rack
from amp_studio.families.servo57c422b.lines.register_line import framed
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory


@pytest.fixture
def module() -> Module:
    """Return a module whose X axis has its loop on and rates for a move."""
    module = Module()
    for register, word in ((22, 100), (24, 100), (18, 500), (65, 1)):
        module.write(register, word)
    return module


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
    assert (module.read(72) & DONE, module.read(75)) == (DONE, 0)
    module.write(66, LATCH)
    assert (module.read(74), module.read(75)) == (0, 500)  # page 4-38


def test_incremental_moves_add_up(module: Module) -> None:
    module.write(65, 0x21)  # as on page 4-48: index move and position loop
    for command in (HOME, MOVE, MOVE, LATCH):
        module.write(66, command)
        module.write(66, 0)
    assert module.read(75) == 1500


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
def test_what_the_module_writes_nobody_else_does(module: Module, register: int) -> None:
    before = module.read(register)
    module.write(register, before ^ 0xFF)
    assert module.read(register) == before


# -- at the line ---------------------------------------------------------------------


@pytest.fixture
def rack(tmp_path: Path) -> Rack:
    return Rack(DeviceSetup("57c422b", Memory(tmp_path), print))


def said(rack: Rack, data: bytes) -> bytes:
    rack.receive(data)
    return rack.answer()


def test_a_request_is_answered_with_its_number(rack: Rack) -> None:
    assert said(rack, framed(5, "W 3 160")) == framed(5, "W 3 160")
    assert said(rack, framed(6, "R 2 2")) == framed(6, "R 2 0 160")


@pytest.mark.parametrize("line", [
    b"\r\n", b"R 0 1\r\n", framed(1, "R 0 1").replace(b"R", b"r"), b"x" * 5_000 + b"\r\n", framed(1, "R 0 1")[:-4] + b"0\r\n",
    b"1 R 0 1*ffff\r\n",
])  # fmt: skip
def test_a_damaged_line_gets_no_answer_and_the_next_one_does(rack: Rack, line: bytes) -> None:
    assert said(rack, line) == b""
    assert said(rack, framed(2, "R 0 1")) == framed(2, "R 0 0")


@pytest.mark.parametrize("request_", ["R 4096 1", "R 4095 2", "R 0 0", "R 0 33", "W 4096 1", "W 0 65536"])
def test_registers_that_there_are_not_are_refused(rack: Rack, request_: str) -> None:
    assert said(rack, framed(1, request_)).startswith(b"1 E there ")


@pytest.mark.parametrize(
    "line", ["patch R4096=1", "patch 3=1", "fault 16 X", "fault 4 Z", "show R9999", "power off", "jump"]
)
def test_an_odd_word_of_the_operator_is_refused(rack: Rack, line: str) -> None:
    with pytest.raises(ValueError, match="is no command"):
        rack.command(line)
