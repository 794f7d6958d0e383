#!/usr/bin/python3
"""Tests the package data that are kept beside the image: made from a package that dpkg-deb packs, and compared with its list.

    provenance_test.py SOURCE    SOURCE: the repository
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
TOOLS = SOURCE / "image_build/contents"
sys.path.insert(0, str(TOOLS))
import dpkg_database  # noqa: E402
from made_image import write  # noqa: E402

CONTROL = """Package: frog
Version: 1:2.0-1+b2
Architecture: amd64
Maintainer: nobody <nobody@frustumscreen.invalid>
Built-Using: glibc (= 2.36-9), pond (= 1~1)
Description: a frog
 that is green
"""


class Provenance(unittest.TestCase):
    def setUp(self):
        self.work = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        tree = self.work / "package"
        write(tree / "DEBIAN/control", CONTROL)
        write(tree / "lib/frog.so", "croak")
        write(tree / "usr/share/doc/frog/copyright", "frogs are free\n")
        (tree / "usr/bin").mkdir()
        (tree / "usr/bin/frog").symlink_to("toad")
        self.deb = self.work / "frog.deb"
        subprocess.run(["dpkg-deb", "--root-owner-group", "-b", tree, self.deb], check=True, capture_output=True)
        self.tree = self.work / "tree"
        subprocess.run([TOOLS / "unpack_deb.sh", self.deb, self.tree], check=True)

    def keep(self, *names):
        write(self.work / "list", "".join(f"{name}  a part of it\n" for name in names))
        return subprocess.run([TOOLS / "keep_provenance.py", self.work / "kept", "--compiled-in", self.work / "list", "--tree",
                               f"debian={self.tree}"], capture_output=True, text=True)

    def test_records_a_package_with_its_files(self):
        listed = subprocess.run(["dpkg-deb", "-c", self.deb], check=True, capture_output=True, text=True).stdout
        names = {line.split()[5].removeprefix("./").rstrip("/") for line in listed.splitlines()} - {"", "lib"}
        self.assertEqual(self.keep().returncode, 0)
        database = dpkg_database.read_kept(self.work / "kept")
        self.assertEqual({path for path in database.owner if path not in (".", "/.", "")}, {dpkg_database.merged(name) for name in names})
        frog = database.packages["frog"]
        self.assertEqual((frog.version, frog.source, frog.source_version), ("1:2.0-1+b2", "frog", "1:2.0-1"))
        self.assertEqual(frog.inside, (("glibc", "2.36-9"), ("pond", "1~1")))
        self.assertEqual(frog.summary, "a frog")

    def test_follows_links_to_copyright_files_inside_the_tree(self):
        doc = self.tree / "usr/share/doc"
        (doc / "toad").symlink_to("frog")
        (doc / "newt").mkdir()
        (doc / "newt/copyright").symlink_to("/etc/passwd")
        self.assertEqual(self.keep().returncode, 0)
        kept = self.work / "kept/debian/usr/share/doc"
        self.assertEqual((kept / "toad/copyright").read_text(), "frogs are free\n")
        self.assertFalse((kept / "newt/copyright").exists())

    def test_compiled_in_packages_must_be_installed(self):
        done = self.keep("libc6", "libfrog-dev")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1))
        self.assertIn("libfrog-dev", done.stderr)
        self.assertEqual(self.keep("libc6").returncode, 0)
        version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "libc6"], check=True, capture_output=True, text=True).stdout
        database = dpkg_database.Database()
        database.add(self.work / "kept/compiled_in")
        self.assertEqual(database.packages["libc6"].version, version)


if __name__ == "__main__":
    unittest.main()
