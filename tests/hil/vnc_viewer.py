"""A viewer of the emulated second screen, which only reports the size of its window to the graphics card. For the guest it is
a projector that is plugged in, unplugged, or changes its mode.

Source   RFC 6143 (RFB 3.8), and its pseudo-encoding ExtendedDesktopSize (github.com/rfbproto/rfbproto, 7.7.10 and 7.4.3).
"""

import socket
import struct

NO_SECURITY = 1
SHARED = 1
SET_ENCODINGS = 2
EXTENDED_DESKTOP_SIZE = -308
SET_DESKTOP_SIZE = 251


class VncViewer:
    def __init__(self, path):
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.settimeout(20.0)
        self._socket.connect(str(path))
        self._read(12)  # the server's version
        self._socket.sendall(b"RFB 003.008\n")
        if NO_SECURITY not in self._read(self._read(1)[0]):
            raise ConnectionError("the emulated screen asks for a password")
        self._socket.sendall(bytes([NO_SECURITY]))
        self._read(4)
        self._socket.sendall(bytes([SHARED]))
        name_length = struct.unpack(">20xI", self._read(24))[0]
        self._read(name_length)
        self._socket.sendall(struct.pack(">BxHi", SET_ENCODINGS, 1, EXTENDED_DESKTOP_SIZE))

    def _read(self, size):
        data = b""
        while len(data) < size:
            more = self._socket.recv(size - len(data))
            if not more:
                raise EOFError("the emulated screen hung up")
            data += more
        return data

    def resize(self, width, height):
        """Reports the window's new size; 0 x 0: a projector that is unplugged."""
        self._socket.sendall(struct.pack(">BxHHBxIHHHHI", SET_DESKTOP_SIZE, width, height, 1, 0, 0, 0, width, height, 0))

    def close(self):
        self._socket.close()
