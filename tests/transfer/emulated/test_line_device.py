"""The clock of the machine behind a line."""

from amp_studio.transfer.emulated.line_device import STEP, DeviceService
from amp_studio.transfer.links import parse_endpoint


class NoCaller:
    """A place at which nobody calls."""

    endpoint = parse_endpoint("tcp://127.0.0.1:0")

    def accept(self, _timeout: float) -> None:
        return None

    def close(self) -> None:
        pass


class Machine:
    """A device that notes the time that passes in it."""

    def __init__(self) -> None:
        self.steps: list[float] = []

    def advance(self, duration: float) -> None:
        self.steps.append(duration)

    def connected(self) -> None: ...
    def receive(self, data: bytes) -> None: ...
    def answer(self) -> bytes:
        return b""

    def operate(self, line: str) -> str:
        return line


def test_quick_turns_step_the_machine_seldom_and_lose_no_time() -> None:
    """A terminal that echoes has a turn for each character: a step in each cost more than the motion
    itself.
    """
    now, machine = 5.0, Machine()

    def clock() -> float:
        return now

    service = DeviceService(machine, NoCaller(), say=lambda _: None, clock=clock)
    for _ in range(1000):
        now += 0.0003
        service.turn()
    assert min(machine.steps) >= STEP
    assert 0.3 - STEP < sum(machine.steps) <= 0.3 + 1e-9
    assert len(machine.steps) == 250
