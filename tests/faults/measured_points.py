"""Damaged files of measured points: each is refused in one line,
or what was read makes a table the control takes.
"""

from functools import cache

from amp_studio.calibration import CalibrationError, MeasurementAnswers, ProposalRequest, propose
from amp_studio.calibration.reading import read_measurement
from amp_studio.families.ninepc.formulas.calibration import calibration_fault
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value

from .texts import mutants, violations

FILES = (
    "angle [deg],deviation [um]\n" + "".join(f"{n},{n % 7}\n" for n in range(0, 200, 2)),
    (
        "# X axis\nTarget [mm],Measured"
        " [mm]\n0,0.001\n100,100.004\n200,200.007\n200,200.012\n100,100.009\n0,0.005\n"
    ),
    "position;error\n0;0\n100;0.004\n200;0.0065\n",
    "Position (mm)\tRun 1 + (um)\tRun 1 - (um)\n0\t0\t5\n50\t2\t7\n100\t4\t9.5\n",
    "0 0\n100 0.004\n200 0.007\n",
    "position,direction,run,deviation [um]\n0,+,1,1\n100,+,1,4\n100,-,1,9\n0,-,1,6\n",
    "0,000 0,001\n100,000 0,004\n",
    (
        "HEADER::\nFile Type: RTL\n\nTARGET DATA::\nFiletype: Linear\nTarget-count: 3\nTargets :\n 0.0"
        " 100.0\n 200.0\nFlags: 0\n\nRUNS::\nRun-count: 2\n\nDEVIATIONS::\nRun Target Data:\n 1 1 0.0\n 1 2"
        " 4.1\n 1 3 7.0\n 2 3 12.0\n 2 2 9.0\n 2 1 5.0\n\nENVIRONMENT::\n"
    ),
)
ANSWERS = (
    MeasurementAnswers(),
    MeasurementAnswers("mm", "um", "target-measured", "comma"),
    MeasurementAnswers("in", "in", "measured-target"),
)


@cache
def _mill() -> ParameterFile:
    file = new_file("9pc", "mill", ["X", "Y"])
    file.set(("servo.hardware_type", "1"), Value("sercos"))
    return file


def fuzz_points(seed: int, count: int) -> list[str]:
    """Damage what a laser has written; nothing is set in the file that its own rule would refuse."""
    return [violation for n, answers in enumerate(ANSWERS) for violation in _fuzz(answers, seed + n, count)]


def _fuzz(answers: MeasurementAnswers, seed: int, count: int) -> list[str]:
    file = _mill()

    def look(text: str) -> None:
        proposal = propose(
            file, "1", read_measurement(text, answers), ProposalRequest(was_on=False, circle="first")
        )
        if proposal.table is not None:
            table = proposal.settings[("calibration.table", "1")]
            assert calibration_fault(str(table.value), turns=False) == ""

    return violations(mutants(FILES, seed, count), look, (CalibrationError,))
