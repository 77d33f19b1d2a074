"""bench/report: Poincaré's integral invariant, up to where the carried loop is resolved."""
import unittest

from synthetic import Fresh, reading, run, measured, synthetic

import figures  # noqa: E402
import loops  # noqa: E402
import verdict  # noqa: E402


class Loops(Fresh):
    def write(self, rows=()):
        """The synthetic experiment: `mid` keeps the integral, `rk` loses it evenly and winds its loop up at the end."""
        synthetic(self.folder)
        table = [["case", "method", "step", "t", "integral", "uncertainty"]]
        for k in range(11):
            table.append(["osc", "mid", "0.4", repr(0.4 * k), repr(1 + 2e-13 * (-1) ** k * (k > 0)), "1e-13"])
            table.append(["osc", "rk", "0.4", repr(0.4 * k), repr(1 - 1e-5 * k), "1e-5" if k > 7 else "1e-9"])
        measured(self.folder, "poincare-loop", table + list(rows))
        return reading.Experiment(self.folder)

    def test_lines_end_where_the_loop_is_wound_up(self):
        shown = self.write()
        found = loops.loops(shown, shown.cases[0])
        self.assertEqual((len(found["mid"].times), found["mid"].whole), (11, True))
        self.assertEqual((len(found["rk"].times), found["rk"].whole), (8, False))
        self.assertAlmostEqual(max(found["mid"].deviations), 2e-13, places=15)
        self.assertAlmostEqual(max(found["rk"].deviations), 7e-5, places=12)
        self.assertEqual(loops.loops(shown, shown.cases[1]), {})

    def test_times_of_runs_that_go_back_are_those_since_the_start(self):
        shown = self.write([["osc", "back", "0.4", "-0.0", "1", "0"], ["osc", "back", "0.4", "-0.8", "1", "0"]])
        self.assertEqual(loops.loops(shown, shown.cases[0])["back"].times, [0, 0.8])
        self.assertEqual(figures.time_label({"time": "-40", "time_unit": "s"}), "−t [s]")
        self.assertEqual(figures.time_label({"time": "-40"}, "t at the turn"), "−t at the turn")
        self.assertEqual(figures.time_label({"time": 40}), "t")

    def test_the_page_shows_who_loses_it(self):
        shown = self.write()
        drawing, = loops.drawings(verdict.Verdict(shown, shown.cases[0]))
        self.assertIn("so wound up", drawing.caption)
        self.assertIn("at step 0.4 s", drawing.caption)
        self.assertEqual(run(self.folder)[0], 0)
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertIn("Poincaré's integral invariant", page.replace("&#x27;", "'"))
        self.assertIn("Of 2 methods the integral moves most for rk, by 7.0e-05 of itself.", page)
        self.assertTrue((self.folder / "figures" / "loop_osc.svg").exists())
        self.assertFalse((self.folder / "figures" / "loop_damped.svg").exists())

    def test_what_is_no_number_is_refused(self):
        self.write([["osc", "mid", "0.4", "5", "one", "1e-13"]])
        status, stderr = run(self.folder)
        self.assertEqual(status, 2)
        self.assertIn("poincare-loop.csv, line 24, column integral", stderr)


if __name__ == "__main__":
    unittest.main()
