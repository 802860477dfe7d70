"""How long to wait for an answer: the adaptive timeout of both directions of a transfer."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class RetryPolicy:
    """Bounds of waiting, in seconds, and how often a request is repeated before the line counts as dead."""

    first: float = 0.7
    least: float = 0.1
    most: float = 5.0
    tries: int = 5


class RetryTimer:
    """The time an answer takes, learnt from those that came (smoothed mean and deviation, after RFC 6298)."""

    def __init__(self, policy: RetryPolicy) -> None:
        self.policy = policy
        self._mean: float | None = None
        self._deviation = 0.0
        self._stretch = 1.0

    @property
    def timeout(self) -> float:
        """Seconds after which an answer counts as lost."""
        expected = self.policy.first if self._mean is None else self._mean + 4 * self._deviation
        return min(self.policy.most, max(self.policy.least, expected) * self._stretch)

    def answered(self, seconds: float) -> None:
        """An answer took this long."""
        if self._mean is None:
            self._mean, self._deviation = seconds, seconds / 2
        else:
            self._deviation += (abs(seconds - self._mean) - self._deviation) / 4
            self._mean += (seconds - self._mean) / 8
        self._stretch = 1.0

    def missed(self) -> None:
        """An answer did not come: wait twice as long for the next."""
        self._stretch = min(self._stretch * 2, 64.0)
