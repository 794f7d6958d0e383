#!/usr/bin/python3
"""Checks a preview's page as a strict browser would: what it may load, which scripts run, and its text.

    check_page.py PAGE [--reloads] [--sounds N] [--pictures N] [--text WORDS]...

Prints nothing and ends with 0 if all is well.
"""
import argparse
import base64
import hashlib
import re
import sys
from html.parser import HTMLParser

ALLOWED_TAGS = set("""html head meta title style body header main section footer div span p h1 h2 h3 dl dt dd ul li b br
    figure figcaption img audio table tr th td button input script noscript""".split())
ADDRESSES = {"src", "href", "poster", "srcset", "action", "formaction", "data", "background", "xlink:href"}


class Page(HTMLParser):
    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.addresses = []
        self.inline = {"style": [], "script": []}
        self.policy = None
        self.refreshes = 0
        self.text = ""
        self.inside = None

    def handle_starttag(self, tag, attributes):
        assert tag in ALLOWED_TAGS, f"<{tag}> has no place in this page"
        values = dict(attributes)
        for name, value in attributes:
            assert not name.startswith("on") and name != "style", f"{name} on <{tag}> would run or style by itself"
            if name in ADDRESSES:
                self.addresses.append((tag, value))
        if tag == "meta" and values.get("http-equiv", "").lower() == "content-security-policy":
            assert not self.inline["style"] and not self.inline["script"], "the policy comes too late"
            self.policy = values["content"]
        self.refreshes += tag == "meta" and values.get("http-equiv", "").lower() == "refresh"
        if tag in self.inline:
            self.inside = tag
            self.inline[tag].append("")

    def handle_endtag(self, tag):
        self.inside = None if tag == self.inside else self.inside

    def handle_data(self, data):
        if self.inside:
            self.inline[self.inside][-1] += data
        else:
            self.text += data


def hashes(contents):
    return {"'sha256-" + base64.b64encode(hashlib.sha256(c.encode()).digest()).decode() + "'" for c in contents}


def check_policy(page):
    rules = {}
    for rule in page.policy.split(";"):
        name, *values = rule.split()
        rules[name] = set(values)
    assert rules["default-src"] == {"'none'"}, page.policy
    assert rules["img-src"] == rules["media-src"] == {"data:"}, page.policy
    assert rules["style-src"] == hashes(page.inline["style"]), "the style is not the one that the policy allows"
    # The policy of a page that does not reload itself may still allow the script for reloading.
    missing = hashes(page.inline["script"]) - rules["script-src"]
    assert not missing and len(rules["script-src"]) <= 2, page.policy
    assert all(value.startswith("'sha256-") for value in rules["script-src"] | rules["style-src"])


def webp_size(data):
    """Width and height, by the container's own description (developers.google.com/speed/webp/docs/riff_container)."""
    assert data[:4] == b"RIFF" and data[8:12] == b"WEBP", data[:12]
    assert int.from_bytes(data[4:8], "little") + 8 == len(data)
    if data[12:16] == b"VP8L":
        bits = int.from_bytes(data[21:25], "little")
        return (bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1
    assert data[12:16] == b"VP8 " and data[23:26] == b"\x9d\x01\x2a", data[12:26]
    return int.from_bytes(data[26:28], "little") & 0x3FFF, int.from_bytes(data[28:30], "little") & 0x3FFF


def check_addresses(page):
    pictures = sounds = 0
    for tag, address in page.addresses:
        kind, data = re.fullmatch(r"data:([a-z/]+);base64,([A-Za-z0-9+/]+=*)", address).groups()
        data = base64.b64decode(data, validate=True)
        assert (tag, kind) in {("img", "image/webp"), ("audio", "audio/ogg")}, (tag, kind)
        if tag == "img":
            assert min(webp_size(data)) > 0
            pictures += 1
        else:
            assert data[:4] == b"OggS" and data[28:36] == b"OpusHead"
            sounds += 1
    return pictures, sounds


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("page")
    parser.add_argument("--reloads", action="store_true")
    parser.add_argument("--pictures", type=int)
    parser.add_argument("--sounds", type=int)
    parser.add_argument("--text", action="append", default=[])
    arguments = parser.parse_args()
    with open(arguments.page, encoding="utf-8") as file:
        source = file.read()
    page = Page()
    page.feed(source)
    page.close()
    assert page.policy, "there is no policy"
    check_policy(page)
    assert "url(" not in "".join(page.inline["style"]) and "@import" not in "".join(page.inline["style"])
    pictures, sounds = check_addresses(page)
    assert arguments.pictures in (None, pictures), f"{pictures} pictures"
    assert arguments.sounds in (None, sounds), f"{sounds} sounds"
    assert page.refreshes == arguments.reloads and len(page.inline["script"]) == 1 + arguments.reloads
    for words in arguments.text:
        assert words in page.text, f"'{words}' is not on the page"


if __name__ == "__main__":
    try:
        main()
    except AssertionError as error:
        sys.exit(f"check_page.py: {error}")
