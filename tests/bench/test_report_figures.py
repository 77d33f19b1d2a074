"""bench/report: figures that fit their sheet, and the numbers and scales behind them."""
import math
import unittest

from synthetic import Fresh, U, figures, reading, save, scales, synthetic

import canvas  # noqa: E402
import verdict  # noqa: E402
import work_precision  # noqa: E402


class Sheets(Fresh):
    def test_many_methods_fit_the_sheet(self):
        shown = reading.Experiment(synthetic(self.folder, extra_methods=9))
        for case in shown.cases:
            for drawing in [figures.drift_at_equal_step(shown, case)]:
                for wide in (True, False):
                    with self.subTest(drawing.name, wide=wide):
                        self.check_layout(drawing.draw(wide))

    def check_layout(self, sheet):
        """Legend below every panel; nothing sticks out of the sheet; no two tick labels of an axis overlap."""
        sheet.png()
        figure, renderer = sheet.figure, sheet.figure.canvas.get_renderer()
        width, height = figure.bbox.size
        legend = figure.legends[0].get_window_extent(renderer)
        self.assertEqual(len(figure.legends[0].get_texts()), len(sheet.methods) + len(sheet.levels))
        boxes = [a.get_tightbbox(renderer) for a in figure.axes]
        self.assertLess(legend.y1, min(b.y0 for b in boxes))
        for box in [legend, *boxes, *(t.get_window_extent(renderer) for t in figure.texts)]:
            self.assertGreaterEqual(min(box.x0, box.y0), -0.5)
            self.assertLessEqual(box.x1, width + 0.5)
            self.assertLessEqual(box.y1, height + 0.5)
        for i, box in enumerate(boxes):
            self.assertFalse(any(box.overlaps(other) for other in boxes[:i]))
        for axes in figure.axes:
            for axis in (axes.xaxis, axes.yaxis):
                low, high = sorted(axis.get_view_interval())
                labels = [t.label1.get_window_extent(renderer) for t in axis.get_major_ticks()
                          if low <= t.get_loc() <= high]
                for i, box in enumerate(labels):
                    self.assertFalse(any(box.overlaps(other) for other in labels[:i]))

    def test_failed_at_the_common_step_is_marked(self):
        shown = reading.Experiment(synthetic(self.folder, steps=(0.4,)))
        sheet = figures.drift_at_equal_step(shown, shown.cases[0]).draw(True)
        self.assertIn("run ended early", sheet.levels)
        self.assertIn("bad at step 0.4 s", work_precision.drawings(verdict.Verdict(shown, shown.cases[0]))[0].caption)


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
            drawing, axes = work_precision.NARROW.canvas()
            axes.set(xscale="log", yscale="log", xlim=(1e5, end), ylim=(1e-9, 1))
            work_precision.ticks(drawing, axes, "time", work_precision.NARROW)
            labels = axes.get_xticklabels()
            self.assertEqual(labels[-1].get_text(), "100 ms")
            self.assertLessEqual(labels[-1].get_window_extent(drawing.renderer).x1, drawing.width)
            self.assertEqual([label.get_horizontalalignment() for label in labels[:-1]], ["center"] * (len(labels) - 1))


class Numbers(Fresh):
    def test_quad_difference_keeps_its_digits(self):
        path = self.folder / "series.csv"
        save(path, [["t [s]", "H [J]"], ["0", "1.333333333333333333333333333333333331"],
                    ["1", "1.333333333333333333333333333333333335"]])
        self.assertEqual(reading.read_series(path, "H", "quad").change, [0, 4e-36])
        self.assertEqual(reading.read_series(path, "H", "double").change, [0, 0])  # control: double cannot see it

    def test_zero_has_a_line_of_its_own(self):
        axis = scales.ErrorAxis([[0.0, 1e-12, math.nan], [1e-3, 1e9]], U)
        zero, small, gap = axis.place([0.0, 1e-12, math.nan])
        self.assertTrue(0 < zero < U and small == 1e-12 and math.isnan(gap))
        self.assertLess(10.0**axis.high, 1e9)  # what exploded leaves the frame
        self.assertEqual(len(axis.remarks()), 2)
        self.assertEqual(scales.ErrorAxis([[1e-12]], U).remarks(), [])

    def test_envelope_keeps_the_largest(self):
        times = [0.01 * k for k in range(5001)]
        values = [abs(math.sin(7 * t)) * (3 if k == 1234 else 1) for k, t in enumerate(times)]
        t, v = scales.envelope(times, values)
        self.assertLessEqual(len(t), 80)
        self.assertIn((times[1234], values[1234]), list(zip(t, v)))
        self.assertEqual(t, sorted(t))

    def test_largest_move_against_the_expected_direction(self):
        series = reading.Series([0, 1, 2, 3, 4], "s", 5, [0, -2, -1, -4, -3.5], "J", [], [])
        self.assertEqual(series.setbacks("decreasing"), [0, 0, 1, 1, 1])
        self.assertEqual(series.setbacks("increasing"), [0, 2, 2, 4, 4])


if __name__ == "__main__":
    unittest.main()
