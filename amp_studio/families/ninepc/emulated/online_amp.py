"""On-line AMP at the screen of the emulated 9/PC: the softkeys behind {AXIS PARAM} (chapter 36).

``axis-param 1340 0.005`` is {REPLCE VALUE}, ``axis-param 1340 add 0.001`` {ADD TO VALUE}, ``axis-param 1801
increase`` and
``decrease`` are {INCRE VALUE} and {DECRE VALUE}; ``axis-calib X insert 100 0.004``, ``replace``, ``delete``
and ``begin deviation - 0`` (input, start, first position) work on the points of an axis, ``cal-status X``
switches its calibration off and ``home X`` on again. Each is stored with {UPDATE & EXIT} at once and counts
without a restart. Assumed, because it is not printed: that a step is the last decimal that is stored.
"""

from __future__ import annotations

from fractions import Fraction

from amp_studio.calibration import (
    CalibrationError,
    CalibrationTable,
    deleted,
    inserted,
    present_table,
    replaced,
    stepped,
    steps_of,
    with_followers,
)
from amp_studio.families.ninepc.compensation import COMPENSATION
from amp_studio.files import ParameterFile, RangeError, axis_instances
from amp_studio.schema import Address, InvalidValueError, Value, read_exact, resolve_axis, show_value
from amp_studio.transfer import decode_image, encode_image
from amp_studio.transfer.emulated import Control

_IN_ESTOP = ("servo.reversal_error", "home.calibration")
"""What is changed in E-Stop only (pages 36-2 and 36-4)."""
OUT_OF_RANGE, INVALID = "PARAM VALUE OUT OF RANGE", "INVALID INPUT VALUE"


class OnlineAmp:
    """The axis parameters of a control; which calibrations are off is forgotten at a start."""

    words = "axis-param NUMBER VALUE, axis-calib AXIS insert POSITION FIGURE, cal-status AXIS, home AXIS"

    def __init__(self) -> None:
        self._off: set[str] = set()
        """Axes whose calibration is off: switched off, or unhomed by a change of a point."""

    def started(self) -> None:
        """Forget what was switched off."""
        self._off = set()

    def operate(self, control: Control, verb: str, rest: str) -> str | None:
        """Do what a softkey does; None for other commands. Raises ValueError, RefusalError, OSError."""
        match verb, rest.split():
            case "axis-param", [number, *words] if words:
                return self._axis_param(control, number, words)
            case "axis-calib", [axis, action, *words]:
                return self._axis_calib(control, axis, action, words)
            case "cal-status", [axis]:
                instance = self._axis(decode_image(control.image), axis)
                if instance in self._off:
                    raise ValueError("the calibration of this axis is off until it is homed (page 36-10)")
                self._off.add(instance)
                return "calibration off until the axis is homed"
            case "home", [axis]:
                instance = self._axis(decode_image(control.image), axis)
                self._off.discard(instance)
                return "homed, calibration on"
        return None

    # -- values ----------------------------------------------------------------------

    def _axis_param(self, control: Control, number: str, words: list[str]) -> str:
        """Change a value on the screen of axis parameters; returns the line as it then is."""
        file = decode_image(control.image)
        address = file.find(number)
        parameter = file.schema.parameters[address[0]]
        if not parameter.tunable or parameter.type == "text":
            raise ValueError(f"{number} is on no screen of the axis parameters (page 36-2)")
        value = self._value(file, address, words)
        try:
            file.set_checked(with_followers(file, {address: value}))
        except RangeError:
            raise ValueError(OUT_OF_RANGE) from None
        self._store(control, file, in_estop=address[0] in _IN_ESTOP)
        return f"{number} {show_value(parameter, file.get(address))}"

    def _value(self, file: ParameterFile, address: Address, words: list[str]) -> Value:
        """Return the value that an operator enters, or steps to."""
        try:
            match words:
                case ["increase"]:
                    return stepped(file, address, steps_of(file, address)[0])
                case ["decrease"]:
                    return stepped(file, address, -steps_of(file, address)[0])
                case ["add", number]:
                    return _sum(file, address, read_exact(number)[0])
                case [text]:
                    return file.read(address, text)
        except InvalidValueError:
            raise ValueError(INVALID) from None
        raise ValueError("axis-param takes a number and a value, add and a value, increase or decrease")

    def _store(self, control: Control, file: ParameterFile, *, in_estop: bool) -> None:
        control.tune(lambda _: encode_image(file), in_estop=in_estop)

    # -- points ------------------------------------------------------------------------

    def _axis_calib(self, control: Control, axis: str, action: str, words: list[str]) -> str:
        """Change the table of an axis; returns its number of points, after which the axis is not homed."""
        file = decode_image(control.image)
        instance = self._axis(file, axis)
        form = COMPENSATION.table
        assert form is not None
        try:
            table = present_table(file, COMPENSATION, instance)
            table = self._changed(table, action, words, file, instance)
            text = form.write(file, instance, table)
        except CalibrationError as error:
            raise ValueError(str(error)) from None
        file.set((form.parameter, instance), Value(text) if text else None)
        self._store(control, file, in_estop=False)
        self._off.add(instance)  # page 36-5: the axis counts as unhomed
        remarks = form.remarks(file, instance, table)
        return "; ".join((f"points: {len(table.points)}; the axis is not homed", *remarks))

    def _changed(
        self, table: CalibrationTable | None, action: str, words: list[str], file: ParameterFile, axis: str
    ) -> CalibrationTable:
        """Return a table after one action at the screen; raises ValueError for one that it does not take."""
        form = COMPENSATION.table
        assert form is not None
        if table is None:
            table = form.empty(file, axis, "", "")
        match action, words:
            case "begin", [input_, start, at] if (
                not table.points and input_ in form.inputs and start in form.starts
            ):
                # The first point is put in where the axis is: it has no deviation (page 36-7).
                return CalibrationTable(table.unit, ((read_exact(at)[0], Fraction(0)),), input_, start)
            case "insert", [at, figure]:
                position = read_exact(at)[0]
                return inserted(table, position, form.error(table, position, read_exact(figure)[0]))
            case "replace", [at, figure]:
                position = read_exact(at)[0]
                return replaced(table, position, form.error(table, position, read_exact(figure)[0]))
            case "delete", [at]:
                return deleted(table, read_exact(at)[0])
        raise ValueError(
            "axis-calib takes an axis and begin INPUT START POSITION, insert or replace POSITION FIGURE, or"
            " delete POSITION"
        )

    def _axis(self, file: ParameterFile, text: str) -> str:
        return resolve_axis(file.evaluation, axis_instances(file), text)


def _sum(file: ParameterFile, address: Address, by: Fraction) -> Value:
    """Return a value with a number added; raises ValueError with the message
    of the screen if it is out of range.
    """
    old, new = file.get(address), stepped(file, address, by)
    assert old is not None
    if Fraction(repr(new.value)) != Fraction(repr(old.value)) + by:  # it stopped at its bound
        raise ValueError(OUT_OF_RANGE)
    return new
