"""Ends all processes that a program has started, and their descendants, however the program itself ends.

Signals  SIGINT, SIGTERM and SIGHUP raise Ended in the main thread, which unittest does not catch, like KeyboardInterrupt.
Threads  the main thread.
Source   prctl(2), PR_SET_CHILD_SUBREAPER; proc(5), /proc/PID/stat.
"""

import contextlib
import ctypes
import os
import pathlib
import signal
import time

PR_SET_CHILD_SUBREAPER = 36
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
PATIENCE_S = 10.0  # between SIGTERM and SIGKILL


class Ended(KeyboardInterrupt):
    """Raised when a signal asks the program to end."""

    def __init__(self, number):
        super().__init__(signal.Signals(number).name)
        self.status = 128 + number  # as in a shell


def _raise_ended(number, _frame):
    """Raises Ended for the first signal only. A repeated signal is ignored, so that it does not interrupt the ending of the family."""
    for each in SIGNALS:
        signal.signal(each, lambda *_: None)
    raise Ended(number)


def descendants():
    """The process numbers of all living descendants, including orphans, which the subreaper adopts."""
    children = {}
    for file in pathlib.Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            fields = file.read_text(encoding="ascii", errors="replace").rpartition(")")[2].split()
            if fields[0] != "Z":
                children.setdefault(int(fields[1]), []).append(int(file.parent.name))
    found, parents = [], [os.getpid()]
    while parents:
        below = children.get(parents.pop(), [])
        found += below
        parents += below
    return found


def _reap():
    """Collects the children that have ended, and returns whether others live.

    Without a living child there is no descendant, because the subreaper adopts each orphan. The list of /proc cannot prove that: it
    misses a process whose parent started it after the list was read and ended before its own entry was.
    """
    with contextlib.suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0] != 0:
            pass
        return True
    return False


def _end_all():
    begun = time.monotonic()
    while _reap():
        number = signal.SIGTERM if time.monotonic() - begun < PATIENCE_S else signal.SIGKILL
        for process in descendants():
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, number)
        time.sleep(0.1)


class Family:
    """`with Family() as family`: ends all processes started inside it; after `family.keep = True` only if it is interrupted."""

    def __init__(self):
        self.keep = False

    def __enter__(self):
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        for number in SIGNALS:
            signal.signal(number, _raise_ended)
        return self

    def __exit__(self, kind, error, trace):
        for number in SIGNALS:
            signal.signal(number, lambda *_: None)  # not SIG_IGN, which a program that a thread starts now would inherit
        if kind is not None or not self.keep:
            _end_all()
