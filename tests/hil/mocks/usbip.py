"""Links to a Linux kernel's vhci_hcd: the server's side of USB/IP 1.1.1, over TCP or directly to this kernel.

All numbers are big-endian, except the eight set-up bytes, which are in the bus's order.
"""

import asyncio
import os
import socket
import struct

from .usb_device import IN, Request, Transfers

VERSION = 0x0111
REQ_DEVLIST, REP_DEVLIST, REQ_IMPORT, REP_IMPORT = 0x8005, 0x0005, 0x8003, 0x0003
CMD_SUBMIT, CMD_UNLINK, RET_SUBMIT, RET_UNLINK = 1, 2, 3, 4
BUS_ID = b"1-1"
BUS_NUMBER, DEVICE_NUMBER = 1, 2
_STALLED, _UNLINKED = -32, -104  # EPIPE, ECONNRESET
_HEADER_BYTES = 48
_VHCI = "/sys/devices/platform/vhci_hcd.0"
_FREE_PORT = "004"


def speed_number(device):
    """The kernel's number of the device's speed: 1 low, 2 full, 3 high."""
    return device.speed + 1


def device_record(device):
    return struct.pack(">256s32sIIIHHHBBBBBB", b"/sys/devices/mock/" + BUS_ID, BUS_ID, BUS_NUMBER, DEVICE_NUMBER,
                       speed_number(device), device.vendor_id, device.product_id, device.version_bcd, 0, 0, 0, 1, 1, len(device.interfaces))


def ret_submit(number, status, actual_length, data=b""):
    return struct.pack(">IIIIIiIIII8x", RET_SUBMIT, number, 0, 0, 0, status, actual_length, 0, 0, 0) + data


def ret_unlink(number, status):
    return struct.pack(">IIIIIi24x", RET_UNLINK, number, 0, 0, 0, status)


class _UsbipLink:
    """The link after the device is imported; subclasses do the import."""

    def __init__(self, device):
        self._device = device
        self._transfers = Transfers(device)
        self._writer = None
        self._plugged = True
        device.link = self

    @property
    def connected(self):
        return self._writer is not None

    async def ended(self):
        await asyncio.Event().wait()

    def unplug(self):
        """The kernel treats a closed connection as a pulled cable."""
        self._plugged = False
        if self._writer:
            self._writer.close()
            self._writer = None
        self._transfers.clear()

    def data_waiting(self, endpoint):
        for number, data in self._transfers.ready_reads(endpoint):
            self._send(ret_submit(number, 0, len(data), data))

    def woke_up(self):
        self._serve_writes()
        for endpoint in self._device.waiting:
            self.data_waiting(endpoint)

    def _send(self, data):
        if self._writer:
            self._writer.write(data)

    async def _serve_imported(self, reader, writer):
        self._writer = writer
        try:
            while True:
                header = await reader.readexactly(_HEADER_BYTES)
                command, number, _, direction, endpoint = struct.unpack_from(">5I", header)
                if command == CMD_SUBMIT:
                    length = struct.unpack_from(">I", header, 24)[0]
                    data = b"" if direction else await reader.readexactly(length)
                    self._submitted(number, endpoint | (IN if direction else 0), length, header[40:], data)
                elif command == CMD_UNLINK:
                    waited = self._transfers.cancel(struct.unpack_from(">I", header, 20)[0])
                    self._send(ret_unlink(number, 0 if waited is None else _UNLINKED))
                else:
                    return
        finally:
            if self._writer is writer:
                self._writer = None
                self._transfers.clear()

    def _submitted(self, number, endpoint, length, setup, data):
        if endpoint & 0x0F == 0:
            answer = self._device.control(Request.parse(setup), data)
            if answer is None:
                self._send(ret_submit(number, _STALLED, 0))
            elif endpoint & IN:
                self._send(ret_submit(number, 0, len(answer), answer))
            else:
                self._send(ret_submit(number, 0, len(data)))
        elif endpoint & IN:
            self._transfers.read(endpoint, number, length)
            self.data_waiting(endpoint)
        else:
            self._transfers.write(endpoint, number, data)
            self._serve_writes()

    def _serve_writes(self):
        for endpoint, number, data in self._transfers.ready_writes():
            self._send(ret_submit(number, 0, len(data)))
            self._device.received(endpoint, data)


class UsbipServerLink(_UsbipLink):
    """Waits for `usbip attach --remote ADDRESS --busid 1-1`; after unplugging, that must be run again."""

    def __init__(self, device, address, port):
        super().__init__(device)
        self._address = address
        self.port = port  # 0: any free one, known once it is open

    async def open(self):
        self._server = await asyncio.start_server(self._serve, self._address, self.port)
        self.port = self._server.sockets[0].getsockname()[1]
        return f"USB/IP at {self._address}, port {self.port}, bus id {BUS_ID.decode()}"

    def plug(self):
        self._plugged = True

    def close(self):
        self.unplug()
        self._server.close()

    async def _serve(self, reader, writer):
        writer.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        try:
            _, request, _ = struct.unpack(">HHI", await reader.readexactly(8))
            if request == REQ_DEVLIST:
                devices = b""
                if self._plugged:
                    devices = device_record(self._device)
                    devices += b"".join(bytes([*triple, 0]) for _, *triple in self._device.interfaces)
                writer.write(struct.pack(">HHII", VERSION, REP_DEVLIST, 0, bool(devices)) + devices)
            elif request == REQ_IMPORT:
                wanted = (await reader.readexactly(32)).rstrip(b"\0")
                if wanted != BUS_ID or not self._plugged or self.connected:
                    writer.write(struct.pack(">HHI", VERSION, REP_IMPORT, 1))
                else:
                    writer.write(struct.pack(">HHI", VERSION, REP_IMPORT, 0) + device_record(self._device))
                    await self._serve_imported(reader, writer)
        except (asyncio.IncompleteReadError, asyncio.CancelledError, ConnectionError):
            pass
        finally:
            writer.close()


class VhciLink(_UsbipLink):
    """A link to this machine's own kernel, without a network; needs root and the module vhci-hcd."""

    async def open(self):
        if self._plugged:
            self.plug()
        return "this machine's USB, by vhci_hcd"

    def plug(self):
        self._plugged = True
        if self._writer:
            return
        port = self._free_port()
        ours, kernels = socket.socketpair()
        with kernels:
            devid = BUS_NUMBER << 16 | DEVICE_NUMBER
            self._write("attach", f"{port} {kernels.fileno()} {devid} {speed_number(self._device)}")
        self._task = asyncio.ensure_future(self._serve(ours))

    def close(self):
        self.unplug()

    async def _serve(self, connection):
        try:
            reader, writer = await asyncio.open_unix_connection(sock=connection)
            await self._serve_imported(reader, writer)
        except (asyncio.IncompleteReadError, asyncio.CancelledError, ConnectionError):
            pass

    def _free_port(self):
        try:
            with open(os.path.join(_VHCI, "status"), encoding="ascii") as file:
                for line in file:
                    fields = line.split()
                    if fields[0] == "hs" and fields[2] == _FREE_PORT:
                        return int(fields[1])
        except FileNotFoundError:
            raise OSError("there is no vhci_hcd: run 'modprobe vhci-hcd'") from None
        raise OSError("all ports of vhci_hcd are in use")

    @staticmethod
    def _write(name, text):
        with open(os.path.join(_VHCI, name), "w", encoding="ascii") as file:
            file.write(text)
