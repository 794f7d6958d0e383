#!/usr/bin/python3
"""Compares the bill of materials of the built image with the image itself, which other programs unpack.

    real_image_test.py SOURCE [IMAGE-FOLDER]    default: out/image of the repository, or out/image/test; without an image there,
                                                nothing is tested
"""

import hashlib
import json
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import unittest

import spdx_list

SOURCE = pathlib.Path(sys.argv[1]).resolve()
OUT = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else SOURCE / "out/image"
if len(sys.argv) == 2 and not (OUT / "sbom.json").exists():
    OUT = OUT / "test"
MADE = "frustumscreen-image-settings"


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True).stdout


class RealImage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = pathlib.Path(cls.folder.name)
        cls.root = cls.work / "root"
        (slot,) = OUT.glob("frustumscreen_*.slot")
        (cls.kernel_image,) = OUT.glob("frustumscreen_*.efi")
        run("unsquashfs", "-quiet", "-no-progress", "-dest", cls.root, slot)
        cls.bill = json.loads((OUT / "sbom.json").read_text(encoding="utf-8"))
        cls.listed = {file["name"]: (component["name"], file["hashes"][0]["content"]) for component in cls.bill["components"]
                      for file in component.get("components", []) if file["type"] == "file"}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_each_file_belongs_to_a_component(self):
        there = {str(path.relative_to(self.root)): path for path in self.root.rglob("*") if path.is_file() and not path.is_symlink()}
        inside = {name for name in self.listed if not name.startswith(("initrd/", "kernel_image/", "boot_partition/"))}
        self.assertEqual(set(there), inside)
        programs = 0
        for name, path in there.items():
            data = path.read_bytes()
            component, digest = self.listed[name]
            self.assertEqual(hashlib.sha256(data).hexdigest(), digest, name)
            if data[:4] == b"\x7fELF":
                programs += 1
                self.assertNotEqual(component, MADE, f"{name} is a program that no package has")
        self.assertGreater(programs, 200)

    def test_the_initrd_belongs_to_components(self):
        run("objcopy", "-O", "binary", "--only-section=.initrd", self.kernel_image, self.work / "initrd.zst")
        (self.work / "initrd").write_bytes(run("zstd", "-dcq", self.work / "initrd.zst"))
        with open(self.work / "initrd", "rb") as archive:
            names = subprocess.run(["cpio", "--quiet", "-it"], stdin=archive, check=True, capture_output=True, text=True).stdout.split()
            archive.seek(0)
            (self.work / "tree").mkdir()
            subprocess.run(["cpio", "--quiet", "-id"], stdin=archive, cwd=self.work / "tree", check=True, capture_output=True)
        for name in names:
            path = self.work / "tree" / name
            if path.is_file() and not path.is_symlink():
                component, digest = self.listed[f"initrd/{name}"]
                data = path.read_bytes()
                self.assertEqual(hashlib.sha256(data).hexdigest(), digest, name)
                if data[:4] == b"\x7fELF":
                    self.assertNotEqual(component, MADE, name)

    def test_versions_match_the_package_list(self):
        taken = {line.split()[0]: line.split()[1] for line in (OUT / "packages.txt").read_text().splitlines()}
        debian = {component["name"]: component["version"] for component in self.bill["components"]
                  if component.get("purl", "").startswith("pkg:deb/") and component.get("components")}
        self.assertGreater(len(debian), 50)
        self.assertEqual({name: taken.get(name) for name in debian}, debian)

    def test_each_component_has_its_licence_text(self):
        with tarfile.open(OUT / "licences.tar") as tar:
            texts = {name.removeprefix("licences/"): tar.extractfile(name).read() for name in tar.getnames()}
        for component in self.bill["components"]:
            if component["name"] != MADE:
                (place,) = [row["value"] for row in component["properties"] if row["name"] == "frustumscreen:licence_text"]
                self.assertGreater(len(texts[place]), 100, component["name"])

    def test_licence_expressions_are_known_to_spdx(self):
        for component in self.bill["components"]:
            for licence in component.get("licenses", []):
                text = licence.get("expression") or licence["license"]["id"]
                self.assertEqual(spdx_list.unknown_of(text), [], component["name"])

    def test_sbom_matches_the_schema(self):
        self.assertEqual(spdx_list.schema_errors(self.bill), [])


if __name__ == "__main__":
    if not (OUT / "sbom.json").exists():
        print("skipped: there is no image in out/image; ./image_build/build makes one, in minutes")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
