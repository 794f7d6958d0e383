#!/usr/bin/python3
"""Runs clang-tidy over the C++ files; `./test tidy` calls this.

Sources that compile as one file are analysed as one file. A file without findings is not analysed again as long as its preprocessed text,
the checks and clang-tidy stay the same; a record in the user's cache folder serves all clones. Exit status 1: there are findings.
"""

import argparse
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = "clang-tidy-16"  # of Debian 12; 14 does not know C++20's captured bindings
CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "frustumscreen" / "tidy"
COMMITS = 20  # the change that --changed looks at
MAX_INCLUDERS = 20  # of a changed header, with --changed
# Left out in tests: their pictures are too small to overflow an int, and the cell k of a grid is (k % columns, k / columns).
NOT_IN_TESTS = "-bugprone-integer-division,-bugprone-misplaced-widening-cast"
PROGRESS = 50  # files between two lines of progress


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT).stdout


def units(build):
    """Two maps, without generated files: compiled file -> its command; source -> the compiled file that is or includes it."""
    commands, unit_of = {}, {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        file = pathlib.Path(entry["file"])
        if file.parent == build / "together":
            sources = [(ROOT / name).resolve() for name in re.findall(r'^#include "(.*)"$', file.read_text(encoding="utf-8"), re.MULTILINE)]
        elif build not in file.parents and file.suffix == ".cpp":
            sources = [file]
        else:
            continue
        commands[file] = entry
        unit_of.update(dict.fromkeys(sources, file))
    return commands, unit_of


def touched(files):
    """The sources that the last commits and the working tree change, and for each changed header some sources that include it."""
    base = output_of("git", "rev-list", f"--max-count={COMMITS + 1}", "HEAD").split()[-1]
    changed = {ROOT / name for name in output_of("git", "diff", "--name-only", "--diff-filter=d", base).splitlines()}
    names = output_of("git", "grep", "--extended-regexp", r'^#include "', "--", "*.cpp").splitlines()
    includers = {}
    for line in names:
        source, include = line.split(":", 1)
        includers.setdefault(ROOT / include.split('"')[1], []).append(ROOT / source)
    chosen = {file for file in changed if file in files}
    left_out = 0
    for header in sorted(changed):
        using = [file for file in includers.get(header, []) if file in files and file not in chosen]
        chosen.update(using[:MAX_INCLUDERS])
        left_out += len(using[MAX_INCLUDERS:])
    if left_out:
        print(f"   {left_out} includers of changed headers are left out; ./test tidy looks at all", flush=True)
    return sorted(chosen)


class Analysis:
    def __init__(self, build, commands, unit_of):
        self._build, self._commands = build, commands
        self._tests = {unit for source, unit in unit_of.items() if ROOT / "tests" in source.parents}
        checks = (ROOT / ".clang-tidy").read_bytes()
        self._salt = checks + output_of(TOOL, "--version").encode()

    def _key(self, file):
        """The hash of checks, clang-tidy's version and the preprocessed text, without line numbers. Comments count: some name an argument,
        and some switch a check off."""
        words = shlex.split(self._commands[file]["command"])
        compiler = next(k for k, word in enumerate(words) if re.search(r"(\+\+|cc)(-\d+)?$", word))
        end = words.index("-o")
        text = subprocess.run([*words[compiler:end], "-E", "-P", "-C", file], capture_output=True, check=True, cwd=self._build).stdout
        salt = self._salt + NOT_IN_TESTS.encode() if file in self._tests else self._salt
        return hashlib.sha256(salt + text.replace(os.fsencode(ROOT), b"")).hexdigest()

    def run(self, file):
        """clang-tidy's findings in a file; empty if there are none; None if an earlier analysis of the same text had none."""
        clean = CACHE / self._key(file)
        if clean.exists():
            return None
        command = [TOOL, "-p", self._build, "--quiet", "--extra-arg=-Wno-unknown-warning-option",
                   *([f"--checks={NOT_IN_TESTS}"] if file in self._tests else []), file]
        ran = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
        if ran.returncode == 0:
            clean.touch()
            return ""
        return ran.stdout or ran.stderr


def main():
    parser = argparse.ArgumentParser(prog="./test tidy", description=__doc__)
    parser.add_argument("--changed", action="store_true", help=f"only files that the last {COMMITS} commits and the working tree change")
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count(), help="files at a time (default: the number of processors)")
    parser.add_argument("files", metavar="FILE", nargs="*", type=pathlib.Path, help="only these")
    arguments = parser.parse_args()

    build = ROOT / "build" / "tidy"  # configured, not built
    commands, unit_of = units(build)
    sources = [file.resolve() for file in arguments.files] or (touched(unit_of) if arguments.changed else list(unit_of))
    for source in sources:
        if source not in unit_of:
            parser.error(f"{source} is no C++ file that the build compiles")
    files = sorted({unit_of[source] for source in sources})
    CACHE.mkdir(parents=True, exist_ok=True)
    analysis = Analysis(build, commands, unit_of)
    said, known = set(), 0
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for number, found in enumerate(pool.map(analysis.run, files), 1):
            known += found is None
            for finding in re.split(r"\n(?=/\S+:\d+:\d+: )", (found or "").strip()):
                if finding and finding not in said:  # each file that includes a header repeats its findings
                    said.add(finding)
                    print(finding, flush=True)
            if number % PROGRESS == 0:
                print(f"   {number} of {len(files)} files", flush=True)
    print(f"== clang-tidy: {len(sources)} sources in {len(files)} files, {known} of them known to be clean, {len(said)} findings")
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main())
