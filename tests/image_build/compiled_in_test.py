#!/usr/bin/python3
"""Compares the headers of compiled_in.list with the headers that the compiler has read and the archives that were linked.

    compiled_in_test.py SOURCE    SOURCE: the repository, with its release build
"""

import os
import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(sys.argv[1]).resolve()
BUILD = SOURCE / "build/release"
PROGRAMS = ("frustumscreen", "frustumscreen-calibrate", "frustumscreen-import", "frustumscreen-pack", "frustumscreen-safe", "frustumscreen-watchdog")
INTERFACE = {"linux-libc-dev"}  # the kernel's interface: only numbers and structures, no code


def lines_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True, cwd=BUILD).stdout.splitlines()


def linked(target, seen):
    """The objects and outside libraries of a program and of the archives that it links."""
    depth = None
    for line in lines_of("ninja", "-t", "query", target):
        if line.startswith("  input:"):
            depth = True
        elif line.startswith("  outputs:"):
            break
        elif depth and not line.strip().startswith("||"):
            name = line.strip().removeprefix("| ")
            if name not in seen and re.search(r"\.(o|a|so)(\.\d+)*$", name):
                seen.add(name)
                if name.endswith(".a") and not name.startswith("/"):
                    linked(name, seen)
    return seen


def packages_of(paths):
    found = set()
    for line in lines_of("dpkg-query", "--search", *sorted(paths)):
        found.update(name.strip().partition(":")[0] for name in line.rpartition(": ")[0].split(","))
    return found


def sources_of(packages):
    """package -> source, for the packages that are installed here."""
    asked = subprocess.run(["dpkg-query", "-W", "-f", "${db:Status-Status} ${Package} ${source:Package}\n", *sorted(packages)],
                           capture_output=True, text=True).stdout
    return {line.split()[1]: line.split()[2] for line in asked.splitlines() if line.startswith("installed ")}


def shared_libraries():
    """Patterns of the libraries that the programs load at their start, and that the image therefore has. A library may be in /lib or
    /usr/lib."""
    listed = lines_of("ldd", *(f"bin/{program}" for program in PROGRAMS))
    return {f"*/{line.split()[0]}" for line in listed if "=> /" in line}


def main():
    inputs = set()
    for program in PROGRAMS:
        linked(f"bin/{program}", inputs)
    archives = {os.path.realpath(name) for name in inputs if name.startswith("/") and name.endswith(".a")}
    objects, headers, of = {name for name in inputs if name.endswith(".o")}, set(), None
    for line in lines_of("ninja", "-t", "deps"):
        if not line.startswith(" "):
            of = line.partition(":")[0]
        elif of in objects and line.strip().startswith("/usr/"):
            headers.add(os.path.realpath(line.strip()))
    if len(headers) < 100:
        sys.exit(f"only {len(headers)} headers of Debian's were read for {', '.join(PROGRAMS)}: ninja does not know them all")
    read = packages_of(headers | archives) - INTERFACE
    with_library = set(sources_of(packages_of(shared_libraries())).values())
    sources = sources_of(read)
    alone = {package for package in read if sources[package] not in with_library}
    listed = {line.split()[0] for line in (SOURCE / "image_build/contents/compiled_in.list").read_text().splitlines()
              if line and not line.startswith("#") and "headers:" in line}
    print(f"{len(headers)} headers of {len(read)} packages; without a library in the image: {', '.join(sorted(alone))}")
    if alone != listed:
        sys.exit(f"compiled_in.list has {sorted(listed)} as headers; the programs have {sorted(alone)}")


if __name__ == "__main__":
    main()
