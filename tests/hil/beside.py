"""Runs pieces of work beside one another, each in a process of its own; what one says is printed in whole blocks.

Threads  the main thread of a program that has no other yet: the processes are forks of it.
Errors   a piece of work whose process ends without a result counts as None; the reason is printed.
Source   multiprocessing.connection.wait, Python's library reference.
"""

import io
import multiprocessing
import multiprocessing.connection
import os
import sys
import traceback

from family import Ended


class _Blocks(io.StringIO):
    """Keeps what is printed until the block ends."""

    def __init__(self, line):
        super().__init__()
        self._line = line

    def end(self):
        if text := self.getvalue():
            self._line.send(("block", text))
        self.seek(0)
        self.truncate()


def end_block():
    """What was printed since the last block belongs together. Without other work beside it everything is printed at once."""
    if isinstance(sys.stdout, _Blocks):
        sys.stdout.end()


def _do(work, line):
    sys.stdout = sys.stderr = blocks = _Blocks(line)
    result = None
    try:
        result = work()
    except Ended as ended:
        os._exit(ended.status)  # who sent the signal to the family ends what was started here
    except BaseException:  # pylint: disable=broad-except
        traceback.print_exc()
    blocks.end()
    line.send(("result", result))


def beside(works):
    """What each of `works`, functions without arguments, returns, in their order."""
    context = multiprocessing.get_context("fork")
    results, numbers = [None] * len(works), {}
    sys.stdout.flush()
    for number, work in enumerate(works):
        here, there = context.Pipe(duplex=False)
        context.Process(target=_do, args=(work, there)).start()
        there.close()
        numbers[here] = number
    while numbers:
        for line in multiprocessing.connection.wait(list(numbers)):
            number = numbers[line]
            try:
                kind, said = line.recv()
            except EOFError:
                del numbers[line]
                continue
            if kind == "result":
                results[number] = said
            else:
                print(f"[{number + 1}] {said}", end="" if said.endswith("\n") else "\n", flush=True)
    return results
