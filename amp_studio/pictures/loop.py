"""The loops of an axis as a diagram: what the command passes on its way to the machine, with the parameters
that act there and the steady signals at one speed.

The blocks and their order are facts (`LoopRoles`); a block is a row, its parameters are beside it by their
numbers, so that the picture is readable where it is low; a click on one leads to it. The signals come from
the law of the axis and from its machine, as in the scenarios.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from amp_studio.drawing import FilledArea, Polyline, Scale, Scene, ShapeSort, Text
from amp_studio.files import ParameterFile
from amp_studio.schema import LoopBlock, LoopRoles, convert
from amp_studio.sim import SimulationError, bind_axis, law_of, steady_signals, value_text

from .figures import ValueReader
from .shapes import SceneShapes

LEFT, RIGHT = 0.7, 2.5
"""Sides of the boxes; the picture is 10 wide, the parameters begin beside them."""
_NAMES = 2.95
BACK, AHEAD, PAST = 0.15, 0.42, 2.75
"""Where the lines run that go back, ahead from the command, and past the boxes."""
ROOM = 0.35
"""Between two rows, of the height of a line of text."""
HEAD = 0.1
"""Half an arrowhead."""
_NUMBERED, _NAMED = 4, 3
"""Values beside each other, by their numbers and by their names; a block of more has several lines."""

Signal = tuple[float, str]


def draw_loop(file: ParameterFile, roles: LoopRoles, part: str, like: Scene | None = None) -> Scene:
    """Return the diagram of an axis; ``part`` is the axis, or ``AXIS@PERCENT`` of the rapid feedrate."""
    axis, _, percent = part.partition("@")
    figures = ValueReader(file)
    signals = _signals(figures, axis, float(percent or 100.0) / 100.0)
    diagram = _LoopDiagram(figures, roles, axis, signals)
    x = like.x if like else Scale("", "", 0.0, 10.0, is_written=False)
    y = like.y if like else Scale("", "", 0.0, diagram.height, is_written=False)
    speed = signals.get("command_velocity")
    at = f", signals at {value_text(*speed)}" if speed else ""
    figures.add_note(roles.note, is_remark=True)
    title = f"{figures.axis(axis)}{at}, page {roles.page}"
    return diagram.shapes.scene(
        "loop", part, "Loops", title, x, y, look="rings", rows=math.ceil(diagram.height)
    )


def _placed(rows: list[LoopBlock], place: str) -> list[LoopBlock]:
    return [block for block in rows if block.place == place]


def _signals(figures: ValueReader, axis: str, share: float) -> Mapping[str, Signal]:
    """Return the steady signals at a share of the rapid feedrate; that there are none is a note."""
    file = figures.file
    try:
        bound = bind_axis(file, law_of(file.schema.family.family), axis)
        if bound.feedrate is None:
            raise SimulationError("No rapid feedrate is set")
        found = steady_signals(bound, share * bound.feedrate)
        return {name: _in_units_of(file, *signal) for name, signal in found.items()}
    except SimulationError:
        figures.add_note("No signals: this axis cannot be simulated as it is set", is_remark=True)
        return {}


def _in_units_of(file: ParameterFile, value: float, unit: str) -> Signal:
    """Return a signal in inches where the file is in inches."""
    inches = unit.replace("mm", "in", 1) if file.header.units == "inch" and unit.startswith("mm") else unit
    return convert(value, unit, inches) if inches != unit else value, inches


class _LoopDiagram:
    """The rows of a diagram while it is drawn, from the top: command, what is added ahead, the loop, and
    what goes back.
    """

    def __init__(
        self, figures: ValueReader, roles: LoopRoles, axis: str, signals: Mapping[str, Signal]
    ) -> None:
        self.shapes, self._figures, self._axis, self._signals = SceneShapes(figures), figures, axis, signals
        order = ("command", "ahead", "chain", "back")
        # The sort is stable: blocks of one place stay in the order of the facts.
        rows = sorted(roles.blocks, key=lambda block: order.index(block.place))
        lines = [self._lines(block) for block in rows]
        machine = figures.file.machine_schema
        is_numbered = any(text.address and machine.number(text.address) for each in lines for text in each)
        self._across = _NUMBERED if is_numbered else _NAMED
        self.height = sum(self._rows(each) + ROOM for each in lines) + ROOM
        top, self._places = self.height - ROOM, dict[str, tuple[float, float]]()
        for block, texts in zip(rows, lines, strict=True):
            bottom = top - self._rows(texts)
            self._box(block, texts, bottom, top)
            self._places[block.name] = (bottom, top)
            top = bottom - ROOM
        self._join(rows)

    def _rows(self, texts: list[Text]) -> int:
        return max(-(-len(texts) // self._across), 1)

    def _lines(self, block: LoopBlock) -> list[Text]:
        """Return the parameters of a block with their values, and the signal behind it: by their numbers, one
        alone with its name.
        """
        lines = []
        machine = self._figures.file.machine_schema
        for parameter in block.params:
            figure = self._figures.figure(parameter, self._axis, quiet=True)
            name = self._figures.file.schema.parameters[parameter].name
            if figure is not None:
                text = figure.text if not figure.inactive else f"{figure.text}, inactive"
                sort: ShapeSort = "error" if figure.wrong else "dim" if figure.inactive else "ink"
                is_alone = len(block.params) == 1 and not block.signal
                label = figure.label if is_alone else machine.number(figure.address) or name
                lines.append(Text((_NAMES, 0.0), label, text, "left", figure.address, sort))
        if (signal := self._signals.get(block.signal)) is not None:
            name = block.signal.replace("_", " ").removeprefix("steady ")
            lines.append(Text((_NAMES, 0.0), name, value_text(*signal), "left", sort="now"))
        return lines

    def _box(self, block: LoopBlock, texts: list[Text], bottom: float, top: float) -> None:
        """Draw a block with its name, and its texts beside it in rows from the top."""
        self.shapes.areas.append(FilledArea(LEFT, bottom, RIGHT, top, "overlap"))
        edge = ((LEFT, bottom), (RIGHT, bottom), (RIGHT, top), (LEFT, top), (LEFT, bottom))
        self.shapes.lines.append(Polyline(edge))
        middle = 0.5 * (LEFT + RIGHT)
        self.shapes.texts.append(Text((middle, 0.5 * (bottom + top)), block.name, "", "middle"))
        for n, text in enumerate(texts):
            row, column = divmod(n, self._across)
            place = (_NAMES + column * (10.0 - _NAMES) / self._across, top - row - 0.5)
            self.shapes.texts.append(Text(place, text.text, text.value, "beside", text.address, text.sort))

    def _join(self, rows: list[LoopBlock]) -> None:
        """Draw the lines between the boxes, in the direction of the signals."""
        (command, *_), chain, ahead = (_placed(rows, place) for place in ("command", "chain", "ahead"))
        for before, after in zip((command, *chain), chain, strict=False):
            if before is command and ahead:  # past the rows of what is added ahead
                self._along(PAST, command, after, RIGHT)
            else:
                self._down(before, after)
        for block in rows:
            into = next((each for each in chain if each.name == block.into), chain[0])
            if block.place == "ahead":
                self._along(AHEAD, command, block, LEFT)
                self._along(PAST, block, into, RIGHT, dashed=True)
            elif block.place == "back":
                self._down(rows[rows.index(block) - 1], block)
                self._along(BACK, block, into, LEFT)

    def _down(self, above: LoopBlock, below: LoopBlock) -> None:
        middle = 0.5 * (LEFT + RIGHT)
        start, end = self._places[above.name][0], self._places[below.name][1]
        self.shapes.lines.append(Polyline(((middle, start), (middle, end))))
        self.shapes.lines.append(
            Polyline(((middle - HEAD, end + 2.0 * HEAD), (middle, end), (middle + HEAD, end + 2.0 * HEAD)))
        )

    def _along(
        self, lane: float, start: LoopBlock, end: LoopBlock, side: float, *, dashed: bool = False
    ) -> None:
        """Draw a line from the side of one box along a lane to the same side of another one."""
        a, b = (sum(self._places[each.name]) / 2.0 for each in (start, end))
        points = ((side, a), (lane, a), (lane, b), (side, b))
        self.shapes.lines.append(Polyline(points, "dim" if dashed else "ink", dashed))
        back = side + HEAD * (-1.0 if side == LEFT else 1.0)
        self.shapes.lines.append(Polyline(((back, b + 2.0 * HEAD), (side, b), (back, b - 2.0 * HEAD))))
