"""Damaged part programs: each is read to its end, or ends at a block with a reason; none takes for ever."""

import tempfile
from functools import cache
from pathlib import Path

from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.programs import ProgramBlockError, read_program
from amp_studio.programs.interpreter import tool_path
from amp_studio.sim import ProgramJob, SimulationError

from .texts import mutants, violations

FILES = (
    (
        "%\nN10 G20 G90 G17 G62\nG0 X-2 Y-1 Z-0.5\nG1 Z-.6 F24\nX-8. F190\n"
        "G3 X-8.6 Y-1.6 I-8 J-1.6\nG4 F0.5\nM2\n"
    ),
    (
        "G91 F100\nP5=0\nN100\nP5=P5+1\nX(P5*(0-0.1))\nY-1\nIF P5<5 THEN GOTO 100\nGOSUB 200\nM2\n"
        "N200\nX-1\nRET\n"
    ),
    "G98 G83 X-4 Z-2 R-1 Q0.4 F10\nX-5 L3\nG80\nG54\nG92 X0\nG52 X1\nG51 X0 Y0 P2\nG50\nG68 X0 Y0 R45\nX-1\n",
)


@cache
def _router() -> ParameterFile:
    return open_file(examples_folder() / "acromill-router" / "ROUTER.amp").file


def fuzz_programs(seed: int, count: int) -> list[str]:
    """Read what is damaged, and plan what was read."""
    file = _router()

    def look(text: str) -> None:
        with tempfile.NamedTemporaryFile(suffix=".nc") as kept:
            kept.write(text.encode("utf-8", "surrogatepass"))
            kept.flush()
            lines = read_program(Path(kept.name))
        path = tool_path(file, lines)
        assert len(path) == len(path.ends)
        ProgramJob(lines, with_contour=False).run(file)

    return violations(mutants(FILES, seed, count), look, (ProgramBlockError, SimulationError))
