"""The facts of a family in another language: what decides, each text under the id that its fact has.

A file of ``parameter_db/<family>/<language>/`` has any of these sections; what is not in it stays English.
"""

from .record import Key, Model, ParameterId


class RuleTexts(Model):
    """A rule in another language."""

    title: str
    message: str
    """With the same names in braces as the English one."""
    reason: str = ""


class HelpTexts(Model):
    """What a parameter warns of in another language, in the order of its facts.

    A sentence that several parameters have is written at the first of them.
    """

    danger: tuple[str, ...] = ()
    warning: tuple[str, ...] = ()
    note: tuple[str, ...] = ()


class StepTexts(Model):
    """A step of commissioning or of a guide."""

    title: str
    what: str = ""
    look: str = ""


class OrderTexts(Model):
    """The order of commissioning: where it comes from, and its last step."""

    why: str
    rest: StepTexts


class GuideTexts(Model):
    """A guide, with its steps in their order."""

    title: str
    steps: tuple[StepTexts, ...]


class MotionTexts(Model):
    """What the simulator assumes of a family."""

    without_axes: str = ""
    assumed: dict[str, str] = {}
    settings: dict[str, str] = {}


class MessageTexts(Model):
    """A message of a control: what we call it and write about it; its printed text stays."""

    title: str = ""
    means: str = ""
    causes: tuple[str, ...] = ()
    cures: tuple[str, ...] = ()
    note: str = ""


class MessageListTexts(Model):
    """A list of messages."""

    title: str
    note: str = ""


class FactTranslation(Model):
    """One file of a language."""

    rules: dict[str, RuleTexts] = {}
    help: dict[ParameterId, HelpTexts] = {}
    conditions: dict[str, str] = {}
    """Why a parameter is inactive."""
    steps: dict[Key, StepTexts] = {}
    order: OrderTexts | None = None
    guides: dict[Key, GuideTexts] = {}
    motion: MotionTexts | None = None
    messages: dict[Key, MessageTexts] = {}
    message_lists: dict[Key, MessageListTexts] = {}
    formulas: dict[Key, str] = {}
    """Name of a published formula, or of what formulas ask for -> its title."""
    phrases: dict[str, str] = {}
    """Texts that have no id: what a rule puts into its message, the meaning of a code of a program, a
    sentence of a law with ``{names}`` for its figures. English -> own."""


class FactTexts(Model):
    """The texts of a family in a language, ready to be looked up."""

    sentences: dict[str, str] = {}
    """English -> own."""
    patterns: dict[str, str] = {}
    """The same of sentences with ``{names}`` for figures."""
    messages: dict[str, str] = {}
    """Rule -> its message, with its names in braces."""
    formulas: dict[str, str] = {}
    """Name of a formula, or of what formulas ask for -> its title."""
