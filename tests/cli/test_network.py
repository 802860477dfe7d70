"""A control with TLS and a password is reached from the command line,
and nothing of the password is shown anywhere.
"""

import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio.cli import asking, run
from amp_studio.transfer.links import passwords

CERTIFICATES = Path(__file__).parents[1] / "transfer" / "links" / "certificates"
PASSWORD = "correct horse"


@pytest.fixture
def control(tmp_path: Path) -> Iterator[str]:
    """Start an emulated control with TLS and a password; give its address."""
    (tmp_path / "password").write_text(f"{PASSWORD}\n", encoding="utf-8")
    command = [
        sys.executable,
        "-m",
        "amp_studio.cli",
        "emulate",
        "57c422b",
        "--listen",
        "tls://127.0.0.1:0",
        "--certificate",
        str(CERTIFICATES / "control.pem"),
        "--key",
        str(CERTIFICATES / "control.key"),
        "--password-file",
        str(tmp_path / "password"),
        "--state",
        str(tmp_path / "state"),
    ]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        yield process.stdout.readline().removeprefix("listening on ").strip()
        process.kill()


def test_the_password_opens_the_line_and_is_shown_nowhere(
    control: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, "keyring", None)
    monkeypatch.delenv(passwords.ENVIRONMENT, raising=False)
    passwords.ask_with(None)
    assert "?fingerprint=sha256:" in control
    assert run(["identify", control]) == 2
    assert "asks for a password: put it into AMP_STUDIO_PASSWORD" in capsys.readouterr().err
    monkeypatch.setenv(passwords.ENVIRONMENT, "wrong password")
    assert run(["identify", control]) == 2
    wrong = capsys.readouterr()
    assert "the password is wrong" in wrong.err
    monkeypatch.setenv(passwords.ENVIRONMENT, PASSWORD)
    code = run(["identify", control])
    reported = capsys.readouterr()
    assert code == 0 or "too many wrong passwords" in reported.err
    assert PASSWORD not in wrong.err + reported.out + reported.err
    assert not any(
        PASSWORD.encode() in path.read_bytes() for path in (tmp_path / "state").rglob("*") if path.is_file()
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--listen", "tls://127.0.0.1:0"], "needs a certificate"),
        (
            ["--listen", "tcp://127.0.0.1:0", "--certificate", str(CERTIFICATES / "control.pem")],
            "write tls://",
        ),
        (
            ["--listen", "tcp://127.0.0.1:0", "--key", str(CERTIFICATES / "control.key")],
            "--key belongs to a --certificate",
        ),
        (["--listen", "tcp://127.0.0.1:0", "--password-file", "missing"], "missing"),
        (
            ["--listen", "pty:", "--password-file", str(CERTIFICATES / "README.md")],
            "a serial line has no password",
        ),
    ],
)
def test_security_that_cannot_be_had_is_refused_at_the_start(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert run(["emulate", "57c422b", "--state", str(tmp_path), *arguments]) == 2
    assert message in capsys.readouterr().err


def test_who_listens_for_the_network_is_warned(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "control.json").mkdir()  # so that it does not start
    assert run(["emulate", "57c422b", "--listen", "tcp://0.0.0.0:0", "--state", str(tmp_path)]) == 2
    assert (
        "warning: 0.0.0.0 can be reached from the network, without TLS and a password"
        in capsys.readouterr().err
    )


def test_a_question_for_a_password_can_be_ended_by_ctrl_c(monkeypatch: pytest.MonkeyPatch) -> None:
    handlers: list[object] = []

    def enter(prompt: str, stream: object) -> str:
        handlers.append(signal.getsignal(signal.SIGINT))
        return prompt

    monkeypatch.setattr("getpass.getpass", enter)
    before = signal.getsignal(signal.SIGINT)
    asking.ask_at_terminal()
    try:
        assert asking._ask("tcp://cnc:1") == "Password of tcp://cnc:1: "
    finally:
        passwords.ask_with(None)
    assert handlers == [signal.default_int_handler]
    assert signal.getsignal(signal.SIGINT) is before
