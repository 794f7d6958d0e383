#!/usr/bin/python3
"""Tests a kiosk's reports on updates on a stick, without a machine: its own script and RAUC run in an artificial root, in which nothing can
be mounted or installed.

update_test.py [unittest's arguments]
"""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
OWN = TOP / "image_build/files/usr/lib/frustumscreen"
RUNNING = "aa" * 32
# Runs in a user namespace as root, with a root folder of its own; /usr, /proc and /dev are the computer's.
ENTER = """set -e
cd "$1"
for folder in usr proc dev; do mount --rbind /$folder $folder; done
exec chroot . /bin/sh -c 'PATH=/run/bin:$PATH exec /own/update stick1'"""


class Update(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        for name in ("ours", "theirs"):
            subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                            "-subj", f"/CN={name}", "-days", "7300", "-keyout", cls.made / f"{name}.key",
                            "-out", cls.made / f"{name}.crt"], check=True, capture_output=True)
        cls.bundles = {}
        for version in ("1.2.0", "1.3.0", "1.10.0"):
            for end in ("slot", "efi"):
                (cls.made / f"frustumscreen_{version}.{end}").write_bytes(os.urandom(1 << 16))
            out = cls.made / f"{version}.raucb"
            subprocess.run([TOP / "image_build/bundle", "--image", cls.made, "--version", version, "-o", out, "--key", cls.made / "ours.key",
                            "--cert", cls.made / "ours.crt"], check=True, capture_output=True)
            cls.bundles[version] = out.read_bytes()

    def setUp(self):
        self.root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for folder in ("usr", "proc", "dev", "own", "tmp", "etc/rauc", "run/bin", "run/frustumscreen-boot", "run/frustumscreen-import",
                       "run/frustumscreen-stick/stick1", "run/frustumscreen-update", "run/sticks/stick1", "efi/EFI/Linux"):
            (self.root / folder).mkdir(parents=True)
        for name in ("bin", "lib", "lib64", "sbin"):
            (self.root / name).symlink_to(f"usr/{name}")
        for name in ("update", "import-report", "boot-slots", "trim-boot-folder"):
            (self.root / "own" / name).write_bytes((OWN / name).read_bytes())
            (self.root / "own" / name).chmod(0o755)
        for name in ("mount", "umount"):
            (self.root / "run/bin" / name).write_text("#!/bin/sh\n", encoding="ascii")
            (self.root / "run/bin" / name).chmod(0o755)
        self.write("run/frustumscreen-boot/slot", "frustumscreen-a\n")
        self.write("run/frustumscreen-boot/version", "1.2.0\n")
        (self.root / "run/frustumscreen-boot/boot").symlink_to("/dev/null")
        self.write("cmdline", f"frustumscreen.root_hash={RUNNING}\n")
        self.write("etc/rauc/keyring.pem", (self.made / "ours.crt").read_bytes())
        self.image("1.2.0+5", RUNNING)

    def write(self, name, content):
        (self.root / name).write_bytes(content if isinstance(content, bytes) else content.encode())

    def image(self, name, root_hash):
        self.write(f"efi/EFI/Linux/frustumscreen_{name}.efi", f"frustumscreen.root_hash={root_hash}")

    def put_in(self, **files):
        """Puts in a stick with these bundles; returns name -> (outcome, refusal, sentence)."""
        for name, content in files.items():
            self.write(f"run/frustumscreen-stick/stick1/{name}.raucb", content)
        done = subprocess.run(["unshare", "--mount", "--map-root-user", "sh", "-c", ENTER, "sh", self.root], capture_output=True, text=True,
                              check=False, env={**os.environ, "BOOT_SLOTS_COMMAND_LINE": "/cmdline", "UPDATE_STICKS": "/run/sticks"})
        self.assertEqual(done.returncode, 0, done.stderr)
        outcome = self.root / "run/frustumscreen-update/outcome-stick1.json"
        if not outcome.exists():
            return None
        report = json.loads(outcome.read_text(encoding="ascii"))
        self.assertEqual((report["import_id"], report["stage"]), ("update-stick1", "done"))
        for pack in report["packs"]:
            self.assertRegex(pack["reason"], r"^[^.!]*[^.!\s]$|[0-9]\.[0-9]")
        return {pack["file"].removesuffix(".raucb"): (pack["outcome"], pack["refusal"], pack["reason"]) for pack in report["packs"]}

    def test_ignores_a_stick_without_updates(self):
        self.assertIsNone(self.put_in())
        self.assertFalse(any((self.root / "run/frustumscreen-import").iterdir()))

    def test_rejects_damaged_bundles(self):
        whole = self.bundles["1.3.0"]
        said = self.put_in(cut=whole[:len(whole) // 2], empty=b"", words=b"hello", signature=whole[:-100] + bytes([whole[-100] ^ 1]) + whole[-99:])
        for name in ("cut", "empty", "words"):
            self.assertEqual(said[name][:2], ("refused", "not_a_pack"), name)
            self.assertIn("cut off or damaged", said[name][2])
        self.assertEqual(said["signature"][0], "refused")

    def test_rejects_another_key_and_a_missing_keyring(self):
        self.write("etc/rauc/keyring.pem", (self.made / "theirs.crt").read_bytes())
        self.assertEqual(self.put_in(new=self.bundles["1.3.0"])["new"][:2], ("refused", "wrong_key"))
        (self.root / "etc/rauc/keyring.pem").unlink()
        self.assertIn("takes no updates", self.put_in()["new"][2])

    def test_refuses_the_same_and_older_versions(self):
        self.assertEqual(self.put_in(same=self.bundles["1.2.0"])["same"], ("already_there", "none", "this version runs already"))
        self.write("run/frustumscreen-boot/version", "1.9.0\n")
        self.assertEqual(self.put_in()["same"][:2], ("refused", "older"))

    def test_takes_the_newest_of_several(self):
        said = self.put_in(a=self.bundles["1.10.0"], b=self.bundles["1.3.0"])
        self.assertEqual(said["b"][:2], ("refused", "older"))
        self.assertEqual(said["a"][1], "unwritable")  # there is no disk here

    def test_refuses_a_version_that_was_tried_or_waits(self):
        self.image("1.3.0+0-3", "bb" * 32)
        self.assertIn("was tried here and did not start", self.put_in(new=self.bundles["1.3.0"])["new"][2])
        (self.root / "efi/EFI/Linux/frustumscreen_1.3.0+0-3.efi").unlink()
        self.image("1.3.0+3", "bb" * 32)
        self.assertEqual(self.put_in()["new"][0], "already_there")

    def test_refuses_updates_while_the_running_version_is_unproved(self):
        (self.root / "efi/EFI/Linux/frustumscreen_1.2.0+5.efi").rename(self.root / "efi/EFI/Linux/frustumscreen_1.2.0+2-1.efi")
        self.assertIn("has itself not shown yet", self.put_in(new=self.bundles["1.3.0"])["new"][2])

    def test_pulled_out(self):
        (self.root / "run/sticks/stick1").rmdir()
        self.assertEqual(self.put_in(cut=self.bundles["1.3.0"][:5000])["cut"][:2], ("refused", "unreadable"))

    def test_hostile_names(self):
        said = self.put_in(**{'a", "x': b"", "b\n\x1b[2J": b"", "ü\\u0000": b"", "-rf": b""})
        self.assertEqual({entry[1] for entry in said.values()}, {"not_a_pack"})
        self.assertTrue(all(name.isprintable() and '"' not in name for name in said), said)


if __name__ == "__main__":
    unittest.main()
