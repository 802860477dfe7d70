"""A scene in another language: its titles, scales, names, values and notes; the names of parameters stay."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from .scene import Scale, Scene

PhraseWords = Callable[[str], str]
"""English phrase -> the phrase of a language, or the same."""


def scene_in_words(scene: Scene, words: PhraseWords, unit: PhraseWords = str) -> Scene:
    """Return a scene with its phrases, and the units of its scales, in a language."""

    def scale(own: Scale) -> Scale:
        rows = tuple((at, name, unit(end)) for at, name, end in own.rows)
        return replace(own, label=words(own.label) if own.label else "", unit=unit(own.unit), rows=rows)

    texts = tuple(replace(t, text=words(t.text), value=words(t.value)) for t in scene.texts)
    notes = tuple(replace(note, text=words(note.text)) for note in scene.notes)
    return replace(
        scene,
        title=words(scene.title),
        subtitle=words(scene.subtitle),
        x=scale(scene.x),
        y=scale(scene.y),
        texts=texts,
        handles=tuple(replace(handle, value=words(handle.value)) for handle in scene.handles),
        notes=notes,
        curves=tuple(replace(curve, name=words(curve.name)) for curve in scene.curves),
        levels=tuple(mark._replace(name=words(mark.name)) for mark in scene.levels),
        marks=tuple(mark._replace(name=words(mark.name)) for mark in scene.marks),
    )
