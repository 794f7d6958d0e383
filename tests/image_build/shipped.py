"""The shipped image in an emulated PC with UEFI. Nothing is added to it, so a test can observe only its screen.

Frame    the disk that ./image_build/build makes, with its own settings; a screen of any size; no tracker, no buttons, no agent.
Time     as in tests/hil/machine.py.
Threads  one caller.
Errors   MachineError.
"""

import time
from dataclasses import dataclass

from appliance import Appliance, screen
from bench import Patience

LIVES_S = 240.0  # from power on; 60 s on two idle cores


@dataclass
class Seen:
    """The screen's pictures since power on."""

    codes: set  # codes of the exhibit's pictures
    lit: set  # hashes of the contents of those pictures that light something
    safe: object = None  # the safe picture, if it was seen
    picture: object = None  # the exhibit's latest picture that lights something


class Shipped(Appliance):
    """`screen_size`: the screen's preferred size (EDID); `card_memory`: the card's memory, as QEMU's option."""

    def __init__(self, image, folder, sockets, screen_size, card_memory, processor):
        super().__init__(image, folder, sockets, {})
        self._screen = f"bochs-display,id=screen,edid=on,xres={screen_size[0]},yres={screen_size[1]},vgamem={card_memory}"
        self.memory_mib, self.processor = 2048, processor

    def give_settings(self):
        """Keeps the image's own settings."""

    def start(self):
        self.power_on()
        self.connect_monitor()
        Patience.clock = self.granted_s

    def look(self, seen):
        path = self.sockets / "screen.ppm"
        self.screendump(path)
        try:
            picture = screen.read_ppm(path)
        except ValueError:  # the screen changes its size
            return
        if screen.safe_probe(picture) is not None:
            seen.safe = picture
        code = screen.probe(picture)
        if code is None:
            return
        seen.codes.add(code)
        if screen.count(screen.lit(picture)) > 0:
            rows = picture.rgb[3 * picture.width:]  # the first row has the code
            seen.lit.add(hash(rows))
            seen.picture = picture

    def lives_within(self, timeout_s=LIVES_S):
        """Waits until the exhibit has drawn two pictures that differ in more than their code, or the safe picture comes."""
        seen = Seen(set(), set())
        deadline = self.granted_s() + timeout_s
        while self.granted_s() < deadline and len(seen.lit) < 2 and seen.safe is None:
            self.look(seen)
            time.sleep(0.2)
        for name, picture in (("lit.png", seen.picture), ("safe.png", seen.safe)):
            if picture:
                screen.write_png(self.logs / name, picture)
        return seen
