"""What else a manual prints: tables, guides, and where it contradicts itself."""

from typing import Self

from pydantic import model_validator

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

    @model_validator(mode="after")
    def _square(self) -> Self:
        if self.units and len(self.units) != len(self.head):
            raise ValueError(f"{len(self.head)} columns and {len(self.units)} units")
        for n, row in enumerate(self.rows, 1):
            if len(row) != len(self.head):
                raise ValueError(f"row {n} has {len(row)} cells below {len(self.head)} columns")
        return self

    def column(self, name: str) -> tuple[str | float, ...] | None:
        """Return the cells below a name; a head may contain several of them (``B410G, B410J``)."""
        for n, head in enumerate(self.head):
            if name in head.split(", "):
                return tuple(row[n] for row in self.rows)
        return None


class Tables(Model):
    """A file of ``tables/``."""

    tables: tuple[Table, ...]


class GuideStep(Model):
    """One step of a guide: what to set, in this order."""

    title: str
    what: str = ""
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
