"""The Open CNC Interface: chapter 34."""

from __future__ import annotations

from collections.abc import Iterable

from amp_studio.validate import whole

OVERHEAD_BYTES = 28
"""Watchlist bytes of an item besides its data (page 34-4)."""

DATA_TYPE_BYTES = {
    "BOOL": 1,
    "BYTE": 1,
    "SINT": 1,
    "USINT": 1,
    "INT": 2,
    "UINT": 2,
    "DINT": 4,
    "UDINT": 4,
    "LINT": 8,
    "STRNG": 128,
    "LREAL": 8,
    "DATE": 8,
    "TIMEOFDAY": 8,
    "LTIME": 8,
    "STRUCT": 8,
    "REAL": 4,
}
"""Watchlist bytes by data type (page 34-4); a command request takes none."""


def watchlist_bytes(items: Iterable[tuple[str, float]]) -> int:
    """Bytes of a watchlist: for each item 28 + array indices x bytes of its data type (page 34-4).

    ``items`` are (data type, array indices), with 1 for what is no array. Command requests take no bytes and
    are left out.
    """
    return sum(_item_bytes(data_type, indices) for data_type, indices in items)


def _item_bytes(data_type: str, indices: float) -> int:
    if data_type not in DATA_TYPE_BYTES:
        raise ValueError(f"{data_type!r} is no data type of the watchlist: {', '.join(DATA_TYPE_BYTES)}.")
    return OVERHEAD_BYTES + whole("The number of array indices", indices) * DATA_TYPE_BYTES[data_type]
