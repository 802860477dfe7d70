"""Damaged descriptions of a control: each gives a whole schema or one plain refusal,
and a file of it opens again.
"""

from pathlib import Path

from amp_studio.families.grblhal.described import schema_of
from amp_studio.files import Header, ParameterFile, read_content
from amp_studio.files.parameter_file import fill_defaults
from amp_studio.files.storage import readable_content
from amp_studio.schema.described import DescriptionError
from amp_studio.validate import Validator
from tests.families.grblhal.recorded import HELP, THREE_AXES, build

from .texts import mutants, violations

_TEXTS = [THREE_AXES.decode() + HELP.decode(), build("XYZABC").decode()]
_ALL = 20
"""One description in so many is checked with all rules."""


def fuzz_descriptions(seed: int, count: int) -> list[str]:
    """Make the schema of damaged descriptions."""
    return violations(mutants(_TEXTS, seed, count), _open_with, (DescriptionError,))


def _open_with(text: str) -> None:
    schema = schema_of(text.encode("utf-8", "surrogatepass"))
    assert schema_of(schema.description).signature == schema.signature, "the description is another one"
    file = ParameterFile(schema, Header(machine="grblhal", signature=schema.signature))
    fill_defaults(file)
    for address in file.addresses():
        file.evaluation.state(address)
    if len(text) % _ALL == 0:
        Validator(file).run()
    path = Path("x.amp")
    again = read_content(path, readable_content(file, path))
    assert again.schema.signature == schema.signature
    assert again.values == file.values
