"""The files beside a migrated configuration: numbered parameters (.var) and tool table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from amp_studio.meaning import AxisMeaning, ConceptFigure, Graded, MachineMeaning, WrittenMachine

from .kinematics import LETTERS

_SYSTEMS = 9
"""Work coordinate systems, G54 to G59.3."""


def numbered_parameters(axes: Iterable[tuple[AxisMeaning, str]], out: WrittenMachine) -> str:
    """Return the file of numbered parameters for axes with their new letters: G28 (5161), G30 (5181)
    and the work coordinate systems (5221 and on), in machine coordinates.
    """
    bases = (5161, 5181, 5211, *(5221 + 20 * n for n in range(_SYSTEMS)))
    rows = {number: 0.0 for base in bases for number in range(base, base + 9)}
    rows |= {5210: 0.0, 5220: 1.0, **{5230 + 20 * n: 0.0 for n in range(_SYSTEMS)}}
    for axis, letter in axes:
        rows |= _positions(axis, LETTERS.index(letter), out)
        rows |= _offsets(axis, LETTERS.index(letter), out)
    return "".join(f"{number}\t{value:.6f}\n" for number, value in sorted(rows.items()))


def _positions(axis: AxisMeaning, place: int, out: WrittenMachine) -> dict[int, float]:
    """Return number -> value of the positions of G28 and G30 of the axis at a place, and grade them."""
    rows = {}
    first = "home.first" if "home.first" in axis.figures else "home.coordinate"
    for concept, base in ((first, 5161), ("home.second", 5181)):
        value = axis.number(concept)
        if value is not None:
            rows[base + place] = value
            if concept != "home.coordinate":  # which is graded with the homing
                out.grade(axis, concept, "exact", f"#{base + place}", f"{value:.6f}")
    return rows


def _offsets(axis: AxisMeaning, place: int, out: WrittenMachine) -> dict[int, float]:
    """Return number -> offset of each work coordinate system of the axis at a place, and grade them."""
    offsets = {
        5221 + 20 * n + place: value
        for n, value in enumerate(_list(axis.figures, "work.offsets")[:_SYSTEMS])
        if value is not None
    }
    texts = ", ".join(f"{value:.6f}" for value in offsets.values())
    out.grade(axis, "work.offsets", "exact", ", ".join(f"#{number}" for number in offsets), texts)
    return offsets


def tool_table(machine: MachineMeaning, out: WrittenMachine) -> str:
    """Return the tool table: the radii of the old control, with their wear, as diameters."""
    radii, worn = _list(machine.figures, "tool.radius"), _list(machine.figures, "tool.wear")
    rows = []
    for n, radius in enumerate(radii):
        if radius is not None:
            loss = (worn[n] if n < len(worn) else None) or 0.0
            rows.append(f"T{n + 1} P{n + 1} D{2.0 * (radius + loss):.6f}\n")
    for concept in ("tool.radius", "tool.wear"):
        ways = ("a radius and its wear", "a diameter with the wear in it", "neither")
        out.graded.append(Graded("", concept, "approximate", "tool.tbl", f"{len(rows)} × D", *ways))
    return "".join(rows)


def _list(figures: Mapping[str, ConceptFigure], concept: str) -> list[float | None]:
    figure = figures.get(concept)
    return figure.value if figure and isinstance(figure.value, list) else []
