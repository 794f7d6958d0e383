"""Finds marks, lines and texts in a plot's SVG, without the code that drew it."""
import re
from xml.etree import ElementTree

SVG = "{http://www.w3.org/2000/svg}"


class Svg:
    def __init__(self, path):
        self.root = ElementTree.parse(path).getroot()  # fails if the XML is not well-formed
        self.groups = {group.get("id"): group for group in self.root.iter(f"{SVG}g") if group.get("id")}

    def texts(self):
        return ["".join(text.itertext()) for text in self.root.iter(f"{SVG}text")]

    def width(self):
        return float(self.root.get("width").removesuffix("pt"))

    def place_of_texts(self, words):
        places = []
        for text in self.root.iter(f"{SVG}text"):
            if "".join(text.itertext()) == words:
                move = re.search(r"translate\(([-\d.]+) ([-\d.]+)\)", text.get("transform", ""))
                places.append((float(move[1]), float(move[2])) if move else (float(text.get("x")), float(text.get("y"))))
        return places

    def marks(self, name):
        """The centres of a series' marks; empty if it has none."""
        group = self.groups.get(name)
        return [] if group is None else [(float(use.get("x")), float(use.get("y"))) for use in group.iter(f"{SVG}use")]

    def line(self, name):
        """The corners of a series' line."""
        path = self.groups[name].find(f"{SVG}path")
        numbers = [] if path is None else [float(number) for number in re.findall(r"-?[\d.]+", path.get("d"))]
        return list(zip(numbers[::2], numbers[1::2]))

    def style(self, name):
        return self.groups[name].find(f"{SVG}path").get("style")

    def ticks(self, panel, axis):
        """{words: pixel} along an axis, 0 for x and 1 for y."""
        found = {}
        area = self.groups[f"axes_{panel + 1}"]
        for group in area.iter(f"{SVG}g"):
            if re.fullmatch(f"{'xy'[axis]}tick_\\d+", group.get("id", "")):
                use = list(group.iter(f"{SVG}use"))[-1]
                words = "".join(next(group.iter(f"{SVG}text")).itertext())
                found[words] = float(use.get("xy"[axis]))
        return found
