"""How far a download of single values has come: what is sent, and what of it the control has confirmed."""

from __future__ import annotations

from .errors import AtControl, Confirmed


class SentValues:
    """The values of one download by their names; ``total`` is how many there are,
    0 where the control confirms none alone.

    ``when_stopped`` is what a person who stops the download now has to know beside what the control contains.
    """

    def __init__(self, total: int = 0) -> None:
        self.total = total
        self.when_stopped = ""
        self.names: list[str] = []
        """Those that the control has confirmed, in their order."""
        self.under_way: list[str] = []
        """Those of which it is not known whether the control has them."""

    def begin(self, name: str) -> None:
        """Take notice of a value that is about to be sent, maybe once more:
        until it is answered it may be there or not.
        """
        if name not in self.under_way:
            self.under_way.append(name)

    def confirm(self, name: str) -> None:
        """Take notice that the control has it."""
        self.refuse(name)
        if name not in self.names:
            self.names.append(name)

    def refuse(self, name: str) -> None:
        """Take notice that the control has answered, and not taken it."""
        if name in self.under_way:
            self.under_way.remove(name)

    @property
    def unanswered(self) -> str:
        """The first value of which it is not known whether the control has it; "" for none."""
        return self.under_way[0] if self.under_way else ""

    @property
    def has_begun(self) -> bool:
        """Whether anything was sent that the control may have taken."""
        return bool(self.under_way or self.names)

    @property
    def confirmed(self) -> Confirmed | None:
        """How far it has come, for an error; None where the control confirms no single value."""
        return Confirmed(len(self.names), self.total, self.unanswered) if self.total else None

    def answered_state(self) -> tuple[AtControl, tuple[str, ...]]:
        """Return what the control contains by its answers alone, and which values are new."""
        if self.unanswered:
            return "unknown", tuple(self.names)
        if not self.names:
            return "old", ()
        return ("mixed", tuple(self.names)) if len(self.names) < self.total else ("new", ())
