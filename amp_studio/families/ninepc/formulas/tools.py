"""Tool words, tool gauging and offset tables: chapter 21. Lengths may be in any one unit."""

from __future__ import annotations

from amp_studio.validate import finite, not_negative, whole


def split_t_word(word: float, digits: float, geometry_as_wear: bool) -> tuple[int, int, int]:
    """Tool, wear offset and geometry offset that a T-word of a lathe calls (pages 21-2 and 21-3).

    The last ``digits`` (1 to 3) are the wear offset, those before it the tool. With the formats "Geom +
    Wear" the geometry offset has the number of the wear offset, with "Wear" that of the tool.
    """
    last = whole("The number of digits", digits)
    if last > 3:
        raise ValueError(f"A T-code format takes 1 to 3 digits for the offset, not {digits!r}.")
    tool, wear = divmod(whole("The T-word", word, 0), 10**last)
    return tool, wear, wear if geometry_as_wear else tool


def tool_life_group(word: float, boundary: float) -> int | None:
    """Tool life group that a T-word calls, None for an ordinary tool: T21 with 20 is group 1 (page 21-14).

    A word equal to Tool Number/Group Boundary is group 0 by the text (erratum e-131-group0).
    """
    group = whole("The T-word", word, 0) - whole("Tool Number/Group Boundary", boundary, 0)
    return group if group >= 0 else None


def tolerance_band(position: float, tolerance: float) -> tuple[float, float]:
    """Lowest and highest position at which a skip or probe signal counts (pages 21-9 and 29-5).

    The tolerance on either side of the programmed end of a G37, or of the expected firing point of a G38.
    """
    around = not_negative("The tolerance", tolerance)
    return finite("The position", position) - around, position + around


def gauge_difference(programmed: float, actual: float) -> float:
    """Value that a G37 tool gauging cycle finds: programmed end less actual position (page 21-10)."""
    return finite("The programmed position", programmed) - finite("The actual position", actual)


def gauged_offset(current: float, difference: float, add: bool) -> float:
    """Entry of the offset table after G37: the value is added to it, or takes its place (page 21-10)."""
    return finite("The value of the cycle", difference) + (finite("The offset", current) if add else 0.0)


def fewest_pockets(current: float, wanted: float, pockets: float) -> int:
    """Pockets that a bidirectional magazine moves by for a tool: the faster way round (page 21-13).

    Pockets are numbered from 1; "the fastest" is taken for the fewest, which is implied, not printed.
    """
    every = whole("The number of tool pockets", pockets)
    here, there = whole("The current pocket", current), whole("The wanted pocket", wanted)
    if max(here, there) > every:
        raise ValueError(f"The magazine has {every} pockets, not {max(here, there)}.")
    way = abs(there - here)
    return min(way, every - way)


def offset_change_allowed(old: float, new: float, limit: float) -> bool:
    """Whether an operator may change a tool offset so far (pages 21-16 and 21-17).

    Not checked where the old or the new value is zero, so that an offset can be entered and cleared.
    """
    change = abs(finite("The new offset", new) - finite("The old offset", old))
    return not old or not new or change <= not_negative("The maximum change", limit)
