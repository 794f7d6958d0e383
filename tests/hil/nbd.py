"""Disks that QEMU reads over a socket, so that they can misbehave: slow ones, and ones whose power is cut.

Bytes    the NBD protocol, newstyle handshake, fixed; big-endian.
Units    bytes; seconds where the name says so.
Threads  one for each connection; `cut` may be called from any.
Source   https://github.com/NetworkBlockDevice/nbd/blob/master/doc/proto.md
"""

import contextlib
import os
import pathlib
import random
import socket
import struct
import threading
import time

SECTOR = 512
HAS_FLAGS, SEND_FLUSH, SEND_FUA = 1, 4, 8
OPTION_EXPORT_NAME, OPTION_ABORT, OPTION_INFO, OPTION_GO = 1, 2, 6, 7
REPLY_ACK, REPLY_INFO, REPLY_UNSUPPORTED = 1, 3, 0x80000001
REPLY_MAGIC = 0x3E889045565A9
COMMAND_READ, COMMAND_WRITE, COMMAND_DISCONNECT, COMMAND_FLUSH = range(4)
COMMAND_FLAG_FUA = 1
EIO = 5


class Server:
    """Serves one disk over a socket. A subclass defines `read(place, length)`, which returns the bytes, `write(place, data, through)` and
    `flush()`. Each may raise OSError, whose number is reported to the machine. The server makes one call at a time."""

    def __init__(self, path, size):
        self.path, self._size = pathlib.Path(path), size
        self._lock = threading.Lock()
        self._listens = socket.socket(socket.AF_UNIX)
        self.path.unlink(missing_ok=True)
        self._listens.bind(os.fspath(self.path))
        self._listens.listen(4)
        self._accepts = threading.Thread(target=self._accept, daemon=True)
        self._accepts.start()

    def stop(self):
        # The thread must end before the socket is closed: a thread that is about to call accept() would use the number of the closed
        # socket, and so take a client of the next one.
        self._listens.shutdown(socket.SHUT_RDWR)
        self._accepts.join()
        self._listens.close()
        self.path.unlink(missing_ok=True)

    def pause(self, kind):
        """Called before the server answers a command; it may block, and other connections are served at the same time."""

    def _accept(self):
        while True:
            try:
                connection, _ = self._listens.accept()
            except OSError:
                return
            threading.Thread(target=self._serve, args=(connection,), daemon=True).start()

    def _serve(self, connection):
        with contextlib.suppress(EOFError, OSError), connection:
            if self._handshake(connection):
                while self._command(connection):
                    pass

    @staticmethod
    def _receive(connection, length):
        found = bytearray()
        while len(found) < length:
            more = connection.recv(min(1 << 20, length - len(found)))
            if not more:
                raise EOFError
            found += more
        return bytes(found)

    def _handshake(self, connection):
        flags = HAS_FLAGS | SEND_FLUSH | SEND_FUA
        connection.sendall(b"NBDMAGIC" + b"IHAVEOPT" + struct.pack(">H", 3))
        self._receive(connection, 4)
        while True:
            _, option, length = struct.unpack(">8sII", self._receive(connection, 16))
            self._receive(connection, length)

            def reply(kind, data=b"", option=option):
                connection.sendall(struct.pack(">QIII", REPLY_MAGIC, option, kind, len(data)) + data)

            if option in (OPTION_INFO, OPTION_GO):
                reply(REPLY_INFO, struct.pack(">HQH", 0, self._size, flags))
                reply(REPLY_ACK)
                if option == OPTION_GO:
                    return True
            elif option == OPTION_EXPORT_NAME:
                connection.sendall(struct.pack(">QH", self._size, flags) + bytes(124))
                return True
            elif option == OPTION_ABORT:
                reply(REPLY_ACK)
                return False
            else:
                reply(REPLY_UNSUPPORTED)

    def _command(self, connection):
        _, flags, kind, handle, place, length = struct.unpack(">IHH8sQI", self._receive(connection, 28))
        data = self._receive(connection, length) if kind == COMMAND_WRITE else b""
        if kind == COMMAND_DISCONNECT:
            return False
        self.pause(kind)
        answer, error = None, 0
        try:
            with self._lock:
                if kind == COMMAND_READ:
                    answer = self.read(place, length)
                elif kind == COMMAND_WRITE:
                    self.write(place, data, bool(flags & COMMAND_FLAG_FUA))
                elif kind == COMMAND_FLUSH:
                    self.flush()
        except OSError as wrong:
            error = wrong.errno
        connection.sendall(struct.pack(">II8s", 0x67446698, error, handle) + (answer or b""))
        return True


class Disk(Server):
    """A disk with a volatile write cache, as real ones have: written data are durable once the host has flushed, or has written
    them with FUA. `image` is read at the start and never written. `delay_s`: delay of each read; `cut_after`: the power is cut after so
    many writes, and without it each write fails; `tell_at`: the read at which `is_reached` is set; `change`: called before each read with
    the disk's bytes, the place and the length."""

    def __init__(self, path, image, delay_s=0.0, cut_after=None, seed=0, tell_at=None, change=None, size=None):
        self.delay_s, self.cut_after, self.tell_at, self.change = delay_s, cut_after, tell_at, change
        self.writes = self.flushes = self.reads = 0
        self._now = bytearray(pathlib.Path(image).read_bytes()) if size is None else None
        self._durable = bytearray(self._now) if cut_after is not None else None
        self._head = pathlib.Path(image).read_bytes() if size is not None else b""
        self._unflushed = []
        self._random = random.Random(seed)
        self.is_cut, self.is_reached = threading.Event(), threading.Event()
        super().__init__(path, len(self._now) if size is None else size)

    def stop(self):
        self.is_cut.set()
        super().stop()

    def cut(self):
        """Cuts the power: a random share of the sectors that were not flushed stays on the disk."""
        with self._lock:
            self._cut()

    def _cut(self):
        if self.is_cut.is_set():
            return
        self.is_cut.set()
        share = self._random.choice((0.0, 0.5, 0.9, 1.0))
        for place, data in self._unflushed:
            for at in range(0, len(data), SECTOR):
                if self._random.random() < share:
                    self._durable[place + at:place + at + SECTOR] = data[at:at + SECTOR]

    def survived(self, image):
        """Writes the contents of the disk after the cut into `image`."""
        assert self.is_cut.is_set()
        pathlib.Path(image).write_bytes(self._durable)

    def pause(self, kind):
        if kind == COMMAND_READ and self.delay_s:
            time.sleep(self.delay_s)

    def _fail(self, otherwise):
        if otherwise or self.is_cut.is_set():
            raise OSError(EIO, "the disk fails")

    def read(self, place, length):
        self._fail(False)
        self.reads += 1
        if self.reads == self.tell_at:
            self.is_reached.set()
        if self._now is None:  # the disk is larger than memory; bytes after the end of the image are zero
            return self._head[place:place + length].ljust(length, b"\0")
        if self.change:
            self.change(self._now, place, length)
        return bytes(self._now[place:place + length])

    def write(self, place, data, through):
        self._fail(False)
        self.writes += 1
        self._fail(self.cut_after is None)
        self._now[place:place + len(data)] = data
        if through:
            self._durable[place:place + len(data)] = data
        else:
            self._unflushed.append((place, data))
        if self.writes == self.cut_after:
            self._cut()

    def flush(self):
        self._fail(False)
        self.flushes += 1
        for place, data in self._unflushed:
            self._durable[place:place + len(data)] = data
        self._unflushed.clear()
