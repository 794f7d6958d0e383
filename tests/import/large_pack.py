#!/usr/bin/python3
"""Gives frustumscreen-import a signed pack of nearly 2 GiB, the largest allowed: it must be taken, with 64 MiB of memory.

    large_pack.py BIN [FOLDER]    BIN: the folder of the programs; FOLDER: a folder with 4 GiB free

Exit status 77: a program that this needs is not on this machine, or there is no room.
"""

import hashlib
import json
import os
import pathlib
import shutil
import sys
import tempfile
import time
import zipfile

import plain_pack
from hostile_sticks import MAX_MIB, Kiosk

PART_BYTES = 511 << 20
PARTS = 4


def write_pack(file, signer):
    """Writes the pack with stored parts, so that the file is as large as its contents. All parts are the same zeros."""
    data = bytes(PART_BYTES)
    description = plain_pack.manifest()
    names = [f"padding/{number}" for number in range(PARTS)]
    description["sections"]["padding"] = {"parts": names, "data": {}}
    files = plain_pack.parts()
    text = json.loads(plain_pack.described(description, files))
    digest = hashlib.sha256(data).hexdigest()
    text["parts"] += [{"name": name, "bytes": PART_BYTES, "sha256": digest} for name in names]
    text = json.dumps(text).encode()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED, allowZip64=False) as archive:
        archive.writestr("manifest.json", text)
        for name, part in files.items():
            archive.writestr(name, part)
        for name in names:
            archive.writestr(name, data)
        archive.writestr("signature", signer.sign(text, 1))


def main():
    if not shutil.which("minisign"):
        print("left out: minisign is not installed")
        return 77
    with tempfile.TemporaryDirectory(dir=sys.argv[2] if len(sys.argv) > 2 else None) as place:
        place = pathlib.Path(place)
        if shutil.disk_usage(place).free < 5 << 30:
            print(f"left out: {place} has not 5 GiB free")
            return 77
        for name in ("keys", "stick"):
            (place / name).mkdir()
        write_pack(place / "stick" / "large.fspack", plain_pack.Signer(place / "keys"))
        kiosk = Kiosk(pathlib.Path(sys.argv[1]) / "frustumscreen-import", place, place / "keys")
        begun = time.monotonic()
        status, said, _, mib, work_s, _ = kiosk.take(place / "stick")
        packs = kiosk.list()
        kiosk.stop()
        size = os.path.getsize(place / "stick" / "large.fspack")
        print(f"{size} bytes: {mib:.0f} MiB, {work_s:.1f} s of the processor, {time.monotonic() - begun:.1f} s; {said}")
        return 0 if status == 0 and [pack["bytes"] for pack in packs] == [size] and mib <= MAX_MIB else 1


if __name__ == "__main__":
    sys.exit(main())
