"""The screen of an emulated control, asked over its line (``emulate --screen``)."""

from __future__ import annotations

import time

from pydantic import TypeAdapter, ValidationError

from amp_studio.transfer.errors import ControlSilentError, NoConnectionError, ProtocolMismatchError
from amp_studio.transfer.links import Endpoint, Link, LinkError, connect
from amp_studio.transfer.status import ControlStatus

_ANSWER = 3.0
"""s"""
_LONGEST_ANSWER = 1 << 18
"""bytes"""
_STATUS = TypeAdapter(ControlStatus)


class ScreenReader:
    """Reads one screen; connects when it is first asked."""

    def __init__(self, place: Endpoint) -> None:
        self._place = place
        self._link: Link | None = None

    def status(self) -> ControlStatus:
        """Return what the screen shows; raises TransferError."""
        try:
            if self._link is None:
                self._link = connect(self._place)
            self._link.write(b"\n")
            return read_status(self._line(self._link))
        except LinkError as error:
            raise NoConnectionError(f"no connection to the screen of the control ({error})", "") from None

    def _line(self, link: Link) -> bytes:
        answer, end = b"", time.monotonic() + _ANSWER
        while not answer.endswith(b"\n"):
            left = end - time.monotonic()
            if left <= 0:
                raise ControlSilentError(f"the screen of the control shows nothing for {_ANSWER:g} s", "")
            answer += link.read(left)
            if len(answer) > _LONGEST_ANSWER:
                raise ProtocolMismatchError("what answers is no screen of an emulated control", "")
        return answer

    def close(self) -> None:
        """Close the line."""
        if self._link is not None:
            self._link.close()


def read_status(line: bytes) -> ControlStatus:
    """Return the status that a screen has sent; raises ProtocolMismatchError for anything else."""
    try:
        return _STATUS.validate_json(line)
    except ValidationError:
        raise ProtocolMismatchError("what answers is no screen of an emulated control", "") from None
