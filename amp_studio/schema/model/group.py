"""What a group is: a file of parameters, and the states that they share."""

from .parameter import Parameter, StateRule
from .record import Key, Model, ParameterId, Scope


class GroupState(StateRule):
    """A state of all parameters of a group, or of those of one scope."""

    scope: Scope | None = None
    """Only parameters of this scope; left out: all parameters of the file."""
    not_for: tuple[ParameterId, ...] = ()
    """Parameters that do not get it."""


class Group(Model):
    """One file of ``groups/``: the parameters of a group in the manual's order."""

    key: Key
    name: str
    """As the manual heads it; the parts of a long group, each in a file, have the same."""
    section: str = ""
    """The part of a long group that is in this file (``Position Loop Parameters``)."""
    chapter: str
    states: tuple[GroupState, ...] = ()
    """Each parameter gets them in front of those it has itself. Compiled,
    the parameters have them and there are none here."""
    last_states: tuple[GroupState, ...] = ()
    """Each parameter gets them behind its own."""
    parameters: tuple[Parameter, ...]

    @property
    def whole_name(self) -> str:
        """Name and part: ``Servo Parameters: Position Loop Parameters``."""
        return f"{self.name}: {self.section}" if self.section else self.name

    @property
    def own_name(self) -> str:
        """What distinguishes it: its part, or its name where it is one file."""
        return self.section or self.name

    def __post_init__(self) -> None:
        """Give each parameter the states of the group."""
        if self.states or self.last_states:
            # Past the frozen attributes, as the record is not in use yet.
            self.__dict__["parameters"] = tuple(map(self._with_states, self.parameters))

    def _with_states(self, parameter: Parameter) -> Parameter:
        first, last = _states_for(parameter, self.states), _states_for(parameter, self.last_states)
        return parameter.model_copy(update={"states": (*first, *parameter.states, *last)})

    def own_states(self, parameter: Parameter) -> range:
        """Return which of the states of a parameter of this group are at the parameter itself."""
        behind = len(parameter.states) - len(_states_for(parameter, self.last_states))
        return range(len(_states_for(parameter, self.states)), behind)


def _states_for(parameter: Parameter, states: tuple[GroupState, ...]) -> tuple[StateRule, ...]:
    """Return those states of a group that a parameter gets."""
    return tuple(
        StateRule(state=s.state, when=s.when, unless=s.unless, page=s.page)
        for s in states
        if s.scope in (None, *parameter.scopes) and parameter.id not in s.not_for
    )
