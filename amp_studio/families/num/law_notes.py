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

CLAMPED = (
    "The axis has a clamp (P8): its reference comes only when the PLC has reported the end of unclamping"
    " (CRM), and the program goes on only when it has reported clamping (4-23). How long that takes is not"
    " in the file and is left out of the times here."
)
NOT_SIMULATED = ("Not simulated: interaxis calibration, QVN and DISC loops (P70 to P87).",)
