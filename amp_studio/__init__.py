"""AMP Studio: the workbench for the numbered parameters that fit a control to a machine.

As a library: ``amp.open`` and ``amp.new`` return a MachineParameters, ``amp.connect`` a ConnectedControl;
every error on purpose is an AmpStudioError. What is named in ``__all__`` is public and stays; the rooms below
(``amp_studio.files``, ``amp_studio.sim``, …) may change without notice.
"""

from .errors import AmpStudioError
from .front_pages import front_page
from .version import __version__

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from .assignments import AssignmentError, MachineError
    from .control import ConnectedControl, ControlLook, connect
    from .files import (
        Change,
        ChangedOnDiskError,
        Comparison,
        Difference,
        InUseError,
        ParameterFileError,
        RangeError,
        SaveError,
    )
    from .formats import Account, FormatError
    from .given import GivenTypeError
    from .machine import MachineParameters, import_text
    from .machine import edit_machine as edit
    from .machine import family_schema as load_schema
    from .machine import new_machine as new
    from .machine import open_machine as open  # noqa: A004  # amp.open, as gzip.open
    from .schema import DatabaseError, Schema, UnknownFamilyError, UnknownParameterError, Value, family_ids
    from .sim import MotionCheck, SimulationError, Trace
    from .transfer import CancelledError, ControlIdentity, ControlStatus, ImageError, TransferError
    from .transfer.client import CopyError, DigestError, ImageComparison, Outcome
    from .transfer.links import EndpointError
    from .validate import Finding, Fixed
    from .value_rows import ParameterEntry
else:
    __getattr__ = front_page(__name__)

__all__ = [
    "Account",
    "AmpStudioError",
    "AssignmentError",
    "CancelledError",
    "Change",
    "ChangedOnDiskError",
    "Comparison",
    "ConnectedControl",
    "ControlIdentity",
    "ControlLook",
    "ControlStatus",
    "CopyError",
    "DatabaseError",
    "Difference",
    "DigestError",
    "EndpointError",
    "Finding",
    "Fixed",
    "FormatError",
    "GivenTypeError",
    "ImageComparison",
    "ImageError",
    "InUseError",
    "MachineError",
    "MachineParameters",
    "MotionCheck",
    "Outcome",
    "ParameterEntry",
    "ParameterFileError",
    "RangeError",
    "SaveError",
    "Schema",
    "SimulationError",
    "Trace",
    "TransferError",
    "UnknownFamilyError",
    "UnknownParameterError",
    "Value",
    "__version__",
    "connect",
    "edit",
    "family_ids",
    "import_text",
    "load_schema",
    "new",
    "open",
]


def __dir__() -> list[str]:
    return __all__  # for completion: the names are loaded when they are asked for
