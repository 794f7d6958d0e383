"""docs/rooms.md is what cmake/rooms_page.py prints.

    rooms_page_test.py SOURCE
"""

import pathlib
import subprocess
import sys
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


if __name__ == "__main__":
    unittest.main()
