"""Many files, each checked by what differs from one before: the findings are those of each by itself."""

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from random import Random

import pytest
from rule_machines import FAMILIES, machines, sound

from amp_studio.files import ParameterFile
from amp_studio.schema import InvalidValueError, Value
from amp_studio.validate import NO_RULES, Validator
from amp_studio.validate.kept_validators import KeptValidators
from tests.campaigns import CAMPAIGN

FILES = 60 if CAMPAIGN else 2
"""Of each family."""
FACTORS = (-1.0, 0.0, 0.1, 2.0, 25.4)


def slipped(base: ParameterFile, random: Random, count: int) -> ParameterFile:
    """Return a copy in which some values are wrong, missing, out of range on purpose, or of another
    choice.
    """
    file = base.copy()
    for address in random.sample(list(file.values), min(count, len(file.values))):
        value, choices = file.values[address], file.schema.parameters[address[0]].choices
        with suppress(InvalidValueError):
            if random.random() < 0.1:
                file.set(address, None)
            elif isinstance(value.value, bool):
                file.set(address, Value(not value.value))
            elif isinstance(value.value, str):
                file.set(address, Value(random.choice(choices).key) if choices else value)
            else:
                number = value.value * random.choice(FACTORS)
                whole = isinstance(value.value, int)
                file.set(address, Value(round(number) if whole else number, value.unit))
                if random.random() < 0.1:
                    file.forced[address] = "by a test"
    return file


def fleet() -> Iterator[ParameterFile]:
    """Yield machines of every family in turns, each a little otherwise damaged than those before."""
    random = Random(21)
    bases = [sound(family, next(iter(machines(family)["machines"]))) for family in FAMILIES]
    for n in range(FILES):
        for base in bases:
            file = slipped(base, random, random.choice((0, 1, 4, 12) if CAMPAIGN else (1, 4)))
            if n % 2:
                file.unknown[f"of.another@{n}"] = "5"
            if random.random() < 0.2 and "inch" in file.schema.family.units:
                file.header.units = "inch"
            yield file


def test_findings_of_a_mixed_fleet_are_those_of_each_file_by_itself() -> None:
    kept, found = KeptValidators(), 0
    for file in fleet():
        alone = Validator(file.copy())
        expected = alone.run()
        with kept.validator_of(file.copy(), None, NO_RULES) as validator:
            assert [*map(repr, validator.findings())] == [*map(repr, expected)], file.schema
            assert validator.not_set == alone.not_set
            assert (validator.file.values, validator.file.header) == (file.values, file.header)
        found += len(expected)
    assert found > len(FAMILIES), "in most of the files something is found"


def test_a_file_that_ends_in_an_error_leaves_nothing_to_the_next(mill: ParameterFile) -> None:
    kept = KeptValidators()
    with kept.validator_of(mill.copy(), None, NO_RULES) as first:
        first.run()
    with pytest.raises(ZeroDivisionError), kept.validator_of(mill.copy(), None, NO_RULES) as second:
        raise ZeroDivisionError
    with kept.validator_of(mill, None, NO_RULES) as third:
        assert third is not second is first


def test_a_file_is_compared_with_its_backup_and_not_with_that_of_the_file_before(
    mill: ParameterFile, tmp_path: Path
) -> None:
    from amp_studio.files import Document

    path, kept = tmp_path / "mill.amp", KeptValidators()
    document = Document.create(mill, path)
    address = ("home.position", "1")
    mill.set(address, Value(20.0, "mm"))
    document.save()
    mill.set(address, Value(200.0, "mm"))
    document.save()
    document.close()
    rules = []
    for at in (None, path, None):
        with kept.validator_of(mill.copy(), at, NO_RULES) as validator:
            rules.append({finding.rule for finding in validator.findings()})
    assert ["plausible.earlier" in found for found in rules] == [False, True, False]
