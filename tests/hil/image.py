"""What the guest starts from: Debian's root, kept between runs, and over it our programs, packed again each time.

Errors   subprocess.CalledProcessError from the scripts that do the work.
"""

import hashlib
import pathlib
import shutil
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
CHECKOUT = HERE.parent.parent
CACHE = CHECKOUT / "build" / "hil"
FONTS = "fonts-dejavu-core"


def library_packages(program):
    """The Debian packages that hold the shared libraries of a program."""
    listed = subprocess.run(["ldd", program], check=True, capture_output=True, text=True).stdout
    paths = [word for line in listed.splitlines() for word in line.split() if word.startswith("/")]
    files = {str(pathlib.Path(path).resolve()) for path in paths}
    files |= {file.removeprefix("/usr") for file in files}  # dpkg knows each file by its name in the package
    found = subprocess.run(["dpkg-query", "--search", *sorted(files)], check=False, capture_output=True, text=True)
    return sorted({line.split(":")[0] for line in found.stdout.splitlines()})


def root(program, say):
    """The folder with vmlinuz, initrd.img and root.squashfs; made again if its recipe or the libraries changed."""
    packages = [*library_packages(program), FONTS]
    recipe = b"".join((HERE / name).read_bytes() for name in ("guest_root.sh", "guest_vkms.sh", "guest_init"))
    key = hashlib.sha256(recipe + " ".join(packages).encode()).hexdigest()[:16]
    folder = CACHE / f"root-{key}"
    if not (folder / "root.squashfs").exists():
        say("making the guest's Debian; it is kept in build/hil")
        for old in CACHE.glob("root-*"):
            shutil.rmtree(old)
        subprocess.run([HERE / "guest_root.sh", folder, *packages], check=True)
    return folder


def packs(build, say):
    """The folder with the two packs that the guest shows."""
    folder = CACHE / "packs"
    say("baking two small packs")
    subprocess.run([HERE / "bake_packs.sh", build / "bin", folder], check=True)
    return folder


def payload(build, pack_folder):
    """The image of our programs, packs and settings."""
    image = CACHE / "payload.squashfs"
    subprocess.run([HERE / "guest_payload.sh", build, pack_folder, image], check=True)
    return image
