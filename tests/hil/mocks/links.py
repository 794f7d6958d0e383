"""The ways to connect a mock to a host, and their options on the command line."""

from .usbredir import UsbredirLink

OPTIONS = ("--usbredir",)


def add_arguments(parser):
    group = parser.add_argument_group("connection, one of").add_mutually_exclusive_group()
    group.add_argument("--usbredir", metavar="SOCKET", help="to QEMU: listen there for its chardev of a usb-redir device")


def chosen(arguments):
    return bool(arguments.usbredir)


def make(arguments, device):
    return UsbredirLink(device, arguments.usbredir)
