"""A line without a cable: a client and an emulated control in one thread, in a simulated time.

Nothing sleeps and nothing is random: time passes only while the client waits,
so that an exchange over a slow or a broken line takes a few milliseconds and
comes out the same each time.
"""

from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.responder import CHUNK, WINDOW, Responder
from amp_studio.transfer.links.link import Link, LinkError


class VirtualClock:
    """Time in seconds that passes on demand."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        """Let time pass."""
        self.now += max(0.0, seconds)


class NullModem:
    """Lines to one control, one at a time.

    ``bytes_per_second`` is what each way carries (None: any amount at once) and ``latency`` the seconds a
    byte is on the way. After a commit or a Restart the control is gone for ``restart_seconds``.
    """

    def __init__(
        self,
        control: Control,
        clock: VirtualClock,
        *,
        bytes_per_second: float | None = None,
        latency: float = 0.0,
        restart_seconds: float = 0.5,
        window: int = WINDOW,
        chunk: int = CHUNK,
    ) -> None:
        self.control = control
        self.window = window
        self.chunk = chunk
        self.clock = clock
        self.bytes_per_second = bytes_per_second
        self.latency = latency
        self.lines = 0
        self._restart_seconds = restart_seconds
        self._back_at: float | None = None

    def connect(self) -> Link:
        """Return a new line; raises LinkError while the control restarts."""
        if not self.is_up():
            raise LinkError("null modem", "the control restarts")
        self.lines += 1
        return NullLink(self)

    def is_up(self) -> bool:
        """Whether the control answers; brings it back when its time has come."""
        if self._back_at is not None:
            if self.clock.now < self._back_at:
                return False
            self._back_at = None
            self.control.restart()
        return True

    def restart(self) -> None:
        """Have the control go away."""
        self._back_at = self.clock.now + self._restart_seconds


class NullLink:
    """The client's end of one line. What is on the way arrives in order, each piece with its last byte.

    A control that hangs up has sent its answer before; the line is cut when that has arrived.
    """

    def __init__(self, modem: NullModem) -> None:
        self._modem = modem
        self._responder = Responder(modem.control, window=modem.window, chunk=modem.chunk)
        self._to_control: list[tuple[float, bytes]] = []
        self._to_client: list[tuple[float, bytes]] = []
        self._is_open = True

    @property
    def bytes_per_second(self) -> float | None:
        return self._modem.bytes_per_second

    def write(self, data: bytes) -> None:
        self._check()
        if data:
            self._put(self._to_control, data, self._modem.clock.now)

    def read(self, timeout: float) -> bytes:
        """Return what arrives first; time passes until then, or by ``timeout`` seconds."""
        clock = self._modem.clock
        end = clock.now + timeout
        while True:
            if self._to_control and self._to_control[0][0] <= min(
                [end, *(at for at, _ in self._to_client[:1])]
            ):
                at, data = self._to_control.pop(0)
                self._answer(max(at, clock.now), data)
            elif self._to_client and self._to_client[0][0] <= end:
                at, data = self._to_client.pop(0)
                clock.now = max(at, clock.now)
                return data
            else:
                if not self._to_client:
                    self._check()
                clock.now = end
                return b""

    def close(self) -> None:
        self._is_open = False

    def _answer(self, at: float, data: bytes) -> None:
        answers = self._responder.receive(data)
        if answers:
            self._put(self._to_client, answers, at)
        if self._responder.restart_due and self._is_open:
            self._is_open = False
            self._modem.restart()

    def _put(self, queue: list[tuple[float, bytes]], data: bytes, now: float) -> None:
        modem = self._modem
        rate = modem.bytes_per_second
        free = queue[-1][0] - modem.latency if queue else now
        queue.append((max(now, free) + (len(data) / rate if rate else 0.0) + modem.latency, data))

    def _check(self) -> None:
        if not self._is_open:
            raise LinkError("null modem", "the line is cut")
