"""A link to QEMU: the host's side of the usbredir protocol 0.7 on a Unix socket at which the mock listens.

    -device qemu-xhci,id=xhci
    -chardev socket,id=tracker,path=SOCKET,reconnect=1 -device usb-redir,chardev=tracker

All numbers are little-endian. Header: u32 type, u32 length of the data after the header, u32 or u64 identifier.
"""

import asyncio
import os
import struct

from .usb_device import IN, Request, Transfers

(HELLO, DEVICE_CONNECT, DEVICE_DISCONNECT, RESET, INTERFACE_INFO, EP_INFO, SET_CONFIGURATION, GET_CONFIGURATION,
 CONFIGURATION_STATUS, SET_ALT_SETTING, GET_ALT_SETTING, ALT_SETTING_STATUS) = range(12)
START_INTERRUPT_RECEIVING, STOP_INTERRUPT_RECEIVING, INTERRUPT_RECEIVING_STATUS = 15, 16, 17
CANCEL_DATA_PACKET = 21
CONTROL_PACKET, BULK_PACKET, INTERRUPT_PACKET = 100, 101, 103
SUCCESS, CANCELLED, STALL = 0, 1, 4

# Bits of the capabilities.
DEVICE_VERSION, DISCONNECT_ACK, MAX_PACKET_SIZE, IDS_64_BIT, BULK_LENGTH_32_BIT = 1, 3, 4, 5, 6
OUR_CAPABILITIES = sum(1 << bit for bit in
                       (DEVICE_VERSION, DISCONNECT_ACK, MAX_PACKET_SIZE, IDS_64_BIT, BULK_LENGTH_32_BIT))

_LONGEST_REPORT = 1024
_SET_CONFIGURATION_REQUEST = 9


def header(kind, length, identifier, wide):
    return struct.pack("<IIQ" if wide else "<III", kind, length, identifier)


def hello_body():
    return b"frustumscreen mock".ljust(64, b"\0") + struct.pack("<I", OUR_CAPABILITIES)


def interface_info_body(device):
    """The interfaces' numbers, classes, subclasses and protocols, 32 of each."""
    columns = zip(*device.interfaces)
    return struct.pack("<I", len(device.interfaces)) + b"".join(bytes(column).ljust(32, b"\0") for column in columns)


def endpoint_info_body(device, with_packet_sizes):
    """The endpoints' data, in the order 0 to 15 out, 16 to 31 in."""
    kinds, intervals, interfaces, sizes = [255] * 32, [0] * 32, [0] * 32, [0] * 32
    kinds[0] = kinds[16] = 0  # control
    sizes[0] = sizes[16] = 64
    for e in device.described_endpoints:
        index = (e.address & 0x0F) + (16 if e.address & IN else 0)
        kinds[index], intervals[index], sizes[index] = e.kind, e.interval, e.packet_bytes
        interfaces[index] = device.interface_of(e.address)
    body = bytes(kinds) + bytes(intervals) + bytes(interfaces)
    return body + struct.pack("<32H", *sizes) if with_packet_sizes else body


def device_connect_body(device, with_version):
    body = struct.pack("<BBBBHH", device.speed, 0, 0, 0, device.vendor_id, device.product_id)
    return body + struct.pack("<H", device.version_bcd) if with_version else body


class UsbredirLink:
    def __init__(self, device, path):
        self._device = device
        self._path = path
        self._transfers = Transfers(device)
        self._writer = None
        self._capabilities = 0
        self._plugged = True
        self._streams = set()  # interrupt endpoints that the host reads
        self._stream_ids = 0
        self.connected = False  # the host knows about the device
        device.link = self

    async def open(self):
        if os.path.exists(self._path):
            os.unlink(self._path)
        self._server = await asyncio.start_unix_server(self._serve, self._path)
        return f"usbredir at {self._path}"

    async def ended(self):
        """Never returns, because a virtual machine may connect again."""
        await asyncio.Event().wait()

    def close(self):
        self.unplug()
        self._server.close()
        if os.path.exists(self._path):
            os.unlink(self._path)

    def plug(self):
        self._plugged = True
        if self._writer and not self.connected:
            device = self._device
            self._send(INTERFACE_INFO, interface_info_body(device))
            self._send(EP_INFO, endpoint_info_body(device, self._has(MAX_PACKET_SIZE)))
            self._send(DEVICE_CONNECT, device_connect_body(device, self._has(DEVICE_VERSION)))
            self.connected = True

    def unplug(self):
        self._plugged = False
        self._transfers.clear()
        self._streams.clear()
        if self.connected:
            self.connected = False
            self._send(DEVICE_DISCONNECT, b"")

    def data_waiting(self, endpoint):
        for identifier, data in self._transfers.ready_reads(endpoint):
            self._send_bulk(endpoint, SUCCESS, data, identifier)
        while endpoint in self._streams and (data := self._device.take(endpoint, _LONGEST_REPORT)) is not None:
            body = struct.pack("<BBH", endpoint, SUCCESS, len(data)) + data
            self._send(INTERRUPT_PACKET, body, self._stream_ids)
            self._stream_ids += 1

    def woke_up(self):
        self._serve_writes()
        for endpoint in self._device.waiting:
            self.data_waiting(endpoint)

    def _has(self, bit):
        return self._capabilities >> bit & 1

    def _send(self, kind, body, identifier=0):
        if self._writer:
            self._writer.write(header(kind, len(body), identifier, self._has(IDS_64_BIT)) + body)

    def _send_bulk(self, endpoint, status, data, identifier, length=None):
        length = len(data) if length is None else length
        head = struct.pack("<BBHI", endpoint, status, length & 0xFFFF, 0)
        if self._has(BULK_LENGTH_32_BIT):
            head += struct.pack("<H", length >> 16)
        self._send(BULK_PACKET, head + data, identifier)

    async def _serve(self, reader, writer):
        if self._writer:  # one host at a time
            writer.close()
            return
        self._writer, self._capabilities = writer, 0
        self._send(HELLO, hello_body())
        try:
            while True:
                wide = self._has(IDS_64_BIT)
                head = await reader.readexactly(16 if wide else 12)
                kind, length, identifier = struct.unpack("<IIQ" if wide else "<III", head)
                self._take(kind, identifier, await reader.readexactly(length))
        except (asyncio.IncompleteReadError, asyncio.CancelledError, ConnectionError):
            pass
        finally:
            self._writer = None
            self.connected = False
            self._transfers.clear()
            self._streams.clear()
            writer.close()

    def _take(self, kind, identifier, body):
        if kind == HELLO:
            if len(body) >= 68:
                self._capabilities = OUR_CAPABILITIES & struct.unpack_from("<I", body, 64)[0]
            if self._plugged:
                self.plug()
        elif not self.connected:
            return  # sent before the host knew that the cable was out
        elif kind == RESET:
            self._device.was_reset()
        elif kind in (SET_CONFIGURATION, GET_CONFIGURATION):
            number = body[0] if kind == SET_CONFIGURATION else 1
            taken = self._device.control(Request(0, _SET_CONFIGURATION_REQUEST, number, 0, 0)) is not None
            self._send(CONFIGURATION_STATUS, bytes([SUCCESS if taken else STALL, number]), identifier)
        elif kind in (SET_ALT_SETTING, GET_ALT_SETTING):
            self._send(ALT_SETTING_STATUS, bytes([SUCCESS, body[0], 0]), identifier)
        elif kind in (START_INTERRUPT_RECEIVING, STOP_INTERRUPT_RECEIVING):
            self._interrupts(body[0], kind == START_INTERRUPT_RECEIVING, identifier)
        elif kind == CONTROL_PACKET:
            self._control(identifier, body)
        elif kind == BULK_PACKET:
            self._bulk(identifier, body)
        elif kind == INTERRUPT_PACKET:
            endpoint, _, length = struct.unpack_from("<BBH", body)
            self._device.received(endpoint, body[4:])
            self._send(INTERRUPT_PACKET, struct.pack("<BBH", endpoint, SUCCESS, length), identifier)
        elif kind == CANCEL_DATA_PACKET:
            endpoint = self._transfers.cancel(identifier)
            if endpoint is not None:
                self._send_bulk(endpoint, CANCELLED, b"", identifier)

    def _interrupts(self, endpoint, start, identifier):
        self._send(INTERRUPT_RECEIVING_STATUS, bytes([SUCCESS, endpoint]), identifier)
        if start:
            self._streams.add(endpoint)
            self.data_waiting(endpoint)
        else:
            self._streams.discard(endpoint)

    def _control(self, identifier, body):
        endpoint, request, kind, _, value, index, length = struct.unpack_from("<BBBBHHH", body)
        answer = self._device.control(Request(kind, request, value, index, length), body[10:])
        status = SUCCESS if answer is not None else STALL
        data = answer or b""
        done = len(data) if kind & IN else (length if status == SUCCESS else 0)
        head = struct.pack("<BBBBHHH", endpoint, request, kind, status, value, index, done)
        self._send(CONTROL_PACKET, head + (data if kind & IN else b""), identifier)

    def _bulk(self, identifier, body):
        endpoint, _, length, _ = struct.unpack_from("<BBHI", body)
        head_bytes = 8
        if self._has(BULK_LENGTH_32_BIT):
            length |= struct.unpack_from("<H", body, 8)[0] << 16
            head_bytes = 10
        if endpoint & IN:
            self._transfers.read(endpoint, identifier, length)
            self.data_waiting(endpoint)
        else:
            self._transfers.write(endpoint, identifier, body[head_bytes:])
            self._serve_writes()

    def _serve_writes(self):
        for endpoint, identifier, data in self._transfers.ready_writes():
            self._send_bulk(endpoint, SUCCESS, b"", identifier, len(data))
            self._device.received(endpoint, data)
