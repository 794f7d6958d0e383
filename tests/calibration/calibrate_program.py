"""Tests frustumscreen-calibrate against independent arithmetic and against SciPy's solver, on equal touches.

    calibrate_program.py BIN        BIN: the folder with the programs
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import tomllib

try:
    import numpy as np
    from scipy.optimize import least_squares
    from scipy.spatial.transform import Rotation
except ImportError:
    print("SciPy is not on this machine")
    sys.exit(77)

WIDTH, HEIGHT = 1920, 1200
SENSOR_HEIGHT = 0.06
HEADER = "tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,block_m\n"
NOISE = {"position": 3e-4, "rotation": 2.6e-3, "pixel": 0.5, "block": 1e-4}
PRIOR = {"aspect": 1e-2, "centre_u": 0.10, "centre_v": 0.40, "k1": 0.2, "k2": 0.05, "sensor_height": 5e-4, "boards": 0.05}


class Truth:
    """A projector 1.4 m above the table with lens shift, an arbitrarily rotated tracker, a tilted sensor in the prop."""

    def __init__(self):
        self.fx, self.fy, self.cx, self.cy, self.k1, self.k2 = 2800.0, 2803.0, 970.0, 1010.0, -0.04, 0.01
        self.table_from_j = Rotation.from_euler("xyz", [180 - 3, 2, 1], degrees=True)
        self.lens = np.array([0.02, -0.15, 1.4])
        self.k_from_table = Rotation.from_euler("xyz", [25, -40, 110], degrees=True)
        self.k_origin = np.array([0.3, -0.2, 0.5])
        self.sensor_from_prop = Rotation.from_euler("xyz", [10, 70, -30], degrees=True)
        self.offset = self.sensor_from_prop.apply([-0.012, 0.007, -SENSOR_HEIGHT])

    def lit(self, pixel, height):
        """The place that a pixel lights, by Newton's method in two dimensions."""
        goal = np.array([(pixel[0] - self.cx) / self.fx, (pixel[1] - self.cy) / self.fy])
        x = goal.copy()
        for _ in range(100):
            r2 = x @ x
            x = goal / (1 + self.k1 * r2 + self.k2 * r2 * r2)
        ray = self.table_from_j.apply([x[0], x[1], 1.0])
        return self.lens + ray * ((height - self.lens[2]) / ray[2])

    def touch(self, pixel, block, yaw, random, scale):
        laid = np.asarray(pixel) + scale * NOISE["pixel"] * random.normal(size=2)
        place = self.lit(laid, block)
        table_from_sensor = Rotation.from_euler("z", yaw) * self.sensor_from_prop.inv()
        k_from_sensor = self.k_from_table * table_from_sensor
        t = self.k_from_table.apply(place) + self.k_origin - k_from_sensor.apply(self.offset)
        t = t + scale * NOISE["position"] * random.normal(size=3)
        k_from_sensor = Rotation.from_rotvec(scale * NOISE["rotation"] * random.normal(size=3)) * k_from_sensor
        x, y, z, w = k_from_sensor.as_quat()
        return [*t, w, x, y, z, *pixel, block]


def touches(truth, scale, seed=4):
    random = np.random.default_rng(seed)
    rows = []
    for k in range(12):
        pixel = (80 + (WIDTH - 160) * (k % 4) / 3, 80 + (HEIGHT - 160) * (k // 4) / 2)
        rows.append(truth.touch(pixel, 0.12 if k % 2 else 0.0, 1.5708 * (k % 3), random, scale))
    return np.array(rows)


def run(programs, rows, *options, status=0):
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.write(HEADER + "".join(",".join(repr(float(x)) for x in row) + "\n" for row in rows))
        file.flush()
        done = subprocess.run([programs / "frustumscreen-calibrate", "touch", "--from", file.name, *options],
                              capture_output=True, text=True, check=False)
    assert done.returncode == status, (done.returncode, done.stdout, done.stderr)
    return done


def calibrated(programs, rows, *options, status=0):
    done = run(programs, rows, "--picture", str(WIDTH), str(HEIGHT), "--json", *options, status=status)
    return json.loads(done.stdout)


def pixels_by(found, t, rotation):
    """The pixels that a calibration lights for the tracker's reports."""
    table_from_k = np.array(found["table_from_tracker"]).reshape(4, 4).T
    p = found["projector"]
    j_from_table = np.linalg.inv(np.array(p["table_from_projector"]).reshape(4, 4).T)
    touched = t + rotation.apply(found["sensor_offset_m"])
    q = (j_from_table @ table_from_k @ np.c_[touched, np.ones(len(touched))].T)[:3].T
    x = q[:, :2] / q[:, 2:]
    r2 = np.sum(x * x, axis=1)[:, None]
    x = x * (1 + p["k1"] * r2 + p["k2"] * r2 * r2)
    return x * [p["fx"], p["fy"]] + [p["cx"], p["cy"]]


def model_of(v):
    """SciPy's unknowns: focal lengths, centre, lens, pose of J from K, offset, table's normal and offset."""
    normal = np.array([v[15], v[16], 1.0])
    return {"f": np.exp(v[0:2]), "c": v[2:4], "k": v[4:6], "turn": Rotation.from_rotvec(v[6:9]), "shift": v[9:12],
            "offset": v[12:15], "normal": normal / np.linalg.norm(normal), "table": v[17]}


def seen(m, point, frame):
    q = m["turn"].apply(point) + m["shift"]
    x = q[:, :2] / q[:, 2:]
    r2 = np.sum(x * x, axis=1)[:, None]
    pixel = x * (1 + m["k"][0] * r2 + m["k"][1] * r2 * r2) * m["f"] + m["c"]
    return np.c_[pixel, point @ frame @ m["normal"] + m["table"]]


def by_scipy(rows, truth):
    """The same least-squares problem by SciPy with numerical derivatives, starting near the truth."""
    rotation = Rotation.from_quat(rows[:, [4, 5, 6, 3]])
    t = rows[:, :3]
    frame = truth.k_from_table.as_matrix()  # so that the normal is near z
    goal = rows[:, 7:10]

    def whitening(v):
        m = model_of(v)
        arm = rotation.apply(m["offset"])
        step = 1e-6
        by_point = np.stack([(seen(m, t + arm + step * e, frame) - seen(m, t + arm - step * e, frame)) / (2 * step)
                             for e in np.eye(3)], axis=2)
        out = []
        for j, a in zip(by_point, arm):
            cross = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
            noise = NOISE["position"] ** 2 * np.eye(3) + NOISE["rotation"] ** 2 * cross @ cross.T
            covariance = j @ noise @ j.T + np.diag([NOISE["pixel"] ** 2] * 2 + [NOISE["block"] ** 2])
            out.append(np.linalg.inv(np.linalg.cholesky(covariance)))
        return out

    def residuals(v, white):
        m = model_of(v)
        arm = rotation.apply(m["offset"])
        off = seen(m, t + arm, frame) - goal * [1, 1, 1 + v[18]]  # v[18]: how far the boards' true height differs from the given one
        up = frame @ m["normal"]
        return np.concatenate([np.concatenate([w @ r for w, r in zip(white, off)]),
                               [(v[0] - v[1]) / PRIOR["aspect"],
                                (v[2] / WIDTH - 0.5) / PRIOR["centre_u"],
                                (v[3] - 0.5 * HEIGHT) / WIDTH / PRIOR["centre_v"],
                                v[4] / PRIOR["k1"], v[5] / PRIOR["k2"], v[18] / PRIOR["boards"],
                                (-np.mean(arm @ up) - SENSOR_HEIGHT) / PRIOR["sensor_height"]]])

    turn = truth.table_from_j.inv() * truth.k_from_table.inv()
    shift = -turn.apply(truth.k_from_table.apply(truth.lens) + truth.k_origin)
    v = np.concatenate([np.log([truth.fx, truth.fx]), [truth.cx, truth.cy, 0, 0], turn.as_rotvec(), shift,
                        truth.offset, [0, 0, -truth.k_origin @ frame[:, 2], 0]])
    for _ in range(4):
        white = whitening(v)
        v = least_squares(residuals, v, args=(white,), x_scale="jac", xtol=1e-14, ftol=1e-14, gtol=1e-14).x
    m = model_of(v)
    arm = rotation.apply(m["offset"])
    return m, seen(m, t + arm, frame)[:, :2], t, rotation, frame


def test_exact_without_noise(programs):
    truth = Truth()
    rows = touches(truth, 0.0)
    found = calibrated(programs, rows, "--sensor-height", str(SENSOR_HEIGHT))
    assert found["verdict"] == "good", found
    assert found["repeat"] == []
    off = pixels_by(found, rows[:, :3], Rotation.from_quat(rows[:, [4, 5, 6, 3]])) - rows[:, 7:9]
    assert np.abs(off).max() < 0.05, off  # the priors add a small bias
    assert abs(found["projector"]["fx"] / truth.fx - 1) < 2e-3
    middle = np.array(found["projector"]["table_from_projector"]).reshape(4, 4).T
    assert abs(middle[2, 3] - truth.lens[2]) < 3e-3
    assert np.abs(np.array(found["sensor_offset_m"]) - truth.offset).max() < 1e-3


def test_matches_scipy(programs):
    truth = Truth()
    for seed in (4, 5, 6):
        rows = touches(truth, 1.0, seed)
        found = calibrated(programs, rows, "--sensor-height", str(SENSOR_HEIGHT))
        m, pixels, t, rotation, frame = by_scipy(rows, truth)
        off = np.abs(pixels_by(found, t, rotation) - pixels).max()
        print(f"seed {seed}: the two solvers' pixels are {off:.2e} apart; focal lengths {found['projector']['fx']:.3f}, "
              f"{m['f'][0]:.3f}")
        assert off < 2e-3, off
        assert abs(found["projector"]["fx"] / m["f"][0] - 1) < 1e-5
        assert abs(found["projector"]["k1"] - m["k"][0]) < 1e-5
        assert np.abs(np.array(found["sensor_offset_m"]) - m["offset"]).max() < 1e-6


def test_refused(programs):
    rows = touches(Truth(), 1.0)
    known = ("--sensor-height", str(SENSOR_HEIGHT))
    flat = rows.copy()
    flat[:, 9] = 0.0
    found = calibrated(programs, flat, *known, status=1)
    assert found["verdict"] == "refused" and found["projector"] is None, found
    found = calibrated(programs, rows, status=1)
    assert found["verdict"] == "refused" and "--sensor-height" in found["reason"], found
    slipped = rows.copy()
    slipped[4, :3] += [0.02, 0.01, 0.0]
    found = calibrated(programs, slipped, *known, status=1)
    assert found["verdict"] == "repeat" and found["repeat"] == [5], found  # rows are counted from 1
    assert found["projector"] is not None
    exchanged = rows.copy()
    exchanged[[2, 7], :7] = exchanged[[7, 2], :7]
    found = calibrated(programs, exchanged, *known, status=1)
    assert found["verdict"] == "repeat" and found["repeat"] == [3, 8], found


def test_command_line(programs):
    rows = touches(Truth(), 1.0)
    done = run(programs, rows, "--picture", str(WIDTH), str(HEIGHT), "--sensor-height", str(SENSOR_HEIGHT))
    assert done.stdout.startswith(("good: ", "usable: ")), done.stdout
    assert run(programs, rows, status=2).stdout == ""
    assert "--picture" in run(programs, rows, status=2).stderr
    run(programs, rows, "--picture", "0", "1200", status=2)
    below = run(programs, rows, "--picture", str(WIDTH), str(HEIGHT), "--sensor-height", "-0.085", status=1)
    assert below.stderr.endswith("[calibrate.sensor_below_table]\n"), below.stderr


def test_corners(programs):
    """With a ruler that seems exact: the projector, the effect of 1 mm on its picture, and a map of that effect."""
    truth = Truth()
    truth.k1 = truth.k2 = 0.0
    rows = [(distance, name, *truth.lit(pixel, height)) for distance, height in ((1, 0.0), (2, 0.4))
            for name, pixel in (("top_left", (0, 0)), ("top_right", (WIDTH, 0)), ("bottom_right", (WIDTH, HEIGHT)), ("bottom_left", (0, HEIGHT)))]

    def corners(rows, *options, status=0):
        file.write_text("distance,corner,x_m,y_m,z_m\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))
        done = subprocess.run([programs / "frustumscreen-calibrate", "corners", "--from", file, "--picture", str(WIDTH), str(HEIGHT),
                               "--map", picture, *options], capture_output=True, text=True, check=False)
        assert done.returncode == status, (done.returncode, done.stdout, done.stderr)
        return done.stdout

    with tempfile.TemporaryDirectory() as folder:
        file, picture = (pathlib.Path(folder) / name for name in ("corners.csv", "map.png"))
        found = json.loads(corners(rows, "--json"))
        assert abs(found["projector"]["fx"] / truth.fx - 1) < 1e-6, found
        assert found["ruler_mm"] == 1.0 and 0.3 < found["uncertainty_mm"]["mean"] < found["uncertainty_mm"]["worst"] < 5.0, found
        assert struct.unpack(">II", picture.read_bytes()[16:24]) == (1600, 900)
        assert "measured to 1.0 mm" in corners(rows)
        picture.unlink()
        refused = json.loads(corners(rows[:4], "--json", status=1))
        assert refused["uncertainty_mm"] is None and not picture.exists(), refused
        within = found["within_mm"]
        assert 0.3 < within["places_68"] < within["places_95"] < within["worst_place_95"] < 15.0, within
        wrong = [row if row[:2] != (2, "bottom_left") else (*row[:2], row[2] + 0.03, row[3] - 0.04, row[4]) for row in rows]
        refused = json.loads(corners(wrong, "--json", status=1))
        assert refused["verdict"] == "refused" and "the bottom left corner" in refused["reason"], refused
        assert refused["repeat"] == [4, 8] and refused["projector"] is None, refused
        text = corners(rows)
        assert "in the frame that the corners were measured in" in text and "of its picture's middle" in text, text


def test_corners_are_kept(programs):
    """The kept projector is in the settings' frame: the picture's middle is lit where the settings say, wherever the ruler's origin was."""
    truth = Truth()
    truth.k1 = truth.k2 = 0.0
    rows = [(distance, name, *(truth.lit(pixel, height) + np.array([1.0, -2.0, 0.0])))
            for distance, height in ((1, 0.0), (2, 0.4))
            for name, pixel in (("top_left", (0, 0)), ("top_right", (WIDTH, 0)), ("bottom_right", (WIDTH, HEIGHT)), ("bottom_left", (0, HEIGHT)))]
    with tempfile.TemporaryDirectory() as folder:
        file, config = (pathlib.Path(folder) / name for name in ("corners.csv", "kiosk.toml"))
        file.write_text("distance,corner,x_m,y_m,z_m\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))
        config.write_text(f'[projector]\nwidth = {WIDTH}\nheight = {HEIGHT}\n[calibration]\nfolder = "kept"\n')
        words = [programs / "frustumscreen-calibrate", "corners", "--from", file, "--config", config, "--keep"]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        assert done.returncode == 0 and "kept as" in done.stderr, (done.stdout, done.stderr)
        kept = tomllib.loads((pathlib.Path(folder) / "kept/calibration-0001.toml").read_text())
        assert kept["method"] == "corners" and kept["places"] == 8, kept
        projector = kept["projector"]
        pose = np.array(projector["table_from_projector"]).reshape(4, 4).T
        middle = np.array([(WIDTH / 2 - projector["cx"]) / projector["fx"], (HEIGHT / 2 - projector["cy"]) / projector["fy"], 1.0])
        ray = pose[:3, :3] @ middle
        light = pose[:3, 3] - ray * pose[2, 3] / ray[2]
        assert np.abs(light).max() < 1e-6, light


def main():
    programs = pathlib.Path(sys.argv[1])
    for test in (test_exact_without_noise, test_matches_scipy, test_refused, test_command_line, test_corners, test_corners_are_kept):
        test(programs)
        print(f"{test.__name__}: well")


if __name__ == "__main__":
    main()
