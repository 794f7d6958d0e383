"""Reads the licences that a Debian package's copyright file names, if the file is machine-readable.

Source   Debian, "Machine-readable debian/copyright file" 1.0: short names, "and", "or", commas; SPDX licence list and expressions.
Errors   none: a file that is not machine-readable gives no licence.
"""

import re

from dpkg_database import paragraphs

# Debian's short names, in lower case, that the rules below do not cover, and their SPDX names.
NAMES = {
    "expat": "MIT", "mit": "MIT", "mit/x11": "MIT", "x11": "X11", "isc": "ISC", "zlib": "Zlib", "libpng": "Libpng", "ftl": "FTL",
    "bsd-1-clause": "BSD-1-Clause", "bsd-2-clause": "BSD-2-Clause", "bsd-3-clause": "BSD-3-Clause", "bsd-4-clause": "BSD-4-Clause",
    "bsd-2-clause-netbsd": "BSD-2-Clause", "bsd-4-clause-uc": "BSD-4-Clause-UC", "bsl-1.0": "BSL-1.0", "sleepycat": "Sleepycat",
    "apache-2": "Apache-2.0", "apache-2.0": "Apache-2.0", "apache-2-llvm-exceptions": "Apache-2.0 WITH LLVM-exception",
    "artistic": "Artistic-1.0-Perl", "artistic-2": "Artistic-2.0", "artistic-2.0": "Artistic-2.0", "cc0": "CC0-1.0",
    "cc0-1.0": "CC0-1.0", "ofl-1.1": "OFL-1.1", "sil-1.1": "OFL-1.1", "beerware": "Beerware", "fsfap": "FSFAP", "fsfullr": "FSFULLR",
    "latex2e": "Latex2e", "ntp": "NTP", "unlicense": "Unlicense", "bitstream-vera": "Bitstream-Vera", "mpl-1.1": "MPL-1.1",
    "mpl-2.0": "MPL-2.0", "cc-by-3.0": "CC-BY-3.0", "cc-by-4.0": "CC-BY-4.0", "cc-by-sa-3.0": "CC-BY-SA-3.0", "wtfpl": "WTFPL",
    "cc-by-sa-4.0": "CC-BY-SA-4.0", "openssl": "OpenSSL", "curl": "curl",
    "lpgl-2.1+": "LGPL-2.1-or-later",  # as alsa-lib writes it
    "expat with embedded exception": "MIT WITH fmt-exception",
}
EXCEPTIONS = {
    "linux-syscall-note": "Linux-syscall-note", "bison": "Bison-exception-2.2", "autoconf": "Autoconf-exception-generic",
    "libtool": "Libtool-exception", "font": "Font-exception-2.0",
    "llvm": "LLVM-exception", "classpath": "Classpath-exception-2.0",
}
# Debian's GPL without a number means any version; SPDX's first versions are 1.0 (GPL) and 2.0 (LGPL).
GNU = re.compile(r"(A?GPL|LGPL|GFDL)(-NIV)?(?:-?v?([0-9.]+))?(\+|-or-later|-only)?(-no-invariants?)?", re.IGNORECASE)


def reference(name):
    """A licence that SPDX has no name for."""
    return "LicenseRef-Debian-" + (re.sub(r"[^A-Za-z0-9.-]+", "-", name).strip("-") or "unnamed")


def gnu(match):
    family, invariants, version, later = match[1].upper(), match[2] or match[5], match[3], match[4]
    if not version:
        version, later = {"LGPL": "2.0", "GFDL": "1.1"}.get(family, "1.0"), "+"
    if "." not in version:
        version += ".0"
    known = {"GPL": ("1.0", "2.0", "3.0"), "LGPL": ("2.0", "2.1", "3.0"), "AGPL": ("1.0", "3.0"), "GFDL": ("1.1", "1.2", "1.3")}
    if version not in known[family]:
        return None
    without = "-no-invariants" if invariants and family == "GFDL" else ""
    return f"{family}-{version}{without}-{'or-later' if later in ('+', '-or-later') else 'only'}"


def single(name):
    """The SPDX expression of one licence, with its exception if it has one."""
    name = name.strip()
    if name.lower() in NAMES:
        return NAMES[name.lower()]
    base, _, exception = re.sub(r"-with-", " with ", name, flags=re.IGNORECASE).partition(" with ")
    match = GNU.fullmatch(base.strip())
    spdx = NAMES.get(base.strip().lower()) or (gnu(match) if match else None)
    if not exception:
        return spdx or reference(name)
    added = EXCEPTIONS.get(re.sub(r"[ -]exceptions?$", "", exception.strip(), flags=re.IGNORECASE).lower())
    return f"{spdx} WITH {added}" if spdx and added else reference(name)


def joined(parts, word):
    parts = list(dict.fromkeys(parts))
    other = " OR " if word == "AND" else " AND "
    return parts[0] if len(parts) == 1 else f" {word} ".join(f"({part})" if other in part else part for part in parts)


def expression(short):
    """The SPDX expression of a short name. "and" binds more tightly than "or"; a comma before either makes it bind least."""
    found, word = None, "AND"
    for part in re.split(r"\s*,\s*((?:and|or)\s+)?", short.strip(), flags=re.IGNORECASE):
        if part is None or re.fullmatch(r"(and|or)\s+", part, flags=re.IGNORECASE):
            word = (part or "and").strip().upper()
        elif part:
            choices = re.split(r"\s+or\s+", part, flags=re.IGNORECASE)
            spdx = joined([joined(map(single, re.split(r"\s+and\s+", choice)), "AND") for choice in choices], "OR")
            found = joined([found, spdx], word) if found else spdx
    return found


def licences_of(text):
    """The distinct expressions of all files except the packaging's, sorted; empty if the file is not machine-readable."""
    found, first = [], True
    for fields in paragraphs(text.replace("\t", " ")):
        if first and not re.search("copyright-format|dep5", fields.get("Format", fields.get("Format-Specification", "")).lower()):
            return []
        first = False
        if "Files" in fields and not all(pattern.startswith("debian/") for pattern in fields["Files"].split()):
            short = fields.get("License", "").partition("\n")[0]
            if short.strip():
                found.append(expression(short))
    return sorted(set(filter(None, found)))


def common_licences_of(text):
    """The texts in /usr/share/common-licenses that a copyright file refers to."""
    return sorted({name.rstrip(".") for name in re.findall(r"/usr/share/common-licenses/([A-Za-z0-9.+-]+)", text)})
