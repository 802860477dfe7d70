"""The frequency response of an axis: read as a table, or estimated from the record of a chirp.

H1 = Sxy / Sxx of torque and motion (J. Bendat, A. Piersol, *Random Data*, 2010, 6.1; P. Welch, IEEE
Transactions on Audio and Electroacoustics 15, 1967), with its coherence. Motion is differenced to an
acceleration before, which has no drift to leak from one frequency to the others, and the answer of the
differences is taken out again exactly.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from amp_studio.files import text_of_name
from amp_studio.schema import read_table_text
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.series import Response, Series

from .drive_record import read_number_table

LEAST_COHERENCE = 0.8
LEAST_POINTS = 12
SEGMENTS = 12
"""Parts of a record, half of each in the next one, that are averaged."""
LEAST_ROWS = 1000
HIGHEST = 0.25
"""Share of the sampling frequency up to which a record is used."""
LEAST_EXCITATION = 1e-4
"""Share of the strongest torque in a frequency from which it is excited."""
_HEADS = {
    "frequency": r"(frequency|freq|f|frequenz)([ _(\[]*hz[)\]]?)?",
    "gain": r"(gain|magnitude|mag|amplitude|verst.rkung)([ _(\[]*db[)\]]?)?",
    "phase": r"(phase|winkel)([ _(\[]*(deg|°|grad)[)\]]?)?",
    "coherence": r"(coherence|coh|koh.renz)",
}


@dataclass(frozen=True, eq=False)
class FrequencyResponse:
    """Motion for one unit of torque over the frequency in Hz."""

    frequency: Series
    response: Response
    coherence: Series | None
    left_out: int = 0
    """Frequencies with a coherence below LEAST_COHERENCE."""

    @property
    def weights(self) -> Series:
        """The weight of each frequency: the reciprocal standard deviation of its logarithm, up to a
        factor.
        """
        if self.coherence is None:
            return np.ones(len(self.frequency))
        sure = np.clip(self.coherence, LEAST_COHERENCE, 0.9999)
        return np.asarray(np.sqrt(sure / (1.0 - sure)))


def is_response(path: Path) -> bool:
    """Return whether a file is a table over the frequency; raises OSError."""
    try:
        return bool(_heads(read_table_text(path)))
    except ValueError:
        return False


def read_response(path: Path) -> FrequencyResponse:
    """Read frequency (Hz), gain (dB), phase (deg) and coherence; raises SimulationError with the file's
    name.
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
    names = [name for name in ("frequency", "gain", "phase", "coherence") if name in heads]
    table = dict(zip(names, read_number_table(text, [heads[name] for name in names]), strict=True))
    frequency = table["frequency"]
    if (frequency <= 0.0).any() or (np.abs(table["gain"]) > 1000.0).any():
        raise SimulationError("A frequency must be above 0 Hz, and a gain between -1000 and 1000 dB")
    order = np.argsort(frequency, kind="stable")
    size, phase = 10.0 ** (table["gain"] / 20.0), np.radians(table["phase"])
    answer = size * np.cos(phase) + 1j * size * np.sin(phase)
    coherence = table.get("coherence")
    if coherence is not None and not ((coherence >= 0.0) & (coherence <= 1.0 + 1e-9)).all():
        raise SimulationError("A coherence must be between 0 and 1")
    return coherent(frequency[order], answer[order], None if coherence is None else coherence[order])


def _heads(text: str) -> dict[str, int]:
    """Return what each column is, by the first line that names frequency, gain and phase;
    empty where none does.
    """
    for line in text.splitlines()[:60]:
        separator = next((character for character in ";\t," if character in line), ",")
        cells = [" ".join(cell.strip().strip("\"'").casefold().split()) for cell in line.split(separator)]
        found = {}
        for name, pattern in _HEADS.items():
            fitting = [n for n, cell in enumerate(cells) if re.fullmatch(pattern, cell)]
            if fitting:
                found[name] = fitting[0]
        if {"frequency", "gain", "phase"} <= found.keys():
            return found
    return {}


def coherent(frequency: Series, response: Response, coherence: Series | None) -> FrequencyResponse:
    """Return the frequencies whose coherence is high enough; raises SimulationError where these are too
    few.
    """
    used: npt.NDArray[np.bool_] = np.isfinite(response) & (np.abs(response) > 0.0)
    low = 0
    if coherence is not None:
        low = int((coherence < LEAST_COHERENCE).sum())
        if 2 * low > len(coherence):
            raise SimulationError(
                f"The coherence is below {LEAST_COHERENCE:g} at {low} of {len(coherence)} frequencies: excite"
                " the axis more, average longer, or keep other motion away from it"
            )
        used &= coherence >= LEAST_COHERENCE
    if int(used.sum()) < LEAST_POINTS:
        raise SimulationError(
            f"{int(used.sum())} frequencies are too few: at least {LEAST_POINTS} are needed"
        )
    return FrequencyResponse(
        frequency[used], response[used], None if coherence is None else coherence[used], low
    )


def response_of_record(period: float, torque: Series, motion: Series, differences: int) -> FrequencyResponse:
    """Return H1 of a record at even times: of a velocity (one difference) or a position (two).

    Raises SimulationError for a record that is too short or not coherent.
    """
    if len(torque) < LEAST_ROWS:
        raise SimulationError(f"The record has {len(torque)} rows; a response needs at least {LEAST_ROWS}")
    moved, driven = np.diff(motion, differences), torque[: len(torque) - differences]
    # Welch: segments that overlap by half, each under a Hann window, which has its smallest weight where the
    # next segment has its largest. Without averages the coherence would be 1 at each frequency.
    length = 2 * len(driven) // (SEGMENTS + 1)
    window = np.hanning(length)
    cross = np.zeros(length // 2 + 1, dtype=np.complex128)
    given, answered = np.zeros(length // 2 + 1), np.zeros(length // 2 + 1)
    for n in range(SEGMENTS):
        part = slice(n * length // 2, n * length // 2 + length)
        x, y = (np.fft.rfft(window * (each[part] - each[part].mean())) for each in (driven, moved))
        cross += np.conj(x) * y
        given, answered = given + np.abs(x) ** 2, answered + np.abs(y) ** 2
    frequency = np.asarray(np.fft.rfftfreq(length, period), dtype=np.float64)
    # The first bin too is left out: the window spreads into it what is left of a drift.
    excited = (given > LEAST_EXCITATION * np.max(given)) & (frequency > 1.5 / (length * period))
    excited &= frequency < HIGHEST / period
    frequency, cross, given, answered = frequency[excited], cross[excited], given[excited], answered[excited]
    # A difference of samples is a factor z - 1; divided out, the response is that of the motion itself. It
    # was differenced because a position drifts, and a drift leaks into all frequencies of a segment.
    ahead = (np.exp(2j * np.pi * frequency * period) - 1.0) ** differences
    return coherent(frequency, cross / given / ahead, np.abs(cross) ** 2 / (given * answered))
