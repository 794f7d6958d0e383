"""A prop pushed out of the light: the advice comes as a sign on the screen, and as speech out of the sound card.

What should be heard comes from the same program without a screen on this machine, which writes a file; what is heard is QEMU's
sound card. Both are compared sample by sample.
"""

import array
import json
import subprocess
import tempfile
import time
import wave

import screen
from bench import UPRIGHT, eventually
from hil_test import OtherSettings

LEFT_OF_THE_LIGHT = (-0.28, 0.0, 0.0)
HEADER_BYTES = 44
PIECE = 2400  # samples, 50 ms
WHOLE_SHARE = 0.95  # of the pieces; the first and the last are faded
TALKS_S = 60.0
CALM_S = 8.0
SOUNDS = "its sound goes to"
SOUND_DRIVER = "/sys/bus/pci/drivers/snd_hda_intel"


def spoken(samples):
    """Without the silence before and after."""
    loud = [k for k, sample in enumerate(samples) if abs(sample) > 300]
    return samples[loud[0]:loud[-1] + 1] if loud else samples[:0]


class Guidance(OtherSettings):
    guided = OtherSettings.settings.replace("guidance = false", 'guidance = true\nwords = "/var/lib/frustumscreen/words.fswords"')

    @classmethod
    def other_settings(cls):
        return cls.guided + '\n[sound]\ndevice = "plughw:0,0"\n'

    def expected(self):
        """The samples that the same program says on this machine for the same place of the prop."""
        with tempfile.TemporaryDirectory() as folder:
            rows = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]
            for k in range(600):
                x = 0.0 if k < 60 else LEFT_OF_THE_LIGHT[0]
                rows.append(f"{k * 16667},1,{x},0,0,1,0,0,0,1")
            with open(f"{folder}/poses.csv", "w", encoding="utf-8") as file:
                file.write("\n".join(rows) + "\n")
            settings = (self.guided.replace('kind = "usb"', 'kind = "replay"\nposes = "poses.csv"')
                        .replace('kind = "gpio"', 'kind = "scripted"')
                        .replace("/var/lib/frustumscreen/packs", str(self.bench.packs))
                        .replace("/var/lib/frustumscreen", str(self.bench.packs)))
            settings = "\n".join(line for line in settings.splitlines() if not line.startswith(("chip", "lines")))
            with open(f"{folder}/kiosk.toml", "w", encoding="utf-8") as file:
                file.write(settings)
            subprocess.run([self.bench.program, "run", "--config", f"{folder}/kiosk.toml", "--headless", "--fast", "--seconds",
                            "10", "--stills", "0", "--out", folder], check=True, capture_output=True)
            with wave.open(f"{folder}/sound.wav") as file:
                return spoken(array.array("h", file.readframes(file.getnframes())))

    def heard(self):
        """The left channel of all that has come out of the sound card."""
        samples = self.bench.machine.heard.read_bytes()[HEADER_BYTES:]
        return array.array("h", samples[:len(samples) // 4 * 4])[0::2]

    def share_heard(self, expected, since):
        """The share of the pieces of `expected` that were heard, sample by sample, one after the other, after so many
        samples."""
        heard = self.heard()[since:].tobytes()
        place, found, count = 0, 0, 0
        for begin in range(0, len(expected) - PIECE, PIECE):
            count += 1
            at = heard.find(expected[begin:begin + PIECE].tobytes(), place)
            if at >= 0:
                place, found = at, found + 1
        return found / max(count, 1)

    def outside_the_light(self):
        """Pushes the prop out of the light, and waits for a sign beside the artifact; returns `artifact_at` there."""
        self.bench.place(LEFT_OF_THE_LIGHT)
        artifact = self.artifact_at((*LEFT_OF_THE_LIGHT, *UPRIGHT))
        eventually(lambda: self.share_beside(artifact) > 0.1, TALKS_S, "no sign appears on the screen")
        return artifact

    def artifact_at(self, pose):
        """The pixels that the artifact lights, and some around them."""
        picture = self.bench.rendered([pose], self.bench.status()["artifact"])[0]
        return screen.grown(screen.lit(picture), 4, picture.width)

    def share_beside(self, artifact):
        return screen.share_outside(screen.lit(self.bench.screendump()), artifact)

    def hears(self, expected, since=0):
        share = [0.0]

        def said():
            share[0] = self.share_heard(expected, since)
            return share[0] >= WHOLE_SHARE

        eventually(said, TALKS_S, lambda: f"the advice is not heard whole: {100 * share[0]:.0f} % of it")

    def test_prop_outside_the_light(self):
        expected = self.expected()
        self.assertGreater(len(expected), 48000 // 2, "nothing is said on this machine: this proves nothing")
        self.bench.status_says("sound", SOUNDS)
        self.outside_the_light()
        self.hears(expected)
        self.bench.place((0.0, 0.0, 0.0))
        self.bench.picture_of((0.0, 0.0, 0.0, *UPRIGHT))
        centre = self.artifact_at((0.0, 0.0, 0.0, *UPRIGHT))
        eventually(lambda: self.share_beside(centre) < 0.01, TALKS_S, "the sign stays although everything is lit")
        quiet = len(self.heard())
        time.sleep(CALM_S)
        after = self.heard()[quiet:]
        self.assertFalse(any(abs(sample) > 300 for sample in after[24000:]), "it goes on talking")
        print(f"  {json.dumps({'sound_underruns': self.bench.status()['sound_underruns']})}", flush=True)

    def test_sound_card_unplugged(self):
        expected = self.expected()
        self.bench.status_says("sound", SOUNDS)
        self.bench.machine.check(f"for card in {SOUND_DRIVER}/0000:*; do echo 1 > $card/remove; done")
        self.addCleanup(self.bench.machine.run, "echo 1 > /sys/bus/pci/rescan")
        self.bench.status_says("sound", "is it plugged in")
        artifact = self.outside_the_light()
        silent = len(self.heard())
        self.bench.machine.check("echo 1 > /sys/bus/pci/rescan")
        self.bench.status_says("sound", SOUNDS)
        self.hears(expected, silent)
        self.assertGreater(self.share_beside(artifact), 0.1, "the sign is gone although it was not followed")
