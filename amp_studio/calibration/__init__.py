"""Errors of axes: measured points, their figures by ISO 230-2, and what a control is set to against them.

``reading.read_measurement`` reads what a laser or a ball-bar measured, ``proposal.propose`` makes of it the values of a file,
``edit`` changes a table by hand. What a family offers is a record (``compensation.py``), found by its registration.
"""

from __future__ import annotations

from .compensation import CalibrationTable, Compensation, FittedTable, TableForm, TuningPage, compensation_of
from .curve import ErrorCurve, mean_curve
from .errors import CalibrationError, MeasurementError
from .figures import AxisFigures, TargetFigures, figures
from .measurement import (
    DECIMALS,
    ERROR_UNITS,
    POSITION_UNITS,
    SIGNS,
    MeasuredRun,
    Measurement,
    MeasurementAnswers,
)
from .proposal import Proposal, Wish, axes_of, base_unit, lost_motion, present_table, propose, shown_unit
from .reading import read_measured_file, read_measurement

__all__ = [
    "DECIMALS",
    "ERROR_UNITS",
    "POSITION_UNITS",
    "SIGNS",
    "AxisFigures",
    "CalibrationError",
    "CalibrationTable",
    "Compensation",
    "ErrorCurve",
    "FittedTable",
    "MeasuredRun",
    "Measurement",
    "MeasurementAnswers",
    "MeasurementError",
    "Proposal",
    "TableForm",
    "TargetFigures",
    "TuningPage",
    "Wish",
    "axes_of",
    "base_unit",
    "compensation_of",
    "figures",
    "lost_motion",
    "mean_curve",
    "present_table",
    "propose",
    "read_measured_file",
    "read_measurement",
    "shown_unit",
]
