"""What cannot be calibrated: each error is one sentence for the person who measured."""

from amp_studio.errors import AmpStudioError


class CalibrationError(AmpStudioError, ValueError):
    """Measured points, or a table, that cannot be used."""


class MeasurementError(CalibrationError):
    """A file of measured points that cannot be read; the text names the line where there is one."""

    def __init__(self, what: str, line: int = 0) -> None:
        super().__init__(f"line {line}: {what}" if line else what)
