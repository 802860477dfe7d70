"""The command line uses the public door, ``import amp_studio``: what goes past it to a room is listed
here."""

import ast
from collections.abc import Iterator
from pathlib import Path

import amp_studio

PROGRAM = Path(amp_studio.__file__).parent
ROOMS = {path.parent.name for path in PROGRAM.glob("*/__init__.py")} - {"cli"}
WORDS = {"schema", "report"}
"""Rooms that say how a fact is written: every verb prints, and the door prints nothing."""

PAST_THE_DOOR = {
    "the paths, folders and dialogues of a command line": {
        "asking.py": "transfer",
        "candidates.py": "files guide meaning sim validate",
        "outcome.py": "files",
        "out_of_range.py": "files",
        "output.py": "files",
        "program.py": "ui",
        "stopping.py": "transfer",
        "checks/cache.py": "files validate",
        "verbs/checks/validate.py": "files formats guide sim validate",
        "verbs/documents/report.py": "files validate",
        "verbs/facts/find.py": "files find",
    },
    "what a room has in words or as JSON, for what the door has returned": {
        "accounts.py": "formats",
        "checks/comparing.py": "files",
        "checks/formats.py": "files formats validate",
        "controls/by_hand.py": "transfer",
        "controls/endings.py": "transfer",
        "controls/tape.py": "transfer",
        "motion/text.py": "sim",
        "motion/calibration_picture.py": "calibration drawing",
        "verbs/checks/fix.py": "files validate",
        "verbs/controls/identify.py": "files transfer",
        "verbs/controls/restore.py": "transfer",
        "verbs/controls/upload.py": "files transfer",
        "verbs/controls/verify.py": "transfer",
        "verbs/documents/import_.py": "formats",
        "verbs/files/set.py": "files",
    },
    "several controls at once": {
        "controls/drift.py": "files transfer",
        "controls/fleet.py": "files transfer",
    },
    "work of one verb alone, which the door does not offer": {
        "files/marked.py": "find guide transfer",
        "motion/trigger.py": "sim",
        "verbs/checks/compare.py": "meaning",
        "verbs/checks/diff.py": "files transfer",
        "verbs/checks/merge.py": "files ui validate",
        "verbs/controls/emulate.py": "transfer",
        "verbs/controls/history.py": "files transfer",
        "verbs/controls/ports.py": "transfer",
        "verbs/controls/receive.py": "files transfer",
        "verbs/controls/send.py": "transfer",
        "verbs/controls/status.py": "sim",
        "verbs/documents/sheet.py": "sheet transfer",
        "verbs/facts/calculate.py": "validate",
        "verbs/files/axis.py": "files",
        "verbs/files/get.py": "guide",
        "verbs/files/guide.py": "files guide validate",
        "verbs/files/migrate.py": "meaning",
        "verbs/files/new.py": "files",
        "verbs/files/note.py": "files",
        "verbs/motion/block.py": "programs",
        "verbs/motion/program.py": "drawing files programs sim",
        "verbs/motion/calibrate.py": "calibration drawing files",
        "verbs/motion/cam.py": "drawing files sim",
        "verbs/motion/machine_tests.py": "files guide sim",
        "verbs/motion/picture.py": "drawing files pictures",
        "verbs/motion/simulate.py": "sim",
    },
}
"""Reason -> module of ``amp_studio/cli`` -> the rooms from which it takes something itself."""

AS_THE_DOOR_DOES = {
    "candidates.py": "new_file open_file",  # a shell is answered in a blink: half the door is not needed
    "controls/fleet.py": "decode_content fetch_image record_look",  # a thread for each control
    "files/marked.py": "found_in",
    "verbs/checks/diff.py": "by_schema compare of_other_schema",  # what only B has is printed by its schema
    "verbs/checks/merge.py": "rules_beside text_of_name",  # the result has no file yet
    "verbs/checks/validate.py": "is_text_of_control",  # of a folder, nothing is opened
    "verbs/controls/history.py": "text_of_name",  # the name in the record
    "verbs/controls/restore.py": "open_copy",  # it is shown before it goes back
    "verbs/controls/upload.py": "decode_content",  # of bytes that are kept also where they cannot be read
    "verbs/documents/sheet.py": "open_copy",  # compares a sheet with a copy
    "verbs/motion/machine_tests.py": "simulated_axes",  # the first one, where none is named
    "verbs/motion/program.py": "Document",  # earlier versions of a file that stays as it is
}
"""Module -> what it takes from a room although the door calls it too, and why."""


def taken(path: Path) -> Iterator[tuple[str, str]]:
    """Yield room and name of each import that runs; those for type checkers alone are left out."""

    def below(node: ast.AST) -> Iterator[tuple[str, str]]:
        for each in ast.iter_child_nodes(node):
            if (
                isinstance(each, ast.If)
                and isinstance(each.test, ast.Name)
                and each.test.id == "TYPE_CHECKING"
            ):
                continue
            if isinstance(each, ast.ImportFrom) and (each.module or "").startswith("amp_studio."):
                yield from ((str(each.module).split(".")[1], alias.name) for alias in each.names)
            yield from below(each)

    yield from (
        (room, name) for room, name in below(ast.parse(path.read_text("utf-8"))) if room in ROOMS - WORDS
    )


def modules() -> dict[str, Path]:
    folder = PROGRAM / "cli"
    return {path.relative_to(folder).as_posix(): path for path in folder.rglob("*.py")}


def test_what_goes_past_the_door_is_listed_with_its_reason() -> None:
    found = {name: " ".join(sorted({room for room, _ in taken(path)})) for name, path in modules().items()}
    listed = {name: rooms for of_reason in PAST_THE_DOOR.values() for name, rooms in of_reason.items()}
    assert {name: rooms for name, rooms in found.items() if rooms} == listed


def test_what_the_door_offers_is_not_taken_from_a_room() -> None:
    of_door = {
        name
        for module in ("machine.py", "assignments.py", "value_rows.py", "control.py")
        for _, name in taken(PROGRAM / module)
    }
    for name in ("ENDING", "Exchange", "axis_instances", "NO_RULES", "ParameterFileError"):  # facts, not work
        of_door.discard(name)
    twice = {
        name: " ".join(sorted({each for _, each in taken(path)} & of_door))
        for name, path in modules().items()
    }
    assert {name: names for name, names in twice.items() if names} == AS_THE_DOOR_DOES
