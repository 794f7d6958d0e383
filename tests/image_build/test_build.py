"""Tests ./image_build/build itself: its bytes, its signatures, and the arguments that it refuses."""

import filecmp
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest

from image_test import IMAGE, long

CHECKOUT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = CHECKOUT / "image_build" / "build"
UPDATE_CA = CHECKOUT / "build" / "image" / "test_keys" / "update.crt"
TEST_KEY = pathlib.Path("/usr/share/ovmf/PkKek-1-snakeoil.key")  # its password is "snakeoil"; never for a museum


def build(*options):
    """Builds like make_image.sh, with the image's versions of Debian's packages and the image's time, because HEAD may have changed."""
    (slot,) = IMAGE.parent.glob("frustumscreen_*.slot")
    (time_s,) = struct.unpack_from("<I", slot.read_bytes()[:12], 8)  # squashfs' superblock: mkfs_time
    return subprocess.run([BUILD, "--quick", "--locked", IMAGE.with_name("packages.txt"), "--packages",
                           os.environ["FRUSTUMSCREEN_IMAGE_PACKAGES"], "--update-ca", UPDATE_CA, *options],
                          capture_output=True, text=True, check=False, env={**os.environ, "SOURCE_DATE_EPOCH": str(time_s)})


def keys_in(folder):
    """A folder for --keys."""
    keys = folder / "keys"
    keys.mkdir()
    subprocess.run(["openssl", "rsa", "-in", TEST_KEY, "-passin", "pass:snakeoil", "-out", keys / "db.key"], check=True,
                   capture_output=True)
    (keys / "db.crt").write_bytes(TEST_KEY.with_suffix(".pem").read_bytes())
    return keys


class Build(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(dir=CHECKOUT / "build")))

    @long  # test_shipped_disk_equals_a_plain_build compares two builds for each change
    def test_two_builds_are_the_same(self):
        done = build("--test", "--out", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        again = self.folder / "test" / IMAGE.name
        self.assertTrue(filecmp.cmp(IMAGE, again, shallow=False), f"{IMAGE} and a second build of it differ")
        for name in ("sbom.json", "licences.tar", "why.txt"):
            self.assertTrue(filecmp.cmp(IMAGE.with_name(name), again.with_name(name), shallow=False), name)

    def test_shipped_disk_equals_a_plain_build(self):
        """The disk as_shipped equals a build without --test, byte for byte."""
        done = build("--out", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        as_shipped = IMAGE.parent / "as_shipped" / IMAGE.name
        self.assertTrue(filecmp.cmp(as_shipped, self.folder / IMAGE.name, shallow=False), f"{as_shipped} and a second build of it differ")
        self.assertTrue(filecmp.cmp(IMAGE.with_name("packages.txt"), self.folder / "packages.txt", shallow=False))

    def test_names_versions_that_debian_lacks(self):
        """Missing versions are named, each with Debian's version, before packages are installed; the order of the list does not matter.
        Debian may also have newer versions of other packages."""
        listed = [line for line in reversed(self.listed()) if not line.startswith("zlib1g ")]
        refused = self.refused_by_debian([*listed, "zlib1g 0.0", "frustumscreen-unknown 1"])
        named = re.findall(r"^--locked has: (\S+) (\S+)\nDebian has:  (\S+) (\S+)$", refused, re.MULTILINE)
        self.assertIn(("zlib1g", "0.0", "zlib1g"), [each[:3] for each in named], refused)
        self.assertIn("--locked has: frustumscreen-unknown 1\nDebian has:  no package of this name\n", refused)
        for package, version, of_debian, there in named:
            self.assertEqual(package, of_debian, refused)
            self.assertIn(f"{package} {version}", [*listed, "zlib1g 0.0"])
            self.assertNotEqual(version, there, refused)

    @long
    def test_names_packages_that_the_list_lacks(self):
        """Debian installs a package that the list does not have, as when a new version depends on another package."""
        (zlib,) = (line for line in self.listed() if line.startswith("zlib1g "))
        refused = self.refused_by_debian([line for line in self.listed() if line != zlib])
        self.assertIn(f"Debian has:  {zlib}\n", refused)

    @staticmethod
    def listed():
        """Name and version of the image's Debian packages, as --locked reads them."""
        lines = IMAGE.with_name("packages.txt").read_text(encoding="utf-8").splitlines()
        return [" ".join(line.split()[:2]) for line in lines]

    def refused_by_debian(self, listed):
        """What debian.sh says about a list that it must refuse."""
        (self.folder / "list").write_text("\n".join(listed) + "\n", encoding="utf-8")
        done = subprocess.run([CHECKOUT / "image_build/debian.sh", "--locked", self.folder / "list", self.folder / "debian"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertFalse((self.folder / "debian" / "debian.tar").exists())
        self.assertIn("--mirror", done.stderr)
        return done.stderr

    @long
    def test_two_signed_builds_are_the_same(self):
        keys = keys_in(self.folder)
        disks = []
        for name in ("a", "b"):
            done = build("--keys", keys, "--out", self.folder / name)
            self.assertEqual(done.returncode, 0, done.stderr)
            disks.append(self.folder / name / IMAGE.name)
        self.assertTrue(filecmp.cmp(*disks, shallow=False))
        for name in ("sbom.json", "licences.tar", "why.txt"):
            self.assertTrue(filecmp.cmp(*(disk.with_name(name) for disk in disks), shallow=False), name)
        kernel = next(disks[0].parent.glob("*.efi"))
        subprocess.run(["sbverify", "--cert", keys / "db.crt", kernel], check=True, capture_output=True)

    def test_reports_wrong_use_in_one_line(self):
        for options, status, words in ((["--keys", "/nowhere"], 1, "db.key"), (["--frimware", "amd"], 2, "--help"),
                                       (["--firmware", "arm"], 2, "amd"), (["--version", "new"], 2, "digit"),
                                       (["--keys"], 2, "value"), (["--data", "big"], 2, "160M"), (["--packages", "/nowhere"], 1, "/nowhere")):
            done = subprocess.run([BUILD, *options], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, status, options)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(words, done.stderr)
