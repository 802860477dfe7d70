"""AMP Studio: the workbench for the numbered parameters that fit a control to a machine.

As a library: ``amp.open`` and ``amp.new`` return a MachineParameters, ``amp.connect`` a ConnectedControl; every error on purpose is an AmpStudioError.
What is named in ``__all__`` is public and stays; the rooms below (``amp_studio.files``, ``amp_studio.sim``, …) may change without notice.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .errors import AmpStudioError
from .version import __version__

if TYPE_CHECKING:
    from .control import ConnectedControl, connect
    from .files import Change, RangeError
    from .machine import AssignmentError, MachineError, MachineParameters, ParameterEntry, import_text
    from .machine import new_machine as new
    from .machine import open_machine as open  # noqa: A004  # amp.open, as gzip.open
    from .schema import UnknownParameterError, Value, family_ids, load_schema
    from .validate import Finding

_PLACES = {
    "AssignmentError": ("machine", "AssignmentError"),
    "Change": ("files", "Change"),
    "ConnectedControl": ("control", "ConnectedControl"),
    "ParameterEntry": ("machine", "ParameterEntry"),
    "Finding": ("validate", "Finding"),
    "MachineParameters": ("machine", "MachineParameters"),
    "MachineError": ("machine", "MachineError"),
    "RangeError": ("files", "RangeError"),
    "UnknownParameterError": ("schema", "UnknownParameterError"),
    "Value": ("schema", "Value"),
    "connect": ("control", "connect"),
    "family_ids": ("schema", "family_ids"),
    "import_text": ("machine", "import_text"),
    "load_schema": ("schema", "load_schema"),
    "new": ("machine", "new_machine"),
    "open": ("machine", "open_machine"),
}
"""Public name -> its module and its name there; loaded when it is first asked for."""


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    module, own = _PLACES[name]
    found = globals()[name] = getattr(import_module(f".{module}", __name__), own)
    return found


__all__ = [
    "AmpStudioError",
    "AssignmentError",
    "Change",
    "ConnectedControl",
    "Finding",
    "MachineError",
    "MachineParameters",
    "ParameterEntry",
    "RangeError",
    "UnknownParameterError",
    "Value",
    "__version__",
    "connect",
    "family_ids",
    "import_text",
    "load_schema",
    "new",
    "open",
]
