#!/usr/bin/python3
"""Tests what a hunt for flaky tests remembers, with artificial tests in an artificial repository; these tests count their own runs."""

import contextlib
import io
import json
import os
import pathlib
import subprocess
import tempfile
import threading
import time
import unittest
import unittest.mock

import hunt
import inputs
import whole

RUN_TEST = pathlib.Path(__file__).resolve().parents[1] / "house" / "run_test.sh"
TIMES = 3


class MadeUpRepository(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name, "repository")
        self.counted = pathlib.Path(folder.name, "counted")
        self.build = self.root / "build" / "release"
        for each in (self.build / "tests", self.counted):
            each.mkdir(parents=True)
        self.places = inputs.Places(self.root, self.build, self.root.parent / "shared", self.root.parent / "git")
        self.listed = []
        without_times = unittest.mock.patch.dict("os.environ")
        without_times.start()
        self.addCleanup(without_times.stop)
        os.environ.pop("FRUSTUMSCREEN_TIMES", None)  # artificial tests are not listed among the slowest

    def add(self, name, *command, labels=""):
        words = " ".join(f'"{word}"' for word in [RUN_TEST, name, *command])
        self.listed.append(f'add_test({name} {words})\nset_tests_properties({name} PROPERTIES LABELS "{labels}")\n')
        (self.build / "CTestTestfile.cmake").write_text("".join(self.listed), encoding="utf-8")

    def add_script(self, name, text, labels=""):
        """A script that writes a line for each of its runs."""
        script = self.root / f"{name}.sh"
        script.write_text(f"echo run >>{self.counted / name}\ncd {self.root}\n{text}\n", encoding="utf-8")
        self.add(name, "/bin/sh", script, labels=labels)

    def runs(self, name):
        file = self.counted / name
        return len(file.read_text(encoding="utf-8").splitlines()) if file.exists() else 0

    def hunt(self, times=TIMES, commit="first", sanitizer=None):
        made = hunt.Hunt(self.places, self.root / "out" / "flakes", commit, times, sanitizer)
        with contextlib.redirect_stdout(io.StringIO()):
            for test in made.waiting(hunt.tests_of(self.places)):
                made.make(test)
        return made

    def new_runs(self, names, **options):
        before = [self.runs(name) for name in names]
        self.hunt(**options)
        return [self.runs(name) - count for name, count in zip(names, before)]


class Remembered(MadeUpRepository):
    def setUp(self):
        super().setUp()
        for name in ("one", "two"):
            (self.root / f"{name}.txt").write_text(name, encoding="utf-8")
            self.add_script(name, f"cat {name}.txt")

    def test_reruns_only_tests_that_read_a_changed_file(self):
        self.assertEqual(self.new_runs(["one", "two"]), [1 + TIMES, 1 + TIMES])  # one under strace
        self.assertEqual(self.new_runs(["one", "two"]), [0, 0])
        (self.root / "one.txt").write_text("other", encoding="utf-8")
        self.assertEqual(self.new_runs(["one", "two"], commit="second"), [1 + TIMES, 0])
        self.assertEqual(self.new_runs(["one", "two"], commit="third"), [0, 0])

    def test_a_changed_script_runs_again(self):
        self.hunt()
        with open(self.root / "two.sh", "a", encoding="utf-8") as script:
            script.write("true\n")
        self.assertEqual(self.new_runs(["one", "two"]), [0, 1 + TIMES])

    def test_each_run_counts(self):
        self.hunt(times=2)
        self.assertEqual(self.new_runs(["one", "two"], times=5), [3, 3])

    def test_an_ended_hunt_begins_no_run(self):
        ended = hunt.Hunt(self.places, self.root / "out" / "flakes", "first", TIMES)
        ended.end()
        for test in ended.waiting(hunt.tests_of(self.places)):
            ended.make(test)
        self.assertEqual(self.runs("one"), 0)

    def test_an_ended_hunt_stops_its_runs(self):
        temporary = self.root.parent / "temporary"
        temporary.mkdir()
        self.enterContext(unittest.mock.patch.object(tempfile, "tempdir", str(temporary)))
        self.add_script("long", f"echo $$ >{self.counted}/shell; exec sleep 1000")
        ended = hunt.Hunt(self.places, self.root / "out" / "flakes", "first", TIMES)
        long = [test for test in hunt.tests_of(self.places) if test.name == "long"]
        thread = threading.Thread(target=ended.make, args=long)
        thread.start()
        shell = self.counted / "shell"
        while not shell.exists() or not shell.read_text(encoding="utf-8"):
            time.sleep(0.01)
        ended.end()
        thread.join()
        self.assertEqual(ended.failed, [])
        while pathlib.Path("/proc", shell.read_text(encoding="utf-8").strip()).exists():
            time.sleep(0.01)
        self.assertEqual(list(temporary.iterdir()), [])
        self.assertFalse((self.root / "out" / "flakes" / "long.json").exists())


class Failures(MadeUpRepository):
    def test_counts_a_failed_test_from_zero(self):
        self.add_script("flaky", f"[ $(wc -l <{self.counted}/flaky) -ne 3 ] || {{ echo the third; exit 1; }}")
        self.assertEqual(self.hunt().failed, ["flaky"])
        self.assertEqual(self.runs("flaky"), 3)
        self.assertIn("the third", (self.root / "out" / "flakes" / "flaky.log").read_text(encoding="utf-8"))
        self.assertEqual(self.new_runs(["flaky"]), [TIMES])

    def test_remembers_untraceable_tests_by_commit(self):
        self.add_script("traces", "strace -o /dev/null true")
        self.assertEqual(self.hunt().untraced, ["traces"])
        self.assertEqual(self.new_runs(["traces"]), [0])
        self.assertEqual(self.new_runs(["traces"], commit="second"), [1 + TIMES])

    def test_remembers_sanitized_tests_by_commit(self):
        self.add_script("sanitized", 'test "$OPTIONS" = halt && test -z "$FRUSTUMSCREEN_UNDER"')
        self.assertEqual(self.hunt(sanitizer={"OPTIONS": "other"}).failed, ["sanitized"])
        self.assertEqual(self.new_runs(["sanitized"], sanitizer={"OPTIONS": "halt"}), [TIMES])
        self.assertEqual(self.new_runs(["sanitized"], sanitizer={"OPTIONS": "halt"}), [0])
        self.assertEqual(self.new_runs(["sanitized"], sanitizer={"OPTIONS": "halt"}, commit="second"), [TIMES])

    def test_remembers_tests_that_use_git_by_commit(self):
        (self.root.parent / "git").mkdir()
        (self.root.parent / "git" / "index").touch()
        self.add_script("asks", "cat ../git/index")
        self.hunt()
        self.assertEqual(self.new_runs(["asks"]), [0])
        self.assertEqual(self.new_runs(["asks"], commit="second"), [1 + TIMES])


class Order(MadeUpRepository):
    def test_runs_new_and_threaded_tests_first(self):
        self.add_script("old", "cat data.txt", labels="threads")
        (self.root / "data.txt").touch()
        self.hunt()
        (self.root / "data.txt").write_text("other", encoding="utf-8")
        self.add_script("new", "true")
        self.add_script("new_threads", "true", labels="outside;threads")
        waiting = hunt.Hunt(self.places, self.root / "out" / "flakes", "first", TIMES).waiting(hunt.tests_of(self.places))
        self.assertEqual([test.name for test in waiting], ["new_threads", "new", "old"])


class Traces(MadeUpRepository):
    def used(self, *lines):
        trace = inputs.Trace([line.replace("ROOT", str(self.root)) for line in lines], self.places)
        return {self.places.name(path): way for path, way in trace.used.items()}, trace

    def test_finds_how_paths_were_used(self):
        used, trace = self.used(
            '7 execve("ROOT/build/release/tests/a", ["a"], 0x7ffc /* 9 vars */) = 0',
            '7 openat(AT_FDCWD</>, "/etc/ld.so.cache", O_RDONLY|O_CLOEXEC) = 3</etc/ld.so.cache>',
            '7 openat(AT_FDCWD<ROOT>, "link.txt", O_RDONLY <unfinished ...>',
            '8 newfstatat(AT_FDCWD<ROOT/docs>, "page.md", {st_mode=S_IFREG|0644, st_size=1, ...}, 0) = 0',
            '7 <... openat resumed>) = 3<ROOT/data.txt>',
            '7 openat(3<ROOT/config>, "none.toml", O_RDONLY) = -1 ENOENT (No such file or directory)',
            '7 openat(AT_FDCWD<ROOT>, "made.txt", O_WRONLY|O_CREAT, 0666) = 4<ROOT/made.txt>',
            '7 openat(AT_FDCWD<ROOT>, "made.txt", O_RDONLY) = 4<ROOT/made.txt>',
            '7 openat(AT_FDCWD<ROOT>, "out/hil/log", O_RDONLY) = 4<ROOT/out/hil/log>',
            '7 openat(AT_FDCWD<ROOT>, "__pycache__/day.cpython-311.pyc", O_RDONLY) = 4<ROOT/__pycache__/day.cpython-311.pyc>')
        self.assertEqual(used, {"build/release/tests/a": inputs.RAN, "data.txt": inputs.READ, "docs/page.md": inputs.SEEN,
                                "config/none.toml": inputs.SEEN, "day.py": inputs.READ})
        self.assertIsNone(trace.timing)
        self.assertFalse(trace.asks_git)

    def test_resolves_a_program_relative_to_its_folder(self):
        used, trace = self.used('7 execve("/usr/bin/sh", ["sh"], 0x7ffc /* 9 vars */) = 0',
                                '7 execve("./b", ["b"], 0x7ffc /* 9 vars */) = 0',
                                '7 openat(AT_FDCWD<ROOT/bin>, "/etc/ld.so.cache", O_RDONLY) = 3</etc/ld.so.cache>')
        self.assertEqual(used, {"bin/b": inputs.RAN})
        self.assertEqual(trace.timing, "execve")

    def test_decodes_escaped_names(self):
        used, _ = self.used('7 openat(AT_FDCWD<ROOT>, "h\\303\\266he.txt", O_RDONLY) = 3<ROOT/h\\303\\266he.txt>')
        self.assertEqual(used, {"höhe.txt": inputs.READ})

    def test_detects_changed_contents(self):
        ways = {"folder": inputs.READ, "later": inputs.SEEN, "data": inputs.READ, "looked_at": inputs.SEEN}
        (self.root / "folder").mkdir()
        (self.root / "data").write_text("a", encoding="utf-8")
        (self.root / "looked_at").write_text("a", encoding="utf-8")
        files = inputs.Digests(self.places).of_all(ways)
        (self.root / "looked_at").write_text("b", encoding="utf-8")
        self.assertIsNone(inputs.Digests(self.places).changed(files))
        for change, name in ((self.root / "folder" / "new", "folder"), (self.root / "later", "later"), (self.root / "data", "data")):
            files = inputs.Digests(self.places).of_all(ways)
            change.write_text("b", encoding="utf-8")
            self.assertEqual(inputs.Digests(self.places).changed(files), name)


class Programs(MadeUpRepository):
    def compile(self, name, text):
        source, program = self.root / f"{name}.cpp", self.build / "tests" / name
        source.write_text(text, encoding="utf-8")
        subprocess.run(["c++", "-g", "-O1", "-o", program, source], check=True)
        return program

    def only_computes(self, name, text):
        self.add(name, self.compile(name, text))
        self.hunt()
        return json.loads((self.root / "out" / "flakes" / f"{name}.json").read_text(encoding="utf-8"))["only_computes"]

    def test_a_comment_changes_no_program(self):
        program = self.compile("program", "int main() { return 0; }\n")
        bytes_before, before = program.read_bytes(), inputs.digest(program, inputs.RAN)
        self.compile("program", "// a comment\n\nint main() { return 0; }\n")
        self.assertNotEqual(program.read_bytes(), bytes_before)
        self.assertEqual(inputs.digest(program, inputs.RAN), before)
        self.compile("program", "int main(int count, char**) { return count - 1; }\n")
        self.assertNotEqual(inputs.digest(program, inputs.RAN), before)

    def test_recognizes_programs_that_only_compute(self):
        self.assertTrue(self.only_computes("sum", "int main(int count, char**) { return count - 1; }\n"))
        self.assertTrue(self.only_computes("googletest", "#include <chrono>\nnamespace testing { __attribute__((noinline)) long now() { "
                                           "return std::chrono::steady_clock::now().time_since_epoch().count(); } }\n"
                                           "int main() { return testing::now() == 0; }\n"))

    def test_recognizes_programs_that_do_more(self):
        for name, text in {"clock": "#include <chrono>\nint main() { return std::chrono::steady_clock::now().time_since_epoch().count() == 0; }\n",
                           "seconds": "#include <ctime>\nint main() { return time(nullptr) == 0; }\n",
                           "cycles": "int main() { return __builtin_ia32_rdtsc() == 0; }\n",
                           "process": "#include <unistd.h>\nint main() { if (fork() == 0) _exit(0); }\n",
                           "thread": "#include <thread>\nint main() { std::thread([] {}).join(); }\n",
                           "sleep": "#include <unistd.h>\nint main() { usleep(1); }\n",
                           "load": "#include <cstdio>\nint main() { return fopen(\"/proc/loadavg\", \"r\") == nullptr; }\n"}.items():
            with self.subTest(name):
                self.assertFalse(self.only_computes(name, text))

    def test_skips_a_computing_test_until_it_changes(self):
        self.only_computes("sum", "int main(int count, char**) { return count - 1; }\n")
        again = self.hunt()
        self.assertEqual((again.only_compute, again.failed), (["sum"], []))
        self.compile("sum", "int main(int count, char**) { return 2 * count - 2; }\n")
        waiting = hunt.Hunt(self.places, self.root / "out" / "flakes", "first", TIMES).waiting(hunt.tests_of(self.places))
        self.assertEqual([test.name for test in waiting], ["sum"])



class Whole(unittest.TestCase):
    """A repository whose runs are scripts that each write a line."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root, self.counted = pathlib.Path(folder.name, "repository"), pathlib.Path(folder.name, "counted")
        (self.root / "docs").mkdir(parents=True)
        self.git("init", "--quiet")
        self.write("test", f'#!/bin/sh\necho "$1" >>{self.counted}\n')
        self.write(".ci/run", f"#!/bin/sh\necho ci >>{self.counted}\n")
        self.write("docs/page.md", "one\n")
        self.write("app/program.cpp", "one\n")

    def git(self, *words):
        subprocess.run(["git", "-C", self.root, *words], check=True, capture_output=True)

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text, encoding="utf-8")
        file.chmod(0o755)
        self.git("add", name)

    def repeat(self, boots=3, times=2):
        """(new runs of hil, of image, of continuous integration, names that failed)"""
        self.counted.write_text("", encoding="utf-8")
        with contextlib.redirect_stdout(io.StringIO()):
            failed = whole.repeat(self.root, self.root.parent / "state", boots, times)
        lines = self.counted.read_text(encoding="utf-8").splitlines()
        return *(lines.count(name) for name in ("hil", "image", "ci")), failed

    def test_continuous_integration_contains_the_machines(self):
        self.assertEqual(self.repeat(), (1, 1, 2, []))
        self.assertEqual(self.repeat(), (0, 0, 0, []))
        self.assertEqual(self.repeat(boots=4), (1, 1, 0, []))

    def test_a_changed_page_reruns_only_continuous_integration(self):
        self.repeat()
        self.write("docs/page.md", "two\n")
        self.assertEqual(self.repeat(times=1), (0, 0, 1, []))

    def test_a_changed_product_reruns_everything(self):
        self.repeat()
        (self.root / "app/program.cpp").write_text("two\n", encoding="utf-8")  # not in the index
        self.assertEqual(self.repeat(), (1, 1, 2, []))

    def test_reruns_failures(self):
        self.write("test", f'#!/bin/sh\necho "$1" >>{self.counted}\n[ "$1" = hil ]\n')
        self.assertEqual(self.repeat(), (1, 1, 2, ["image"]))
        self.assertEqual(self.repeat(), (0, 1, 0, ["image"]))


if __name__ == "__main__":
    unittest.main()
