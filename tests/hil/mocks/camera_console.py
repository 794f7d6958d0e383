"""The commands that the mocked camera understands, from its control socket or at a time."""

import time

from . import pgm
from .fault_console import FaultConsole
from .uvc_camera import KINDS


class CameraConsole(FaultConsole):
    kinds = KINDS
    commands = """\
play FILE                         sends this picture (PGM of 160 x 120 or 320 x 240 pixels) with a little noise, if its size is the
                                  negotiated one; FILE is read once, now
play off                          sends the test picture again
good                              ends every fault
status                            the negotiated format, frames, the controls' values
help                              this text"""

    def answer(self, name, words):
        if name != "play" or not words:
            return None
        if words == ["off"]:
            self._device.played = None
        else:
            try:
                self._device.play(*pgm.read(" ".join(words)))
            except OSError as error:
                raise ValueError(str(error)) from None
        return {"t_ns": time.monotonic_ns()}

    def begin_or_end(self, name, begins):
        camera = self._device
        if name == "hang" and camera.hung != begins:
            camera.hang(begins)
        elif name == "unplug" and begins:
            camera.link.unplug()
            camera.start_anew()
        elif name == "unplug":
            camera.link.plug()
