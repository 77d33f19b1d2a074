"""bench/report: errors of frequencies against the step, and who has an error that grows."""
import unittest

from synthetic import Fresh, load, measured, reading, run, save, synthetic

import frequencies  # noqa: E402
import verdict  # noqa: E402


class Frequencies(Fresh):
    def write(self, rows=()):
        """The synthetic experiment: `mid` is wrong by h^2 steadily, `rk` by less and more and more; `bad` is not followed."""
        synthetic(self.folder)
        table = [["case", "method", "step", "t", "vector", "frequency", "error", "change"]]
        for h in (0.1, 0.4, 0.2):
            table.append(["osc", "mid", repr(h), "40", "phase", "-1.5", repr(1e-2 * h * h), repr(1e-5 * h * h)])
            table.append(["osc", "rk", repr(h), "40", "phase", "-1.5", repr(-1e-3 * h**4), repr(1e-3 * h**4)])
        table.append(["osc", "bad", "0.1", "40", "phase", "nan", "nan", "nan"])
        measured(self.folder, "frequency", table + list(rows), texts=("vector",), over="step")
        return reading.Experiment(self.folder)

    def test_lines_go_from_the_largest_step_to_the_finest(self):
        shown = self.write()
        (rate, lines), = frequencies.frequencies(shown, shown.cases[0]).values()
        self.assertEqual(rate, -1.5)
        self.assertEqual(lines["mid"].steps, [0.4, 0.2, 0.1])
        self.assertAlmostEqual(lines["mid"].errors[0], 1.6e-3, places=12)
        self.assertEqual((lines["mid"].steady, lines["rk"].steady), (True, False))
        self.assertNotIn("bad", lines)
        self.assertEqual(frequencies.frequencies(shown, shown.cases[1]), {})

    def test_errors_of_rounding_are_steady(self):
        """Angles are known to 1e-16, a rate over 40 s to a few 1e-18 and no better."""
        shown = self.write([["osc", "bad", repr(h), "40", "still", "1e-20", "3e-19", "-2e-17"] for h in (0.4, 0.2)]
                           + [["osc", "rk", "0.4", "40", "still", "1e-20", "3e-16", "-2e-15"]])
        lines = frequencies.frequencies(shown, shown.cases[0])["still"][1]
        self.assertEqual((lines["bad"].steady, lines["rk"].steady), (True, False))

    def test_the_page_says_whose_frequency_is_wrong(self):
        shown = self.write()
        drawing, = frequencies.drawings(verdict.Verdict(shown, shown.cases[0]))
        self.assertIn("In the solution phase turns by -1.5 rad per s.", drawing.caption)
        self.assertIn("a slow oscillation is left: rk.", drawing.caption)
        self.assertEqual(run(self.folder)[0], 0)
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertTrue("<desc>Errors of frequencies against the step.</desc>" in page)  # one method alone is steady
        self.assertTrue((self.folder / "figures" / "frequencies_osc.svg").exists())
        path = self.folder / "measures" / "frequency.csv"
        save(path, [*load(path), ["osc", "bad", "0.4", "40", "phase", "-1.5", "1e-4", "1e-7"]])
        shown = reading.Experiment(self.folder)
        told = frequencies.described(verdict.Verdict(shown, shown.cases[0]), frequencies.frequencies(shown, shown.cases[0]))
        self.assertEqual(told, "At step 0.4 the frequency of phase is best with bad, wrong by 1.0e-04, and worst with mid, by 1.6e-03 "
                         "rad per s.")
        self.assertFalse((self.folder / "figures" / "frequencies_damped.svg").exists())

    def test_what_is_no_number_is_refused(self):
        self.write([["osc", "mid", "0.4", "40", "phase", "1", "one", "0"]])
        status, stderr = run(self.folder)
        self.assertEqual(status, 2)
        self.assertIn("frequency.csv, line 9, column error", stderr)


if __name__ == "__main__":
    unittest.main()
