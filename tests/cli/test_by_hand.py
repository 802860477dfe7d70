"""A family whose controls take values at their screens only: each exchange with one offers the sheet,
in one sentence.
"""

import shutil
import socket
from pathlib import Path

import pytest
from new_family import write_family

from amp_studio.cli.controls.by_hand import ways_offered
from amp_studio.schema.registration import Registration, register, unregister
from amp_studio.transfer.errors import ControlSilentError, NotInEmergencyStopError

EXAMPLE = Path(__file__).parents[2] / "examples" / "syntec-mill" / "SYNTEC_MILL.amp"
SENTENCE = "A Syntec control takes values at its parameter screens only"


@pytest.fixture
def silent_address() -> str:
    """Return an address at which nothing listens."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return f"tcp://127.0.0.1:{free.getsockname()[1]}"


@pytest.mark.parametrize("verb", ["download", "verify", "identify"])
def test_who_reaches_no_syntec_control_is_offered_the_sheet_in_the_one_line_of_the_error(
    amp, tmp_path: Path, silent_address: str, verb: str
) -> None:
    path = shutil.copy(next(EXAMPLE.parent.glob("*.amp")), tmp_path / "mill.amp")
    line = {
        "download": (path, "--to", silent_address, "--accept-errors"),
        "verify": (path, "--with", silent_address),
        "identify": (silent_address, "--family", "syntec"),
    }[verb]
    message = amp(verb, *line)
    assert message.code == 2
    assert "no connection to the control" in message.err
    assert (
        f"({SENTENCE}, because no protocol of it is published: print what to key in with amp-studio sheet "
        in message.err
    )


def test_who_asks_a_gateway_of_a_silent_control_reads_how_the_control_itself_is_reached() -> None:
    with (
        pytest.raises(
            ControlSilentError, match=r"asks for a gateway.*\?protocol=peripheral for the parameter table"
        ) as caught,
        ways_offered("num", "tcp://127.0.0.1:1"),
    ):
        raise ControlSilentError("the control does not answer", "")
    assert "sheet" not in str(caught.value)
    for family, address in (
        ("num", "tcp://127.0.0.1:1?protocol=house"),
        ("grblhal", "tcp://127.0.0.1:1"),
        ("", "tcp://h:1"),
    ):
        with (
            pytest.raises(ControlSilentError, match=r"^the control does not answer$"),
            ways_offered(family, address),
        ):
            raise ControlSilentError("the control does not answer", "")


def test_an_error_of_a_control_that_answers_is_about_that_control_alone() -> None:
    with (
        pytest.raises(NotInEmergencyStopError, match=r"^please place the control in E-stop$"),
        ways_offered("9pc", "tcp://h:1"),
    ):
        raise NotInEmergencyStopError("please place the control in E-stop", "")


def test_other_families_hear_nothing_of_it(amp, tmp_path: Path, silent_address: str) -> None:
    assert "sheet" not in amp("identify", silent_address, "--family", "num").err


def test_a_family_to_whose_controls_no_way_is_known_is_keyed_in_and_not_downloaded(
    amp, tmp_path: Path
) -> None:
    write_family("tiny", tmp_path)
    register(Registration("tiny", facts=tmp_path / "tiny"))
    try:
        path = tmp_path / "tiny.amp"
        assert amp("new", "tiny", path).code == 0
        refused = amp("download", path, "--to", "tcp://127.0.0.1:1", "--accept-errors")
        assert refused.code == 2
        assert (
            "Values are keyed in at the screens of a tiny: print a sheet of what to key in (amp-studio sheet"
            in refused.err
        )
        refused = amp("emulate", "tiny", "--listen", "tcp://127.0.0.1:0")
        assert refused.code == 2
        assert "There is no emulated control of tiny" in refused.err
    finally:
        unregister("tiny")


def test_the_sheet_of_a_syntec_has_its_pr_numbers_and_what_the_screens_show(amp, tmp_path: Path) -> None:
    path, other = tmp_path / "mill.amp", tmp_path / "other.amp"
    shutil.copy(next(EXAMPLE.parent.glob("*.amp")), path)
    shutil.copy(path, other)
    assert amp("set", path, "Pr821=7", "Pr61=1500").code == 0
    entries = {
        e["param"]: (e["new"], e["unit"])
        for e in amp("sheet", path, "--against", other, "--json").json["entries"]
    }
    assert entries["Pr61"][0] == "1500"
