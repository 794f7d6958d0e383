"""A minimal client that writes to a served disk, in place of an emulated PC: for the test of the log."""

import socket
import struct

READ, WRITE, _, FLUSH = range(4)
FUA = 1


class Client:
    """`path`: the server's socket; Source and bytes as in tests/hil/nbd.py."""

    def __init__(self, path):
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.connect(str(path))
        assert self._receive(18)[:16] == b"NBDMAGICIHAVEOPT"
        self._socket.sendall(struct.pack(">I", 3) + b"IHAVEOPT" + struct.pack(">II", 1, 0))
        self.size, flags = struct.unpack(">QH", self._receive(134)[:10])
        assert flags & 0b1100 == 0b1100, "it offers no flush, or no FUA"

    def close(self):
        self._socket.close()

    def _receive(self, length):
        found = b""
        while len(found) < length:
            more = self._socket.recv(length - len(found))
            assert more, "the server hung up"
            found += more
        return found

    def _ask(self, kind, flags, place, length, data=b""):
        self._socket.sendall(struct.pack(">IHH8sQI", 0x25609513, flags, kind, b"12345678", place, length) + data)
        magic, error, handle = struct.unpack(">II8s", self._receive(16))
        assert (magic, handle) == (0x67446698, b"12345678")
        if error:
            raise OSError(error, "the disk fails")
        return self._receive(length) if kind == READ else b""

    def read(self, place, length):
        return self._ask(READ, 0, place, length)

    def write(self, place, data, through=False):
        self._ask(WRITE, FUA if through else 0, place, len(data), data)

    def flush(self):
        self._ask(FLUSH, 0, 0, 0)
