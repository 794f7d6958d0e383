"""The mocked camera's test picture: a grey ramp with noise, a bar that moves, and the frame's number in black and white blocks.

Luma     a ramp of codes 40 to 200 from left to right, with +-3 of noise that repeats after eight frames; so a hundredth of the pixels
         are near 40, half are below 120, a hundredth near 200. Dark: 16 to 19. Blind: 255 with some noise.
Number   in the first eight rows: sixteen blocks, the lowest bit at the left; black 16, white 235.
JPEG     baseline (ITU-T T.81), grey, only DC coefficients: each block of 8 x 8 pixels has its mean.
"""

import functools
import random
import struct

BITS, BLOCK = 16, 8
BLACK, WHITE = 16, 235
_KINDS = 8  # pictures of noise, which take turns


@functools.lru_cache(None)
def _ground(width, height, kind, light):
    """The picture without its moving parts."""
    noise = random.Random(kind)
    count = width * height
    if light == "usual":
        ramp = bytes(40 + 160 * x // width for x in range(width)) * height
        return bytes(code + extra % 7 - 3 for code, extra in zip(ramp, noise.randbytes(count)))
    if light == "dark":
        return bytes(16 + extra % 4 for extra in noise.randbytes(count))
    return bytes(255 - extra // 255 for extra in noise.randbytes(count))


_BELOW_NOISE = bytes(min(code, 252) for code in range(256))


@functools.lru_cache(None)
def _noise(count, kind):
    return bytes(extra % 4 for extra in random.Random(kind).randbytes(count))


def luma(width, height, number, light="usual"):
    picture = bytearray(_ground(width, height, number % _KINDS, light))
    if light != "usual":
        return picture
    block = width // BITS
    row = b"".join(bytes([WHITE if number >> bit & 1 else BLACK]) * block for bit in range(BITS))
    for y in range(BLOCK):
        picture[y * width:y * width + len(row)] = row
    x = 4 * number % (width - BLOCK)
    for y in range(height // 2, height // 2 + BLOCK):
        picture[y * width + x:y * width + x + BLOCK] = bytes([WHITE]) * BLOCK
    return picture


def number_in(picture, width):
    """The number that `luma` has written into a picture."""
    block = width // BITS
    row = picture[width * (BLOCK // 2):]
    return sum(1 << bit for bit in range(BITS) if row[bit * block + block // 2] > 128)


def with_noise(picture, number):
    """The luma picture, limited to 252, with 0 to 3 codes of a sensor's noise added to each pixel."""
    picture = bytes(picture).translate(_BELOW_NOISE)
    # The bytes are added as two long numbers, which is fast; no byte overflows into the next.
    total = int.from_bytes(picture, "little") + int.from_bytes(_noise(len(picture), number % _KINDS), "little")
    return total.to_bytes(len(picture), "little")


def yuyv(width, height, picture):
    data = bytearray(b"\x80") * (2 * width * height)
    data[0::2] = picture
    return bytes(data)


_LENGTHS = (0, 1, 5, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0)  # codes of each length for DC sizes 0 to 11 (T.81, table K.3)


@functools.lru_cache(None)
def _codes():
    codes, code, size = {}, 0, 0
    for length, count in enumerate(_LENGTHS, 1):
        for _ in range(count):
            codes[size] = (code, length)
            code, size = code + 1, size + 1
        code <<= 1
    return codes


def _segment(marker, body):
    return struct.pack(">BBH", 0xFF, marker, 2 + len(body)) + body


def jpeg(width, height, picture):
    bits, count, before = 0, 0, 0
    for top in range(0, height, BLOCK):
        rows = [picture[y * width:(y + 1) * width] for y in range(top, top + BLOCK)]
        for left in range(0, width, BLOCK):
            mean = sum(sum(row[left:left + BLOCK]) for row in rows) // BLOCK ** 2
            value = mean - 128  # the DC coefficient is 8 times this value, and the quantisation step is 8
            step, before = value - before, value
            size = abs(step).bit_length()
            code, length = _codes()[size]
            bits = (bits << length | code) << size | (step if step >= 0 else step + (1 << size) - 1)
            bits <<= 2  # the end of the block: 00, the only code of the AC table below
            count += length + size + 2
    fill = -count % 8
    scan = (bits << fill | (1 << fill) - 1).to_bytes((count + fill) // 8, "big").replace(b"\xff", b"\xff\0")
    return (b"\xff\xd8" + _segment(0xDB, b"\0" + bytes([8]) * 64)
            + _segment(0xC0, struct.pack(">BHHB", 8, height, width, 1) + b"\1\x11\0")
            + _segment(0xC4, b"\0" + bytes(_LENGTHS) + bytes(range(12)))
            + _segment(0xC4, b"\x10" + bytes([0, 1] + [0] * 14) + b"\0")  # one code, of two bits: the end of a block
            + _segment(0xDA, b"\1\1\0\0\x3f\0") + scan + b"\xff\xd9")
