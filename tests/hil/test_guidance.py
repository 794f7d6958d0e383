"""Tests the advice for a prop that is pushed out of the light, and for a cube in the hand that is turned so that a face gets no light: a
sign and words on the screen, and speech from the sound card, in the visitor's language.

The expected pictures and sounds are files that the same program writes on this machine, without a screen. They are compared with the
guest's screen and the output of QEMU's sound card, sounds sample by sample.
"""

import array
import subprocess
import tempfile
import wave
from dataclasses import dataclass

import screen
from bench import CUBE_ARTIFACT, UPRIGHT, USUAL, WIDTH, Patience, about, both_turns, eventually, with_cube
from hil_test import HilTest, long

# As shipped, with everything that visitors see and hear: captions, pictures and advice on the table, speech, five buttons.
WHOLE = (USUAL.replace("captions = false", "captions = true").replace("table_pictures = false", "table_pictures = true")
         .replace("guidance = false", 'guidance = true\nwords = "/var/lib/frustumscreen/words.fswords"')
         .replace('lines = ["0", "1", "2"]', 'lines = ["0", "1", "2", "3", "4"]') + '\n[sound]\ndevice = "plughw:0,0"\n')
LEFT_OF_THE_LIGHT = (-0.36, 0.0, 0.0)  # the table ends at -0.4, so a part of the artifact is dark, also for the eye in front
PUSHED = (*LEFT_OF_THE_LIGHT, *UPRIGHT)
CENTRE = (0.0, 0.0, 0.0, *UPRIGHT)
LIT_CUBE = (0.0, 0.05, 0.10, *about(1, 0, 0, -30))  # tilted so that the only visible face points up
DARK_CUBE = (*LIT_CUBE[:3], *both_turns(about(0, 0, 1, 30), LIT_CUBE[3:]))  # its left side is visible too, and is vertical
REPLAYED_S, REPLAYED_HZ = 9.0, 60.0
PUSHED_S = 1.0  # when the prop leaves the light in the replay
STILLS = 3  # one in the middle of each third of the replay: before the sign, with the sign, with the spoken words
LANGUAGES = ("en", "de")
LANGUAGE, HELP = 2, 4  # buttons
FAULTS = ("drop 0.2", "duplicate 0.3", "reorder 0.2")
STAGES_S = (0.4, 1.5, 3.0)  # docs/guidance.md: time until the sign, from the sign until the words, from the words until the voice
HEADER_BYTES = 44
PIECE = 2400  # samples, 50 ms
LOUD = 300
WHOLE_SHARE = 0.95  # of the pieces must be heard; the first and the last are faded
TALKS_S = 60.0
SAID_S = 12.0  # longer than an advice
CALM_S = 4.0
SOUNDS = "its sound goes to"
SOUND_DRIVER = "/sys/bus/pci/drivers/snd_hda_intel"


@dataclass
class Told:
    """The pictures and sounds for a visitor in one language, made by the program on this machine."""

    before: list  # lit pixels before the advice
    after: list  # lit pixels once it is given
    samples: array.array


def without(rows, others):
    return [row & ~other for row, other in zip(rows, others)]


def spoken(samples):
    """The samples without the silence before and after the speech."""
    loud = [k for k, sample in enumerate(samples) if abs(sample) > LOUD]
    return samples[loud[0]:loud[-1] + 1] if loud else samples[:0]


def first_piece(samples):
    """The first piece that is heard unchanged: the very first is faded in."""
    pieces = (samples[begin:begin + PIECE] for begin in range(PIECE, len(samples), PIECE))
    return next(piece for piece in pieces if max(map(abs, piece)) > LOUD).tobytes()


def replay(lit, dark):
    """A pose file of a prop at one pose, then at the other."""
    rows = ["t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok"]
    for k in range(round(REPLAYED_S * REPLAYED_HZ)):
        pose = dark if k >= PUSHED_S * REPLAYED_HZ else lit
        rows.append(f"{round(1e6 * k / REPLAYED_HZ)},1," + ",".join(str(value) for value in pose) + ",1")
    return "\n".join(rows) + "\n"


def told_here(bench, language, settings, lit, dark):
    settings = (settings.replace('kind = "usb"', 'kind = "replay"\nposes = "poses.csv"')
                .replace('kind = "gpio"', 'kind = "scripted"').replace("[exhibit]", f'[exhibit]\nlanguage = "{language}"')
                .replace("/var/lib/frustumscreen/packs", str(bench.packs)).replace("/var/lib/frustumscreen", str(bench.packs)))
    settings = "\n".join(line for line in settings.splitlines() if not line.startswith(("chip", "lines")))
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("poses.csv", replay(lit, dark)), ("kiosk.toml", settings)):
            with open(f"{folder}/{name}", "w", encoding="utf-8") as file:
                file.write(text)
        subprocess.run([bench.program, "run", "--config", f"{folder}/kiosk.toml", "--headless", "--fast", "--seconds",
                        f"{REPLAYED_S:.0f}", "--stills", f"{STILLS}", "--out", folder], check=True, capture_output=True)
        before, after = (screen.lit(screen.read_png(f"{folder}/frame_{k:05}.png")) for k in (0, STILLS - 1))
        with wave.open(f"{folder}/sound.wav") as file:
            return Told(before, after, spoken(array.array("h", file.readframes(file.getnframes()))))


class Advised(HilTest):
    """Tests the visible and audible advice for a prop that moves from a lit pose to a dark one."""

    artifact, lit, dark = "amphora", CENTRE, PUSHED

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.told = {language: told_here(cls.bench, language, cls.settings, cls.lit, cls.dark) for language in LANGUAGES}
        first, second = (cls.told[language].after for language in LANGUAGES)
        cls.words = {"en": without(first, second), "de": without(second, first)}  # pixels that only one language has
        others = [artifact | a | b for artifact, a, b in zip(cls.told["en"].before, *cls.words.values())]
        sign = without([a & b for a, b in zip(first, second)], screen.grown(others, 6, WIDTH))
        cls.sign_place = screen.grown(sign, 8, WIDTH)  # the sign moves a little
        cls.sign_pixels = screen.count(sign)

    def setUp(self):
        super().setUp()
        for language in LANGUAGES:
            self.assertGreater(len(self.told[language].samples), 48000 // 2, "nothing is said on this machine: this proves nothing")
            self.assertGreater(screen.count(self.words[language]), 200, "no words are shown on this machine: this proves nothing")
        self.show(self.artifact)
        self.bench.status_says("sound", SOUNDS)
        self.put(self.lit)
        self.bench.picture_of(self.lit)

    def put(self, pose):
        self.bench.place(pose[:3], pose[3:])

    # The screen.

    def sign_is_there(self):
        lit = [row & place for row, place in zip(screen.lit(self.bench.screendump()), self.sign_place)]
        return screen.count(lit) > self.sign_pixels / 2  # half, because some lit pixels may be of the artifact

    def words_are_there(self, language):
        """Whether all pixels that only this language has are lit, and most of the other language's are not."""
        lit = screen.lit(self.bench.screendump())
        other = next(each for each in LANGUAGES if each != language)
        return (screen.share_outside(self.words[language], screen.grown(lit, 1, WIDTH)) < 0.05
                and screen.share_outside(self.words[other], lit) > 0.5)

    def sees_words(self, language):
        eventually(lambda: self.words_are_there(language), TALKS_S, f"the advice is not on the screen in '{language}'")

    # The sound card's output.

    def heard(self):
        """The left channel of the sound card's whole output."""
        samples = self.bench.machine.heard.read_bytes()[HEADER_BYTES:]
        return array.array("h", samples[:len(samples) // 4 * 4])[0::2]

    def share_heard(self, language, since):
        """The share of the pieces of this language's advice that occur, unchanged and in order, in the output after `since` samples."""
        heard, expected = self.heard()[since:].tobytes(), self.told[language].samples
        place, found, count = 0, 0, 0
        for begin in range(0, len(expected) - PIECE, PIECE):
            count += 1
            at = heard.find(expected[begin:begin + PIECE].tobytes(), place)
            if at >= 0:
                place, found = at, found + 1
        return found / max(count, 1)

    def is_loud(self, since):
        return any(abs(sample) > LOUD for sample in self.heard()[since:])

    def hears(self, language, since):
        """Checks that this language's advice is heard completely, and of another language at most the end of advice that began before."""
        share, asked_s = [0.0], [Patience.clock()]

        def said():
            share[0] = self.share_heard(language, since)
            if share[0] < WHOLE_SHARE and self.is_loud(since) and Patience.clock() > asked_s[0] + SAID_S:
                asked_s[0] = Patience.clock()
                self.bench.buttons.tell("press", HELP, "300ms")  # the host interrupted it, and the pauses between repetitions grow
            return share[0] >= WHOLE_SHARE

        eventually(said, TALKS_S, lambda: f"the advice is not heard whole in '{language}': {100 * share[0]:.0f} % of it")
        for other in LANGUAGES:
            if other != language:
                self.assertNotIn(first_piece(self.told[other].samples), self.heard()[since:].tobytes(), f"the advice begins in '{other}' too")

    # The visitor.

    def take_language(self, language):
        """Holds the button until the language has changed, because a slow guest notices it late."""
        if self.bench.status()["language"] != language:
            self.bench.buttons.tell("hold", LANGUAGE)
            self.bench.status_says("language", language)
            self.bench.buttons.tell("release", LANGUAGE)

    def goes_when_it_is_lit(self):
        """Puts the prop back into the light, and checks that sign and voice end."""
        self.put(self.lit)
        self.bench.picture_of(self.lit)
        eventually(lambda: not self.sign_is_there(), TALKS_S, "the sign stays although everything is lit")
        quiet = len(self.heard())
        self.bench.machine.let_run(CALM_S)
        self.assertFalse(self.is_loud(quiet + 24000), "it goes on talking")


class Guidance(Advised):
    settings = WHOLE

    def test_advice_in_the_language_of_the_button(self):
        """The advice comes although the tracker drops, doubles and reorders its samples."""
        self.take_language("en")
        self.addCleanup(self.bench.tracker.tell, "good")
        for fault in FAULTS:
            self.bench.tracker.tell(fault)
        self.bench.place(LEFT_OF_THE_LIGHT)
        eventually(self.sign_is_there, TALKS_S, "no sign appears on the screen")
        self.sees_words("en")
        self.take_language("de")
        since = len(self.heard())
        self.sees_words("de")
        self.hears("de", since)
        self.goes_when_it_is_lit()

    @long
    def test_card_unplugged(self):
        self.take_language("en")
        self.bench.machine.check(f"for card in {SOUND_DRIVER}/0000:*; do echo 1 > $card/remove; done")
        self.addCleanup(self.bench.machine.run, "echo 1 > /sys/bus/pci/rescan")
        self.bench.status_says("sound", "is it plugged in")
        self.bench.place(LEFT_OF_THE_LIGHT)
        eventually(self.sign_is_there, TALKS_S, "no sign appears on the screen")
        silent = len(self.heard())
        self.bench.machine.check("echo 1 > /sys/bus/pci/rescan")
        self.bench.status_says("sound", SOUNDS)
        self.bench.buttons.tell("hold", HELP)  # otherwise the advice would wait for its pause, which has grown
        self.hears("en", silent)
        self.assertTrue(self.sign_is_there(), "the sign is gone although it was not followed")
        self.assertTrue(self.words_are_there("en"), "the words are gone although they were not followed")

    def test_help_button_gives_all_advice_at_once(self):
        """The help button gives all stages at once. Times count from the push, before which the exhibit cannot give advice."""
        self.take_language("en")
        pushed = self.artifact_at_its_place()
        since = len(self.heard())
        begun = Patience.clock()
        self.bench.place(LEFT_OF_THE_LIGHT)
        eventually(pushed, TALKS_S, "the picture does not follow the prop")
        moved = Patience.clock()
        self.bench.buttons.tell("hold", HELP)
        came_s = {}
        signs = {"sign": self.sign_is_there, "words": lambda: self.words_are_there("en"), "voice": lambda: self.is_loud(since)}

        def all_came():
            for name, is_there in signs.items():
                if name not in came_s and is_there():
                    came_s[name] = Patience.clock() - begun
            return len(came_s) == len(signs)

        eventually(all_came, TALKS_S, lambda: f"asked for help, it gives only {', '.join(came_s) or 'nothing'}")
        print(f"  the picture follows after {moved - begun:.1f} s; help: "
              + ", ".join(f"{name} {s:.1f} s" for name, s in came_s.items()), flush=True)
        self.bench.buttons.tell("release", HELP)
        self.assertLess(came_s["voice"], sum(STAGES_S))
        self.hears("en", since)

    def artifact_at_its_place(self):
        """A function that returns whether the screen shows the artifact at the place to which the prop is pushed."""
        there = screen.lit(self.bench.rendered([(*LEFT_OF_THE_LIGHT, *UPRIGHT)], "amphora")[0])
        return lambda: screen.share_outside(there, screen.grown(screen.lit(self.bench.screendump()), 4, WIDTH)) < 0.05


class CubeInTheHand(Advised):
    """The case of Figure 12 of Kim et al. 2008: the visitor turns the cube so that a visible face gets no light, and turns it back."""

    settings, artifact = with_cube(WHOLE), CUBE_ARTIFACT
    lit, dark = LIT_CUBE, DARK_CUBE

    def test_a_face_turned_out_of_the_light(self):
        self.take_language("en")
        since = len(self.heard())
        self.put(self.dark)
        eventually(self.sign_is_there, TALKS_S, "no sign appears on the screen")
        self.sees_words("en")
        self.hears("en", since)
        self.goes_when_it_is_lit()
