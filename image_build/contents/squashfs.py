"""Reads a squashfs image: each file with its bytes, and how many of the image's bytes it takes, compressed.

Source   Linux, Documentation/filesystems/squashfs.rst and fs/squashfs/squashfs_fs.h: version 4.0, little-endian, zstd.
Errors   ValueError, in a sentence: the file is no such image.
"""

import ctypes
import ctypes.util
import struct

SUPERBLOCK = struct.Struct("<IIIIIHHHHHHQQQQQQQQ")
MAGIC, ZSTD = 0x73717368, 6
NO_FRAGMENT = 0xFFFFFFFF
UNCOMPRESSED = 1 << 24  # flag in a data block's size word; in a metadata block's it is bit 15
METADATA = 8192  # bytes of a full metadata block, unpacked


class File:
    """kind: "file", "link", "folder" or "other"; taken: bytes in the image, with its shares of common blocks."""

    def __init__(self, kind, size=0, inode=0, target=""):
        self.kind, self.size, self.inode, self.target, self.taken = kind, size, inode, target, 0.0
        self.blocks, self.fragment = [], None  # (place in the image, size word); (fragment, offset, bytes)


class Squashfs:
    """files: path -> File, in the order of the paths; paths are without the leading slash."""

    def __init__(self, path):
        self.image = open(path, "rb")
        head = self.image.read(SUPERBLOCK.size)
        if len(head) < SUPERBLOCK.size or head[:4] != MAGIC.to_bytes(4, "little"):
            raise ValueError(f"{path} is not a squashfs image")
        fields = SUPERBLOCK.unpack(head)
        if fields[9] != 4 or fields[5] != ZSTD:
            raise ValueError(f"{path} is squashfs of another version, or not packed with zstd")
        self.time_s, self.block_size, fragments = fields[2], fields[3], fields[4]
        root, self.bytes_used, inodes, folders, table = fields[11], fields[12], fields[15], fields[16], fields[17]
        self.zstd = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
        self.zstd.ZSTD_decompress.restype = ctypes.c_size_t
        self.zstd.ZSTD_decompress.argtypes = (ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t)
        self.fragments = self.read_fragments(table, fragments)
        self.inodes, self.inode_at = self.read_table(inodes, folders)
        self.folders, self.folder_at = self.read_table(folders, self.bytes_used)
        self.files, self.unpacked = {}, (None, b"")
        self.walk("", root)
        self.files = dict(sorted(self.files.items()))
        self.share_out()

    def unpack(self, data, max_bytes):
        out = ctypes.create_string_buffer(max_bytes)
        size = self.zstd.ZSTD_decompress(out, max_bytes, data, len(data))
        if size > max_bytes:
            raise ValueError("the squashfs image has a damaged block")
        return out.raw[:size]

    def metadata(self, place):
        """(the block's bytes, where the next one begins)"""
        self.image.seek(place)
        (word,) = struct.unpack("<H", self.image.read(2))
        data = self.image.read(word & 0x7FFF)
        return (data if word & 0x8000 else self.unpack(data, METADATA)), place + 2 + (word & 0x7FFF)

    def read_table(self, begin, end):
        """(all bytes of a table, place of a block after `begin` -> its offset in these bytes). A block that is not full ends it."""
        data, at, place = bytearray(), {}, begin
        while place < end:
            block, following = self.metadata(place)
            at[place - begin] = len(data)
            data += block
            place = following
            if len(block) < METADATA:  # the last one
                break
        return bytes(data), at

    def read_fragments(self, table, count):
        """(place, size word) of each fragment block."""
        self.image.seek(table)
        blocks = -(-count * 16 // METADATA)
        places = struct.unpack(f"<{blocks}Q", self.image.read(8 * blocks))
        data = b"".join(self.metadata(place)[0] for place in places)
        return [struct.unpack_from("<QI", data, 16 * number) for number in range(count)]

    def walk(self, path, reference):
        at = self.inode_at[reference >> 16] + (reference & 0xFFFF)
        kind, _, _, _, _, number = struct.unpack_from("<HHHHII", self.inodes, at)
        at += 16
        if kind in (1, 8):
            if kind == 1:
                start, _, size, offset, _ = struct.unpack_from("<IIHHI", self.inodes, at)
            else:
                _, size, start, _, _, offset, _ = struct.unpack_from("<IIIIHHI", self.inodes, at)
            if path:
                self.files[path] = File("folder", inode=number)
            self.walk_folder(path, self.folder_at.get(start, 0) + offset, size - 3)
        elif kind in (2, 9):
            self.files[path] = self.read_file_inode(kind, at, number)
        elif kind in (3, 10):
            (size,) = struct.unpack_from("<4xI", self.inodes, at)
            target = self.inodes[at + 8 : at + 8 + size].decode("utf-8")
            self.files[path] = File("link", inode=number, target=target)
        else:
            self.files[path] = File("other", inode=number)

    def walk_folder(self, path, at, size):
        end = at + size
        while at < end:
            count, start, _ = struct.unpack_from("<III", self.folders, at)
            at += 12
            for _ in range(count + 1):
                offset, _, _, length = struct.unpack_from("<HhHH", self.folders, at)
                name = self.folders[at + 8 : at + 9 + length].decode("utf-8")
                at += 9 + length
                self.walk(f"{path}/{name}" if path else name, start << 16 | offset)

    def read_file_inode(self, kind, at, number):
        if kind == 2:
            start, fragment, offset, size = struct.unpack_from("<IIII", self.inodes, at)
            at += 16
        else:
            start, size, _, _, fragment, offset, _ = struct.unpack_from("<QQQIIII", self.inodes, at)
            at += 40
        file = File("file", size, number)
        whole = size // self.block_size if fragment != NO_FRAGMENT else -(-size // self.block_size)
        for word in struct.unpack_from(f"<{whole}I", self.inodes, at):
            file.blocks.append((start, word))
            start += word & (UNCOMPRESSED - 1)
        if fragment != NO_FRAGMENT:
            file.fragment = (fragment, offset, size - whole * self.block_size)
        return file

    def share_out(self):
        """Data shared by two files counts for the first; a fragment block is divided by size."""
        seen, in_fragment = set(), {}
        owners = []
        for file in self.files.values():
            for block in file.blocks:
                if block not in seen:
                    seen.add(block)
                    file.taken += block[1] & (UNCOMPRESSED - 1)
            if file.fragment and file.fragment not in seen:
                seen.add(file.fragment)
                owners.append(file)
                in_fragment[file.fragment[0]] = in_fragment.get(file.fragment[0], 0) + file.fragment[2]
        for file in owners:
            number, _, size = file.fragment
            file.taken += (self.fragments[number][1] & (UNCOMPRESSED - 1)) * size / in_fragment[number]

    def block(self, place, word):
        self.image.seek(place)
        data = self.image.read(word & (UNCOMPRESSED - 1))
        return data if word & UNCOMPRESSED else self.unpack(data, self.block_size)

    def read(self, file):
        """The bytes of a file."""
        parts, left = [], file.size
        for place, word in file.blocks:
            part = self.block(place, word) if word else bytes(min(left, self.block_size))
            left -= len(part)
            parts.append(part)
        if file.fragment:
            number, offset, size = file.fragment
            if self.unpacked[0] != number:
                self.unpacked = (number, self.block(*self.fragments[number]))
            parts.append(self.unpacked[1][offset : offset + size])
        return b"".join(parts)
