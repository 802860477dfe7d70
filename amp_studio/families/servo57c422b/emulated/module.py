"""An emulated 57C422B: 4096 registers, the commands in 66 and 67 with their handshake, and the faults of register 73.

Written from chapter 4 of the instruction manual. Our copy has lost the figures with the bit numbers: bits that no text and
no program of the manual names are ASSUMED below. Motion is not emulated (``amp-studio simulate`` has it): a move ends at once.
"""

from __future__ import annotations

from collections.abc import Callable

REGISTERS, AXIS_Y = 4096, 2048
AXES = {"X": 0, "Y": AXIS_Y}
ACCELERATION, DECELERATION, POSITION = 21, 23, 17
AUTO_ACKNOWLEDGE, INTERRUPT_RESET, MODE, COMMAND, COMMAND_2 = 63, 64, 65, 66, 67
ENABLE_STATUS, ENABLE_FAULT, STATUS, FAULT, SOURCE_STATUS, SOURCE_FAULT = 68, 69, 72, 73, 104, 105
FEEDBACK, VERSION = 74, 99

LOOP = 1 << 0  # enable control loop (page 4-24)
INCREMENTAL = 1 << 5  # page 4-24
MOVE, HOME, STOP, DEFAULTS, LATCH = 1 << 0, 1 << 2, 1 << 6, 1 << 9, 1 << 11  # pages 4-28 to 4-32
DONE, ACKNOWLEDGE = 1 << 0, 1 << 15  # pages 4-43 and 4-36
BUSY, HOMED, ENABLED = 1 << 2, 1 << 5, 1 << 7  # ASSUMED
POSITION_ERROR, VELOCITY_ERROR = 1 << 4, 1 << 5  # page 4-43
FEEDBACK_FAULT, ILLEGAL, SYSTEM = 1 << 6, 1 << 8, 1 << 9  # ASSUMED
READ_ONLY = frozenset((*range(70, 83), *range(84, 88), *range(99, 104)))
"""Written by the module; the manual calls 72 to 82, 84 to 87 and 99 to 103 its own. What a write to them does is not printed: here nothing."""
NAME = "57C422B module in an emulated rack"


class Module:
    """One module. ``read`` and ``write`` are what an application task does over the backplane of the rack."""

    def __init__(self) -> None:
        self.words = [0] * REGISTERS
        """What is in the registers at power-on is not printed: here 0."""
        self._positions: dict[int, int] = {}
        self.setups: dict[str, tuple[int, ...]] = {}
        """Axis -> the setup registers that the module works with, once a command has it take them over."""
        self.power_on()

    def power_on(self) -> None:
        """Begin as after a cold start of the processor, which sets the system fault (page 4-38)."""
        self.words[:] = [0] * REGISTERS
        self.setups.clear()
        self._positions.clear()
        for axis in AXES.values():
            for n, pair in enumerate(("EM", "UL", "AT", "ED", " 1")):
                self.words[axis + VERSION + n] = int.from_bytes(pair.encode("ascii"), "big")
            self.words[axis + STATUS] = DONE
            self.words[axis + FAULT] = FEEDBACK_FAULT
        self.stop_all()

    def stop_all(self) -> None:
        """Obey STOP ALL / CLEAR from the programming terminal: feedback and drive reference off, system fault (page 4-38)."""
        for axis in AXES.values():
            self.words[axis + MODE] &= ~LOOP & 0xFFFF
            self._follow_mode(axis, 0)
            self._set(axis + FAULT, SYSTEM)

    def fault(self, axis: int, bit: int) -> None:
        """Have a severe fault: the control loop is disabled (page 4-35)."""
        self._set(axis + FAULT, 1 << bit)
        self.words[axis + STATUS] &= ~ENABLED & 0xFFFF
        self._set(axis + FAULT, FEEDBACK_FAULT)

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
            self._obey(axis)

    # -- what the module does ---------------------------------------------------------

    def _follow_mode(self, axis: int, before: int) -> None:
        """Switch the control loop; toggled on, it reads the setups and resets faults (page 4-24)."""
        is_on, was_on = bool(self.words[axis + MODE] & LOOP), bool(before & LOOP)
        if is_on and not was_on:
            self._take_setups(axis)
            self.words[axis + FAULT] = 0
            self._set(axis + STATUS, ENABLED)
        elif not is_on:
            self.words[axis + STATUS] &= ~ENABLED & 0xFFFF
            self._set(axis + FAULT, FEEDBACK_FAULT)

    def _take_setups(self, axis: int) -> None:
        name = next(each for each, base in AXES.items() if base == axis)
        self.setups[name] = tuple(self.words[axis : axis + COMMAND - 3])

    def _obey(self, axis: int) -> None:
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
        if self.words[axis + AUTO_ACKNOWLEDGE] & 1:  # page 4-22
            self.words[axis + COMMAND] = self.words[axis + COMMAND_2] = 0
        else:
            self._set(axis + STATUS, ACKNOWLEDGE)

    def _may(self, axis: int, command: int) -> bool:
        """Return whether a command has legal parameters: a move needs a rate (page 4-38) and a loop that is on (assumed)."""
        if not command & MOVE:
            return True
        rates = (self._double(axis + ACCELERATION), self._double(axis + DECELERATION))
        return all(rates) and bool(self.words[axis + STATUS] & ENABLED)

    def _actions(self) -> dict[int, Callable[[int], None]]:
        return {MOVE: self._move, HOME: self._home, DEFAULTS: self._take_setups, LATCH: self._latch}

    def _move(self, axis: int) -> None:
        target = self._double(axis + POSITION)
        if self.words[axis + MODE] & INCREMENTAL:
            target += self._positions.get(axis, 0)
        self._positions[axis] = target & 0xFFFFFFFF
        self._set(axis + STATUS, DONE)

    def _home(self, axis: int) -> None:
        """Home by the first way, which moves nothing: the position becomes that of 17, 18 (page 4-29)."""
        self._positions[axis] = self._double(axis + POSITION)
        self._set(axis + STATUS, HOMED)

    def _latch(self, axis: int) -> None:
        """Update the position registers, which nothing else does (page 4-38)."""
        position = self._positions.get(axis, 0)
        self.words[axis + FEEDBACK], self.words[axis + FEEDBACK + 1] = position >> 16, position & 0xFFFF

    # -- small parts ------------------------------------------------------------------

    def _double(self, register: int) -> int:
        return self.words[register] << 16 | self.words[register + 1]

    def _set(self, register: int, bits: int) -> None:
        """Set bits of a status or fault register; those that are enabled cause an interrupt (pages 4-43 to 4-45)."""
        new = bits & ~self.words[register]
        self.words[register] |= bits
        axis, number = register // AXIS_Y * AXIS_Y, register % AXIS_Y
        enable, source = (ENABLE_STATUS, SOURCE_STATUS) if number == STATUS else (ENABLE_FAULT, SOURCE_FAULT)
        self.words[axis + source] |= new & self.words[axis + enable]
