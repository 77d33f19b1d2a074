"""bench/report: tables of measures that have no figure of their own."""
import unittest

from synthetic import Fresh, measured as table_of, reading, run, synthetic

import measured  # noqa: E402
import verdict  # noqa: E402


class Measured(Fresh):
    def drawing(self, columns, rows, over="time"):
        """That of a measure `spread`, whose rows are (method, step, t, cells...)."""
        synthetic(self.folder)
        table_of(self.folder, "spread", [["case", "method", "step", "t", *columns], *(["osc", *map(str, row)] for row in rows)],
                 texts=("word",), over=over)
        shown = reading.Experiment(self.folder)
        return measured.drawings(verdict.Verdict(shown, shown.cases[0]))

    def rows(self, value, cells=1):
        return [(method, 0.4, 0.4 * k, *[value(k, n)] * cells) for n, method in enumerate(("mid", "rk")) for k in range(10)]

    def test_each_column_of_numbers_is_a_panel(self):
        drawing, = self.drawing(["spread", "word", "width"], [(m, h, t, x, "why", 2 * x) for m, h, t, x in
                                                              self.rows(lambda k, n: 1 + 0.1 * k * n)])
        self.assertIn("At step 0.4 s.", drawing.caption)
        canvas = drawing.draw(True)
        self.assertEqual([axes.get_ylabel() for axes in canvas.axes], ["spread", "width"])
        self.assertEqual({axes.get_yscale() for axes in canvas.axes}, {"linear"})
        self.assertEqual([len(axes.get_lines()) for axes in canvas.axes], [2, 2])
        self.assertEqual(run(self.folder)[0], 0)
        page = (self.folder / "report.html").read_text()
        self.assertIn('href="measures/spread.csv"', page)
        self.assertEqual(page.count('<h3 id="measure-spread-osc">spread</h3>'), 1)
        section = page[page.index('<h3 id="measure-spread-osc">'):]
        self.assertEqual(section[:section.index("</figure>")].count("<svg"), 2)  # for wide screens and for narrow ones

    def test_decades_stand_on_a_logarithmic_axis_and_signs_do_not(self):
        drawing, = self.drawing(["spread"], self.rows(lambda k, n: 10.0 ** (k - 9)))
        self.assertEqual(drawing.draw(True).axes[0].get_yscale(), "log")

    def test_signs_stand_on_a_linear_axis(self):
        drawing, = self.drawing(["spread"], self.rows(lambda k, n: (-1) ** k * 10.0**k))
        self.assertEqual(drawing.draw(True).axes[0].get_yscale(), "linear")

    def test_over_the_step_each_run_is_a_mark(self):
        rows = [(method, h, 40, h * (n + 1)) for n, method in enumerate(("mid", "rk")) for h in (0.4, 0.2, 0.1)]
        drawing, = self.drawing(["spread"], rows, over="step")
        axes = drawing.draw(True).axes[0]
        self.assertEqual(axes.get_xlabel(), "step [s]")
        self.assertEqual(sorted(axes.get_lines()[0].get_xdata()), [0.1, 0.2, 0.4])
        self.assertNotEqual(axes.get_lines()[0].get_marker(), "")

    def test_empty_cells_leave_gaps(self):
        drawing, = self.drawing(["spread"], self.rows(lambda k, n: "" if k == 3 else 1.0 + k))
        drawing.draw(False)

    def test_a_case_without_rows_has_no_figure(self):
        self.assertEqual(self.drawing(["spread"], []), [])


if __name__ == "__main__":
    unittest.main()
