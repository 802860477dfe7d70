"""An emulated 57C422B: 4096 registers, the commands in 66 and 67 with their handshake,
and the faults of register 73.

Written from chapter 4 of the instruction manual. Our copy has lost the figures with the bit numbers: bits
that no text and no program of the manual names are ASSUMED below. Behind each axis is a simulated one, made
from its registers, that moves while time passes (`advance`).
"""

from __future__ import annotations

from collections.abc import Callable

from amp_studio.families.servo57c422b.law_facts import MOTION
from amp_studio.families.servo57c422b.switch_bits import MARKER

from .module_axis import ModuleMotion, double

REGISTERS, AXIS_Y = 4096, 2048
AXES = {"X": 0, "Y": AXIS_Y}
SWITCHES, ACCELERATION, DECELERATION, POSITION = 2, 21, 23, 17
AUTO_ACKNOWLEDGE, INTERRUPT_RESET, MODE, COMMAND, COMMAND_2 = 63, 64, 65, 66, 67
ENABLE_STATUS, ENABLE_FAULT, STATUS, FAULT, SOURCE_STATUS, SOURCE_FAULT = 68, 69, 72, 73, 104, 105
FEEDBACK, VERSION = 74, 99

_LOOP = 1 << 0  # enable control loop (page 4-24)
_VELOCITY_CONTROL, _NEGATIVE, _INCREMENTAL = 1 << 2, 1 << 4, 1 << 5  # pages 4-24 and 4-25
MOVE, HOME, STOP, DEFAULTS, LATCH = 1 << 0, 1 << 2, 1 << 6, 1 << 9, 1 << 11  # pages 4-28 to 4-32
DEFINE, CHANGE_VELOCITY = (
    1 << 1,
    1 << 8,
)  # 4-28 and 4-31; the bit of "define feedback position" is inferred by its place
PASSIVE = 1 << 4  # of 67, "set feedback position on feedback marker pulse": inferred by its place (4-33)
DONE, ACKNOWLEDGE = 1 << 0, 1 << 15  # pages 4-43 and 4-36
LOCKED, BUSY, HOMED, ENABLED = 1 << 1, 1 << 2, 1 << 5, 1 << 7  # ASSUMED, by the order of section 4.37
POSITION_ERROR, VELOCITY_ERROR = 1 << 4, 1 << 5  # page 4-43
OVERTRAVEL, DRIVE, FEEDBACK_FAULT, ILLEGAL, SYSTEM = 1 << 0, 1 << 3, 1 << 6, 1 << 8, 1 << 9
"""ASSUMED, by the order of section 4.38: bits 0 to 3 are the overtravels and the drive fault, as the mask
037FH of page 5-6 has them."""
FAULTS = {
    "POSITION ERROR": POSITION_ERROR,
    "VELOCITY ERROR": VELOCITY_ERROR,
    "OVERTRAVEL": OVERTRAVEL,
    "DRIVE FAULT": DRIVE,
}
"""Alarm of the simulated axis -> bit of register 73."""
IN_POSITION, MAX_ERROR, VELOCITY, ERROR, PERIOD = 10, 8, 78, 80, 83
READ_ONLY = frozenset((*range(70, 83), *range(84, 88), *range(99, 104)))
"""Written by the module; the manual calls 72 to 82, 84 to 87 and 99 to 103 its own.
What a write to them does is not printed: here nothing."""
NAME = "57C422B module in an emulated rack"


class Module:
    """One module. ``read`` and ``write`` are what an application task does over the backplane of the rack."""

    def __init__(self) -> None:
        self.words = [0] * REGISTERS
        """What is in the registers at power-on is not printed: here 0."""
        self._motion = {base: ModuleMotion(name) for name, base in AXES.items()}
        self.setups: dict[str, tuple[int, ...]] = {}
        """Axis -> the setup registers that the module works with, once a command has it take them over."""
        self.power_on()

    def power_on(self) -> None:
        """Begin as after a cold start of the processor, which sets the system fault (page 4-38)."""
        self.words[:] = [0] * REGISTERS
        self.setups.clear()
        self._motion = {base: ModuleMotion(name) for name, base in AXES.items()}
        for axis in AXES.values():
            for n, pair in enumerate(("EM", "UL", "AT", "ED", " 1")):
                self.words[axis + VERSION + n] = int.from_bytes(pair.encode("ascii"), "big")
            self.words[axis + STATUS] = DONE
            self.words[axis + FAULT] = FEEDBACK_FAULT
        self.stop_all()

    def stop_all(self) -> None:
        """Obey STOP ALL / CLEAR from the programming terminal: feedback and drive reference off,
        system fault (page 4-38).
        """
        for axis in AXES.values():
            self.words[axis + MODE] &= ~_LOOP & 0xFFFF
            self._follow_mode(axis, 0)
            self._set(axis + FAULT, SYSTEM)

    def fault(self, axis: int, bit: int) -> None:
        """Have a severe fault: the control loop is disabled (page 4-35)."""
        self._set(axis + FAULT, 1 << bit)
        self._disable(axis)

    def trip(self, axis: int) -> None:
        """Have the drive of an axis trip: its input sets the fault bit where register 2 enables it (4-5),
        else the following error shows it. Raises ValueError where the registers make no axis.
        """
        motion = self._motion[axis]
        if not motion.bind(self.words) or motion.simulated is None:
            raise ValueError("the registers of this axis make none that can move")
        motion.simulated.fail("drive")

    def advance(self, duration: float) -> None:
        """Let time pass, s: the axes move, and their state is in registers 72 and 73 (continuously,
        4-34 and 4-37).
        """
        for axis, motion in self._motion.items():
            simulated = motion.simulated
            if simulated is None:
                continue
            was_busy = bool(self.words[axis + STATUS] & BUSY)
            simulated.advance(duration)
            if simulated.alarm is not None and self.words[axis + STATUS] & ENABLED:
                self._set(axis + FAULT, FAULTS.get(simulated.alarm.code, 0))
                if not simulated.is_enabled:
                    self._disable(axis)
            if was_busy and not simulated.is_busy:
                self.words[axis + STATUS] &= ~BUSY & 0xFFFF
                self._set(axis + STATUS, DONE | (HOMED if simulated.is_homed else 0))
            self._locked(axis, abs(simulated.following_error))

    def _locked(self, axis: int, error: float) -> None:
        if error < self.words[axis + IN_POSITION]:
            self._set(axis + STATUS, LOCKED)
        else:
            self.words[axis + STATUS] &= ~LOCKED & 0xFFFF

    def _disable(self, axis: int) -> None:
        """Switch the loop off: the drive gets no output, and the axis coasts (4-6)."""
        self.words[axis + STATUS] &= ~(ENABLED | BUSY) & 0xFFFF
        self._set(axis + STATUS, DONE)
        self._set(axis + FAULT, FEEDBACK_FAULT)
        simulated = self._motion[axis].simulated
        if simulated and simulated.is_enabled:
            simulated.switch_off()

    def read(self, register: int) -> int:
        """Return a register."""
        return self.words[register]

    def write(self, register: int, word: int) -> None:
        """Write a register; the module reads mode and commands continuously (pages 4-23 and 4-27)."""
        axis, number = register // AXIS_Y * AXIS_Y, register % AXIS_Y
        if number in READ_ONLY or register == REGISTERS - 1:
            return
        before, self.words[register] = self.words[register], word
        if number == MODE:
            self._follow_mode(axis, before)
        elif number in (COMMAND, COMMAND_2):
            self._execute(axis)

    # -- what the module does ---------------------------------------------------------

    def _follow_mode(self, axis: int, before: int) -> None:
        """Switch the control loop; toggled on, it reads the setups and resets faults (page 4-24)."""
        is_on, was_on = bool(self.words[axis + MODE] & _LOOP), bool(before & _LOOP)
        if is_on and not was_on:
            self._take_setups(axis)
            self.words[axis + FAULT] = 0
            self._set(axis + STATUS, ENABLED)
            simulated = self._motion[axis].simulated
            if simulated:
                simulated.reset()
        elif not is_on:
            self._disable(axis)
        self._follow_velocity(axis, before)

    def _follow_velocity(self, axis: int, before: int) -> None:
        """Begin or end velocity control; a change of its direction alone is not seen at a limit (4-25)."""
        mode, motion = self.words[axis + MODE], self._motion[axis]
        if mode & _VELOCITY_CONTROL and not before & _VELOCITY_CONTROL:
            self._run(axis)
        elif before & _VELOCITY_CONTROL and not mode & _VELOCITY_CONTROL:
            motion.stop(self.words)
        elif mode & _VELOCITY_CONTROL and (mode ^ before) & _NEGATIVE and not motion.is_stopped:
            self._run(axis)

    def _run(self, axis: int) -> None:
        """Run an axis in its direction at the velocity of the registers."""
        motion = self._motion[axis]
        if not self.words[axis + STATUS] & ENABLED or not motion.bind(self.words):
            return
        if motion.simulated:
            motion.simulated.alarm = None
        motion.limit(self.words)
        motion.run(-1.0 if self.words[axis + MODE] & _NEGATIVE else 1.0, self.words)
        self._begun(axis)

    def _take_setups(self, axis: int) -> None:
        name = next(each for each, base in AXES.items() if base == axis)
        self.setups[name] = tuple(self.words[axis : axis + COMMAND - 3])
        self._motion[axis].bind(self.words)

    def _execute(self, axis: int) -> None:
        """Obey the command words of an axis by their handshake: a command, its acknowledge, 0."""
        first, second = self.words[axis + COMMAND], self.words[axis + COMMAND_2]
        if (
            first == second == 0
        ):  # the application has seen the acknowledge, or ends an illegal command (page 4-38)
            self.words[axis + STATUS] &= ~ACKNOWLEDGE & 0xFFFF
            self.words[axis + FAULT] &= ~ILLEGAL & 0xFFFF
            return
        if self.words[axis + STATUS] & ACKNOWLEDGE:
            return  # the last command is not cleared yet: nothing new is recognised
        if (first.bit_count() + second.bit_count()) > 1 or not self._may(axis, first):
            self._set(axis + FAULT, ILLEGAL)
            return
        for bit, act in self._actions().items():
            if first & bit:
                act(axis)
        if second & PASSIVE:
            self._arm(axis)
        if self.words[axis + AUTO_ACKNOWLEDGE] & 1:  # page 4-22
            self.words[axis + COMMAND] = self.words[axis + COMMAND_2] = 0
        else:
            self._set(axis + STATUS, ACKNOWLEDGE)

    def _may(self, axis: int, command: int) -> bool:
        """Return whether a command has legal parameters: a move needs a rate (page 4-38)
        and a loop that is on (assumed).
        """
        if not command & MOVE:
            return True
        rates = (double(self.words, axis + ACCELERATION), double(self.words, axis + DECELERATION))
        return all(rates) and bool(self.words[axis + STATUS] & ENABLED)

    def _actions(self) -> dict[int, Callable[[int], None]]:
        """Bit of the first command word -> what it does with an axis."""
        return {
            MOVE: self._move,
            DEFINE: self._define,
            HOME: self._home,
            STOP: lambda axis: self._motion[axis].stop(self.words),
            CHANGE_VELOCITY: self._run,
            DEFAULTS: self._take_setups,
            LATCH: self._latch,
        }

    def _move(self, axis: int) -> None:
        """Move an axis to the position of the registers, or by it."""
        motion, target = self._motion[axis], float(double(self.words, axis + POSITION))
        motion.bind(self.words)
        if self.words[axis + MODE] & _INCREMENTAL:
            target += motion.simulated.command if motion.simulated else motion.commanded
        if not motion.limit(self.words):
            self._set(axis + FAULT, ILLEGAL)
            return
        motion.move(target, self.words)
        self._begun(axis)
        if motion.simulated is None and abs(target) > self.words[axis + MAX_ERROR]:
            self.fault(axis, POSITION_ERROR.bit_length() - 1)  # nothing follows the command

    def _define(self, axis: int) -> None:
        """Call the present position by that of 17, 18 (4-28)."""
        motion = self._motion[axis]
        if motion.bind(self.words) and motion.simulated:
            motion.simulated.define(float(double(self.words, axis + POSITION)))

    def _arm(self, axis: int) -> None:
        """Have the next feedback marker, in any motion, give the position of 17, 18; nothing moves (4-33)."""
        motion = self._motion[axis]
        if motion.bind(self.words) and motion.simulated and self.words[axis + SWITCHES] & MARKER:
            value = float(double(self.words, axis + POSITION))
            motion.simulated.define_at_marker(value, MOTION.value("marker_distance"))

    def _home(self, axis: int) -> None:
        """Home by the sequence that register 2 gives (4-29)."""
        motion = self._motion[axis]
        self.words[axis + STATUS] &= ~HOMED & 0xFFFF
        motion.bind(self.words)
        if motion.home(self.words):
            self._begun(axis)
        else:
            self._set(axis + FAULT, ILLEGAL)

    def _begun(self, axis: int) -> None:
        self.words[axis + STATUS] &= ~DONE & 0xFFFF
        self._set(axis + STATUS, BUSY)

    def _latch(self, axis: int) -> None:
        """Update the position registers, which nothing else does (page 4-38)."""
        motion = self._motion[axis]
        self._put(axis + FEEDBACK, motion.position)
        scans = max(self.words[axis + PERIOD], 1)
        self._put(axis + VELOCITY, round(motion.counts_a_scan * scans))
        # One word with a sign: a larger error stays at its end.
        self.words[axis + ERROR] = max(-0x8000, min(0x7FFF, motion.following_error)) & 0xFFFF

    def _put(self, register: int, value: int) -> None:
        self.words[register], self.words[register + 1] = value >> 16 & 0xFFFF, value & 0xFFFF

    # -- small parts ------------------------------------------------------------------

    def _set(self, register: int, bits: int) -> None:
        """Set bits of a status or fault register; those that are enabled cause an interrupt (pages 4-43 to
        4-45).
        """
        # Bits that are new alone: a fault that lasts causes one interrupt.
        new = bits & ~self.words[register]
        self.words[register] |= bits
        axis, number = register // AXIS_Y * AXIS_Y, register % AXIS_Y
        enable, source = (ENABLE_STATUS, SOURCE_STATUS) if number == STATUS else (ENABLE_FAULT, SOURCE_FAULT)
        self.words[axis + source] |= new & self.words[axis + enable]
