"""Tests frustumscreen-calibrate auto against independent arithmetic and against SciPy's solver, on equal rests.

SciPy also solves for the error of every tracker report, with six unknowns each; the program marginalises these errors in its covariances.

    auto_program.py BIN        BIN: the folder with the programs
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from scipy.optimize import least_squares
    from scipy.spatial.transform import Rotation
except ImportError:
    print("SciPy is not on this machine")
    sys.exit(77)

from calibrate_program import HEIGHT, PRIOR, WIDTH, Truth, model_of, pixels_by, seen

HEADER = "rest,tx_m,ty_m,tz_m,qw,qx,qy,qz,x_m,y_m,z_m,u_px,v_px,block_m\n"
PRINT = 2e-3
NOISE = {"position": 3e-4, "rotation": 2.6e-3, "pixel": 0.15, "block": 1e-4}
BOTTOM = np.array([[0.05, 0, 0], [-0.025, 0.0433, 0], [-0.025, -0.0433, 0]])


def sheet():
    tags = [(x, y, 0.0, 0.025) for x in (-0.17, 0, 0.17) for y in (-0.11, 0.11)] + [(0, 0, 0.12, 0.03)]
    return np.array([[x + a * s, y + b * s, z] for x, y, z, s in tags for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])


def project(truth, places):
    q = truth.table_from_j.inv().apply(places - truth.lens)
    x = q[:, :2] / q[:, 2:]
    r2 = np.sum(x * x, axis=1)[:, None]
    return x * (1 + truth.k1 * r2 + truth.k2 * r2 * r2) * [truth.fx, truth.fy] + [truth.cx, truth.cy]


class Rest:
    def __init__(self, name, truth, random, scale):
        self.name = name
        leans = name % 4 == 3
        self.block = None if leans else (0.0, 0.06, 0.12)[name % 3]
        turn = Rotation.from_euler("zx", [random.uniform(0, 6.28), 0.4 if leans else 0.0])
        pixel = (200 + (WIDTH - 400) * (name % 4) / 3, 150 + (HEIGHT - 300) * (name // 4) / 2)
        bottom = truth.lit(pixel, 0.08 if leans else self.block)
        k_from_sensor = truth.k_from_table * turn * truth.sensor_from_prop.inv()
        t = truth.k_from_table.apply(bottom) + truth.k_origin - k_from_sensor.apply(truth.offset)
        self.t = t + scale * NOISE["position"] * random.normal(size=3)
        self.turn = Rotation.from_rotvec(scale * NOISE["rotation"] * random.normal(size=3)) * k_from_sensor
        points = sheet()
        pixels = project(truth, turn.apply(points) + bottom) + scale * NOISE["pixel"] * random.normal(size=(len(points), 2))
        inside = (pixels >= 0).all(axis=1) & (pixels[:, 0] <= WIDTH) & (pixels[:, 1] <= HEIGHT)
        self.points, self.pixels = points[inside], pixels[inside]

    def rows(self):
        x, y, z, w = self.turn.as_quat()
        block = "" if self.block is None else repr(self.block)
        pose = ",".join(repr(float(n)) for n in [*self.t, w, x, y, z])
        return "".join(f"{self.name},{pose}," + ",".join(repr(float(n)) for n in [*p, *uv]) + f",{block}\n"
                       for p, uv in zip(self.points, self.pixels))


def rests_of(truth, scale, seed=4):
    random = np.random.default_rng(seed)
    return [Rest(k, truth, random, scale) for k in range(12)]


def run(programs, text, *options, status=0):
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.write(text)
        file.flush()
        done = subprocess.run([programs / "frustumscreen-calibrate", "auto", "--from", file.name, *options],
                              capture_output=True, text=True, check=False)
    assert done.returncode == status, (done.returncode, done.stdout, done.stderr)
    return done


def calibrated(programs, rests, status=0):
    text = HEADER + "".join(rest.rows() for rest in rests)
    return json.loads(run(programs, text, "--picture", str(WIDTH), str(HEIGHT), "--json", status=status).stdout)


def by_scipy(rests, truth, pixel_noise):
    """Solves for projector, table, sensor and every rest's pose error at once, starting near the truth."""
    frame = truth.k_from_table.as_matrix()  # so that the table's normal is near z
    near_turn = truth.sensor_from_prop

    def residuals(v):
        m = model_of(v)
        prop = Rotation.from_rotvec(v[18:21]) * near_turn
        out = [(v[0] - v[1]) / PRIOR["aspect"], (v[2] / WIDTH - 0.5) / PRIOR["centre_u"],
               (v[3] - 0.5 * HEIGHT) / WIDTH / PRIOR["centre_v"], v[4] / PRIOR["k1"], v[5] / PRIOR["k2"], v[21] / PRINT, v[22] / PRIOR["boards"]]
        size = [np.exp(v[21]), np.exp(v[21]), 1]
        for rest, error in zip(rests, v[23:].reshape(-1, 6)):
            turn = Rotation.from_rotvec(NOISE["rotation"] * error[3:]) * rest.turn
            t = rest.t + NOISE["position"] * error[:3]
            off = seen(m, turn.apply(m["offset"] + prop.apply(rest.points * size)) + t, frame)[:, :2] - rest.pixels
            out.extend(off.ravel() / pixel_noise)
            out.extend(error)
            if rest.block is not None:
                height = seen(m, turn.apply(m["offset"] + prop.apply(BOTTOM)) + t, frame)[:, 2]
                out.extend((height - (1 + v[22]) * rest.block) / NOISE["block"])
        return np.array(out)

    turn = truth.table_from_j.inv() * truth.k_from_table.inv()
    shift = -turn.apply(truth.k_from_table.apply(truth.lens) + truth.k_origin)
    v = np.concatenate([np.log([truth.fx, truth.fx]), [truth.cx, truth.cy, 0, 0], turn.as_rotvec(), shift,
                        truth.offset, [0, 0, -truth.k_origin @ frame[:, 2]], np.zeros(5 + 6 * len(rests))])
    v = least_squares(residuals, v, x_scale="jac", xtol=1e-13, ftol=1e-13, gtol=1e-13).x
    m = model_of(v)
    t = np.array([rest.t for rest in rests])
    turns = Rotation.concatenate([rest.turn for rest in rests])
    return m, Rotation.from_rotvec(v[18:21]) * near_turn, seen(m, t + turns.apply(m["offset"]), frame)[:, :2], t, turns


def test_exact_without_noise(programs):
    truth = Truth()
    found = calibrated(programs, rests_of(truth, 0.0))
    assert found["verdict"] == "good" and found["repeat"] == [], found
    assert abs(found["projector"]["fx"] / truth.fx - 1) < 2e-4
    sensor_from_prop = np.array(found["sensor_from_prop"]).reshape(4, 4).T
    assert np.abs(sensor_from_prop[:3, :3] - truth.sensor_from_prop.as_matrix()).max() < 1e-4
    assert np.abs(sensor_from_prop[:3, 3] - truth.offset).max() < 1e-4
    assert np.abs(np.array(found["sensor_offset_m"]) - truth.offset).max() < 1e-4
    assert found["residual_mm"]["worst"] < 0.02, found["residual_mm"]


def test_matches_scipy(programs):
    truth = Truth()
    for seed in (4, 5):
        rests = rests_of(truth, 1.0, seed)
        found = calibrated(programs, rests)
        assert found["verdict"] in ("good", "usable"), found["reason"]
        m, prop, pixels, t, turns = by_scipy(rests, truth, found["pixel_noise_px"])
        off = np.abs(pixels_by(found, t, turns) - pixels).max()
        turned = np.abs(np.array(found["sensor_from_prop"]).reshape(4, 4).T[:3, :3] - prop.as_matrix()).max()
        print(f"seed {seed}: the two solvers' pixels are {off:.2e} apart, the prop's turn {turned:.2e}; noise "
              f"{found['pixel_noise_px']:.3f} px")
        assert off < 0.03, off  # the program's covariances are linear in the tracker's error
        assert turned < 2e-5, turned
        assert abs(found["projector"]["fx"] / m["f"][0] - 1) < 2e-4


def test_wrong_data(programs):
    truth = Truth()
    rests = rests_of(truth, 1.0)
    rests[5].t = rests[5].t + [0.02, 0.01, 0.0]
    found = calibrated(programs, rests, status=1)
    assert found["verdict"] == "repeat" and found["repeat"] == [5], (found["verdict"], found["reason"], found["repeat"])
    rests = rests_of(truth, 1.0)
    random = np.random.default_rng(1)
    for rest in rests:
        wrong = random.choice(len(rest.pixels), len(rest.pixels) * 3 // 10, replace=False)
        rest.pixels[wrong] = random.uniform([0, 0], [WIDTH, HEIGHT], (len(wrong), 2))
    found = calibrated(programs, rests)
    clean = calibrated(programs, rests_of(truth, 1.0))
    t = np.array([rest.t for rest in rests])
    turns = Rotation.concatenate([rest.turn for rest in rests])
    off = np.abs(pixels_by(found, t, turns) - pixels_by(clean, t, turns)).max()
    print(f"with three of ten points wrong, the answer moves by {off:.2f} pixels")
    assert off < 0.5, off


def test_command_line(programs):
    picture = ("--picture", str(WIDTH), str(HEIGHT))
    text = HEADER + "".join(rest.rows() for rest in rests_of(Truth(), 1.0))
    done = run(programs, text, *picture)
    assert done.stdout.startswith(("good: ", "usable: ")), done.stdout
    assert "--picture" in run(programs, text, status=2).stderr
    lines = text.splitlines()
    for number, change, word in ((0, lambda row: row.replace("block_m", "block"), "header"),
                                 (3, lambda row: row + ",1", "fields"),
                                 (3, lambda row: row.replace("0,", "x,", 1), "rest is"),
                                 (3, lambda row: row.replace(row.split(",")[1], "0.5"), "rest 0"),
                                 (3, lambda row: row.replace(row.split(",")[-2], "nan"), "finite")):
        bad = "\n".join([*lines[:number], change(lines[number]), *lines[number + 1:]]) + "\n"
        done = run(programs, bad, *picture, status=1)
        assert done.stderr.count("\n") == 1 and word in done.stderr, (word, done.stderr)


def test_map(programs):
    """--map draws a picture of the size that the page gives, also with JSON; none for refused rests, whose reason is printed."""
    picture = ("--picture", str(WIDTH), str(HEIGHT))
    text = HEADER + "".join(rest.rows() for rest in rests_of(Truth(), 1.0))
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "map.png"
        run(programs, text, *picture, "--json", "--map", file)
        assert struct.unpack(">II", file.read_bytes()[16:24]) == (1600, 900)
        file.unlink()
        few = HEADER + "".join(rest.rows() for rest in rests_of(Truth(), 1.0)[:3])
        run(programs, few, *picture, "--map", file, status=1)
        assert not file.exists()


def main():
    programs = pathlib.Path(sys.argv[1])
    for test in (test_exact_without_noise, test_matches_scipy, test_wrong_data, test_command_line, test_map):
        test(programs)
        print(f"{test.__name__}: well")


if __name__ == "__main__":
    main()
