"""Tests `frustumscreen-bake --prop-file` on random bodies, against SciPy's hulls: faces, normals, volume, least width.

    prop_file_program.py PROGRAMS

The least width is computed here as the least distance of a face of the body's difference with itself from the origin, a formula that
app/solid does not use.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
    from scipy.spatial import ConvexHull, HalfspaceIntersection
except ImportError:
    print("SciPy is missing on this machine")
    sys.exit(77)

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() / "frustumscreen-bake"


def outward_triangles(hull):
    triangles = hull.points[hull.simplices]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    inward = np.einsum("ij,ij->i", normals, hull.equations[:, :3]) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    return triangles


def binary_stl(triangles):
    facets = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facets["corners"] = triangles
    return bytes(80) + np.uint32(len(triangles)).tobytes() + facets.tobytes()


def ascii_ply(triangles):
    points = triangles.reshape(-1, 3)
    lines = ["ply", "format ascii 1.0", f"element vertex {len(points)}", "property double x", "property double y", "property double z",
             f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(repr, point)) for point in points.tolist()]
    lines += [f"3 {3 * k} {3 * k + 1} {3 * k + 2}" for k in range(len(triangles))]
    return "\n".join(lines + [""]).encode()


def obj(triangles):
    lines = ["v " + " ".join(map(repr, point)) for point in triangles.reshape(-1, 3).tolist()]
    lines += [f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}" for k in range(len(triangles))]
    return "\n".join(lines).encode()


def different_normals(hull):
    """The normals of the faces, one for all triangles of a face."""
    normals = []
    for normal in hull.equations[:, :3]:
        if not any(normal @ other > 1 - 1e-9 for other in normals):
            normals.append(normal)
    return np.array(normals)


def is_generic(hull, normals):
    """Whether no edge is shorter than 3 mm and faces are at 8 degrees or more to each other; others may be read as another body."""
    points = hull.points[hull.vertices]
    gaps = np.linalg.norm(points[:, None] - points, axis=2) + 1e9 * np.eye(len(points))
    cosines = normals @ normals.T - 2 * np.eye(len(normals))
    return gaps.min() > 3 and cosines.max() < np.cos(0.14)


def random_hull(random, trial):
    while True:
        if trial % 2:  # points on a sphere: triangles
            points = random.normal(size=(random.integers(4, 11), 3))
            points *= 70 / np.linalg.norm(points, axis=1)[:, None]
        else:  # random planes: faces of several corners
            normals = random.normal(size=(random.integers(4, 17), 3))
            normals /= np.linalg.norm(normals, axis=1)[:, None]
            try:
                points = HalfspaceIntersection(np.c_[normals, -random.uniform(50, 70, len(normals))], np.zeros(3)).intersections
            except Exception:  # pylint: disable=broad-except; the planes enclose nothing
                continue
            if not np.all(np.linalg.norm(points, axis=1) < 500):
                continue
        hull = ConvexHull(points)
        normals = different_normals(hull)
        if 4 <= len(normals) <= 16 and is_generic(hull, normals):
            return hull, normals


def min_width(hull):
    points = hull.points[hull.vertices]
    differences = (points[:, None] - points).reshape(-1, 3)
    return -ConvexHull(differences).equations[:, 3].max()


class PropFile(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)

    def bake(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, check=False)

    def refusal(self, name, data, *more):
        (self.folder / name).write_bytes(data)
        done = self.bake("--prop-file", name, "-o", "refused.obj", *more)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertFalse((self.folder / "refused.obj").exists())
        self.assertIn(name, done.stderr)
        return done.stderr

    def test_random_bodies_match_scipy(self):
        random = np.random.default_rng(1)
        for trial in range(60):
            hull, normals = random_hull(random, trial)
            triangles = outward_triangles(hull)
            random.shuffle(triangles)
            if trial % 5 == 0:
                triangles = triangles[:, ::-1]  # inside out
            name, data = (("a.stl", binary_stl), ("a.ply", ascii_ply), ("a.obj", obj))[trial % 3]
            (self.folder / name).write_bytes(data(triangles))
            done = self.bake("--prop-file", name, "-o", "prop.obj", "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            report = json.loads(done.stdout)
            self.assertEqual([face["name"] for face in report["faces"]], [f"F{k + 1}" for k in range(len(normals))])
            self.assertAlmostEqual(report["volume_cm3"] / (hull.volume / 1000), 1, delta=2e-6)
            self.assertAlmostEqual(report["least_width_mm"], min_width(hull), delta=1e-3)
            for face in report["faces"]:
                self.assertGreater(np.max(normals @ face["normal"]), 1 - 1e-9)
            self.assertEqual(sum(len(face["corners_mm"]) for face in report["faces"]),
                             2 * (len(hull.vertices) + len(normals) - 2))  # twice Euler's number of edges
            # The file holds the same, standing on z = 0: read here, not by the program.
            points = np.array([line.split()[1:] for line in (self.folder / "prop.obj").read_text().splitlines() if line.startswith("v ")], float)
            self.assertAlmostEqual(ConvexHull(points).volume / hull.volume, 1, delta=2e-6)
            self.assertEqual(points[:, 2].min(), 0)
            self.assertEqual(self.bake("--prop-file", "prop.obj", "-o", "again.obj").returncode, 0)
            self.assertEqual((self.folder / "again.obj").read_bytes(), (self.folder / "prop.obj").read_bytes())

    def test_converts_units_and_axes(self):
        points = np.array([[x, y, z] for x in (0, 0.1) for y in (0, 0.2) for z in (0, 0.3)])
        (self.folder / "box.stl").write_bytes(binary_stl(outward_triangles(ConvexHull(points))))
        done = self.bake("--prop-file", "box.stl", "-o", "box.obj", "--unit", "m", "--up", "y", "--json")
        report = json.loads(done.stdout)
        self.assertTrue(np.allclose(report["size_mm"], [100, 300, 200], atol=1e-3), report["size_mm"])
        self.assertIn("metres", self.refusal("box.stl", (self.folder / "box.stl").read_bytes()))

    def test_rejects_invalid_props(self):
        random = np.random.default_rng(2)
        ball = random.normal(size=(500, 3))
        ball *= 60 / np.linalg.norm(ball, axis=1)[:, None]
        round_body = outward_triangles(ConvexHull(ball))
        self.assertIn("[prop_file.faces]", self.refusal("ball.stl", binary_stl(round_body)))
        box = outward_triangles(ConvexHull(np.array([[x, y, z] for x in (0, 100) for y in (0, 100) for z in (0, 100)])))
        self.assertIn("triangle ", self.refusal("open.stl", binary_stl(box[:-1])))
        turned = box.copy()
        turned[3] = turned[3][::-1]
        self.assertIn("[prop_file.turned]", self.refusal("turned.ply", ascii_ply(turned)))
        self.assertIn("[prop_file.too_many]", self.refusal("scan.stl", binary_stl(np.tile(box, (1_000_000 // 12 + 1, 1, 1)))))
        self.assertIn("[prop_file.size]", self.refusal("far.stl", binary_stl(box * 1e4)))
        self.refusal("nan.stl", binary_stl(np.where(box == 0, np.nan, box)))
        self.refusal("empty.stl", b"")
        self.assertIn("not convex", self.refusal("hollow.stl", binary_stl(self.dented(box))))

    @staticmethod
    def dented(box):
        """The box with a pyramid cut into its top."""
        top = [triangle for triangle in box if np.all(triangle[:, 2] == 100)]
        rest = [triangle for triangle in box if not np.all(triangle[:, 2] == 100)]
        corners = np.array([[0, 0, 100], [100, 0, 100], [100, 100, 100], [0, 100, 100]])
        assert len(top) == 2
        return np.array(rest + [[corners[k], corners[(k + 1) % 4], [50, 50, 70]] for k in range(4)], float)

    def test_does_not_overwrite_other_files(self):
        (self.folder / "mine.obj").write_text("# mine\n")
        (self.folder / "box.obj").write_text((pathlib.Path(__file__).parents[2] / "config/prop_cube.obj").read_text())
        done = self.bake("--prop-file", "box.obj", "-o", "mine.obj")
        self.assertEqual((done.returncode, "[prop_file.not_replaced]" in done.stderr), (1, True), done.stderr)
        self.assertEqual((self.folder / "mine.obj").read_text(), "# mine\n")
        self.assertEqual(self.bake("--prop-file", "box.obj", "-o", "mine.obj", "--force").returncode, 0)
        self.assertEqual(self.bake("--prop-file", "box.obj", "-o", "mine.obj").returncode, 0)
        self.assertEqual(self.bake("--prop-file", "mine.obj", "-o", "mine.obj").returncode, 1)
        self.assertIn('g +X\n', (self.folder / "mine.obj").read_text())

    def test_reports_usage_errors(self):
        for arguments in (["--prop-file"], ["--prop-file", "a.stl"], ["--prop-file", "a.stl", "-o", "b.obj", "--unit", "inch"]):
            done = self.bake(*arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertEqual(self.bake("--prop-file", "a.stl", "-o", "b.obj").returncode, 1)


if __name__ == "__main__":
    unittest.main()
