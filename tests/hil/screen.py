"""Pictures: read from PPM (screendump) and PNG (our programs), and measured.

Shape    row 0 at the top; 8-bit sRGB codes, three bytes a pixel.
Outline  a picture's lit part is a list of integers, one for each row. An integer's bits are the row's pixels, the leftmost pixel
         the highest bit; so shifting and counting pixels is integer arithmetic.
Errors   ValueError.
Source   netpbm's ppm(5); PNG specification (W3C, 2003), section 9 (filters).
"""

import struct
import zlib
from dataclasses import dataclass

LIT = 12  # sRGB codes above this count as lit; it exceeds the greys of the picture's code (base/probe_code.h) and rounding
PROBE_PIXELS = 8
CODES = 1 << PROBE_PIXELS


@dataclass
class Picture:
    width: int
    height: int
    rgb: bytes

    def pixel(self, x, y):
        at = 3 * (y * self.width + x)
        return tuple(self.rgb[at : at + 3])


def read_ppm(path):
    with open(path, "rb") as file:
        data = file.read()
    fields, at = [], 0
    while len(fields) < 4:
        while data[at : at + 1].isspace():
            at += 1
        end = at
        while end < len(data) and not data[end : end + 1].isspace():
            end += 1
        fields.append(data[at:end])
        at = end
    width, height = int(fields[1]), int(fields[2])
    rgb = data[at + 1 :]
    if fields[0] != b"P6" or fields[3] != b"255" or len(rgb) != 3 * width * height:
        raise ValueError(f"{path} is not a whole 8-bit PPM")
    return Picture(width, height, rgb)


def _unfilter(kind, row, above, step):
    if kind == 0:
        return row
    row = bytearray(row)
    for k in range(len(row)):
        left = row[k - step] if k >= step else 0
        up = above[k]
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = up
        elif kind == 3:
            guess = (left + up) // 2
        else:  # Paeth
            corner = above[k - step] if k >= step else 0
            estimate = left + up - corner
            guess = min((left, up, corner), key=lambda value: abs(estimate - value))
        row[k] = (row[k] + guess) & 255
    return bytes(row)


def read_png(path):
    """Reads 8-bit RGB and RGBA, not interlaced, as our programs write it."""
    with open(path, "rb") as file:
        data = file.read()
    width = height = step = 0
    packed, at = [], 8
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            if depth != 8 or colour not in (2, 6) or interlaced:
                raise ValueError(f"{path} is not a plain 8-bit RGB or RGBA PNG")
            step = 3 if colour == 2 else 4
        elif kind == b"IDAT":
            packed.append(body)
        at += 12 + length
    lines = zlib.decompress(b"".join(packed))
    rows, above = [], bytes(step * width)
    for y in range(height):
        start = y * (step * width + 1)
        above = _unfilter(lines[start], lines[start + 1 : start + 1 + step * width], above, step)
        rows.append(above)
    flat = b"".join(rows)
    if step == 4:
        colours = bytearray(3 * width * height)
        for channel in range(3):
            colours[channel::3] = flat[channel::4]
        flat = bytes(colours)
    return Picture(width, height, flat)


def write_png(path, picture):
    """Writes with weak compression: fast, and small enough to keep."""
    lines = b"".join(
        b"\0" + picture.rgb[3 * picture.width * y : 3 * picture.width * (y + 1)] for y in range(picture.height)
    )

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", picture.width, picture.height, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 1)))
        file.write(chunk(b"IEND", b""))


_DIGIT = bytes(ord("1") if code > LIT else ord("0") for code in range(256))


def lit(picture):
    """The lit part of the picture, row by row."""
    rows = []
    for y in range(picture.height):
        start = 3 * picture.width * y
        row = picture.rgb[start : start + 3 * picture.width]
        bits = 0
        for channel in range(3):
            bits |= int(row[channel::3].translate(_DIGIT), 2)
        rows.append(bits)
    return rows


def count(rows):
    return sum(row.bit_count() for row in rows)


def centroid(rows, width):
    """(x, y) in pixels, the top left pixel's centre at (0.5, 0.5); None if nothing is lit."""
    total = count(rows)
    if total == 0:
        return None
    planes = []  # plane k: the pixels whose distance from the right edge has bit k
    for k in range(width.bit_length()):
        planes.append(sum(1 << position for position in range(width) if position >> k & 1))
    from_right = sum((row & plane).bit_count() << k for row in rows if row for k, plane in enumerate(planes))
    y = sum(number * row.bit_count() for number, row in enumerate(rows))
    return (width - 0.5 - from_right / total, 0.5 + y / total)


def box(rows, width):
    """(left, top, right, bottom), the last two exclusive; None if nothing is lit."""
    lines = [number for number, row in enumerate(rows) if row]
    if not lines:
        return None
    together = 0
    for row in rows:
        together |= row
    right = width - ((together & -together).bit_length() - 1)
    return (width - together.bit_length(), lines[0], right, lines[-1] + 1)


def changed(before, after, by):
    """An outline of the pixels that differ by more than so many codes, without the first row, which has the watchdog's code."""
    rows = [0]
    for y in range(1, before.height):
        first = 3 * before.width * y
        bits = 0
        for at in range(first, first + 3 * before.width, 3):
            bits = bits << 1 | int(any(abs(before.rgb[at + k] - after.rgb[at + k]) > by for k in range(3)))
        rows.append(bits)
    return rows


def grown(rows, pixels, width):
    """The outline grown by `pixels` along rows and columns."""
    full = (1 << width) - 1
    wide = []
    for row in rows:
        for _ in range(pixels):
            row |= (row << 1 | row >> 1) & full
        wide.append(row)
    out = []
    for y in range(len(wide)):
        bits = 0
        for row in wide[max(0, y - pixels) : y + pixels + 1]:
            bits |= row
        out.append(bits)
    return out


def share_outside(rows, allowed):
    """The share of the lit pixels that is not in `allowed`."""
    total = count(rows)
    return count([row & ~other for row, other in zip(rows, allowed)]) / total if total else 0.0


def _code(picture, zero, one):
    code = 0
    for k in range(PROBE_PIXELS):
        red, green, blue = picture.pixel(k, 0)
        if red != green or green != blue or red not in (zero, one):
            return None
        code |= (red == one) << k
    return code


def probe(picture):
    """The code in the corner of a picture that the exhibit drew (base/probe_code.h); None: the exhibit did not draw it."""
    return _code(picture, 1, 2)


def not_before(code, other):
    """Whether the picture with this code is the one with the other code or a later one. Codes wrap around after CODES pictures."""
    return (code - other) % CODES < CODES // 2


def safe_probe(picture):
    """The code in the corner of the safe picture."""
    return _code(picture, 3, 4)
