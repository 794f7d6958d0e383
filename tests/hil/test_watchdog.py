"""Tests the watchdog service: after each failure the exhibit comes back by the fewest steps; docs/recovery.md has the table.

Each test checks the screen: the lit area, and the code in the picture's corner, which changes while the picture is live.
"""

import json

import screen
from bench import SETTINGS, UNIT, USUAL, eventually
from hil_test import START_S, HilTest, long

WATCHDOG = "frustumscreen-watchdog.service"
STATUS = "/run/frustumscreen-watchdog/status.json"
LAST_GOOD = "/var/cache/frustumscreen/settings_last_good.toml"
CRASHES = "/var/cache/frustumscreen/crashes"
REASON = "/run/frustumscreen-watchdog/reason"
GROUP = "/sys/fs/cgroup/system.slice/frustumscreen.service"
PACKS = "/var/lib/frustumscreen/packs"
SPOILT = "[projector]\nwidth = \n"
BEGIN = f"""systemctl stop {WATCHDOG}; rm -rf /var/lib/frustumscreen-watchdog/*; touch /run/hil-watchdog
systemctl start {WATCHDOG}"""
END = f"rm -f /run/hil-watchdog; systemctl stop {WATCHDOG}"
BACK_S = 60.0  # a start on a slow processor
LIT_PIXELS = 300
SYSTEM_BACK_S = 120.0


class Watchdog(HilTest):
    def setUp(self):
        super().setUp()
        self.bench.machine.check(BEGIN)
        self.addCleanup(self.bench.machine.run, END)
        eventually(lambda: self.said().get("lit"), BACK_S, "the watchdog does not see that the exhibit is lit")
        self.process = self.bench.main_process()

    def said(self):
        text = self.bench.machine.read(STATUS)
        try:
            return json.loads(text) if text else {}
        except ValueError:
            return {}

    def faults(self):
        return self.said().get("faults", [])

    def took(self, step, cause, timeout_s=BACK_S):
        """Waits until the watchdog has taken this step for this cause, and prints the steps before it."""
        def found():
            return [fault for fault in self.faults() if (fault["step"], fault["cause"]) == (step, cause)]

        eventually(found, timeout_s, lambda: f"no step {step} for {cause}, only {self.faults()}")
        print("  " + ", ".join(f"{fault['cause']}: {fault['step']}" for fault in self.faults()), flush=True)

    def assert_lives(self, timeout_s=BACK_S):
        """Waits until the screen is lit and its picture changes."""
        seen = set()

        def lit_anew():
            picture = self.bench.screendump()
            code = screen.probe(picture)
            if code is not None and screen.count(screen.lit(picture)) >= LIT_PIXELS:
                seen.add(code)
            return len(seen) > 1

        eventually(lit_anew, timeout_s, lambda: f"no living picture comes; codes seen: {seen}")
        self.tell_lit()

    def assert_untouched(self):
        self.assert_lives()
        self.assertEqual(self.bench.main_process(), self.process, "the exhibit was started again")
        self.assertEqual(self.faults(), [], "a step was taken though the exhibit was well")

    def kill(self):
        """Kills the exhibit, and waits until systemd has started it again."""
        process = self.bench.main_process()
        self.assertNotEqual(process, 0, "the exhibit does not run")
        self.broken()
        self.bench.machine.check(f"kill -KILL {process}")
        eventually(lambda: self.bench.main_process() not in (0, process), BACK_S, "systemd does not restart it")

    def process_of(self, unit):
        return int(self.bench.machine.check(f"systemctl show --value -p MainPID {unit}"))

    def test_watchdog_killed_and_stopped(self):
        for signal in ("KILL", "STOP"):
            process = self.process_of(WATCHDOG)
            self.bench.machine.check(f"kill -{signal} {process}")
            eventually(lambda: self.process_of(WATCHDOG) not in (0, process), BACK_S, "systemd does not restart it")
            since_ns = 1e9 * self.bench.uptime_s()  # the old process has ended, but its file is still there
            eventually(lambda since_ns=since_ns: (said := self.said()).get("monotonic_ns", 0) > since_ns and said["lit"], BACK_S,
                       "it runs again and sees nothing")
        self.assert_untouched()

    def test_exhibit_killed_again_and_again(self):
        for _ in range(3):
            self.kill()
        self.took("reset_device", "keeps_ending")
        self.bench.status_says("tracker", "is running", START_S, fresh=True)
        self.assert_lives()
        self.assertEqual(len(self.faults()), 1, f"more steps than one: {self.faults()}")

    @long
    def test_spoilt_settings(self):
        machine = self.bench.machine
        self.show("nautilus-cup")
        eventually(lambda: machine.read(LAST_GOOD) == USUAL, BACK_S, "good settings are not kept")
        # When the watchdog stops, systemd removes its folder, and with it the mode.
        self.addCleanup(machine.run, f"{END}; systemctl restart --no-block {UNIT}")
        self.addCleanup(machine.write, SETTINGS, USUAL)
        machine.write(SETTINGS, SPOILT)
        self.broken()
        machine.check(f"kill -KILL {self.process}")
        self.took("built_in", "keeps_ending", 3 * BACK_S)
        self.bench.status_says("mode", "^built_in$", START_S)
        status = self.bench.status_says("artifact", "^Amphora$", START_S)
        self.assertIn(f"the last good settings, {LAST_GOOD}, are used in their place: {SETTINGS}:2", status["settings"])
        self.bench.status_says("tracker", "is running", START_S)
        self.assert_at((0.0, 0.0, 0.0), artifact="amphora")  # the pack of this name has the same triangles
        self.assert_lives()

    @long
    def test_tracker_hung_until_its_port_is_reset(self):
        self.broken()
        self.bench.tracker.tell("hang-until-reset")
        self.bench.status_says("tracker_hangs", "True")
        self.took("reset_device", "device_silent")
        self.bench.status_says("tracker", "is running", START_S)
        self.bench.place((0.05, 0.0, 0.0))
        self.assert_at((0.05, 0.0, 0.0))
        self.assert_lives()
        self.assertEqual(self.bench.main_process(), self.process, "the exhibit was started again")

    def test_driver_that_crashes_at_each_start(self):
        """With plain drawing the museum's own set is shown, and the place of the crash is reported and kept."""
        machine = self.bench.machine
        # When the watchdog stops, systemd removes its folder, and with it the mode.
        self.addCleanup(machine.run, f"{END}; rm -f /run/hil/crash-driver; rm -rf {CRASHES}; systemctl restart --no-block {UNIT}")
        machine.check("touch /run/hil/crash-driver")
        self.broken()
        machine.check(f"kill -KILL {self.process}")
        self.took("draw_plainly", "keeps_ending", 2 * BACK_S)
        self.assertIn("the exhibit's program ends again and again: SIGSEGV in hang.so+0x", machine.read(REASON))
        self.assertIn("thread llvmpipe-", machine.read(REASON))
        self.bench.status_says("mode", "^plain$", START_S)
        self.bench.status_says("tracker", "is running", START_S)
        self.assert_at((0.0, 0.0, 0.0))
        self.assert_lives()
        crashes = json.loads(machine.run("frustumscreen status --json").output)["crashes"]
        self.assertLessEqual(len(crashes), 3)
        self.assertEqual(crashes[0]["signal"], "SIGSEGV")
        self.assertRegex(crashes[0]["frames"][0], r"^hang\.so\+0x[0-9a-f]+$")
        self.assertIn("swrast_dri.so", " ".join(crashes[0]["frames"]))
        self.assertTrue(all(crash["whole"] for crash in crashes))

    def test_clock_leaps(self):
        machine = self.bench.machine
        self.addCleanup(machine.run, "date -s \"@$(cat /run/hil/now)\"")
        machine.check("date +%s > /run/hil/now")
        for days in (365, -730):
            machine.check(f"date -s @$(($(date +%s) + {86400 * days}))")
            self.settle()
        self.assert_untouched()

    @long
    def test_spoilt_packs(self):
        """The exhibit runs and has nothing to show."""
        machine = self.bench.machine
        self.addCleanup(machine.run, f"{END}; mv /run/hil-packs/* {PACKS}; systemctl restart --no-block {UNIT}")
        machine.check(f"mkdir -p /run/hil-packs; mv {PACKS}/*.fspack /run/hil-packs; "
                      f"for pack in amphora nautilus-cup; do echo spoilt > {PACKS}/$pack.fspack; done")
        self.kill()
        self.took("built_in", "nothing_to_show", 4 * BACK_S)
        self.bench.status_says("artifact", "^Amphora$", START_S)
        self.assert_at((0.0, 0.0, 0.0), artifact="amphora")
        self.assert_lives()

    @long
    def test_full_disk(self):
        """The disk is full: the exhibit goes on, and the watchdog takes steps, but no reboot that it cannot record."""
        machine = self.bench.machine
        folders = ("/var/lib/frustumscreen-watchdog", "/var/cache/frustumscreen")
        self.addCleanup(machine.run, f"{END}; systemctl stop {UNIT}; umount {' '.join(folders)}; systemctl start --no-block {UNIT}")
        machine.check(f"systemctl stop {WATCHDOG} {UNIT}")
        for folder in folders:
            machine.check(f"mount -t tmpfs -o size=8k full {folder}; "
                          f"head -c 8192 /dev/zero > {folder}/full; ! echo more > {folder}/more")
        machine.check(f"systemctl start --no-block {UNIT}")
        eventually(lambda: self.said().get("lit"), BACK_S, "it is not lit")
        self.assert_lives()
        for _ in range(3):
            self.kill()
        self.took("reset_device", "keeps_ending")
        self.assert_lives()

    @long
    def test_full_run(self):
        """No memory is left for the files of /run; the exhibit's status still stays fresh, and no step is taken."""
        machine = self.bench.machine
        self.addCleanup(machine.run, "rm -f /run/full")
        machine.run("cat /dev/zero > /run/full")
        self.assertEqual(machine.check("stat -f -c %a /run").strip(), "0")
        machine.check("sleep 30", 300.0)  # the agent itself cannot open a file now
        known = json.loads(machine.run("frustumscreen status --json").output)
        machine.check("rm /run/full")
        for who in ("exhibit", "watchdog"):
            self.assertLess(known[who]["age_s"], 5.0, f"the status of the {who} is old")
        self.assert_untouched()

    @long
    def test_leak(self):
        """A process of the unit takes memory until MemoryMax=: the kernel ends it, and systemd starts the exhibit again."""
        self.broken()
        self.bench.machine.spawn(f"echo $$ > {GROUP}/cgroup.procs; exec tail /dev/zero")
        eventually(lambda: self.bench.main_process() not in (0, self.process), 2 * BACK_S, "it was not started again")
        self.assertIn("Failed with result 'oom-kill'", self.bench.journal())
        self.assert_lives()

    @long
    def test_fork_bomb(self):
        """TasksMax= limits a fork bomb; the exhibit goes on, and when it is killed it comes back without the bomb."""
        machine = self.bench.machine
        machine.spawn(f"echo $$ > {GROUP}/cgroup.procs; while :; do sleep 1000 & done")
        # The shell ends when the kernel refuses it a process; the processes that exist stay.
        eventually(lambda: int(machine.read(f"{GROUP}/pids.events").split()[1]) > 0, BACK_S, "the bomb does not go off")
        self.assertGreaterEqual(int(machine.read(f"{GROUP}/pids.current")), int(machine.read(f"{GROUP}/pids.max")) - 4)
        self.assert_untouched()
        self.kill()
        self.assert_lives()
        self.assertLess(int(machine.read(f"{GROUP}/pids.current")), int(machine.read(f"{GROUP}/pids.max")) // 2)

    @long
    def test_load(self):
        """Twelve busy loops for ten minutes: no step is taken."""
        self.addCleanup(self.bench.machine.run, "systemctl stop hil-load.service")
        self.bench.machine.check("systemd-run --unit=hil-load sh -c 'for k in 1 2 3 4 5 6 7 8 9 10 11 12; do "
                                 "while :; do :; done & done; wait'")
        self.settle(600.0)
        self.assert_untouched()

    @long
    def test_frozen_service_manager(self):
        """Only the hardware's watchdog still works: it resets the machine."""
        self.bench.machine.may_start_anew()
        self.broken()
        self.bench.machine.spawn("echo 1 > /sys/fs/cgroup/init.scope/cgroup.freeze")
        self.assert_started_anew()

    @long
    def test_panic(self):
        self.bench.machine.may_start_anew()
        self.broken()
        self.bench.machine.spawn("sleep 1; echo c > /proc/sysrq-trigger")
        self.assert_started_anew()

    def assert_started_anew(self):
        self.assertTrue(self.bench.machine.resets_within(SYSTEM_BACK_S), "the machine was not reset")
        self.bench.machine.wait_for_start()
        self.bench.status_says("tracker", "is running", SYSTEM_BACK_S)
        self.assert_lives(SYSTEM_BACK_S)

    def settle(self, seconds=5.0):
        """Lets the watchdog observe the exhibit for this time."""
        begun = self.said()["monotonic_ns"]
        eventually(lambda: self.said().get("monotonic_ns", 0) > begun + 1e9 * seconds, 10 * seconds, "it does not look")
