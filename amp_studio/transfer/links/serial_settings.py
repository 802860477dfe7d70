"""How a serial line is set: rate, data bits, parity, stop bits and flow control."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

Parity = Literal["none", "even", "odd", "mark", "space"]
Flow = Literal["none", "xonxoff", "rtscts"]

PARITIES: tuple[Parity, ...] = get_args(Parity)
FLOWS: tuple[Flow, ...] = get_args(Flow)
DATA_BITS = (7, 8)
STOP_BITS = (1, 2)


@dataclass(frozen=True)
class SerialSettings:
    """The settings of a line at both of its ends; ``baud`` is in bit/s."""

    baud: int = 115_200
    bits: int = 8
    parity: Parity = "none"
    stop: int = 1
    flow: Flow = "none"

    @property
    def bytes_per_second(self) -> float:
        """What the line carries each way: a start bit, the data bits,
        the parity bit and the stop bits make a byte.
        """
        return self.baud / (1 + self.bits + (self.parity != "none") + self.stop)
