"""The password of a link: each end proves that it knows it, before the first byte of anything else.

Neither the password nor what it could be replaced by passes the line (docs/protocols/password.md).
"""

from __future__ import annotations

import hashlib
import hmac
import re
import secrets
import time
from collections.abc import Callable

from .link import Link, LinkError

GREETING = b"AMP-STUDIO-PASSWORD 1 "
_CHALLENGE = re.compile(rb"AMP-STUDIO-PASSWORD 1 ([0-9a-f]{32}) ([0-9a-f]{64})\n")
PROOF = re.compile(rb"PROOF ([0-9a-f]{64}) ([0-9a-f]{64})\n")
WELCOME = re.compile(rb"WELCOME ([0-9a-f]{64})\n")
LATER = re.compile(rb"LATER ([0-9]{1,3})\n")
WRONG = b"WRONG\n"
LONGEST = 256  # bytes of a line; the longest has 137

BEGINNING = 0.5  # seconds after which what only begins like a challenge is none
_MAX_BYTES_KEPT = 65_536  # bytes that are written before anything has come from the other end
ROUNDS = 200_000  # of PBKDF2: a tenth of a second for each guess of who has recorded a proof
NO_TLS = bytes(32)
"""Takes in a proof the place of the digest of the server's certificate where there is no TLS."""

_LONGEST_DELAY = 32.0  # seconds between two guesses of one host
_HOSTS = 256  # whose wrong guesses are remembered, the latest


class PasswordError(LinkError):
    """The other end asks for a password, does not know it, or does not take it."""


class TooManyWrongError(PasswordError):
    """Others were wrong just before: the same password may be right a little later."""


def key_of(password: str, salt: bytes) -> bytes:
    """Return what proofs are made with."""
    return hashlib.pbkdf2_hmac("sha256", password.encode(), salt, ROUNDS)


def proof_of(key: bytes, end: bytes, challenge: bytes, certificate: bytes, nonce: bytes) -> bytes:
    """Return the proof of one end (``client`` or ``server``) for one challenge over one certificate,
    in hexadecimal.
    """
    return hmac.new(key, b"\0".join((end, challenge, certificate, nonce)), "sha256").hexdigest().encode()


def prove(
    link: Link, place: object, password: str, certificate: bytes, seconds: float, look: Callable[[], None]
) -> bytes:
    """Prove to a control that this end knows its password, and have it prove the same; raises PasswordError,
    LinkError.

    Returns what the control has sent behind its proof: a greeting of its protocol, for one.
    """
    challenge = _line(link, seconds, look)
    match = _CHALLENGE.fullmatch(challenge)
    if match is None:
        raise PasswordError(str(place), "it asks for no password, and one is set for it: nothing was sent")
    key, nonce = key_of(password, bytes.fromhex(match[1].decode())), secrets.token_hex(32).encode()
    link.write(b"PROOF " + nonce + b" " + proof_of(key, b"client", challenge, certificate, nonce) + b"\n")
    answer, end, rest = _line(link, seconds, look).partition(b"\n")
    answer += end
    if welcome := WELCOME.fullmatch(answer):
        if hmac.compare_digest(welcome[1], proof_of(key, b"server", challenge, certificate, nonce)):
            return rest
        raise PasswordError(
            str(place), "it does not know the password itself: it is not the control it should be"
        )
    if later := LATER.fullmatch(answer):
        raise TooManyWrongError(str(place), f"too many wrong passwords: try again in {int(later[1])} s")
    raise PasswordError(str(place), "the password is wrong")


class ProvenLink:
    """A link whose password is proven; what came behind the proof is read first."""

    def __init__(self, link: Link, rest: bytes) -> None:
        self._link = link
        self._buffer = rest
        self.write, self.close = link.write, link.close

    @property
    def bytes_per_second(self) -> float | None:
        """What the line carries."""
        return self._link.bytes_per_second

    def read(self, timeout: float) -> bytes:
        """Return what has come."""
        rest, self._buffer = self._buffer, b""
        return rest or self._link.read(timeout)


class GuardedLink:
    """A link without a password that notices when the control asks for one, and is opened again with it.

    ``reopen`` returns a link on which the password is proven, and raises PasswordError where none is known.
    """

    def __init__(self, link: Link, reopen: Callable[[], Link]) -> None:
        self._link = link
        self._reopen = reopen
        self._written = self._read = b""
        self._is_settled = False
        self._begun_at = 0.0

    @property
    def bytes_per_second(self) -> float | None:
        """What the line carries."""
        return self._link.bytes_per_second

    def read(self, timeout: float) -> bytes:
        """Return what has come; the first of it may be the question for a password."""
        end = time.monotonic() + timeout
        while not self._is_settled:
            data = self._link.read(max(0.0, end - time.monotonic()))
            if not self._read:
                self._begun_at = time.monotonic()
            self._read += data
            if not data and not (self._read and time.monotonic() - self._begun_at > BEGINNING):
                return b""
            if self._read.startswith(GREETING):
                self._link.close()
                self._link, self._is_settled = self._reopen(), True
                self._link.write(self._written)
            elif not data or not GREETING.startswith(self._read):
                self._is_settled = True
                return self._read
        return self._link.read(max(0.0, end - time.monotonic()))

    def write(self, data: bytes) -> None:
        """Write; until something has come from the other end, what was written is kept."""
        if not self._is_settled and len(self._written) < _MAX_BYTES_KEPT:
            self._written += data
        self._link.write(data)

    def close(self) -> None:
        """Give the line up."""
        self._link.close()


def _line(link: Link, seconds: float, look: Callable[[], None]) -> bytes:
    """Return a line and what came with it, or what has come in time."""
    got, end = b"", time.monotonic() + seconds
    while b"\n" not in got and len(got) <= LONGEST and (left := end - time.monotonic()) > 0:
        look()
        got += link.read(min(left, 0.1))
    return got


class Gate:
    """The control's side: knows the key, and makes each host wait longer after each wrong proof."""

    def __init__(self, password: str, clock: Callable[[], float] = time.monotonic) -> None:
        self._salt = secrets.token_bytes(16)
        self._key = key_of(password, self._salt)
        self._clock = clock
        self._wrong: dict[str, tuple[int, float]] = {}  # host -> how often, and when it may try again

    def challenge(self) -> bytes:
        """Return a line that no other connection has got."""
        return GREETING + self._salt.hex().encode() + b" " + secrets.token_hex(32).encode() + b"\n"

    def answer(self, host: str, challenge: bytes, proof: bytes, certificate: bytes) -> tuple[bytes, bool]:
        """Return the answer to a proof, and whether the link may be used."""
        match = PROOF.fullmatch(proof)
        if match is None:
            return WRONG, False  # no guess: who does not know of passwords speaks another protocol
        count, again_at = self._wrong.get(host, (0, 0.0))
        left = again_at - self._clock()
        if left > 0:  # a right one too: who guesses does not learn it
            return b"LATER %d\n" % max(1, round(left)), False
        if hmac.compare_digest(match[2], proof_of(self._key, b"client", challenge, certificate, match[1])):
            self._wrong.pop(host, None)
            return (
                b"WELCOME " + proof_of(self._key, b"server", challenge, certificate, match[1]) + b"\n",
                True,
            )
        self._wrong.pop(host, None)
        self._wrong[host] = count + 1, self._clock() + min(_LONGEST_DELAY, 2.0 ** min(count - 1, 9))
        if len(self._wrong) > _HOSTS:
            self._wrong.pop(next(iter(self._wrong)))
        return WRONG, False
