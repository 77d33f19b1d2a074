"""bench/report: tracks of the motion, and its stretches early and late."""
import json
import math
import unittest

from synthetic import CLASSES, COLUMNS, FIELDS, Fresh, describe, load, measured, reading, run, save

import moving  # noqa: E402
import verdict  # noqa: E402


def circles(folder, motion_of=("x", "y"), away=1e3, units=("m", "m"), more=0):
    """`round` runs on the unit circle, `small` on one of half its size, and `lost` runs away to `away`."""
    measures = [f"energy:{m}" for m in FIELDS]
    rows = []
    for label, size in (("round", 1.0), ("small", 0.5), ("lost", away), *((f"more {k}", 1.0) for k in range(more))):
        row = dict.fromkeys(COLUMNS + measures + ["run"], "")
        row.update({"case": "ball", "system": "ball", "method": label, "integrator": label, "step": 0.1, "time": 10,
                    "steps": 100, "precision": "double", "status": "converged", "rhs_per_step": 1, "run": label,
                    "energy:max": 1e-6, "energy:class": "near"})
        rows.append(row)
        path = folder / "runs" / label
        path.mkdir(parents=True)
        table = [["t [s]", f"x [{units[0]}]", f"y [{units[1]}]", "energy [J]"]]
        for k in range(101):
            t = 0.1 * k
            table.append([repr(t), repr(3 + size * math.cos(t)), repr(size * math.sin(t)), "1"])
        save(path / "series.csv", table)
        (path / "summary.json").write_text(json.dumps({"schema": 1, "plane": ["x", "y"], "invariants": [
            {"name": "energy", "unit": "J", "expected": "conserved"}]}))
    head = {"schema": reading.SCHEMA, "name": "ball", "title": "Ball", "drift_classes": CLASSES, "cases": [
        {"name": "ball", "title": "Ball <b>", "system": "ball", "precision": "double", "time_unit": "s",
         "conserved": "energy", "motion": list(motion_of)}], "methods": [{"label": r["method"]} for r in rows]}
    save(folder / "results.csv", [list(rows[0])] + [list(r.values()) for r in rows])
    describe(folder, head)
    return folder


class Tracks(Fresh):
    def portraits(self, **of_circles):
        shown = reading.Experiment(circles(self.folder, **of_circles))
        return moving.drawings(verdict.Verdict(shown, shown.cases[0]))[0]

    def test_tracks_are_the_coordinates_of_the_runs(self):
        line = self.portraits().draw(True).axes[0].lines[0]
        self.assertEqual(len(line.get_xdata()), 101)
        for a, b in zip(line.get_xdata(), line.get_ydata()):
            self.assertAlmostEqual(math.hypot(a - 3, b), 1)

    def test_frame_leaves_out_what_runs_away(self):
        drawing = self.portraits()
        self.assertIn("The track of lost leaves the frame.", drawing.caption)
        self.assertLess(drawing.draw(True).axes[0].get_xlim()[1], 10)

    def test_nothing_leaves_the_frame_of_tracks_alike(self):
        self.assertNotIn("leaves the frame", self.portraits(away=1.1).caption)

    def test_coordinates_are_those_that_the_case_names(self):
        self.assertEqual(self.portraits(motion_of=("y", "x")).title, "Ball <b>: x against y")

    def test_different_units_have_scales_of_their_own(self):
        self.assertNotIn("same scale", self.portraits(units=("m", "rad")).caption)

    def test_the_most_accurate_motion_stands_behind_where_its_error_is_not_seen(self):
        for error, behind in (("1e-9", True), ("0.1", False)):
            folder = circles(self.folder / error)
            self.folder, before = folder, self.folder
            self.edit("results.csv", "error_max", lambda x: error, lambda row: row[2] == "round")
            self.folder = before
            path = folder / "runs" / "round" / "summary.json"
            path.write_text(json.dumps(json.loads(path.read_text()) | {"step": "0.1"}))
            shown = reading.Experiment(folder)
            drawing = moving.drawings(verdict.Verdict(shown, shown.cases[0]))[0]
            self.assertEqual("for the exact motion that of round at step 0.1 s, whose error is at most 1e-09" in drawing.caption, behind)
            self.assertEqual({len(axes.lines) for axes in drawing.draw(True).axes}, {3 if behind else 2})  # track and start

    def test_of_many_methods_the_most_wrong_are_shown(self):
        circles(self.folder, more=9)
        self.edit("results.csv", "error_max", lambda x: "1e-3")
        for label, error in (("more 8", "0.5"), ("more 5", "0.2")):
            self.edit("results.csv", "error_max", lambda x: error, lambda row: row[2] == label)
        shown = reading.Experiment(self.folder)
        titles = [axes.get_title(loc="left") for axes in moving.drawings(verdict.Verdict(shown, shown.cases[0]))[0].draw(True).axes]
        self.assertEqual(len(titles), moving.PANELS)
        self.assertLessEqual({"more 8", "more 5"}, set(titles))

    def test_a_run_that_ended_early_is_shown(self):
        folder = circles(self.folder)
        self.edit("results.csv", "status", lambda x: "not_converged", lambda row: row[2] == "lost")
        path = folder / "runs" / "lost" / "summary.json"
        path.write_text(json.dumps(json.loads(path.read_text()) | {"status": "not_converged"}))
        shown = reading.Experiment(folder)
        self.assertIn("Ended early: lost.", moving.drawings(verdict.Verdict(shown, shown.cases[0]))[0].caption)

    def test_report_draws_the_motion_and_is_the_same_again(self):
        folder = circles(self.folder)
        self.assertEqual(run(folder)[0], 0)
        first = (folder / "figures" / "motion_ball.svg").read_bytes()
        self.assertIn("A cross marks the start.", (folder / "report.html").read_text())
        self.assertEqual(run(folder)[0], 0)
        self.assertEqual((folder / "figures" / "motion_ball.svg").read_bytes(), first)

    def test_a_case_that_names_no_coordinates_has_a_portrait_of_each_method(self):
        shown = reading.Experiment(circles(self.folder, motion_of=()))
        drawing, = moving.drawings(verdict.Verdict(shown, shown.cases[0]))
        self.assertEqual(drawing.title, "Ball <b>: y against x")
        self.assertEqual(len(drawing.draw(True).axes), 3)
        self.assertIn("The track of lost leaves the frame.", drawing.caption)
        axes = drawing.draw(False).axes[0]  # in which a circle is a circle
        box = axes.get_window_extent()
        scales = [(high - low) / pixels for (low, high), pixels in ((axes.get_xlim(), box.width), (axes.get_ylim(), box.height))]
        self.assertAlmostEqual(scales[0] / scales[1], 1, places=9)

    def test_wrong_names_are_refused(self):
        for names, told in ((["x"], "two coordinates"), (["x", "w"], "column 'w' is missing")):
            with self.subTest(names=names):
                head = json.loads((circles(self.folder / names[-1], names) / "experiment.json").read_text())
                self.assertEqual(head["cases"][0]["motion"], names)
                status, said = run(self.folder / names[-1])
                self.assertEqual(status, 2)
                self.assertIn(told, said)


def turning(folder, stretches=5, lost=1e3, more=0, late=None, shrinks=1.0, small=0.5):
    """`circles` with stretches of twelve steps: `round` on the exact unit circle, `small` on one of half its size, `lost` far away. `late`
    has by how much later the stretches of a method begin. From one stretch to the next the motion `shrinks`, but not that of `lost`."""
    circles(folder, more=more)
    rows = [["case", "method", "step", "t", "x axis", "y axis", "stretch", "x", "y", "exact_x", "exact_y", "exact_x_between", "exact_y_between"]]
    for label, size in (("round", 1.0), ("small", small), ("lost", lost), *((f"more {k}", 1.0) for k in range(more))):
        for stretch in range(1, (stretches[label] if isinstance(stretches, dict) else stretches) + 1):
            for k in range(13):
                t = 20 * (stretch - 1) + k / 2 + (late or {}).get(label, 0)
                exact = shrinks ** (stretch - 1)
                own = size * (1 if label == "lost" else exact)
                cells = [own * math.cos(t), own * math.sin(t), exact * math.cos(t), exact * math.sin(t)]
                between = [exact * math.cos(t - 0.25), exact * math.sin(t - 0.25)] if k > 0 else [math.nan] * 2
                rows.append(["ball", label, "0.5", repr(t), "x [m]", "y [m]", str(stretch), *map(repr, cells + between)])
    measured(folder, "motion", rows, texts=("x axis", "y axis"))
    return folder


class Stretches(Fresh):
    def drawing(self, **of_turning):
        shown = reading.Experiment(turning(self.folder, **of_turning))
        return moving.drawings(verdict.Verdict(shown, shown.cases[0]))[0]

    def test_a_row_for_each_method_and_a_column_for_each_stretch(self):
        canvas = self.drawing().draw(True)
        self.assertEqual(len(canvas.axes), 15)
        for k, axes in enumerate(canvas.axes):
            exact, line = axes.lines
            size, begin = (1.0, 0.5, 1e3)[k // 5], 20 * (k % 5)
            for n, (x, y) in enumerate(zip(*line.get_data())):
                self.assertAlmostEqual(x, size * math.cos(begin + n / 2))
                self.assertAlmostEqual(y, size * math.sin(begin + n / 2))
            self.assertEqual(len(exact.get_xdata()), 24 * 4 + 1)  # two for each step, and a curve through them
            for n, (x, y) in enumerate(zip(*exact.get_data())):
                inside = 4 < n < 92  # at its ends no neighbour says how it goes on
                self.assertAlmostEqual(x, math.cos(begin + n / 16), delta=1e-9 if n % 4 == 0 else 5e-4 if inside else 5e-3)
                self.assertAlmostEqual(y, math.sin(begin + n / 16), delta=1e-9 if n % 4 == 0 else 5e-4 if inside else 5e-3)
        self.assertEqual([axes.get_title(loc="left") for axes in canvas.axes if axes.get_title(loc="left")], ["round", "small", "lost"])
        self.assertEqual([text.get_text() for text in canvas.axes[1].texts], ["t = 20 to 26 s"])
        self.assertEqual(len({(axes.get_xlim(), axes.get_ylim()) for axes in canvas.axes}), 1)

    def test_a_narrow_screen_has_the_first_the_middle_and_the_last(self):
        canvas = self.drawing().draw(False)
        self.assertEqual([text.get_text() for axes in canvas.axes for text in axes.texts], ["t = 0 to 6 s", "t = 40 to 46 s", "t = 80 to 86 s"])

    def test_rows_of_other_times_have_headings_of_their_own(self):
        drawing = self.drawing(late={"small": 0.5, "lost": 1.0})
        for wide, columns in ((True, (0, 20, 40, 60, 80)), (False, (0, 40, 80))):
            canvas = drawing.draw(wide)
            self.assertEqual([[text.get_text() for text in axes.texts] for axes in canvas.axes],
                             [[f"t = {late + t:g} to {late + t + 6:g} s"] for late in (0, 0.5, 1) for t in columns])
            for axes in canvas.axes:  # above its panel, below the name of the method, and beside the next one
                panel, text = axes.get_window_extent(), axes.texts[0].get_window_extent(canvas.renderer)
                names = [t.get_window_extent(canvas.renderer) for t in axes.findobj(lambda a: hasattr(a, "get_text") and a.get_text() ==
                                                                                  axes.get_title(loc="left") != "")]
                self.assertGreaterEqual(text.y0, panel.y1)
                self.assertTrue(all(text.y1 <= name.y0 + 1 for name in names))
                self.assertLess(text.x1, panel.x1 + 12)

    def test_a_run_of_fewer_stretches_has_fewer_panels(self):
        drawing = self.drawing(stretches={"round": 4, "small": 5, "lost": 4}, lost=1.1)
        canvas = drawing.draw(True)
        self.assertEqual(len(canvas.axes), 13)
        self.assertEqual([axes.texts[0].get_text() for axes in canvas.axes if axes.texts],
                         ["t = 0 to 6 s", "t = 20 to 26 s", "t = 40 to 46 s", "t = 60 to 66 s", "t = 80 to 86 s"])
        self.assertEqual([axes.get_xlabel() for axes in canvas.axes if axes.get_xlabel()], ["x [m]"] * 5)
        self.assertEqual(len(drawing.draw(False).axes), 9)  # of each the first, one in the middle and the last

    def test_what_is_far_away_leaves_the_frame_and_is_named(self):
        drawing = self.drawing()
        self.assertIn("The track of lost leaves the frame.", drawing.caption)
        self.assertLess(drawing.draw(True).axes[0].get_xlim()[1], 10)

    def test_the_frame_is_that_of_the_exact_motion_where_most_leave_it(self):
        drawing = self.drawing(small=1e4)
        self.assertIn("The tracks of small and lost leave the frame.", drawing.caption)
        self.assertLess(drawing.draw(True).axes[0].get_xlim()[1], 10)

    def test_where_the_motion_dies_away_each_column_has_its_axes(self):
        drawing = self.drawing(lost=1.1, shrinks=1e-3)
        axes = drawing.draw(True).axes
        for column in range(5):
            limits = {(one.get_xlim(), one.get_ylim()) for one in axes[column::5]}
            self.assertEqual(len(limits), 1)
            (low, high), _ = limits.pop()
            self.assertTrue(1 <= high / 1e-3 ** column < 3 and 1 <= -low / 1e-3 ** column < 3)
            self.assertTrue(axes[column].yaxis.majorTicks[0].label1.get_visible())
        self.assertIn("t = 80 to 86 s\naxes in 10⁻¹²", [text.get_text() for text in axes[4].texts])
        self.assertEqual([text.get_text() for text in axes[14].get_xticklabels()], ["\N{MINUS SIGN}2", "\N{MINUS SIGN}1", "0", "1", "2"])
        self.assertIn("Axes are the same in the panels of a column, in multiples of the power of ten above it.", drawing.caption)
        self.assertIn("The track of lost leaves the frame of some columns.", drawing.caption)

    def test_a_motion_may_die_away_to_numbers_that_no_axis_can_show(self):
        drawing = self.drawing(lost=1.1, shrinks=1e-80)  # 1e-320 in the last column
        axes = drawing.draw(True).axes
        self.assertIn("axes in 10⁻²⁴⁰", axes[3].texts[0].get_text())
        self.assertEqual(axes[4].texts[0].get_text(), "t = 80 to 86 s")
        for one in axes:
            self.assertTrue(all(len(text.get_text()) < 8 for text in one.get_xticklabels()))

    def test_a_stretch_without_numbers_has_an_empty_panel(self):
        folder = turning(self.folder, lost=1.1, shrinks=1e-3)
        table = folder / "measures" / "motion.csv"
        rows = load(table)
        save(table, [row if row[1] != "small" or row[6] != "3" else [*row[:7], *["nan"] * 6] for row in rows])
        shown = reading.Experiment(folder)
        drawing = moving.drawings(verdict.Verdict(shown, shown.cases[0]))[0]
        self.assertEqual([len(line.get_xdata()) for line in drawing.draw(True).axes[7].lines], [0, 0])
        self.assertIn("Axes are the same in the panels of a column", drawing.caption)

    def test_axes_are_the_same_where_the_motion_changes_little(self):
        drawing = self.drawing(lost=1.1, shrinks=0.9)
        self.assertEqual(len({(axes.get_xlim(), axes.get_ylim()) for axes in drawing.draw(True).axes}), 1)
        self.assertIn("Axes are the same in all panels.", drawing.caption)

    def test_nothing_leaves_the_frame_of_motions_alike(self):
        self.assertNotIn("leaves the frame", self.drawing(lost=1.1).caption)

    def test_of_many_methods_the_first_and_the_last_are_drawn(self):
        self.assertEqual(len(self.drawing(more=9).draw(True).axes), 4 * 5)

    def test_one_stretch_is_drawn_side_by_side(self):
        drawing = self.drawing(stretches=1)
        self.assertIn("Every step of the run from its start, t = 0 to 6 s.", drawing.caption)
        axes = drawing.draw(True).axes
        self.assertEqual([one.get_title(loc="left") for one in axes], ["round", "small", "lost"])
        self.assertEqual({line.get_linestyle() for one in axes for line in one.lines[:2]}, {"-"})  # also where steps turn by half a radian

    def test_side_by_side_each_has_its_times_and_the_exact_motion_at_these(self):
        drawing = self.drawing(stretches=1, late={"small": 0.5}, lost=1.1)
        self.assertIn("Every step of the run from its start.", drawing.caption)
        axes = drawing.draw(True).axes
        self.assertEqual([one.get_title(loc="left") for one in axes], [
            "round, t = 0 to 6 s", "small, t = 0.5 to 6.5 s", "lost, t = 0 to 6 s"])
        for one, begin in zip(axes, (0, 0.5, 0)):
            self.assertAlmostEqual(min(one.lines, key=lambda line: line.get_zorder()).get_xdata()[0], math.cos(begin))

    def test_the_table_has_no_second_figure(self):
        self.assertEqual(run(turning(self.folder))[0], 0)
        self.assertTrue((self.folder / "figures" / "motion_ball.svg").exists())
        self.assertFalse((self.folder / "figures" / "measure-motion_ball.svg").exists())


if __name__ == "__main__":
    unittest.main()
