"""The present pose of each station: from a pose file, or set by a command."""

from .pose import Pose


class Player:
    """Times are parameters: seconds of the monotonic clock."""

    def __init__(self, loop=False, speed=1.0):
        self.loop = loop
        self.speed = speed
        self._file = None
        self._begun = 0.0
        self._placed = {1: Pose()}

    def play(self, file, now):
        """Plays a file from its beginning; at its end the last poses stay, or with `loop` it begins again."""
        self._file = file
        self._begun = now
        self._placed = {}

    def place(self, station, pose):
        """Fixes the station at this pose, regardless of the file."""
        self._placed[station] = pose

    def take_away(self, station):
        """Removes the station's sensor from the device, unless the file has it."""
        self._placed.pop(station, None)

    def poses(self, now):
        """{station: table_from_sensor, or None: the device has no pose of it}."""
        found = {}
        if self._file:
            t_us = (now - self._begun) * self.speed * 1e6
            length_us = self._file.end_us - self._file.begin_us
            if self.loop and length_us > 0:
                t_us %= length_us
            found = self._file.at(self._file.begin_us + t_us)
        found.update(self._placed)
        return dict(sorted(found.items()))
