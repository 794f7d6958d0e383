"""Lists everything in the image: its kind, its package, its size and the reason for it.

Paths    as in the root, without the leading slash; other files are below initrd/, kernel_image/ and boot_partition/.
Bytes    of files, unpacked; and in the image. In the root the latter are exact, because squashfs packs each file in blocks of its own.
         The initrd is packed as one; its size is shared in proportion to the packed size of each file alone.
Errors   Wrong, one sentence: no list has a reason or a purpose for something in the image; a part of the image is missing.
"""

import collections
import dataclasses
import hashlib
import pathlib
import re
import stat
import subprocess
from concurrent.futures import ThreadPoolExecutor

import boot_files
import dpkg_database
import squashfs
from word_lists import Wrong, first_match, lines_of

LISTS = pathlib.Path(__file__).resolve().parent
MADE = "(made by the build)"  # stands for the package of files that belong to none


@dataclasses.dataclass
class Item:
    path: str
    kind: str  # "file" or "link"
    size: int
    taken: float
    sha256: str
    package: str = MADE
    reason: str = ""
    purpose: str = ""
    is_elf: bool = False


@dataclasses.dataclass
class Contents:
    items: list
    database: object  # dpkg_database.Database, also with packages that are not in the image
    compiled_in: list  # (Package, which part of it is in which program)
    version: str
    time_s: int  # the image's
    parts: list  # (what, bytes): the image's bytes that belong to no file


def one_file(folder, pattern):
    found = sorted(folder.glob(pattern))
    if len(found) != 1:
        raise Wrong(f"{folder} has {'no' if not found else len(found)} {pattern}, and should have one: ./image_build/build makes it")
    return found[0]


def item_of(path, data, taken):
    return Item(path, "file", len(data), taken, hashlib.sha256(data).hexdigest(), is_elf=data[:4] == b"\x7fELF")


def root_items(image):
    inodes = set()
    for path, file in image.files.items():
        if file.kind == "link":
            yield Item(path, "link", 0, 0, "")
        elif file.kind == "file":
            item = item_of(path, image.read(file), file.taken)
            if file.inode in inodes:  # a second name of the same file
                item.size, item.taken = 0, 0
            inodes.add(file.inode)
            yield item


def packed_alone(data):
    return len(subprocess.run(["zstd", "-qc", "-3", "--single-thread"], input=data, check=True, capture_output=True).stdout)


def initrd_items(packed):
    """Items of the initrd; their packed bytes add up to the size of the initrd."""
    files = boot_files.files_of_initrd(packed)
    plain = [path for path, (mode, _) in files.items() if stat.S_ISREG(mode)]
    with ThreadPoolExecutor(2) as workers:
        alone = dict(zip(plain, workers.map(lambda path: packed_alone(files[path][1]), plain)))
    share = len(packed) / max(1, sum(alone.values()))
    for path, (mode, data) in files.items():
        if stat.S_ISREG(mode):
            yield item_of(f"initrd/{path}", data, alone[path] * share)
        elif stat.S_ISLNK(mode):
            yield Item(f"initrd/{path}", "link", 0, 0, "")


def owner_of(path, owner):
    """The package that a file comes from; the initrd has files of /usr/bin and /usr/sbin in /bin."""
    place, _, inside = path.partition("/")
    if place == "initrd":
        inside = inside.removeprefix("extra/over/")  # the test's agent is laid over the root
        name = inside.rpartition("/")[2]
        places = [dpkg_database.merged(inside), *([f"usr/bin/{name}", f"usr/sbin/{name}"] if inside.startswith("bin/") else [])]
    else:
        places = [path]
    return next((owner[place] for place in places if place in owner), None)


def reasons_of(folder):
    kept = {}
    for line in (folder / "kept.tsv").read_text(encoding="utf-8").splitlines():
        _, reason, path = line.split("\t", 2)
        kept[path] = reason
    return kept


def explain(items, database, kept):
    """Fills in package, reason and purpose."""
    made = list(lines_of(LISTS / "reasons.list"))
    purposes = list(lines_of(LISTS / "purposes.list"))
    from_packages = dict(lines_of(LISTS / "sources.list"))
    for item in items:
        package = first_match(from_packages.items(), item.path)
        if package:  # a section of the kernel image or a boot loader, whose path differs from that in its package
            package = next((name for name in sorted(database.packages) if re.fullmatch(package, name)), None)
        else:
            package = owner_of(item.path, database.owner)
        item.package = package or MADE
        below_initrd = dpkg_database.merged(item.path.removeprefix("initrd/"))
        item.reason = first_match(made, item.path) or kept.get(item.path) or kept.get(below_initrd) or ""
        if not item.reason:
            raise Wrong(f"{item.path} ({item.package}) is in the image without a reason: a line in image_build/contents/reasons.list gives one")
        names = ()
        if package:
            names = (f"package:{package}", f"source:{database.packages[package].source}")
        item.purpose = first_match(purposes, item.path, names) or ""
        if not item.purpose:
            raise Wrong(f"{item.path} ({item.package}) is in the image without a purpose: a line in image_build/contents/purposes.list gives one")


def read_compiled_in(folder):
    database = dpkg_database.Database()
    if folder.exists():
        database.add(folder)
    listed = collections.OrderedDict(lines_of(LISTS / "compiled_in.list"))
    missing = set(listed) - set(database.packages)
    if missing:
        raise Wrong(f"{folder} does not know {', '.join(sorted(missing))}: build the image again")
    return [(database.packages[name], what) for name, what in listed.items()]


def read(out):
    """The contents of the image that ./image_build/build has left in the folder out."""
    try:
        image = squashfs.Squashfs(one_file(out, "frustumscreen_*.slot"))
        kernel_image = one_file(out, "frustumscreen_*.efi")
        sections = boot_files.sections_of(kernel_image)
        items = [*root_items(image), *initrd_items(sections.pop(".initrd"))]
        held = sum(len(data) for data in sections.values())
        for name, data in sections.items():
            items.append(item_of(f"kernel_image/{name}", data, len(data)))
        for path, data in boot_files.files_of_boot_partition(one_file(out, "frustumscreen.raw")).items():
            items.append(item_of(f"boot_partition/{path}", data, len(data)))
        database = dpkg_database.read_kept(out / "provenance")
        explain(items, database, reasons_of(out))
    except (ValueError, OSError) as wrong:
        raise Wrong(f"{out} is not a whole image: {wrong}") from wrong
    version = kernel_image.name.removeprefix("frustumscreen_").removesuffix(".efi")
    slot_size = one_file(out, "frustumscreen_*.slot").stat().st_size
    packed = sum(item.taken for item in items if item.path.startswith("initrd/"))
    parts = [("the root's tables: names, rights, where each block is", image.bytes_used - round(sum(file.taken for file in image.files.values()))),
             ("dm-verity: hashes, and the code that mends damaged blocks", slot_size - image.bytes_used),
             ("the kernel image's headers and gaps", kernel_image.stat().st_size - held - round(packed))]
    return Contents(items, database, read_compiled_in(out / "provenance/compiled_in"), version, image.time_s, parts)
