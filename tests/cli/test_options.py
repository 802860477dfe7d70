"""Options that no other story needs: each does through the command line what its help promises."""

import socket
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from .conftest import MEASURED, from_points

EXAMPLE = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"


def test_a_comparison_of_everything_has_the_rows_that_are_the_same(amp, example: Path) -> None:
    differing = amp("compare", example, example, "--json").json
    everything = amp("compare", example, example, "--json", "--everything").json
    assert differing["rows"] == []
    assert len(everything["rows"]) == everything["same"] == differing["same"] > 600


def test_a_report_of_the_inactive_has_what_the_control_ignores(amp, example: Path, tmp_path: Path) -> None:
    lines = {}
    for name, options in (("active", ()), ("all", ("--inactive",))):
        path = tmp_path / f"{name}.csv"
        assert amp("report", example, "-o", path, *options).code == 0
        lines[name] = path.read_text("utf-8-sig").splitlines()
    assert set(lines["active"]) < set(lines["all"])


@pytest.mark.parametrize(
    ("options", "unit", "point"),
    [
        (("--unit", "in", "--error-unit", "in"), "in", (25.4, 0.0254)),
        (("--unit", "mm", "--error-unit", "um"), "mm", (1, 0.001)),
    ],
)
def test_points_without_units_get_them(amp, example: Path, tmp_path: Path, options, unit: str, point) -> None:
    laser = tmp_path / "laser.csv"
    laser.write_text("position,error\n0,0\n1,0.001\n" if unit == "in" else "position,error\n0,0\n1,1\n")
    found = amp(*from_points(example, laser), *MEASURED, "--json", "--dry-run", *options)
    assert found.code == 0, found.err
    last = found.json["table"]["points"][-1]
    assert (last["position"], last["figure"]) == (pytest.approx(point[0]), pytest.approx(point[1]))


def test_a_decimal_comma_is_read_where_it_is_shown_to_be_one(amp, example: Path, tmp_path: Path) -> None:
    laser = tmp_path / "laser.csv"
    laser.write_text("position [mm];error [mm]\n0;0\n100,500;0,004\n")
    line = (*from_points(example, laser), *MEASURED, "--json", "--dry-run")
    comma = amp(*line, "--decimal", "comma")
    assert comma.json["table"]["points"][-1]["position"] == pytest.approx(100.5)
    assert amp(*line, "--decimal", "point").code == 2


def test_an_option_that_the_control_was_not_ordered_with_is_refused(amp) -> None:
    listening = ("--listen", "tcp://127.0.0.1:0")
    assert "has no options" in amp("emulate", "num", *listening, "--option", "axes=3").err
    assert amp("emulate", "9pc", *listening, "--option", "axes=many").code == 2
    assert "Unknown option 'axes'" in amp("emulate", "grblhal", *listening, "--option", "axes=3").err
    card = ("--listen", "tcp://127.0.0.1:0?protocol=terminal")
    assert "Known: file" in amp("emulate", "acromill", *card, "--option", "axes=3").err
    assert "nix.amp" in amp("emulate", "acromill", *card, "--option", "file=nix.amp").err
    assert "'axes' is not NAME=VALUE" in amp("emulate", "9pc", *listening, "--option", "axes").err
    assert "'5' is not NAME=VALUE" in amp("calculate", "9pc", "gain_break_point", "5").err


@pytest.mark.parametrize(("blank", "sign"), [("nul", b"\0"), ("space", b" ")])
def test_a_raw_text_has_its_leader_of_blanks(amp, tmp_path: Path, blank: str, sign: bytes) -> None:
    text = tmp_path / "tape.txt"
    text.write_bytes(b"N1\n")
    with socket.create_server(("127.0.0.1", 0)) as server, ThreadPoolExecutor(1) as pool:
        got = pool.submit(lambda: server.accept()[0].makefile("rb").read())
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        assert (
            amp("send", text, "--to", address, "--protocol", "raw", "--leader", "3", "--blank", blank).code
            == 0
        )
        assert got.result(10) == sign * 3 + b"N1\n" + sign * 3


def test_silence_ends_a_raw_text(amp, tmp_path: Path) -> None:
    back = tmp_path / "back.txt"

    def speak(server: socket.socket) -> None:
        line = server.accept()[0]
        with line:
            line.sendall(b"N1 G0\n")
            line.recv(1)  # until the other end hangs up

    with socket.create_server(("127.0.0.1", 0)) as server, ThreadPoolExecutor(1) as pool:
        spoken = pool.submit(speak, server)
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        assert amp("receive", "--from", address, "-o", back, "--protocol", "raw", "--idle", "0.2").code == 0
        spoken.result(10)
    assert back.read_bytes() == b"N1 G0\n"
