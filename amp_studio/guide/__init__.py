"""Commissioning, guided: the steps of a family in their order, and how far a file has come in them.

``steps_of`` are the steps, from the facts; ``progress`` is what one file has set and not set, and which
findings belong to steps that have been reached and which are deferred; ``present`` parts these for every
list; ``next_open`` is the next value to give.
A step that a person has ticked is kept in the head of the file (``tick``).
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .delivered import Present, found_in, present
    from .steps import SetupStep, find_step, step_of, steps_of
    from .steps_done import GuideProgress, StepProgress, StepState, next_open, progress
    from .summary import FileSummary, summary_of
    from .ticks import tick
else:
    __getattr__ = front_page(__name__)
