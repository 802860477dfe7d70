"""A process apart: for what keeps memory, cannot be interrupted, or may end the process that runs it."""

from __future__ import annotations

from amp_studio.child_process import child_command
from amp_studio.errors import AmpStudioError


class ReportNotMadeError(AmpStudioError, RuntimeError):
    """The process that makes a report, or a part of it, did not; the text names the cause."""


def run_apart(module: str, question: bytes, patience_s: float | None = None) -> bytes:
    """Return what ``answer(asked, out)`` of a module writes in a process apart, where it reads the question.

    Raises ReportNotMadeError.
    """
    import subprocess  # most reports are made without one

    try:
        command = child_command(module, "answer")
        # Its errors are read and not shown: Typst and Python write traces that help no user.
        done = subprocess.run(command, input=question, capture_output=True, timeout=patience_s, check=False)
    except subprocess.TimeoutExpired:
        raise ReportNotMadeError("works without end") from None
    except OSError as error:
        raise ReportNotMadeError(f"needs a process, which cannot be started: {error.strerror}") from error
    if done.returncode:
        # MemoryError of Python, or the message with which Typst ends: the exit code does not name it.
        lacks_memory = b"memory" in done.stderr.lower()
        raise ReportNotMadeError(
            "needs too much memory" if lacks_memory else "ended the process that sets it"
        )
    return done.stdout
