"""Reads the parts of dpkg's data base that the build has kept: the packages, and which package a file belongs to.

Source   dpkg(1), deb-control(5): var/lib/dpkg/status, var/lib/dpkg/info/PACKAGE.list.
Errors   OSError: a folder without a data base.
"""

import dataclasses
import re

MERGED = ("bin/", "sbin/", "lib/", "lib64/")  # links into usr


@dataclasses.dataclass(frozen=True)
class Package:
    name: str
    version: str
    architecture: str
    source: str
    source_version: str
    summary: str
    inside: tuple  # (source, version) of the sources linked in, from Built-Using and Static-Built-Using
    depends: tuple  # names, with all alternatives
    folder: object  # the kept tree that has its usr/share/doc
    built_here: bool


def paragraphs(text):
    """Each paragraph as a dictionary of its fields; a continued field keeps its newlines."""
    for paragraph in re.split(r"\n\s*\n", text):
        fields, name = {}, None
        for line in paragraph.splitlines():
            if line.startswith("#"):
                continue
            if line[:1] in (" ", "\t"):
                if name:
                    fields[name] += "\n" + line.strip()
            elif ":" in line:
                name, _, value = line.partition(":")
                fields[name] = value.strip()
        if fields:
            yield fields


def package_of(fields, folder, built_here):
    source = re.fullmatch(r"(\S+)(?: \((\S+)\))?", fields.get("Source", fields["Package"]))
    inside = re.findall(r"([a-z0-9][a-z0-9+.-]+) \(= ([^)]+)\)",
                        f"{fields.get('Built-Using', '')}, {fields.get('Static-Built-Using', '')}")
    depends = re.findall(r"(?:^|[,|])\s*([a-z0-9][a-z0-9+.-]+)", f"{fields.get('Depends', '')},{fields.get('Pre-Depends', '')}")
    version = fields["Version"]
    return Package(fields["Package"], version, fields["Architecture"], source[1],
                   source[2] or re.sub(r"\+b\d+$", "", version), fields.get("Description", "").partition("\n")[0],
                   tuple(sorted(set(inside))), tuple(sorted(set(depends))), folder, built_here)


def merged(path):
    """A path as it is in the image, whose /bin, /sbin and /lib are links into /usr."""
    path = path.lstrip("/")
    return f"usr/{path}" if path.startswith(MERGED) else path


class Database:
    """packages: name -> Package; owner: path without the leading slash -> package's name."""

    def __init__(self):
        self.packages, self.owner = {}, {}

    def add(self, folder, built_here=False):
        """Reads the data base of a tree; a package or file that an earlier tree has keeps that tree's entry."""
        place = folder / "var/lib/dpkg"
        for fields in paragraphs((place / "status").read_text(encoding="utf-8")):
            if "Version" not in fields or not fields.get("Status", "install ok installed").endswith(" installed"):
                continue
            package = package_of(fields, folder, built_here)
            self.packages.setdefault(package.name, package)
            lists = [place / "info" / f"{package.name}.list",
                     place / "info" / f"{package.name}:{package.architecture}.list"]
            for path in (path for path in lists if path.exists()):
                for line in path.read_text(encoding="utf-8").splitlines():
                    if line[1:] + "/" not in MERGED:
                        self.owner.setdefault(merged(line), package.name)


def read_kept(folder):
    """The data base of all packages that the image was made from: ours, Debian's installed ones, and those that were only unpacked."""
    database = Database()
    for name in ("ours", "debian", "unpacked"):
        if (folder / name / "var/lib/dpkg/status").exists():
            database.add(folder / name, built_here=name == "ours")
    return database
