"""The commands that the mocked camera understands, from its control socket or at a time."""

from .fault_console import FaultConsole
from .uvc_camera import KINDS


class CameraConsole(FaultConsole):
    kinds = KINDS
    commands = """\
good                              ends every fault
status                            what was agreed on, frames, the controls' values
help                              this"""

    def begin_or_end(self, name, begins):
        camera = self._device
        if name == "hang" and camera.hung != begins:
            camera.hang(begins)
        elif name == "unplug" and begins:
            camera.link.unplug()
            camera.start_anew()
        elif name == "unplug":
            camera.link.plug()
