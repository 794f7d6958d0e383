"""Tests settings on a stick: the exhibit restarts with them and says so; unsigned, wrong and unusable ones change nothing."""

from bench import SETTINGS, eventually
from hil_test import CENTRE_M, long
from stick_bench import TOLD_PIXELS, ToldStickTest, pulled_packs

RESTART_S = 90.0
START_S = 120.0  # the exhibit may take so long with new settings before the previous ones are restored
TOLD_S = 180.0  # the table shows the report for two minutes


@long
class SettingsByStick(ToldStickTest):
    after = f"rm -f {SETTINGS}.*"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.bench.machine.write(SETTINGS, cls.settings)  # no key yet: that comes with the stick
        # Settings with only the other artifact, and with the museum's key
        amphora = '"/var/lib/frustumscreen/packs/amphora.fspack", '
        assert amphora in cls.settings
        cls.brought = cls.settings.replace(amphora, "") + cls.keys

    @classmethod
    def tearDownClass(cls):
        cls.bench.machine.check(cls.after)
        super().tearDownClass()

    def put(self, name, text):
        """The report on these settings on a stick."""
        self.plug(name, self.make(name, "vfat", {"kiosk.toml": text.encode()}))
        told = pulled_packs(self.outcome())["kiosk.toml"]
        self.pull(name)
        return told

    def test_1_taken(self):
        before = self.bench.main_process()
        self.assertEqual(self.put("first", self.brought), ("taken", "none"))
        eventually(lambda: self.bench.main_process() not in (before, 0), RESTART_S, "the exhibit is not started again")
        self.bench.status_says("artifact", "^nautilus-cup$", RESTART_S)
        # The table reports on the stick after the restart.
        eventually(lambda: self.lit_beside_prop() > TOLD_PIXELS, 20.0, "the table says nothing of the stick")
        eventually(lambda: self.lit_beside_prop() == 0, TOLD_S, "what was told stays on the table")
        self.assert_at(CENTRE_M, artifact="nautilus-cup")
        self.assertEqual(self.bench.machine.read(SETTINGS), self.brought)
        self.assertEqual(self.bench.machine.read(f"{SETTINGS}.before"), self.settings)

    def test_2_not_taken(self):
        before = self.bench.main_process()
        self.assertEqual(self.put("again", self.brought), ("already_there", "none"))
        self.assertEqual(self.put("unsigned", self.settings), ("refused", "unsigned"))
        self.assertEqual(self.bench.main_process(), before, "the exhibit was started again")
        self.assertEqual(self.bench.machine.read(SETTINGS), self.brought)

    def test_3_the_exhibit_does_not_start_with_them(self):
        self.bench.machine.write(SETTINGS, self.settings)
        unusable = self.settings.replace("[exhibit]", '[display]\ncard = "card99"\n\n[exhibit]')
        self.assertEqual(self.put("unusable", unusable), ("taken", "none"))
        eventually(lambda: self.bench.machine.read(SETTINGS) == self.settings, START_S + RESTART_S, "the settings of before do not come back")
        self.bench.status_says("artifact", "^amphora$", RESTART_S)
        self.assertEqual(pulled_packs(self.report())["kiosk.toml"], ("refused", "not_a_pack"))
