"""The common part of mocked trackers: they play poses at their own rate, with faults on command."""

import asyncio
import time

from . import pose_file
from .faults import FramePath
from .pose import IDENTITY, compose
from .usb_device import BULK, IN, Endpoint, UsbDevice

_ABSURD_ENDPOINTS = tuple(Endpoint(address, address % 4, 0xFFFF, 255)
                          for k in range(15) for address in (k, IN | k)
                          if address % 4 != BULK)
_SET_CONFIGURATION = (0, 9)
_BURST_PERIOD_S = 0.25
_IDLE_S = 0.05  # between two checks whether a host listens
_LONGEST_CATCH_UP_S = 0.25  # length of a device's own buffer; frames older than that are lost


class Tracker(UsbDevice):
    """A subclass has the wire format: `frames`, `received`, `rate_hz`, `break_bytes`, `false_start`; it sets `streaming`
    when its host starts or stops the stream."""

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
        self.last = None  # (t_ns, counter, {station: table_from_sensor or None}) of the last frame that was sent unbroken
        self.changed = None  # the same for the last frame whose poses differ from those before
        self._tracker_from_table = tracker_from_table
        self._path = FramePath(faults, self.break_bytes)
        self._log = log
        self._clock_s = 0.0
        self._burst_due = 0.0
        self._in = next((e.address for e in self.endpoints if e.address & IN), None)

    # A subclass defines these.

    rate_hz = 60.0

    def frames(self, counter, time_s, poses):
        """The bytes of one instant: a list of (bytes, {station: table_from_sensor or None})."""
        raise NotImplementedError

    @staticmethod
    def break_bytes(data, random_):
        raise NotImplementedError

    @staticmethod
    def false_start(random_):
        """Noise that begins like a frame but contains no valid one."""
        raise NotImplementedError

    # For subclasses.

    def clock_s(self, time_s):
        """The time of the device's own clock."""
        if not self.faults.on("clock-stands"):
            self._clock_s = time_s
        return self._clock_s

    def answer(self, data):
        self.send(self._in, data)

    def in_tracker(self, table_from_sensor):
        return compose(self._tracker_from_table, table_from_sensor)

    def start_anew(self):
        super().start_anew()
        self.streaming = False
        self.counter = 0
        self._path.clear()

    def was_reset(self):
        if self.faults.on("hang-until-reset"):
            self.faults.tell("hang-until-reset", ["off"])
            self.start_anew()
            self.hang(False)

    def lose_units(self):
        """Called when `wrong-units` begins; a device whose frames do not name their units starts again."""

    # The life of the device.

    async def run(self):
        """Sends one frame each period, without end; after a delay the frames that are due follow at once. It checks less often while no
        host listens, because a test's bench has trackers that are not plugged in."""
        due = time.monotonic()
        while True:
            rate_hz = self.faults.value("rate") or self.rate_hz
            due += 1.0 / rate_hz if self._is_heard() else max(_IDLE_S, 1.0 / rate_hz)
            now = time.monotonic()
            if now - due > _LONGEST_CATCH_UP_S:
                skipped = int((now - due) * rate_hz)
                due += skipped / rate_hz
                self.counter += skipped if self.streaming else 0
            await asyncio.sleep(max(0.0, due - now))
            self.step(due)

    def step(self, now):
        """Sends the frame of this instant, if one is due."""
        if not self._is_heard():
            return
        self.counter = (self.counter + 1) & 0xFFFFFFFF
        if self.faults.on("stall"):
            return
        frames = self.frames(self.counter, now, self.poses(now))
        for frame in frames:
            self.made += 1
            if self.faults.on("false-preambles"):
                self.answer(self.false_start(self.faults.random))
            for sent in self._path.send(frame):
                self._send(sent)
        if self.faults.on("burst") and now >= self._burst_due:
            self._burst_due = now + _BURST_PERIOD_S
            self._burst(frames[-1].data)

    def _burst(self, data):
        count = int(self.faults.value("burst") * 1024) // len(data)
        if self.endpoints[0].kind == BULK:
            self.answer(data * count)
        else:  # at most as many reports as the device keeps for a host
            for _ in range(min(count, self.max_waiting)):
                self.answer(data)

    # The descriptors.

    @property
    def described_endpoints(self):
        if self.faults.on("no-endpoints"):
            return ()
        return _ABSURD_ENDPOINTS if self.faults.on("absurd-endpoints") else self.endpoints

    def configuration_descriptor(self):
        whole = super().configuration_descriptor()
        if self.faults.on("absurd-lengths"):  # the lengths of the whole and of its first interface
            whole = whole[:2] + b"\xFF\xFF" + whole[4:9] + b"\0" + whole[10:]
        return whole

    def control(self, request, data=b""):
        if self.faults.on("wrong-configuration") and (request.kind, request.request) == _SET_CONFIGURATION:
            return None
        return super().control(request, data)

    def _is_heard(self):
        return self.streaming and not self.hung and self._has_host()

    def _has_host(self):
        return self.link is None or self.link.connected

    def poses(self, now):
        missing = self.faults.value("sensor-missing")
        return {station: pose for station, pose in self.player.poses(now).items() if station != missing}

    def _send(self, frame):
        t_ns = time.monotonic_ns()
        if frame.intact:
            self._note(t_ns, frame.poses)  # noted before the host can receive it
        self.sent += 1
        self.answer(frame.data)

    def _note(self, t_ns, poses):
        if any(self.faults.on(fault) for fault in ("nan", "slow-boot", "wrong-units")):
            poses = dict.fromkeys(poses)  # the host may use none of them
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
