"""bench/report: a disc of states carried along by methods, through a lens that undoes the exact contraction."""
import math
import unittest

from synthetic import Fresh, load, reading, run, save, measured, synthetic

import contraction  # noqa: E402
import verdict  # noqa: E402

NU = 0.5


def discs(folder, rows=()):
    """The synthetic experiment, in which `mid` contracts by the law e^{-t/2} and `rk` by 1.1 times as much at the end."""
    synthetic(folder)
    table = [["case", "method", "step", "t", "area", "law", "outline"]]
    for label, worse in (("mid", 0.0), ("rk", 0.1)):
        for k in range(11):
            t, law = 0.4 * k, math.exp(-NU * 0.4 * k)
            size = math.sqrt(law * (1 + worse * k / 10))
            outline = ";".join(f"{size * math.cos(a)!r} {size * math.sin(a)!r}" for a in (0, 1.5, 3, 4.5)) if k % 2 == 0 else ""
            table.append(["osc", label, "0.4", repr(t), repr(law * (1 + worse * k / 10)), repr(law), outline])
    measured(folder, "contraction", table + list(rows), texts=("outline",))
    return folder


class Contraction(Fresh):
    def shown(self, **more):
        return reading.Experiment(discs(self.folder, **more))

    def test_images_keep_their_area_where_the_law_is_kept(self):
        shown = self.shown()
        found = contraction.carried(shown, shown.cases[0])
        self.assertEqual(list(found), ["mid", "rk"])
        for label, last in (("mid", 1.0), ("rk", 1.1)):
            one = found[label]
            self.assertEqual(len(one.images), 6)
            self.assertAlmostEqual(one.ratios[-1], last, places=12)
            for (t, xs, ys), ratio in zip(one.images, one.ratios[::2]):
                for x, y in zip(xs, ys):
                    self.assertAlmostEqual(math.hypot(x, y) ** 2, ratio, places=9)
        self.assertLess(max(found["mid"].deviations), 1e-15)
        self.assertAlmostEqual(found["rk"].deviations[-1], 0.1, places=12)

    def test_axes_are_the_coordinates_with_their_units(self):
        discs(self.folder)
        for path in self.folder.glob("runs/osc-*/series.csv"):
            rows = load(path)
            save(path, [[*rows[0][:2], "p [kg m^2/s]", *rows[0][2:]]] + [[*r[:2], "0", *r[2:]] for r in rows[1:]])
        shown = reading.Experiment(self.folder)
        drawing, = contraction.drawings(verdict.Verdict(shown, shown.cases[0]))
        axes = drawing.draw(True).axes[0]
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("q [m]", "p [kg m²/s]"))

    def test_the_figure_names_methods_with_their_last_ratio(self):
        shown = self.shown()
        drawing, = contraction.drawings(verdict.Verdict(shown, shown.cases[0]))
        for wide in (True, False):
            canvas = drawing.draw(wide)
            self.assertEqual(sorted(a.get_title(loc="left") for a in canvas.axes), ["", "mid: 1", "rk: 1.1"])
            self.assertEqual(canvas.axes[0].get_ylabel(), "momentum")  # where runs have one coordinate alone
            deviations = canvas.axes[-1]
            for panel in canvas.axes[:-1]:  # which hold every image
                for line in panel.lines:
                    for values, (low, high) in zip(line.get_data(), (panel.get_xlim(), panel.get_ylim())):
                        self.assertLess(low, min(values))
                        self.assertGreater(high, max(values))
            self.assertGreaterEqual(deviations.get_ylim()[1], 0.1)
            boxes = [t.get_window_extent(canvas.renderer) for t in deviations.texts]
            self.assertEqual(len(boxes), 2)
            self.assertFalse(boxes[0].overlaps(boxes[1]))
            self.assertLessEqual(max(b.x1 for b in boxes), canvas.width)

    def test_no_name_leaves_the_figure(self):
        discs(self.folder)
        for name in ("experiment.json", "results.csv", "cost.csv", "measures/contraction.csv"):
            path = self.folder / name
            path.write_text(path.read_text().replace('"mid"', '"a method of a long name"').replace(",mid,", ",a method of a long name,"))
        shown = reading.Experiment(self.folder)
        drawing, = contraction.drawings(verdict.Verdict(shown, shown.cases[0]))
        for wide in (True, False):
            canvas = drawing.draw(wide)
            texts = canvas.axes[-1].texts
            self.assertIn("a method of a long name", [t.get_text() for t in texts])
            self.assertLessEqual(max(t.get_window_extent(canvas.renderer).x1 for t in texts), canvas.width)

    def test_a_case_without_a_law_has_no_figure(self):
        shown = self.shown()
        self.assertEqual(contraction.drawings(verdict.Verdict(shown, shown.cases[1])), [])

    def test_the_page_has_a_section_for_it(self):
        self.assertEqual(run(discs(self.folder))[0], 0)
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertEqual(page.count("Contraction of areas</h3>"), 1)
        self.assertTrue((self.folder / "figures" / "contraction_osc.svg").exists())
        (self.folder / "measures" / "contraction.csv").unlink()
        self.assertEqual(run(self.folder)[0], 0)
        self.assertNotIn("Contraction of areas", (self.folder / "report.html").read_text(encoding="utf-8"))

    def test_wrong_numbers_are_refused_in_one_line(self):
        for row, told in ((["osc", "mid", "0.4", "5", "1", "0", ""], "column law: expected a positive number"),
                          (["osc", "mid", "0.4", "5", "1", "1", "1 2;3"], "column outline: expected pairs of numbers"),
                          (["osc", "mid", "0.4", "five", "1", "1", ""], "column t")):
            with self.subTest(row=row):
                status, said = run(discs(self.folder / row[5] / row[3] / str(len(row[6])), [row]))
                self.assertEqual(status, 2)
                self.assertIn(told, said)
                self.assertEqual(len(said.strip().splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
