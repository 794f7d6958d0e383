"""Runs each test of ctest until it has passed a number of times with the same inputs. A record for each test keeps its inputs and the
number of runs that passed."""

import contextlib
import dataclasses
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time

import inputs


@dataclasses.dataclass
class Test:
    name: str
    command: list  # words, in which '$root' and '$build' stand for these folders
    labels: list


@dataclasses.dataclass
class Record:
    """`files`: name -> [way, digest], from inputs.Digests. `commit`: the repository's state, if the files are not all inputs; else None."""

    command: list
    files: dict
    commit: str | None
    only_computes: bool
    passed: int = 0  # runs that passed with these inputs
    completed: bool = False  # it has once passed all runs, perhaps with other inputs
    seconds: float = 0.0  # time of the last run


def tests_of(places):
    listed = subprocess.run(["ctest", "--test-dir", places.build, "--show-only=json-v1"], capture_output=True, check=True)
    for test in json.loads(listed.stdout)["tests"]:
        properties = {entry["name"]: entry["value"] for entry in test["properties"]}
        words = test["command"] + properties.get("ENVIRONMENT", [])
        yield Test(test["name"], [word.replace(places.build, "$build").replace(places.root, "$root") for word in words],
                   properties.get("LABELS", []))


class Hunt:
    """`folder`: the records' folder. `commit`: a name for the repository's state. `sanitizer`: the environment for a build with a
    sanitizer. Such a build cannot run under strace, so its records are valid for one commit only."""

    def __init__(self, places, folder, commit, times, sanitizer=None):
        self._places, self._folder, self._commit, self._times = places, pathlib.Path(folder), commit, times
        self._sanitizer = sanitizer
        self._folder.mkdir(parents=True, exist_ok=True)
        self._digests = inputs.Digests(places)
        self._lock = threading.Lock()
        self._ended = threading.Event()
        self._running = set()
        self.failed = []
        self.untraced = []  # tests whose records are valid for this commit only
        self.only_compute = []  # tests whose trace shows that they only compute

    def end(self):
        """Lets no further run begin, and stops those that have begun."""
        with self._lock:
            self._ended.set()
            for process in self._running:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGTERM)

    def waiting(self, tests):
        """The tests that still have to run: first those that have never passed all their runs, and of these first those with threads."""
        found = []
        for test in tests:
            record = self._read(test)
            if record and not self._changed(record, test):
                if record.only_computes:
                    self.only_compute.append(test.name)
                    continue
                if record.passed >= self._times:
                    continue
            found.append((record is not None and record.completed, "threads" not in test.labels, len(found), test))
        return [test for *_, test in sorted(found)]

    def make(self, test):
        if self._ended.is_set():
            return
        record = self._read(test)
        changed = self._changed(record, test) if record else None
        if record is None or changed:
            if changed:
                self._say(f"{test.name}: anew, {changed} is not the same")
            record = self._traced(test, record is not None and record.completed)
            if self._ended.is_set():
                return
            self._write(test, record)
        if record.only_computes:
            self.only_compute.append(test.name)
            return
        while record.passed < self._times:
            if self._ended.is_set():
                return
            output = self._run(test, record)
            if self._ended.is_set():
                return
            record.passed = 0 if output else record.passed + 1
            record.completed = record.passed >= self._times or (record.completed and not output)
            self._write(test, record)
            if output:
                self.failed.append(test.name)
                self._say(f"{test.name}: FAILED in {record.seconds:.0f} s, its output is in {self._keep(test.name, output)}")
                return
        self._say(f"{test.name}: passed {record.passed} times, the last in {record.seconds:.0f} s")

    def _changed(self, record, test):
        if record.command != test.command:
            return "its command"
        if record.commit not in (None, self._commit):
            return "the repository"
        return self._digests.changed(record.files)

    def _traced(self, test, completed):
        """A new record, from a run under strace. This run does not count, because strace makes everything slower."""
        if self._sanitizer is not None:
            return Record(test.command, {}, self._commit, False, completed=completed)
        with tempfile.TemporaryDirectory(prefix="flakes.") as folder:
            file = pathlib.Path(folder, "trace")
            record = Record(test.command, {}, self._commit, False, completed=completed)
            output = self._run(test, record, " ".join([*inputs.STRACE, "-o", os.fspath(file)]))
            if self._ended.is_set():
                return record
            if output or not file.exists():  # it may use strace itself
                self.untraced.append(test.name)
                why = f"its output under strace is in {self._keep(test.name + ' traced', output)}" if output else "it has no trace"
                self._say(f"{test.name}: remembered for this commit only, {why}")
                return record
            with open(file, encoding="utf-8", errors="replace") as lines:
                trace = inputs.Trace(lines, self._places)
        trace.used.setdefault(self._places.path(test.command[0].replace("$root/", "")), inputs.READ)  # the script that started it
        record.files = self._digests.of_all({self._places.name(path): way for path, way in trace.used.items()})
        record.only_computes = inputs.only_computes(trace, self._places)
        if not trace.asks_git:
            record.commit = None
        return record

    def _run(self, test, record, under=None):
        """The output of a run that failed; empty if it passed."""
        environment = dict(os.environ, **(self._sanitizer or {}), **({"FRUSTUMSCREEN_UNDER": under} if under else {}))
        begun = time.monotonic()
        command = ["ctest", "--test-dir", self._places.build, "--tests-regex", f"^{test.name}$", "--no-tests=error", "--output-on-failure"]
        # A folder of its own, because ctest kills a test that is stopped before the test can remove its own.
        with tempfile.TemporaryDirectory(prefix="f.", ignore_cleanup_errors=True) as folder:
            os.chmod(folder, 0o1777)  # some tests act as another user
            with self._lock:
                if self._ended.is_set():
                    return b"it was not run\n"
                # Its own session: where Linux groups processes by session (sched(7), autogroup), each test gets the share of one loop.
                process = subprocess.Popen(command, env={**environment, "TMPDIR": folder}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                           start_new_session=True)
                self._running.add(process)
            with process:
                output = process.stdout.read()
        with self._lock:
            self._running.remove(process)
        record.seconds = round(time.monotonic() - begun, 1)
        return (output or b"it printed nothing\n") if process.returncode else b""

    def _file(self, test):
        return self._folder / f"{test.name}.json"

    def _read(self, test):
        return Record(**json.loads(self._file(test).read_text(encoding="utf-8"))) if self._file(test).exists() else None

    def _write(self, test, record):
        new = self._file(test).with_suffix(".new")
        new.write_text(json.dumps(dataclasses.asdict(record), indent=1), encoding="utf-8")
        new.replace(self._file(test))  # if the hunt is ended before this, the old record stays

    def _keep(self, name, output):
        log = self._folder / f"{name.replace(' ', '_')}.log"
        log.write_bytes(output)
        return log

    def _say(self, text):
        with self._lock:
            print(f"   {text}", flush=True)
