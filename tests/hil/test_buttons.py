"""Tests that a button shows another artifact on the screen, through the CP2112's kernel driver and libgpiod."""


import screen
from bench import eventually
from hil_test import HilTest

POSE = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
NEXT = 1


class Buttons(HilTest):
    def test_button_shows_the_other_artifact(self):
        amphora = screen.lit(self.bench.rendered([POSE], "amphora")[0])
        nautilus = screen.lit(self.bench.rendered([POSE], "nautilus-cup")[0])
        apart = screen.share_outside(amphora, nautilus) + screen.share_outside(nautilus, amphora)
        self.assertGreater(apart, 0.1, "the two artifacts look alike from here: this proves nothing")
        self.show("amphora")
        self.assert_shown(amphora)
        self.bench.buttons.tell("press", NEXT, "300ms")
        self.assert_shown(nautilus)
        self.bench.buttons.tell("bounce", NEXT, "300ms")  # one press, however often its contacts bounce
        self.assert_shown(amphora)
        self.bench.machine.let_run(3.0)
        self.assert_shown(amphora)

    def assert_shown(self, outline):
        def shown():
            picture = self.bench.screendump()
            rows = screen.lit(picture)
            return (screen.share_outside(rows, screen.grown(outline, 2, picture.width)) < 0.01
                    and screen.share_outside(outline, screen.grown(rows, 2, picture.width)) < 0.01)

        eventually(shown, 20.0, "the screen does not show this artifact's outline")
