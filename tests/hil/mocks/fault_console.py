"""The common part of consoles of mocked devices with faults: a command names a fault, which lasts for a duration or until it is ended."""

import asyncio
import time


class FaultConsole:
    """Subclasses define the faults (`kinds`), further commands, and the actions at a fault's beginning and end."""

    kinds = {}
    commands = ""  # help for unknown faults
    ended_by_time = ("unplug", "hang")  # faults that need an action when their duration ends

    def __init__(self, device):
        self._device = device
        self._alarms = {}

    @classmethod
    def help_text(cls):
        rows = []
        for name, kind in cls.kinds.items():
            value = f" [{kind.allowed[0]:g}..{kind.allowed[1]:g}]" if kind.allowed else ""
            rows.append(f"{name + value + ' [DURATION]':33} {kind.says}")
        return "\n".join([*rows, "NAME off                          ends it; a DURATION is 2s or 300ms", cls.commands])

    def execute(self, line):
        name, *words = line.split() or [""]
        if name in self.kinds:
            return self._fault(name, words)
        if name == "good" and not words:
            return self._good()
        if name == "status" and not words:
            return self._device.status()
        if name == "help":
            return {"help": self.help_text()}
        answer = self.answer(name, words)
        if answer is None:
            raise ValueError(f"unknown command '{line}'; 'help' lists them")
        return answer

    # For subclasses to override.

    def answer(self, name, words):
        """The answer to a command that is no fault; None: the device does not know the command."""

    def begin_or_end(self, name, begins):
        """Actions at a fault's beginning and end, besides its switch."""

    def _fault(self, name, words):
        duration = self._device.faults.tell(name, words)
        self.disarm(name)
        self.begin_or_end(name, words != ["off"])
        if duration is not None and name in self.ended_by_time:
            self.arm(name, duration, self.begin_or_end, name, False)
        return {"t_ns": time.monotonic_ns()}

    def _good(self):
        for name in self.kinds:
            if self._device.faults.on(name):
                self.begin_or_end(name, False)
        for name in list(self._alarms):
            self.disarm(name)
        self._device.faults.clear()
        return {"t_ns": time.monotonic_ns()}

    def arm(self, name, seconds, act, *words):
        self._alarms[name] = asyncio.get_running_loop().call_later(seconds, act, *words)

    def disarm(self, name):
        alarm = self._alarms.pop(name, None)
        if alarm:
            alarm.cancel()
