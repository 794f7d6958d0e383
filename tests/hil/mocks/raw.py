"""Links that carry only the bytes, without USB: for tests of a codec, or in place of a serial port.

There is one stream each way: to the device's OUT endpoint and from its IN endpoint.
"""

import asyncio
import os
import socket
import sys
import tty

from .usb_device import IN

_CHUNK = 65536


class RawLink:
    """A pair of file descriptors; subclasses choose them and define unplugging."""

    def __init__(self, device):
        self._device = device
        self._loop = asyncio.get_running_loop()
        self._input = self._output = None
        self._unsent = b""
        self._held = b""  # bytes that came while the device hung
        self._ended = asyncio.Event()
        self._plugged = True
        device.link = self

    @property
    def connected(self):
        return self._plugged and self._input is not None

    async def ended(self):
        await self._ended.wait()

    def plug(self):
        self._plugged = True
        self._device.greet()

    def unplug(self):
        self._plugged = False
        self._held = b""

    def close(self):
        self._detach()

    def data_waiting(self, endpoint):
        while self.connected and not self._unsent and (data := self._device.take(endpoint, _CHUNK)) is not None:
            self._unsent = data
            self._write()

    def woke_up(self):
        held, self._held = self._held, b""
        if held:
            self._deliver(held)
        self._all_waiting()

    def _attach(self, input_, output):
        self._input, self._output = input_, output
        os.set_blocking(input_, False)
        os.set_blocking(output, False)
        self._loop.add_reader(input_, self._read)

    def _detach(self):
        if self._input is not None:
            self._loop.remove_reader(self._input)
            self._loop.remove_writer(self._output)
        self._input = self._output = None
        self._unsent = self._held = b""

    def _hung_up(self):
        """Called when the other side has closed the link."""
        self._detach()
        self._ended.set()

    def _read(self):
        try:
            data = os.read(self._input, _CHUNK)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if not data:
            self._hung_up()
        elif self._plugged and self._device.hung:
            self._held += data
        elif self._plugged:
            self._deliver(data)

    def _deliver(self, data):
        endpoint = next((e.address for e in self._device.endpoints if not e.address & IN), 0)
        self._device.received(endpoint, data)

    def _write(self):
        try:
            self._unsent = self._unsent[os.write(self._output, self._unsent):]
        except BlockingIOError:
            pass
        except OSError:
            self._hung_up()
            return
        if self._unsent:
            self._loop.add_writer(self._output, self._write_more)

    def _write_more(self):
        self._loop.remove_writer(self._output)
        self._write()
        self._all_waiting()

    def _all_waiting(self):
        for endpoint in self._device.waiting:
            self.data_waiting(endpoint)


class StdioLink(RawLink):
    async def open(self):
        try:
            self._attach(sys.stdin.fileno(), sys.stdout.fileno())
        except PermissionError:
            raise OSError("both must be pipes, sockets or a terminal, not files") from None
        self._device.greet()
        return "standard input and output"


class PtyLink(RawLink):
    async def open(self):
        controller, self._terminal = os.openpty()  # stays open here, so that other programs can open and close it
        tty.setraw(self._terminal)
        self._attach(controller, controller)
        return f"pseudo-terminal {os.ttyname(self._terminal)}"


class SocketLink(RawLink):
    """Listens at a Unix socket for one host at a time; the socket does not exist while the device is unplugged."""

    def __init__(self, device, path):
        super().__init__(device)
        self._path = path
        self._listener = None
        self._connection = None

    async def open(self):
        if self._plugged:
            self.plug()
        return f"socket {self._path}"

    def plug(self):
        self._plugged = True
        if self._listener is None:
            if os.path.exists(self._path):
                os.unlink(self._path)
            self._listener = socket.socket(socket.AF_UNIX)
            self._listener.bind(self._path)
            self._listener.listen()
            self._listener.setblocking(False)
            self._loop.add_reader(self._listener, self._accept)

    def unplug(self):
        super().unplug()
        self._hung_up()
        if self._listener is not None:
            self._loop.remove_reader(self._listener)
            self._listener.close()
            self._listener = None
            os.unlink(self._path)

    def close(self):
        self.unplug()

    def _accept(self):
        connection, _ = self._listener.accept()
        if self._connection is not None:
            connection.close()
            return
        self._connection = connection
        self._attach(connection.fileno(), connection.fileno())
        self._device.greet()
        self._all_waiting()

    def _hung_up(self):
        self._detach()
        if self._connection is not None:
            self._connection.close()
            self._connection = None
