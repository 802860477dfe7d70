"""Commissioning, guided: the steps of a family in their order, and how far a file has come in them.

``steps_of`` are the steps, from the facts; ``progress`` is what one file has set and not set, and which findings belong to
steps that have been reached and which are deferred; ``next_open`` is the next value to give. A step that a person has
ticked is kept in the head of the file (``tick``).
"""

from .delivered import Delivered, as_delivered
from .progress import GuideProgress, StepProgress, StepState, next_open, progress
from .steps import SetupStep, find_step, step_of, steps_of
from .ticks import tick

__all__ = [
    "Delivered",
    "GuideProgress",
    "SetupStep",
    "StepProgress",
    "StepState",
    "as_delivered",
    "find_step",
    "next_open",
    "progress",
    "step_of",
    "steps_of",
    "tick",
]
