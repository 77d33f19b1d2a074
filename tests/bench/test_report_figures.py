"""bench/report: names of lines, and the numbers and scales behind them."""
import math
import unittest

from synthetic import Fresh, U, reading, save, scales, synthetic

import canvas  # noqa: E402
import drift  # noqa: E402
import families  # noqa: E402
import lines  # noqa: E402
import series as series_of_runs  # noqa: E402
import verdict  # noqa: E402
import work_precision  # noqa: E402


class Names(Fresh):
    """Names of lines stand in the margin, are joined to their lines, and no two share a place."""

    def panel(self, count, **of_some):
        """Lines that end at 1, 2, ..., of which some have other members."""
        look = families.style(families.FAMILIES[0], 0, "full")
        return [lines.Line(f"method {k}", [1.0, 2.0], [1e-9, 1e-9 * (k + 1)], look, **of_some.get(f"m{k}", {})) for k in range(count)]

    def drawn(self, some, wide):
        axis = scales.ErrorAxis([line.y for line in some], U)
        one = lines.Panel(some, axis, "t", "error", lambda _, axes: scales.time_axis(axes, 0, 2))
        canvas = lines.draw([one], wide)
        return one, canvas, [t for t in canvas.axes[0].texts if t.get_text().strip()]

    def test_names_touch_neither_each_other_nor_lines_nor_the_edge(self):
        for wide in (True, False, 241.0):
            one, canvas, names = self.drawn(self.panel(9), wide)
            self.assertEqual(len(names), lines.LINES)
            boxes = [t.get_window_extent(canvas.renderer) for t in names]
            panel = canvas.axes[0].get_window_extent(canvas.renderer)
            for k, box in enumerate(boxes):
                self.assertGreater(box.x0, panel.x1)  # where no line is
                self.assertLessEqual(box.x1, canvas.width)
                self.assertFalse(any(box.y0 < other.y1 - 2 and other.y0 < box.y1 - 2 for other in boxes[:k]))  # but for descenders
            self.assertEqual(len(canvas.figure.artists), 2 * len(names))  # to the margin, and in it to the name

    def test_of_many_lines_the_worst_and_those_that_fail_are_named(self):
        some = self.panel(9, m6={"fails": True}, m7={"ended": True})
        one, canvas, names = self.drawn(some, True)
        told = {t.get_text() for t in names}
        self.assertLessEqual({"method 6", "method 7", "method 8"}, told)  # the last one is the worst
        self.assertEqual(lines.in_grey([one]), "In grey: method 3, method 4 and method 5.")
        self.assertIn("X", {line.get_marker() for line in canvas.axes[0].lines})  # where the run ended early
        self.assertEqual(lines.in_grey([self.drawn(self.panel(6), True)[0]]), "")

    def test_a_group_has_one_name(self):
        group = {f"m{k}": {"group": "3 kept"} for k in range(3)}
        _, _, names = self.drawn(self.panel(5, **group), True)
        self.assertEqual(sorted(t.get_text() for t in names), ["3 kept", "method 3", "method 4"])
        _, _, names = self.drawn(self.panel(2, m0={"group": "1 kept"}), True)
        self.assertEqual(sorted(t.get_text() for t in names), ["method 0", "method 1"])  # one line is no group

    def test_failed_at_the_common_step_is_marked(self):
        shown = reading.Experiment(synthetic(self.folder, steps=(0.4,)))
        said = verdict.Verdict(shown, shown.cases[0])
        for drawing in drift.at_equal_step(said) + drift.drawings(said):
            self.assertIn("A cross: the run ended early.", drawing.caption)
            self.assertIn("X", {line.get_marker() for axes in drawing.draw(True).axes for line in axes.lines})
        drawing = work_precision.drawings(said)[0]
        self.assertIn("bad at step 0.4 s", drawing.caption)
        self.assertIn("✗ bad", [t.get_text() for t in drawing.draw(True).axes[0].texts])

    def test_lines_with_a_name_are_in_the_frame(self):
        """One of whose runs failed, which is always named, takes longer than all others."""
        synthetic(self.folder, extra_methods=9)
        self.edit("cost.csv", "ns_per_step_min", lambda x: repr(1e4 * float(x)), lambda row: row[1] == "bad")
        shown = reading.Experiment(self.folder)
        said = verdict.Verdict(shown, shown.cases[0])
        self.assertIn("bad", said.named())
        low, high = work_precision.drawings(said)[0].draw(True).axes[0].get_xlim()
        costs = [p.cost for c in said.curves if c.label in said.named() for p in c.measured()]
        self.assertTrue(low < min(costs) and max(costs) < high)
        self.assertNotIn("leave the frame", work_precision.drawings(said)[0].caption)

    def test_longer_runs_of_lines_in_grey_leave_the_frame_and_this_is_said(self):
        synthetic(self.folder, extra_methods=9)
        self.edit("cost.csv", "ns_per_step_min", lambda x: repr(1e4 * float(x)), lambda row: row[1] == "mid")
        shown = reading.Experiment(self.folder)
        self.assertIn("Longer runs leave the frame on the right.", work_precision.drawings(verdict.Verdict(shown, shown.cases[0]))[0].caption)


class Bands(unittest.TestCase):
    def test_the_name_of_a_band_stands_where_no_line_crosses(self):
        drawing = canvas.Canvas(400, 200, 11)
        axes = drawing.panel(50, 10, 300, 150)
        box = axes.get_window_extent(drawing.renderer)
        at_ends = [(x, y) for y in range(200) for x in (box.x0 + 10, box.x0 + 40, box.x1 - 40, box.x1 - 10)]
        for lines_at in ([], at_ends):
            work_precision.band_text(drawing, "phase lost", box, "top", 0.88, lines_at)
            text = axes.texts[-1].get_window_extent(drawing.renderer)
            self.assertFalse(any(text.x0 <= x <= text.x1 and text.y0 <= y <= text.y1 for x, y in lines_at))
            self.assertEqual(text.x0 < box.x0 + 8, not lines_at)  # at an end where there is room


class Steps(unittest.TestCase):
    def labels(self, width, steps):
        """The boxes of the labels at an axis of steps, in pixels, from left to right."""
        drawing = canvas.Canvas(width + 60, 200, 11)
        axes = drawing.panel(30, 10, width, 150)
        scales.step_axis(axes, steps, lambda label: drawing.measure(label, 0.92)[0])
        return [t.get_window_extent(drawing.renderer) for t in axes.get_xticklabels()]

    def test_labels_of_steps_do_not_touch(self):
        steps = [5.0 / n for n in (1, 1.6, 2.5, 4, 6.4, 16, 40, 100, 640, 4000, 16000)]
        for width in (110, 300, 600):
            boxes = self.labels(width, steps)
            for one, next_one in zip(boxes, boxes[1:]):
                self.assertGreater(next_one.x0 - one.x1, 4)
        self.assertGreater(len(self.labels(600, steps)), len(self.labels(110, steps)))

    def test_few_steps_are_all_labelled(self):
        self.assertEqual(len(self.labels(300, [0.4, 0.2, 0.1])), 3)
        self.assertEqual(len(self.labels(300, [0.4])), 1)


class Times(unittest.TestCase):
    def test_no_label_of_a_time_leaves_the_figure(self):
        for end in (1e8, 1.3e8):  # the last tick at the edge of the panel, and inside
            drawing, axes, *_ = work_precision.frame_of(False, ["a name"])
            axes.set(xscale="log", yscale="log", xlim=(1e5, end), ylim=(1e-9, 1))
            work_precision.ticks(drawing, axes, "time")
            labels = axes.get_xticklabels()
            self.assertEqual(labels[-1].get_text(), "100 ms")
            boxes = [label.get_window_extent(drawing.renderer) for label in labels]
            self.assertTrue(all(b.x0 - a.x1 > 1 for a, b in zip(boxes, boxes[1:])))
            self.assertLessEqual(labels[-1].get_window_extent(drawing.renderer).x1, drawing.width)
            self.assertEqual([label.get_horizontalalignment() for label in labels[:-1]], ["center"] * (len(labels) - 1))


class Numbers(Fresh):
    def test_quad_difference_keeps_its_digits(self):
        path = self.folder / "series.csv"
        save(path, [["t [s]", "H [J]"], ["0", "1.333333333333333333333333333333333331"],
                    ["1", "1.333333333333333333333333333333333335"]])
        self.assertEqual(series_of_runs.read_series(path, "H", "quad").change, [0, 4e-36])
        self.assertEqual(series_of_runs.read_series(path, "H", "double").change, [0, 0])  # control: double cannot see it

    def test_zero_has_a_line_of_its_own(self):
        axis = scales.ErrorAxis([[0.0, 1e-12, math.nan], [1e-3, 1e9]], U)
        zero, small, gap = axis.place([0.0, 1e-12, math.nan])
        self.assertTrue(0 < zero < 1e-12 and small == 1e-12 and math.isnan(gap))
        self.assertLess(10.0**axis.high, 1e9)  # what exploded leaves the frame
        self.assertEqual(len(axis.remarks()), 3)
        self.assertEqual(scales.ErrorAxis([[1e-14]], U).remarks(), [])

    def part(self, axis, values):
        """The part of the panel, from its bottom, at which values stand."""
        drawn = canvas.Canvas(300, 200, 11).panel(30, 10, 250, 150)
        axis.apply(drawn)
        low, high = (math.log10(y) for y in drawn.get_ylim())
        return [(math.log10(v) - low) / (high - low) for v in axis.place(values)]

    def test_tiny_first_samples_leave_no_panel_empty(self):
        """Errors that grow from 1e-6 to 1e-3, but for three first ones of 1e-15, fill three quarters of the panel."""
        line = [1e-15] * 3 + [10 ** (-6 + 3 * k / 40) for k in range(41)]
        axis = scales.ErrorAxis([line], U)
        filled = self.part(axis, line[3:])
        self.assertGreater(max(filled) - min(filled), 0.75)
        self.assertEqual(axis.remarks(), ["The smallest values leave the frame at the bottom.", "Unit round-off is below the frame."])
        few = scales.ErrorAxis([line[2:10]], U)  # of few values, which may be all there is, none leaves it
        self.assertGreater(self.part(few, line[2:10])[0], 0)

    def test_round_off_is_seen_where_errors_come_near_it(self):
        for error, seen in ((1e-14, True), (1e-11, False)):
            axis = scales.ErrorAxis([[error, 1e-3]], U)
            self.assertEqual((axis.seen, "Unit round-off is below the frame." in axis.remarks()), (seen, not seen))
            self.assertEqual(self.part(axis, [U])[0] > 0, seen)
        self.assertEqual(scales.remarks_of([scales.ErrorAxis([[x]], U) for x in (1e-14, 1e-3)]), [])  # one of them shows it

    def test_what_is_bounded_by_round_off_has_no_line_for_zero(self):
        axis = scales.ErrorAxis([[0.0, 1e-17, 1e-15], [1e-3]], U, bounded=True)
        self.assertEqual(axis.place([0.0, 1e-17, 1e-15]), [U, U, 1e-15])
        self.assertEqual(axis.remarks(), ["Nothing is drawn below unit round-off."])

    def test_of_values_that_are_too_small_for_the_frame_beside_zeros(self):
        axis = scales.ErrorAxis([[0.0] + [1e-30] + [1e-8] * 40], U)
        zero, small, other = axis.place([0.0, 1e-30, 1e-8])
        self.assertTrue(zero == small < other)
        self.assertIn("Zeros, and what is too small to be in the frame, are drawn on the line labelled ≈ 0.", axis.remarks())

    def test_envelope_keeps_the_largest(self):
        times = [0.01 * k for k in range(5001)]
        values = [abs(math.sin(7 * t)) * (3 if k == 1234 else 1) for k, t in enumerate(times)]
        t, v = scales.envelope(times, values)
        self.assertLessEqual(len(t), 80)
        self.assertIn((times[1234], values[1234]), list(zip(t, v)))
        self.assertEqual(t, sorted(t))

    def test_largest_move_against_the_expected_direction(self):
        series = series_of_runs.Series([0, 1, 2, 3, 4], "s", 5, [0, -2, -1, -4, -3.5], "J", [], [])
        self.assertEqual(series.setbacks("decreasing"), [0, 0, 1, 1, 1])
        self.assertEqual(series.setbacks("increasing"), [0, 2, 2, 4, 4])


if __name__ == "__main__":
    unittest.main()
