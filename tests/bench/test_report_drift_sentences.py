"""bench/report: what is said of drift is said of all methods, or of those that it names, and no two clauses deny each other."""
import json
import pathlib
import sys
import unittest

from synthetic import Fresh, load, reading, run, save, synthetic
from test_report_ensembles import walks

import answers  # noqa: E402
import first_screen  # noqa: E402
import verdict  # noqa: E402
import wording  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))

import assertions  # noqa: E402


class Three(Fresh):
    """Three methods that cost the same, and whose errors of the energy are of a class that does not grow."""

    def setUp(self):
        super().setUp()
        synthetic(self.folder)
        head = json.loads((self.folder / "experiment.json").read_text())
        head["cases"] = head["cases"][:1]
        (self.folder / "experiment.json").write_text(json.dumps(head))
        rows = load(self.folder / "results.csv")
        save(self.folder / "results.csv", [r for r in rows if r[0] in ("case", "osc")])
        self.classes(mid="near", rk="near", bad="near")

    def dear(self, method, factor=100):
        for column in ("ns_per_step", "ns_per_step_min"):
            self.edit("cost.csv", column, lambda x: repr(factor * float(x)), lambda row: row[1] == method)

    def classes(self, **of):
        for method, name in of.items():
            self.edit("results.csv", "energy:class", lambda x: name, lambda row: row[2] == method)
            self.edit("results.csv", "energy:max", lambda x: "1e-3", lambda row: row[2] == method)

    def ask(self, answer):
        path = self.folder / "experiment.json"
        head = json.loads(path.read_text())
        head["cases"][0]["answer"] = answer
        path.write_text(json.dumps(head))

    def told(self, answer="energy"):
        """The first screen in words, which the files bear out."""
        self.ask(answer)
        shown = reading.Experiment(self.folder)
        said = verdict.Verdict(shown, shown.cases[0])
        (self.folder / "report.json").write_text(first_screen.data(shown, [said]))
        self.assertEqual(assertions.faults(self.folder), [])
        return wording.plain_text(f"{first_screen.finding(said)} {first_screen.below(said)}")


class Told(Three):
    """rk costs a hundred times as much as the others, and has no run at equal cost."""

    def setUp(self):
        super().setUp()
        self.dear("rk")

    def test_no_method_is_said_of_those_at_their_own_steps_too(self):
        self.assertIn("At equal cost, 10 µs, and with rk at its own step, for 400 µs, no method lets the energy drift away",
                      self.told())

    def test_one_that_drifts_at_its_own_step_denies_no_sentence(self):
        self.classes(rk="drifting")
        told = self.told()
        self.assertIn("neither bad nor mid lets the energy drift away; at its own step, for 400 µs, rk lets the energy drift (drifting)", told)
        self.assertNotIn("no method lets", told)

    def test_one_that_does_not_while_others_do(self):
        self.classes(mid="drifting")
        self.assertIn("mid lets the energy drift (drifting), bad does not; at its own step, for 400 µs, rk does not let the energy drift away",
                      self.told())

    def test_a_rise_at_another_step_is_told(self):
        for path in self.folder.glob("runs/*/summary.json"):
            path.write_text(path.read_text().replace('"conserved"', '"decreasing"', 1))
        for path in self.folder.glob("runs/osc-[02]-*/series.csv"):  # mid and bad
            rows = load(path)
            save(path, [rows[0]] + [[r[0], r[1], repr(1 - 0.01 * float(r[0])), *r[3:]] for r in rows[1:]])
        for path in self.folder.glob("runs/osc-1-*/series.csv"):
            rows = load(path)
            save(path, [rows[0]] + [[r[0], r[1], repr(1 + 0.01 * float(r[0])), *r[3:]] for r in rows[1:]])
        told = self.told()
        self.assertIn("neither bad nor mid lets it rise by more than round-off; at its own step, for 400 µs, rk lets it rise", told)
        self.assertNotIn("no method", told)

    def test_a_method_of_which_no_run_finished_is_no_part_of_all(self):
        self.edit("results.csv", "status", lambda x: "singular", lambda row: row[2] == "rk")
        told = self.told()
        self.assertIn("of 2 methods of which it is known none lets the energy drift away; no run of rk finished", told)
        self.assertNotIn("no method lets", told)

    def test_the_cheapest_that_drifts_in_another_run(self):
        """rk is cheapest, and drifts at the step that is nearest to the target; at equal cost, which is that of a coarser one, it does not."""
        self.dear("rk", 0.01)
        self.edit("results.csv", "energy:class", lambda x: "drifting", lambda row: row[2] == "rk" and row[5] == "0.1")
        told = self.told("cost")
        self.assertIn("let the energy drift (drifting)", told.replace("lets", "let"))
        self.assertIn("no method lets the energy drift away (rk does in the run nearest to state error 10^−5)", told)


class Growing(Fresh):
    def test_of_what_is_told_to_grow_it_is_not_said_that_it_stays(self):
        """Errors of both methods grow over the seeds, while each run is of a class that does not."""
        folder = walks(self.folder)
        shown = reading.Experiment(folder)
        said = verdict.Verdict(shown, shown.cases[0] | {"answer": "growth"})
        self.assertEqual(answers.growth(said)[0].subject, ["walk", "drift"])
        self.assertNotIn("no method lets", wording.plain_text(first_screen.finding(said) + first_screen.below(said)))
        self.assertEqual(run(folder)[0], 0)


if __name__ == "__main__":
    unittest.main()
