"""A line without a cable between a driver and an emulated device, in a simulated time."""

import contextlib
import threading
from collections.abc import Iterator

from amp_studio.transfer.emulated.line_device import DeviceService, LineDevice
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.link import LinkError
from amp_studio.transfer.links.opening import listen

from .null_modem import VirtualClock


class DeviceLine:
    """One line; time passes while the client waits. ``bytes_per_second`` is what it states and carries."""

    def __init__(
        self, device: LineDevice, clock: VirtualClock, bytes_per_second: float | None = None
    ) -> None:
        self.device = device
        self.clock = clock
        self.bytes_per_second = bytes_per_second
        self.sent = bytearray()
        """All that the client has sent."""
        self._is_open = True

    def read(self, timeout: float) -> bytes:
        if not self._is_open:
            raise LinkError("device line", "the line is closed")
        answer = self.device.answer()
        self.clock.sleep(len(answer) / (self.bytes_per_second or 1e6) if answer else timeout)
        return answer

    def write(self, data: bytes) -> None:
        if not self._is_open:
            raise LinkError("device line", "the line is closed")
        self.sent += data
        self.clock.sleep(len(data) / (self.bytes_per_second or 1e6))
        self.device.receive(data)

    def close(self) -> None:
        self._is_open = False


@contextlib.contextmanager
def served(device: LineDevice, place: str) -> Iterator[tuple[str, DeviceService]]:
    """Serve a device at a real place; yields its address and the service, whose ``command`` presses keys."""
    listener, stop = listen(parse_endpoint(place)), threading.Event()
    service = DeviceService(device, listener, say=lambda _: None, stop=stop)
    thread = threading.Thread(target=service.run)
    thread.start()
    try:
        yield str(listener.endpoint), service
    finally:
        stop.set()
        thread.join()
        listener.close()
