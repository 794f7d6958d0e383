"""Writes the files that the commands of docs/calibration.md read, for the table of true_table.py: touches.csv, rests.csv, corners.csv,
sights.csv and two kept calibrations, calibration/calibration-000N.toml.

    make_points.py FOLDER
"""

import csv
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "calibration"))
from true_table import TrueTable, apply, plus, quaternion, times, turn  # noqa: E402

SENSOR_M = 0.085
TABLE = TrueTable(1920, 0.4)
REPORT = ["tx_m", "ty_m", "tz_m", "qw", "qx", "qy", "qz"]
PLACES = [(u, v) for v in (150, 600, 1050) for u in (200, 720, 1240, 1720)]
TAGS = [(x, y, 0.0) for x in (-0.17, 0.0, 0.17) for y in (-0.11, 0.11)] + [(0.0, 0.0, 0.12)]
EYES = {"left": (-0.02, 0.05, -0.07), "right": (0.04, 0.046, -0.066)}  # in the head's sensor


def report(rotation, place):
    """The tracker's report of a sensor at this pose on the table."""
    return (*TABLE.in_tracker(place), *quaternion(times(turn((0, 0, 1), TABLE.yaw), rotation)))


def touches():
    for number, (u, v) in enumerate(PLACES):
        block = 0.12 if number % 2 else 0.0
        lies = math.pi / 2 if number % 4 == 3 else 0.0  # on a side, which determines the sensor's height
        rotation = times(turn((0, 0, 1), 1.2 * (number % 3) - 1.0), turn((1, 0, 0), lies))
        yield (*report(rotation, plus(TABLE.light(u, v, block), apply(rotation, (0.0, 0.0, SENSOR_M)))), u, v, block)


def rests():
    for number, (u, v) in enumerate(PLACES):
        leans = number % 4 == 3
        block = 0.08 if leans else (0.0, 0.06, 0.12)[number % 3]
        rotation = times(turn((0, 0, 1), 1.2 * (number % 3) - 1.0), turn((1, 0, 0), 0.4 if leans else 0.0))
        bottom = TABLE.light(u, v, block)
        pose = report(rotation, plus(bottom, apply(rotation, (0.0, 0.0, SENSOR_M))))
        for x, y, z in TAGS:
            for corner in ((x + a * 0.025, y + b * 0.025, z) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))):
                pixel = TABLE.pixel(plus(bottom, apply(rotation, corner)))
                if 0 <= pixel[0] <= TABLE.width and 0 <= pixel[1] <= TABLE.height:
                    yield (number, *pose, *corner, *pixel, "" if leans else block)


def corners():
    for distance, height in ((1, 0.0), (2, 0.4)):
        for name, u, v in (("top_left", 0, 0), ("top_right", 1, 0), ("bottom_right", 1, 1), ("bottom_left", 0, 1)):
            yield (distance, name, *TABLE.light(u * TABLE.width, v * TABLE.height, height))


def sights():
    for name, in_sensor in EYES.items():
        for number, (nod, aside) in enumerate(((0.3, 0.0), (0.0, 0.4), (-0.3, 0.0), (0.0, -0.4), (0.3, 0.2), (-0.3, -0.2))):
            tip = (0.04, 0.04, 0.155)
            cross = (0.02 * number - 0.04, 0.2, 0.0)
            way = plus(tip, cross, -1.0)
            rotation = times(turn((0, 0, 1), aside), turn((1, 0, 0), nod - 0.45))
            place = plus(plus(tip, way, 2.0 + 0.1 * number), apply(rotation, in_sensor), -1.0)
            yield (name, *report(rotation, place), *TABLE.pixel(cross), *tip)


def main(folder):
    kept = folder / "calibration"
    kept.mkdir()
    for number in (1, 2):  # one to be undone
        (kept / f"calibration-000{number}.toml").write_text(TABLE.calibration(SENSOR_M), encoding="utf-8")
    for name, head, rows in (("touches", [*REPORT, "u_px", "v_px", "block_m"], touches()),
                             ("rests", ["rest", *REPORT, "x_m", "y_m", "z_m", "u_px", "v_px", "block_m"], rests()),
                             ("corners", ["distance", "corner", "x_m", "y_m", "z_m"], corners()),
                             ("sights", ["eye", *REPORT, "u_px", "v_px", "x_m", "y_m", "z_m"], sights())):
        with open(folder / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows([head, *rows])


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
