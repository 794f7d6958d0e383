"""Checks a printed command against the programs: does each program exist, and does it accept the arguments."""

import collections
import pathlib
import re
import shutil
import subprocess
import tempfile

import accepted

SCRIPTS = ("run", "test", "setup.sh", "cmake/build.sh", "image_build/build", "image_build/bundle", "image_build/packages", "image_build/why",
           "tests/hil/mock_tracker", "tests/hil/mock_buttons", "tests/hil/mock_camera")
BUILTINS = ("cd", "export")


class Checks:
    """`harmless`: other programs that are run. `elsewhere`: other programs that are not run, and that this machine may lack."""

    def __init__(self, source, build, harmless, elsewhere):
        self.source, self.build, self.harmless, self.elsewhere = source, build, harmless, elsewhere
        installed = sorted((build / "bin").glob("frustumscreen*"))
        ours = installed + [source / script for script in SCRIPTS]
        self.programs = {program.name: program for program in ours if program in installed or program.name.startswith("mock_")}
        self.owners = collections.defaultdict(list)  # subcommand -> programs
        for program in installed:
            for name in accepted.read(program).subcommands:
                self.owners[name].append(program)
        self.helps = [(program, ()) for program in ours]
        self.helps += [(program, (name,)) for name, owners in self.owners.items() for program in owners]
        self.helps += [(program, tuple(mode.split())) for program in ours for mode in accepted.MODES.get(program.name, ())]
        self.options = frozenset().union(*(accepted.read(*each).options for each in self.helps))
        self.targets = "\n".join(path.read_text(encoding="utf-8") for path in source.glob("tests/*/CMakeLists.txt"))

    def objections(self, command):
        """One sentence for each word that is wrong."""
        try:
            return [each for word, *arguments in command.simple_commands() for each in self._objections_to(command, word, arguments)]
        except ValueError as error:
            return [str(error)]

    def is_mention(self, command):
        """Whether a code span only names a program or an option, and is not a whole command."""
        if not command.inline:
            return False
        word, *arguments = command.simple_commands()[0]
        if word not in self.programs:
            return word in self.owners or word.startswith("--")
        return word.startswith("frustumscreen") and not accepted.is_complete(self.programs[word], arguments)

    def may_run(self, command):
        """Whether it runs only our built programs and harmless ones, without sudo."""
        paths = [(word, self._program(command, word)) for word, *_ in command.simple_commands()]
        return "sudo" not in command.text.split() and all(
            word in self.harmless or path and (path.name.startswith("mock_") or self.build in path.parents) for word, path in paths)

    def _objections_to(self, command, word, arguments):
        if word.startswith("--"):  # `--out FILE`
            return [] if word in self.options else [f"no program has an option {word}"]
        if command.inline and word in self.owners:  # `run --out`
            return min((accepted.objections(program, [word, *arguments]) for program in self.owners[word]), key=len)
        if word == "ctest":
            return [] if self._finds_tests(arguments) else ["ctest finds no test so"]
        path = self._program(command, word)
        if path == self.source / "cmake/build.sh":
            return [f"there is no target {name}" for name in arguments[1:] if not self._is_target(name)]
        return accepted.objections(path, arguments) if path and arguments else []

    def _finds_tests(self, arguments):
        """Lists the tests from another folder, because even a list begins a new log in ctest's folder, over the log of a running test."""
        with tempfile.TemporaryDirectory() as folder:
            places = [self.source / after for before, after in zip(arguments, arguments[1:]) if before == "--test-dir"]
            (pathlib.Path(folder) / "CTestTestfile.cmake").write_text("".join(f'subdirs("{place}")\n' for place in places), encoding="utf-8")
            listed = subprocess.run(["ctest", "-N", *arguments, "--test-dir", folder], capture_output=True, text=True, check=False)
        return re.search(r"Total Tests: [1-9]", listed.stdout)

    def _is_target(self, name):
        return re.search(rf"\b{re.escape(name)}\b", self.targets)

    def _program(self, command, word):
        """The path of one of our programs; None for another program or a test. A ValueError: there is no such program."""
        if word in self.programs:
            return self.programs[word]
        if word.startswith("build/release/tests/"):
            if not self._is_target(word.rsplit("/", 1)[1]):
                raise ValueError(f"no test builds {word}")
            return None
        if "/" in word:
            candidates = (self.source / word, (self.source / command.page).parent / word, self.build / word.removeprefix("build/release/"))
            path = next((path for path in candidates if path.is_file()), None)
            if not path:
                raise ValueError(f"there is no program {word}")
            return path
        if not shutil.which(word) and word not in (*self.elsewhere, *BUILTINS):
            raise ValueError(f"there is no program {word} here, and commands.toml does not name it as one elsewhere")
        return None
