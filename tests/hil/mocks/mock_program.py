"""The common part of programs that play a device: options, commands to a running one, the run until it is stopped."""

import argparse
import asyncio
import json
import signal
import sys

from . import control, links
from .faults import parse_duration


def parse_at(text):
    words = text.split(maxsplit=1)
    seconds = parse_duration(words[0]) if words else None
    if seconds is None or len(words) != 2:
        raise argparse.ArgumentTypeError(f"'{text}' is not a time and a command, such as '5s unplug 2s'")
    return seconds, words[1]


def add_arguments(parser):
    links.add_arguments(parser)
    parser.add_argument("--control", metavar="SOCKET", help="listen there for commands")
    parser.add_argument("--at", metavar="'TIME COMMAND'", type=parse_at, action="append", default=[],
                        help="a command at a time after the start; may be given again")
    parser.add_argument("--tell", metavar=("SOCKET", "COMMAND"), nargs="+",
                        help="send a command to a running mock, and end")


def parse_arguments(parser):
    arguments = parser.parse_args()
    if arguments.tell:
        if len(arguments.tell) < 2:
            parser.error("--tell needs the control socket and a command")
    elif not links.chosen(arguments):
        parser.error("say how the device is connected: " + ", ".join(links.OPTIONS))
    return arguments


def tell(arguments):
    path = arguments.tell[0]
    try:
        answer = control.tell(path, " ".join(arguments.tell[1:]))
    except OSError as error:
        raise OSError(f"{path}: no mock listens there: {error.strerror or error}") from None
    print(answer["help"] if "help" in answer else json.dumps(answer, indent=1))
    return 0 if answer["ok"] else 1


async def run(name, arguments, device, execute, life):
    """Runs until SIGINT or SIGTERM, or until the link has ended. `life()` is what the device does by itself."""
    link = links.make(arguments, device)
    loop = asyncio.get_running_loop()
    stopped = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, stopped.set)

    def carry_out(command):
        answer = control.carry_out(execute, command)
        if not answer["ok"]:
            print(f"{name}: {answer['error']}", file=sys.stderr)

    for seconds, command in arguments.at:
        if seconds == 0:
            carry_out(command)
        else:
            loop.call_later(seconds, carry_out, command)
    try:
        where = await link.open()
    except OSError as error:
        raise OSError(f"{links.chosen(arguments)}: {error.strerror or error}") from None
    if arguments.control:
        await control.serve(arguments.control, execute)  # when this socket exists, the device does too
    print(f"{name}: {where}", file=sys.stderr, flush=True)
    tasks = [asyncio.create_task(work) for work in (life(), link.ended(), stopped.wait())]
    done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    link.close()
    for task in done:
        task.result()  # raises what the task raised
