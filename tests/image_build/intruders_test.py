"""Tests the checks of test_breakout on artificial facts: no sentence without a break-in, and a sentence for each kind of break-in."""

import copy
import unittest

import intruders

CALM = {
    "process": ["/usr/lib/systemd/systemd", "/usr/bin/frustumscreen", "/usr/bin/frustumscreen-watchdog", "/usr/bin/dash", "/usr/bin/udevadm"],
    "shown": ["tty1"], "boot": ["1"], "pid": ["600"], "restarts": ["0"], "tainted": ["0"], "sysrq": ["0"],
    "lockdown": ["none [integrity] confidentiality"], "net": ["lo"], "keyboards": ['Name="Power Button"'], "volumes": ["dm-0"],
    "listens": ["/run/systemd/private", "/run/frustumscreen/remote"], "mounted": ["/ ro", "/data rw,nosuid,nodev,noexec"],
}


class Judge(unittest.TestCase):
    def test_accepts_an_unchanged_machine(self):
        self.assertEqual(intruders.wrong(CALM, copy.deepcopy(CALM)), [])

    def test_reports_each_break_in(self):
        for kind, lines, words in (
                ("process", [*CALM["process"], "/usr/bin/bash"], "/usr/bin/bash runs"),
                ("process", [*CALM["process"], "/run/frustumscreen"], "/run/frustumscreen runs"),
                ("process", [*CALM["process"], "/usr/bin/dash (deleted)"], "runs, which"),
                ("process", CALM["process"][:1], "frustumscreen runs no more"),
                ("shown", ["tty2"], "the console shows"),
                ("boot", ["2"], "boot was"), ("pid", ["601"], "pid was"), ("tainted", ["512"], "tainted was"),
                ("net", ["lo", "eth0"], "network interface eth0"),
                ("socket", ["tcp 0: 00000000:1F90 0A"], "spoken to"),
                ("listens", ["@/tmp/.X11-unix/X0"], "listens at"),
                ("sysrq", ["1"], "the kernel obeys"), ("lockdown", ["[none] integrity"], "the kernel obeys"),
                ("keyboards", ['Name="Power Button"', 'Name="Keyboard"'], "keyboards was"),
                ("swaps", ["/dev/sda1"], "swaps was"), ("volumes", ["dm-0", "dm-1"], "volumes was"),
                ("mounted", [*CALM["mounted"], "/mnt ro,nosuid,nodev,noexec"], "/mnt is mounted")):
            with self.subTest(words):
                said = intruders.wrong(CALM, {**CALM, kind: lines})
                self.assertTrue(any(words in line for line in said), said)

    def test_mounts(self):
        """Also at an expected place, a mount must not allow programs to run."""
        for options, strange in (("ro,nosuid,nodev,noexec,nosymfollow", 0), ("rw,nosuid,nodev,noexec", 1), ("ro,nosuid,nodev", 1)):
            now = {**CALM, "mounted": [*CALM["mounted"], f"/run/frustumscreen-stick/stick3 {options}"]}
            self.assertEqual(len(intruders.wrong(CALM, now, mounted="/run/frustumscreen-stick/stick3")), strange, options)


if __name__ == "__main__":
    unittest.main()
