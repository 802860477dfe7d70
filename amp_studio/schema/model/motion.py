"""How an axis of a family moves in the simulator, as far as it is facts: which parameters its law reads,
which scenarios there are, which figures are assumed. The law itself is code of the family.
"""

from typing import Annotated, Literal

from .record import Model, NotEmpty, Page, ParameterId, Pattern

Role = Annotated[str, Pattern(r"^[a-z][a-z0-9_]*$")]

ScenarioName = Literal[
    "step",
    "velocity",
    "frequency",
    "tune",
    "load",
    "sweep",
    "circle",
    "home",
    "jog",
    "travel",
    "spindle",
    "tap",
    "probe",
    "fault",
    "handwheel",
]


class AssumedFigure(Model):
    """A figure that no parameter gives: what it is assumed to be, and why."""

    value: float
    unit: str = ""
    """As in the sentences of a result: 1/s, mm, V; "" for a ratio or a count."""
    why: Annotated[str, NotEmpty()]
    """Where it comes from, a sentence."""
    page: Page | None = None
    """Where the manual has the evidence; none where nothing is printed."""


class MotionFacts(Model):
    """A file ``motion.yaml``: what the law of a family takes from its facts."""

    without_axes: str = "No axis is fitted. Set the type of an axis first"
    """What to do about a file that has no axis to simulate, a sentence."""
    scenarios: tuple[ScenarioName, ...]
    """Those that the manual of the family carries, in the order in which they are listed."""
    axes: tuple[str, ...] = ()
    """The axes as the control names and orders them, where the law needs it."""
    params: dict[Role, ParameterId] = {}
    """What a parameter is to the law -> the parameter."""
    settings: dict[str, str] = {}
    """Figures of the machine that are no parameters, ``model.*`` -> what they are."""
    assumed: dict[Role, AssumedFigure] = {}

    def __post_init__(self) -> None:
        for name in self.settings:
            if not name.startswith("model."):
                raise ValueError(f"the setting {name} does not begin with 'model.'")

    def value(self, name: str) -> float:
        """Return an assumed figure."""
        return self.assumed[name].value

    def reasons(self, *names: str, **of: str) -> dict[str, str]:
        """Return figure of the machine -> why it has its value: that of the assumed figure of the same name,
        or of the one that is named for it.
        """
        return {
            figure: self.assumed[name].why
            for figure, name in {**dict(zip(names, names, strict=True)), **of}.items()
        }


NO_MOTION = MotionFacts.model_construct(scenarios=())
"""Of a family whose axes are not simulated."""
