"""The commands that the mocked buttons understand, from their control socket or at a time."""

import asyncio
import time

from .cp2112 import PINS, SPECIAL
from .faults import parse_duration

_USUAL_PRESS_S = 0.2
_KNOWN_S = 0.05  # longer than the time for which the exhibit debounces
_MAX_PRESS_S = 10.0
_BOUNCE_S = 0.003  # between two edges of a bouncing contact
_BOUNCES = 5
HELP = f"""\
press PIN [DURATION]   down, and up again after it (200 ms); pins are 0 to {PINS - 1}. A press becomes longer on a busy host: it ends when
                       the kernel's driver has seen it for {_KNOWN_S:g} s, and after {_MAX_PRESS_S:g} s if nothing reads the pins
hold PIN               down until 'release PIN'
release PIN
bounce PIN [DURATION]  a press whose contacts bounce: bursts of edges when the button goes down and when it comes up
special PIN            the special function of pin 0, 1 or 7 is on, and it is no GPIO, until 'special off' or 'unplug'
unplug [DURATION]      the USB cable is out; 'plug' puts it back
plug
status                 pins, lamps, how often the host has read the pins
help                   this text"""


class ButtonsConsole:
    def __init__(self, buttons):
        self._buttons = buttons
        self._alarm = None
        self._presses = {}  # pin -> the call that ends its press

    def execute(self, line):
        name, *words = line.split() or [""]
        if name in ("press", "bounce") and len(words) in (1, 2):
            duration = _duration(words[1]) if len(words) == 2 else _USUAL_PRESS_S
            self._press(_pin(words[0]), duration, name == "bounce")
        elif name in ("hold", "release") and len(words) == 1:
            pin = _pin(words[0])
            self._forget(pin)
            self._buttons.hold(pin, name == "hold")
        elif name == "special" and len(words) == 1:
            self._special(words[0])
        elif name == "unplug" and len(words) <= 1:
            self._unplug(_duration(words[0]) if words else None)
        elif name == "plug" and not words:
            self._disarm()
            self._buttons.link.plug()
        elif name == "status" and not words:
            return self._status()
        elif name == "help":
            return {"help": HELP}
        else:
            raise ValueError(f"unknown command '{line}'; 'help' lists them")
        return {"t_ns": time.monotonic_ns()}

    def _press(self, pin, duration, bounces):
        self._forget(pin)  # a press during the previous one extends it
        self._move(pin, True, bounces)
        self._come_up_after(duration, pin, duration, bounces)

    def _come_up(self, pin, held_s, bounces):
        """Ends a press, but not before the host can have noticed it: a busy host may give the guest no time while the button is down."""
        is_known = self._buttons.noticed_for_s(pin) >= _KNOWN_S or not self._buttons.link.connected
        if is_known or held_s >= _MAX_PRESS_S:
            self._move(pin, False, bounces)
        else:
            self._come_up_after(_KNOWN_S / 5, pin, held_s + _KNOWN_S / 5, bounces)

    def _come_up_after(self, seconds, pin, *held):
        self._presses[pin] = asyncio.get_running_loop().call_later(seconds, self._come_up, pin, *held)

    def _forget(self, pin):
        if pin in self._presses:
            self._presses.pop(pin).cancel()

    def _move(self, pin, down, bounces):
        """Presses or releases the button now; contacts that bounce end at the new level."""
        self._buttons.hold(pin, down)
        for k in range(1, 2 * _BOUNCES + 1 if bounces else 1):
            asyncio.get_running_loop().call_later(k * _BOUNCE_S, self._buttons.hold, pin, down if k % 2 == 0 else not down)

    def _special(self, word):
        bits = {"off": 0, **{str(pin): self._buttons.special_bits() | bit for pin, bit in SPECIAL.items()}}
        if word not in bits:
            raise ValueError(f"found special '{word}'; allowed are 0, 1, 7 or off")
        self._buttons.set_special(bits[word])

    def _unplug(self, duration):
        self._disarm()
        self._buttons.link.unplug()
        self._buttons.start_anew()
        if duration is not None:
            self._alarm = asyncio.get_running_loop().call_later(duration, self._buttons.link.plug)

    def _disarm(self):
        if self._alarm:
            self._alarm.cancel()
            self._alarm = None

    def _status(self):
        buttons = self._buttons
        return {"device": "cp2112", "t_ns": time.monotonic_ns(), "connected": buttons.link.connected,
                "pins": buttons.pins(), "lamps": buttons.lamps, "reads": buttons.reads}


def _pin(text):
    if text.isdecimal() and int(text) < PINS:
        return int(text)
    raise ValueError(f"found pin '{text}'; allowed are 0 to {PINS - 1}")


def _duration(text):
    seconds = parse_duration(text)
    if seconds is None:
        raise ValueError(f"found duration '{text}'; allowed are such as 2s or 300ms")
    return seconds
