"""What each firmware lists and takes, written from its public sources,
to judge the published listings apart from our reader and rules.

Grbl 0.9j (grbl/grbl), Grbl 1.1h (gnea/grbl), Grbl-Mega 1.1g (gnea/grbl-Mega) and Grbl-Mega-5X
(fra589/grbl-Mega-5X):
``settings_store_global_setting`` of grbl/settings.c takes, ``report_grbl_settings`` of grbl/report.c lists.
The three 8-bit forks of 1.1 take and list the same, but for the number of axes. Grbl_ESP32
(bdring/Grbl_Esp32): ``make_settings`` of src/SettingsDefinitions.cpp, which states the least and most of each
setting. FluidNC (bdring/FluidNC): ``make_proxies`` of src/SettingsDefinitions.cpp. grblHAL (grblHAL/core):
settings.c; it has every number that the others have.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

ANY = (0.0, float("inf"))
BYTE = (0.0, 255.0)
FLAG = (0.0, 1.0)
Range = tuple[float, float]
_WHOLE = re.compile(r"[0-9]+")


def of_axes(count: int, each: Mapping[int, Range]) -> dict[int, Range]:
    """Return the settings of axes: number of the first axis -> range, for each of them."""
    return {first + axis: limits for first, limits in each.items() for axis in range(count)}


def eight_bit(axes: int) -> dict[int, Range]:
    """Return what an 8-bit Grbl lists, without the spindle: bytes, flags and floats that are not negative."""
    singles = {
        **dict.fromkeys((0, 1, 2, 3, 10, 23, 26), BYTE),
        **dict.fromkeys((4, 5, 6, 13, 20, 21, 22), FLAG),
        **dict.fromkeys((11, 12, 24, 25, 27), ANY),
        0: (3.0, 255.0),  # STATUS_SETTING_STEP_PULSE_MIN
    }
    return singles | of_axes(axes, dict.fromkeys((100, 110, 120, 130), ANY))


SPINDLE = {30: ANY, 31: ANY, 32: FLAG}


def esp32(axes: int) -> dict[int, Range]:
    """Return what Grbl_ESP32 lists, with the least and most that it states."""
    return {
        0: (3, 1000),
        1: BYTE,
        2: BYTE,
        3: BYTE,
        4: FLAG,
        5: FLAG,
        6: FLAG,
        10: (0, 3),
        11: (0, 10),
        12: (0, 1),
        13: FLAG,
        20: FLAG,
        21: FLAG,
        22: FLAG,
        23: BYTE,
        24: (0, 10_000),
        25: (0, 10_000),
        26: (0, 10_000),
        27: (0, 1000),
        30: (0, 100_000),
        31: (0, 100_000),
        32: FLAG,
        33: (0, 100_000),
        34: (0, 100),
        35: (0, 100),
        36: (0, 100),
    } | of_axes(
        axes,
        {
            100: (1, 100_000),
            110: (1, 100_000),
            120: (1, 100_000),
            130: (0, 100_000),
            140: (0, 20),
            150: (0.05, 20),
            160: (0, 256),
            170: (-64, 255),
        },
    )


@dataclass(frozen=True)
class Firmware:
    """A firmware whose listing is closed: it has these settings and no others."""

    machine: str
    """Our machine type for it."""
    settings: Mapping[int, Range]

    def lists(self, listing: Mapping[int, str]) -> bool:
        """Return whether every line of a listing could be one of this firmware; lines may be missing."""
        return listing.keys() <= self.settings.keys() and all(
            self._shows(self.settings[n], text) for n, text in listing.items()
        )

    def _shows(self, limits: Range, text: str) -> bool:
        if limits in (BYTE, FLAG) and not _WHOLE.fullmatch(text):
            return False
        try:
            return limits[0] <= float(text) <= limits[1]
        except ValueError:
            return False


CLOSED = (
    Firmware("grbl-0.9", eight_bit(3)),
    Firmware("grbl-1.1", eight_bit(3) | SPINDLE),  # and Grbl-Mega, which lists the same
    *(Firmware("grbl-mega-5x", eight_bit(axes) | SPINDLE) for axes in (4, 5, 6)),
    *(Firmware("grbl-esp32", esp32(axes)) for axes in (3, 4, 5, 6)),
)


NO_LIMIT = float("inf")
OF_GRBLHAL: dict[int, Range] = {
    1: (0, 65_535),
    9: (0, 31),
    14: (0, (1 << 13) - 1),
    21: (0, 7),
    22: (0, (1 << 11) - 1),
    29: (0, 20),
    32: (0, 2),
    **dict.fromkeys((34, 35, 36, 347, 734, 735, 736), (0, 100)),
    42: (0, 2),
    43: (1, 128),
    58: (-100_000, NO_LIMIT),
    **{170 + axis: (-10, 10) for axis in range(8)},
    341: (0, 4),
    **dict.fromkeys((392, 393, 394, 539, 673), (0.5, 20)),
    398: (30, 1000),
    481: (100, 1000),
    **dict.fromkeys((536, 537), (0, 255)),
    676: (0, 15),
    680: (0, 500),
}
"""Least and most of ``setting_detail`` in grblHAL/core settings.c (f80fc34, lines 2305 to 2477); of masks and
choices by the labels there. Every other figure is not negative (``validate_value``, line 3189)."""
MAY_BE_ZERO = {392, 393, 394, 539, 673, 481}
"""Those with ``allow_null``."""


def machine_of(listing: Mapping[int, str]) -> str:
    """Return the machine type of a listing: the firmware of whose lines fewest are missing;
    grblHAL where none lists it.

    Of a few lines any firmware could have nobody knows more: half of them have to be there.
    """
    fits = [
        (len(each.settings) - len(listing), n)
        for n, each in enumerate(CLOSED)
        if each.lists(listing) and 2 * len(listing) >= len(each.settings)
    ]
    return CLOSED[min(fits)[1]].machine if fits else "grblhal"


def refusals_of_grblhal(figures: Mapping[int, float]) -> Iterator[str]:
    """Yield what ``settings_store_setting`` of grblHAL would answer with an error."""
    if figures.get(40) and not int(figures.get(22, 1)) & 1:
        yield "$40: limits of jogging need homing"  # set_jog_soft_limited, line 1057
    for n, figure in figures.items():
        low, high = OF_GRBLHAL.get(n, (0, NO_LIMIT))
        if not low <= figure <= high and not (figure == 0 and n in MAY_BE_ZERO):
            yield f"${n}: {figure:g} is not within {low:g} to {high:g}"


def refusals(listing: Mapping[int, str], machine: str) -> Iterator[str]:
    """Yield the settings that the firmware would answer with an error, or with which an axis could not
    move.
    """
    figures = {n: float(text) for n, text in listing.items() if re.fullmatch(r"-?[0-9]+(\.[0-9]*)?", text)}
    if figures.get(20) and not figures.get(22, 1):
        yield "$20: soft limits need homing"  # STATUS_SOFT_LIMIT_ERROR, in all of them
    if machine == "grblhal":
        yield from refusals_of_grblhal(figures)
    least = 2.0 if machine == "grblhal" else 3.0
    if figures.get(0, least) < least:
        yield "$0: the pulse is too short"
    for n, figure in figures.items():
        if 100 <= n < 140 and n % 10 < 6 and figure < 0:
            yield f"${n}: negative"
        if 100 <= n < 130 and n % 10 < 6 and figure == 0:
            yield f"${n}: zero, by which the planner divides"
