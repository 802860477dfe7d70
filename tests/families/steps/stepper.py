"""Everything a sixth family has to write: facts beside this module, formulas, a text format, a driver,
a law, one record.
"""

import hashlib
from pathlib import Path
from typing import ClassVar

from amp_studio.files import ParameterFile
from amp_studio.formats.text_format import FormatError, ReadOptions, TextFormat, TextRead
from amp_studio.schema import InvalidValueError, Schema, load_schema, read_value, write_value
from amp_studio.schema.registration import Registration
from amp_studio.sim import AxisLaw, AxisParameters, Law, Machine, Ramp
from amp_studio.sim.engine.arrays import Vector
from amp_studio.sim.engine.signals import COMMAND, OUTPUT, POSITION
from amp_studio.transfer.content import HouseContent
from amp_studio.transfer.driver import Abilities, ControlIdentity, Receipt
from amp_studio.transfer.errors import NoConnectionError, WrongFamilyError
from amp_studio.transfer.exchange import QUIET, Exchange, Replacement
from amp_studio.transfer.links.endpoint import Endpoint

FAMILY = "steps"


# -- formulas: what one BLU is, another parameter sets --------------------------------------------


def limit_mm(limit: float, increment: str) -> float:
    """Return the length in mm of so many BLU under an increment system (page 1-1)."""
    return limit * {"is-b": 0.001, "is-c": 0.0001}[increment]


FORMULAS = {"limit_mm": limit_mm}


# -- a separate text format: ``N10=50000 BLU`` ---------------------------------------------------


def _read(text: str, schema: Schema, _options: ReadOptions) -> TextRead:
    found, file = TextRead(), ParameterFile(schema)
    for n, line in enumerate(text.splitlines()[1:], 1):
        number, _, message = line.removeprefix("N").partition("=")
        address = file.find(number)
        parameter = schema.parameters[address[0]]
        try:
            found.values[address] = read_value(parameter, message, schema.units_of(parameter)[0])
        except InvalidValueError as error:
            raise FormatError(str(error), n + 1) from None
    return found


def _write(file: ParameterFile) -> str:
    here, parameters = file.schema.on(file.machine), file.schema.parameters
    lines = [
        f"N{here.short(a)}={write_value(parameters[a[0]], file.values[a])}"
        for a in file.addresses()
        if a in file.values
    ]
    return "\n".join(["(STEPS)", *lines]) + "\n"


FORMAT = TextFormat("stp", "stepper list", ".stp", lambda text: text.startswith("(STEPS)"), _read, _write)


# -- a separate protocol ---------------------------------------------------------------------------


class Driver(HouseContent):
    """Speaks to a stepper control; those of the tests are ``BENCH``, by the host that an endpoint names."""

    abilities = Abilities()
    BENCH: ClassVar[dict[str, bytes]] = {}

    def __init__(self, endpoint: Endpoint, family: str) -> None:
        self._host, self._family = endpoint.host, family

    def identify(self, exchange: Exchange = QUIET) -> ControlIdentity:
        if self._host not in self.BENCH:
            raise NoConnectionError("no connection to the control")
        if self._family not in {"", FAMILY}:
            raise WrongFamilyError(f"the control is of the family {FAMILY}, not {self._family}")
        digest = hashlib.sha256(self.BENCH[self._host]).digest()
        return ControlIdentity(
            FAMILY, "dnc", "STEPPER", "7", load_schema(FAMILY).signature, axes=("X", "Y"), sha256=digest
        )

    def fetch(self, exchange: Exchange = QUIET, stage: str = "upload") -> bytes:
        return self.BENCH[self._host]

    def send(self, replacement: Replacement, exchange: Exchange = QUIET) -> Receipt:
        self.BENCH[self._host] = replacement.content
        return Receipt()

    def close(self) -> None:
        pass


# -- the law of its axes ---------------------------------------------------------------------------


GAIN, PERIOD, LAST = 0, 1, 0


def position_sample(p: Vector, s: Vector, io: Vector) -> None:
    """Ask for a torque in proportion to the following error, less the velocity."""
    velocity = (io[POSITION] - s[LAST]) / p[PERIOD]
    s[LAST] = io[POSITION]
    io[OUTPUT] = 4.0 * (p[GAIN] * (io[COMMAND] - io[POSITION]) - velocity)


def _axis(read: AxisParameters) -> AxisLaw:
    rapid = read.number("model.rapid") / 60.0
    return AxisLaw(
        axis=read.axis,
        unit="mm",
        title="stepper axis",
        position_sample=position_sample,
        velocity_sample=None,
        parameters=(20.0, 0.001),
        state_size=1,
        servo_period=0.001,
        velocity_period=0.001,
        machine=Machine(acceleration_per_output=50.0),
        output_unit="%",
        position_rate=20.0,
        feedrate=rapid,
        inposition_band=0.02,
        ramps={"linear": Ramp("linear", 500.0)},
    )


LAW = Law(_axis, axes=lambda _file: ("X",))

HERE = __name__
REGISTRATION = Registration(
    family=FAMILY,
    formulas=f"{HERE}:FORMULAS",
    formats=(f"{HERE}:FORMAT",),
    drivers={"dnc": f"{HERE}:Driver"},
    law=f"{HERE}:LAW",
    facts=Path(__file__).parent / "facts",
)
