#!/usr/bin/python3
"""Tests the Debian packages, packed from the existing release build, with dpkg, lintian and the statements of the pages.

    packages_test.py SOURCE    SOURCE: the repository
"""

import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
NAMES = {"frustumscreen", "frustumscreen-base", "frustumscreen-bake"}


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


def pack(folder, umask, zone):
    environment = {**os.environ, "TZ": zone, "LC_ALL": "C"}
    run(SOURCE / "image_build/packages", "--no-build", "--quick", "--out", folder, umask=umask, env=environment)
    return {deb.name.split("_")[0]: deb for deb in pathlib.Path(folder).glob("*.deb")}


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        work = pathlib.Path(cls.folder.name)
        cls.debs = pack(work / "debs", 0o022, "UTC")
        cls.trees = {name: work / "tree" / name for name in cls.debs}
        (work / "tree").mkdir()
        for name, deb in cls.debs.items():
            run("dpkg-deb", "--raw-extract", deb, cls.trees[name])
        cls.files = {name: {"/" + str(path.relative_to(tree)) for path in tree.rglob("*")
                            if not path.is_dir() and path.relative_to(tree).parts[0] != "DEBIAN"}
                     for name, tree in cls.trees.items()}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def field(self, package, name):
        return run("dpkg-deb", "--field", self.debs[package], name).strip()

    def depends(self, package, kind="Depends"):
        return {part.split()[0] for part in self.field(package, kind).split(", ")}

    def test_fields(self):
        self.assertEqual(set(self.debs), NAMES)
        version = run(self.trees["frustumscreen-base"] / "usr/bin/frustumscreen", "--version").split()[-1]
        for name, deb in self.debs.items():
            self.assertEqual(deb.name, f"{name}_{version}_amd64.deb")
            self.assertEqual(self.field(name, "Version"), version)
            self.assertRegex(self.field(name, "Maintainer"), r"^[^<>]+ <[^<>@ ]+@[^<>@ ]+>$")
        for name in ("frustumscreen", "frustumscreen-bake"):
            self.assertIn(f"frustumscreen-base (= {version})", self.field(name, "Depends"))

    def test_depends_on_files_opened_by_name(self):
        # dpkg-shlibdeps does not know these, because the programs' files do not name them.
        self.assertLessEqual({"libegl-mesa0", "libgl1-mesa-dri", "fonts-dejavu-core", "tzdata"}, self.depends("frustumscreen-base"))
        self.assertLessEqual({"systemd", "udev", "mount", "ntfs-3g"}, self.depends("frustumscreen"))
        self.assertIn("fonts-noto-core", self.depends("frustumscreen-bake"))
        self.assertIn("espeak-ng", self.depends("frustumscreen-bake", "Recommends"))

    def test_depends_on_linked_libraries(self):
        linked = {program: set(re.findall(r"NEEDED +(\S+)", run("objdump", "--private-headers", program)))
                  for tree in self.trees.values() for program in (tree / "usr/bin").iterdir()}
        owners = {}
        for line in run("dpkg-query", "--search", *(f"*/{library}" for library in set().union(*linked.values()))).splitlines():
            if not line.startswith("diversion "):
                packages, path = line.split(": ")
                owners.setdefault(pathlib.Path(path).name, set()).update(one.split(":")[0] for one in packages.split(", "))
        for program, libraries in linked.items():
            depends = self.depends(program.parts[-4]) # the package whose tree the program is in
            for library in libraries:
                self.assertTrue(owners[library] & depends, f"{program.name} links {library} of {owners[library]}")

    def test_no_file_is_in_two_packages(self):
        all_files = [file for files in self.files.values() for file in files]
        self.assertEqual(len(all_files), len(set(all_files)))

    def test_files_are_in_allowed_places(self):
        for name, files in self.files.items():
            for file in files:
                self.assertRegex(file, r"^(/usr/(bin|share|lib/(frustumscreen|systemd|udev|sysctl\.d|sysusers\.d|tmpfiles\.d))"
                                       r"|/etc/frustumscreen)/")
                self.assertNotRegex(file, r"mock|fixture|[_-]test|gtest")
            self.assertIn(f"/usr/share/doc/{name}/copyright", files)
            self.assertIn(f"/usr/share/doc/{name}/changelog.gz", files)

    def test_settings_are_never_overwritten(self):
        for name, files in self.files.items():
            conffiles = self.trees[name] / "DEBIAN/conffiles"
            named = set(conffiles.read_text().split()) if conffiles.exists() else set()
            self.assertEqual(named, {file for file in files if file.startswith("/etc/")})

    def test_owner_and_modes(self):
        for deb in self.debs.values():
            for line in run("dpkg-deb", "--contents", deb).splitlines():
                mode, owner = line.split()[:2]
                self.assertEqual(owner, "root/root", line)
                self.assertRegex(mode, r"^(drwxr-xr-x|-rwxr-xr-x|-rw-r--r--)$", line)

    def test_programs_are_stripped_and_contain_no_build_path(self):
        for tree in self.trees.values():
            for path in tree.rglob("*"):
                if path.is_file():
                    self.assertFalse(str(SOURCE).encode() in path.read_bytes(), path)
            for program in (tree / "usr/bin").iterdir():
                self.assertNotIn(".debug_info", run("objdump", "--section-headers", program))

    def test_programs_started_by_units_exist(self):
        """Our files come from our packages, any other file from a dependency or from a package that every Debian has."""
        ours = self.files["frustumscreen"] | self.files["frustumscreen-base"]
        units = self.trees["frustumscreen"] / "usr/lib/systemd/system"
        started = {program for unit in units.glob("*.service")
                   for program in re.findall(r"^Exec\w+=[-+!@:]*(/\S+)", unit.read_text(), re.MULTILINE)}
        self.assertGreater(len(started), 5)
        owners = {"/bin/sh": None, "/usr/bin/install": None, "/usr/bin/systemd-mount": "systemd", "/usr/bin/systemd-umount": "systemd",
                  "/usr/bin/mount": "mount", "/usr/bin/umount": "mount", "/usr/bin/ntfs-3g": "ntfs-3g"}
        for program in started - ours:
            self.assertIn(program, owners)
            self.assertIn(owners[program], {None} | self.depends("frustumscreen"), program)

    def test_programs_of_the_curators_page_exist(self):
        page = (SOURCE / "docs/curators.md").read_text()
        named = set(re.findall(r"^(frustumscreen(?:-[a-z]+)?) ", page, re.MULTILINE))
        self.assertGreater(len(named), 5)
        there = self.files["frustumscreen-bake"] | self.files["frustumscreen-base"]
        for program in named:
            self.assertIn(f"/usr/bin/{program}", there)

    def test_pages_of_the_manual(self):
        for name, tree in self.trees.items():
            for program in (tree / "usr/bin").iterdir():
                manual = tree / f"usr/share/man/man1/{program.name}.1.gz"
                self.assertTrue(manual.exists(), manual)
                if shutil.which("man"):
                    said = run("man", "--warnings", "--local-file", manual, env={**os.environ, "MANWIDTH": "80"})
                    self.assertIn(program.name, said)

    def test_no_unit_is_enabled(self):
        self.assertFalse([file for file in self.files["frustumscreen"] if ".wants/" in file])

    def script(self, name, *arguments):
        """The requests of a dpkg script to a running systemd. Each program is a stub that records its arguments."""
        stubs = pathlib.Path(self.folder.name) / "stubs"
        stubs.mkdir(exist_ok=True)
        for stub in ("systemctl", "deb-systemd-helper", "deb-systemd-invoke", "udevadm", "systemd-sysusers", "systemd-tmpfiles"):
            (stubs / stub).write_text(f'#!/bin/sh\necho "{stub} $*" >>"$ASKED"\n')
            (stubs / stub).chmod(0o755)
        asked = stubs / "asked"
        asked.write_text("")
        namespace = ["unshare", "--map-root-user", "--mount"]
        possible = subprocess.run([*namespace, "mount", "-t", "tmpfs", "none", "/run"], capture_output=True, text=True)
        if possible.returncode != 0:
            self.skipTest(f"no namespaces here: {possible.stderr}")
        inside = 'mount -t tmpfs none /run && mkdir -p /run/systemd/system && exec "$@"'
        environment = {**os.environ, "PATH": f"{stubs}:{os.environ['PATH']}", "ASKED": str(asked)}
        done = subprocess.run([*namespace, "sh", "-c", inside, "sh",
                               self.trees["frustumscreen"] / "DEBIAN" / name, *arguments],
                              capture_output=True, text=True, env=environment)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return asked.read_text().splitlines()

    def test_an_installation_starts_nothing(self):
        asked = self.script("postinst", "configure", "")
        self.assertIn("systemd-sysusers frustumscreen.conf", asked)
        self.assertIn("systemctl --system daemon-reload", asked)
        self.assertLess(asked.index("systemd-sysusers frustumscreen.conf"),
                        asked.index("systemd-tmpfiles --create frustumscreen.conf"))
        self.assertFalse([line for line in asked if line.startswith("deb-systemd-invoke")])

    def test_an_update_restarts_running_units(self):
        asked = [line for line in self.script("postinst", "configure", "0.0.1") if line.startswith("deb-systemd-invoke")]
        self.assertEqual(asked, [f"deb-systemd-invoke try-restart {unit}.service"
                                 for unit in ("frustumscreen-watchdog", "frustumscreen", "frustumscreen-safe")])

    def test_a_removal_first_stops_units_that_restart_the_exhibit(self):
        asked = self.script("prerm", "remove")
        stopped = [unit for line in asked if line.startswith("deb-systemd-invoke stop") for unit in line.split()[2:]]
        # The calibration's end brings the exhibit and its watchdog back, and the watchdog the exhibit.
        self.assertEqual(stopped[:3], ["frustumscreen-calibrate.path", "frustumscreen-calibrate.service", "frustumscreen-watchdog.service"])
        self.assertIn("frustumscreen.service", stopped[3:])
        self.assertEqual(asked[-1], "deb-systemd-invoke start getty@tty1.service")
        self.assertEqual(self.script("prerm", "upgrade", "0.2"), [])

    def test_packages_are_reproducible(self):
        """The packages are the same when packed with another umask and another time zone."""
        again = pack(pathlib.Path(self.folder.name) / "again", 0o077, "Pacific/Auckland")
        for name, deb in self.debs.items():
            self.assertEqual(*(hashlib.sha256(path.read_bytes()).hexdigest() for path in (deb, again[name])), name)

    def test_lintian(self):
        if not shutil.which("lintian"):
            self.skipTest("lintian is not installed: ./setup.sh tests")
        with tempfile.TemporaryDirectory() as folder: # lintian leaves files in it
            done = subprocess.run(["lintian", "--allow-root", *map(str, self.debs.values())], capture_output=True, text=True,
                                  env={**os.environ, "TMPDIR": folder})
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    if not shutil.which("dpkg-shlibdeps"):
        print("dpkg-shlibdeps is not installed: ./setup.sh packages")
        sys.exit(77)
    unittest.main(verbosity=2)
