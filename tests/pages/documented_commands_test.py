#!/usr/bin/python3
"""Checks every command that a page or a --help prints: the programs accept it, and it runs as printed or commands.toml says why not.

    documented_commands_test.py SOURCE BUILD [--long] [--only PAGE]    --long: also commands that take long

Each page has a working folder, in which its commands run one after another, so that a command finds the files of earlier ones;
commands.toml lists the files that are there before. The exit status must be 0, and standard error must not have the word "error".
"""

import argparse
import collections
import fnmatch
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import tomllib

import accepted
from checks import Checks
from commands import commands_of, examples_of

HISTORY = "CHANGELOG.md"
GUARD_S = 3600  # a limit only for a command that never ends


class Table:
    """commands.toml; remembers which of its patterns a command has matched."""

    def __init__(self):
        self.words = tomllib.loads((pathlib.Path(__file__).parent / "commands.toml").read_text(encoding="utf-8"))
        self.used = set()

    def has(self, kind, command):
        matches = [(kind, number, each) for number, entry in enumerate(self.words[kind]) for each in entry["commands"]
                   if entry.get("page", command.page) == command.page and fnmatch.fnmatchcase(command.text, each)]
        self.used.update(matches)
        return bool(matches)

    def mistakes(self, source, printed):
        """Entries without a reason, and entries for files, commands or pages that do not exist."""
        for kind in ("not_run", "long"):
            for number, entry in enumerate(self.words[kind]):
                if not entry.get("reason"):
                    yield f"{entry['commands'][0]} has no reason"
                if not (source / entry.get("instead", ".")).exists():
                    yield f"{entry['commands'][0]}: there is no {entry['instead']}"
                for each in entry["commands"]:
                    if (kind, number, each) not in self.used:
                        yield f"no page prints '{each}' any more"
        yield from (f"page {page} prints no command" for page in self.words["page"] if page not in printed)


def printed_commands(source, helps, subcommands):
    """The commands of each page or help text, in the order of their lines."""
    found = {}
    for path in sorted(source.rglob("*.md")):
        name = str(path.relative_to(source))
        if name != HISTORY and not name.startswith(("build/", "out/", ".")):
            found[name] = sorted(commands_of(name, path.read_text(encoding="utf-8"), subcommands), key=lambda command: command.line)
    for program, words in helps:
        name = " ".join((program.name, *words, "--help"))
        found[name] = examples_of(name, accepted.help_of(program, words))
    return {name: commands for name, commands in found.items() if commands}


def processor_s():
    """Processor seconds of all programs that have ended so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Runner:
    """Runs commands in folders below `whole`, with the build's programs in the path."""

    def __init__(self, words, whole, source, build):
        self.words, self.whole = words, whole
        kept = {name: value for name, value in os.environ.items() if name.startswith("MALLOC_")}  # set by run_test.sh
        self.variables = kept | {"PATH": f"{build / 'bin'}:/usr/bin:/bin", "LC_ALL": "C.UTF-8", "PYTHONDONTWRITEBYTECODE": "1", "SOURCE": str(source), "BUILD": str(build),
                          "SHELF": str(whole / "shelf")}

    def run_page(self, name, commands):
        """The failures, a text for each command."""
        page = self.words["page"].get(name, {})
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.whole))
        failure = self.run(self.words["everywhere"] + page.get("prepare", ""), folder)
        if failure:
            yield f"{name}: it could not be prepared: {failure}"
        else:
            yield from self._run_commands(page, commands, folder)
        failure = self.run(page.get("finish", ""), folder)
        if failure:
            yield f"{name}: what was prepared could not be ended: {failure}"

    def _run_commands(self, page, commands, folder):
        exports = ""
        for command in commands:
            text = re.sub(r"(?<=\w)\.\.\.", "", command.required)
            for printed, here in (self.words["places"] | page.get("places", {})).items():
                text = text.replace(printed, here)
            begun = processor_s()
            failure = self.run(exports + text, folder)
            print(f"{processor_s() - begun:6.1f} s  {command.place}: {command.text}", flush=True)
            if failure:
                yield f"{command.place}: {command.text}\n    {failure}"
            if text.startswith("export "):
                exports += text + "\n"

    def run(self, script, folder):
        """None, or a text that says what went wrong."""
        folder.mkdir(exist_ok=True)
        variables = self.variables | {"HOME": str(folder), "TMPDIR": str(folder)}
        try:
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, env=variables, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, errors="replace", timeout=GUARD_S, check=False)
        except subprocess.TimeoutExpired:
            return f"it has not ended after {GUARD_S} s"
        if done.returncode == 0 and not re.search(r"\berror\b", done.stderr, re.IGNORECASE):
            return None
        return f"exit status {done.returncode}; {done.stderr.strip()[-600:] or done.stdout.strip()[-600:]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--only", help="run only the commands of this page")
    arguments = parser.parse_args()
    source, build = arguments.source.resolve(), arguments.build.resolve()
    table = Table()
    checks = Checks(source, build, table.words["harmless"], table.words["elsewhere"])
    printed = printed_commands(source, checks.helps, checks.owners)
    wrong, counts, to_run = [], collections.Counter(), collections.defaultdict(list)
    for name, commands in printed.items():
        for command in commands:
            objections = checks.objections(command)
            not_run, takes_long = table.has("not_run", command), table.has("long", command)
            kind = ("wrong" if objections else "not run" if not_run else "mentioned" if checks.is_mention(command)
                    else "left to --long" if takes_long and not arguments.long else "run")
            if kind == "run" and not checks.may_run(command):
                kind, objections = "wrong", ["it is not run here, and commands.toml does not say why"]
            wrong += [f"{command.place}: {command.text}\n    {each}" for each in objections]
            counts[kind] += 1
            if kind == "run" and arguments.only in (None, name):
                to_run[name].append(command)
    wrong += [f"commands.toml: {each}" for each in table.mistakes(source, printed)]
    with tempfile.TemporaryDirectory(prefix="frustumscreen_pages_") as whole:
        runner = Runner(table.words, pathlib.Path(whole), source, build)
        failure = runner.run(table.words["shelf"], pathlib.Path(whole) / "shelf")
        if failure:
            sys.exit(f"what the pages need could not be made: {failure}")
        for name, commands in to_run.items():
            wrong += runner.run_page(name, commands)
    print(f"{sum(counts.values())} commands:", ", ".join(f"{count} {kind}" for kind, count in counts.items()))
    for each in wrong:
        print(each, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
