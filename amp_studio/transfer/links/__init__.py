"""Byte links to a control: TCP, serial lines, pseudo terminals, and the endpoints people write for them."""

from .endpoint import Endpoint, is_endpoint, parse_endpoint
from .link import Link, LinkError, Listener
from .opening import connect, listen

__all__ = ["Endpoint", "Link", "LinkError", "Listener", "connect", "is_endpoint", "listen", "parse_endpoint"]
