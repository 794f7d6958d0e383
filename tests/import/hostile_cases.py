"""Hostile sticks: each function fills a folder. `signer` signs the packs that have a valid signature."""

import copy
import hashlib
import json
import os
import socket
import stat
import struct
import zlib

from plain_pack import DEFLATED, Entry, described, manifest, pack, pack_entries, parts, png, triangle, zip_file

NO_NUMBERS = ("NaN", "Infinity", "-Infinity", "1e999", "-1e999", "nan(1)", "0x7ff0", "--1")


def signed(signer, text, files):
    return zip_file(pack_entries(text, files, signer.sign(text)))


def with_part(signer, name, data, method=None):
    """A signed pack in which the part `name` is `data`."""
    files = {**parts(), name: data}
    text = described(manifest(), files)
    entries = pack_entries(text, files, signer.sign(text))
    for entry in entries:
        if method is not None and entry.name == name.encode():
            entry.method = method
    return zip_file(entries)


def unlike(signer, change):
    """A signed pack whose manifest `change` has altered before it was written."""
    description = manifest()
    change(description)
    return pack(signer, description=description)


def raw(signer, entries_change=None, **options):
    """A signed pack whose ZIP container is wrong."""
    files = parts()
    text = described(manifest(), files)
    entries = pack_entries(text, files, signer.sign(text))
    if entries_change:
        entries = entries_change(entries) or entries
    return zip_file(entries, **options)


def zip_directories(folder, signer):
    def renamed(name):
        def change(entries):
            entries[1].name = name
        return change

    def doubled(entries):
        return [*entries, copy.copy(entries[1])]

    def first_twice(entries):
        return [entries[0], copy.copy(entries[0]), *entries[1:]]

    def overlapping(entries):
        return entries + [Entry(b"more/%d" % number, entries[1].data, offset=0) for number in range(50)]

    def set_of(**values):
        def change(entries):
            for key, value in values.items():
                setattr(entries[1], key, value)
        return change

    wrong = {
        "up": raw(signer, renamed(b"../../../etc/cron.d/x")), "absolute": raw(signer, renamed(b"/etc/passwd")), "back": raw(signer, renamed(b"..\\..\\x")),
        "dots": raw(signer, renamed(b"textures/../../x")), "empty_name": raw(signer, renamed(b"")), "zero": raw(signer, renamed(b"a\0b")),
        "broken_utf8": raw(signer, renamed(b"\xff\xfe\xc0\xaf")), "long": raw(signer, renamed(b"a" * 60000)),
        "doubled": raw(signer, doubled), "manifest_twice": raw(signer, first_twice), "overlapping": raw(signer, overlapping),
        "symlink": raw(signer, set_of(attributes=(stat.S_IFLNK | 0o777) << 16, data=b"/etc/shadow")),
        "other_name": raw(signer, set_of(local_name=b"manifest.json")), "encrypted": raw(signer, set_of(flags=1)),
        "method": raw(signer, set_of(method=99, packed=b"x")), "size_small": raw(signer, set_of(size=1)), "size_large": raw(signer, set_of(size=0x7FFFFFFF)),
        "packed_large": raw(signer, set_of(packed_size=0x7FFFFFFF)), "outside": raw(signer, set_of(offset=0xFFFFFF00)),
        "zip64": raw(signer, set_of(size=0xFFFFFFFF)), "count_small": raw(signer, count=1), "count_large": raw(signer, count=60000),
        "before": raw(signer, before=b"#!/bin/sh\n"), "after": raw(signer, after=b"x" * 100), "no_entry": zip_file([]),
        "half": raw(signer)[:200], "end_alone": raw(signer)[-22:], "no_zip": os.urandom(70000), "nothing": b"",
    }
    for name, data in wrong.items():
        (folder / f"{name}.fspack").write_bytes(data)


def many_parts(folder, signer):
    (folder / "entries.fspack").write_bytes(zip_file([Entry(b"p/%d" % number, b"", packed=b"") for number in range(65535)]))
    files = {f"p/{number}": b"x" for number in range(65534)}
    text = described(manifest(), files)
    (folder / "signed.fspack").write_bytes(signed(signer, text, files))


def zeros(mib):
    """`mib` MiB of zeros, deflated. The blocks end at a byte boundary, so one block is repeated."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    block = packer.compress(bytes(1 << 20)) + packer.flush(zlib.Z_FULL_FLUSH)
    return block * mib + b"\x03\x00"


def bombs(folder, signer):
    packed = zeros(1024)
    for name, size in (("true", 1 << 30), ("lying", 1000), ("at_limit", 16 << 20)):
        (folder / f"manifest_{name}.fspack").write_bytes(zip_file([Entry(b"manifest.json", b"", packed=packed, size=size)]))
    (folder / "signature.fspack").write_bytes(zip_file(
        [Entry(b"manifest.json", described(manifest(), parts())), Entry(b"signature", b"", packed=packed, size=60000)]))
    # Signed: a person who has the key, or has bypassed it, still cannot make the importer use more memory.
    text = described(manifest(), {**parts(), "textures/0.png": b""})
    lying = pack_entries(text, {"levels/0.bin": triangle()}, signer.sign(text))
    lying.insert(1, Entry(b"textures/0.png", b"", DEFLATED, packed=packed, size=1000))
    (folder / "signed_lying.fspack").write_bytes(zip_file(lying))


def large_part(folder, signer):
    """512 MiB of zeros with the right hash, as large as a part may be. It is a valid pack, so it may take longer."""
    block, total, check = bytes(1 << 20), hashlib.sha256(), 0
    for _ in range(512):
        total.update(block)
        check = zlib.crc32(block, check)
    text = json.loads(described(manifest(), {"levels/0.bin": triangle()}))
    text["parts"].append({"name": "textures/0.png", "bytes": 512 << 20, "sha256": total.hexdigest()})
    text = json.dumps(text).encode()
    entries = pack_entries(text, {"levels/0.bin": triangle()}, signer.sign(text))
    entries.insert(1, Entry(b"textures/0.png", b"", DEFLATED, packed=zeros(512), size=512 << 20, check=check))
    (folder / "large.fspack").write_bytes(zip_file(entries))


def places_of_numbers(value, place=()):
    """The places of all numbers in the manifest."""
    if isinstance(value, bool):
        return
    if isinstance(value, (int, float)):
        yield place
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield from places_of_numbers(inner, (*place, key))


def no_numbers(folder, signer):
    """Manifests in each of which one number is replaced by something that is not a number."""
    files = parts()
    whole = json.loads(described(manifest(), files))
    texts = []
    for number, place in enumerate(places_of_numbers(whole)):
        for offset in (0, 3):
            changed = copy.deepcopy(whole)
            inner = changed
            for key in place[:-1]:
                inner = inner[key]
            inner[place[-1]] = "@"
            texts.append(json.dumps(changed).replace('"@"', NO_NUMBERS[(number + offset) % len(NO_NUMBERS)]).encode())
    for number, (text, signature) in enumerate(zip(texts, signer.sign_all(texts))):
        (folder / f"{number:03}.fspack").write_bytes(zip_file(pack_entries(text, files, signature)))


def manifests(folder, signer):
    """Manifests that are too large, broken, or contradict their parts."""
    texts = {
        "deep": described(manifest(), parts())[:-1] + b', "x": ' + b"[" * 500000 + b"]" * 500000 + b"}",
        "names": b"{" + b",".join(b'"%d":0' % number for number in range(1 << 20)) + b"}",
        "broken_utf8": described(manifest(), parts()).replace(b"A vase.", b"\xff\xc0\xaf\xed\xa0\x80"),
        "cut": described(manifest(), parts())[:-40], "zeros": bytes(1 << 20), "list": b"[]", "nothing": b"",
    }
    for (name, text), signature in zip(texts.items(), signer.sign_all(texts.values())):
        (folder / f"{name}.fspack").write_bytes(zip_file(pack_entries(text, parts(), signature)))
    changes = {
        "direction": lambda d: d.update(title="abc\u202efed"), "control": lambda d: d.update(title="a\u0007\u001b[2Jb"),
        "extremes": lambda d: d["placement"].update(extremes=[[9.0, 9.0, 9.0]] * 100001),
        "textures": lambda d: d.update(textures=["textures/0.png"] * 65), "levels": lambda d: d.update(levels=d["levels"] * 33),
        "title": lambda d: d.update(title="t" * 2000), "languages": lambda d: d.update(languages=["en"] * 70),
        "index": lambda d: d.update(default_level=31), "version": lambda d: d.update(version=99),
        "up": lambda d: d.update(textures=["../../etc/passwd"]), "unknown": lambda d: d.update(run="rm -rf /"),
    }
    for name, change in changes.items():
        (folder / f"{name}.fspack").write_bytes(unlike(signer, change))


def broken_parts(folder, signer):
    """Signed packs with parts of wrong contents."""
    nan, infinity = float("nan"), float("inf")
    usual = (0, 3, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0, -0.5, 0.0, 0.0, 1.0, 2.0)
    levels = {f"cluster_{place}": triangle(clusters=((*usual[:place], nan if place % 2 else infinity, *usual[place + 1:]),))
              for place in range(2, 13)}
    levels |= {
        "indices": triangle(indices=(0, 1, 4000000000)), "counts": triangle(counts=(3, 0xFFFFFFFF, 1)),
        "vertices": triangle(counts=(1 << 24, 3, 1)), "clusters": triangle(counts=(3, 3, 1 << 22)),
        "cluster_range": triangle(clusters=((0xFFFFFFF0, 0x20, *usual[2:]),)), "half": triangle()[:60], "long": triangle() + bytes(9),
    }
    for name, data in levels.items():
        (folder / f"level_{name}.fspack").write_bytes(with_part(signer, "levels/0.bin", data))
    pictures = {
        "giant": png(0x7FFFFFFF, 0x7FFFFFFF, zeros(1)), "wide": png(100000, 100000, zeros(4)), "zero": png(0, 0, b""), "noise": os.urandom(5000),
        "sixteen_thousand": png(16384, 16384, zlib.compress(bytes(1 << 20))),
        "bomb": png(8192, 8193, zlib.compress(bytes(1 << 24))), "webp": b"RIFF\xff\xff\xff\xffWEBPVP8L" + bytes(64),
    }
    for name, data in pictures.items():
        (folder / f"picture_{name}.fspack").write_bytes(with_part(signer, "textures/0.png", data))
    files = parts()
    text = described(manifest(), files)
    altered = pack_entries(text, {**files, "levels/0.bin": triangle(indices=(0, 2, 1))}, signer.sign(text))
    (folder / "altered.fspack").write_bytes(zip_file(altered))
    (folder / "missing.fspack").write_bytes(zip_file(pack_entries(text, {"levels/0.bin": triangle()}, signer.sign(text))))


def altered_copies(folder, signer):
    """A signed pack of 4 MiB, a thousand times, in which one byte was changed after signing: manifest and signature are valid."""
    data = os.urandom(4 << 20)
    description = manifest()
    description["sections"]["padding"] = {"parts": ["padding.bin"], "data": {}}
    files = {**parts(), "padding.bin": data}
    text = described(description, files)
    entries = pack_entries(text, {**files, "padding.bin": data[:-1] + bytes([data[-1] ^ 1])}, signer.sign(text))
    (folder / "000.fspack").write_bytes(zip_file(entries))
    for number in range(1, 1000):
        os.link(folder / "000.fspack", folder / f"{number:03}.fspack")


def signatures(folder, signer):
    text = described(manifest(), parts())
    good = signer.sign(text, 99)
    lines = good.split(b"\n")
    wrong = {"half": good[:100], "noise": os.urandom(300), "zeros": bytes(60000), "nothing": b"", "no_comment": b"\n".join(lines[:2]),
             "comment": good.replace(b"serial:99", b"serial:99999999"), "long": good + b"x" * 65000, "too_long": good + b"x" * 200000,
             "key": lines[0] + b"\n" + b"RW" + b"A" * 98 + b"\n" + b"\n".join(lines[2:]), "lines": b"\n" * 60000}
    for name, signature in wrong.items():
        (folder / f"{name}.fspack").write_bytes(zip_file(pack_entries(text, parts(), signature)))
    (folder / "of_another.fspack").write_bytes(zip_file(pack_entries(described({**manifest(), "title": "Jug"}, parts()), parts(), good)))
    (folder / "unsigned.fspack").write_bytes(pack())


def no_files(folder, signer):
    """Entries of the stick that are not regular files, or links to other places."""
    elsewhere = folder.parent / "elsewhere.fspack"
    elsewhere.write_bytes(pack(signer, 50))
    (folder / "link.fspack").symlink_to(elsewhere)
    (folder / "loop.fspack").symlink_to("loop.fspack")
    (folder / "device_link.fspack").symlink_to("/dev/zero")
    (folder / "up").symlink_to("..")
    (folder / "root").symlink_to("/")
    os.mkfifo(folder / "pipe.fspack")
    (folder / "folder.fspack").mkdir()
    with socket.socket(socket.AF_UNIX) as place:
        place.bind(str(folder / "socket.fspack"))
    if os.geteuid() == 0:
        for name, number in (("zero", (1, 5)), ("random", (1, 9)), ("tty", (5, 0))):
            try:
                os.mknod(folder / f"{name}.fspack", stat.S_IFCHR | 0o666, os.makedev(*number))
            except PermissionError:  # in a container
                pass
    os.mkfifo(folder / "exhibit.toml")


def names(folder, _):
    for name in (b"\xff\xfe\xc0\xaf.fspack", b"new\nline.fspack", b"\x1b[2J\x07bell.fspack", "\u202egpj.fspack".encode(),
                 b"a" * 248 + b".fspack", b" .fspack", b"'; reboot #.fspack", b"%s%n%d.fspack", b"-rf.fspack", b"{}.fspack"):
        with open(os.fsencode(folder) + b"/" + name, "wb") as file:
            file.write(b"x" * 100)


def many_files(folder, _):
    for number in range(100_000):
        os.close(os.open(f"{folder}/{number}.fspack" if number % 100 == 0 else f"{folder}/{number}", os.O_CREAT | os.O_WRONLY))


def many_folders(folder, _):
    for number in range(3000):
        (folder / f"{number}").mkdir()
        (folder / f"{number}" / "x.fspack").touch()


def deep_folders(folder, _):
    here = os.open(folder, os.O_RDONLY)
    for _ in range(1500):
        os.mkdir("d" * 100, dir_fd=here)
        below = os.open("d" * 100, os.O_RDONLY, dir_fd=here)
        os.close(here)
        here = below
    os.close(here)


def two_terabytes(folder, _):
    with open(folder / "sparse.fspack", "wb") as file:
        file.truncate(2 << 40)


def sparse_with_end(folder, _):
    """A sparse file of 2 GiB - 1 bytes. Only its last 22 hold data: a ZIP's end, which says that the directory fills all bytes before."""
    size = (2 << 30) - 1
    with open(folder / "sparse.fspack", "wb") as file:
        file.truncate(size)
        file.seek(size - 22)
        file.write(struct.pack("<IHHHHIIH", 0x06054B50, 0, 0, 0xFFFF, 0xFFFF, size - 22, 0, 0))


def set_files(folder, signer):
    """A signed exhibit.toml that is far too large."""
    (folder / "exhibit.toml").write_bytes(b"order = [" + b'"x",' * 3_000_000 + b"]")
    (folder / "exhibit.toml.minisig").write_bytes(signer.sign((folder / "exhibit.toml").read_bytes()))


def deep_set_file(folder, signer):
    (folder / "exhibit.toml").write_bytes(b"a = " + b"[" * 100_000)
    (folder / "exhibit.toml.minisig").write_bytes(signer.sign((folder / "exhibit.toml").read_bytes()))


CASES = (zip_directories, many_parts, bombs, large_part, no_numbers, manifests, broken_parts, altered_copies, signatures, no_files, names, many_files,
         many_folders, deep_folders, two_terabytes, sparse_with_end, set_files, deep_set_file)
WHOLE = (large_part,)  # valid packs; their import may take a time in proportion to their size
