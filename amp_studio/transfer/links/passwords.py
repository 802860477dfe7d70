"""Where the password of a control comes from: the environment, the system's keyring,
or the person at the terminal.

Never the command line, an address or a file: those are shown, logged and kept.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from importlib import import_module
from typing import Literal

from .endpoint import Endpoint

ENVIRONMENT = "AMP_STUDIO_PASSWORD"
_SERVICE = "amp-studio"
"""Under which the keyring has passwords, each with its address: ``keyring set amp-studio
tcp://host:port``."""

Ask = Callable[[str], str]


class _Known:
    """What this run of the program knows: passwords that were entered, and who can be asked."""

    def __init__(self) -> None:
        self.entered: dict[str, str] = {}
        self.ask: Ask | None = None


_known = _Known()


def ask_with(ask: Ask | None, *, forget: bool = True) -> None:
    """Have a person asked for a password that is in no other place;
    ``ask`` gets the address and may raise KeyboardInterrupt.
    """
    _known.ask = ask
    if forget:
        _known.entered.clear()


def find_password(endpoint: Endpoint) -> str:
    """Return the password set for a control, "" for none: then it is only asked for if the control does."""
    place = place_of(endpoint)
    return _known.entered.get(place) or os.environ.get(ENVIRONMENT, "") or _from_keyring(place)


def ask_password(endpoint: Endpoint) -> str:
    """Return what a person enters, "" where there is no terminal to ask at."""
    place = place_of(endpoint)
    if _known.ask is not None:
        _known.entered[place] = _known.ask(place)
    return _known.entered.get(place, "")


def enter_password(endpoint: Endpoint, password: str) -> None:
    """Take a password for this run of the program; an empty one forgets what was entered before."""
    _known.entered[place_of(endpoint)] = password


def kept_password(endpoint: Endpoint) -> Literal["entered", "environment", "keyring"] | None:
    """Return where the password of a control is kept, None where there is none."""
    place = place_of(endpoint)
    if _known.entered.get(place):
        return "entered"
    if os.environ.get(ENVIRONMENT):
        return "environment"
    return "keyring" if _from_keyring(place) else None


def forget_password(endpoint: Endpoint) -> None:
    """Forget the password of a control, also in the keyring; raises RuntimeError where that refuses, and
    for one of the environment.
    """
    place = place_of(endpoint)
    _known.entered.pop(place, None)
    if _from_keyring(place):
        try:
            import_module("keyring").delete_password(_SERVICE, place)
        except Exception as error:  # each system's keyring has its own errors
            raise RuntimeError(f"The keyring does not delete the password of {place}: {error}") from error
    if os.environ.get(ENVIRONMENT):
        raise RuntimeError(f"The password is in {ENVIRONMENT}, which this program cannot change.")


def place_of(endpoint: Endpoint) -> str:
    """Return the address by which a password is kept."""
    host = f"[{endpoint.host}]" if ":" in endpoint.host else endpoint.host
    return f"{endpoint.kind}://{host}:{endpoint.port}"


def _from_keyring(place: str) -> str:
    try:
        return import_module("keyring").get_password(_SERVICE, place) or ""
    except ModuleNotFoundError:
        return ""
    # a keyring that is locked, broken or not there has no password for us; the control asks if it needs one
    except Exception:
        return ""
