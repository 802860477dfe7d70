"""A folder as a control: what goes into its configuration, what stays, and what a break leaves."""

from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from amp_studio import MachineParameters, connect
from amp_studio.families.linuxcnc.control import driver as driver_module
from amp_studio.families.linuxcnc.control import running
from amp_studio.families.linuxcnc.control.content import Configuration, ConfigurationContent
from amp_studio.files import ParameterFile, SaveError, write_atomic
from amp_studio.formats import import_file
from amp_studio.schema import Value
from amp_studio.transfer import ImageChangedError, ImageError, Replacement, TransferError
from amp_studio.transfer.client import open_driver
from amp_studio.transfer.links import parse_endpoint

MAIN = (
    b"[EMC]\r\nMACHINE = Fr\xe4se\r\n#INCLUDE joints.inc\r\n[HAL]\r\nHALFILE = m.hal\r\n"
    b"[RS274NGC]\r\nMINE = 1\r\n"
)
JOINTS = "# größer\n[JOINT_0]\nFERROR = 1.50   # wide\nMAX_LIMIT = 8\nMINE = 3\n".encode()
HAL = b"setp pid.0.Pgain [JOINT_0]MINE\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    place = tmp_path / "mill"
    place.mkdir()
    for name, text in (("mill.ini", MAIN), ("joints.inc", JOINTS), ("m.hal", HAL)):
        (place / name).write_bytes(text)
    return place


def read(folder: Path) -> ParameterFile:
    return import_file(folder / "mill.ini", "linuxcnc")


def sent(folder: Path, file: ParameterFile) -> str:
    outcome = connect(f"folder:{folder}").download(
        MachineParameters(file), accept_errors=True, keep=folder.parent
    )
    assert outcome.verified
    return outcome.kept or ""


def test_a_value_of_an_included_file_is_written_there_and_every_other_byte_stays(folder: Path) -> None:
    file = read(folder)
    file.set(("joint.ferror", "0"), Value(2.25, "mm"))
    file.set(("joint.max_limit", "0"), None)
    sent(folder, file)
    changed = JOINTS.replace(b"1.50", b"2.25").replace(b"MAX_LIMIT = 8\n", b"")
    assert (folder / "joints.inc").read_bytes() == changed
    assert (folder / "mill.ini").read_bytes() == MAIN
    assert (folder / "m.hal").read_bytes() == HAL


def test_what_the_control_has_beside_parameters_stays(folder: Path) -> None:
    file = read(folder)
    file.set(("traj.max_velocity", ""), Value(30.0, "mm/s"))
    (folder / "mill.ini").write_bytes(MAIN + b"# added at the machine\r\n[HAL]\r\nHALCMD = x\r\n")
    sent(folder, file)
    text = (folder / "mill.ini").read_bytes()
    assert b"# added at the machine\r\n" in text
    assert b"[TRAJ]\r\nMAX_LINEAR_VELOCITY = 30\r\n" in text


def test_a_copy_puts_every_file_back(folder: Path) -> None:
    file = read(folder)
    file.set(("joint.ferror", "0"), Value(2.25, "mm"))
    kept = sent(folder, file)
    (folder / "m.hal").write_bytes(b"# lost\n")
    assert connect(f"folder:{folder}").restore(kept).verified
    assert [(folder / n).read_bytes() for n in ("mill.ini", "joints.inc", "m.hal")] == [MAIN, JOINTS, HAL]


def test_verify_names_a_difference_and_what_the_control_does_not_have(folder: Path) -> None:
    file = read(folder)
    control = connect(f"folder:{folder}", "linuxcnc")
    assert control.verify(MachineParameters(file)).agrees
    (folder / "joints.inc").write_bytes(JOINTS.replace(b"1.50", b"1.75"))
    found = control.verify(MachineParameters(file))
    assert [d.address for d in found.values.differences] == [("joint.ferror", "0")]
    (folder / "mill.ini").write_bytes(MAIN.replace(b"MINE = 1\r\n", b""))
    assert "[RS274NGC]MINE" in control.verify(MachineParameters(file)).missing


def test_a_file_that_cannot_be_written_leaves_the_folder_as_it_was(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = read(folder)
    file.set(("joint.ferror", "0"), Value(2.25, "mm"))
    file.set(("emc.machine", ""), Value("other"))

    write: Callable[..., str] = write_atomic

    def full_disk(place: Path, *args: object, **more: object) -> str:
        if place.name == "mill.ini":
            raise SaveError("no space left")
        return write(place, *args, **more)

    monkeypatch.setattr(driver_module, "write_atomic", full_disk)
    with pytest.raises(TransferError, match="no space left") as broken:
        sent(folder, file)
    assert broken.value.at_control == "old"
    assert (folder / "joints.inc").read_bytes() == JOINTS


def test_a_file_that_was_changed_since_it_was_read_is_not_overwritten(folder: Path) -> None:
    with closing(open_driver(f"folder:{folder}")) as driver:
        current = driver.fetch()
        files = dict(Configuration.read(current).files)
        files["joints.inc"] = files["joints.inc"].replace(b"1.50", b"2.25")
        (folder / "joints.inc").write_bytes(JOINTS + b"# added at the machine\n")
        with pytest.raises(ImageChangedError) as refused:
            driver.send(Replacement(Configuration(files).written(), current))
    assert refused.value.at_control == "old"
    assert (folder / "joints.inc").read_bytes() == JOINTS + b"# added at the machine\n"


def test_files_that_cannot_be_put_back_are_named_and_the_others_go_back(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "axes.inc").write_bytes(b"[AXIS_X]\nMAX_VELOCITY = 30\n")
    (folder / "mill.ini").write_bytes(b"#INCLUDE axes.inc\n" + MAIN)
    file = read(folder)
    file.take({("joint.ferror", "0"): Value(2.25, "mm"), ("axis.max_velocity", "X"): Value(45.0, "mm/s")})
    file.set(("emc.machine", ""), Value("other"))
    written: list[str] = []
    write: Callable[..., str] = write_atomic

    def failing(place: Path, *args: object, **more: object) -> str:
        if place.name == "mill.ini" or (place.name == "joints.inc" and place.name in written):
            raise SaveError("no space left")
        written.append(place.name)
        return write(place, *args, **more)

    monkeypatch.setattr(driver_module, "write_atomic", failing)
    with pytest.raises(
        TransferError, match=r"the control contains the new joints\.inc and the old"
    ) as broken:
        sent(folder, file)
    assert (broken.value.at_control, broken.value.new) == ("mixed", ("joints.inc",))
    assert (folder / "axes.inc").read_bytes() == b"[AXIS_X]\nMAX_VELOCITY = 30\n"
    assert b"2.25" in (folder / "joints.inc").read_bytes()


def test_a_file_outside_of_the_folder_is_neither_read_nor_written(folder: Path) -> None:
    outside = folder.parent / "other.inc"
    outside.write_bytes(JOINTS)
    (folder / "mill.ini").write_bytes(b"#INCLUDE ../other.inc\n[EMC]\nMACHINE = a\n")
    with closing(open_driver(f"folder:{folder}")) as driver:
        content = driver.fetch()
    assert set(Configuration.read(content).files) == {""}
    hostile = Configuration({"": b"[EMC]\n", "../other.inc": b"lost"}).written()
    copy = folder.parent / "a.before-20260101-000000.img"
    copy.write_bytes(hostile)
    with pytest.raises(TransferError, match="not in the folder"):
        connect(f"folder:{folder}").restore(copy)
    assert outside.read_bytes() == JOINTS


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"LinuxCNC configuration 1\n",
        b"LinuxCNC configuration 1\n9 \n[EMC]\nend\n",
        b"LinuxCNC configuration 1\n6 \n[EMC]\n\n6 \n[EMC]\n\nend\n",
    ],
)
def test_a_damaged_content_is_refused(content: bytes) -> None:
    with pytest.raises(ImageError):
        ConfigurationContent().decode(content)


def test_an_address_is_a_path_as_it_is() -> None:
    assert str(parse_endpoint("folder:C:\\cnc\\what?.ini")) == "folder:C:\\cnc\\what?.ini"
    with pytest.raises(ValueError, match="names no file or folder"):
        parse_endpoint("folder: ")
    with pytest.raises(ValueError, match="no control of grblhal"):
        open_driver("folder:/tmp", "grblhal")


def test_several_configurations_or_none_in_a_folder_are_named(folder: Path) -> None:
    (folder / "lathe.ini").write_bytes(MAIN)
    with (
        closing(open_driver(f"folder:{folder}")) as driver,
        pytest.raises(TransferError, match=r"2 configurations \(lathe\.ini, mill\.ini\)"),
    ):
        driver.identify()
    with pytest.raises(TransferError, match="cannot be read"):
        connect(f"folder:{folder}/none.ini").identify()


def test_a_program_that_runs_uses_what_its_pins_show(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    displayed = {"ini.0.ferror": "1.5", "ini.0.max_limit": "8.100001", "ini.0.backlash": "0"}
    monkeypatch.setattr(running, "pins", lambda _kind: displayed)
    process = folder / "proc" / "77"
    process.mkdir(parents=True)
    process.joinpath("cmdline").write_bytes(b"/usr/bin/milltask\0-ini\0%s\0" % bytes(folder / "mill.ini"))
    control, machine = connect(f"folder:{folder}"), MachineParameters(read(folder))
    monkeypatch.setattr(running, "PROCESSES", folder / "none")
    assert control.verify(machine).agrees
    monkeypatch.setattr(running, "PROCESSES", process.parent)
    found = control.verify(machine)
    assert [(d.address, d.b) for d in found.in_use] == [(("joint.max_limit", "0"), Value(8.100001, "mm"))]
    assert found.is_same
    assert not found.agrees
    assert control.identify().restart_needed


def test_who_writes_into_the_folder_of_a_program_that_runs_is_warned_before_the_first_byte(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    order: list[str] = []
    write: Callable[..., str] = write_atomic

    def noted(place: Path, *args: object, **more: object) -> str:
        order.append(place.name)
        return write(place, *args, **more)

    monkeypatch.setattr(driver_module, "write_atomic", noted)
    monkeypatch.setattr(driver_module, "is_running", lambda _path: True)
    monkeypatch.setattr(running, "pins", lambda _kind: {})
    file = read(folder)
    control = connect(f"folder:{folder}", notify=order.append)
    control.download(MachineParameters(file), accept_errors=True, keep=folder.parent)
    assert order == []  # nothing is written, and nobody is warned
    file.set(("joint.ferror", "0"), Value(2.25, "mm"))
    control.download(MachineParameters(file), accept_errors=True, keep=folder.parent)
    assert order == [driver_module.IN_USE, "joints.inc"]
    monkeypatch.setattr(driver_module, "is_running", lambda _path: False)
    assert not control.identify().notice


def test_a_user_who_cannot_ask_the_program_may_send_and_is_refused_a_verdict(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(_kind: str) -> dict[str, str]:
        raise TransferError("the running LinuxCNC does not show its values", "")

    monkeypatch.setattr(running, "pins", refused)
    monkeypatch.setattr(driver_module, "is_running", lambda _path: True)
    file = read(folder)
    file.set(("joint.ferror", "0"), Value(2.25, "mm"))
    sent(folder, file)
    assert b"2.25" in (folder / "joints.inc").read_bytes()
    with pytest.raises(TransferError, match="does not show its values"):
        connect(f"folder:{folder}").verify(MachineParameters(file))
