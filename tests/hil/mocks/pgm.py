"""Grey pictures as files: binary PGM of 8 bits.

Shape    luma[height][width], row 0 at the top, one byte a pixel.
Errors   OSError, ValueError with a sentence.
Source   netpbm's pgm(5), without its comments.
"""

import os
import re


def read(path):
    """(width, height, luma)"""
    with open(path, "rb") as file:
        data = file.read()
    header = re.match(rb"P5\s+(\d+)\s+(\d+)\s+255\s", data)
    if not header:
        raise ValueError(f"{path} is not a binary PGM of 8 bits")
    width, height, luma = int(header[1]), int(header[2]), data[header.end():]
    if len(luma) != width * height:
        raise ValueError(f"{path}: {width} x {height} pixels need {width * height} bytes; found {len(luma)}")
    return width, height, luma


def write(path, width, height, luma):
    """A concurrent reader gets the complete old file."""
    new = f"{path}.new"
    with open(new, "wb") as file:
        file.write(b"P5 %d %d 255\n" % (width, height) + luma)
    os.replace(new, path)
