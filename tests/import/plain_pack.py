"""A pack of one triangle and one small picture, written only from app/pack/FORMAT.md. A test can make each of its bytes wrong.

Units    as in FORMAT.md.
Errors   subprocess.CalledProcessError from minisign, which signs.
Source   PKWARE's APPNOTE.TXT 6.3.10 (ZIP), RFC 2083 (PNG).
"""

import hashlib
import json
import pathlib
import struct
import subprocess
import tempfile
import zlib
from dataclasses import dataclass

STORED, DEFLATED = 0, 8
DATE = 0x0021  # 1980-01-01


@dataclass
class Entry:
    """An entry of a ZIP. A member that is None gets the true value; any other value is written as given, even if it is false."""

    name: bytes
    data: bytes
    method: int = DEFLATED
    packed: bytes = None  # the bytes in the archive, packed from `data`
    size: int = None  # its size in the directory
    packed_size: int = None
    offset: int = None  # its offset in the directory
    flags: int = 0
    attributes: int = 0
    local_name: bytes = None  # its name in its own header
    check: int = None  # CRC-32


def deflated(data):
    packer = zlib.compressobj(1, zlib.DEFLATED, -15)
    return packer.compress(data) + packer.flush()


def zip_file(entries, count=None, before=b"", after=b""):
    """The bytes of a ZIP. `count`: the number of entries in its end record."""
    body, directory = bytearray(before), bytearray()
    for entry in entries:
        if entry.packed is None:
            entry.packed = deflated(entry.data) if entry.method == DEFLATED else entry.data
        size = len(entry.data) if entry.size is None else entry.size
        packed_size = len(entry.packed) if entry.packed_size is None else entry.packed_size
        check = zlib.crc32(entry.data) if entry.check is None else entry.check
        offset = len(body) if entry.offset is None else entry.offset
        name = entry.name if entry.local_name is None else entry.local_name
        body += struct.pack("<IHHHHHIIIHH", 0x04034B50, 20, entry.flags, entry.method, 0, DATE, check, packed_size, size,
                            len(name), 0) + name + entry.packed
        directory += struct.pack("<IHHHHHHIIIHHHHHII", 0x02014B50, 0x0314, 20, entry.flags, entry.method, 0, DATE, check,
                                 packed_size, size, len(entry.name), 0, 0, 0, 0, entry.attributes, offset) + entry.name
    count = min(len(entries), 0xFFFF) if count is None else count
    end = struct.pack("<IHHHHIIH", 0x06054B50, 0, 0, count, count, len(directory), len(body), 0)
    return bytes(body) + bytes(directory) + end + after


def png(width=4, height=4, rows=None):
    """An RGB picture; `rows`: packed pixels that do not fit the size, if given."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    if rows is None:
        rows = zlib.compress((b"\0" + b"\xc0\x80\x40" * width) * height)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", rows) + chunk(b"IEND", b""))


def triangle(clusters=((0, 3, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0, -0.5, 0.0, 0.0, 1.0, 2.0),), counts=None, indices=(0, 1, 2)):
    """The part levels/0.bin; `counts`: the numbers of vertices, indices and clusters in its header."""
    vertices = ((0, 0, 0), (65535, 65535, 0), (32768, 32768, 65535))
    counts = counts or (len(vertices), len(indices), len(clusters))
    return (b"FSLV" + struct.pack("<IIIII", 1, 0, *counts)
            + b"".join(struct.pack("<II11f", *cluster) for cluster in clusters)
            + struct.pack(f"<{len(indices)}I", *indices)
            + b"".join(struct.pack("<6H", *vertex, 0, 100, 200) for vertex in vertices))


def manifest():
    """The manifest as Python values, without `parts`."""
    return {
        "format": "FrustumScreen pack", "version": 2, "title": "Vase", "languages": ["en"],
        "captions": [{"language": "en", "title": "Vase", "text": "A vase."}],
        "provenance": {"source_name": "vase.glb", "source_sha256": "", "licence": "CC0", "source_triangles": 1},
        "prop_kind": "frustum", "unlit": False, "samples": 1, "relief_size": 0,
        "placement": {"box_size": [0.5, 0.5, 1.0],
                      "box_from_file": [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
                      "extremes": [[-0.25, -0.25, 0.0], [0.25, 0.25, 0.0], [0.0, 0.0, 1.0]], "scale": 1.0},
        "textures": ["textures/0.png"], "relief": None,
        "levels": [{"technique": "mesh", "error": {"mean_box": 0.0, "p95_box": 0.0, "max_box": 0.0, "colour_rmse": 0.0},
                    "triangles": 1, "vertices": 3, "texture": "textures/0.png", "mesh": "levels/0.bin"}],
        "default_level": 0,
        "sections": {"identity": {"parts": [], "data": {"id": "vase"}}},
    }


def parts():
    return {"textures/0.png": png(), "levels/0.bin": triangle()}


def described(description, files):
    """The bytes of manifest.json for these parts."""
    listed = [{"name": name, "bytes": len(data), "sha256": hashlib.sha256(data).hexdigest()} for name, data in files.items()]
    return json.dumps({**description, "parts": listed}).encode()


class Signer:
    """A minisign key pair without a password."""

    def __init__(self, folder):
        self._folder = pathlib.Path(folder)
        self.public = self._folder / "museum.pub"
        self._secret = self._folder / "museum.key"
        subprocess.run(["minisign", "-G", "-W", "-f", "-p", self.public, "-s", self._secret], check=True, capture_output=True)

    def sign_all(self, texts, serial=20):
        """The bytes of a .minisig file for each text."""
        with tempfile.TemporaryDirectory(dir=self._folder) as folder:
            files = [pathlib.Path(folder) / str(number) for number in range(len(texts))]
            for file, text in zip(files, texts):
                file.write_bytes(text)
            subprocess.run(["minisign", "-S", "-s", self._secret, "-t", f"serial:{serial}", "-m", *files], check=True,
                           capture_output=True)
            return [pathlib.Path(f"{file}.minisig").read_bytes() for file in files]

    def sign(self, data, serial=20):
        return self.sign_all([data], serial)[0]


def pack_entries(text, files, signature=None):
    """The entries of a pack, in the order that FORMAT.md requires."""
    entries = [Entry(b"manifest.json", text)]
    entries += [Entry(name.encode(), data, STORED if name.endswith(".png") else DEFLATED) for name, data in files.items()]
    if signature is not None:
        entries.append(Entry(b"signature", signature))
    return entries


def pack(signer=None, serial=20, description=None, files=None):
    """The bytes of a pack, signed if a signer is given."""
    files = parts() if files is None else files
    text = described(manifest() if description is None else description, files)
    return zip_file(pack_entries(text, files, signer and signer.sign(text, serial)))
