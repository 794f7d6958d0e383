"""What every mocked tracker has in common: it plays poses at its own rate, and misbehaves as it is told."""

import asyncio
import time

from . import pose_file
from .faults import FramePath
from .pose import IDENTITY, compose
from .usb_device import IN, UsbDevice

_LONGEST_CATCH_UP_S = 0.25  # what a device's own buffer holds; frames older than that are lost


class Tracker(UsbDevice):
    """A subclass has the wire format: `frames`, `received`, `rate_hz`, `break_bytes`; it sets `streaming` as told."""

    name = "tracker"

    def __init__(self, player, faults, tracker_from_table=IDENTITY, log=None):
        super().__init__()
        self.player = player
        self.faults = faults
        self.streaming = False
        self.counter = 0
        self.made = 0
        self.sent = 0
        self.commands = 0
        self.last = None  # (t_ns, counter, {station: table_from_sensor or None}) of the last frame sent whole
        self.changed = None  # the same, of the last whose poses differ from those before
        self._tracker_from_table = tracker_from_table
        self._path = FramePath(faults, self.break_bytes)
        self._log = log
        self._in = next((e.address for e in self.endpoints if e.address & IN), None)

    # A subclass has these.

    rate_hz = 60.0

    def frames(self, counter, time_s, poses):
        """Bytes of one instant: a list of (bytes, {station: table_from_sensor or None})."""
        raise NotImplementedError

    @staticmethod
    def break_bytes(data, random_):
        raise NotImplementedError

    # For subclasses.

    def answer(self, data):
        self.send(self._in, data)

    def in_tracker(self, table_from_sensor):
        return compose(self._tracker_from_table, table_from_sensor)

    def start_anew(self):
        super().start_anew()
        self.streaming = False
        self.counter = 0
        self._path.clear()

    def lose_units(self):
        """`wrong-units` begins; a device whose frames do not name their units starts anew."""

    # The life of the device.

    async def run(self):
        """For ever: one frame each period, on time; after a delay those that are due follow at once."""
        due = time.monotonic()
        while True:
            due += 1.0 / self.rate_hz
            now = time.monotonic()
            if now - due > _LONGEST_CATCH_UP_S:
                skipped = int((now - due) * self.rate_hz)
                due += skipped / self.rate_hz
                self.counter += skipped if self.streaming else 0
            await asyncio.sleep(max(0.0, due - now))
            self.step(due)

    def step(self, now):
        """The frame of this instant, if it is time for any."""
        if not self.streaming or self.hung or not self._has_host():
            return
        self.counter = (self.counter + 1) & 0xFFFFFFFF
        if self.faults.on("stall"):
            return
        for frame in self.frames(self.counter, now, self.poses(now)):
            self.made += 1
            for sent in self._path.send(frame):
                self._send(sent)

    def _has_host(self):
        return self.link is None or self.link.connected

    def poses(self, now):
        missing = self.faults.value("sensor-missing")
        return {station: pose for station, pose in self.player.poses(now).items() if station != missing}

    def _send(self, frame):
        t_ns = time.monotonic_ns()
        if frame.intact:
            self._note(t_ns, frame.poses)  # before the host can have it
        self.sent += 1
        self.answer(frame.data)

    def _note(self, t_ns, poses):
        if any(self.faults.on(fault) for fault in ("nan", "slow-boot", "wrong-units")):
            poses = dict.fromkeys(poses)  # none that a host may use
        before = self.last[2] if self.last else {}
        self.last = (t_ns, self.counter, {**before, **poses})
        if self.last[2] != before:
            self.changed = self.last
        if self._log:
            for station, pose in poses.items():
                self._log.write(pose_file.row(t_ns // 1000, station, pose))

    def status(self):
        def told(moment):
            if moment is None:
                return None
            t_ns, counter, poses = moment
            return {"t_ns": t_ns, "counter": counter, "poses": {
                station: pose and {"position_m": pose.position, "quaternion_wxyz": pose.quaternion}
                for station, pose in poses.items()}}

        return {
            "device": self.name,
            "t_ns": time.monotonic_ns(),
            "connected": bool(self.link and self.link.connected),
            "streaming": self.streaming,
            "rate_hz": self.rate_hz,
            "frames_made": self.made,
            "frames_sent": self.sent,
            "frames_not_read": self.discarded,
            **self._path.counts,
            "commands": self.commands,
            "faults": self.faults.active(),
            "last": told(self.last),
            "changed": told(self.changed),
        }
