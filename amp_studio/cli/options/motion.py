"""The simulator, pictures, and the demonstration."""

from __future__ import annotations

from amp_studio.cli.arguments import Verbs, json_option, path_of


def add(verbs: Verbs) -> None:
    """Add the simulator and the demonstration."""
    sub = verbs.add("simulate", "motion", "check settings in motion", writes="output")
    sub.add_argument("path", type=path_of)
    sub.add_argument(
        "scenario",
        nargs="?",
        help="what is simulated; or identify: inertia, friction and weight from a record",
    )
    sub.add_argument("record", nargs="?", type=path_of,
                     help="identify: CSV of a drive with time, velocity or position, and torque; units in the heads")  # fmt: skip
    sub.add_argument("--list", action="store_true",
                     help="list the scenarios of this family, its axes, and what can be set")  # fmt: skip
    sub.add_argument("--axis")
    sub.add_argument("--set", action="append", default=[], metavar="PARAM=VALUE", dest="assignments")
    sub.add_argument("--machine", dest="machine_file", type=path_of, metavar="FILE.yaml",
                     help="the machine that identify has written; --set model.… has precedence")  # fmt: skip
    sub.add_argument("--scale", metavar="TORQUE",
                     help="identify: torque of the record for 1 %% (or 1 V) of the axis, as '0.056 A'")  # fmt: skip
    sub.add_argument(
        "--units", metavar="SYSTEM", help="metric or inch, for settings and result (default: as the file)"
    )
    sub.add_argument("-o", "--output", type=path_of,
                     help="file to write: .csv, .svg, .png; of identify also .yaml, the machine")  # fmt: skip
    json_option(sub)
    sub = verbs.add(
        "picture", "picture", "draw zones, ramps, jog speeds, gears and gains of a file", writes="output"
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("name", nargs="?", help="the picture; without one the pictures of the file are listed")
    sub.add_argument("--part", help="the axes (X,Y), the axis or the spindle; default: the first one")
    sub.add_argument("-o", "--output", type=path_of, help="file to write (.svg)")
    json_option(sub)
    sub = verbs.add(
        "demo",
        "motion",
        "the whole job on the example machine: in the desktop program, or here without a display",
    )
    sub.add_argument(
        "--terminal", action="store_true", help="stay in the terminal even where there is a display"
    )
