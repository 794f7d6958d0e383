"""Tests frustumscreen-calibrate eye against SciPy's solver on equal sightings, its kept result, and its bad inputs.

    eye_program.py BIN SOURCES        BIN: the folder with the programs; SOURCES: the project's
"""

import json
import pathlib
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

HEADER = "eye,tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,x_m,y_m,z_m\n"
LEFT, RIGHT = np.array([-0.01, 0.05, -0.07]), np.array([0.05, 0.045, -0.075])


class Table:
    """The settings' projector and tracker."""

    def __init__(self, settings):
        p, t = settings["projector"], settings["tracker"]
        self.f, self.c = np.array([p["fx"], p["fy"]]), np.array([p["cx"], p["cy"]])
        self.from_j = np.array(p["table_from_projector"]).reshape(4, 4).T
        self.from_k = np.array(t["table_from_tracker"]).reshape(4, 4).T
        self.j_from = np.linalg.inv(self.from_j)

    def pixel(self, point):
        q = self.j_from @ [*point, 1.0]
        return q[:2] / q[2] * self.f + self.c

    def cross(self, pixel):
        ray = self.from_j[:3, :3] @ [*((pixel - self.c) / self.f), 1.0]
        lens = self.from_j[:3, 3]
        return lens - ray * lens[2] / ray[2]


def sightings(table, random, noise):
    """The file's rows, without the eye's name."""
    names, rows = [], []
    k_from_table = np.linalg.inv(table.from_k)
    for name, eye in (("left", LEFT), ("right", RIGHT)):
        for _ in range(7):
            tip = np.array([0.04, 0.04, 0.12])
            cross = np.array([random.uniform(-0.08, 0.12), random.uniform(0.16, 0.2), 0.0])
            seen = tip + random.uniform(2, 3) * (tip - cross) + noise * random.normal(size=3)
            turn = Rotation.from_euler("zxy", random.uniform(-1, 1, 3) * [0.5, 0.4, 0.2])
            at = seen - turn.apply(eye)
            k_turn = Rotation.from_matrix(k_from_table[:3, :3]) * turn
            x, y, z, w = k_turn.as_quat()
            names.append(name)
            rows.append([*(k_from_table @ [*at, 1.0])[:3], w, x, y, z, *table.pixel(cross), *tip])
    return names, np.array(rows)


def by_scipy(table, names, rows):
    """Least squares of the lines' distances, with the whitening fixed at each round's distance of the eye."""
    turn = Rotation.from_matrix(table.from_k[:3, :3]) * Rotation.from_quat(rows[:, [4, 5, 6, 3]])
    at = rows[:, :3] @ table.from_k[:3, :3].T + table.from_k[:3, 3]
    tip = rows[:, 9:12]
    way = tip - np.array([table.cross(p) for p in rows[:, 7:9]])
    b = np.linalg.norm(way, axis=1)
    along, place = turn.inv().apply(way / b[:, None]), turn.inv().apply(tip - at)
    is_left = np.array(names) == "left"

    def eyes(v):
        return np.where(is_left[:, None], v[:3], v[3:])

    v = np.zeros(6)
    for _ in range(8):
        times = np.maximum(0, np.sum((eyes(v) - place) * along, axis=1)) / b
        own = np.sqrt((1.5e-3 * (1 + times)) ** 2 + 1.5e-3**2 + (3e-3 * np.linalg.norm(eyes(v), axis=1)) ** 2)

        def residuals(u, own=own):
            return (np.cross(eyes(u) - place, along) / own[:, None]).ravel()

        v = least_squares(residuals, v, xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    return v


class Program:
    def __init__(self, programs, config):
        self.programs, self.config = programs, config

    def __call__(self, names, rows, *options, status=0):
        text = HEADER + "".join(name + "," + ",".join(repr(float(x)) for x in row) + "\n" for name, row in zip(names, rows))
        return self.of_text(text, *options, status=status)

    def settings(self):
        done = subprocess.run([self.programs / "frustumscreen", "config", "--config", self.config, "--json"],
                              capture_output=True, text=True, check=True)
        return json.loads(done.stdout)

    def of_text(self, text, *options, status=0):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write(text)
            file.flush()
            done = subprocess.run([self.programs / "frustumscreen-calibrate", "eye", "--from", file.name, "--config",
                                   self.config, *options], capture_output=True, text=True, check=False)
        assert done.returncode == status, (done.returncode, done.stdout, done.stderr)
        return done


def test_matches_scipy(program, table):
    for seed, noise in ((1, 0.0), (2, 3e-3), (3, 3e-3)):
        names, rows = sightings(table, np.random.default_rng(seed), noise)
        found = json.loads(program(names, rows, "--json").stdout)
        v = by_scipy(table, names, rows)
        apart = max(np.abs(found["left_m"] - v[:3]).max(), np.abs(found["right_m"] - v[3:]).max())
        off = np.abs(found["eye_in_sensor_m"] - (LEFT + RIGHT) / 2).max()
        right = (v[3:] - v[:3]) / np.linalg.norm(v[3:] - v[:3])
        assert np.abs(found["right_in_sensor"] - right).max() < 1e-5, found["right_in_sensor"]
        print(f"seed {seed}: the two solvers are {apart:.1e} m apart; the eye is off by {1e3 * off:.2f} mm, {found['verdict']}")
        assert apart < 1e-6, apart
        assert off < (1e-6 if noise == 0.0 else 0.02), off


def test_wrong_data(program, table):
    names, rows = sightings(table, np.random.default_rng(4), 2e-3)
    slipped = rows.copy()
    slipped[3, 7] += 80.0  # another cross
    done = program(names, slipped, "--json", status=1)
    found = json.loads(done.stdout)
    assert found["verdict"] == "repeat" and found["repeat"] == [4], found
    assert done.stderr.count("\n") == 1, done.stderr
    assert "needed" in json.loads(program(names[:9], rows[:9], "--json", status=1).stdout)["reason"]
    good = HEADER + "left," + ",".join(repr(float(x)) for x in rows[0]) + "\n"
    for text, because in (("", "header"), ("a,b\n", "header"), (good.replace("left", "both"), "allowed are left, right"),
                          (good.replace("left,", "left,x"), "finite number"), (good + "left,1\n", "fields"),
                          (HEADER + "left,0,0,0,0,0,0,0,1,1,0,0,0\n", "not a rotation")):
        done = program.of_text(text, status=1)
        assert done.stdout == "" and because in done.stderr and done.stderr.count("\n") == 1, done.stderr
    done = program(names, rows, "--keep", status=1)
    assert "no calibration is kept" in done.stderr, done.stderr


def kept_form(settings):
    """The settings' own table, in the form of a measured one."""
    p, t = settings["projector"], settings["tracker"]
    keys = ("width", "height", "fx", "fy", "cx", "cy", "k1", "k2", "table_from_projector")
    return ('version = 1\nmade = "today"\nmethod = "auto"\nplaces = 16\n[residual]\nmean_mm = 0.2\nworst_mm = 0.4\nmean_px = 0.1\n'
            + "[projector]\n" + "".join(f"{key} = {p[key]}\n" for key in keys)
            + "[tracker]\n" + "".join(f"{key} = {t[key]}\n" for key in
                                      ("table_from_tracker", "sensor_from_prop", "eye_in_sensor_m")))


def test_keep_and_undo(program, table):
    """After --keep the exhibit's settings have the eye, and nothing else changes; --undo reverts it."""
    before = program.settings()
    folder = program.config.parent / "calibration"
    folder.mkdir()
    (folder / "calibration-0001.toml").write_text(kept_form(before))
    names, rows = sightings(table, np.random.default_rng(5), 0.0)
    program(names, rows, "--keep")
    after = program.settings()
    assert np.abs(np.array(after["tracker"]["eye_in_sensor_m"]) - (LEFT + RIGHT) / 2).max() < 1e-6, after["tracker"]
    assert after["projector"] == before["projector"]
    assert after["tracker"]["table_from_tracker"] == before["tracker"]["table_from_tracker"]
    subprocess.run([program.programs / "frustumscreen-calibrate", "kept", "--config", program.config, "--undo"],
                   capture_output=True, check=True)
    assert program.settings()["tracker"] == before["tracker"]


def main():
    programs, sources = map(pathlib.Path, sys.argv[1:3])
    with tempfile.TemporaryDirectory() as folder:
        config = pathlib.Path(folder) / "kiosk.toml"
        text = (sources / "config" / "near.toml").read_text()
        config.write_text(text + f'\n[calibration]\nfolder = "{folder}/calibration"\n')
        program = Program(programs, config)
        table = Table(program.settings())
        for test in (test_matches_scipy, test_wrong_data, test_keep_and_undo):
            test(program, table)
            print(f"{test.__name__}: well")


if __name__ == "__main__":
    main()
