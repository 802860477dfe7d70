"""The configuration of LinuxCNC: what is read of it, and that nobody's byte is changed."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, export_of, import_file
from amp_studio.schema import Value

MILL = Path(__file__).parent / "mill.ini"


def read(tmp_path: Path, text: str | bytes, **more: str) -> ParameterFile:
    path = tmp_path / "a.ini"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return import_file(path, "linuxcnc", **more)


def written(file: ParameterFile) -> str:
    return export_of(file, "a.ini").content.decode("latin-1")


TEXTS = [
    b"[EMC]\nVERSION = 1.1\n",
    b"[TRAJ]\r\nCOORDINATES = X Z\r\n; remark\r\n[JOINT_0]\r\nFERROR=1.50   # wide\r\n",
    b"[EMC]\nMACHINE = Fr\xe4se\n[HAL]\nHALFILE = a.hal\nHALFILE = b.hal",
    "[EMC]\nMACHINE = Fräse µ\n\n\n[TRAJ]\nHOME = 0 0 \\\n 0\n".encode(),
    b"# first\n[KINS]\n JOINTS = 3\r\n\tKINEMATICS\t=trivkins  \n[JOINT_0]\nMAX_LIMIT =\n",
    b"\xef\xbb\xbf[EMC]\nVERSION = 1.1\n[TRAJ]\nLINEAR_UNITS = 0.03937007874016\n",
    b"[JOINT_0]\nP = 1\nP = 2\n[HOSTMOT2]\nCARD0 = hm2_5i25.0\n[JOINT_0]\nI = 3\n",
]


@pytest.mark.parametrize("text", [*TEXTS, MILL.read_bytes()])
def test_what_is_not_changed_is_written_back_byte_for_byte(tmp_path: Path, text: bytes) -> None:
    assert export_of(read(tmp_path, text), "b.ini").content == text


def test_a_changed_value_is_another_one_in_its_line_and_a_new_one_is_at_the_end_of_its_section(
    tmp_path: Path,
) -> None:
    file = read(tmp_path, "[JOINT_0]\nFERROR = 1.50   # wide\nMAX_LIMIT = 8\n\n[HAL]\nHALUI = halui\n")
    file.set(("joint.ferror", "0"), Value(2.25, "mm"))
    file.set(("joint.max_limit", "0"), None)
    file.set(("joint.home_use_index", "0"), Value(True))
    file.set(("axis.max_limit", "X"), Value(1.0, "in"))
    assert (
        written(file) == "[JOINT_0]\nFERROR = 2.25   # wide\nHOME_USE_INDEX = YES\n\n[HAL]\nHALUI ="
        " halui\n\n[AXIS_X]\nMAX_LIMIT = 25.4\n"
    )


def test_keys_that_a_screen_reads_are_no_slips_and_a_second_line_of_one_is(tmp_path: Path) -> None:
    text = (
        "[EMC]\n[DISPLAY]\nMAX_RAPID_OVERRIDE = 1\nMACRO = a\nMACRO = b\nLOG_FILE = x.log\n"
        "[TOOLSENSOR]\nX = 10\n"
    )
    assert read(tmp_path, text).unknown == {}
    assert len(read(tmp_path, text + "X = 20\n").unknown) == 1


def test_another_unit_of_length_writes_every_length_again(tmp_path: Path) -> None:
    file = read(
        tmp_path,
        "[TRAJ]\nLINEAR_UNITS = mm\n[JOINT_0]\nMAX_LIMIT = 25.4\n[JOINT_3]\nTYPE=ANGULAR\nMAX_LIMIT = 90\n",
    )
    file.set(("traj.linear_units", ""), Value("inch"))
    assert written(file).endswith("inch\n[JOINT_0]\nMAX_LIMIT = 1\n[JOINT_3]\nTYPE=ANGULAR\nMAX_LIMIT = 90\n")


def test_figures_are_in_the_units_of_the_machine(tmp_path: Path) -> None:
    text = (
        "[TRAJ]\nLINEAR_UNITS = inch\n[JOINT_0]\nMAX_VELOCITY = 2\n[JOINT_1]\nTYPE = angular\nMAX_VELOCITY ="
        " 30\n[AXIS_B]\nMIN_LIMIT=-1e1\n[EMCMOT]\nSERVO_PERIOD = 1000000"
    )
    file = read(tmp_path, text)
    assert file.get(("joint.max_velocity", "0")) == Value(2.0, "in/s")
    assert file.get(("joint.max_velocity", "1")) == Value(30.0, "deg/s")
    assert file.get(("axis.min_limit", "B")) == Value(-10.0, "deg")
    assert file.get(("emcmot.servo_period", "")) == Value(1000.0, "us")


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("[JOINT_0]\nFERORR = 1\n", "[JOINT_0]FERORR in line 2 ([JOINT_0]FERROR?)"),
        ("[JOINT_0]\nP = 1\nP = 2\n", "[JOINT_0]P in line 3 (line 2 comes first and counts)"),
        (
            "[JOINT_0]\nP = 1\n[HAL]\n[JOINT_0]\nI = 2",
            "[JOINT_0]I in line 5 (the section is in line 1 already, and only that one is read)",
        ),
        (
            "[JOINT_0]\nHOME_USE_INDEX = YES # marker\n",
            "[JOINT_0]HOME_USE_INDEX in line 2 (it is not one of YES, NO)",
        ),
        ("[JOINT_0]\nMAX_LIMIT = far\n", "[JOINT_0]MAX_LIMIT in line 2 (it is no number)"),
        ("[HOSTMOT2]\nCARD0 = 5i25\n[HAL]\n", "[HOSTMOT2]CARD0 in line 2"),
    ],
)
def test_what_linuxcnc_passes_over_in_silence_is_named(tmp_path: Path, text: str, name: str) -> None:
    assert list(read(tmp_path, text).unknown) == [name]


def test_a_key_of_another_version_shows_of_which_one(tmp_path: Path) -> None:
    text = "[SPINDLE_0]\nMAX_VELOCITY = 6000\nMAX_FORWARD_VELOCITY = 6000\nMIN_FORWARD_VELOCITY = 60\n"
    file = read(tmp_path, text)
    assert file.machine == "2.9"
    assert list(file.unknown) == [
        "[SPINDLE_0]MAX_VELOCITY in line 2 (read by LinuxCNC 2.9.0~pre1 (Debian 12) alone)"
    ]
    assert read(tmp_path, text, machine="2.9-pre").get(("spindle.max_velocity_pre", "0")) == Value(
        6000.0, "rpm"
    )


def test_an_included_file_is_read_in_its_place_and_nothing_outside_of_the_folder(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "secret.inc").write_text("[JOINT_0]\nI = 7\n")
    (tmp_path / "in/joint.inc").write_text("[JOINT_0]\nP = 30\n\n")
    text = "[KINS]\nJOINTS = 3\n#INCLUDE joint.inc\n#INCLUDE ../secret.inc\n#INCLUDE lost.inc\n"
    (tmp_path / "in/a.ini").write_text(text)
    notes: list[str] = []
    file = import_file(tmp_path / "in/a.ini", "linuxcnc", notify=notes.append)
    assert file.get(("joint.pid_p", "0")) == Value(30.0)
    assert file.get(("joint.pid_i", "0")) is None
    assert notes[0] == "included and not found beside the file: ../secret.inc, lost.inc"
    export = export_of(file, tmp_path / "b.ini")
    assert (export.content.decode(), export.account.not_representable) == (text, ())
    file.set(("joint.pid_p", "0"), Value(31.0))
    with pytest.raises(FormatError, match=r"included file joint\.inc"):
        export_of(file, tmp_path / "b.ini")


def test_the_pins_that_hal_files_set_are_noted_and_never_written(tmp_path: Path) -> None:
    file = import_file(MILL, "linuxcnc")
    assert file.unknown == {}
    assert file.header.value_notes["joint.pid_p@2"] == "HAL: pid.z.Pgain (mill.hal line 22)"
    (tmp_path / "a.hal").write_text("setp hm2.pwm [HOSTMOT2](RATE)\nloadrt x card=[HOSTMOT2]CARD0 # [A]B\n")
    text = "[HAL]\nHALFILE = a.hal\n[HOSTMOT2]\nRATE = 20\nCARD0 = 5i25\nCARD1 = none\n"
    assert list(read(tmp_path, text).unknown) == ["[HOSTMOT2]CARD1 in line 6"]
