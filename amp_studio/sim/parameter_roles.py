"""The parameters of a family by what they are to its law, as ``motion.yaml`` names them."""

from __future__ import annotations

from collections.abc import Mapping


class ParameterRoles:
    """The roles as attributes: ``ids.loop_gain`` is the id of a parameter."""

    def __init__(self, params: Mapping[str, str]) -> None:
        self._params = params

    def __getattr__(self, role: str) -> str:
        try:
            return self._params[role]
        except KeyError:
            raise AttributeError(f"motion.yaml has no parameter '{role}'") from None

    def __getitem__(self, role: str) -> str:
        return getattr(self, role)  # type: ignore[no-any-return]  # what __getattr__ gives
