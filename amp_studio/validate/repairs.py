"""Repairs of many findings at once."""

from __future__ import annotations

from contextlib import suppress

from amp_studio.files import RangeFault
from amp_studio.schema import Address

from .validator import Validator

_ROUNDS = 10
"""A repair may leave another finding, whose repair may leave another; two that contradict each other end here."""


def repair_all_safe(validator: Validator) -> dict[Address, None]:
    """Apply every repair that cannot change motion, until there is none; returns the addresses that were set.

    The findings are up to date before and after. Of two findings that want one parameter to have different values,
    the more severe one has it.
    """
    changed: dict[Address, None] = {}
    file = validator.file
    for _ in range(_ROUNDS):
        done: dict[Address, None] = {}
        for finding in validator.findings():  # errors come first
            wanted = {repair.address: repair.value for repair in finding.repairs}
            if finding.safe and done.keys().isdisjoint(wanted):
                with suppress(RangeFault):  # its bound moved with another repair
                    done |= dict.fromkeys(change.address for change in file.set_many(wanted))
        if not done:
            break
        changed |= done
        validator.update(done)
    return changed
