"""In which order a machine of a family is commissioned: steps, and the parameters of each."""

from typing import Literal

from .record import Key, Model, Page, ParameterId


class CommissioningStep(Model):
    """One step: what is set in it, and what it is about."""

    id: Key
    """Files name it where a person has ticked it: it never changes once it is published."""
    title: str
    what: str = ""
    """In our own words; empty where the title is enough."""
    params: tuple[ParameterId, ...] = ()
    """Parameters of this step in this order. They are of no other, whatever their groups are in."""
    groups: tuple[Key, ...] = ()
    """Groups of whose parameters those follow that no step names."""
    again: tuple[ParameterId, ...] = ()
    """Parameters of earlier steps at which this one looks again."""
    page: Page


class Remainder(Model):
    """The last step: what is in no other."""

    title: str
    what: str
    """Why it is in no other."""
    page: Page


class Commissioning(Model):
    """``commissioning.yaml``: each parameter of the family is in one step, or in the remainder."""

    order: Literal["manual", "ours"]
    """Whose order it is."""
    why: str
    """Where the order comes from."""
    page: Page
    steps: tuple[CommissioningStep, ...]
    rest: Remainder
    of_one_machine: tuple[ParameterId, ...] = ()
    """Values that are found on one machine and true of that one alone:
    a file that is made like it does not get them."""
