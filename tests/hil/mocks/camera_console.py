"""The commands that the mocked camera understands, from its control socket or at a time."""

import asyncio
import time

from .uvc_camera import KINDS

_COMMANDS = """\
NAME off                          ends it; a DURATION is 2s or 300ms
good                              ends every fault
status                            what was agreed on, frames, the controls' values
help                              this"""


def help_text():
    rows = []
    for name, kind in KINDS.items():
        value = f" [{kind.allowed[0]:g}..{kind.allowed[1]:g}]" if kind.allowed else ""
        rows.append(f"{name + value + ' [DURATION]':33} {kind.says}")
    return "\n".join([*rows, _COMMANDS])


class CameraConsole:
    def __init__(self, camera):
        self._camera = camera
        self._alarms = {}

    def execute(self, line):
        name, *words = line.split() or [""]
        if name in KINDS:
            return self._fault(name, words)
        if name == "good" and not words:
            for fault in ("unplug", "hang"):
                self._begin_or_end(fault, False)
            self._camera.faults.clear()
            return {"t_ns": time.monotonic_ns()}
        if name == "status" and not words:
            return self._camera.status()
        if name == "help":
            return {"help": help_text()}
        raise ValueError(f"unknown command '{line}'; 'help' lists them")

    def _fault(self, name, words):
        duration = self._camera.faults.tell(name, words)
        self._begin_or_end(name, words != ["off"])
        if duration is not None and name in ("unplug", "hang"):
            self._alarms[name] = asyncio.get_running_loop().call_later(duration, self._begin_or_end, name, False)
        return {"t_ns": time.monotonic_ns()}

    def _begin_or_end(self, name, begins):
        alarm = self._alarms.pop(name, None)
        if alarm:
            alarm.cancel()
        camera = self._camera
        if name == "hang" and camera.hung != begins:
            camera.hang(begins)
        elif name == "unplug" and begins:
            camera.link.unplug()
            camera.start_anew()
        elif name == "unplug":
            camera.link.plug()
