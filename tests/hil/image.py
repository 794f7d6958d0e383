"""The machine's disk: the kiosk's image as ./image_build/build --test makes it, with packs and settings on its data partition
as a museum has them. In addition to the test's agent, these tests lay files over the root (guest/).

Errors   subprocess.CalledProcessError from the programs that do the work.
"""

import pathlib
import shutil
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
CHECKOUT = HERE.parent.parent
BUILD = CHECKOUT / "build" / "release"
CACHE = CHECKOUT / "build" / "hil"
PRODUCT = CHECKOUT / "out" / "image" / "test"  # by make_image.sh of tests/image_build
SETTINGS = HERE / "guest/etc/frustumscreen/kiosk.toml"
DATA_PARTITION = "frustumscreen-data"


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def packs(say):
    """The folder with the two packs that the guest shows."""
    say("baking two small packs")
    run(HERE / "bake_packs.sh", BUILD / "bin", CACHE / "packs")
    return CACHE / "packs"


def partition(disk, name):
    """(offset, size) in bytes of the partition of this name."""
    listed = run("sfdisk", "--dump", disk, capture_output=True, text=True).stdout
    row, = [line for line in listed.splitlines() if f'name="{name}"' in line]
    values = dict(word.strip().split("=", 1) for word in row.split(":", 1)[1].split(",") if "=" in word)
    return 512 * int(values["start"]), 512 * int(values["size"])


def write_data(disk, files):
    """Puts files, {path: host's path}, into the data partition of a disk, without root."""
    begin, _ = partition(disk, DATA_PARTITION)
    folders = sorted({str(parent) for path in files for parent in pathlib.PurePath(path).parents if parent.name})
    commands = [f"mkdir {folder}" for folder in folders] + [f"write {source} {path}" for path, source in files.items()]
    # debugfs reports no failure in its exit status. It is no error if a folder exists already.
    run("debugfs", "-w", "-f", "-", f"{disk}?offset={begin}", input="\n".join(commands), text=True, capture_output=True)


def disk(pack_folder, out):
    """Makes a copy of the image's disk with the museum's settings and packs on it; a sparse file."""
    run("cp", "--sparse=always", "--reflink=auto", PRODUCT / "frustumscreen.raw", out)
    files = {f"lib/frustumscreen/packs/{pack.name}": pack for pack in sorted(pack_folder.glob("*.fspack"))}
    write_data(out, {**files, "lib/frustumscreen/words.fswords": pack_folder / "words.fswords", "settings/kiosk.toml": SETTINGS})
    return out


def kernel_image_parts(kernel_image, folder):
    """Writes kernel, initrd and command line into files of the folder, for a start without firmware and boot loader."""
    for name in ("linux", "initrd", "cmdline"):
        run("objcopy", "-O", "binary", f"--only-section=.{name}", kernel_image, folder / name, stderr=subprocess.DEVNULL)


def start_files(out, unsigned=None):
    """Fills the folder `out` with linux, initrd and cmdline. In the initrd, the files that these tests lay over the root follow the
    agent's. `unsigned`: a kernel module without Debian's signature, for which the kernel must not be locked down."""
    kernel_image, = PRODUCT.glob("*.efi")
    out.mkdir(parents=True, exist_ok=True)
    kernel_image_parts(kernel_image, out)
    with tempfile.TemporaryDirectory() as tree:
        over = pathlib.Path(tree) / "extra/over"
        shutil.copytree(HERE / "guest", over, symlinks=True)
        (over / "usr/bin").mkdir(parents=True)
        run("strip", "-o", over / "usr/bin/frustumscreen-pack", BUILD / "bin/frustumscreen-pack")
        ours = over / "usr/lib/frustumscreen"
        ours.mkdir(parents=True)
        run("c++", "-O1", "-Wall", "-Wextra", "-shared", "-fPIC", HERE / "guest_hang.cpp", "-o", ours / "hang.so")
        if unsigned:
            shutil.copy(unsigned, ours / "vkms.ko")
        listed = run("find", ".", "-print0", cwd=tree, capture_output=True).stdout
        archive = run("cpio", "--quiet", "--null", "--owner=0:0", "-o", "-H", "newc", cwd=tree, input=listed, capture_output=True).stdout
        packed = run("zstd", "-q", "-1", input=archive, capture_output=True).stdout
    with open(out / "initrd", "ab") as initrd:
        initrd.write(bytes(-initrd.tell() % 4) + packed)
    command_line = (out / "cmdline").read_text(encoding="utf-8").rstrip("\0\n")
    command_line += " mitigations=off"  # they make the emulator much slower, and it has none of these faults of processors
    if unsigned:
        command_line = command_line.replace("lockdown=integrity ", "")
    (out / "cmdline").write_text(command_line, encoding="utf-8")


def vkms(say):
    """Builds the kernel's virtual display as a module for the image's kernel, and keeps it."""
    kept = (PRODUCT / "kept.tsv").read_text(encoding="utf-8")
    version = kept.split("usr/lib/modules/", 1)[1].split("/", 1)[0]
    module = CACHE / f"vkms-{version}.ko"
    if not module.exists():
        say("building the kernel's virtual display; it is kept in build/hil")
        run(HERE / "guest_vkms.sh", version, module)
    return module
