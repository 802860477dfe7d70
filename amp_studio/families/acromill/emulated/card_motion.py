"""The machine behind an emulated ACR card: its settings make the axes,
and words of the terminal and of AcroMill's screens move them.

Page 91 lists JOG, MOV, HALT, RES and their words, and prints no form of them: how they are written is ASSUMED
here, and so is that their figures are units, units/s and units/s2. Home and MDI are screens of AcroMill on
the PC (pages 43 and 48), which sends its own words to the card.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from amp_studio.families.acromill.law import LAW
from amp_studio.families.acromill.lines.content import FAMILY, AcrContent, CardContent, plain_figure, settings
from amp_studio.files import ParameterFile, new_file
from amp_studio.formats import system_of
from amp_studio.sim import Ramp, SimulatedAxis, SimulatedMachine, SimulationError, bind_axis

from .settings import AXES, CardSettings, CommandError, number_text, single

MM = {"inch": 25.4, "metric": 1.0}
"""mm of a unit of the card, which is an inch as delivered (page 61)."""
ENCODER, ENCODER_STEP = 6144, 16  # encoder position of an axis, pulses (page 114)
PRIMARY, SECONDARY, SETPOINT_STEP = (
    12294,
    12295,
    256,
)  # setpoints before and behind the compensation (page 107)
_NOT_EXCESS, _BIT_STEP = 769, 32  # bits for not excess error (page 113)
_RATES = ("VEL", "ACC", "DEC", "STP")
WORDS = frozenset(("JOG", "MOV", "HALT", "RES", *_RATES))
_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)"
_ARGUMENT = re.compile(rf"\s*([{AXES}])\s*({_NUMBER})?(?![\w.])", re.IGNORECASE)
_MDI = re.compile(rf"G(0|00|1|01|28)((?:\s*[{AXES}F]\s*{_NUMBER})*)\s*", re.IGNORECASE)
_MDI_WORD = re.compile(rf"([{AXES}F])\s*({_NUMBER})", re.IGNORECASE)


class CardMotion:
    """The axes of a card; each is made when it is first moved.

    ``file`` has what AcroMill on the PC is set up with; None as delivered.
    """

    def __init__(self, settings: CardSettings, file: ParameterFile | None = None) -> None:
        self._settings = settings
        self._set_up = new_file(FAMILY) if file is None else file
        self._system = system_of(self._set_up)
        self._unit = MM[self._system]
        self._machine = SimulatedMachine()
        self._bound: dict[str, str] = {}
        self._file: ParameterFile | None = None
        self._rates: dict[str, float] = {}
        """Of JOG ("JOG VEL X") and of moves ("VEL"), as far as they are set."""
        self._homing: list[list[str]] = []
        """Axes that are still homed, those of one priority together (page 65)."""
        self._moves: list[dict[str, float]] = []
        """Moves at rapid that follow the present one: to the intermediate point,
        to the reference point (page 28)."""

    # -- what it is doing -------------------------------------------------------------------------

    def parameter(self, number: int) -> float | None:
        """Return a system parameter that is alive; None for others."""
        if 0 <= number - ENCODER < ENCODER_STEP * len(AXES) and (number - ENCODER) % ENCODER_STEP == 0:
            return self._pulses((number - ENCODER) // ENCODER_STEP, measured=True)
        for first in (PRIMARY, SECONDARY):
            if 0 <= number - first < SETPOINT_STEP * len(AXES) and (number - first) % SETPOINT_STEP == 0:
                return self._pulses((number - first) // SETPOINT_STEP, measured=False)
        return None

    def bit(self, number: int) -> bool | None:
        """Return whether an axis is within its EXC; None for other bits."""
        place, rest = divmod(number - _NOT_EXCESS, _BIT_STEP)
        if rest or not 0 <= place < len(AXES):
            return None
        axis = self._machine.axes.get(AXES[place])
        return axis is None or axis.is_enabled

    def status(self) -> str:
        """Return a line for the operator."""
        where = " ".join(
            f"{name} {axis.position / self._unit:.4f}{' homed' if axis.is_homed else ''}"
            f"{f' {axis.alarm.code}' if axis.alarm else ''}"
            for name, axis in self._machine.axes.items()
        )
        return f"{'moving' if self._machine.is_busy else 'at rest'}; {where or 'no axis has moved'}"

    def _pulses(self, place: int, *, measured: bool) -> float:
        name = AXES[place]
        axis = self._machine.axes.get(name)
        if axis is None:
            return 0.0
        # PPU is pulses for one unit of the card, positions here are in mm.
        pulses = float(self._settings.values[f"PPU {name}"]) / self._unit
        return float(round(axis.position * pulses)) if measured else axis.command * pulses

    # -- words of the terminal -----------------------------------------------------------------------

    def execute(self, word: str, rest: str) -> list[str]:
        """Obey a line with one of WORDS; returns what the card shows. Raises CommandError."""
        try:
            if word == "HALT":
                self.stop()
            elif word == "RES":
                for name, figure in _arguments(rest):
                    self._axis(name).define((figure or 0.0) * self._unit)
            elif word == "MOV":
                self._forget_next()
                self._move(
                    {name: (figure or 0.0) * self._unit for name, figure in _arguments(rest)}, self._feed()
                )
            elif word == "JOG":
                what, _, arguments = rest.strip().partition(" ")
                return self._jog(what.upper(), arguments)
            else:
                return self._rate(word, rest)
        except SimulationError as error:
            raise CommandError(_words(str(error))) from None
        return []

    def _rate(self, name: str, text: str) -> list[str]:
        text = text.strip()
        if not text:
            return [f"{self._rates.get(name, 0.0):.7g}"]
        if re.fullmatch(_NUMBER, text) is None or float(text) <= 0.0:
            raise CommandError("Syntax error")
        self._rates[name] = float(text)
        return []

    def _feed(self) -> float | None:
        rate = self._rates.get("VEL")
        return None if rate is None else rate * self._unit

    def _jog(self, what: str, rest: str) -> list[str]:
        """Obey a JOG command for each axis that it names; returns the lines of the answer."""
        answer = []
        for name, figure in _arguments(rest):
            key = f"JOG {what} {name}"
            if what in _RATES:
                answer += self._rate(key, "" if figure is None else repr(figure))
                continue
            axis, (speed, ramp) = self._axis(name), self._jogging(name)
            self._forget_next()
            if what in ("FWD", "REV"):
                axis.go(speed if what == "FWD" else -speed, ramp)
            elif what == "OFF":
                axis.stop(ramp)
            elif what in ("ABS", "INC") and figure is not None:
                axis.move(figure * self._unit + (axis.command if what == "INC" else 0.0), speed, ramp)
            else:
                raise CommandError("Syntax error")
        return answer

    def _jogging(self, name: str) -> tuple[float, Ramp]:
        """Return speed and ramp of a jog: what JOG has set, else the values of page 67 as delivered."""
        law = self._axis(name).law
        assert law.jogging is not None
        jogging = law.jogging()
        assert jogging.ramp is not None
        rates = {
            word: self._rates[f"JOG {word} {name}"] * self._unit
            for word in _RATES
            if f"JOG {word} {name}" in self._rates
        }
        ramp = replace(
            jogging.ramp,
            acceleration=rates.get("ACC", jogging.ramp.acceleration),
            deceleration=rates.get("DEC", jogging.ramp.deceleration),
        )
        return rates.get("VEL", next(iter(jogging.speeds.values()))), ramp

    # -- screens of AcroMill -----------------------------------------------------------------------

    def home(self, axes: str) -> str:
        """Home axes as the HOME key does (page 48), by their priority (page 65)."""
        names = [name for name in AXES if name in (axes.upper() or "XYZ")]
        if not names or set(axes.upper()) - set(AXES):
            raise ValueError("home takes the letters of axes")
        order: dict[int, list[str]] = {}
        for name in names:
            # All axes before the first one moves: one that cannot be homed refuses the whole order.
            self._law_homing(name)
            order.setdefault(self._priority(name), []).append(name)
        order.pop(0, None)  # an axis that need not home (page 65)
        self._forget_next()
        self._homing = [order[priority] for priority in sorted(order)]
        self._home_next()
        return f"homing {', '.join('+'.join(group) for group in order.values()) or 'no axis'}"

    def mdi(self, block: str) -> str:
        """Execute a block of the MDI screen: G0, G1 and G28 (page 28)."""
        match = _MDI.fullmatch(block.strip())
        if match is None:
            raise ValueError("of MDI blocks this card has G0, G1 and G28 with axes and F")
        words = {word.upper(): float(figure) for word, figure in _MDI_WORD.findall(match[2])}
        feed = words.pop("F", None)
        targets = {name: figure * self._unit for name, figure in words.items()}
        follow: list[dict[str, float]] = []
        if match[1] == "28":
            homed = [name for name in targets if self._axis(name).is_homed]
            if len(homed) < len(targets):
                raise ValueError("home the axes first: G28 goes to the reference point")
            follow = [{name: self._reference(name) for name in targets}]
        elif match[1] in ("1", "01") and not feed:
            raise ValueError("G1 needs a feedrate F")
        self._homing, self._moves = [], follow
        linear = feed is not None and match[1] in ("1", "01")
        self._move(targets, feed * self._unit / 60.0 if linear and feed else None)
        return block

    def _reference(self, name: str) -> float:
        law = self._axis(name).law
        assert law.homing is not None
        return law.homing().coordinate

    def _law_homing(self, name: str) -> None:
        try:
            law = self._axis(name).law
            assert law.homing is not None
            law.homing()
        except SimulationError as error:
            raise ValueError(str(error)) from None

    def _priority(self, name: str) -> int:
        """Return the group in which an axis is homed; 0 for one that need not home."""
        value = self._content().evaluation.canonical(("home.priority", name))
        return int(value) if isinstance(value, float) else 1

    def _home_next(self) -> None:
        for name in self._homing.pop(0) if self._homing else ():
            axis = self._axis(name)
            axis.travel = None
            assert axis.law.homing is not None
            homing = axis.law.homing()
            axis.home(homing, homing.ramp or next(iter(axis.law.ramps.values())))

    # -- time ------------------------------------------------------------------------------------------

    def advance(self, duration: float) -> None:
        """Let time pass, s."""
        self._machine.advance(duration)
        if self._machine.is_busy:
            return
        try:
            if self._homing:
                self._home_next()
            elif self._moves:
                self._move(self._moves.pop(0), None)
        except (
            SimulationError
        ):  # settings that came meanwhile make no axis: nothing follows, the card lives on
            self._forget_next()

    def stop(self) -> None:
        """Stop every axis."""
        self._forget_next()
        for axis in self._machine.axes.values():
            axis.stop(next(iter(axis.law.ramps.values())))

    def trip(self, name: str) -> None:
        """Have the drive of an axis trip: its excess error shows it once it is moved. Raises ValueError."""
        try:
            self._axis(name).fail("drive")
        except (SimulationError, KeyError) as error:
            raise ValueError(str(error)) from None

    def switch_off(self) -> None:
        """Lose the power."""
        self._machine.axes.clear()
        self._rates.clear()
        self._forget_next()

    # -- small parts -----------------------------------------------------------------------------------

    def _forget_next(self) -> None:
        """Forget what was to follow the present move: another order has come."""
        self._homing, self._moves = [], []

    def _move(self, targets: dict[str, float], feed: float | None) -> None:
        for name in targets:
            self._axis(name)
        self._machine.line(targets, feed)

    def _axis(self, name: str) -> SimulatedAxis:
        """Return an axis as the settings make it now; one that EXC has stopped is taken up again.
        Raises SimulationError.
        """
        # Settings that changed while an axis moves count from its next order on.
        if self._settings.values != self._bound and not self._machine.is_busy:
            self._bound, self._file = dict(self._settings.values), None
            for other, axis in self._machine.axes.items():
                axis.bind(bind_axis(self._content(), LAW, other))
        if name not in self._machine.axes:
            self._machine.axes[name] = SimulatedAxis(bind_axis(self._content(), LAW, name))
        axis = self._machine.axes[name]
        if axis.alarm is not None and not self._machine.is_busy:
            axis.reset()
        # Soft limits are "legal travel from home position" (page 60).
        axis.travel = axis.law.travel() if axis.is_homed and axis.law.travel is not None else None
        return axis

    def _content(self) -> ParameterFile:
        if self._file is None:
            card = _content_of(self._settings.values, self._system)
            self._file = self._set_up.copy()  # what is not on the card
            self._file.set_checked(AcrContent().decode(card.written()).values, force="the card takes it")
        return self._file


def _content_of(values: Mapping[str, str], system: str) -> CardContent:
    """Return what a card with these settings contains."""
    card = CardContent(system)
    for setting in settings():
        text = values.get(setting.name, "")
        card.figures[setting.name] = tuple(map(plain_figure, text.split(", "))) if text else ()
    return card


def set_up_figures(file: ParameterFile, delivered: Mapping[str, str]) -> dict[str, str]:
    """Return the settings of a card to which a file was sent as it was delivered; raises ImageError."""
    card = _content_of(delivered, system_of(file))
    sent = CardContent.read(AcrContent().encode(file, card.written()))
    return {
        name: ", ".join(number_text(single(figure)) for figure in figures)
        for name, figures in sent.figures.items()
    }


def _arguments(rest: str) -> Iterator[tuple[str, float | None]]:
    """Yield axis and figure of each argument; raises CommandError."""
    at = 0
    if not rest.strip():
        raise CommandError("Axis expected")
    while at < len(rest.rstrip()):
        match = _ARGUMENT.match(rest, at)
        if match is None:
            raise CommandError("Syntax error")
        yield match[1].upper(), None if match[2] is None else float(match[2])
        at = match.end()


def _words(text: str) -> str:
    """Return an error without digits, as every error of this card is."""
    return re.sub(r"[^A-Za-z ,.;:'()/-]", "", text)[:100]
