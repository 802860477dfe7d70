"""The sandbox of a project's template, with a bound for its time and for what one operation may make.

Imported only where a template of a project is there: jinja2 takes a while to load.
"""

from __future__ import annotations

import re
import time
from collections.abc import Mapping
from pathlib import Path
from types import CodeType
from typing import Any, ClassVar

from jinja2 import BytecodeCache, StrictUndefined, nodes
from jinja2.bccache import Bucket
from jinja2.exceptions import SecurityError
from jinja2.runtime import Context
from jinja2.sandbox import ImmutableSandboxedEnvironment
from jinja2.utils import missing

from amp_studio.schema import did_you_mean

_MAX_SIZE_MADE = 2**24
"""Characters, elements or bits that one operation may make."""
_WIDE = re.compile(r"%[^a-zA-Z%]*(?:\d{6}|\*)")
_TICK = "_within_time"
_GIVEN = ("counted", "language", "report")
"""What a template can name."""
_WIDENING = ("batch", "center", "indent", "slice")
"""Filters whose argument is the size of what they make."""


class UnknownName(StrictUndefined):
    """A name in a template that does not exist; its message has the nearest one that does."""

    @property
    def _undefined_message(self) -> str:
        name, owner = self._undefined_name, self._undefined_obj
        if self._undefined_hint or not isinstance(name, str):
            return self._undefined_hint or f"there is no element {name}"
        if owner is missing:
            return f"there is no '{name}'{did_you_mean(name, _GIVEN)}"
        known = owner if isinstance(owner, Mapping) else (n for n in dir(owner) if not n.startswith("_"))
        return f"there is no '{name}' in a {type(owner).__name__}{did_you_mean(name, map(str, known))}"


class StandardTemplates(BytecodeCache):
    """The program's own templates as this sandbox compiles them, once a process: a preview fills them at
    every edit. A project's template is compiled each time.
    """

    _made: ClassVar[dict[tuple[str, str], CodeType]] = {}
    """Key and checksum of a source -> its code."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def get_cache_key(self, name: str, filename: str | None = None) -> str:
        """Return "" for a template that is not the program's."""
        is_own = filename is not None and Path(filename).parent == self._folder
        return super().get_cache_key(name, filename) if is_own else ""

    def load_bytecode(self, bucket: Bucket) -> None:
        """Give a bucket the code that is known."""
        bucket.code = self._made.get((bucket.key, bucket.checksum))

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Keep the code of a bucket."""
        if bucket.key and bucket.code is not None:
            self._made[bucket.key, bucket.checksum] = bucket.code


class BoundedEnvironment(ImmutableSandboxedEnvironment):
    """A sandbox in which every loop and every call looks at the clock:
    a template that only works is ended too.

    It changes nothing of the report, which is printed without it where it fails.
    """

    # Those that make something large of two small operands; intercepting the others would only cost time.
    intercepted_binops = frozenset({"*", "**", "%"})

    def __init__(self, seconds: float, **settings: Any) -> None:
        super().__init__(**settings)
        self._end = time.monotonic() + seconds
        self.globals[_TICK] = self.check_time
        for name in _WIDENING:
            self.filters[name] = _narrow(self.filters[name])

    def check_time(self) -> None:
        """Raise SecurityError when the time is over."""
        if time.monotonic() > self._end:
            raise SecurityError("works without end")

    def call(self, context: Context, function: Any, /, *args: Any, **kwargs: Any) -> Any:
        """Call what a template calls, while there is time."""
        self.check_time()
        return super().call(context, function, *args, **kwargs)

    def call_binop(self, context: Context, operator: str, left: Any, right: Any) -> Any:
        """Calculate what is not too large; raises SecurityError."""
        if _made(operator, left, right) > _MAX_SIZE_MADE:
            raise SecurityError(f"'{operator}' makes too much")
        return super().call_binop(context, operator, left, right)

    def _parse(self, source: str, name: str | None, filename: str | None) -> nodes.Template:
        """Let every loop look at the clock: jinja2 parses with this for its compiler."""
        template = super()._parse(source, name, filename)
        for loop in template.find_all(nodes.For):
            tick = nodes.ExprStmt(nodes.Call(nodes.Name(_TICK, "load"), [], [], None, None))
            # With the line of its loop, so that the mistake names it.
            loop.body.insert(0, tick.set_lineno(loop.lineno))
        # The inserted nodes have none, and the compiler asks each node for it.
        template.set_environment(self)
        return template


def _made(operator: str, left: Any, right: Any) -> int:
    """Return about how much an operation makes: elements, characters or bits."""
    if operator == "%":
        return _MAX_SIZE_MADE + 1 if isinstance(left, str) and _WIDE.search(left) else 0
    if isinstance(right, int) and isinstance(left, int):
        bits = left.bit_length()
        # In bits: 2 ** 10 ** 9 would take all memory before the clock is read again.
        return bits * abs(right) if operator == "**" else bits + right.bit_length()
    times, many = (left, right) if isinstance(left, int) else (right, left)
    if isinstance(times, int) and isinstance(many, str | bytes | list | tuple):
        return len(many) * times
    return 0


def _narrow(made: Any) -> Any:
    """Return a filter that takes no huge number for what it makes."""

    def narrow(value: Any, *args: Any, **kwargs: Any) -> Any:
        if any(isinstance(each, int) and each > _MAX_SIZE_MADE for each in (*args, *kwargs.values())):
            raise SecurityError("a filter makes too much")
        return made(value, *args, **kwargs)

    return narrow
