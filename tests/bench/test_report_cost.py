"""bench/report: runs that were made at equal cost, and on which machine costs were measured."""
import json
import math
import unittest

from synthetic import Fresh, describe, load, parsed, reading, run, save, synthetic

import bibliography  # noqa: E402
import verdict  # noqa: E402
import verdict_table  # noqa: E402


def at_equal_cost(folder, level=2e4):
    """The synthetic experiment, with a run of `rk` at equal cost: its error and drift are numbers that no other run has."""
    rows = load(synthetic(folder) / "results.csv")
    heads = rows[0]
    one = next(dict(zip(heads, r)) for r in rows[1:] if r[heads.index("method")] == "rk" and r[heads.index("case")] == "osc")
    one |= {"step": "0.07", "error_max": "1.23e-5", "energy:max": "4.5e-7", "run": "osc-rk"}
    save(folder / "equal_cost.csv", [["level_ns", *heads], [level, *one.values()]])
    describe(folder)
    return folder


class EqualCost(Fresh):
    def test_the_verdict_takes_the_run_that_was_made(self):
        shown = reading.Experiment(at_equal_cost(self.folder))
        said = verdict.Verdict(shown, shown.cases[0])
        self.assertEqual(said.level, 2e4)
        row = next(r for r in said.rows if r.label == "rk")
        self.assertEqual((row.error, row.drift, row.run.step, row.off), (1.23e-5, 4.5e-7, 0.07, False))
        other = next(r for r in said.rows if r.label == "mid")  # no run was made of it: as without equal_cost.csv
        self.assertIn(other.run.step, (0.4, 0.2, 0.1))
        self.assertIn("each method was run at the step that costs this", verdict_table.caption(said))
        self.assertEqual(len(row.curve.points), 3)  # the run is not a point of work and precision

    def test_without_such_runs_errors_are_interpolated(self):
        shown = reading.Experiment(synthetic(self.folder))
        said = verdict.Verdict(shown, shown.cases[0])
        self.assertEqual(said.made, {})
        self.assertIn("the error is interpolated between runs", verdict_table.caption(said))

    def test_a_run_without_an_error_has_none(self):
        at_equal_cost(self.folder)
        self.edit("equal_cost.csv", "error_max", lambda cell: "")
        shown = reading.Experiment(self.folder)
        row = next(r for r in verdict.Verdict(shown, shown.cases[0]).rows if r.label == "rk")
        self.assertTrue(math.isnan(row.error))

    def test_every_run_is_listed(self):
        self.assertEqual(run(at_equal_cost(self.folder))[0], 0)
        text = parsed(self.folder).text
        self.assertIn("0.07 equal cost", text)
        self.assertIn("osc-rk settings samples summary", text)

    def test_levels_are_positive(self):
        status, told = run(at_equal_cost(self.folder, level=0))
        self.assertEqual(status, 2)
        self.assertIn("equal_cost.csv, line 2, column level_ns: expected one positive number for a case", told)


class Machine(Fresh):
    def test_provenance_says_where_and_when(self):
        synthetic(self.folder)
        (self.folder / "machine.json").write_text(json.dumps({
            "cpu": "Abacus 3 <1 GHz>", "processors": 2, "system": "Debian", "host": "here", "date": "2026-01-02 03:04 UTC",
            "load": [0.5, 1.25]}))
        self.assertEqual(run(self.folder)[0], 0)
        text = parsed(self.folder).text
        for said in ("Abacus 3 <1 GHz>", "2026-01-02 03:04 UTC", "0.50 and 1.25 processes before and after the timings, on 2",
                     "the median repetition took 1.25 times as long as the fastest, in the worst of 16 timings 2.50 times; 6 above"):
            self.assertIn(said, text)

    def test_works_are_linked_by_their_doi(self):
        entry, = bibliography.entries(["ahnert-mulansky2011"]).values()
        self.assertTrue(entry.startswith("@inproceedings{ahnert-mulansky2011,") and entry.endswith("}"))
        self.assertEqual(bibliography.link(entry), "https://doi.org/10.1063/1.3637934")
        self.assertEqual(bibliography.link("@book{x, year = {1964}}"), "")
        made = bibliography.bibtex({"name": "kepler", "reference": ["ahnert-mulansky2011"], "versions": {"pfaff": "0.1"}})
        self.assertEqual(made.count("\n@"), 1)
        self.assertIn("note = {experiment kepler}", made)


if __name__ == "__main__":
    unittest.main()
