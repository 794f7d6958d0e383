"""Tests that docs/rooms.md equals the output of cmake/rooms_page.py, and that its examples are those of tests/examples.

    rooms_page_test.py SOURCE
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve()


class RoomsPage(unittest.TestCase):
    def test_page_has_every_room_as_cmake_declares_it(self):
        printed = subprocess.run([SOURCE / "cmake" / "rooms_page.py"], capture_output=True, text=True, check=True).stdout
        declared = sum(path.read_text(encoding="utf-8").count("frustumscreen_room(")
                       for top in ("app", "firmware_host", "assets_baked", "tests/simulators")
                       for path in (SOURCE / top).rglob("CMakeLists.txt"))
        self.assertEqual(printed.count("\n| `"), declared)
        self.assertEqual((SOURCE / "docs" / "rooms.md").read_text(encoding="utf-8"), printed,
                         "run cmake/rooms_page.py > docs/rooms.md")

    def test_room_with_an_example_begins_with_a_header(self):
        page = (SOURCE / "docs" / "rooms.md").read_text(encoding="utf-8")
        begins = dict(re.findall(r"^\| `[^`]+` \| \[(\w+)\]\(#\1\) \| .* \| \[[^]]+\]\(\.\./([^)]+\.h)\) \| [^|]+ \|$", page, re.MULTILINE))
        examples = [file.name.removesuffix("_example.cpp") for file in (SOURCE / "tests" / "examples").glob("*_example.cpp")]
        self.assertGreaterEqual(len(examples), 25)
        self.assertEqual(sorted(begins), sorted(examples))
        for room, header in begins.items():
            self.assertTrue((SOURCE / header).is_file(), f"{room} begins with {header}")
            self.assertIn(f"\n### {room}\n", page)

    def test_examples_of_the_page_are_lines_of_the_tested_files(self):
        page = (SOURCE / "docs" / "rooms.md").read_text(encoding="utf-8")
        sections = re.findall(r"^### (\w+)\n.*?^```cpp\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(sections), 25)
        for room, code in sections:
            tested = {line.strip() for line in (SOURCE / "tests" / "examples" / f"{room}_example.cpp").read_text(encoding="utf-8").splitlines()}
            self.assertIn("EXPECT_", code, room)
            self.assertLessEqual(code.count("\n"), 25, f"{room}: too long to be an example")
            self.assertEqual({line.strip() for line in code.splitlines()} - tested, set(), room)

    def test_reports_missing_parts_in_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            house = pathlib.Path(folder)
            for part in ("cmake", "firmware_host/base", "tests/examples"):
                (house / part).mkdir(parents=True)
            shutil.copy(SOURCE / "cmake" / "rooms_page.py", house / "cmake")
            (house / "firmware_host" / "base" / "result.h").touch()
            room = house / "firmware_host" / "base" / "CMakeLists.txt"
            good = "# Errors.\n# Begin with result.h.\nfrustumscreen_room(base SOURCES a.cpp)\n"
            example = house / "tests" / "examples" / "base_example.cpp"
            shown = "// Shows it.\n    // example\n    use();\n    // end\n"
            for declared, file, lacks in (
                    (good, shown, None),
                    (good.replace("# Errors.\n", ""), shown, "write the purpose of base"),
                    (good.replace("# Begin with result.h.\n", ""), shown, "write the purpose of base"),
                    (good.replace("result.h", "results.h"), shown, "base begins with results.h, which is not there"),
                    (good.replace("(base", "(basis"), shown, "there is no room base"),
                    (good, shown.replace("// end", ""), "tests/examples/base_example.cpp: begin with a comment"),
                    (good, shown.replace("// Shows it.\n", ""), "tests/examples/base_example.cpp: begin with a comment")):
                room.write_text(declared, encoding="utf-8")
                example.write_text(file, encoding="utf-8")
                run = subprocess.run([house / "cmake" / "rooms_page.py"], capture_output=True, text=True, check=False)
                self.assertEqual(run.returncode, 0 if lacks is None else 1, run.stderr)
                self.assertEqual(run.stderr.count("\n"), 0 if lacks is None else 1, run.stderr)
                self.assertIn(lacks or "", run.stderr)


if __name__ == "__main__":
    unittest.main()
