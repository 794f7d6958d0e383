#!/usr/bin/python3
"""Writes, beside the image, its bill of materials and the texts of all licences.

    write_bill.py IMAGE-FOLDER

IMAGE-FOLDER/sbom.json       CycloneDX 1.4: packages, code compiled into our programs, the hash of each file
IMAGE-FOLDER/licences.tar    the copyright file of each package in the image, each text once; the licences that these refer to; and
                             INDEX, which names the text of each package
Errors   one sentence: a package without a copyright file.
"""

import io
import json
import pathlib
import sys
import tarfile

import copyright_file
import cyclonedx
import image_contents
from word_lists import Wrong


def text_of(package):
    path = package.folder / "usr/share/doc" / package.name / "copyright"
    if not path.exists():
        raise Wrong(f"the package {package.name} has no copyright file below {package.folder}; it cannot be passed on without")
    return path.read_text(encoding="utf-8", errors="replace")


def texts_of(contents):
    """package -> (text, its name in the tar); packages with the same text share a name."""
    names, texts = {}, {}
    present = {item.package for item in contents.items} - {image_contents.MADE}
    packages = [contents.database.packages[name] for name in present] + [package for package, _ in contents.compiled_in]
    for package in sorted(packages, key=lambda package: package.name):
        text = text_of(package)
        texts[package.name] = (text, names.setdefault(text, f"packages/{package.name}"))
    return texts


def common_texts(texts, provenance):
    """name -> text of the common licences that copyright files refer to."""
    found = {}
    for name in sorted({name for text, _ in texts.values() for name in copyright_file.common_licences_of(text)}):
        path = provenance / "debian/usr/share/common-licenses" / name
        if path.exists():
            found[name] = path.read_text(encoding="utf-8")
    return found


def write_tar(path, files, time_s):
    with tarfile.open(path, "w", format=tarfile.USTAR_FORMAT) as tar:
        for name, text in sorted(files.items()):
            data = text.encode("utf-8")
            entry = tarfile.TarInfo(f"licences/{name}")
            entry.size, entry.mtime, entry.mode = len(data), time_s, 0o644
            tar.addfile(entry, io.BytesIO(data))


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    contents = image_contents.read(folder)
    provenance = folder / "provenance"
    texts = texts_of(contents)
    bill = cyclonedx.make(contents, texts)
    (folder / "sbom.json").write_text(json.dumps(bill, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    files = {place: text for text, place in texts.values()}
    files.update({f"common-licenses/{name}": text for name, text in common_texts(texts, provenance).items()})
    files["INDEX"] = "".join(f"{name}\t{place}\n" for name, (_, place) in sorted(texts.items()))
    write_tar(folder / "licences.tar", files, contents.time_s)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Wrong as wrong:
        sys.exit(f"build: {wrong}")
