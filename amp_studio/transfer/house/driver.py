"""The house protocol as one of the ways to speak to a control."""

from __future__ import annotations

from amp_studio.transfer.content import HouseContent
from amp_studio.transfer.driver import Abilities, ControlIdentity, Receipt
from amp_studio.transfer.exchange import QUIET, Exchange, Replacement
from amp_studio.transfer.links import Endpoint

from .message import Flags
from .session import Session


class HouseDriver(HouseContent):
    """Speaks to a control in the sessions of the house protocol (docs/protocols/exchange.md)."""

    abilities = Abilities(remembers=True, lasting_states=("E-stop",))

    def __init__(self, session: Session) -> None:
        self.session = session
        self._sent: bytes | None = None

    @classmethod
    def at(cls, endpoint: Endpoint, family: str = "") -> HouseDriver:
        """Return the driver of an endpoint; ``family`` is the one the control must be of, "" for any."""
        return cls(Session.at(endpoint, family=family))

    def identify(self, exchange: Exchange = QUIET) -> ControlIdentity:
        """Return what the control answers about itself."""
        welcome = self.session.hello(exchange)
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

    def fetch(self, exchange: Exchange = QUIET, stage: str = "upload") -> bytes:
        """Return the control's active image; on a slow line only some of what was sent is read back."""
        sent = self._sent if stage == "verify" else None
        return self.session.fetch(exchange, stage, sent)

    @property
    def read_back(self) -> str:
        """How the last upload was proven, where not every byte was read; "" where it was."""
        if self.session.sampled is None:
            return ""
        some, all_of_them = self.session.sampled
        return (
            f"the control states the digest of the new image for what it contains, and {some} of"
            f" {all_of_them} pieces, chosen at random, were read back equal (a verification reads everything)"
        )

    def send(self, replacement: Replacement, exchange: Exchange = QUIET) -> Receipt:
        """Stage and commit an image, all or nothing."""
        sent = self.session.send(replacement, exchange)
        self._sent = replacement.content
        notes = (f"It was taken up again at byte {sent.resumed_at}.",) if sent.resumed_at else ()
        return Receipt(sent.committed.restarting, sent.committed.incarnation, notes=notes)

    def wait_restarted(self, receipt: Receipt, seconds: float, exchange: Exchange = QUIET) -> bool:
        """Call the control until it answers with another incarnation."""
        return self.session.wait_restarted(receipt.boot_count, seconds, exchange) is not None

    def close(self) -> None:
        """Close the line."""
        self.session.close()
