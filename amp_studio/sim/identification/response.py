"""The frequency response of an axis: read as a table, or estimated from the record of a chirp.

H1 = Sxy / Sxx of torque and motion (J. Bendat, A. Piersol, *Random Data*, 2010, 6.1) over windows of
neighbouring frequencies of the whole record, in which the response is a polynomial (J. Schoukens, G.
Vandersteen, K. Barbé, R. Pintelon, European Journal of Control 15, 2009), with its coherence. Parts of a
record, as P. Welch averages, would each have ahead of them what a chirp did in the part before, which takes
up to 7 % off an acceleration. Motion is differenced to an acceleration before, which has no drift to leak
from one frequency to the others, and the answer of the differences is taken out again exactly.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from amp_studio.files import text_of_name
from amp_studio.schema import read_table_text
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.series import Response, Series

from .drive_record import read_number_table

_MIN_COHERENCE = 0.8
_MIN_POINTS = 12
ORDER = 2
"""Of the polynomial in a window."""
_MIN_BESIDE, _MAX_WINDOWS = 6, 500
"""Frequencies on each side of the middle of a window; windows in a record."""
_MIN_ROWS = 1000
_HIGHEST = 0.25
"""Share of the sampling frequency up to which a record is used."""
_MIN_EXCITATION = 1e-3
"""Share of the strongest torque in a window, by its square, from which it is excited."""
_HEADS = {
    "frequency": r"(?:frequency|frequenz|freq|f)",
    "omega": r"(?:omega|ω|w|angular frequency|kreisfrequenz)",
    "gain": r"(?:gain|magnitude|mag|amplitude|betrag|verst.rkung)",
    "phase": r"(?:phase|winkel)",
    "real": r"(?:real part|realteil|real|re)",
    "imaginary": r"(?:imaginary part|imagin.rteil|imaginary|imag|im)",
    "coherence": r"(?:coherence|coh|koh.renz)",
}
"""What a column is -> its name, which its unit follows in brackets or behind a blank or _."""
_UNIT = r"(?:[ _]*\[(.+)\]|[ _]*\((.+)\)|[ _]+([^\s_()\[\]]+))?"
_HERTZ = {"hz": 1.0, "khz": 1e3, "rad/s": 0.5 / math.pi, "rad/sec": 0.5 / math.pi, "1/s": 0.5 / math.pi}
_DEGREES, _RADIANS = ("deg", "degree", "degrees", "°", "grad"), ("rad", "radian", "radians")
_ABSOLUTE = ("abs", "absolute", "absolut", "lin", "linear", "ratio", "-", "1")
_MIN_DEGREES = 30.0
_DECIBELS = 1000.0
"""dB: a larger one is no gain."""


@dataclass(frozen=True)
class _Column:
    """Where a column is and the unit that its head has; "" for none."""

    index: int
    unit: str


@dataclass(frozen=True, eq=False)
class FrequencyResponse:
    """Motion for one unit of torque over the frequency in Hz."""

    frequency: Series
    response: Response
    coherence: Series | None
    left_out: int = 0
    """Frequencies with a coherence below _MIN_COHERENCE."""
    period: float = 0.0
    """s between two rows of the record that it is from; 0 where it is not from one."""
    open_ends: tuple[Response, ...] = ()
    """Of a record: by which share the response may be off as its ends are not known better."""

    @property
    def weights(self) -> Series:
        """The weight of each frequency: the reciprocal standard deviation of its logarithm, up to a
        factor.
        """
        if self.coherence is None:
            return np.ones(len(self.frequency))
        # A coherence of 1 would have an infinite weight.
        sure = np.clip(self.coherence, _MIN_COHERENCE, 0.9999)
        return np.asarray(np.sqrt(sure / (1.0 - sure)))


def is_response(path: Path) -> bool:
    """Return whether a file is a table over the frequency; raises OSError."""
    try:
        return bool(_heads(read_table_text(path)))
    except ValueError:
        return False


def read_response(path: Path) -> FrequencyResponse:
    """Read frequency (Hz, rad/s), gain (dB, absolute), phase (deg, rad) or the parts of the response, and
    coherence; raises SimulationError with the file's name.
    """
    try:
        return response_of_text(read_table_text(path))
    except SimulationError as error:
        raise SimulationError(f"{text_of_name(path.name)}: {error}") from None


def response_of_text(text: str) -> FrequencyResponse:
    """Return the response in a text of columns; raises SimulationError naming the line."""
    heads = _heads(text)
    if not heads:
        raise SimulationError(
            "No line has the heads frequency_hz, gain_db and phase_deg, and coherence where it is known"
        )
    columns = read_number_table(text, [column.index for column in heads.values()])
    table = dict(zip(heads, columns, strict=True))
    frequency = _hertz(table, heads)
    if (frequency <= 0.0).any():
        raise SimulationError("A frequency must be above 0 Hz")
    order = np.argsort(frequency, kind="stable")
    answer = _answer(table, heads)
    coherence = table.get("coherence")
    if coherence is not None:
        coherence = coherence / 100.0 if heads["coherence"].unit == "%" else coherence
        if not ((coherence >= 0.0) & (coherence <= 1.0 + 1e-9)).all():
            raise SimulationError("A coherence must be between 0 and 1")
    return coherent(frequency[order], answer[order], None if coherence is None else coherence[order])


def _hertz(table: Mapping[str, Series], heads: Mapping[str, _Column]) -> Series:
    name = "frequency" if "frequency" in heads else "omega"
    unit = heads[name].unit or ("hz" if name == "frequency" else "rad/s")
    if unit not in _HERTZ:
        raise SimulationError(f"The unit {unit} of the frequency is not known: Hz, kHz or rad/s")
    return np.asarray(table[name] * _HERTZ[unit])


def _answer(table: Mapping[str, Series], heads: Mapping[str, _Column]) -> Response:
    """Return the response of gain and phase, or of its parts; raises SimulationError where a unit is open."""
    if "real" in heads:
        return np.asarray(table["real"] + 1j * table["imaginary"])
    phase = (
        table["phase"] if _is_in_radians(table["phase"], heads["phase"].unit) else np.radians(table["phase"])
    )
    size = _size(table["gain"], heads["gain"].unit)
    return np.asarray(size * np.cos(phase) + 1j * size * np.sin(phase))


def _is_in_radians(phase: Series, unit: str) -> bool:
    if unit in _DEGREES or unit in _RADIANS:
        return unit in _RADIANS
    if unit:
        raise SimulationError(f"The unit {unit} of the phase is not known: deg or rad")
    # A motion lags behind its torque by 90 deg and more: so small a phase may be radians.
    if (np.abs(phase) < _MIN_DEGREES).all():
        raise SimulationError("The phase may be in deg or rad and names no unit: phase_deg or phase_rad")
    return False


def _size(gain: Series, unit: str) -> Series:
    """Return gains as absolute ones; raises SimulationError for a unit that cannot be."""
    # An absolute gain is above 0, so that a column that goes below is in dB.
    if unit == "db" or (not unit and (gain <= 0.0).any()):
        if (np.abs(gain) > _DECIBELS).any():
            raise SimulationError("A gain must be between -1000 and 1000 dB")
        return np.asarray(10.0 ** (gain / 20.0))
    if not unit:
        raise SimulationError("The gain names no unit: gain_db or gain_abs")
    # A unit with a slash, as mm/s/A, is an absolute one.
    if unit not in _ABSOLUTE and "/" not in unit:
        raise SimulationError(f"The unit {unit} of the gain is not known: dB or abs")
    if (gain < 0.0).any():
        raise SimulationError("An absolute gain is not below 0: the minus is in the phase")
    return gain


def _heads(text: str) -> dict[str, _Column]:
    """Return what each column is, by the first line that names frequency and gain with phase, or the parts of
    the response; empty where none does.
    """
    for line in text.splitlines()[:60]:
        separator = next((character for character in ";\t," if character in line), ",")
        cells = [" ".join(cell.strip().strip("\"'").casefold().split()) for cell in line.split(separator)]
        found: dict[str, _Column] = {}
        for name, pattern in _HEADS.items():
            for n, cell in enumerate(cells):
                if (match := re.fullmatch(pattern + _UNIT, cell)) and name not in found:
                    found[name] = _Column(n, next(filter(None, match.groups()), "").strip())
        if not found.keys() & {"frequency", "omega"}:
            continue
        if {"gain", "phase"} <= found.keys() or {"real", "imaginary"} <= found.keys():
            return found
    return {}


def coherent(
    frequency: Series, response: Response, coherence: Series | None, open_ends: Sequence[Response] = ()
) -> FrequencyResponse:
    """Return the frequencies whose coherence is high enough; raises SimulationError where these are too
    few.
    """
    used: npt.NDArray[np.bool_] = np.isfinite(response) & (np.abs(response) > 0.0)
    low = 0
    if coherence is not None:
        low = int((coherence < _MIN_COHERENCE).sum())
        if 2 * low > len(coherence):
            raise SimulationError(
                f"The coherence is below {_MIN_COHERENCE:g} at {low} of {len(coherence)} frequencies: excite"
                " the axis more, average longer, or keep other motion away from it"
            )
        used &= coherence >= _MIN_COHERENCE
    if int(used.sum()) < _MIN_POINTS:
        raise SimulationError(f"{int(used.sum())} frequencies are too few: at least {_MIN_POINTS} are needed")
    return FrequencyResponse(
        frequency[used],
        response[used],
        None if coherence is None else coherence[used],
        low,
        open_ends=tuple(each[used] for each in open_ends),
    )


def response_of_record(period: float, torque: Series, motion: Series, differences: int) -> FrequencyResponse:
    """Return H1 of a record that begins at rest, of a velocity (one difference) or a position (two).

    Raises SimulationError for a record that is too short or not coherent.
    """
    if len(torque) < _MIN_ROWS:
        raise SimulationError(
            f"The record has too few rows for a response: {len(torque)} of at least {_MIN_ROWS}"
        )
    moved, driven = np.diff(motion, differences), torque[: len(torque) - differences]
    given, answered = (np.fft.rfft(each - each.mean()) for each in (driven, moved))
    frequency = np.asarray(np.fft.rfftfreq(len(driven), period), dtype=np.float64)
    middles, beside = _windows(frequency, np.abs(given) ** 2, period)
    parts = [slice(k - beside, k + beside + 1) for k in middles]
    ahead = np.exp(2j * np.pi * frequency * period) - 1.0
    ends, errors = _ends(given, answered, ahead, parts, differences)
    answered = answered - ends
    found = [_at_middle(given[part], answered[part]) for part in parts]
    frequency, response, ahead = frequency[middles], np.array([each for each, _ in found]), ahead[middles]
    open_ends = [error * ahead**n / (response * given[middles]) for n, error in enumerate(errors)]
    # What is above half of the sampling frequency is folded back, for a torque that is kept for
    # a sample in this share.
    folded = (frequency * period / (1.0 - frequency * period)) ** (differences + 1)
    coherence = 1.0 / (1.0 / np.maximum([each for _, each in found], 1e-9) + folded**2)
    # A difference of samples is a factor z - 1; divided out, the response is that of the motion itself. It
    # was differenced because a position drifts, and a drift leaks into all frequencies.
    found_response = coherent(frequency, response / ahead**differences, coherence, open_ends)
    return replace(found_response, period=period)


def _ends(
    given: Response, answered: Response, ahead: Response, parts: Sequence[slice], differences: int
) -> tuple[Response, Series]:
    """Return what the noise of the first and the last rows adds to all frequencies, and its standard errors.

    Differences end where the record does, so that the noise of its ends is not differenced: it is a constant
    over the frequency (of a position also one in proportion to z - 1), larger at low frequencies than all
    other noise, and smooth where the torque is, so that no window sees it by itself.
    """
    basis = np.stack([ahead**n for n in range(differences)], axis=1)
    shapes, rests = [], []
    for part in parts:
        own = np.linalg.qr(_powers(given[part]))[0]
        shape, rest = (each[part] - own @ (own.conj().T @ each[part]) for each in (basis, answered))
        noise = math.sqrt(float(np.sum(np.abs(rest) ** 2)) / (len(rest) - ORDER - 1)) or 1.0
        shapes.append(shape / noise)
        rests.append(rest / noise)
    shape, rest = (np.concatenate([each.real, each.imag]) for each in map(np.concatenate, (shapes, rests)))
    inverse = np.linalg.pinv(shape.T @ shape)
    # Real and imaginary part have half of the noise each.
    return np.asarray(basis @ (inverse @ (shape.T @ rest))), np.sqrt(0.5 * np.diag(inverse))


def _windows(frequency: Series, power: Series, period: float) -> tuple[npt.NDArray[np.int64], int]:
    """Return the middles of windows beside each other that are excited, and the frequencies on each side."""
    width = 2 * _MIN_BESIDE + 1
    smooth = np.convolve(power, np.full(width, 1.0 / width), "same")
    excited = np.flatnonzero((smooth > _MIN_EXCITATION * smooth.max()) & (frequency < _HIGHEST / period))
    first, last = max(1, int(excited[0])), int(excited[-1])
    beside = max(_MIN_BESIDE, math.ceil((last - first) / (2 * _MAX_WINDOWS)))
    return np.arange(first + beside, last - beside + 1, 2 * beside + 1), beside


def _powers(given: Response) -> Response:
    """Return the torque in a window times each power of the distance from its middle, a column each."""
    away = np.linspace(-1.0, 1.0, len(given))
    return np.asarray(given[:, None] * away[:, None] ** np.arange(ORDER + 1))


def _at_middle(given: Response, answered: Response) -> tuple[complex, float]:
    """Return the response in the middle of a window, and the coherence: the share of the motion that follows
    the torque.
    """
    powers = _powers(given)
    factors = np.linalg.lstsq(powers, answered, rcond=None)[0]
    left = float(np.sum(np.abs(answered - powers @ factors) ** 2)) / (len(given) - ORDER - 1)
    whole = float(np.mean(np.abs(answered) ** 2))
    return complex(factors[0]), max(0.0, 1.0 - left / whole) if whole else 0.0
