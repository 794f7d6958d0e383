"""Tests the plots with artificial tables: marks and lines that are read back from the SVG lie where the tables say."""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
PLOTS = Path(__file__).resolve().parents[3] / "app/bench/plots"
sys.path.insert(0, str(PLOTS))

import torch_plots  # noqa: E402
from draw_plots import main, median_attainment, pareto_front  # noqa: E402
from panels import Failure, Panel, Series, save_column, save_sheet  # noqa: E402
from svg import Svg  # noqa: E402

# Three levels of a pack and three simplified meshes, the middle one of higher cost and error than the first; the second
# two-pass picture is better than the first.
TECHNIQUES = (  # technique, kind, triangles, cost, error, best eye image
    ("floor", "floor", 0, 1.0, None, 1), ("mesh 0", "pack level", 1000, 2.0, 0.4, 1),
    ("mesh 1", "pack level", 2000, 3.0, 0.2, 1), ("mesh 2", "pack level", 3000, 5.0, 0.1, 1),
    ("LOD 5k", "LOD", 5000, 2.5, 0.5, 1), ("LOD 7k", "LOD", 7000, 2.9, 0.6, 1),
    ("LOD 9k", "LOD", 9000, 4.0, 0.3, 1), ("two-pass 640", "two-pass", 9000, 8.0, 0.7, 0),
    ("two-pass 1024", "two-pass", 9000, 9.0, 0.08, 1), ("new", "a kind of 2050", 9, 9.0, 0.08, 1))
COLUMNS = ("silhouette_percent", "geometric_mean_mm", "rmse_16_rays")
FACTORS = (1.0, 1.0, 20.0)  # multiply the error, one for each column


def error_time_rows(set_up):
    for technique, kind, triangles, cost, error, best in TECHNIQUES:
        row = {"set_up": set_up, "technique": technique, "kind": kind, "triangles": triangles, "times_floor": cost,
               "best_eye_image": best}
        for column, factor in zip(COLUMNS, FACTORS):
            row[f"mean_{column}"] = "" if error is None else factor * error
            row[f"worst_{column}"] = "" if error is None else 2 * factor * error
        yield row


def write_table(path, rows):
    rows = list(rows)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)


class Plots(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def error_time(self, name="", set_ups=("near",), title="Cat"):
        folder = self.folder / name
        folder.mkdir(exist_ok=True)
        write_table(folder / "error_time.csv", (row for set_up in set_ups for row in error_time_rows(set_up)))
        (folder / "error_time.json").write_text(json.dumps({"pack": title}))
        write_table(folder / "limits.csv", [
            {"level": level, "silhouette_percent": limit, "geometric_mean_mm": limit, "colour_rmse": 20 * limit}
            for level, limit in (("default level", 0.25), ("finest level", 0.15), ("fine level", 0.99))])
        return folder

    def drawn(self, panels):
        path = self.folder / "panels.svg"
        save_column(path, panels)
        return Svg(path)

    def assert_at(self, svg, panel, series, points, log=True):
        """The marks of a series lie at its points, measured by the ticks of the axes."""
        scaled = math.log10 if log else float
        places = svg.marks(f"panel{panel}/{series}")
        self.assertEqual(len(places), len(points), series)
        for axis in (0, 1):
            ticks = sorted((float(words.removeprefix("≤ ").replace("k", "e3").replace("M", "e6")), pixel)
                           for words, pixel in svg.ticks(panel, axis).items())
            (low, low_px), (high, high_px) = ticks[0], ticks[-1]
            per_unit = (high_px - low_px) / (scaled(high) - scaled(low))
            for point, place in zip(points, places):
                self.assertAlmostEqual(place[axis], low_px + per_unit * (scaled(point[axis]) - scaled(low)), delta=0.01)


class Fronts(unittest.TestCase):
    def test_pareto_front_keeps_undominated_points(self):
        self.assertEqual(pareto_front([(3, 1), (1, 3), (2, 4), (2, 2), (3, 1), (4, 1), (1, 5)]),
                         [(1, 3), (2, 2), (3, 1)])
        self.assertEqual(pareto_front([]), [])

    def test_median_attainment_is_reached_by_half_of_the_artifacts(self):
        three = [[(1, 10), (4, 2)], [(2, 8), (5, 1)], [(3, 20)]]
        # At 1 one of three reaches anything; at 2 two do: 8 and 10; at 4: 2, 8 and 20; at 5: 1, 2 and 20.
        self.assertEqual(median_attainment(three), [(2, 10), (4, 8), (5, 2)])
        self.assertEqual(median_attainment(three[:1]), three[0])
        self.assertEqual(median_attainment([]), [])
        self.assertEqual(median_attainment([[], [], [(1, 1)]]), [])

    def test_median_attainment_of_equal_artifacts_is_their_front(self):
        points = [(1, 5), (2, 6), (3, 2), (9, 1)]
        self.assertEqual(median_attainment([points] * 4), pareto_front(points))


class ErrorTime(Plots):
    def test_marks_techniques_at_cost_and_error_in_three_plots(self):
        main([str(self.error_time() / "error_time.csv")])
        svg = Svg(self.folder / "error_time_near.svg")
        for panel, factor in enumerate(FACTORS):
            self.assert_at(svg, panel, "pack's levels", [(2, 0.4 * factor), (3, 0.2 * factor), (5, 0.1 * factor)])
            self.assert_at(svg, panel, "the same, worst pose",
                           [(2, 0.8 * factor), (3, 0.4 * factor), (5, 0.2 * factor)])
            self.assert_at(svg, panel, "one pass, LODs", [(2.5, 0.5 * factor), (4, 0.3 * factor)])
        words = svg.texts()
        for label in ("mesh 0", "mesh 1", "mesh 2", "5k", "7k", "9k", "two-pass 1024"):
            self.assertEqual(words.count(label), 3, label)
        for title in ("Silhouette", "Geometric", "Colour"):
            self.assertEqual(words.count(f"{title} error: Cat, near set-up"), 1)
        self.assertNotIn("floor", words)
        self.assertNotIn("new", words)

    def test_points_off_the_front_are_faint_and_not_on_the_line(self):
        main([str(self.error_time() / "error_time.csv")])
        svg = Svg(self.folder / "error_time_near.svg")
        self.assert_at(svg, 0, "one pass, LODs/more", [(2.9, 0.6)])
        self.assertEqual(len(svg.line("panel0/one pass, LODs")), 2)
        self.assertEqual(svg.line("panel0/one pass, LODs/more"), [])
        opacities = {use.get("style") for use in svg.groups["panel0/one pass, LODs/more"].iter()
                     if use.tag.endswith("use")}
        self.assertTrue(all("fill-opacity: 0.3" in style for style in opacities), opacities)

    def test_omits_two_pass_rows_without_the_best_eye_image(self):
        main([str(self.error_time() / "error_time.csv")])
        svg = Svg(self.folder / "error_time_near.svg")
        self.assert_at(svg, 0, "two-pass, full mesh", [(9, 0.08)])
        self.assertNotIn("two-pass 640", svg.texts())

    def test_a_family_without_members_is_not_in_the_legend(self):
        main([str(self.error_time() / "error_time.csv")])
        words = Svg(self.folder / "error_time_near.svg").texts()
        self.assertEqual(words.count("one pass, LODs"), 3)
        self.assertNotIn("ray cast (reference)", words)

    def test_draws_limits_of_default_and_finest_level(self):
        main([str(self.error_time() / "error_time.csv")])
        svg = Svg(self.folder / "error_time_near.svg")
        self.assertEqual(svg.texts().count("default level's limit"), 3)
        self.assertEqual(svg.texts().count("finest level's limit"), 3)
        ticks = svg.ticks(0, 1)
        for limit, words in ((0.25, "default level's limit"), (0.15, "finest level's limit")):
            line = svg.line(f"panel0/{words}")
            self.assertEqual(line[0][1], line[1][1])
            share = math.log10(limit / 0.1) / math.log10(0.5 / 0.1)
            self.assertAlmostEqual(line[0][1], ticks["0.1"] + (ticks["0.5"] - ticks["0.1"]) * share, delta=0.01)
        self.assertNotIn("fine level's limit", svg.texts())

    def test_draws_a_two_pass_table(self):
        folder = self.error_time()
        (folder / "error_time.csv").rename(folder / "two_pass_near_1000000.csv")
        main([str(folder / "two_pass_near_1000000.csv")])
        words = Svg(folder / "two_pass_near_1000000.svg").texts()
        self.assertIn("Colour error: Built-in amphora, 1000000 triangles, near set-up", words)

    def test_overall_sheet_has_a_row_per_set_up_and_names_artifacts(self):
        cat = self.error_time("cat", ("near", "kiosk"))
        skull = self.error_time("skull", title="Skull & <bones>")
        out = self.folder / "all.svg"
        main(["--overall", str(out), str(cat), str(skull)])
        svg = Svg(out)
        words = svg.texts()
        self.assertEqual(words.count("Error against cost, 2 artifacts"), 1)
        self.assertEqual(words.count("Artifacts: Cat, Skull & <bones>."), 1)
        self.assertEqual(sum(", near set-up" in text for text in words), 3)
        self.assertEqual(sum(", kiosk set-up" in text for text in words), 3)
        self.assertEqual(words.count("pack's levels"), 1)  # one legend
        self.assertEqual(words.count("better ↙"), 6)
        levels = [(2, 0.4), (3, 0.2), (5, 0.1)]
        self.assert_at(svg, 0, "pack's levels/more", levels + levels)
        self.assert_at(svg, 3, "pack's levels/more", levels)
        self.assert_at(svg, 0, "pack's levels", levels)
        self.assertEqual(len(svg.line("panel0/pack's levels")), 5)  # stepped
        main(["--overall", str(out), str(skull)])
        self.assertIn("Error against cost, 1 artifact", Svg(out).texts())


class OtherTables(Plots):
    def test_scaling_has_four_lines_over_the_sources_size(self):
        rows = [{"source_triangles": triangles, "times_floor": cost * k, "mean_geometric_mm": 0.01 * k}
                for triangles, cost in ((10_000, 1.5), (1_000_000, 2.0)) for k in (1, 2, 3, 4)]
        write_table(self.folder / "scaling_near.csv", rows)
        main([str(self.folder / "scaling_near.csv")])
        svg = Svg(self.folder / "scaling_near.svg")
        self.assert_at(svg, 0, "default level", [(1e4, 1.5), (1e6, 2.0)])
        self.assert_at(svg, 0, "finest relief", [(1e4, 4.5), (1e6, 6.0)])
        self.assert_at(svg, 0, "two-pass, full mesh", [(1e4, 6.0), (1e6, 8.0)])
        self.assert_at(svg, 1, "finest level", [(1e4, 0.02), (1e6, 0.02)])
        for label in ("1.50 x", "2.00 x", "8.00 x"):
            self.assertEqual(svg.texts().count(label), 1, label)

    def test_latency_has_a_plot_per_tracker_and_dashed_lines(self):
        rows = [{"source": tracker, "contestant": contestant, "motion": motion, "speed_m_s": 0.25,
                 "latency_ms": latency, "rms_mm": 0.1 * latency}
                for tracker in ("PATRIOT", "VIPER") for contestant in ("exhibit", "exhibit, predicted")
                for motion in ("latency", "strokes") for latency in (20, 60)]
        write_table(self.folder / "latency.csv", rows)
        main([str(self.folder / "latency.csv")])
        svg = Svg(self.folder / "latency.svg")
        for panel in (0, 1):
            self.assert_at(svg, panel, "exhibit", [(20, 2.0), (60, 6.0)], log=False)
            self.assertIn("stroke-dasharray", svg.style(f"panel{panel}/exhibit"))
            self.assertNotIn("stroke-dasharray", svg.style(f"panel{panel}/exhibit, predicted"))
        self.assertIn("VIPER, strokes at 0.25 m/s", svg.texts())

    def test_step_errors_have_a_plot_per_unit_and_show_zero(self):
        rows = [{"what": what, "step": step, "step_unit": unit, "error": error}
                for what, unit in (("exact", "time constants"), ("governor", "s"))
                for step, error in ((0.1, 0), (10, 0.5))]
        write_table(self.folder / "step_error.csv", rows)
        main([str(self.folder / "step_error.csv")])
        svg = Svg(self.folder / "step_error.svg")
        self.assert_at(svg, 0, "exact", [(0.1, 1e-18), (10, 0.5)])
        self.assert_at(svg, 1, "governor", [(0.1, 1e-18), (10, 0.5)])
        self.assertEqual(svg.texts().count("all of it"), 1)

    def setup_plot(self, *costs):
        """A plot of the present set-up and two choices, with these costs of a frame."""
        rows = [{"choice": choice, "lens_height_m": height, "lens_side_m": side, "evenness": 0.3, "pixels": 900,
                 "reach_y_m": 0.04, "reference_light": 0.2, "frame_times_now": cost}
                for (choice, height, side), cost in zip(
                    (("as it is", 1.2, 0.0), ("tilted", 1.5, 0.0), ("tilted", 1.5, 0.3), ("tilted", 1.6, 0.0)), costs)]
        write_table(self.folder / "setup.csv", rows)
        main([str(self.folder / "setup.csv")])
        return Svg(self.folder / "setup.svg")

    def test_draws_frame_costs_that_were_measured(self):
        svg = self.setup_plot("1.0", "1.5", "", "2.0")
        self.assert_at(svg, 4, "above the middle", [(1.5, 1.5), (1.6, 2.0)], log=False)
        self.assertFalse(svg.marks("panel4/0.3 m behind it, tilted"))
        self.assertTrue(svg.marks("panel3/0.3 m behind it, tilted"))
        self.assertEqual(svg.texts().count("as it is"), 5)

    def test_omits_the_frame_cost_panel_without_measurements(self):
        svg = self.setup_plot("", "", "", "")
        self.assertIn("axes_4", svg.groups)
        self.assertNotIn("axes_5", svg.groups)


class Panels(Plots):
    def test_points_that_the_axes_cannot_show_are_left_out(self):
        nan, inf = math.nan, math.inf
        svg = self.drawn([Panel("t", "x", "y", [Series("s", [(0, 1), (1, -1), (nan, 1), (1, nan), (1, inf), (1, 1)])])])
        self.assertEqual(len(svg.marks("panel0/s")), 1)

    def test_an_axis_has_ticks_over_any_range(self):
        for high in (1.0, 1.01, 1.3, 2, 7, 40, 300, 1e5, 1e12):
            for low in (1e-4, 1.7, 2e6):
                svg = self.drawn([Panel("t", "x", "y", [Series("s", [(low, low), (low * high, low * high)])])])
                for axis in (0, 1):
                    self.assertGreaterEqual(len(svg.ticks(0, axis)), 3, (low, high))
                    self.assertLessEqual(len(svg.ticks(0, axis)), 15, (low, high))

    def test_long_legends_and_notes_fit(self):
        words = "a technique whose name is very long, on the finest level, in the worst of all poses"
        svg = self.drawn([Panel("t", "x", "y", [Series("short", [(1, 1), (2, 2)])]),
                          Panel("t", "x", "y", [Series(words, [(1, 1), (2, 2)])])])
        (left, _), = svg.place_of_texts(words)
        self.assertGreater(svg.width(), left + 6.5 * len(words))  # 6.5 px a letter: a wide font
        self.assertGreater(svg.place_of_texts("short")[0][0], max(x for x, _ in svg.marks("panel0/short")))
        sheet = self.folder / "sheet.svg"
        panels = [Panel("t", "x", "y", [Series(f"{k} {words}", [(1, 1), (2, 2)], k)]) for k in range(3)]
        note = "Artifacts: " + ", ".join(f"artifact {k}" for k in range(60)) + "."
        save_sheet(sheet, "s", panels, 3, [note])
        svg = Svg(sheet)
        for k in range(3):
            (left, _), = svg.place_of_texts(f"{k} {words}")
            self.assertGreater(svg.width(), left + 6.5 * len(words))
        lines = [text for text in svg.texts() if "artifact" in text]
        self.assertEqual(" ".join(lines), note)
        self.assertLess(max(map(len, lines)) * 6.5, svg.width())

    def test_clamps_points_below_the_axis_minimum(self):
        panel = Panel("t", "x", "y", [Series("s", [(1, 1), (2, 0.001), (3, 1e-7), (4, 0)])], y_min=0.001)
        svg = self.drawn([panel])
        self.assert_at(svg, 0, "s", [(1, 1), (2, 0.001), (3, 0.001), (4, 0.001)])
        self.assertIn("≤ 0.001", svg.texts())
        panel.series[0].points = panel.series[0].points[:1]
        self.assertNotIn("≤ 0.001", self.drawn([panel]).texts())  # nothing lies there

    def test_escapes_special_characters_in_text(self):
        words = "Error & cost <\"quoted\"> $x^2$"
        svg = self.drawn([Panel(words, words, words, [Series(words, [(1, 1, words)])], [(2, words)])])
        self.assertEqual(svg.texts().count(words), 6)

    def test_draws_an_empty_plot(self):
        for log in (False, True):
            self.assertIn("nothing", self.drawn([Panel("nothing", "x", "y", log=log)]).texts())
        save_sheet(self.folder / "none.svg", "none", [], 3, [])
        self.assertIn("none", Svg(self.folder / "none.svg").texts())

    def test_labels_of_crowded_points_do_not_overlap(self):
        words = "a label of some length"
        points = [(1 + 0.01 * k, 1 + 0.005 * k, words) for k in range(12)] + [(10, 10)]
        places = self.drawn([Panel("crowd", "x", "y", [Series("s", points)])]).place_of_texts(words)
        self.assertGreaterEqual(len(places), 6)  # words that find no place are left out
        for a in range(len(places)):
            for b in range(a):
                away = [abs(p - q) for p, q in zip(places[a], places[b])]
                self.assertTrue(away[0] > 22 * 5 or away[1] > 11, (places[a], places[b]))  # 5 px a letter at least

    def test_the_same_panels_give_the_same_bytes(self):
        panel = Panel("t", "x", "y", [Series("s", [(1, 1, "a"), (2, 2, "b")], mark="s", dashed=True)], [(1.5, "limit")])
        files = [self.folder / "one.svg", self.folder / "two.svg"]
        for file in files:
            save_column(file, [panel])
        self.assertEqual(files[0].read_bytes(), files[1].read_bytes())
        self.assertEqual(len(list(self.folder.iterdir())), 2)  # no partial file stays


class Room(Plots):
    def test_marks_the_slowest_frame_of_each_technique_with_its_rate(self):
        table = self.folder / "room_frames.csv"
        write_table(table, ({"technique": technique, "walk": walk, "seconds": seconds, "ms": ms, "wall_ms": 2 * ms}
                            for technique, times in (("ours", (20, 25, 20)), ("lod", (50, 80, 100)))
                            for walk in ("paper", "bends") for seconds, ms in enumerate(times)))
        main([str(table)])
        svg = Svg(table.with_suffix(".svg"))
        for panel in (0, 1):
            self.assert_at(svg, panel, "ours, least/more", [(1, 40)], log=False)
            self.assert_at(svg, panel, "lod, least/more", [(2, 10)], log=False)
        self.assertEqual(svg.texts().count("40.0"), 2)

    def test_marks_each_technique_at_its_median_and_99th_percentile(self):
        table = self.folder / "room.csv"
        write_table(table, ({"technique": technique, "objects": 200, "triangles": 4_000_000, "ms_p50": ms, "ms_p99": 2 * ms,
                             "fps_min": 1, "error_mm_mean": error}
                            for technique, ms, error in (("ours", 20, 1.0), ("paper", 60, 3.0))))
        main([str(table)])
        svg = Svg(table.with_suffix(".svg"))
        self.assert_at(svg, 0, "paper", [(60, 3.0)])
        self.assert_at(svg, 0, "paper, p99 mark/more", [(120, 3.0)])
        self.assertIn("A room of 200 objects, 4.0 million source triangles", svg.texts())

    def test_marks_the_papers_machines(self):
        table = self.folder / "room_paper.csv"
        write_table(table, ({"technique": technique, "polygons_s": rate, "polygons_p50": 1, "polygons_max": 2, "ms_p50": 3,
                             "fps_min": fps, "error_mm_mean": error}
                            for technique, rate, fps, error in (("paper", 5000, 30, 2.0), ("paper", 50000, 20, 1.5),
                                                                ("paper", 0, 12, 1.0), ("ours", 0, 40, 1.2))))
        main([str(table)])
        svg = Svg(table.with_suffix(".svg"))
        self.assert_at(svg, 0, "paper", [(5000, 2.0), (50000, 1.5)])
        self.assert_at(svg, 1, "paper", [(5000, 30), (50000, 20)])


class Torch(Plots):
    def test_marks_each_technique_at_its_relative_cost_and_error(self):
        table = self.folder / "torch.csv"
        write_table(table, ({"scene": scene, "technique": technique, "tolerance_mm": 0, "ms_p50": ms, "ms_p99": 2 * ms,
                             "intensity_rmse": error, "intensity_max": 2 * error}
                            for scene in ("mesh", "cells")
                            for technique, ms, error in (("none", 10, 0), ("ours", 12, 0.1), ("paper", 30, 0.2),
                                                         ("paper", 20, 0.9), ("paper_curvature_2pct", 25, 0.3))))
        main([str(table)])
        svg = Svg(table.with_suffix(".svg"))
        for panel in (0, 1):
            self.assert_at(svg, panel, "ours", [(1.2, 0.1)], log=False)
            self.assert_at(svg, panel, "paper", [(2.0, 0.9), (3.0, 0.2)], log=False)
            self.assert_at(svg, panel, "paper_curvature", [(2.5, 0.3)], log=False)

    def test_frame_rates_are_means_of_ten_frames(self):
        table = self.folder / "torch_frames.csv"
        write_table(table, ({"scene": "mesh", "technique": technique, "tolerance_mm": 2, "frame": frame,
                             "ms": ms if frame < 10 else 2 * ms}
                            for technique, ms in (("paper_steered", 20), ("paper_fixed", 25), ("ours_no_shadow", 10),
                                                  ("ours", 12.5)) for frame in range(25)))  # the last five are no group
        main([str(table)])
        svg = Svg(table.with_suffix(".svg"))
        self.assert_at(svg, 0, "paper_steered, spread 2.00", [(5, 50), (15, 25)], log=False)
        self.assert_at(svg, 0, "paper_fixed, spread 2.00", [(5, 40), (15, 20)], log=False)

    def test_wall_plots_triangles_over_errors(self):
        table = self.folder / "torch_wall.csv"
        write_table(table, ({"attenuation": attenuation, "heuristic": heuristic, "triangles": triangles,
                             "intensity_rmse": error, "intensity_max": 3 * error}
                            for attenuation in ("linear", "smooth_step")
                            for heuristic, triangles, error in (("length", 200, 1.0), ("length", 20, 5.0),
                                                                ("curvature", 100, 1.0))))
        main([str(table)])
        svg = Svg(table.with_suffix(".svg"))
        self.assert_at(svg, 0, "by edge length (paper)", [(20, 5.0), (200, 1.0)])
        self.assert_at(svg, 3, "by the bound (ours)", [(100, 3.0)])

    def test_interpolates_wall_light_inside_the_beam_only(self):
        corner = (0.1, 0.0, 1.0, 0.0, 0.0, 1.0)
        triangle = [corner, (0.5, 0.0, 0.0, 2.0, 0.0, 1.0), (0.1, 0.4, 0.0, 0.0, 2.0, 1.0)]
        codes, in_beam = torch_plots.wall_picture([triangle])
        at = [round((place - torch_plots.MIDDLE + torch_plots.EXTENT) / (2 * torch_plots.EXTENT) * torch_plots.SIZE)
              for place in (0.2, 0.4)]
        row = torch_plots.SIZE // 2 - 1
        self.assertAlmostEqual(codes[row, at[0]] ** 2.2, 0.75, delta=0.02)
        self.assertTrue(in_beam[row, at[0]])
        self.assertFalse(in_beam[row, at[1]])
        self.assertEqual(codes[row, at[1]], 0)
        table = self.folder / "torch_triangles.csv"
        write_table(table, (dict(zip(("heuristic", "tolerance", "triangle", "x_m", "y_m", "intensity", "s", "t", "q"),
                                     (heuristic, tolerance, 0, *each)))
                            for heuristic, tolerance in (("length", 60), ("curvature", 4)) for each in triangle))
        main([str(table)])
        words = Svg(table.with_suffix(".svg")).texts()
        self.assertIn("edges up to 60 mm: 1 triangles", words)
        self.assertIn("bound of the error 4 %: 1 triangles", words)


class Ldi(Plots):
    def test_window_costs_are_relative_to_the_scene_alone(self):
        table = self.folder / "ldi.csv"
        write_table(table, ({"triangles": triangles, "windows": windows, "technique": technique,
                             "ms_p50": 10 + windows * ms, "ms_p99": 99, "silhouette_pct": 0.5 if windows else 0,
                             "error_mm_mean": 0.1 if windows else 0, "rmse": 3, "mb": 1, "make_ms": 1}
                            for triangles in (1000, 630799) for technique, ms in (("geometry", 20), ("ours", 2))
                            for windows in range(5)))
        main([str(table)])
        svg = Svg(table.with_suffix(".svg"))
        self.assert_at(svg, 0, "ours", [(windows, 1 + 0.2 * windows) for windows in range(5)], log=False)
        self.assert_at(svg, 1, "ours", [(1000, 10), (630799, 10)])
        self.assert_at(svg, 2, "ours", [(2, 0.5)])
        self.assert_at(svg, 3, "geometry", [(20, 0.1)])

    def test_errors_are_means_of_the_patches(self):
        table = self.folder / "ldi_error.csv"
        write_table(table, ({"triangles": 9, "technique": "ours", "pixels": pixels, "patch": patch, "pictures": 1,
                             "silhouette_pct": 128 / pixels * (1 + 2 * patch), "error_mm_mean": 1, "rmse": 2}
                            for pixels in (128, 256) for patch in (0, 1)))
        main([str(table)])
        self.assert_at(Svg(table.with_suffix(".svg")), 0, "ours", [(128, 2.0), (256, 1.0)])


class InvalidInput(Plots):
    def assert_said(self, arguments, words):
        with self.assertRaisesRegex(Failure, words) as caught:
            main([str(argument) for argument in arguments])
        self.assertNotIn("\n", str(caught.exception))

    def test_reports_an_invalid_table_in_one_line(self):
        folder = self.error_time()
        table = folder / "error_time.csv"
        good = table.read_text()
        self.assert_said([folder / "other.csv"], "no table that is drawn")
        self.assert_said([folder / "latency.csv"], "latency.csv: No such file")
        for column in ("kind", "times_floor", "mean_rmse_16_rays", "best_eye_image"):
            table.write_text(good.replace(column, "_", 1))
            self.assert_said([table], "error_time.csv: .*measure again")
        table.write_text(good.replace("2.0", "two", 1))
        self.assert_said([table], "error_time.csv: .*measure again")
        table.write_text("")
        self.assert_said([table], "holds no rows")
        table.write_bytes(b"\xff\xfe\n\n")
        self.assert_said([table], "error_time.csv: .*measure again")

    def test_reports_an_outdated_table_of_a_sheet_in_one_line(self):
        folder = self.error_time()
        table = folder / "error_time.csv"
        table.write_text(table.read_text().replace("best_eye_image", "_", 1))
        self.assert_said(["--overall", folder / "all.svg", folder], "best_eye_image.*measure again")

    def test_reports_a_missing_title_in_one_line(self):
        folder = self.error_time()
        for text in ("", "{", "[]", "null", "{}"):
            (folder / "error_time.json").write_text(text)
            self.assert_said(["--overall", folder / "all.svg", folder], "error_time.json: .*measure again")

    def test_names_missing_matplotlib_package_and_keeps_table(self):
        table = self.error_time() / "error_time.csv"
        (self.folder / "matplotlib.py").write_text("raise ImportError('none')\n")
        done = subprocess.run([PLOTS / "draw_plots.py", table], capture_output=True, text=True, check=False,
                              env=os.environ | {"PYTHONPATH": str(self.folder), "PYTHONDONTWRITEBYTECODE": "1"})
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\A.*python3-matplotlib.*\n\Z")
        self.assertTrue(table.exists())


if __name__ == "__main__":
    unittest.main()
