"""What other builds of the firmware have is known without a control, judged by the widest of them,
and asked of no file.
"""

import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.families.grblhal.described import schema_of
from amp_studio.families.grblhal.formats.listing import FORMAT
from amp_studio.files import Header, ParameterFile, new_file, open_file
from amp_studio.formats import file_of, import_file
from amp_studio.formats.text_format import ReadOptions, TextRead
from amp_studio.schema import Value, load_schema
from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.validate import Validator

from .bench import Bench, current
from .recorded import THREE_AXES

GRBLHAL = load_schema("grblhal")


def read(text: str) -> TextRead:
    return FORMAT.read(text, GRBLHAL, ReadOptions())


def errors(tmp_path: Path, text: str) -> list[str]:
    listing, made = tmp_path / "listing.txt", tmp_path / "made.amp"
    listing.write_text(text, "utf-8")
    made.unlink(missing_ok=True)
    assert run(["import", str(listing), "-o", str(made), "--machine", "grblhal", "--on-fault", "keep"]) == 0
    return [
        f.message.partition(" It was forced")[0]
        for f in Validator(open_file(made).file).run()
        if f.severity == "error"
    ]


def test_a_new_file_has_none_of_them_and_an_old_one_keeps_its_signature() -> None:
    others = {p.id for p in GRBLHAL.parameters.values() if not p.in_signature}
    assert len(others) > 250
    assert not others & {parameter for parameter, _ in new_file("grblhal", None, "XYZ").values}
    assert all(
        p.optional and p.needs
        for p in GRBLHAL.parameters.values()
        if p.id in others and "classic" not in p.id
    )


def test_a_control_that_describes_itself_has_its_own_settings_only() -> None:
    described = schema_of(THREE_AXES)
    assert not {p.id for p in GRBLHAL.parameters.values() if not p.in_signature} & described.parameters.keys()


def test_what_a_control_was_delivered_with_is_not_known_where_it_describes_itself() -> None:
    """It prints no defaults, and every value of it seemed to be another one."""
    schema = schema_of(THREE_AXES)
    file = ParameterFile(schema, Header(signature=schema.signature, machine="grblhal"))
    seldom = [(name, "") for name in GRBLHAL.plausible.seldom if name in file.schema.parameters]
    assert len(seldom) > 10
    for address in seldom:
        file.set(address, file.read(address, "0"))
    assert "plausible.seldom" not in {finding.rule for finding in Validator(file).run()}


@pytest.mark.parametrize(
    ("number", "address", "text", "value"),
    [
        (8, ("stepper.ganged_axes_direction_invert", ""), "3", Value(3)),
        (16, ("spindle.invert_spindle_signals", ""), "1", Value(1)),
        (70, ("networking.network_services", ""), "11", Value(11)),
        (140, ("axis.motor_current", "X"), "2801", Value(2801)),
        (201, ("axis.stallguard4_fast_threshold", "Y"), "22.0", Value(22.0)),
        (302, ("networking.ip_address", ""), "192.168.5.1", Value("192.168.5.1")),
        (340, ("spindle.spindle_at_speed_tolerance", ""), "5.0", Value(5.0, "%")),
        (374, ("modbus.modbus_baud_rate", ""), "3", Value("choice_3")),
        (395, ("spindle.default_spindle", ""), "2", Value("raw:2")),
        (491, ("user_settings.macro_2", ""), "G4P0", Value("G4P0")),
    ],
)
def test_settings_of_plugins_are_known(
    number: int, address: tuple[str, str], text: str, value: Value
) -> None:
    assert read(f"${number}={text}\n").values[address] == value


def test_a_mask_is_judged_by_the_widest_build(tmp_path: Path) -> None:
    assert errors(tmp_path, f"$14={(1 << 13) - 1}\n$17=4096\n$6=7\n$65=48\n$22=1281\n$9=17\n") == []
    assert errors(tmp_path, f"$14={1 << 13}\n") == ["Invert control inputs 8192 does not fit its 13 bits."]
    assert errors(tmp_path, "$6=8\n") == ["Invert probe inputs 8 does not fit its 3 bits."]


def test_a_number_that_another_build_uses_otherwise_is_kept_as_text() -> None:
    found = read("$700=5\n$100=80\n$650=G4P0\n")
    assert found.unknown == {"$700": "5", "$650": "G4P0"}
    assert any("another meaning" in note and "$650, $700" in note for note in found.notes)


def test_forks_of_grbl_are_machine_types(tmp_path: Path) -> None:
    old = (
        "$0=10\n$1=25\n$2=0\n$3=0\n$4=0\n$5=0\n$6=0\n$10=19\n$11=0.01\n$12=0.002\n$13=0\n$20=0\n"
        "$21=0\n$22=0\n$23=0\n$24=25\n$25=500\n$26=250\n$27=1\n"
    )
    axes = lambda count: "".join(f"${100 + 10 * q + n}=500\n" for q in range(4) for n in range(count))  # noqa: E731  # one line
    later = "$30=1000\n$31=0\n$32=0\n"
    found = {
        name: read(text)
        for name, text in {
            "0.9": old + axes(3),
            "1.1": old + later + axes(3),
            "5X": old + later + axes(5),
            "ESP32": (
                old.replace("$0=10\n", "$0=500\n").replace("$10=19", "$10=1")
                + later
                + "$33=5000\n$34=0\n$35=0\n$36=100\n"
                + axes(6)
            ),
        }.items()
    }
    assert {name: one.machine for name, one in found.items()} == {
        "0.9": "grbl-0.9",
        "1.1": "grbl-1.1",
        "5X": "grbl-mega-5x",
        "ESP32": "grbl-esp32",
    }
    assert found["0.9"].values["classic.report_options_09", ""] == Value(19)
    assert found["5X"].values["build.axes", ""] == Value("XYZAB")
    for name in ("grbl-0.9", "grbl-mega-5x", "grbl-esp32"):
        path = tmp_path / f"{name}.amp"
        assert run(["new", "grblhal", str(path), "--machine", name]) == 0
        assert run(["validate", str(path)]) == 0


def test_every_error_of_the_firmware_has_a_meaning() -> None:
    (listed,) = [m for m in GRBLHAL.message_lists if m.id == "errors"]
    codes = {int(m.code.partition(":")[2]) for m in listed.messages}
    assert codes >= set(range(1, 93)) - {59, 67, 68, 69}, "59 and 67 to 69 are not used"


SOURCE = """
typedef enum {
    Setting_First = 900,
    Setting_GateBase = 910, // first of three
    Setting_Gate0 = Setting_GateBase,
    Setting_Gate1,
    Setting_Gate2,
} ids_t;
static char inputs[] = "Left,N/A,Right";
/* { Setting_First, Group_X, "Old", NULL, Format_Bool, NULL, NULL, NULL, 0 }, */
static const setting_detail_t details[] = {
#if FOO_ENABLE > 1
    { Setting_First, Group_Foo, "Gate inputs", NULL, Format_Bitfield, inputs, NULL, NULL, \
Setting_NonCore, &a, NULL, NULL },
#endif
    { Setting_GateBase, Group_Foo, "Gate ? time", "milliseconds", Format_Decimal, "-#0.00", "-5", "20", \
Setting_NonCore, &b, NULL, NULL, X_OPTS },
};
static const setting_group_detail_t groups [] = { { Group_Root, Group_Foo, "Gates" } };
"""


def test_the_harvest_finds_numbers_bounds_bits_and_conditions(checkout: Path, tmp_path: Path) -> None:
    source = tmp_path / "plugin"
    source.mkdir()
    (source / "gate.c").write_text(SOURCE, "utf-8")
    command = [sys.executable, str(checkout / "scripts" / "harvest_grblhal.py"), str(source), "--print"]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 0, done.stderr
    lines = [line.strip() for line in done.stdout.splitlines()]
    for expected in (
        "group gates: 2",
        '- {machines: [grblhal], scope: global, numbers: {start: 900, format: "${n}"}}',
        '- {bit: 0, label: "Left"}',
        '- {bit: 2, label: "Right"}',
        'storage: {bits: 3, signed: false, command: "${n}={v}"}',
        '- {what: "a build with plugin gate.c, FOO_ENABLE > 1", page: GATE13}',
        'name: "Gate 3 time"',
        'ranges: {"ms": [-5, 20]}',
        "decimals: 2",
    ):
        assert expected in lines, done.stdout
    assert "Old" not in done.stdout


CORE = {
    "settings.h": (
        "typedef enum {\n    Setting_ControlInvertMask = 14,\n    Setting_Unheard = 999,\n} setting_id_t;\n"
    ),
    "alarms.h": "enum { Alarm_None = 0, Alarm_Known = 1, Alarm_Unheard = 98, };\n",
    "errors.h": "enum { Status_OK = 0, Status_Known = 20, Status_Unheard = 199, Status_Unhandled = 253, };\n",
    "settings.c": """static char signals[] = "A,B,C,D,E,F,G,H,I,J,K,L,M,N";
static const setting_detail_t details[] = {
    { Setting_ControlInvertMask, Group_X, "Inputs", NULL, Format_Bitfield, signals, NULL, NULL, \
0, &a, NULL, NULL },
    { Setting_Unheard, Group_X, "New", NULL, Format_Bool, NULL, NULL, NULL, 0, &a, NULL, NULL },
};
""",
}


def test_the_harvest_counts_what_the_firmware_has_and_names_what_is_missing_here(
    checkout: Path, tmp_path: Path
) -> None:
    """Of the core of 2026-08-18 it counts 146 settings (135 in the core of the issue), 13 bits of $14, 22
    alarms and 88 errors, and finds none missing. The same is asked of the sources of ``make peer-grblhal``
    where they are.
    """
    (tmp_path / "core").mkdir()
    for name, text in CORE.items():
        (tmp_path / "core" / name).write_text(text, "utf-8")
    lines = counts(checkout, tmp_path / "core")
    assert lines == [
        "2 settings are described, 2 have an id in setting_id_t",
        "not described here: settings 999",
        "$14 has 14 bits",
        "not described here: bits of $14 13",
        "2 alarms",
        "not described here: alarms 98",
        "2 errors",
        "not described here: errors 199",
    ]
    core = checkout / "build" / "peers" / "grblhal" / "src" / "src" / "grbl"
    if core.is_dir():
        assert not [line for line in counts(checkout, core) if line.startswith("not described here")]


def counts(checkout: Path, folder: Path) -> list[str]:
    command = [sys.executable, str(checkout / "scripts" / "harvest_grblhal.py"), str(folder), "--counts"]
    return subprocess.run(command, capture_output=True, encoding="utf-8", check=True).stdout.splitlines()


OF_THE_CORE = (
    "0-49 56-69 90-92 95 100 110 120 130 160 170 180 190 340-349 370-372 374-376 384 392-395 398-399 481"
    " 484-489 519 534 536-539 640-648 650 671 673 676 680-681 700-701 709 716 730-731 733-740 742-745 800"
)
"""The numbers that ``--counts`` found described in grblHAL/core f80fc34 (2026-08-18)."""


def test_every_setting_that_the_core_describes_is_known_and_has_its_build_condition() -> None:
    numbers = [
        n
        for part in OF_THE_CORE.split()
        for n in range(int(part.split("-")[0]), int(part.split("-")[-1]) + 1)
    ]
    here = GRBLHAL.on("grblhal")
    known = {here.plain_number(a): a[0] for a in here.addresses}
    assert len(numbers) == 146
    assert [n for n in numbers if str(n) not in known] == []
    described = [GRBLHAL.parameters[known[str(n)]] for n in numbers]
    others = [p for p in described if not p.in_signature]
    assert len(others) >= 50
    assert all(p.needs for p in others), "a setting of other builds has its condition"
    assert {bit.bit for bit in GRBLHAL.parameters[known["14"]].bits or ()} == set(range(13))


def test_a_masked_password_and_an_empty_one_are_text_and_no_value() -> None:
    found = read("$74=\n$75=\n$77=hunter2222\n$331=********\n$300=mill\n")
    assert found.unknown == {"$75": "", "$331": "********"}
    assert found.values["wifi.wifi_access_point_ap_password", ""] == Value("hunter2222")
    assert found.values["wifi.wifi_station_sta_ssid", ""] == Value("")


def test_a_listing_goes_to_a_control_by_its_numbers_and_what_that_lacks_is_not_sent(tmp_path: Path) -> None:
    bench = Bench(tmp_path / "control")
    file = file_of(GRBLHAL, read("$110=777\n$16=1\n$370=3\n$N0=G21\n"), "mill")
    outcome = download(bench.driver, WantedContent(partial(bench.driver.encode, file), ""), lambda _: "kept")
    assert outcome.verified
    assert current(bench).settings[110] == "777.000"
    sent = b"".join(bench.received).split()
    assert [line for line in sent if line.partition(b"=")[0] in (b"$110", b"$16", b"$370", b"$N0")] == [
        b"$110=777.000"
    ]


@pytest.mark.parametrize(("debounce", "machine"), [("250.000", "grbl-esp32"), ("250", "grbl-mega-5x")])
def test_a_debounce_with_decimals_is_of_grbl_esp32(tmp_path: Path, debounce: str, machine: str) -> None:
    """Both list six axes; Grbl_ESP32 alone has the debounce as a decimal."""
    of_axes = "".join(f"${n + k}=100.000\n" for n in (100, 110, 120, 130) for k in range(6))
    head = (
        "0=4 1=255 2=0 3=0 4=0 5=0 6=1 10=3 11=0.010 12=0.002 13=0 20=1 21=1 22=1 23=3 24=50.000 25=2000.000"
    )
    path = tmp_path / "six.txt"
    lines = "".join(f"${each}\n" for each in f"{head} 26={debounce} 27=2.000 30=1000 31=0 32=0".split())
    path.write_text(lines + of_axes, "utf-8")
    assert import_file(path).machine == machine


@pytest.mark.parametrize(("rate", "is_asked"), [("500.000", True), ("600.000", False)])
def test_a_listing_of_nothing_but_defaults_is_asked_about(tmp_path: Path, rate: str, is_asked: bool) -> None:
    """A fresh Grbl 1.1 lists these, and a machine that was set up has other values."""
    settings = (
        "0=10 1=25 2=0 3=0 4=0 5=0 6=0 10=1 11=0.010 12=0.002 13=0 20=0 21=0 22=0 23=0 24=25 25=500 26=250"
        f" 27=1 30=1000 31=0 32=0 100=250 101=250 102=250 110={rate} 111=500 112=500 120=10 121=10 122=10"
        " 130=200 131=200 132=200"
    )
    path, notes = tmp_path / "fresh.txt", list[str]()
    path.write_text("".join(f"${each}\n" for each in settings.split()), "utf-8")
    import_file(path, notify=notes.append)
    asked = [note for note in notes if note.endswith("was the memory of the control erased?")]
    assert len(asked) == is_asked
