"""What the simulation of a NUM axis assumes and leaves out, for every result."""

from __future__ import annotations

ALWAYS = (
    (
        "The reference is KVAR / 1000 points for each internal unit of following error, in whole points of a"
        " converter with 32768 points at 10 V, and ends at 10 V (6-14)."
    ),
    (
        "The share of the speed reference that is added (6-26) is turned into a following error by the time"
        " constant of P66 or P56 (6-40); where it fits the gain, 100 % leaves no following error. The figures"
        " of 6-26 and 6-48 are lost."
    ),
    (
        "ASSUMED: position, reference and checks belong to the same moment of a sampling period; times of"
        " computation are not printed (set model.delay)."
    ),
    "Directions (P10, P20) are taken to fit the wiring.",
)

NOT_SIMULATED = ("Not simulated: interaxis calibration, QVN and DISC loops (P70 to P87).",)

DRIVE = {
    "acceleration_per_output": (
        "The file contains neither inertia nor torque: 100 % of rated torque is taken to give the fast"
        " acceleration of P32 (6-43 takes it from the speed buildup of the axis), and the drive to end at"
        " 200 %."
    ),
    "velocity_bandwidth": (
        "The drive is not in the file: it is taken to be a velocity drive that has the speed of P30 at 9 V"
        " (6-14; set model.drive_voltage)."
    ),
    "velocity_integral": (
        "An integral part of that drive, without which friction and weight would leave a speed error."
    ),
    "inertia_ratio": "Load and motor are one rigid mass unless model.resonance or model.backlash is set.",
}
