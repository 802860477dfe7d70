"""Many files, one after the other: each is checked by what differs from one that was checked before.

The files of a shop have most of their values in common, so most of a full run comes to what the last one
came to. What an edit does (``Validator.recheck``) is done for all that differs between two files.
"""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from contextlib import contextmanager
from pathlib import Path

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Schema

from .beside import earlier_beside
from .builder_rules import NO_RULES, BuilderRules
from .validator import Validator

_Kind = tuple[Schema, str, str, str]
"""Schema, machine type, model and units: what a validator is made for."""
_OF_A_KIND, _KINDS = 4, 16
"""Validators that are kept: a megabyte each."""
_SHARE = 4
"""Part of the values that may differ; with more a full run is quicker."""


class KeptValidators:
    """Validators of files that were checked; what they found of one file is asked before the next one."""

    def __init__(self) -> None:
        self._kept: dict[_Kind, list[Validator]] = {}
        """Of each kind the one that was asked last at the end."""

    @contextmanager
    def validator_of(self, file: ParameterFile, path: Path | None, own: BuilderRules) -> Iterator[Validator]:
        """Yield what finds the findings of a file at ``path``, the same as ``beside.validator_of`` does. Its
        file may be another object with the same content.

        A builder's rules are those of a folder: a file with such is checked by itself.
        """
        earlier = earlier_beside(path, file) if path else ()
        if own is not NO_RULES:
            yield Validator(file, own, earlier)
            return
        header = file.header
        kind = (file.schema, file.machine, header.application, header.units)
        validators = self._kept.pop(kind, [])
        nearest, differing = _nearest(validators, file)
        if nearest is None:
            nearest = Validator(file, own, earlier)
        else:
            # What ends in an error may be half done: it is kept only after that.
            validators.remove(nearest)
            nearest.take_over(file, differing, earlier)
        yield nearest
        self._kept[kind] = [*validators[1 - _OF_A_KIND :], nearest]
        if len(self._kept) > _KINDS:
            # The one that was asked longest ago: each use puts its kind at the end.
            del self._kept[next(iter(self._kept))]


def _nearest(
    validators: list[Validator], file: ParameterFile
) -> tuple[Validator | None, AbstractSet[Address]]:
    """Return the validator whose file differs least from another one, and in what;
    none where all differ in too much.
    """
    most = len(file.values) // _SHARE
    nearest: Validator | None = None
    least: AbstractSet[Address] = frozenset()
    for validator in reversed(validators):
        differing = validator.file.differing(file)
        if len(differing) <= most and validator.has_run:
            # From now on only one that differs in fewer.
            nearest, least, most = validator, differing, len(differing) - 1
    return nearest, least
