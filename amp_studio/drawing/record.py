"""A scene as JSON, for other programs."""

from __future__ import annotations

import math
from typing import Any

from amp_studio.drawing.scene import Drag, Handle, Scale, Scene
from amp_studio.schema import Address


def scene_json(scene: Scene) -> dict[str, Any]:
    """Return a scene as plain data: what is drawn in world units, handles with their ranges, notes."""
    return {
        "picture": scene.name,
        "part": scene.part,
        "title": scene.title,
        "x": _scale(scene.x),
        "y": _scale(scene.y),
        "areas": [
            {"name": a.name, "meaning": a.sort, "x": [a.left, a.right], "y": [a.bottom, a.top]}
            for a in scene.areas
        ],
        "lines": [{"meaning": line.sort, "points": [list(p) for p in line.points]} for line in scene.lines],
        "marks": [{"kind": dot.kind, "at": list(dot.at)} for dot in scene.dots],
        "labels": [
            {"text": text.text, "value": text.value, "at": list(text.at), **_named(text.address)}
            for text in scene.texts
        ],
        "handles": [_handle(handle) for handle in scene.handles],
        "notes": [{"text": note.text, "wrong": note.wrong, **_named(note.address)} for note in scene.notes],
        "drawn_from": [_named(address) for address in scene.drawn_from],
    }


def _named(address: Address | None) -> dict[str, str]:
    return {} if address is None else {"id": address[0], "instance": address[1]}


def _scale(scale: Scale) -> dict[str, Any]:
    return {"label": scale.label, "unit": scale.unit, "low": scale.low, "high": scale.high, "log": scale.log}


def _handle(handle: Handle) -> dict[str, Any]:
    return {
        "label": handle.label,
        "value": handle.value,
        "at": list(handle.at),
        "moves": [_drag(drag) for drag in handle.drags],
    }


def _drag(drag: Drag) -> dict[str, Any]:
    """Return what a handle changes and between which values, without infinite bounds: JSON has none."""
    low, high = (
        bound if bound is not None and math.isfinite(bound) else None for bound in (drag.low, drag.high)
    )
    return {
        **_named(drag.address),
        "along": drag.along,
        "unit": drag.unit,
        "step": drag.step,
        "range": [low, high],
    }
