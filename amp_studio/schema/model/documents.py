"""What else a manual prints: tables, guides, and where it contradicts itself."""

from typing import Literal

from .record import Key, Model, Page, ParameterId


class Table(Model):
    """A printed table, in the order of the page: a head, and rows of texts and numbers below it."""

    id: str
    """As the manual numbers it (``7.B``), or a name of ours where it has no number."""
    title: str
    page: Page
    head: tuple[str, ...]
    units: tuple[str, ...] = ()
    """Unit of each column as printed, empty where it has none; left out where no column has one."""
    rows: tuple[tuple[str | float, ...], ...]
    params: tuple[ParameterId, ...] = ()
    """Parameters for whose values it is looked up."""
    note: str = ""

    def __post_init__(self) -> None:
        if self.units and len(self.units) != len(self.head):
            raise ValueError(f"{len(self.head)} columns and {len(self.units)} units")
        for n, row in enumerate(self.rows, 1):
            if len(row) != len(self.head):
                raise ValueError(f"row {n} has {len(row)} cells below {len(self.head)} columns")

    def column(self, name: str) -> tuple[str | float, ...] | None:
        """Return the cells below a name; a head may contain several of them (``B410G, B410J``)."""
        for n, head in enumerate(self.head):
            if name in head.split(", "):
                return tuple(row[n] for row in self.rows)
        return None


class Tables(Model):
    """A file of ``tables/``."""

    tables: tuple[Table, ...]


Reaction = Literal["e-stop", "stop", "alarm", "error", "refused", "warning", "notice", "symptom"]
"""What a control does beside showing a message; ``alarm`` and ``error`` where no more is printed. A symptom
is what a person sees or hears at the machine, where the control shows nothing yet.
"""


class ControlMessage(Model):
    """What a control shows on its screen: what it means, which parameters bring it about, what helps.

    ``text`` and ``code`` are the control's own words. Where the manual mentions a message and does not print
    it, there is a ``title`` of ours instead.
    """

    id: Key
    code: str = ""
    """The number before the text: ``MOT-022``, ``ALARM:1``, ``40 to 71``."""
    span: tuple[int, int] | None = None
    """First and last number of a ``code`` that counts axes:
    the number is the first plus the address of the axis."""
    also: tuple[str, ...] = ()
    """Other spellings that are printed."""
    called: tuple[str, ...] = ()
    """What people call it, in any language: it is found by these words too."""
    text: str = ""
    title: str = ""
    reaction: Reaction
    means: str = ""
    """What has happened, in our own words; empty where the title is all that is known."""
    causes: tuple[str, ...] = ()
    """How it comes about, in the order of the manual: where to look."""
    cures: tuple[str, ...] = ()
    params: tuple[ParameterId, ...] = ()
    """Parameters to look at, the nearest first."""
    rules: tuple[str, ...] = ()
    """Ids of the rules that find in a file what brings it about."""
    scenarios: tuple[str, ...] = ()
    """Scenarios of ``simulate`` that show it."""
    page: Page
    pages: tuple[Page, ...] = ()
    """Where else the manual prints it."""
    note: str = ""

    def __post_init__(self) -> None:
        if bool(self.text) == bool(self.title):
            raise ValueError("a message has either the text that is printed or a title")
        if self.span is not None and (self.span[0] > self.span[1] or not self.code):
            raise ValueError("a span goes upward, and has a code")

    @property
    def name(self) -> str:
        """Code and text, or what we call it."""
        return " ".join(filter(None, (self.code, self.text or self.title)))

    @property
    def every_page(self) -> tuple[str, ...]:
        """Each page that has it, the main one first."""
        return (self.page, *self.pages)

    def table(self) -> Table:
        """Return it as a table to look up: when it comes, causes and cures in their order."""
        # Made of facts that have been checked: checking them again would load pydantic at each start.
        rows = [("When", self.means)] if self.means else []
        for part, texts in (("Cause", self.causes), ("Cure", self.cures)):
            rows += [(f"{part} {n}" if len(texts) > 1 else part, text) for n, text in enumerate(texts, 1)]
        head = ("Part", "What")
        return Table.model_construct(
            id=self.id,
            title=self.name,
            page=self.page,
            head=head,
            rows=tuple(rows),
            params=self.params,
            note=self.note,
        )


class Messages(Model):
    """A file of ``messages/``: the messages of one part of the control, which are a table too."""

    id: Key
    title: str
    page: Page
    params: tuple[ParameterId, ...] = ()
    """Parameters for whose values the list as a whole is looked up."""
    note: str = ""
    messages: tuple[ControlMessage, ...]

    def tables(self) -> tuple[Table, ...]:
        """Return the list, and behind it each message that has a code, causes and cures."""
        rows = tuple((m.code, m.text or m.title, m.means, ", ".join(m.every_page)) for m in self.messages)
        head = ("Code", "Message", "What it means", "Page")
        listed = Table.model_construct(
            id=self.id,
            title=self.title,
            page=self.page,
            head=head,
            rows=rows,
            params=self.params,
            note=self.note,
        )
        return listed, *(m.table() for m in self.messages if m.code and m.causes and m.cures)


class SimulatedStep(Model):
    """What the simulated axis shows at a step of tuning."""

    scenario: str
    figures: tuple[str, ...]
    """Figures of its result."""
    settings: dict[str, float | str] = {}
    """``move.…`` of the run."""


class GuideStep(Model):
    """One step of a guide: what to set, in this order."""

    title: str
    what: str = ""
    look: str = ""
    """What to look for when it is done."""
    shows: SimulatedStep | None = None
    params: tuple[ParameterId, ...]
    page: Page


class Guide(Model):
    """A path through the parameters in the order in which a machine is fitted."""

    id: Key
    title: str
    page: Page
    steps: tuple[GuideStep, ...]


class Guides(Model):
    """A file of ``guides/``."""

    guides: tuple[Guide, ...]


class Statement(Model):
    """One place of the manual."""

    page: str
    says: str


class Erratum(Model):
    """Where the manual contradicts itself, and what was decided."""

    id: Key
    params: tuple[ParameterId, ...]
    readings: tuple[Statement, ...]
    taken: str
    why: str


class Errata(Model):
    """A file of ``errata/``."""

    errata: tuple[Erratum, ...]
