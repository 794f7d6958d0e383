#!/usr/bin/python3
"""Tests the conversion of Debian's licence names to SPDX expressions, with the examples of the format's page and with a parser of SPDX.

    licence_names_test.py SOURCE    SOURCE: the repository
"""

import pathlib
import sys
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE / "image_build/contents"))
import copyright_file  # noqa: E402
import spdx_list  # noqa: E402

FORMAT = "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n\n"
# Names from the format's page and from packages of Debian 12.
ROWS = [
    ("GPL-2", "GPL-2.0-only"),
    ("GPL-2+", "GPL-2.0-or-later"),
    ("GPL-2.0+", "GPL-2.0-or-later"),
    ("GPLv3+", "GPL-3.0-or-later"),
    ("LGPLv2.1+", "LGPL-2.1-or-later"),
    ("LGPL-2", "LGPL-2.0-only"),
    ("GPL", "GPL-1.0-or-later"),
    ("GPL-7", "LicenseRef-Debian-GPL-7"),
    ("GFDL-NIV-1.3+", "GFDL-1.3-no-invariants-or-later"),
    ("GFDL-1.3+-no-invariant", "GFDL-1.3-no-invariants-or-later"),
    ("Expat", "MIT"),
    ("public-domain", "LicenseRef-Debian-public-domain"),
    ("GPL-1+ or Artistic", "GPL-1.0-or-later OR Artistic-1.0-Perl"),
    ("GPL-2+ or Artistic-2.0, and BSD-3-clause", "(GPL-2.0-or-later OR Artistic-2.0) AND BSD-3-Clause"),
    ("Expat and ISC or Zlib", "(MIT AND ISC) OR Zlib"),
    ("MPL-1.1 or GPL-2+ or LGPL-2.1+", "MPL-1.1 OR GPL-2.0-or-later OR LGPL-2.1-or-later"),
    ("GPL-2 with Linux-syscall-note exception", "GPL-2.0-only WITH Linux-syscall-note"),
    ("GPL-3+-WITH-BISON-EXCEPTION", "GPL-3.0-or-later WITH Bison-exception-2.2"),
    ("GPL-2+ with frog exception", "LicenseRef-Debian-GPL-2-with-frog-exception"),
    ("MIT/X11", "MIT"),
    ("Expat with embedded exception", "MIT WITH fmt-exception"),
]


class LicenceNames(unittest.TestCase):
    def test_a_short_name_becomes_an_expression(self):
        for short, spdx in ROWS:
            self.assertEqual(copyright_file.expression(short), spdx)

    def test_every_name_is_known_to_spdx(self):
        known = [*copyright_file.NAMES.values(), *(spdx for _, spdx in ROWS)]
        known += [f"GPL-2.0-only WITH {name}" for name in copyright_file.EXCEPTIONS.values() if name != "LLVM-exception"]
        for spdx in known:
            self.assertEqual(spdx_list.unknown_of(spdx), [], spdx)
        self.assertEqual(spdx_list.unknown_of("MIT OR Frog-1.0"), ["Frog-1.0"])

    def test_ignores_packaging_and_free_text(self):
        files = "Files: *\nCopyright: a\nLicense: Zlib\n text\n\nFiles: debian/*\nCopyright: b\nLicense: GPL-2\n"
        self.assertEqual(copyright_file.licences_of(FORMAT + files), ["Zlib"])
        self.assertEqual(copyright_file.licences_of("This is free.\n\n" + files), [])
        text = "see /usr/share/common-licenses/GPL-2. Or\n'/usr/share/common-licenses/LGPL-2.1'."
        self.assertEqual(copyright_file.common_licences_of(text), ["GPL-2", "LGPL-2.1"])


if __name__ == "__main__":
    unittest.main()
