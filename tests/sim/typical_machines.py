"""Machines as a fitter sets them up, two a family: made with `new`, `axis` and `set` where a test needs
them."""

from collections.abc import Sequence
from pathlib import Path

from amp_studio.cli import run

NUM = "P97N0=1 P97N1=0 P1N0=0 P1N1=0 P4N2=3 P50N0=5000 P53N0=1 P7N1=0 P31N0=500 P31N1=2000 P31N2=10000"


def num_axis(n: int) -> str:
    """Pages 4-24 to 7-12: an encoder of 0.5 um, travel of 601 mm, gains of the example of 6-20."""
    return (
        f" P11N{2 * n}=1 P11N{2 * n + 1}=2 P16N{n}=0 P17N{2 * n}=-1000 P17N{2 * n + 1}=600000 P21N{n}=4915"
        f" P22N{n}=20 P23N{n}=6600 P30N{n}=10000 P32N{2 * n}=800 P32N{2 * n + 1}=1000 P19N{n}=0 P18N{n}=0"
    )


def syntec_axis(n: int) -> str:
    """Slides 1.2 to 3.2: 2500 pulses four times, a pitch of 10 mm."""
    return (
        f" Pr{60 + n}=2500 Pr{80 + n}=4 Pr{200 + n}=0 Pr{119 + 2 * n}=1 Pr{120 + 2 * n}=1 Pr{160 + n}=10000"
        f" Pr{460 + n}=24000 servo.loop_gain@{n}=30 Pr{540 + n}=100 Pr{820 + n}=3000 Pr{840 + n}=500"
        f" Pr{880 + n}=0 Pr{2399 + 2 * n}=500000 Pr{2400 + 2 * n}=-1000"
    )


def acromill_axis(name: str) -> str:
    """Appendix C: the bare test motor."""
    words = (
        "axes.pulses_per_unit=4096 servo.p_gain=0.08 servo.d_gain=0.00021 servo.vel_ffwd=0.0000015"
        " axes.disable_limit=False axes.soft_limit_plus=10 axes.soft_limit_minus=-1"
        " axes.excess_error_band=0.25 axes.inposition_band=0.001 axes.home_required=True"
    )
    return " " + " ".join(word.replace("=", f"@{name}=") for word in words.split())


def linuxcnc_axis(joint: int, name: str, low: int, high: int) -> str:
    """A joint that homes by a switch (H796)."""
    own = (
        f"min_limit={low} max_limit={high} max_velocity=100 max_acceleration=500 home=0 home_offset=0"
        f" home_search_velocity=20 home_latch_velocity=-2 home_sequence={joint}"
    )
    kind = f" joint.type@{joint}=ANGULAR" if name == "A" else ""
    of_axis = f"min_limit={low} max_limit={high} max_velocity=100 max_acceleration=500"
    joints = " ".join(f"joint.{word.replace('=', f'@{joint}=')}" for word in own.split())
    return f" {joints}{kind} " + " ".join(f"axis.{w.replace('=', f'@{name}=')}" for w in of_axis.split())


FEEDER = (
    "R0=0x1414 R1=0 R2=0x11C R3=1000 R4=0 R5=100 R6=8192 R7=0 R8=2000 R9=64000 R10=10 R15=1600 R17=4000"
    " R19=100000 R21=200000 R23=200000 command.gear_ratio@X=1 R31=10 R34=4000"
)
SECOND = (
    " R2048=0x0404 R2049=0 R2050=0x41D R2051=1000 R2052=0 R2053=0 R2054=0 R2055=0 R2079=10 R2067=50000"
    " R2069=400000 R2071=400000 R2056=3000 R2057=128000 R2063=800 R2065=0 R2059=40000 R2061=-200"
)
GRBL = "$20=1 $21=1 $22=1 $24=50 $25=1000 $27=2 $110=8000 $111=8000 $120=400 $121=400"

MACHINES: dict[str, tuple[str, str, str]] = {
    "9pc lathe with a gearbox": ("9pc", "--like lathe-ls176 --axes X,Z,S", "860=2 901=500"),
    "9pc mill with a rotary and a split axis": (
        "9pc",
        "--like mill-1394 --axes X,Y,Z,V,B",
        "660=X 661=V 662=2 663=1",
    ),
    "num lathe": ("num", "--axes X,Z", f"{NUM} P2N0=3 P3N0=3 P9N0=0 P9N1=2{num_axis(0)}{num_axis(1)}"),
    "num gantry": (
        "num",
        "--axes X,Y,Z,U",
        f"{NUM} P2N0=0x0F P3N0=0x0F P9N0=0 P9N1=1 P9N2=2 P9N3=3 P27N3=raw:0 P28N0=8 P24N3=500"
        + "".join(map(num_axis, range(4))),
    ),
    "syntec router with a bus": (
        "syntec",
        "--axes X,Y,Z --machine serial",
        "control.series=super Pr3203=2000" + "".join(map(syntec_axis, (1, 2, 3))),
    ),
    "syntec lathe": (
        "syntec",
        "--axes X,Z",
        "control.series=super Pr3203=2000" + "".join(map(syntec_axis, (1, 2))),
    ),
    "57c422b feeder": ("57c422b", "", FEEDER),
    "57c422b two axes": ("57c422b", "", FEEDER + SECOND),
    "acromill mill": ("acromill", "--axes X,Y,Z", "speeds.rapid=200" + "".join(map(acromill_axis, "XYZ"))),
    "grblhal laser": ("grblhal", "--axes X,Y,Z", f"{GRBL} $32=raw:1 $30=1000 $31=0 $130=400 $131=400"),
    "grblhal router with two motors on Y": (
        "grblhal",
        "--axes X,Y,Z",
        f"{GRBL} $30=24000 $31=6000 $170=10 $130=800 $131=1200",
    ),
    "linuxcnc lathe": (
        "linuxcnc",
        "--axes X,Z",
        "kins.joints=2 kins.kinematics=trivkins~coordinates=XZ traj.coordinates=X~Z traj.linear_units=mm"
        + linuxcnc_axis(0, "X", -100, 2)
        + linuxcnc_axis(1, "Z", -300, 5),
    ),
    "linuxcnc with four axes": (
        "linuxcnc",
        "--axes X,Y,Z,A",
        "kins.joints=4 kins.kinematics=trivkins~coordinates=XYZA traj.coordinates=X~Y~Z~A"
        " traj.linear_units=mm" + "".join(linuxcnc_axis(n, name, -300, 5) for n, name in enumerate("XYZA")),
    ),
}
"""Name -> family, how it is made, and what is set; ~ is a blank."""
COPIED = {"9pc mill with a rotary and a split axis": ("copy", "X", "V")}


def made(name: str, folder: Path) -> Path:
    """Make a machine in a folder, as a user does."""
    family, options, values = MACHINES[name]
    path = folder / "machine.amp"
    done(["new", family, str(path), *options.split()])
    if name in COPIED:
        done(["axis", str(path), *COPIED[name]])
    done(["set", str(path), *(word.replace("~", " ") for word in values.split())])
    return path


def done(line: Sequence[str]) -> None:
    """Run a verb that must succeed."""
    assert run(list(line)) == 0, line
