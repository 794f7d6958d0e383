"""The ways to connect a mock to a host, and their options on the command line."""

import argparse

from .raw import PtyLink, SocketLink, StdioLink
from .usbip import UsbipServerLink, VhciLink
from .usbredir import UsbredirLink

OPTIONS = ("--usbredir", "--usbip", "--vhci", "--socket", "--pty", "--stdio")
_USBIP_PORT = 3240


def _address(text):
    address, _, port = text.rpartition(":")
    if not port.isdecimal() or not 0 < int(port) < 65536:
        raise argparse.ArgumentTypeError(f"'{text}' is not a port nor ADDRESS:PORT")
    return address or "127.0.0.1", int(port)


def add_arguments(parser):
    group = parser.add_argument_group("connection, one of").add_mutually_exclusive_group()
    group.add_argument("--usbredir", metavar="SOCKET", help="to QEMU: listen there for its usb-redir device")
    group.add_argument("--usbip", metavar="[ADDRESS:]PORT", type=_address, nargs="?", const=("127.0.0.1", _USBIP_PORT),
                       help=f"to any Linux machine: listen there for 'usbip attach' (127.0.0.1:{_USBIP_PORT})")
    group.add_argument("--vhci", action="store_true",
                       help="to this Linux machine itself; needs root, and 'modprobe vhci-hcd' before")
    group.add_argument("--socket", metavar="SOCKET",
                       help="only the bytes, at a Unix socket that exists while the device is plugged in")
    group.add_argument("--pty", action="store_true", help="only the bytes, at a new pseudo-terminal")
    group.add_argument("--stdio", action="store_true", help="only the bytes, by standard input and output")


def chosen(arguments):
    """The link's option that was given, or None."""
    return next((option for option in OPTIONS if getattr(arguments, option[2:])), None)


def make(arguments, device):
    if arguments.usbredir:
        return UsbredirLink(device, arguments.usbredir)
    if arguments.usbip:
        return UsbipServerLink(device, *arguments.usbip)
    if arguments.vhci:
        return VhciLink(device)
    if arguments.socket:
        return SocketLink(device, arguments.socket)
    return PtyLink(device) if arguments.pty else StdioLink(device)
