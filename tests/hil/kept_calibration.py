"""A kept calibration, written by hand, that equals the usual settings; and commands for the guest that install and remove it."""

import base64
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "calibration"))
from true_table import by_columns, turn  # pylint: disable=wrong-import-position

FOLDER = "/var/lib/frustumscreen/calibration"
FILE = f"{FOLDER}/calibration-0001.toml"
FOCAL_PX, ABOVE_M = 1200.0, 1.5  # the projector, as in the settings
DOWN = ((1, 0, 0), (0, -1, 0), (0, 0, -1))
STRAIGHT = by_columns(turn((0, 0, 1), 0.0), (0.0, 0.0, 0.0))
TEXT = (f'version = 1\nmade = "2026-11-01"\nmethod = "touch"\nplaces = 9\n[residual]\nmean_mm = 0.0\nworst_mm = 0.0\nmean_px = 0.0\n'
        f"[projector]\nwidth = 640\nheight = 400\nfx = {FOCAL_PX}\nfy = {FOCAL_PX}\ncx = 320.0\ncy = 200.0\nk1 = 0.0\nk2 = 0.0\n"
        f"table_from_projector = {by_columns(DOWN, (0.0, 0.0, ABOVE_M))}\n"
        f"[tracker]\ntable_from_tracker = {STRAIGHT}\nsensor_from_prop = {STRAIGHT}\neye_in_sensor_m = [0.0, 0.0, 0.0]\n")

KEEP = f"mkdir -p {FOLDER}; echo {base64.b64encode(TEXT.encode()).decode()} | base64 -d > {FILE}"
FORGET = f"rm -rf {FOLDER}/*"
