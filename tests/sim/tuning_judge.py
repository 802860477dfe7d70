"""Tuned axes judged by python-control: ``make judged`` takes thirty random machines.

Nothing here is of the simulator. The laws of all families with gains are written again, from docs/simulation
(AcroMill: pages 59, 113, 128; 57C422B: the assumed loop; NUM: 6-14; Syntec: 1.5.3; 9/PC: 7-25, 7-54, 7-56,
7-69), the machine is motor and load on a spring behind a current loop or a drive with its own velocity loop,
sampled by its own matrix exponential with the delay in it (K. J. Åström, B. Wittenmark, Computer-Controlled
Systems, 1997, 3.2). Compared are margins, Ms of both loops and the way of the load under a torque, before and
after ``tune``.
"""

import math
import random
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from amp_studio.files import open_file
from amp_studio.schema import Value
from amp_studio.sim import Trace, address_of, simulate

EXAMPLES = Path(__file__).parents[2] / "examples"
INCH = 25.4
TOLERANCE = 0.01
"""Share by which a figure may be off: the printed one is sought on a grid and refined."""
UNSTABLE = 1.0 + 1e-9


@dataclass(frozen=True)
class JudgedAxis:
    """An axis of an example, and what its manual (or the assumed drive) has beside its gains."""

    example: str
    axis: str
    gains: tuple[str, ...]
    period: float
    """s between two samples of its loops."""
    per_unit: float = 1.0
    """Counts of the feedback for 1 u."""
    unit: str = " mm/s2"
    speed: float = 0.0
    """u/s for 1 of the output, of a drive with a velocity loop."""
    current: float = 0.0
    """Hz of the current loop; 0 for one without a lag."""


SERVO = "servo.velocity_proportional_gain", "servo.velocity_integral_gain", "servo.initial_gain"
AXES = {
    "acromill": JudgedAxis(
        "acromill-router/ROUTER.amp",
        "X",
        ("servo.p_gain", "servo.i_gain", "servo.d_gain"),
        400e-6,
        1.0 / 0.001240234375,
    ),
    "57c422b": JudgedAxis(
        "57c422b-label-press/LABEL_PRESS.amp",
        "X",
        ("gain.velocity", "gain.proportional", "gain.integral"),
        1.25e-3,
        unit="",
    ),
    # 6000 mm/min at 9 V, in thousandths of a millimetre.
    "num": JudgedAxis(
        "num-1060-mill/MILL_1060.amp", "0", ("servo.loop_gain",), 5e-3, 1000.0, speed=100.0 / 9.0
    ),
    # An eighth of 1.966 ms; the output is in mm/min.
    "syntec": JudgedAxis(
        "syntec-mill/SYNTEC_MILL.amp", "1", ("servo.loop_gain",), 1.966e-3 / 8.0, speed=1.0 / 60.0
    ),
    "9pc": JudgedAxis("mill-1394/MILL_1394.amp", "1", SERVO, 1e-3, current=200.0),
}
"""Family -> the axis that is judged."""
RADIANS = 2.0 * math.pi / 12.7
"""rad of the 9/PC's motor for 1 mm of its screw."""
TORQUE_FILTER = 200.0
"""Hz, of the 9/PC as delivered."""


@dataclass(frozen=True)
class Machine:
    """Motor and load in the unit of the axis and s; torque in V."""

    acceleration: float
    friction: float
    """V for 1 u/s."""
    delay: float
    ratio: float = 0.0
    resonance: float = 0.0
    damping: float = 0.0
    current: float = 0.0
    """Hz of the current loop; 0 for one without a lag."""
    at_motor: float = 0.0
    """Share of the friction that is at the motor."""
    speed: float = 0.0
    """u/s for 1 of the output, of a drive with a velocity loop."""
    bandwidth: float = 0.0
    """Hz of that velocity loop."""
    integral: float = 0.0
    """1/s"""

    def settings(self, unit: str) -> dict[str, str]:
        """Return it as settings of the simulator."""
        found = {
            "model.acceleration_per_output": f"{self.acceleration!r}{unit}",
            "model.viscous_friction": f"{self.friction * 1000.0 / 60.0!r}",
            "model.delay": f"{1e3 * self.delay!r} ms",
        }
        if self.ratio:
            found |= {
                "model.inertia_ratio": f"{self.ratio!r}",
                "model.resonance": f"{self.resonance!r} Hz",
                "model.damping": f"{self.damping!r}",
            }
        if self.current:
            found |= {"model.current_bandwidth": f"{self.current!r} Hz"}
        if self.speed:
            found |= {
                "model.velocity_bandwidth": f"{self.bandwidth!r} Hz",
                "model.velocity_integral": f"{self.integral!r}",
            }
        return found

    def driven(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the matrices of masses and drive: from (output, torque on the load) to (motor, load)."""
        a, b, c = self.matrices()
        size = len(a)
        if not (self.current or self.speed):
            return a, b, c
        grown, drive = np.zeros((size + 1, size + 1)), np.zeros((size + 1, 2))
        grown[:size, :size], drive[:size, 1] = a, b[:, 1]
        if self.current:
            rate = 2.0 * math.pi * self.current
            grown[:size, size], grown[size, size], drive[size, 0] = b[:, 0], -rate, rate
        else:  # torque = gain (e + integral ∫e), of the error e of the motor's speed
            gain = 2.0 * math.pi * self.bandwidth / self.acceleration
            grown[:size, 1] -= gain * b[:, 0]
            grown[:size, size] = gain * self.integral * b[:, 0]
            drive[:size, 0] = gain * self.speed * b[:, 0]
            grown[size, 1], drive[size, 0] = -1.0, self.speed
        return grown, drive, np.hstack([c, np.zeros((2, 1))])

    def matrices(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return a, b (torque of the motor, torque on the load) and c (motor, load)."""
        if not self.ratio:
            a = np.array([[0.0, 1.0], [0.0, -self.acceleration * self.friction]])
            b = np.array([[0.0, 0.0], [self.acceleration, self.acceleration]])
            return a, b, np.array([[1.0, 0.0], [1.0, 0.0]])
        motor, load = (
            self.acceleration * (1.0 + self.ratio),
            self.acceleration * (1.0 + self.ratio) / self.ratio,
        )
        rate, rubs = 2.0 * math.pi * self.resonance, self.at_motor * self.friction
        stiff, slip = rate**2 / (motor + load), 2.0 * self.damping * rate / (motor + load)
        a = np.array(
            [
                [0.0, 1.0, 0.0, 0.0],
                [-motor * stiff, -motor * (slip + rubs), motor * stiff, motor * slip],
                [0.0, 0.0, 0.0, 1.0],
                [load * stiff, load * slip, -load * stiff, -load * (slip + self.friction - rubs)],
            ]
        )
        b = np.array([[0.0, 0.0], [motor, 0.0], [0.0, 0.0], [0.0, load]])
        return a, b, np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]])

    def sampled(self, period: float, control: ModuleType) -> Any:
        """Return the machine from (output, push on the load) to (motor, load), sampled."""
        from scipy.linalg import expm

        a, b, c = self.driven()
        size = len(a)

        def constant(span: float) -> tuple[np.ndarray, np.ndarray]:
            whole = expm(np.block([[a, b], [np.zeros((2, size + 2))]]) * span)
            return whole[:size, :size], whole[:size, size:]

        samples = math.ceil(self.delay / period - 1e-9)
        late = samples * period - self.delay  # of a sample, in which the newer of two outputs acts
        phi, gamma = constant(period)
        newer = constant(late)[1][:, :1]
        older = constant(late)[0] @ constant(period - late)[1][:, :1]
        grown = np.zeros((size + samples, size + samples))
        drive = np.zeros((size + samples, 2))
        grown[:size, :size], drive[:size, 1] = phi, gamma[:, 1]
        # The states behind those of the machine are the outputs of before, the newest first.
        if samples:
            grown[:size, size + samples - 1 :] += older
            (drive[:, :1] if samples == 1 else grown[:, size + samples - 2 : size + samples - 1])[:size] += (
                newer
            )
            drive[size, 0] = 1.0
            for n in range(1, samples):
                grown[size + n, size + n - 1] = 1.0
        else:
            drive[:size, :1] = gamma[:, :1]
        out = np.hstack([c, np.zeros((2, samples))])
        return control.ss(grown, drive, out, np.zeros((2, 2)), period)


def laws(name: str, gains: Mapping[str, float], period: float, control: ModuleType) -> tuple[Any, Any]:
    """Return the controllers from following error, and from the position of the motor, to the output in V or
    %.
    """
    z = control.tf([1, 0], [1], period)
    change, total = (z - 1) / z, z / (z - 1)
    if name == "acromill":
        return gains["p_gain"] + gains["i_gain"] * period * total + gains["d_gain"] / period * change, None
    if name == "num":  # KVAR thousandths of a point for a unit, 32768 points for 10 V
        return control.tf([gains["loop_gain"] / 1000.0 * 10.0 / 32768.0], [1], period), None
    if name == "syntec":
        return control.tf([60.0 * gains["loop_gain"]], [1], period), None
    if name == "9pc":
        left = math.exp(-2.0 * math.pi * TORQUE_FILTER * period)
        sums = gains["velocity_proportional_gain"] + gains["velocity_integral_gain"] * total
        torque = (1.0 - left) / (1.0 - left / z) * sums * (100.0 / 65536.0 * RADIANS)
        return torque * (gains["initial_gain"] * 1000.0 / 60.0), torque * change / period
    words = 10.0 / 1984.0 * gains["velocity"]
    wanted = (gains["proportional"] + gains["integral"] * total) / 65536.0
    return words * wanted, words * change


def judged(
    name: str,
    machine: Machine,
    gains: Mapping[str, float],
    per_unit: float,
    period: float,
    control: ModuleType,
) -> dict[str, float | None]:
    """Return Ms, margins and the largest way of the load under 1 V, as python-control has them; None for an
    unstable loop.
    """
    outer, inner = laws(name, gains, period, control)
    plant = machine.sampled(period, control)
    count = control.ss([], [], [], [[per_unit]], period)
    outer = control.ss(outer) * count
    whole = plant
    if inner is not None:
        whole = control.feedback(
            plant, control.append(control.ss(inner) * count, control.ss([], [], [], [[0.0]], period))
        )
    loop = outer * whole[0, 0]
    closed = control.feedback(whole, control.append(outer, control.ss([], [], [], [[0.0]], period)))
    if np.abs(closed.poles()).max() >= UNSTABLE:
        return {"Ms": None}
    found = dict(_margins(loop, period))
    if inner is not None:
        speeds = dict(_margins(control.ss(inner) * count * plant[0, 0], period))
        found |= {f"velocity_loop_{key}": value for key, value in speeds.items()}
    time = period * np.arange(round(3.0 / period))
    way = control.forced_response(closed[1, 1], time, np.ones(len(time))).outputs
    return found | {"stiffness": float(np.abs(way).max())}


def _margins(loop: Any, period: float) -> Iterator[tuple[str, float]]:
    """Yield Ms, phase and gain margin of an open loop on a fine grid."""
    rates = np.geomspace(1e-4 / period, math.pi / period, 60_000)
    response = loop(np.exp(1j * rates * period))
    yield "Ms", float(np.max(1.0 / np.abs(1.0 + response)))
    gain, phase = np.abs(response), np.unwrap(np.angle(response))
    phase -= 2.0 * math.pi * round((phase[0] + math.pi) / (2.0 * math.pi))
    at_one = np.flatnonzero((gain[:-1] >= 1.0) & (gain[1:] < 1.0) | (gain[:-1] < 1.0) & (gain[1:] >= 1.0))
    if at_one.size:
        left = np.degrees((phase[at_one] + math.pi + math.pi) % (2.0 * math.pi) - math.pi)
        yield "phase_margin", float(left[np.argmin(np.abs(left))])
    over = np.flatnonzero(
        np.floor((phase[:-1] + math.pi) / (2.0 * math.pi))
        != np.floor((phase[1:] + math.pi) / (2.0 * math.pi))
    )
    margins = [float(-20.0 * math.log10(gain[n])) for n in over]
    if margins:
        yield "gain_margin", min(margins, key=abs)


def random_machine(dice: random.Random, name: str) -> Machine:
    """Return a machine around the one of the example; one in two has a resonance, but not that of
    AcroMill.
    """

    def log(low: float, high: float) -> float:
        return math.exp(dice.uniform(math.log(low), math.log(high)))

    if name == "acromill":
        return Machine(6232.3 * log(0.3, 3.0), 1.21e-3 * log(0.3, 3.0), 0.64e-3 * log(0.5, 3.0))
    swings = dice.random() < 0.5
    of_two = (log(0.4, 2.5), log(40.0, 150.0), log(0.02, 0.1)) if swings else (0.0, 0.0, 0.0)
    if name == "57c422b":
        return Machine(4e5 * log(0.3, 3.0), 7.2e-6 * log(0.3, 3.0), 2e-4 * log(0.5, 6.0), *of_two)
    axis = AXES[name]
    size, friction = {"num": (10.0, 0.05), "syntec": (40.0, 0.02), "9pc": (28.0, 0.02)}[name]
    masses = size * log(0.3, 3.0), friction * log(0.3, 3.0)
    if name == "9pc":
        return Machine(*masses, 1.5e-3 * log(0.5, 2.0), *of_two, axis.current, at_motor=1.0)
    drive = {"speed": axis.speed, "bandwidth": 50.0 * log(0.3, 2.0), "integral": 60.0 * log(0.5, 2.0)}
    return Machine(*masses, axis.period * log(0.2, 2.0), *of_two, **drive)


def compared(number: int, control: ModuleType) -> Iterator[str]:
    """Yield where ``tune`` and python-control differ about a machine, before and after."""
    name = tuple(AXES)[number % len(AXES)]
    axis, dice = AXES[name], random.Random(40 + number)
    machine, file = random_machine(dice, name), open_file(EXAMPLES / axis.example).file
    for each in axis.gains:
        address = address_of(file, each, axis.axis)
        old = file.get(address)
        number_now = old.value * math.exp(dice.uniform(math.log(0.1), 0.0))
        file.set(
            address,
            Value(round(number_now) if isinstance(old.value, int) else float(f"{number_now:.3g}"), old.unit),
        )
    trace = simulate(file, "tune", axis.axis, machine.settings(axis.unit))
    before = {
        each.partition(".")[2]: float(file.get(address_of(file, each, axis.axis)).value)
        for each in axis.gains
    }
    others = {each.parameter for each in trace.recommendations}
    after = before | {
        each.parameter.partition(".")[2]: each.value
        for each in trace.recommendations
        if each.parameter in axis.gains
    }
    for which, gains in (("_before", before), ("", after)):
        if which == "" and others & {"servo.lopass", "servo.notch", "servo.torque_filter"}:
            continue  # other filters are not written here
        found = judged(name, machine, gains, axis.per_unit, axis.period, control)
        yield from _differences(number, trace, which, found)


def _differences(number: int, trace: Trace, which: str, found: Mapping[str, float | None]) -> Iterator[str]:
    for key, value in found.items():
        there, unit = trace.result.get(f"{key}{which}", (None, ""))
        if key == "stiffness" and there is not None and unit.startswith("in/"):
            there *= INCH
        if which == "" and value is None:
            yield f"{number}: tune leaves an unstable loop"
        elif (value is None) != (there is None):
            yield f"{number}: {key}{which} is {there}, and {value} by python-control"
        elif value is not None and abs(there - value) > TOLERANCE * max(
            abs(value), 1.0 if "margin" in key else 0.0
        ):
            yield f"{number}: {key}{which} is {there:.5g}, and {value:.5g} by python-control"


def main(count: int) -> int:
    """Compare so many machines; return how many differ."""
    import control

    bad = 0
    for number in range(count):
        found = list(compared(number, control))
        bad += bool(found)
        print("\n".join(found) or f"{number}: agrees", flush=True)
    print(f"{count} machines: {bad} differ")
    return bad


if __name__ == "__main__":
    sys.exit(1 if main(int(sys.argv[1])) else 0)
