"""A disk's commands in order, and its possible contents if the power fails at any moment.

A machine runs once on a RecordedDisk, which records each write and each flush. A Replay goes through that log and makes, for a moment
and a seed, a disk as a volatile write cache may leave it: all flushed data are there; each piece of the other data is there or not, at
random. The method is that of Linux's dm-log-writes and of CrashMonkey (Mohan and others, OSDI 2018).

Bytes    a log: records of RECORD, each followed by the data of a write or the words of a mark.
Units    bytes; names with _s: seconds since the recording began.
Threads  RecordedDisk: `mark` from any. Replay: one caller.
Errors   OSError; AssertionError if the file is no log.
"""

import collections
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import time
from dataclasses import dataclass

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "hil"))
import nbd  # noqa: E402

SECTOR = nbd.SECTOR
RECORD = struct.Struct(">BBQQd")  # kind, with FUA, place, length, seconds
WRITE, FLUSH, MARK = 1, 2, 3


class RecordedDisk(nbd.Server):
    """Serves the file `disk`, writes into it, and records writes and flushes in `log`."""

    def __init__(self, path, disk, log):
        self._disk = os.open(disk, os.O_RDWR)
        self._log = open(log, "wb")
        self._begun = time.monotonic()
        self.records = 0
        super().__init__(path, os.fstat(self._disk).st_size)

    def stop(self):
        super().stop()
        with self._lock:
            self._log.close()
            os.close(self._disk)

    def _record(self, kind, through, place, data):
        self._log.write(RECORD.pack(kind, through, place, len(data), time.monotonic() - self._begun))
        self._log.write(data)
        self.records += 1

    def mark(self, words):
        """Marks data that the machine has just acknowledged: every later cut must keep it."""
        with self._lock:
            self._record(MARK, False, 0, words.encode())

    def read(self, place, length):
        return os.pread(self._disk, length, place)

    def write(self, place, data, through):
        os.pwrite(self._disk, data, place)
        self._record(WRITE, through, place, data)

    def flush(self):
        self._record(FLUSH, False, 0, b"")


@dataclass(frozen=True)
class Entry:
    kind: int
    through: bool
    place: int
    length: int
    at_s: float
    data_at: int  # in the log

    def words(self, log):
        return os.pread(log.fileno(), self.length, self.data_at).decode()


def entries(log):
    """The records of an open log, without an incomplete last one."""
    found, at, size = [], 0, os.fstat(log.fileno()).st_size
    while at + RECORD.size <= size:
        kind, through, place, length, at_s = RECORD.unpack(os.pread(log.fileno(), RECORD.size, at))
        assert kind in (WRITE, FLUSH, MARK), f"no log of writes, at {at}"
        if at + RECORD.size + length > size:
            break
        found.append(Entry(kind, bool(through), place, length, at_s, at + RECORD.size))
        at += RECORD.size + length
    return found


def sparse_copy(source, target):
    subprocess.run(["cp", "--sparse=always", "--reflink=auto", source, target], check=True)


class Replay:
    """`disk`: a file of the replay's own, made from `image`, the disk before the log. `heeds_flushes`: False ignores every flush and FUA,
    as a faulty disk does; this is the control, in which damage must be found."""

    def __init__(self, image, log, disk, heeds_flushes=True):
        sparse_copy(image, disk)
        self._file = os.open(disk, os.O_RDWR)
        self._log = open(log, "rb")
        self.path, self.entries, self.at = disk, entries(self._log), 0
        self._heeds = heeds_flushes
        self._unflushed = []  # entries, the oldest first; those with FUA are on the disk in any case
        self.generation = {}  # for each name of `watch`: a number that changes when data reach that place
        self._watched = {}

    def close(self):
        os.close(self._file)
        self._log.close()

    def watch(self, name, place, length):
        """Lets `generation[name]` change whenever data reach this place of the disk."""
        self._watched[name], self.generation[name] = (place, place + length), 0

    def _data(self, entry):
        return os.pread(self._log.fileno(), entry.length, entry.data_at)

    def _land(self, place, data):
        os.pwrite(self._file, data, place)
        for name, (begin, end) in self._watched.items():
            if place < end and begin < place + len(data):
                self.generation[name] += 1

    def words(self, entry):
        return entry.words(self._log)

    def advance(self, to):
        """Advances to the moment before record `to`."""
        assert to >= self.at
        while self.at < to:
            entry = self.entries[self.at]
            self.at += 1
            if entry.kind == WRITE:
                self._unflushed.append(entry)
            elif entry.kind == FLUSH and self._heeds:
                for flushed in self._unflushed:
                    self._land(flushed.place, self._data(flushed))
                self._unflushed.clear()

    def unflushed_bytes(self):
        return sum(entry.length for entry in self._unflushed)

    def _survivors(self, chance):
        """(place, data) of the unflushed pieces that reached the disk, in the order of the writes. A disk may write sectors in any order,
        whole pages, whole commands, or everything up to some moment."""
        piece = chance.choice((SECTOR, SECTOR, 4096, None))
        share = chance.choice((0.0, 0.1, 0.5, 0.5, 0.9, 1.0))
        in_order = chance.random() < 0.2
        last = chance.randrange(len(self._unflushed) + 1) if in_order else 0
        for number, entry in enumerate(self._unflushed):
            data = self._data(entry)
            if entry.through and self._heeds:
                yield entry.place, data
                continue
            if in_order:
                if number < last:
                    yield entry.place, data
                continue
            step = piece or max(1, entry.length)
            begin = 0
            while begin < entry.length:  # pieces begin at multiples of their size on the disk
                end = min(entry.length, begin + step - (entry.place + begin) % step) if piece else entry.length
                if chance.random() < share:
                    yield entry.place + begin, data[begin:end]
                begin = end

    def cut(self, chance):
        """Cuts the power: until `mend`, `path` holds one of the disks that this may leave."""
        self._before = []
        generation = dict(self.generation)
        for place, data in self._survivors(chance):
            self._before.append((place, os.pread(self._file, len(data), place)))
            self._land(place, data)
        self._generation = generation

    def mend(self):
        """Restores the disk as it was before `cut`."""
        for place, data in reversed(self._before):
            os.pwrite(self._file, data, place)
        for name, before in self._generation.items():
            if self.generation[name] != before:
                self.generation[name] += 1

    def keep(self, path):
        """Copies the present disk to `path`."""
        sparse_copy(self.path, path)


def moments(log, count, chance, data):
    """`count` moments for each phase: [(record, phase, seed)], in the log's order. It chooses a flush at random, then a write before it, so
    that a long copy between two flushes does not get most of the moments. Every second flush follows writes outside the data partition, if
    there are any: these are few and the most important. `log`: a Replay; `data`: (begin, end) of the data partition."""
    intervals, outside, phase, begin = collections.defaultdict(list), collections.defaultdict(list), "", 0
    for number, entry in enumerate(log.entries):
        if entry.kind in (FLUSH, MARK):
            if number > begin:
                intervals[phase].append((begin, number))
                if not all(data[0] <= written.place < data[1] for written in log.entries[begin:number]):
                    outside[phase].append((begin, number))
            begin = number + 1
        if entry.kind == MARK:
            phase = json.loads(log.words(entry)).get("phase", phase)
    chosen = []
    for phase in sorted(intervals):
        for number in range(count if phase else 0):
            begin, end = chance.choice(outside[phase] if number % 2 and outside[phase] else intervals[phase])
            at = end if chance.random() < 0.5 else chance.randrange(begin, end) + 1  # at the end most data are unflushed
            chosen.append((at, phase, chance.getrandbits(64)))
    return sorted(chosen)


def copy_part(disk, place, length, target):
    """Copies a part of a file with holes into a file of its own."""
    with open(disk, "rb") as source, open(target, "wb") as out:
        out.truncate(length)
        at = place
        while at < place + length:
            try:
                begin = os.lseek(source.fileno(), at, os.SEEK_DATA)
            except OSError:  # nothing but a hole up to the end
                break
            if begin >= place + length:
                break
            at = min(os.lseek(source.fileno(), begin, os.SEEK_HOLE), place + length)
            source.seek(begin)
            out.seek(begin - place)
            shutil.copyfileobj(_Limited(source, at - begin), out, 1 << 20)


class _Limited:
    def __init__(self, file, left):
        self._file, self._left = file, left

    def read(self, max_bytes):
        data = self._file.read(min(max_bytes, self._left))
        self._left -= len(data)
        return data
