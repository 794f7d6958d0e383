#!/usr/bin/python3
"""Tests `frustumscreen status` on files that an exhibit, its watchdog and systemd could have left, and on hostile ones.

status_command_test.py PROGRAM [unittest's arguments]
"""

import json
import os
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

from prometheus_client.parser import text_string_to_metric_families

PROGRAM = ""


BOOT_ID = "7b0a6a4e-0d1c-4c39-9f0e-5b3b2f2d4c11"
NOW_S = 90000.25  # since the start of the machine, in the file that the program reads in place of its clock
WRITTEN_S = NOW_S - 1


def ns(seconds):
    return int(seconds * 10**9)


def exhibit(**changes):
    """A status as in docs/status.md, written shortly before."""
    status = {
        "written_at": "2026-05-01T10:00:00Z", "monotonic_ns": ns(WRITTEN_S), "boot_id": BOOT_ID,
        "versions": {"program": "1.2.3", "pack_format": 2, "system": "Debian GNU/Linux 12, Linux 6.1"},
        "health": "well", "left_out": [{"pack": "cat.fspack", "reason": "it is damaged"}],
        "set": {"number": 7, "packs": [{"file": "a", "id": "a", "title": "Amphora", "serial": 1}],
                "newest": {"number": 8, "verdict": "bad", "on_trial": False, "starts": 3, "reason": "dog.fspack is damaged"},
                "trouble": ""},
        "state": "view", "artifact": "Amphora \"of\" Exekias", "shown_since": "2026-05-01T08:00:00Z", "shown_for_s": 7200.5,
        "loaded": {"artifacts": 2, "bytes": 1048576}, "technique": "auto", "level": "level1", "samples": 4,
        "language": "en", "estimated_error_mm": 0.25, "frame_ms": {"p50": 8.5, "p95": 12.0, "p99": 17.25},
        "missed_deadlines": 3, "level_switches": 5, "frames": 100000, "drawn": 4000, "skipped": 6, "device_errors": 9,
        "display": "lights HDMI-A-1", "tracker": "a VIPER sends",
        "tracker_counts": {"connections": 2, "frames": 5000, "lost": 11, "broken": 1, "clock_drift_ppm": 25.0},
        "panel": "", "sound": "its sound goes to default", "sound_underruns": 2, "recording": "", "import": None,
        "prop_known": True, "head_known": False, "uptime_s": 36000.0, "resident_mib": 181.5}
    status.update(changes)
    return status


def device(ok, short_name, impaired=False):
    return {"ok": ok, "impaired": impaired, "id": short_name}


def devices(**changes):
    """The devices of an exhibit that has all of them; the settings have no camera and no screen."""
    all_well = {"display": device(True, "display.lit"), "screen": device(None, ""), "tracker": device(True, "tracker.streaming"),
                "camera": device(None, ""), "panel": device(True, "panel.well"), "sound": device(True, "sound.well")}
    return all_well | changes


NO_TRACKER = {"devices": devices(tracker=device(False, "tracker.not_connected")),
              "tracker": "no tracker is connected; check its USB cable and its power"}
NO_BUTTONS = "the buttons' GPIO chip cp2112_gpio: it is not there; is it plugged in, and its driver loaded?"


def watchdog(**changes):
    status = {
        "written_at": "2026-05-01T10:00:00Z", "monotonic_ns": ns(WRITTEN_S), "mode": "normal", "trouble": None, "step": None,
        "climb": 0, "reboots_today": 1,
        "boot_id": BOOT_ID, "lit": True, "next_pause_s": 60, "awake_s": 9000, "failures": 0, "last_end": "", "notes": [],
        "faults": [{"at": "2026-05-01T09:00:00Z", "awake_s": 5000, "cause": "device_hangs", "sentence": "the tracker is silent",
                    "step": "reset_device", "done": "its port is reset", "detail": "", "helped": True},
                   # the wall clock was set back meanwhile
                   {"at": "2026-05-01T08:30:00Z", "awake_s": 6000, "cause": "no_picture", "sentence": "no live picture",
                    "step": "restart_exhibit", "done": "the exhibit is started again", "detail": "killed KILL", "helped": False}]}
    status.update(changes)
    return status


class Status(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        for file, content in (("uptime", f"{NOW_S} 1000.00"), ("sys/kernel/random/boot_id", BOOT_ID)):
            path = self.folder / "root/proc" / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content + "\n", encoding="ascii")

    def write(self, name, content):
        data = content if isinstance(content, bytes) else json.dumps(content).encode()
        (self.folder / name).write_bytes(data)

    def boot_folder(self, version, slot, *notes):
        (self.folder / "boot").mkdir()
        for name, lines in (("version", [version]), ("slot", [slot]), ("notes", notes)):
            self.write(f"boot/{name}", "".join(f"{line}\n" for line in lines).encode())

    def crash(self, number, unix_s, thread, frame, *more):
        (self.folder / "crashes").mkdir(exist_ok=True)
        lines = ["frustumscreen-crash-1", f"unix_s {unix_s}", "monotonic_ms 5000", "boot b1", "signal SIGSEGV", f"thread {thread}",
                 "program 0.1.0", "system Debian", "driver llvmpipe", f"frame {frame}", *more, "end"]
        self.write(f"crashes/crash_{number}", "".join(f"{line}\n" for line in lines).encode())

    def run_status(self, *options):
        return subprocess.run(
            [PROGRAM, "status", "--status-file", self.folder / "status.json", "--watchdog-file", self.folder / "dog.json",
             "--staff-socket", self.folder / "staff.sock", "--boot-folder", self.folder / "boot",
             "--crash-folder", self.folder / "crashes", "--data-folder", self.folder / "data", "--root", self.folder / "root",
             *options],
            capture_output=True, check=False, env={**os.environ, "TZ": "UTC", "LC_ALL": "C.UTF-8"})

    def sensor(self, path, **files):
        """Makes a folder like the kernel's below sys, in the test's own root."""
        folder = self.folder / "root/sys/class" / path
        folder.mkdir(parents=True)
        for name, content in files.items():
            (folder / name).write_text(content + "\n", encoding="ascii")

    def text(self, expected_status):
        done = self.run_status()
        self.assertEqual(done.returncode, expected_status, done.stdout + done.stderr)
        self.assertEqual(done.stderr, b"")
        return done.stdout.decode()

    def line(self, text, name):
        found = [line for line in text.split("\n") if line.startswith(name + " ")]
        self.assertEqual(len(found), 1, text)
        return found[0][len(name):].strip()


class Text(Status):
    def test_fits_a_well_exhibit_on_one_screen(self):
        self.write("status.json", exhibit())
        self.write("dog.json", watchdog(notes=["the disk is 95 % full", 3, "it is hot\n"]))
        self.write("ends", f"{NOW_S - 36010} success exited 0\n{NOW_S - 240} watchdog killed KILL\n".encode())
        text = self.text(0)
        self.assertEqual(text.split("\n")[0], "The exhibit runs and is well.")
        self.assertLessEqual(text.count("\n"), 24)
        self.assertIn("\"Amphora \"of\" Exekias\" (en), for 2 h 0 min, since ", self.line(text, "on the screen"))
        self.assertEqual(self.line(text, "tracker"), "a VIPER sends")
        self.assertEqual(self.line(text, "projector"), "lights HDMI-A-1")
        self.assertEqual(self.line(text, "buttons"), "there are none")
        self.assertIn("median 8.5 ms, 99 % within 17.2 ms; 3 of 4000 pictures took longer",
                      self.line(text, "frame times"))
        self.assertIn("9 errors of devices; tracker: 11 of 5000 samples lost", self.line(text, "errors"))
        self.assertEqual(self.line(text, "packs"),
                         "set 7, 1 pack: Amphora; the newest is set 8, bad: dog.fspack is damaged")
        self.assertEqual(self.line(text, "left out"), "cat.fspack: it is damaged")
        self.assertRegex(self.line(text, "starts"),
                         r"^it runs for 10 h 0 min; it has ended 2 times, last 4 min ago: it stopped reporting "
                         r"to systemd \(killed KILL\)$")
        self.assertIn("1 restart of the machine today", self.line(text, "watchdog"))
        self.assertEqual(self.line(text, "last faults"),
                         "2026-05-01T08:30:00Z no live picture: the exhibit is started again, which did not help (killed KILL)")
        self.assertIn("2026-05-01T09:00:00Z the tracker is silent: its port is reset, which helped", text)
        self.assertEqual(self.line(text, "machine"), "the disk is 95 % full; it is hot?")
        self.assertEqual(self.line(text, "versions"), "FrustumScreen 1.2.3, packs of format 2, Debian GNU/Linux 12, Linux 6.1")

    def test_lists_the_last_crashes(self):
        self.write("status.json", exhibit())
        self.assertNotIn("last crashes", self.text(0))
        self.crash(1, 1767225600, "llvmpipe-0", "compiled+0x7f0012", "guess swrast_dri.so+0x1f3a0")
        self.crash(2, 1767225660, "frustumscreen", "frustumscreen+0x1234")
        (self.folder / "crashes/crash_3").write_bytes(b"\x00" * 100)
        text = self.text(0)
        self.assertEqual(self.line(text, "last crashes"),
                         "2026-01-01T00:01:00Z SIGSEGV in frustumscreen+0x1234, thread frustumscreen (FrustumScreen 0.1.0, llvmpipe)")
        self.assertIn("2026-01-01T00:00:00Z SIGSEGV in code that the graphics driver compiled, called from swrast_dri.so+0x1f3a0, "
                      "thread llvmpipe-0 (FrustumScreen 0.1.0, llvmpipe)", text)
        crashes = json.loads(self.run_status("--json").stdout)["crashes"]
        self.assertEqual([(crash["unix_s"], crash["frames"], crash["whole"]) for crash in crashes],
                         [(1767225660, ["frustumscreen+0x1234"], True), (1767225600, ["compiled+0x7f0012"], True)])

    def test_prints_since_when_an_artifact_is_shown(self):
        self.write("status.json", exhibit(shown_for_s=3 * 86400.0))
        begun = time.time() - 1  # time(2), which the program asks, is coarser
        shown = self.line(self.text(0), "on the screen")
        days = {time.strftime("%Y-%m-%d", time.gmtime(int(now) - 3 * 86400 - 1)) for now in (begun, time.time())}
        self.assertIn(shown.partition("for 72 h 0 min, since ")[2].split(" ")[0], days)  # two, around midnight

    def test_reports_a_missing_watchdog(self):
        self.write("status.json", exhibit())
        self.assertRegex(self.line(self.text(0), "watchdog"), r"^unknown: .*dog.json: there is no such file$")

    def test_prints_the_system_version_and_a_failed_update(self):
        self.write("status.json", exhibit())
        self.assertNotIn("\nsystem ", self.text(0))  # this is a computer that was not made from the image
        (self.folder / "boot").mkdir()
        self.write("boot/version", b"1.4.0\n")
        self.write("boot/slot", b"frustumscreen-b\n")
        self.assertEqual(self.line(self.text(0), "system"), "version 1.4.0, slot b")
        self.write("boot/notes", b"data: it was mended\nsystem: version 1.5.0 did not start\x1b\n")
        self.assertEqual(self.line(self.text(0), "system"),
                         "version 1.4.0, slot b; data: it was mended; version 1.5.0 did not start?")

    def test_reports_an_unknown_status(self):
        self.assertRegex(self.text(1), r"^The exhibit's status is unknown: .*status.json: there is no such file; systemctl status frustumscreen says more\.\n")

    def test_reports_the_age_of_an_old_status(self):
        self.write("status.json", exhibit(monotonic_ns=ns(NOW_S - 300)))
        text = self.text(1)
        self.assertTrue(text.startswith(
            "The exhibit does not run, or cannot say how it is: its status is 5 min old; systemctl status "
            "frustumscreen says more.\nIts last messages:\n"), text)
        self.assertTrue(self.line(text, "on the screen").endswith("(en), for 2 h 0 min"), text)
        self.assertIn("it ran for 10 h 0 min", self.line(text, "starts"))

    def test_a_status_is_current_for_five_seconds(self):
        for age_s, expected in ((0.0, 0), (5.0, 0), (5.01, 1)):
            self.write("status.json", exhibit(monotonic_ns=ns(NOW_S) - ns(age_s)))
            self.text(expected)

    def test_a_status_of_another_boot_is_old(self):
        self.write("status.json", exhibit(boot_id="00000000-0000-0000-0000-000000000000"))
        self.assertIn("its status is from before the machine was started", self.text(1))

    def test_rejects_a_status_from_the_future(self):
        self.write("status.json", exhibit(monotonic_ns=ns(NOW_S + 3600)))
        self.assertIn("does not say when it was written", self.text(1))

    def test_ignores_the_wall_clock(self):
        self.write("status.json", exhibit(written_at="1970-01-01T00:00:00Z"))
        self.assertIn("runs and is well", self.text(0))

    def test_names_the_fault_in_the_first_line(self):
        for changes, words in (({"health": "hangs"}, "not well"), ({"health": "no_picture"}, "not well"),
                               ({"health": "unheard of"}, "not well: its health is 'unheard of'"),
                               ({"state": "fault", "artifact": ""}, "has no artifact that it can show")):
            self.write("status.json", exhibit(**changes))
            self.assertIn(words, self.text(1).split("\n")[0])

    def test_prints_the_watchdogs_trouble_and_mode(self):
        trouble = {"cause": "hot", "sentence": "the machine is hot", "since_s": 90}
        for changes, words in (({"trouble": trouble}, "its watchdog says: the machine is hot"),
                               ({"mode": "built_in"}, "its watchdog lets the exhibit show a built-in artifact")):
            self.write("status.json", exhibit())
            self.write("dog.json", watchdog(**changes))
            self.assertIn(words, self.text(1).split("\n")[0])
        self.write("dog.json", watchdog(trouble=trouble, monotonic_ns=ns(NOW_S - 1000)))
        self.assertIn("runs and is well", self.text(0))  # an old complaint does not count

    def test_names_missing_devices(self):
        self.write("status.json", exhibit(**NO_TRACKER))
        text = self.text(1)
        self.assertEqual(text.split("\n")[0], "The exhibit runs, but: no tracker is connected.")
        self.assertEqual(self.line(text, "tracker"), NO_TRACKER["tracker"])
        known = json.loads(self.run_status("--json").stdout)
        self.assertEqual((known["well"], known["runs"], known["id"]), (False, True, "tracker.not_connected"))
        missing = devices(tracker=device(False, "tracker.not_connected"), panel=device(False, "panel.chip_not_opened"))
        self.write("status.json", exhibit(**(NO_TRACKER | {"devices": missing, "panel": NO_BUTTONS})))
        self.assertEqual(self.text(1).split("\n")[0],
                         "The exhibit runs, but: no tracker is connected; the buttons' GPIO chip cp2112_gpio: it is not there.")

    def test_devices_without_settings_are_not_missing(self):
        none = {name: device(None, "device.none") for name in devices()}
        self.write("status.json", exhibit(devices=none, tracker="a simulated visitor moves the prop; no tracker is used"))
        self.assertTrue(self.text(0).startswith("The exhibit runs and is well.\n"))

    def test_names_impaired_devices(self):
        for changes, words, short_name in (
                ({"devices": devices(panel=device(True, "panel.stuck", True)),
                  "panel": "a button is stuck and is ignored; free it or replace it"},
                 "a button is stuck and is ignored", "panel.stuck"),
                ({"drift": "the picture lies 5.0 mm beside where it was calibrated; hold both", "drifted": True},
                 "the picture lies 5.0 mm beside where it was calibrated", "drift.moved")):
            self.write("status.json", exhibit(**changes))
            self.assertEqual(self.text(0).split("\n")[0], f"The exhibit runs and is well, but needs attention: {words}.")
            self.assertEqual(json.loads(self.run_status("--json").stdout)["id"], short_name)
        self.write("status.json", exhibit(**(NO_TRACKER | {"drifted": True, "drift": "it moved"})))
        self.assertEqual(self.text(1).split("\n")[0], "The exhibit runs, but: no tracker is connected.")

    def test_prints_the_most_severe_fault_first(self):
        self.write("status.json", exhibit(health="frozen", **NO_TRACKER))
        self.assertIn("is not well: the picture that is presented", self.text(1).split("\n")[0])
        self.write("status.json", exhibit(**NO_TRACKER))
        self.write("dog.json", watchdog(mode="built_in"))
        self.assertIn("its watchdog lets the exhibit show a built-in artifact", self.text(1).split("\n")[0])

    def test_prints_disk_and_temperature(self):
        self.write("status.json", exhibit())
        self.assertEqual(self.line(self.text(0), "computer"), "on for 25 h 0 min")  # nothing else is known here
        (self.folder / "data").mkdir()
        self.sensor("thermal/thermal_zone0", type="acpitz", temp="27800")
        self.sensor("hwmon/hwmon3", name="k10temp", temp1_input="61250", temp1_crit="105000")
        self.sensor("hwmon/hwmon4", name="nvme", temp1_input="84850")
        disk = os.statvfs(self.folder)
        known = json.loads(self.run_status("--json").stdout)["machine"]
        self.assertEqual(known["hottest_c"], 61.25)  # a disk's own sensor is not the processor's
        self.assertEqual(known["disk"]["size_bytes"], disk.f_frsize * disk.f_blocks)
        self.assertAlmostEqual(known["disk"]["free_bytes"], disk.f_frsize * disk.f_bavail, delta=0.05 * known["disk"]["size_bytes"])
        self.assertEqual(known["on_s"], NOW_S)
        self.assertRegex(self.line(self.text(0), "computer"),
                         r"^on for 25 h 0 min; [0-9.]+ of [0-9.]+ GB of its disk are free; 61 degrees Celsius at its hottest sensor$")

    def test_prints_visits(self):
        self.write("status.json", exhibit())
        self.assertNotIn("\nvisitors ", self.text(0))
        visits = {"today": 34, "since_start": 40, "today_s": 7080.0, "since_start_s": 8000.0, "trouble": ""}
        self.write("status.json", exhibit(visits=visits))
        self.assertEqual(self.line(self.text(0), "visitors"), "today 34 visits, 118 minutes in all")
        self.write("status.json", exhibit(visits=visits | {"trouble": "the disk is full"}))
        self.assertEqual(self.line(self.text(0), "visitors"), "today 34 visits, 118 minutes in all; the disk is full")

    def test_rejects_wrong_options(self):
        for options in (("--json", "--prometheus"), ("--no-such-option",), ("word",)):
            done = self.run_status(*options)
            self.assertEqual((done.returncode, done.stdout), (2, b""))
            self.assertEqual(done.stderr.count(b"\n\n"), 0)


class Hostile(Status):
    DOCUMENTS = (
        b"", b"\x00", b"null", b"[]", b"3", b"{", b"{\"a\":1,\"a\":2}", b"[" * 100000, b"{\"a\":" * 5000, b"\xff\xfe{}",
        b" " * (1 << 20) + b"{}")

    def test_reports_an_invalid_status_in_one_line(self):
        for document in self.DOCUMENTS:
            self.write("status.json", document)
            self.write("dog.json", document)
            text = self.text(1)
            self.assertRegex(text.split("\n")[0], r"^The exhibit's status is unknown: .*\.$")
            self.assertLess(text.count("\n"), 6)

    def test_survives_any_type_and_value(self):
        values = (None, True, -1, 1e308, -1e308, 2**64 - 1, "", "x" * 100000, "\u202e\x1b[2J\x07\n\x9b", [], [[]], {}, {"a": []},
                  [None, 3, "x", {"pack": 3, "title": {}, "at": 1}])
        of_now = {"monotonic_ns": ns(WRITTEN_S), "boot_id": BOOT_ID}
        for value in values:  # in every field at once, and in each alone
            self.write("dog.json", watchdog(**{key: value for key in watchdog()}))
            self.check({key: value for key in exhibit()} | of_now)
            self.write("dog.json", watchdog(**{key: value for key in watchdog() if key != "monotonic_ns"}))
            self.check(exhibit())
        for number, key in enumerate(exhibit()):
            self.check(exhibit(**{key: values[number % len(values)]}))

    def check(self, status):
        self.write("status.json", status)
        done = self.run_status()
        self.assertIn(done.returncode, (0, 1), (status, done.stderr))
        self.assertFalse(re.search(rb"[\x00-\x09\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80\xae", done.stdout), status)
        list(text_string_to_metric_families(self.run_status("--prometheus").stdout.decode()))

    def test_reports_paths_that_are_no_files(self):
        os.mkfifo(self.folder / "status.json")  # reading it would wait for ever
        (self.folder / "dog.json").mkdir()
        (self.folder / "ends").symlink_to("/dev/zero")
        (self.folder / "boot").mkdir()
        os.mkfifo(self.folder / "boot/version")
        (self.folder / "boot/notes").symlink_to("/dev/zero")
        self.assertIn("status is unknown", self.text(1))

    def test_skips_invalid_lines_of_ends(self):
        self.write("status.json", exhibit())
        self.write("ends", b"\n\nnan watchdog a b\nx signal killed SEGV\n5\n5 \n\x00\xff\n7 invented \x1b[2J x y z\n8 oom-kill killed KILL")
        self.assertIn("it has ended 2 times, last", self.line(self.text(0), "starts"))


class Json(Status):
    def test_contains_both_files_under_fixed_keys(self):
        self.write("status.json", exhibit())
        self.write("dog.json", watchdog())
        self.boot_folder("1.4.0", "frustumscreen-a", "system: it did not start")
        self.write("ends", f"{NOW_S - 60} core-dump dumped ABRT\n".encode())
        done = self.run_status("--json")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        known = json.loads(done.stdout)
        self.assertEqual(list(known), ["well", "runs", "sentence", "id", "age_s", "exhibit", "watchdog", "ends", "crashes", "system", "machine"])
        self.assertEqual(known["system"], {"version": "1.4.0", "slot": "a", "notes": ["it did not start"]})
        self.assertTrue(known["well"] and known["runs"])
        self.assertEqual(known["age_s"], 1)
        self.assertEqual(known["watchdog"]["age_s"], 1)
        self.assertEqual(known["exhibit"]["status"]["artifact"], "Amphora \"of\" Exekias")
        self.assertEqual(known["watchdog"]["status"]["faults"], watchdog()["faults"])
        self.assertEqual((known["id"], known["watchdog"]["id"]), ("exhibit.well", "watchdog.normal"))
        self.assertEqual(known["ends"]["count"], 1)
        self.assertEqual(known["ends"]["last"]["result"], "core-dump")
        self.assertEqual(known["ends"]["last"]["ago_s"], 60)

    def test_contains_all_keys_without_a_status(self):
        done = self.run_status("--json")
        self.assertEqual(done.returncode, 1)
        known = json.loads(done.stdout)
        self.assertEqual(list(known), ["well", "runs", "sentence", "id", "age_s", "exhibit", "watchdog", "ends", "crashes", "system", "machine"])
        self.assertEqual((known["age_s"], known["exhibit"]["status"], known["ends"]["last"], known["system"]), (None,) * 4)
        self.assertIn("there is no such file", known["exhibit"]["why_unknown"])
        self.assertEqual((known["id"], known["watchdog"]["id"]), ("exhibit.unknown", "watchdog.unknown"))
        self.assertEqual((known["machine"]["hottest_c"], known["machine"]["disk"]), (None, None))

    def test_each_watchdog_sentence_has_an_id(self):
        self.write("status.json", exhibit())
        trouble = {"cause": "no_picture", "sentence": "the exhibit shows no live picture", "since_s": 90}
        for changes, short_name in (({"trouble": trouble}, "watchdog.no_picture"), ({"mode": "plain"}, "watchdog.plain"),
                                    ({"trouble": trouble | {"cause": "\u001b[2J"}}, "watchdog.trouble"),
                                    ({"mode": "invented"}, "watchdog.unheard_of"),
                                    ({"monotonic_ns": ns(NOW_S - 1000)}, "watchdog.old"),
                                    ({"monotonic_ns": None}, "watchdog.no_time")):
            self.write("dog.json", watchdog(**changes))
            self.assertEqual(json.loads(self.run_status("--json").stdout)["watchdog"]["id"], short_name)


class Prometheus(Status):
    def families(self, expected_status):
        done = self.run_status("--prometheus")
        self.assertEqual(done.returncode, expected_status, done.stderr)
        text = done.stdout.decode()
        families = {family.name: family for family in text_string_to_metric_families(text)}
        for family in families.values():
            self.assertTrue(family.name.startswith("frustumscreen_"), family.name)
            self.assertTrue(family.documentation and family.type in ("gauge", "counter"), family.name)
            labels = {tuple(sorted(sample.labels)) for sample in family.samples}
            self.assertEqual(len(labels), 1, family.name)
            seen = [tuple(sample.labels.items()) for sample in family.samples]
            self.assertEqual(len(seen), len(set(seen)), family.name)
            for sample in family.samples:
                self.assertEqual(sample.name.endswith("_total"), family.type == "counter", sample.name)
                self.assertNotRegex(sample.name, r"_(ms|mib|mm|ppm|percent|minutes|hours)(_|$)")
        self.assertEqual(len(re.findall("^# HELP ", text, re.M)), len(families))
        self.assertEqual(len(re.findall("^# TYPE ", text, re.M)), len(families))
        return families

    def value(self, families, name, **labels):
        found = [sample.value for sample in families["frustumscreen_" + name].samples if sample.labels == labels]
        self.assertEqual(len(found), 1, name)
        return found[0]

    def test_prints_numbers_in_base_units(self):
        self.write("status.json", exhibit())
        self.write("dog.json", watchdog())
        self.boot_folder("1.4.0", "frustumscreen-a", "one", "two")
        self.write("ends", b"1 watchdog killed KILL\n2 watchdog killed KILL\n3 strange killed KILL\n")
        families = self.families(0)
        self.assertEqual(self.value(families, "up"), 1)
        self.assertEqual(self.value(families, "well"), 1)
        self.assertEqual(self.value(families, "frame_time_seconds", share="0.99"), 0.01725)
        self.assertEqual(self.value(families, "resident_memory_bytes"), 181.5 * 2**20)
        self.assertEqual(self.value(families, "estimated_error_meters"), 0.00025)
        self.assertEqual(self.value(families, "tracker_clock_drift_ratio"), 25e-6)
        self.assertEqual(self.value(families, "frames"), 100000)
        self.assertEqual(self.value(families, "shown_seconds"), 7200.5)
        self.assertEqual(self.value(families, "artifact_info", artifact="Amphora \"of\" Exekias"), 1)
        self.assertEqual(self.value(families, "health", health="well"), 1)
        self.assertEqual(sum(sample.value for sample in families["frustumscreen_state"].samples), 1)
        self.assertEqual(self.value(families, "ends", result="watchdog"), 2)
        self.assertEqual(self.value(families, "ends", result="other"), 1)
        self.assertEqual(self.value(families, "ends", result="oom-kill"), 0)
        self.assertEqual(self.value(families, "watchdog_reboots"), 1)
        self.assertEqual(self.value(families, "system_info", version="1.4.0"), 1)
        self.assertEqual(self.value(families, "system_notes"), 2)
        self.assertEqual(self.value(families, "watchdog_mode", mode="normal"), 1)

    def test_prints_one_sample_per_configured_device(self):
        self.write("status.json", exhibit(**NO_TRACKER))
        families = self.families(1)
        self.assertEqual(self.value(families, "well"), 0)
        self.assertEqual({sample.labels["device"]: sample.value for sample in families["frustumscreen_device_ok"].samples},
                         {"display": 1, "tracker": 0, "panel": 1, "sound": 1})

    def test_prints_the_screen_behind_the_table(self):
        picture = {"health": "well", "code": 7, "shown_code": 6, "presented": 7000, "drawn": 600, "held_up": 5,
                   "frame_ms": {"p50": 4.5, "p95": 6.0, "p99": 9.25}}
        lit = exhibit(devices=devices(screen=device(True, "display.lit")), screen="the screen at DP-1 is lit", screen_picture=picture)
        self.write("status.json", lit)
        self.assertIn("the screen at DP-1 is lit; 7000 pictures presented, 600 of them drawn, 95 % within 6.0 ms", self.text(0))
        families = self.families(0)
        self.assertEqual(self.value(families, "device_ok", device="screen"), 1)
        self.assertEqual(self.value(families, "screen_pictures"), 7000)
        away = {"devices": devices(screen=device(False, "display.no_projector")),
                "screen": "no screen is connected to DP-1, or it is off; the exhibit lights it when it comes"}
        self.write("status.json", lit | away)
        self.assertTrue(self.text(1).startswith("The exhibit runs, but: no screen is connected to DP-1, or it is off.\n"))

    def test_prints_the_machine_and_its_visits(self):
        (self.folder / "data").mkdir()
        self.sensor("thermal/thermal_zone0", temp="54000")
        self.write("status.json", exhibit(visits={"today": 3, "since_start": 40, "today_s": 1.0, "since_start_s": 8000.5}))
        families = self.families(0)
        self.assertEqual(self.value(families, "temperature_celsius"), 54)
        self.assertEqual(self.value(families, "visits"), 40)
        self.assertEqual(self.value(families, "visits_seconds"), 8000.5)
        self.assertLess(self.value(families, "disk_free_bytes"), self.value(families, "disk_size_bytes"))
        self.assertEqual(self.value(families, "machine_uptime_seconds"), NOW_S)

    def test_omits_the_exhibits_numbers_if_it_does_not_run(self):
        self.write("status.json", exhibit(monotonic_ns=1))
        families = self.families(1)
        self.assertEqual(self.value(families, "up"), 0)
        self.assertEqual(self.value(families, "watchdog_up"), 0)
        self.assertNotIn("frustumscreen_frames", families)

    def test_escapes_titles_in_labels(self):
        title = "a\"} 1\nfrustumscreen_up 5\n\\"
        self.write("status.json", exhibit(artifact=title))
        families = self.families(0)
        self.assertEqual(self.value(families, "up"), 1)
        self.assertEqual(families["frustumscreen_artifact_info"].samples[0].labels["artifact"], title.replace("\n", "?"))


class Screenshot(Status):
    """The client, with an exhibit that gives wrong answers; tests/programs tests it with a real exhibit."""

    def answered(self, answer):
        """The program's end after this answer. It gives up after ten seconds, in which `serve` may not have run: it must ask again then."""
        done = self.asked(answer)
        while b"does not answer in time" in done.stderr:
            done = self.asked(answer)
        return done

    def asked(self, answer):
        listening = socket.socket(socket.AF_UNIX)
        listening.bind(str(self.folder / "staff.sock"))
        listening.listen()

        def serve():
            with listening, listening.accept()[0] as client:
                self.question = client.recv(100)
                try:
                    client.sendall(answer)
                except OSError:
                    pass

        thread = threading.Thread(target=serve)
        thread.start()
        self.write("status.json", exhibit())
        done = self.run_status("--screenshot", self.folder / "shot.png")
        thread.join()
        (self.folder / "staff.sock").unlink()
        return done

    def test_writes_the_picture_and_prints_the_status(self):
        done = self.answered(b"ok 5\nhello")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(self.question, b"screenshot\n")
        self.assertEqual((self.folder / "shot.png").read_bytes(), b"hello")
        self.assertIn(b"runs and is well", done.stdout)

    def test_writes_no_file_for_other_answers(self):
        for answer in (b"", b"ok 6\nhello", b"ok 4\nhello", b"ok -1\n", b"ok x\n", b"ok 99999999999999999999\n", b"hello" * 1000,
                       b"no it \x1b[2J hangs\n"):
            done = self.answered(answer)
            self.assertEqual(done.returncode, 1, answer)
            self.assertEqual(done.stderr.count(b"\n"), 1, done.stderr)
            self.assertNotIn(b"\x1b", done.stderr)
            self.assertFalse((self.folder / "shot.png").exists())
            self.assertIn(b"runs and is well", done.stdout)

    def test_reports_that_no_exhibit_listens(self):
        self.write("status.json", exhibit())
        done = self.run_status("--screenshot", self.folder / "shot.png")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"no exhibit listens there", done.stderr)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
