"""Repeats the runs of the emulated machines and of continuous integration as a whole, and remembers those that passed.

A run of continuous integration contains one of each emulated machine. Machines are remembered as long as the files on which they depend
are the same, continuous integration as long as all files are.
"""

import hashlib
import subprocess
import time

ALL = (".",)
OF_MACHINES = (".", ":(exclude)*.md", ":(exclude)docs", ":(exclude,glob)tests/**/*_test.cpp")
MACHINES = {"hil": ["./test", "hil"], "image": ["./test", "image"]}


def state(root, paths):
    """A name for the contents of these files in the working tree; of files that are not in git's index, their names count."""
    git = [subprocess.run(["git", *command, "--", *paths], cwd=root, capture_output=True, check=True).stdout
           for command in (("ls-files", "--stage"), ("diff",), ("ls-files", "--others", "--exclude-standard"))]
    return hashlib.sha256(b"\0".join(git)).hexdigest()[:12]


class Runs:
    """The runs that passed with one state of the files, one a line in a file, and the outputs of those that failed."""

    def __init__(self, root, folder):
        self._root, self._folder = root, folder
        folder.mkdir(parents=True, exist_ok=True)
        self._file = folder / "passed.txt"
        self.failed = []

    def passed(self, name):
        return self._file.read_text(encoding="utf-8").splitlines().count(name) if self._file.exists() else 0

    def remember(self, name):
        with open(self._file, "a", encoding="utf-8") as file:
            file.write(f"{name}\n")

    def make(self, name, command):
        """Whether this run passed."""
        begun = time.monotonic()
        ran = subprocess.run(command, cwd=self._root, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        print(f"   {name}: {'passed' if ran.returncode == 0 else 'FAILED'} in {time.monotonic() - begun:.0f} s", flush=True)
        if ran.returncode == 0:
            self.remember(name)
            return True
        self.failed.append(name)
        log = self._folder / f"{name}_{self.failed.count(name)}.log"
        log.write_bytes(ran.stdout)
        print(f"   its output is in {log}", flush=True)
        return False


def repeat(root, folder, boots, times):
    """Runs continuous integration until it has passed `times` times, and the emulated machines `boots` times, each unless one fails;
    returns the names of the runs that failed."""
    whole, machines = (Runs(root, folder / state(root, paths)) for paths in (ALL, OF_MACHINES))
    for _ in range(times - whole.passed("ci")):
        if whole.make("ci", [".ci/run"]):
            for name in MACHINES:
                machines.remember(name)
    for name, command in MACHINES.items():
        for _ in range(boots - machines.passed(name)):
            machines.make(name, command)
    return whole.failed + machines.failed
