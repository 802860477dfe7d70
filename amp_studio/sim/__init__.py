"""The simulation: how an axis moves with its parameters, before the machine moves.

`run.simulate` is the single call from an open file to a trace. A family brings its law (`law.py`: two sample
functions and the figures of an axis, bound from a file); the rest knows no family: what is commanded
(`command/`), machine and loop over both (`engine/`), axes that run or are stepped (`axis/`), the scenarios,
gains (`tuning/`), a machine out of a record (`identification/`), and what is drawn and written (`picture.py`,
`write.py`). Every assumption is documented where it is made, is part of each trace,
and is listed in docs/simulation.md and its pages.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

from . import one_thread as one_thread

if TYPE_CHECKING:
    from .axis.file_machine import FileMachine
    from .axis.motion import Motion, RunEnd, run_axis
    from .axis.moving_axis import MovingAxis
    from .axis.orders import GoOrder, Seen, Watch
    from .axis.simulated_machine import SimulatedAxis, SimulatedMachine
    from .axis_parameters import AxisParameters, ParameterValue
    from .binding import bind_axis
    from .cam import CamForm, CamPoints, CamProfile, cam_figures, cam_picture
    from .cam_reading import read_cam_points
    from .command.events import CodedScale, Failure, Handwheel, Homing, Jogging, Ramp, Travel
    from .command.pieces import Piece, change, length
    from .command.ramps import end_of, exponential_pieces, leg, move, profile_of
    from .engine.arrays import Vector
    from .engine.counts import nearest
    from .engine.machine import Machine
    from .engine.profiles import POLYNOMIAL
    from .engine.signals import (
        COMMAND,
        COMMAND_ACCELERATION,
        COMMAND_VELOCITY,
        FEED_SHARE,
        MODE,
        MONITOR,
        MOTOR,
        OUTPUT,
        OUTPUT_TEST,
        POSITION,
        POSITION_LOOP,
        REFERENCE_LAG,
        STOP,
        VELOCITY_LOOP,
    )
    from .errors import SimulationError
    from .identification.identify import figure_rows, identified_text, identify, machine_settings
    from .identification.identify_response import identify_response
    from .identification.machine_file import machine_for, read_machine, write_machine
    from .identification.overlay import laid_over, unit_factor
    from .identification.recording import SIGNALS as RECORDED_SIGNALS
    from .identification.recording import (
        LiveRecorder,
        SignalRecord,
        Trigger,
        read_recording,
        trigger_of,
        write_recording,
    )
    from .identification.response import is_response
    from .law import AlarmText, AxisLaw, BoundMachine, Law, Leader, LoopFilter, Prediction, Source, law_of
    from .listings import SimulationListing, listing
    from .machine_test import MachineTest, MachineTestStep
    from .model import assumptions
    from .motion_check import NEAR_GRID, LimitUse, MotionCheck, check_again, check_motion
    from .parameter_roles import ParameterRoles
    from .path.job import JobProgress, ProgramJob, ProgramVersion, WhatIf, versions, what_if
    from .path.moment import PathMoment, moment_at
    from .path.picture import (
        NOT_GOOD,
        PathChoice,
        PathColours,
        limit_sort,
        not_good_lines,
        path_outline,
        path_picture,
        path_place,
    )
    from .path.program import ProgramRun
    from .path.result import (
        alarm_text,
        assumed_texts,
        contour_text,
        limit_tries,
        limited_by,
        line_columns,
        lines_limited_by,
        program_csv,
        program_summary,
        program_text,
        run_against,
        try_summary,
    )
    from .path.typed import typed_error, typed_places, typed_steps, typed_values
    from .path_rules import (
        CornerRule,
        Corners,
        Geometry,
        PathLimit,
        PathRows,
        PathRules,
        RowBounds,
        ShapedPath,
        row_sums,
        steps_of_axes,
    )
    from .picture import picture_of, plot_svg, recording_picture, settling_span
    from .probing import Probing
    from .rounding import rounded_down, rounded_up, value_text
    from .run import machine_tests, simulate, simulated_axes, sweep
    from .scenario import CheckPart, Scenario, ScenarioSettings, above_zero, number, refuse_unknown
    from .scenarios.columns import alarms_of, column_units, per_minute
    from .scenarios.step import SCENARIO as STEP
    from .spindle import Gear, Orient, SpeedWatch, Spindle, Tapping
    from .steady import error_at_speed, steady_signals
    from .trace import Alarm, Figure, HomingCourse, HomingStage, Recommendation, Trace, titled
    from .tuning.linear import linear_model
    from .tuning.record import add_tuning, read_tunings, recorded_tuning, value_at
    from .tuning.trial import address_of, called_parameter, named_parameter
    from .unit_system import length_unit, path_error_text, path_error_unit
    from .variations.scenario import SweepWay
    from .write import trace_summary, trace_text, with_uncertainty, write_trace
    from .zones import Zone
else:
    __getattr__ = front_page(__name__)
