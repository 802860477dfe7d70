"""From where on a record is kept, or laid over a simulation: ``--trigger`` and ``--pre-trigger``."""

from __future__ import annotations

from amp_studio.cli.errors import UsageError

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from amp_studio.cli.verb import Options
    from amp_studio.sim import Trigger


def trigger_given(options: Options) -> Trigger | None:
    """Return the trigger of a record; raises UsageError for an option without its other one."""
    from amp_studio.sim import trigger_of

    if options.trigger is None:
        if options.pre_trigger is not None:
            raise UsageError("--pre-trigger belongs to --trigger")
        return None
    return trigger_of(options.trigger, options.pre_trigger or 0.0)
