"""No reader of the program is left out of the campaigns:
every place that takes something from outside is in this table.
"""

import ast
import re
from pathlib import Path

from amp_studio import families
from amp_studio.formats import formats_of
from amp_studio.schema import family_ids

from . import texts
from .campaigns import CAMPAIGNS

PROGRAM = Path(families.__file__).parents[1]
CALLS = {
    "read_file",
    "read_table_text",
    "read_yaml",
    "read_yaml_file",
    "loads",
    "reader",
    "recv",
    "readLine",
    "readline",
    "readAllStandardError",
    "unpack_from",
    "model_validate_json",
    "validate_python",
    "QSettings",
    "read_bytes",
    "read_text",
    "parse_qsl",
    "fromhex",
    "parse_args",
    "clipboard",
    "input",
    "comports",
    "os.read",
    "read_entries",
    "read_expression",
    "read_content",
    "decode_image",
    "decode_content",
    "decode",
    "read_block",
    "feed",
    "get_template",
}
"""Calls by which something comes in, or becomes what it means."""
NAMES = {"stdin", "argv", "environ"}

READERS = {
    "calibration/cells.py": "damaged points of a laser",
    "calibration/reading.py": "damaged points of a laser",
    "child_process.py": "",  # what a copy of the process itself has made
    "cli/checks/cache.py": "damaged results of checks",
    "cli/checks/formats.py": "",  # what the program itself has printed
    "cli/console.py": "odd values",
    "cli/verbs/checks/validate.py": "damaged parameter file",
    "cli/verbs/controls/upload.py": "damaged control image",
    "families/acromill/emulated/card_motion.py": "",  # what the emulated card itself has written
    "cli/out_of_range.py": "",  # whether somebody is at the terminal
    "cli/verbs/controls/send.py": "",  # carries any bytes as they are
    "cli/program.py": "odd command lines",
    "cli/screen.py": "",  # gives the streams, reads nothing
    "control.py": "damaged control image",
    "languages/catalogue.py": "",  # texts of the program itself
    "dossier.py": "",  # what the program itself has written for its other process
    "demo.py": "",  # whether there is a display
    "families/grblhal/driver.py": "damaged answers of a Grbl control",
    "families/grblhal/emulated/firmware.py": "odd bytes at an emulated Grbl control",
    "families/grblhal/kind.py": "damaged copies of Grbl settings",
    "cli/controls/fleet.py": "damaged control image",
    "families/acromill/emulated/card.py": "odd keys and bytes at emulated NUM and ACR controls",
    "families/acromill/emulated/settings.py": "odd keys and bytes at emulated NUM and ACR controls",
    "families/acromill/formats/acr_lines.py": "damaged texts of controls",
    "families/acromill/formats/acr_script.py": "damaged texts of controls",
    "families/acromill/lines/content.py": "damaged contents of NUM, ACR and LinuxCNC",
    "families/acromill/lines/terminal.py": "ACR terminal over a bad line, power off in the save",
    "families/grblhal/content.py": "damaged copies of Grbl settings",
    "families/grblhal/description.py": "damaged descriptions of a control",
    "families/grblhal/line.py": "damaged answers of a Grbl control",
    "families/linuxcnc/formats/ini.py": "damaged texts of controls",
    "meaning/facts.py": "",  # facts of the program itself
    "meaning/folder.py": "damaged answers of a migration",
    "families/num/emulated/parameter_memory.py": "odd keys and bytes at emulated NUM and ACR controls",
    "families/linuxcnc/control/content.py": "damaged contents of NUM, ACR and LinuxCNC",
    "families/linuxcnc/control/driver.py": "damaged contents of NUM, ACR and LinuxCNC",
    "families/linuxcnc/control/running.py": "damaged pins of LinuxCNC",
    "families/num/lines/content.py": "damaged contents of NUM, ACR and LinuxCNC",
    "families/num/lines/driver.py": "damaged unloads of a NUM control",
    "families/servo57c422b/formats/automax.py": "damaged texts of controls",
    "families/servo57c422b/emulated/module_axis.py": "damaged contents and racks of the 57C422B",
    "families/servo57c422b/lines/content.py": "damaged contents and racks of the 57C422B",
    "families/servo57c422b/lines/driver.py": "57C422B registers over a bad line",
    "families/servo57c422b/lines/register_line.py": "57C422B registers over a bad line",
    "families/ninepc/emulated/online_amp.py": "odd commands at the screen of a 9/PC",
    "families/ninepc/emulated/panel.py": "odd commands at the screen of a 9/PC",
    "family_places.py": "",  # looks for a line in what pip has installed; other characters are no such line
    "files/atomic.py": "damaged backups",
    "files/document.py": "damaged journal and history",
    "files/example_files.py": "",  # the program's own examples, of which the heads are shown
    "files/lock.py": "damaged lock notes",
    "files/origin.py": "damaged parameter file",
    "files/paths.py": "",  # shortens a name
    "files/project.py": "damaged project.yaml",
    "files/reading.py": "damaged parameter file",
    "files/storage.py": "damaged parameter file",
    "formats/any_file.py": "damaged texts of controls",
    "formats/import_export.py": "damaged texts of controls",
    "formats/spreadsheet_block.py": "pasted blocks of cells",
    "formats/values_csv.py": "damaged texts of controls",
    "programs/source.py": "damaged part programs",
    "report/build.py": "",  # the values of the open file, written by the program
    "report/output/page.py": "",  # the program's own drawings, in letters of base64
    "report/output/typesetter.py": "",  # the program itself asks and answers in the process apart
    "report/output/pdf.py": "",  # what Typst found on pages that it has set
    "report/templating/starting.py": "",  # a file of the program itself
    "report/apart.py": "hostile templates of a project",
    "report/write.py": "hostile templates of a project",
    "report/templating/folder_copy.py": "hostile templates of a project",
    "report/templating/templates.py": "hostile templates of a project",
    "schema/folder.py": "",  # the environment names the folder of caches
    "schema/compiled_cache.py": "damaged cache",
    "schema/file_error.py": "damaged YAML",
    "schema/load.py": "damaged facts",
    "schema/model/compiled_json.py": "damaged cache",
    "schema/model/record.py": "damaged facts",
    "schema/regular_file.py": "",  # the gate itself: gives bytes
    "cli/verbs/documents/sheet.py": "damaged lists of a control's screen",
    "sheet/read_back.py": "damaged lists of a control's screen",
    "sheet/ticks.py": "damaged ticks of a sheet",
    "sim/identification/machine_file.py": "damaged machines of an axis",
    "sim/cam_reading.py": "damaged records of a drive",  # by the same reader of columns
    "sim/identification/drive_record.py": "damaged records of a drive",
    "sim/identification/response.py": "damaged frequency responses",
    "sim/identification/recording.py": "damaged tunings and recordings",
    "sim/tuning/record.py": "damaged tunings and recordings",
    "sim/variations/job.py": "",  # the file that is open already, written by the program
    "sim/variations/running.py": "damaged parts of a sweep",
    "sim/one_thread.py": "",  # sets a variable that is not there, reads none
    "sim/engine/compiled.py": "",  # one switch of numba, compared with "0"
    "sim/variations/worker.py": "",  # a job, points and figures between two processes of the program itself
    "families/num/emulated/control.py": "",  # what the emulated control itself has written
    "families/ninepc/emulated/machine_keys.py": "odd commands at an emulated control",
    "find/synonyms.py": "",  # a file of the program itself
    "schema/expression.py": "",  # its own names
    "ui/actions/find.py": "",  # writes to the clipboard
    "machine.py": "damaged parameter file",
    "trouble.py": "",  # what the program itself has written down of its faults
    "formats/text_format.py": "",  # which format a text has; it is read by that one
    "schema/units.py": "",  # a file of the program itself
    "transfer/client/kept.py": "damaged copies of a control",
    "transfer/client/live.py": "damaged control image",
    "transfer/client/record.py": "damaged record of exchanges",
    "transfer/client/parameters.py": "damaged digests",
    "transfer/client/verification.py": "damaged control image",
    "transfer/content.py": "damaged control image",
    "transfer/emulated/emulator.py": "odd commands at an emulated control",
    "transfer/emulated/faults.py": "damaged practice faults",
    "transfer/emulated/memory.py": "damaged memory of an emulated control",
    "transfer/emulated/record.py": "damaged memory of an emulated control",
    "transfer/emulated/responder.py": "damaged frames",
    "transfer/emulated/staging.py": "damaged memory of an emulated control",
    "transfer/house/broken_transfers.py": "damaged notes of begun downloads",
    "transfer/house/frame.py": "damaged frames",
    "transfer/house/message.py": "damaged messages",
    "transfer/house/transaction.py": "damaged frames",
    "transfer/image.py": "odd commands at an emulated control",
    "transfer/links/endpoint.py": "damaged addresses of controls",
    "transfer/links/password.py": "hostile ends of a password",
    "transfer/links/passwords.py": "",  # a password may be any text
    "transfer/links/opening.py": "",  # the fingerprint of the emulator's certificate
    "transfer/links/pseudo_terminal.py": "damaged frames",
    "transfer/links/rfc2217.py": "damaged telnet",
    "transfer/links/usb_ports.py": "",  # the system's text about its ports is only shown
    "transfer/links/security.py": "",  # the operator's own certificate: read by ssl
    "transfer/links/tls.py": "hostile clients",
    "transfer/links/tcp.py": "hostile clients",
    "ui/__init__.py": "",  # paths of files to open: by the gate of every file
    "ui/base/display.py": "",  # whether names of displays are set
    "ui/actions/file.py": "",  # copies an example of the program, which is opened as every file is
    "ui/window/file_tabs.py": "",  # writes to the clipboard
    "ui/base/emulated_control.py": "",  # the own child's first line: an address, which is read as one
    "ui/base/known_controls.py": "damaged settings",
    "ui/merge/sources.py": "damaged control image",
    "ui/merge/tree.py": "",  # writes to the clipboard
    "ui/project/files.py": "damaged parameter file",
    "ui/actions/range.py": "pasted blocks of cells",
    "ui/control/session.py": "damaged control image",
    "transfer/plain/ymodem.py": "hostile ends of plain files",
    "ui/base/theme.py": "",  # a file of the icon package
    "ui/dialogs/manual_window.py": "",  # pages of the program itself
    "ui/window/settings.py": "damaged settings",
    "validate/beside.py": "damaged record of exchanges",
    "validate/cell_expression.py": "odd expressions in cells",
    "validate/rule_file.py": "damaged suppressions",
    "validate/calculator.py": "odd arguments of formulas",
    "validate/rule_review.py": "damaged expressions in rules",
}
"""Module -> the campaign that damages what it reads; "" where it makes nothing of it."""


def test_every_place_that_reads_something_from_outside_has_a_campaign() -> None:
    reading = {path.relative_to(PROGRAM).as_posix() for path in sorted(PROGRAM.rglob("*.py")) if _reads(path)}
    assert reading - READERS.keys() == set(), "damage what they read in a campaign, and name it here"
    assert READERS.keys() - reading == set(), "they read nothing any more"
    assert {name for name in READERS.values() if name} <= {campaign.name for campaign in CAMPAIGNS}


def test_every_text_format_of_every_family_is_damaged() -> None:
    assert {family for family, _ in texts._FORMATS} == set(family_ids())
    assert all((family, f.key) in texts._FORMATS for family in family_ids() for f in formats_of(family))


_SPELLED = re.compile(
    rf"(?<!def )\b({'|'.join(name.rpartition('.')[2] for name in sorted(CALLS))})\("
    rf"|\.({'|'.join(sorted(NAMES))})\b"
)


def _reads(path: Path) -> bool:
    text = path.read_text(encoding="utf-8")
    if not _SPELLED.search(text):  # to take a module apart costs more than to look through it
        return False
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call):
            called = node.func
            if isinstance(called, ast.Name) and called.id in CALLS:
                return True
            if isinstance(called, ast.Attribute):
                whole = f"{called.value.id}.{called.attr}" if isinstance(called.value, ast.Name) else ""
                if called.attr in CALLS or whole in CALLS:
                    return True
        if isinstance(node, ast.Attribute) and node.attr in NAMES:
            return True
    return False
