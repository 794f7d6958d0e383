"""./image_build/build fetches Debian's packages once a day, also for other clones; the program that fetches them is replaced."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECKOUT = pathlib.Path(sys.argv.pop(1))
FETCH = """#!/bin/bash
set -e
folder=${*: -1}
echo "${@:1:$#-1}" >>"$FETCHES"
mkdir -p "$folder/root/bin" "$folder/root/dev"
echo library >"$folder/root/bin/file"
chmod 4755 "$folder/root/bin/file"
ln -s file "$folder/root/bin/link"
echo "zlib1g 1.2 amd64 zlib 1.2" >"$folder/packages.txt"
tar -C "$folder/root" -cf "$folder/debian.tar" .
rm -r "$folder/root"
"""
BUILD = """set -euo pipefail
work=$(mktemp -d -p "$1")
cache=$1 locked=$2 firmware= mirror=$3
. "$STEPS"
umask 022
date() { echo "$TODAY"; }
fetch_debian
rm -r "$work"
echo "$debian"
"""


class DebianCopy(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.copies = self.folder / "home" / ".cache" / "frustumscreen" / "debian"
        self.fetches = self.folder / "fetches"
        self.fetches.touch()
        sources = self.folder / "image_build"
        sources.mkdir()
        (sources / "debian.sh").write_text(FETCH, encoding="utf-8")
        (sources / "debian.sh").chmod(0o755)
        (sources / "packages.conf").write_text("install zlib1g\n", encoding="utf-8")

    def build(self, clone, today="2026-05-01", locked="", mirror=""):
        """The folder with the packages that a build in `clone` uses."""
        (self.folder / clone).mkdir(exist_ok=True)
        environment = {"PATH": os.environ["PATH"], "HOME": str(self.folder / "home"), "FETCHES": str(self.fetches), "TODAY": today,
                       "STEPS": str(CHECKOUT / "image_build" / "steps.sh")}
        done = subprocess.run(["bash", "-c", BUILD, "bash", self.folder / clone, locked, mirror], cwd=self.folder, env=environment,
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        packages = pathlib.Path(done.stdout.strip())
        self.assertEqual(packages.parent, self.folder / clone)
        self.assertEqual((packages / "packages.txt").read_text(encoding="utf-8"), "zlib1g 1.2 amd64 zlib 1.2\n")
        self.assertEqual((packages / "tree" / "bin" / "link").readlink(), pathlib.Path("file"))
        self.assertEqual((packages / "tree" / "bin" / "file").read_text(encoding="utf-8"), "library\n")
        self.assertFalse((packages / "tree" / "dev").exists())
        return packages

    def assert_fetched(self, times):
        self.assertEqual(len(self.fetches.read_text(encoding="utf-8").splitlines()), times)

    def test_another_clone_uses_the_copy(self):
        first, second = self.build("first"), self.build("second")
        self.assert_fetched(1)
        self.assertEqual(first.name, second.name)
        listed = [subprocess.run(["find", ".", "-printf", "%P %M %s %T@ %l\n"], cwd=each / "tree", capture_output=True, text=True,
                                 check=True).stdout.splitlines() for each in (first, second)]
        self.assertEqual(sorted(listed[0])[1:], sorted(listed[1])[1:])  # without the folder itself
        self.build("first")
        self.assert_fetched(1)

    def test_the_next_day_has_its_own_packages(self):
        self.build("first")
        self.build("second", today="2026-05-02")
        self.assert_fetched(2)
        self.assertEqual([copy.name[-18:] for copy in self.copies.iterdir()], ["2026-05-02.tar.zst"])

    def test_replaces_a_damaged_copy(self):
        self.build("first")
        copy, = self.copies.iterdir()
        whole = copy.read_bytes()
        for damaged in (b"", whole[:-20], whole[:40] + b"x" * 20 + whole[60:]):
            copy.write_bytes(damaged)
            self.build(f"clone_{len(damaged)}_{damaged[50:51].hex()}")
        self.assert_fetched(4)
        self.build("last")
        self.assert_fetched(4)

    def test_other_packages_have_their_own_copy(self):
        self.build("first")
        self.build("second", mirror="http://mirror.invalid/")
        (self.folder / "image_build" / "packages.conf").write_text("install zlib1g libc6\n", encoding="utf-8")
        self.build("third")
        self.assert_fetched(3)
        self.assertEqual(len(list(self.copies.iterdir())), 3)

    def test_locked_versions_are_fetched(self):
        locked = self.folder / "packages.txt"
        locked.write_text("zlib1g 1.2 amd64 zlib 1.2\n", encoding="utf-8")
        self.build("first")
        self.build("second", locked=str(locked))
        self.assert_fetched(2)
        self.assertIn("--locked", self.fetches.read_text(encoding="utf-8"))

    def test_without_a_cache_folder_each_clone_fetches(self):
        (self.folder / "home").write_text("a file", encoding="utf-8")
        self.build("first")
        self.build("second")
        self.assert_fetched(2)


if __name__ == "__main__":
    unittest.main()
