"""Errors of axes: measured points, their figures by ISO 230-2, and what a control is set to against them.

``reading.read_measurement`` reads what a laser or a ball-bar measured, ``proposal.propose`` makes of it the
values of a file, ``edit`` changes a table by hand. What a family offers is a record (``compensation.py``),
found by its registration.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .compensation import (
        CalibrationTable,
        Compensation,
        FittedTable,
        TableForm,
        TuningPage,
        compensation_of,
    )
    from .curve import ErrorCurve
    from .edit import deleted, inserted, left_over, rechosen, replaced
    from .errors import CalibrationError
    from .measurement import DECIMALS, ERROR_UNITS, POSITION_UNITS, Measurement, MeasurementAnswers
    from .proposal import (
        Proposal,
        ProposalRequest,
        axes_of,
        base_unit,
        lost_motion,
        present_table,
        propose,
        shown_unit,
    )
    from .reading import read_measured_file
    from .steps import stepped, steps_of, usual_step, with_followers
else:
    __getattr__ = front_page(__name__)
