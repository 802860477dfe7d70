"""Byte links to a control: TCP, serial lines, pseudo terminals, and the endpoints people write for them."""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .endpoint import Endpoint, EndpointError, is_endpoint, parse_endpoint
    from .link import Link, LinkError, Listener
    from .opening import connect, listen
    from .password import PasswordError, TooManyWrongError
    from .passwords import ask_with, enter_password, forget_password, kept_password
    from .pseudo_terminal import PtyLink
    from .security import Security, can_others_read, exposure, read_password
    from .serial_line import SerialLink
    from .serial_settings import Parity, SerialSettings
    from .tcp import TcpLink
    from .usb_ports import serial_ports
else:
    __getattr__ = front_page(__name__)
