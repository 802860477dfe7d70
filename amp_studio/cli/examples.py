"""Examples of every verb, shown by its help and the man page, and run word for word by the tests."""

from __future__ import annotations

MILL = "MILL_1394.amp"
"""The example machine (``examples/mill-1394``); a copy of it lies in the folder in which the examples are run."""

EXAMPLES: dict[str, tuple[str, ...]] = {
    "families": ("amp-studio families",),
    "schema": ('amp-studio schema 9pc --group "Home Parameters"', "amp-studio schema num --json"),
    "show": ("amp-studio show 9pc 1300", "amp-studio show num P21", "amp-studio show syntec Pr61"),
    "tables": ("amp-studio tables 9pc", "amp-studio tables 9pc accdec-codes"),
    "find": (
        'amp-studio find 9pc "exess error"',
        'amp-studio find "SERVO AMP FE LIMITS"',
        f"amp-studio find {MILL} 12.7 mm --json",
    ),
    "calculate": (
        "amp-studio calculate 9pc",
        "amp-studio calculate 9pc acceleration_time_s milliseconds=125",
    ),
    "new": (
        "amp-studio new 9pc lathe.amp --machine lathe --axes X,Z,S",
        "amp-studio new 9pc second.amp --like mill-1394 --axes X,Y,Z,S",
    ),
    "set": (
        f"amp-studio set {MILL} 1300=1.5",
        f'amp-studio set {MILL} home.calibration@X="0.05 in" 1350=300',
        f"amp-studio set {MILL} 1300=not-set",
        f"amp-studio set {MILL} 1340==25.4/5000 1750='=Y*1.1'",
    ),
    "get": (
        f"amp-studio get {MILL} 1300 home.calibration@Y",
        f"amp-studio get {MILL} --all --json",
        f"amp-studio get {MILL} --changed --axes-differ",
        f"amp-studio get {MILL} --not-set",
    ),
    "guide": (
        "amp-studio guide 9pc",
        f"amp-studio guide {MILL}",
        f"amp-studio guide {MILL} home",
        f"amp-studio guide {MILL} --next --json",
        f"amp-studio guide {MILL} --done dual",
        f"amp-studio guide {MILL} -o list.pdf",
    ),
    "note": (
        f'amp-studio note {MILL} 1750 "11.5 needed with the long spindle, see order 4711"',
        f"amp-studio note {MILL} 1750",
        f'amp-studio note {MILL} group:home "Switches renewed"',
        f"amp-studio note {MILL} --json",
    ),
    "axis": (
        f"amp-studio axis {MILL}",
        f"amp-studio axis {MILL} copy X Y",
        f"amp-studio axis {MILL} add C 3",
    ),
    "validate": (
        f"amp-studio validate {MILL}",
        f"amp-studio validate {MILL} --why --json",
        f"amp-studio validate {MILL} --format sarif",
    ),
    "fix": (f"amp-studio fix {MILL} --dry-run", f"amp-studio fix {MILL} --safe"),
    "diff": (
        f"amp-studio diff {MILL} other.amp",
        f"amp-studio diff {MILL} --axes X Y",
        f"amp-studio diff {MILL} other.amp --base {MILL}",
        f"amp-studio diff {MILL} other.amp -o differences.pdf",
    ),
    "compare": (
        f"amp-studio compare {MILL} other.amp",
        f"amp-studio compare {MILL} other.amp -o machines.xlsx",
    ),
    "form": ("amp-studio form num -o tables.pdf", f"amp-studio form {MILL} -o form.html"),
    "merge": (
        f"amp-studio merge {MILL} other.amp {MILL} -o merged.amp",
        f"amp-studio merge {MILL} other.amp {MILL} --dry-run --take theirs --json",
    ),
    "report": (
        f"amp-studio report {MILL} -o mill.pdf",
        f"amp-studio report {MILL} -o changed.csv --changed-only --sort axis",
    ),
    "sheet": (
        f"amp-studio sheet {MILL} --against other.amp -o sheet.pdf",
        f"amp-studio sheet {MILL} --against other.amp --tick 1300",
        f"amp-studio sheet {MILL} --against other.amp --check screen.txt",
    ),
    "export": (f"amp-studio export {MILL} -o mill.csv",),
    "import": ("amp-studio import values.csv -o imported.amp --family 9pc",),
    "emulate": ("amp-studio emulate 9pc --listen tcp://127.0.0.1:8193 --state control",),
    "ports": ("amp-studio ports",),
    "identify": ("amp-studio identify tcp://127.0.0.1:8193",),
    "download": (
        f"amp-studio download {MILL} --to tcp://127.0.0.1:8193",
        f"amp-studio download {MILL} --to tcp://127.0.0.1:8193 --to tcp://localhost:8193 --stop-on-failure",
    ),
    "verify": (f"amp-studio verify {MILL} --with tcp://127.0.0.1:8193",),
    "upload": (
        "amp-studio upload --from tcp://127.0.0.1:8193 -o uploaded.amp",
        "amp-studio upload --from tcp://127.0.0.1:8193 -o uploaded.img",
    ),
    "history": (f"amp-studio history {MILL}",),
    "restore": ("amp-studio restore uploaded.img --to tcp://127.0.0.1:8193",),
    "send": (f"amp-studio send {MILL} --to tcp://127.0.0.1:8194 --protocol xmodem-1k",),
    "receive": ("amp-studio receive --from tcp://127.0.0.1:8195 -o received.txt --protocol ymodem",),
    "simulate": (
        f"amp-studio simulate {MILL} --list",
        f"amp-studio simulate {MILL} step --axis X",
        f"amp-studio simulate {MILL} step --axis X --set move.distance=50 -o trace.csv",
        f"amp-studio simulate {MILL} identify record.csv --axis X -o machine.yaml",
        f"amp-studio simulate {MILL} step --axis X --machine machine.yaml",
    ),
    "picture": (
        f"amp-studio picture {MILL}",
        f"amp-studio picture {MILL} travel --part X,Y -o travel.svg",
    ),
    "calibrate": (
        f"amp-studio calibrate {MILL} --axis X",
        f"amp-studio calibrate {MILL} --axis X --from laser.csv --dry-run -o errors.svg",
        f"amp-studio calibrate {MILL} --axis X --from laser.csv --sign measured-target",
        f"amp-studio calibrate {MILL} --axis X --compensation on --from laser.csv --sign measured-target --json --dry-run",
    ),
    "demo": ("amp-studio demo --terminal",),
    "completion": ("amp-studio completion bash",),
    "man": ("amp-studio man",),
}
"""Verb -> command lines, in the order in which they can be tried one after the other."""
