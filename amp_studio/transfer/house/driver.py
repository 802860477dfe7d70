"""The house protocol as one of the ways to speak to a control."""

from __future__ import annotations

import threading

from amp_studio.transfer.content import HouseContent
from amp_studio.transfer.driver import Abilities, ControlIdentity, Receipt
from amp_studio.transfer.links.endpoint import Endpoint
from amp_studio.transfer.progress import Progress, quiet

from .message import Flags
from .session import Session


class HouseDriver(HouseContent):
    """Speaks to a control in the sessions of the house protocol (docs/protocols/exchange.md)."""

    abilities = Abilities(can_send=True, remembers=True, lasting_states=("E-stop",))

    def __init__(self, session: Session) -> None:
        self.session = session
        self._sent: bytes | None = None

    @classmethod
    def at(cls, endpoint: Endpoint, family: str = "") -> HouseDriver:
        """Return the driver of an endpoint; ``family`` is the one the control must be of, "" for any."""
        return cls(Session.at(endpoint, family=family))

    def identify(self, progress: Progress = quiet, cancel: threading.Event | None = None) -> ControlIdentity:
        """Return what the control answers about itself."""
        welcome = self.session.hello(cancel, progress)
        return ControlIdentity(
            family=welcome.family,
            protocol="house",
            name=welcome.name,
            revision=welcome.revision,
            signature=welcome.signature,
            size=welcome.size,
            sha256=welcome.sha256,
            in_estop=bool(welcome.flags & Flags.ESTOP),
            restart_needed=bool(welcome.flags & Flags.RESTART_NEEDED),
        )

    def fetch(
        self, progress: Progress = quiet, cancel: threading.Event | None = None, stage: str = "upload"
    ) -> bytes:
        """Return the control's active image; on a slow line only some of what was sent is read back."""
        sent = self._sent if stage == "verify" else None
        return self.session.fetch(progress, cancel, stage, sent)

    @property
    def read_back(self) -> str:
        """How the last upload was proven, where not every byte was read; "" where it was."""
        if self.session.sampled is None:
            return ""
        some, all_of_them = self.session.sampled
        return (
            f"the control states the digest of the new image for what it contains, and {some} of {all_of_them} pieces, "
            "chosen at random, were read back equal (amp-studio verify reads everything)"
        )

    def send(
        self,
        content: bytes,
        *,
        signature: str,
        expected: bytes,
        held: bytes,  # noqa: ARG002 -- it is replaced as a whole
        progress: Progress = quiet,
        cancel: threading.Event | None = None,
    ) -> Receipt:
        """Stage and commit an image, all or nothing."""
        sent = self.session.send(
            content, signature=signature, expected=expected, progress=progress, cancel=cancel
        )
        self._sent = content
        notes = (f"It was taken up again at byte {sent.resumed_at}.",) if sent.resumed_at else ()
        return Receipt(sent.committed.restarting, sent.committed.incarnation, notes=notes)

    def wait_restarted(
        self,
        receipt: Receipt,
        seconds: float,
        progress: Progress = quiet,
        cancel: threading.Event | None = None,
    ) -> bool:
        """Call the control until it answers with another incarnation."""
        return self.session.wait_restarted(receipt.incarnation, seconds, progress, cancel) is not None

    def close(self) -> None:
        """Hang up."""
        self.session.close()
