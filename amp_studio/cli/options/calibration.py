"""The verb that calibrates an axis."""

from __future__ import annotations

import re

from amp_studio.cli.arguments import Verbs, json_option, path_of


def add(verbs: Verbs) -> None:
    """Add the verb that calibrates an axis."""
    sub = verbs.add(
        "calibrate",
        "calibration",
        "the calibration table and the reversal error of an axis, from measured points or by hand; without either, show them",
        writes="path output",
    )
    sub.add_argument("path", type=path_of)
    sub.add_argument("--axis", required=True, help="axis by its letter or number")
    sub.add_argument("--from", dest="measured", type=path_of, metavar="FILE",
                     help="points measured by a laser interferometer or a ball-bar: columns as CSV, or Renishaw .rtl")  # fmt: skip
    sub.add_argument("--unit", metavar="UNIT", help="unit of the positions: mm, in, um, deg, counts")
    sub.add_argument(
        "--error-unit", metavar="UNIT", help="unit of the errors: mm, in, um, deg, arcsec, counts"
    )
    sub.add_argument("--sign", choices=("measured-target", "target-measured"),
                     help="what an error is: measured less target (ISO 230-2), or the correction")  # fmt: skip
    sub.add_argument("--decimal", choices=("point", "comma"), help="decimal sign of the points")
    sub.add_argument("--compensation", choices=("on", "off"),
                     help="whether the axis was measured with its compensation on; points are then added to it")  # fmt: skip
    sub.add_argument("--circle", choices=("first", "second"),
                     help="which axis of the circle of a ball-bar (angle, deviation) it is")  # fmt: skip
    sub.add_argument("--only", choices=("table", "reversal"), help="make only one of both")
    sub.add_argument("--input", choices=("measurement", "deviation"), help="how the control has its points")
    sub.add_argument(
        "--start", choices=("positive", "negative"), help="end of the travel at which the table starts"
    )
    sub.add_argument(
        "--insert", action="append", metavar="POSITION=FIGURE", help="one more point of the table"
    )
    sub.add_argument(
        "--replace", action="append", metavar="POSITION=FIGURE", help="another figure at a point"
    )
    sub.add_argument("--delete", action="append", metavar="POSITION", help="a point that goes")
    sub.add_argument("--clear", action="store_true", help="delete all points of the axis")
    sub.add_argument("-o", "--output", type=path_of, help="the errors before and after as a picture (.svg)")
    sub.add_argument("--dry-run", action="store_true", help="change nothing, show what would change")
    json_option(sub)
    sub._negative_number_matcher = re.compile(
        r"-[0-9.]"
    )  # -50=0.001 is a point, as -50 is a number to argparse
