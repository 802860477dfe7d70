"""The client's side of an exchange: it survives cut lines and ends by reporting what the control contains."""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import platformdirs

from amp_studio.transfer.errors import ControlSilentError, NoConnectionError, TransferError
from amp_studio.transfer.exchange import QUIET, Exchange, Replacement
from amp_studio.transfer.links import Endpoint, LinkError, connect, parse_endpoint
from amp_studio.transfer.waiting import OpenLink

from .broken_transfers import BrokenTransfers, NoBrokenTransfers
from .connection import Connection, OutOfTimeError
from .download_transfer import DownloadTransfer, Sent
from .message import RefusalError, Welcome, shorten
from .refusals import error_of
from .retry_timer import RetryPolicy
from .transaction import NoAnswerError
from .upload_transfer import UploadTransfer

_T = TypeVar("_T")

_CLIENT = "AMP Studio (ODS)"
"""A length of name with which no length in the frame of a Hello is one of `connection.ACTS_ON_GRBL`."""
RESTART_PAUSE = 0.02  # seconds between two calls to a control that restarts


class Session:
    """An exchange with one control.

    ``open_link`` makes the line, and makes it again when it is cut, for up to ``patience`` seconds without
    progress; while it waits, it calls the function it is given at least every 0.1 s. ``family`` is the family
    the control must be of ("" for any). ``clock`` and ``sleep`` are in seconds. A session belongs to one
    thread; only a cancel event may be set from another. A ``progress`` is called within 2 s when nothing is
    answered.
    """

    def __init__(
        self,
        open_link: OpenLink,
        *,
        family: str = "",
        patience: float = 20.0,
        policy: RetryPolicy | None = None,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
        random_bytes: Callable[[int], bytes] = os.urandom,
        client: str = _CLIENT,
        broken: BrokenTransfers | None = None,
    ) -> None:
        self._broken = broken or NoBrokenTransfers()
        self.sampled: tuple[int, int] | None = None
        self._line = Connection(
            open_link,
            family=family,
            client=shorten(client),
            patience=patience,
            policy=policy or RetryPolicy(),
            clock=clock,
            sleep=sleep,
            random_bytes=random_bytes,
        )

    @classmethod
    def at(cls, address: Endpoint | str, *, family: str = "", patience: float = 20.0) -> Session:
        """Return a session with the control at an address; raises ValueError when it is none."""
        place = parse_endpoint(address) if isinstance(address, str) else address
        place.need_all_bytes("the house protocol")
        broken = BrokenTransfers(Path(platformdirs.user_state_dir("amp-studio")) / "transfers")
        return cls(lambda look: connect(place, look=look), family=family, patience=patience, broken=broken)

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the line."""
        self._line.close()

    # -- asking ------------------------------------------------------------------------------------

    def hello(self, exchange: Exchange = QUIET) -> Welcome:
        """Return who the control is and what it contains; connects where there is no line yet.

        Raises NoConnectionError, ControlSilentError, ControlBusyError, WrongFamilyError,
        ProtocolMismatchError, CancelledError.
        """
        self._line.cancel, self._line.progress = exchange.cancel, exchange.progress
        self._line.begin()
        try:
            return self._line.greet()
        except LinkError as error:
            failure: TransferError = NoConnectionError(f"no connection to the control ({error})")
            failure.__cause__ = error  # whether it is the password is asked by who has a field for one
        except NoAnswerError:
            failure = ControlSilentError("the control does not answer")
        except RefusalError as refusal:
            failure = error_of(refusal)
        self.close()
        raise failure

    def wait_restarted(self, boot_count: int, seconds: float, exchange: Exchange = QUIET) -> Welcome | None:
        """Call the control until it answers with another incarnation; None when it has not after ``seconds``.

        Raises CancelledError and an error where another control answers.
        """
        line = self._line
        start = line.now()

        def waiting(*_: object) -> None:  # the control's silence is what is waited out here
            exchange.progress("restart", int((line.now() - start) * 10), max(1, int(seconds * 10)))

        line.cancel, line.progress = exchange.cancel, waiting
        self.close()
        line.begin(seconds)
        while line.now() - start < seconds:
            line.notify("restart", 0, 1)
            try:
                welcome = line.greet(tries=1)
            except (LinkError, NoAnswerError, RefusalError):
                self.close()
            else:
                if welcome.incarnation != boot_count:
                    line.further()
                    line.progress = exchange.progress
                    line.notify("restart", 1, 1)
                    return welcome
            with contextlib.suppress(OutOfTimeError):
                line.pause(RESTART_PAUSE)
        return None

    # -- images ------------------------------------------------------------------------------------

    def fetch(self, exchange: Exchange = QUIET, stage: str = "upload", sent: bytes | None = None) -> bytes:
        """Return the control's active image, checked against its digest; raises TransferError.

        ``sent`` is what was committed before: on a slow line only some of it is read, and ``sampled`` is how
        many pieces of how many; None after every other upload.
        """
        self._line.cancel, self._line.progress = exchange.cancel, exchange.progress
        upload = UploadTransfer(self._line, stage, sent)
        image = upload.run()
        self.sampled = upload.sampled
        return image

    def send(self, replacement: Replacement, exchange: Exchange = QUIET) -> Sent:
        """Have the control replace one image by another, all or nothing.

        Can be stopped until the commit is asked for; from then on it sees the matter through, for
        up to 5 s more (not at all where the event is a Stop that was set twice). Raises TransferError, whose
        ``at_control`` is what the control contains.
        """
        self._line.progress = exchange.progress
        return DownloadTransfer(self._line, replacement, self._broken).run(exchange.cancel)
