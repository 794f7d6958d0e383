#!/usr/bin/python3
"""Tests the list of the image's contents with an artificial image, the schema of CycloneDX, unsquashfs and sha256sum.

    contents_test.py SOURCE    SOURCE: the repository
"""

import hashlib
import json
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE / "image_build/contents"))
import made_image  # noqa: E402
import spdx_list  # noqa: E402

WHY, WRITE = SOURCE / "image_build/why", SOURCE / "image_build/contents/write_bill.py"
NOTE = ("etc/systemd/system/frog.service", "", None)


def compiled_in():
    lines = (SOURCE / "image_build/contents/compiled_in.list").read_text(encoding="utf-8").splitlines()
    return [line.split()[0] for line in lines if line.strip() and not line.startswith("#")]


def call(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)


class Contents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = pathlib.Path(cls.folder.name)
        cls.out = made_image.make(cls.work / "image", compiled_in(), [NOTE])
        cls.why = call(WHY, cls.out)
        written = call(WRITE, cls.out)
        assert written.returncode == 0, written.stderr
        cls.bill = json.loads((cls.out / "sbom.json").read_text(encoding="utf-8"))
        cls.components = {component["name"]: component for component in cls.bill["components"]}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def rows(self, words):
        """(MB unpacked, MB packed, the rest) of each row of the table whose head has these words."""
        self.assertEqual((self.why.returncode, self.why.stderr), (0, ""))
        table = self.why.stdout.partition(words)[2].strip("\n").split("\n\n")[0]
        return [(float(line.split()[0]), float(line.split()[1]), line.split(None, 2)[2]) for line in table.splitlines()]

    def test_every_byte_of_the_image_is_in_the_table(self):
        rows = self.rows("MB packed, what for")
        files = [self.out / "frustumscreen_1.2.slot", self.out / "frustumscreen_1.2.efi"]
        image = sum(path.stat().st_size for path in files) + 3000 + len("timeout 0\n")
        self.assertEqual(rows[-1][2], "all")
        self.assertAlmostEqual(rows[-1][1], image / 1e6, delta=0.006)
        self.assertAlmostEqual(sum(row[1] for row in rows[:-1]), image / 1e6, delta=0.01 * len(rows))

    def test_sorts_by_size_with_reasons(self):
        purposes, packages = self.rows("MB packed, what for"), self.rows("package: reason")
        self.assertEqual(purposes[0], (0.7, 0.7, "our programs and data"))  # noise cannot be compressed
        self.assertEqual(purposes[1], (1.2, 0.3, "graphics: LLVM, by which the processor draws, and what it links"))
        self.assertEqual([row[2] for row in packages][:2], ["frustumscreen 1.0-1: the exhibit",
                                                            "libllvm15 1:15.0.6-4+b1: graphics: the processor draws"])
        self.assertNotIn("perl", self.why.stdout)
        self.assertIn("etc/systemd/system/frog.service: which units run", self.why.stdout)

    def test_counts_duplicate_files_once(self):
        listed = call(WHY, self.out, "--files", "tzdata").stdout.split()
        sizes = [int(number.replace(",", "")) for number in listed if number.replace(",", "").isdigit()]
        self.assertEqual(sizes[::2], [118, 118, 0])
        self.assertEqual(sorted(sizes[1::2], reverse=True)[1:], [0, 0])

    def assert_refused(self, more, *words):
        with tempfile.TemporaryDirectory() as folder:
            done = call(WHY, made_image.make(pathlib.Path(folder) / "image", compiled_in(), [more]))
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            for word in words:
                self.assertIn(word, done.stderr)

    def test_rejects_a_file_without_a_reason(self):
        self.assert_refused(("usr/bin/perl", "x", None), "usr/bin/perl (perl)", "without a reason")

    def test_rejects_a_module_without_a_reason(self):
        self.assert_refused(("usr/lib/modules/6.1/kernel/drivers/net/e1000.ko", "x", None), "e1000.ko", "without a reason")

    def test_rejects_a_package_without_a_purpose(self):
        self.assert_refused(("usr/bin/perl", "x", "to see"), "usr/bin/perl (perl)", "without a purpose")

    def test_wrong_use(self):
        self.assertEqual(call(WHY, "--frog").returncode, 2)
        missing = call(WHY, self.work / "nothing")
        self.assertEqual((missing.returncode, missing.stderr.count("\n")), (1, 1))
        self.assertIn("there is no folder", missing.stderr)
        (self.work / "empty").mkdir()
        self.assertIn("has no frustumscreen_*.slot", call(WHY, self.work / "empty").stderr)

    def test_sbom_matches_the_schema(self):
        self.assertEqual(spdx_list.schema_errors(self.bill), [])
        worse = json.loads(json.dumps(self.bill))
        worse["components"][0]["licenses"] = [{"license": {"id": "Frog-1.0"}}]
        self.assertNotEqual(spdx_list.schema_errors(worse), [])

    def test_sbom_lists_exactly_the_components(self):
        packages = {"frustumscreen", "libllvm15", "libc6", "tzdata", "base-files", "linux-image-6.1", "systemd-boot-efi", "busybox-static"}
        self.assertEqual(set(self.components), packages | set(compiled_in()) | {"frustumscreen-image-settings"})
        llvm = self.components["libllvm15"]
        self.assertEqual(llvm["purl"], "pkg:deb/debian/libllvm15@1:15.0.6-4%2Bb1?arch=amd64&distro=bookworm")
        self.assertEqual([(source["name"], source["version"]) for source in llvm["pedigree"]["ancestors"]], [("llvm-toolchain-15", "1:15.0.6-4")])
        self.assertEqual(llvm["licenses"], [{"expression": "(MIT AND BSD-3-Clause) OR LicenseRef-Debian-Frog"}])
        inside = [part["purl"] for part in self.components["busybox-static"]["components"] if part["type"] == "library"]
        self.assertEqual(inside, ["pkg:deb/debian/glibc@2.36-9?arch=source&distro=bookworm"])
        self.assertEqual(self.components["linux-image-6.1"]["licenses"], [{"license": {"id": "GPL-2.0-only"}}])
        self.assertNotIn("licenses", self.components["libc6"])
        self.assertEqual(self.components["libc6"]["evidence"], {"licenses": [{"license": {"name": "refers to LGPL-2.1"}}]})

    def test_lists_dependencies_that_are_present(self):
        graph = {row["ref"]: row["dependsOn"] for row in self.bill["dependencies"]}
        references = {name: component["bom-ref"] for name, component in self.components.items()}
        self.assertEqual(graph[references["libllvm15"]], [references["libc6"], references["tzdata"]])
        self.assertIn(references["libglm-dev"], graph[references["frustumscreen"]])
        self.assertEqual(set(graph["image"]), set(references.values()))

    def test_each_file_is_listed_with_its_hash(self):
        tree = self.work / "tree"
        subprocess.run(["unsquashfs", "-quiet", "-no-progress", "-dest", tree, self.out / "frustumscreen_1.2.slot"], check=True, capture_output=True)
        there = {str(path.relative_to(tree)): hashlib.sha256(path.read_bytes()).hexdigest()
                 for path in tree.rglob("*") if path.is_file() and not path.is_symlink() and "lib" != path.relative_to(tree).parts[0]}
        listed = {file["name"]: file["hashes"][0]["content"] for component in self.bill["components"]
                  for file in component.get("components", []) if file["type"] == "file"}
        outside = {name for name in listed if name.startswith(("initrd/", "kernel_image/", "boot_partition/"))}
        self.assertEqual({name: listed[name] for name in set(listed) - outside}, there)
        self.assertEqual(outside, {"initrd/init", "initrd/bin/busybox", "initrd/lib/x86_64-linux-gnu/libc.so.6", "kernel_image/.linux",
                                   "kernel_image/.cmdline", "kernel_image/.osrel", "boot_partition/EFI/BOOT/BOOTX64.EFI",
                                   "boot_partition/loader/loader.conf"})
        self.assertIn("initrd/lib/x86_64-linux-gnu/libc.so.6", [file["name"] for file in self.components["libc6"]["components"]])

    def test_contains_each_licence_text_once(self):
        with tarfile.open(self.out / "licences.tar") as tar:
            texts = {name.removeprefix("licences/"): tar.extractfile(name).read().decode() for name in tar.getnames()}
        places = dict(line.split("\t") for line in texts["INDEX"].splitlines())
        self.assertEqual(set(places), set(self.components) - {"frustumscreen-image-settings"})
        for _, name, _, _, text in made_image.PACKAGES:
            if name in places:
                self.assertEqual(texts[places[name]], text)
        self.assertEqual(places["libc6"], places["tzdata"])
        self.assertEqual(len([name for name in texts if name.startswith("packages/")]), len(set(places.values())))
        self.assertEqual({name for name in texts if name.startswith("common-licenses/")}, {"common-licenses/Apache-2.0", "common-licenses/LGPL-2.1"})

    def test_output_is_reproducible(self):
        again = self.work / "again"
        shutil.copytree(self.out, again)
        for name in ("sbom.json", "licences.tar"):
            (again / name).unlink()
        self.assertEqual(call(WRITE, again).returncode, 0)
        for name in ("sbom.json", "licences.tar"):
            self.assertEqual((again / name).read_bytes(), (self.out / name).read_bytes())
        self.assertEqual(self.bill["metadata"]["timestamp"], "2023-11-14T22:13:20Z")


if __name__ == "__main__":
    needed = [tool for tool in made_image.TOOLS if not shutil.which(tool)]
    if needed:
        print(f"skipped: {', '.join(needed)} are not on this machine")
        sys.exit(77)
    unittest.main()
