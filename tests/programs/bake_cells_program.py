"""Tests `frustumscreen-bake` on a chest whose lid turns by an animation: counts and poses of the cells, against values computed here.

    bake_cells_program.py PROGRAMS

The pack is read here as a ZIP file with a manifest in JSON, without the code of the programs.
"""

import base64
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() / "frustumscreen-bake"


def box(low, high):
    """Positions of 8 corners and indices of 12 triangles."""
    corners = [[(low, high)[k >> axis & 1][axis] for axis in range(3)] for k in range(8)]
    quads = [(1, 3, 7, 5), (2, 0, 4, 6), (3, 2, 6, 7), (0, 1, 5, 4), (4, 5, 7, 6), (2, 3, 1, 0)]
    return corners, [index for a, b, c, d in quads for index in (a, b, c, a, c, d)]


CHEST = box((-1, 0, -2), (1, 1, 2))
LID = box((-2, 0, -2), (0, 0.2, 2))  # hangs from a hinge at its right side
HINGE = [1, 1.01, 0]
TIMES = [0.0, 0.5, 2.0]
ANGLES = [0.0, 30.0, 110.0]


def gltf():
    """The scene: a chest with a child, a hinge that has the lid's mesh. The animation turns the hinge about z."""
    document = {"asset": {"version": "2.0"}, "buffers": [], "bufferViews": [], "accessors": [],
                "meshes": [], "scene": 0, "scenes": [{"nodes": [0]}],
                "nodes": [{"name": "chest", "mesh": 0, "children": [1], "scale": [0.1, 0.1, 0.1]},
                          {"name": "lid", "mesh": 1, "translation": HINGE}]}
    data = b""

    def accessor(kind, component, numbers, each):
        nonlocal data
        packed = struct.pack(f"<{len(numbers)}{component}", *numbers)
        document["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        document["accessors"].append({"bufferView": len(document["bufferViews"]) - 1, "type": kind, "count": len(numbers) // each,
                                      "componentType": {"f": 5126, "H": 5123}[component]})
        data += packed + bytes(-len(packed) % 4)
        return len(document["accessors"]) - 1

    for corners, indices in (CHEST, LID):
        positions = accessor("VEC3", "f", [value for corner in corners for value in corner], 3)
        document["meshes"].append({"primitives": [{"attributes": {"POSITION": positions}, "indices": accessor("SCALAR", "H", indices, 1)}]})
    turns = [value for angle in ANGLES for value in (0, 0, math.sin(math.radians(angle) / 2), math.cos(math.radians(angle) / 2))]
    document["animations"] = [{"name": "open", "samplers": [{"input": accessor("SCALAR", "f", TIMES, 1), "output": accessor("VEC4", "f", turns, 4)}],
                               "channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}]}]
    document["buffers"] = [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]
    return document


def still_after(stiffness, damping):
    """Seconds after which the spring stays within a thousandth of the way from its end, by small steps."""
    x, v, step, last = 0.0, 0.0, 1e-4, 0.0
    for k in range(200000):
        v += (stiffness * (1 - x) - damping * v) * step
        x += v * step
        if abs(x - 1) > 1e-3:
            last = k * step
    return last


class BakeCells(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)
        (self.folder / "chest.gltf").write_text(json.dumps(gltf()))

    def bake(self, *more, given="chest.gltf", status=0):
        """The report of a bake, or its messages on standard error."""
        command = [PROGRAM, given, "-o", "chest.fspack", "--size", "32", "--turn", "0", "--no-relief", "--speech", "none", "--json", *more]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, status, done.stderr)
        return json.loads(done.stdout) if status == 0 else done.stderr

    def manifest(self, file="chest.fspack"):
        with zipfile.ZipFile(self.folder / file) as pack:
            return json.loads(pack.read("manifest.json")), pack.namelist()

    def sections(self):
        manifest, _ = self.manifest()
        sections = manifest["sections"]
        return sections if isinstance(sections, dict) else {each["name"]: each for each in sections}

    def test_the_lid_and_the_chest_are_cells(self):
        report = self.bake()
        self.assertEqual(report["cells"]["taken"], "nodes")
        self.assertEqual(report["cells"]["cells"], [{"name": "chest", "triangles": 12}, {"name": "lid", "triangles": 12}])
        self.assertEqual(report["cells"]["behaviours"], [{"name": "open", "seconds": 2.0, "trigger": "button"}])
        self.assertEqual(report["lost"], [])
        manifest, names = self.manifest()
        self.assertEqual([name for name in names if name.endswith(".fspack")], ["cells/0.fspack", "cells/1.fspack"])
        self.assertEqual(manifest["provenance"]["source_triangles"], 24)
        cells = self.sections()["cells"]["data"]["cells"]
        self.assertEqual([cell["parent"] for cell in cells], [None, 0])
        self.assertEqual(cells[1]["translation"], HINGE)
        # The file's y goes up in the box, and its longest edge, 0.4 along z, is 1.
        for cell, (corners, _), at in ((cells[0], CHEST, [0, 0, 0]), (cells[1], LID, HINGE)):
            moved = [[(corner[k] + at[k]) / 4 for k in range(3)] for corner in corners]
            heights = [corner[1] for corner in moved]
            self.assertAlmostEqual(cell["low"][2], min(heights), places=6)
            self.assertAlmostEqual(cell["high"][2], max(heights), places=6)
            self.assertEqual(cell["triangles"], 12)

    def test_reports_lost_movement_without_cells(self):
        with_cells = self.bake()
        report = self.bake("--cells", "none")
        self.assertEqual((report["cells"]["taken"], report["cells"]["cells"]), ("none", []))
        self.assertEqual(report["lost"], ["the movement of its parts, since --cells none says so"])
        self.assertEqual(report["levels"], with_cells["levels"], "the whole is the same either way")
        self.assertNotIn("cells", self.sections())
        self.assertIn("would be lost", self.bake("--cells", "none", "--strict", status=1))

    def test_a_still_model_has_cells_only_if_asked_for(self):
        still = gltf()
        del still["animations"]
        (self.folder / "chest.gltf").write_text(json.dumps(still))
        self.assertEqual(self.bake()["cells"]["taken"], "none")
        report = self.bake("--cells", "nodes")
        self.assertEqual([cell["name"] for cell in report["cells"]["cells"]], ["chest", "lid"])
        self.assertEqual(report["cells"]["behaviours"], [])

    def test_auto_uses_cells_only_when_they_pay_off(self):
        report = self.bake("--cells", "auto")
        self.assertEqual(report["cells"]["taken"], "nodes", "its animation needs them")
        still = gltf()
        del still["animations"]
        (self.folder / "chest.gltf").write_text(json.dumps(still))
        report = self.bake("--cells", "auto")
        self.assertEqual((report["cells"]["taken"], report["cells"]["cells"]), ("none", []))
        self.assertRegex(report["cells"]["why"], r"^one cell: \d+\.\d floors whole, at least \d+\.\d in cells$")
        self.assertNotIn("cells", self.sections())

    def test_rejects_unknown_cells_option(self):
        self.assertIn("--cells", self.bake("--cells", "some", status=2))

    def test_a_check_lists_parts_and_animations(self):
        done = subprocess.run([PROGRAM, "--check", "chest.gltf", "--json"], cwd=self.folder, capture_output=True, text=True, check=True)
        scan = json.loads(done.stdout)["scans"][0]
        self.assertEqual((scan["parts"], scan["animations"]), (["chest", "lid"], ["open"]))

    def test_reads_behaviours_from_artifact_toml(self):
        lines = ['scan = "chest.gltf"', "[[texts]]", 'language = "en"', 'title = "Chest"',
                 "[[behaviours]]", 'name = "turn the lid"', 'animation = "open"', 'trigger = "arrival"', 'titles = { en = "Turn the lid" }',
                 "[[behaviours]]", 'name = "spring"', 'cell = "lid"', "spring = { axis = [0, 0, 2], reach_mm = 50, stiffness = 50, damping = 5 }",
                 "[[behaviours]]", 'name = "glow"', 'cell = "chest"', "light = [2, 1.5, 1]", "seconds = 3", "stays = true"]
        file = self.folder / "artifact.toml"
        file.write_text("\n".join(lines))
        report = self.bake(given=".")
        self.assertEqual([each["name"] for each in report["cells"]["behaviours"]], ["turn the lid", "spring", "glow"])
        self.assertEqual([each["trigger"] for each in report["cells"]["behaviours"]], ["arrival", "button", "button"])
        behaviours = self.sections()["behaviours"]["data"]["behaviours"]
        self.assertEqual(behaviours[0]["titles"], [{"language": "en", "text": "Turn the lid"}])
        spring = behaviours[1]["springs"][0]
        self.assertEqual((spring["cell"], spring["axis"], spring["turns"]), (1, [0, 0, 1], False))
        self.assertAlmostEqual(spring["reach"], 0.5, msg="50 mm in a frame that is scaled by 0.1")
        still_s = still_after(50, 5)
        self.assertTrue(still_s <= behaviours[1]["seconds"] <= 2 * still_s, (still_s, behaviours[1]["seconds"]))
        self.assertEqual(behaviours[2]["seconds"], 3)
        self.assertTrue(behaviours[2]["stays"])
        for wrong, words in (('animation = "opne"', "the model has no animation 'opne' that moves parts; it has open"),
                             ('cell = "lit"\npendulum = { axis = [1, 0, 0] }', "the model has no part 'lit'; it has chest, lid")):
            file.write_text("\n".join(lines[:4] + ["[[behaviours]]", 'name = "x"', wrong]))
            said = self.bake(given=".", status=1)
            self.assertIn("artifact.toml:6: behaviours[0].name: " + words, said)
            self.assertEqual(said.count("\n"), 1)


    def test_typesets_titles_of_behaviours_in_each_language(self):
        titles = {"en": "Turn the lid", "ar": "أدر الغطاء", "th": "หมุนฝา", "de": "Den Deckel drehen"}
        flat = gltf()  # a part of no height, whose light nobody would see
        flat["nodes"].append({"name": "flat", "mesh": 1, "scale": [1, 0, 1]})
        flat["nodes"][0]["children"].append(2)
        (self.folder / "chest.gltf").write_text(json.dumps(flat))
        lines = ['scan = "chest.gltf"']
        for language in titles:
            lines += ["[[texts]]", f'language = "{language}"', 'title = "1"']
        told = ", ".join(f'{language} = "{text}"' for language, text in titles.items())
        lines += ["[[behaviours]]", 'name = "glow"', 'cell = "flat"', "light = [2, 2, 2]", "titles = { en = \"Glow\" }",
                  "[[behaviours]]", 'name = "lid"', 'animation = "open"', f"titles = {{ {told} }}"]
        (self.folder / "artifact.toml").write_text("\n".join(lines), encoding="utf-8")
        report = self.bake(given=".")
        self.assertEqual([each["name"] for each in report["cells"]["behaviours"]], ["lid"])
        there = {each["language"] for each in self.sections()["texts"]["data"]["languages"]}
        missing = [language for language in titles if any(f"texts in '{language}'" in lost for lost in report["lost"])]
        self.assertEqual(there, set(titles) - set(missing), report["lost"])
        with zipfile.ZipFile(self.folder / "chest.fspack") as pack:
            for language in there:
                runs = pack.read(f"texts/{language}/glyphs.bin")
                self.assertEqual((runs.count(b"behaviour.0"), runs.count(b"behaviour.")), (1, 1), language)
        self.bake("--cells", "none", given=".")
        with zipfile.ZipFile(self.folder / "chest.fspack") as pack:
            self.assertNotIn(b"behaviour.", pack.read("texts/en/glyphs.bin"))


if __name__ == "__main__":
    unittest.main()
