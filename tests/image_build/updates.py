"""Makes bundles for tests: good ones, and each kind that must be refused or fall back.

Frame    `next_image`: the folder of an image with version NEXT, from which all bundles are made.
Threads  one caller.
Errors   subprocess.CalledProcessError of the programs that make a bundle.
"""

import os
import pathlib
import re
import shutil
import subprocess

CHECKOUT = pathlib.Path(__file__).resolve().parent.parent.parent
BUNDLE = CHECKOUT / "image_build/bundle"
# The version of the image under test, and versions later than any release.
THIS = re.search(r"^project\(FrustumScreen VERSION ([0-9.]+) ", (CHECKOUT / "CMakeLists.txt").read_text(encoding="utf-8"), re.MULTILINE).group(1)
NEXT = "99.0.0"
AFTER_NEXT = "99.1.0"


def make_key(folder, name):
    """NAME.key and NAME.crt, which are valid for twenty years."""
    folder.mkdir(parents=True, exist_ok=True)
    key, certificate = folder / f"{name}.key", folder / f"{name}.crt"
    if not certificate.exists():
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:3072", "-nodes", "-subj", f"/CN={name}", "-days", "7300",
                        "-keyout", key, "-out", certificate], check=True, capture_output=True)
    return key, certificate


def _in_place(kernel_image, pattern, words):
    """Replaces words on the command line of a kernel image, which keeps its length."""
    data = kernel_image.read_bytes()
    found = re.search(pattern, data)
    assert found and len(words) <= len(found.group(0)), pattern
    kernel_image.write_bytes(data[:found.start()] + words.ljust(len(found.group(0))) + data[found.end():])


def no_root(kernel_image):
    """The version's root is on no disk: the initrd gives up and restarts the machine."""
    _in_place(kernel_image, rb"frustumscreen\.root_hash=[0-9a-f]{64}", b"frustumscreen.root_hash=" + b"5" * 64)


def no_init(kernel_image):
    """The kernel finds no first program, and panics."""
    _in_place(kernel_image, rb"systemd\.import_credentials=0", b"rdinit=/none")


def no_exhibit(kernel_image):
    """The system starts, but the exhibit never does."""
    _in_place(kernel_image, rb"systemd\.import_credentials=0 systemd\.show_status=0", b"systemd.mask=frustumscreen.service")


class Updates:
    def __init__(self, next_image, keys, folder):
        self._image, self._keys, self._folder = next_image, keys, folder
        folder.mkdir(parents=True, exist_ok=True)

    def make(self, version=NEXT, key="update", change=None):
        """Makes a signed bundle with this version. `change`: a function that changes its kernel image before."""
        work = self._folder / f"of-{version}"
        work.mkdir()
        os.link(self._image / f"frustumscreen_{NEXT}.slot", work / f"frustumscreen_{version}.slot")
        kernel_image = work / f"frustumscreen_{version}.efi"
        shutil.copyfile(self._image / f"frustumscreen_{NEXT}.efi", kernel_image)
        if change:
            change(kernel_image)
        private, certificate = make_key(self._keys, key)
        out = self._folder / f"{key}-{version}.raucb"
        subprocess.run([BUNDLE, "--image", work, "--key", private, "--cert", certificate, "-o", out], check=True, capture_output=True)
        shutil.rmtree(work)
        return out

    def truncated(self):
        out = self.make()
        os.truncate(out, out.stat().st_size * 6 // 10)
        return out

    def altered(self):
        """A bundle with one wrong bit in the middle of the signed data, which is read only at the installation."""
        out = self.make()
        with open(out, "r+b") as file:
            file.seek(out.stat().st_size // 2)
            byte = file.read(1)
            file.seek(-1, os.SEEK_CUR)
            file.write(bytes([byte[0] ^ 1]))
        return out
