"""bench/report: what answers questions on growth, constraints, formulations and frequencies, and that the files bear it out."""
import json
import math
import pathlib
import sys
import unittest

from synthetic import CLASSES, COLUMNS, Fresh, describe, load, measured, reading, save, synthetic
from test_report_constraints import ensemble
from test_report_ensembles import walks

import answers  # noqa: E402
import first_screen  # noqa: E402
import verdict  # noqa: E402
import wording  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))

import assertions  # noqa: E402


class Answers(Fresh):
    def said(self, answer):
        """The sentence of the first case, of which the files bear out every assertion."""
        path = self.folder / "experiment.json"
        head = json.loads(path.read_text())
        for case in head["cases"]:
            case["answer"] = answer
        path.write_text(json.dumps(head))
        shown = reading.Experiment(self.folder)
        self.verdict = verdict.Verdict(shown, shown.cases[0])
        (self.folder / "report.json").write_text(first_screen.data(shown, [verdict.Verdict(shown, c) for c in shown.cases]))
        self.assertEqual(assertions.faults(self.folder), [])
        return wording.plain_text(first_screen.finding(self.verdict))

    def denied(self, **change):
        """The checker finds an assertion of the sentence that is changed so."""
        path = self.folder / "report.json"
        report = json.loads(path.read_text())
        report["cases"][0]["assertions"][0].update(change)
        path.write_text(json.dumps(report))
        self.assertEqual(len(assertions.faults(self.folder)), 1)


class Growth(Answers):
    def test_powers_and_what_they_are_called(self):
        walks(self.folder)
        self.assertEqual(self.said("growth"), "At step 0.1 s, rms errors of the energy over 4 seeds grow as a random walk with walk (t^0.50 ± 0.00); "
                         "in proportion to time with drift (t^1.00 ± 0.00).")
        self.denied(groups={"as a random walk": ["drift"], "in proportion to time": ["walk"], "": []})

    def test_a_power_that_rounds_to_zero_has_no_sign(self):
        self.assertEqual([wording.hundredths(p) for p in (-0.001, 0.004, -0.006, 1)], ["0.00", "0.00", "−0.01", "1.00"])

    def test_a_power_that_depends_on_one_seed_is_not_told(self):
        """One seed's error grows with another power, and is as large as before at the end."""
        walks(self.folder)
        path = self.folder / "runs" / "walk-4" / "series.csv"
        rows = load(path)
        for power in (3, 0.7):  # the interval holds 1/2 and 1, and 1/2 alone but by 0.28 to either side
            save(path, [rows[0]] + [[t, repr(1 + 4e-8 * (float(t) / 100) ** power)] for t, _ in rows[1:]])
            said = self.said("growth")
            self.assertIn("grow in proportion to time with drift (t^1.00 ± 0.00); with walk the power is not told.", said)
            self.assertNotIn("random walk", said)

    def test_drifts_of_all_steps_come_before_samples(self):
        """The drifts of all seeds say that nothing grows, which the samples do not see."""
        walks(self.folder)
        for powers, said in ((("0", "0.02", "-0.01", "0"), "not at all with walk (t^0.00 ± 0.02); in proportion"),
                             (("0", "0.9", "0.3", "0.6"), "as a random walk with walk (t^0.50 ± 0.00); in proportion")):
            of_seeds = iter(powers)
            self.edit("results.csv", "energy:exponent", lambda x: next(of_seeds), lambda row: row[2] == "walk")
            self.assertIn(said, self.said("growth"))

    def test_a_power_next_to_one_is_that_power(self):
        walks(self.folder)
        self.edit("results.csv", "energy:exponent", lambda x: "0.97", lambda row: row[2] == "drift")
        self.assertIn("in proportion to time with drift (t^0.97 ± 0.00).", self.said("growth"))

    def test_two_seeds_say_nothing(self):
        walks(self.folder)
        rows = load(self.folder / "results.csv")
        k = rows[0].index("seed")
        save(self.folder / "results.csv", [r for r in rows if r[k] in ("seed", "1", "2")])
        self.assertEqual(self.said("growth"), "The runs do not tell with which power of time errors grow.")


class Constraints(Answers):
    def test_who_stays_and_who_leaves(self):
        ensemble(self.folder)
        self.assertEqual(self.said("constraints"), "At step 0.02 s, no method stays on the constraints; mild leaves them least, by "
                         "2·10^−8 to 6·10^−8, and wild most, by 4·10^−7 to 1·10^−6.")
        self.edit("results.csv", "constraint:max", lambda x: "2e-16", lambda row: row[2] == "mild")
        self.assertEqual(self.said("constraints"), "At step 0.02 s, mild stays on the constraints; wild leaves them, by 4·10^−7 "
                         "to 1·10^−6.")
        self.denied(subject=["wild"])

    def test_differences_within_the_spread_are_ties(self):
        """The largest of one is above the smallest of the other: neither is called worst."""
        ensemble(self.folder)
        self.edit("results.csv", "constraint:max", lambda x: repr(float(x) / 12), lambda row: row[2] == "wild")
        said = self.said("constraints")
        self.assertIn("mild and wild leave them, by 2·10^−8 to 1·10^−7.", said)
        self.assertNotIn("most", said)

    def test_ties_for_the_least(self):
        """Meek has half as much again as mild, whose seeds differ by three: both leave them least."""
        ensemble(self.folder)
        rows = load(self.folder / "results.csv")
        method, size = rows[0].index("method"), rows[0].index("constraint:max")
        meek = [[*r] for r in rows if r[method] == "mild"]
        for row in meek:
            row[method], row[size] = "meek", repr(1.5 * float(row[size]))
        save(self.folder / "results.csv", rows + meek)
        head = json.loads((self.folder / "experiment.json").read_text())
        head["methods"].append({"label": "meek"})
        (self.folder / "experiment.json").write_text(json.dumps(head))
        self.assertIn("mild and meek leave them least, by 2·10^−8 to 9·10^−8, and wild most", self.said("constraints"))

    def test_one_of_which_nothing_is_known_is_named(self):
        """A third method, whose runs have no residuals."""
        ensemble(self.folder)
        rows = load(self.folder / "results.csv")
        method, size = (rows[0].index(name) for name in ("method", "constraint:max"))
        third = [[*r] for r in rows if r[method] == "mild"]
        for row in third:
            row[method], row[size] = "third", ""
        save(self.folder / "results.csv", rows + third)
        head = json.loads((self.folder / "experiment.json").read_text())
        head["methods"].append({"label": "third"})
        (self.folder / "experiment.json").write_text(json.dumps(head))
        said = self.said("constraints")
        self.assertIn("At step 0.02 s, of 2 methods of which it is known none stays on the constraints", said)
        self.assertIn("; of third it is not known", said)
        self.edit("results.csv", "steps", lambda x: repr(float(x) / 2), lambda row: row[method] == "mild")  # which has a tolerance
        self.assertIn(" or the nearest that a method has, of 2 methods", self.said("constraints"))

    def test_the_other_level_is_told_where_others_stay_on_it(self):
        ensemble(self.folder)
        rows = load(self.folder / "results.csv")
        method = rows[0].index("method")
        head = json.loads((self.folder / "experiment.json").read_text())
        head["quantities"].append({**head["quantities"][-1], "name": "hidden-constraint"})
        (self.folder / "experiment.json").write_text(json.dumps(head))
        for hidden, told in (({"mild": "1e-16", "wild": "0.05"}, True), ({"mild": "0.01", "wild": "0.05"}, False)):
            save(self.folder / "results.csv", [rows[0] + ["hidden-constraint:max", "hidden-constraint:class"]]
                 + [row + [hidden[row[method]], "drifting"] for row in rows[1:]])
            said = self.said("constraints")
            self.assertIn("no method stays on the constraints; mild leaves", said)
            self.assertEqual("; mild stays on the hidden constraints; wild leaves them, by 0.05" in said, told, said)

    def test_one_residual_is_no_comparison(self):
        ensemble(self.folder)
        self.edit("results.csv", "constraint:max", lambda x: "", lambda row: row[2] == "mild")
        self.assertEqual(self.said("constraints"), "The runs do not tell which methods stay on the constraints.")


class Agreement(Answers):
    def write(self, offsets):
        """Circles in formulations a, b and c, by two methods each: b is off by an angle, c by another."""
        rows, methods = [], []
        for kind, offset in offsets.items():
            for method, own in (("fine", 0), ("rough", 1e-6)):
                label, slug = f"{method} {kind}", f"{method}-{kind}"
                methods.append({"label": label, "formulation": kind})
                row = dict.fromkeys(COLUMNS + ["run"], "")
                rows.append(row | {"case": "ball", "system": "ball", "method": label, "step": 0.1, "time": 10, "steps": 100,
                                   "precision": "double", "status": "converged", "rhs_per_step": 1, "run": slug})
                path = self.folder / "runs" / slug
                path.mkdir(parents=True)
                save(path / "series.csv", [["t [s]", "x [m]", "y [m]"]] + [
                    [repr(0.1 * k), repr(math.cos(0.1 * k + offset + own)), repr(math.sin(0.1 * k + offset + own))]
                    for k in range(101)])
                (path / "summary.json").write_text(json.dumps({"schema": 1, "invariants": []}))
        head = {"schema": reading.SCHEMA, "name": "balls", "title": "Balls", "drift_classes": CLASSES, "methods": methods,
                "cases": [{"name": "ball", "system": "ball", "precision": "double"}]}
        save(self.folder / "results.csv", [list(rows[0])] + [list(r.values()) for r in rows])
        describe(self.folder, head)

    def test_groups_agree_and_differ(self):
        self.write({"a": 0, "b": 1e-4, "c": 0.2})
        self.assertEqual(self.said("agreement"), "A and b agree, to 1·10^−4 of the motion; a and b differ from c, by 0.2 of the motion "
                         "or more.")
        self.denied(relation="differ")

    def test_between_agreement_and_none_nothing_is_said(self):
        self.write({"a": 0, "b": 4e-3})
        self.assertEqual(self.said("agreement"), "The runs do not tell whether formulations agree.")

    def test_a_difference_no_larger_than_that_of_methods_is_none(self):
        self.write({"a": 0, "b": 0.1})
        self.assertIn("a differs from b", self.said("agreement").lower())
        path = self.folder / "runs" / "rough-a" / "series.csv"
        rows = load(path)
        save(path, [rows[0]] + [[t, repr(math.cos(float(t) - 0.05)), repr(math.sin(float(t) - 0.05))] for t, *_ in rows[1:]])
        self.assertEqual(self.said("agreement"), "The runs do not tell whether formulations agree.")


class Turning(Answers):
    def test_errors_that_are_not_steady_are_not_ranked(self):
        synthetic(self.folder)
        rows = [["case", "method", "step", "t", "vector", "frequency", "error", "change"]]
        rows += [["osc", m, h, "40", "phase", "1", e, c] for h in ("0.2", "0.1") for m, e, c in (
            ("mid", "1e-3", "1e-6"), ("rk", "-1e-9", "1e-9"), ("bad", "1e-5", "1e-8"))]
        measured(self.folder, "frequency", rows, texts=("vector",), over="step")
        self.assertEqual(self.said("frequencies"), "At step 0.1 phase, of 2 steady methods, turns best with bad, off by 1·10^−5, "
                         "and worst with mid, by 1·10^−3 rad per unit of time.")
        self.denied(subject=["mid"])
        self.assertEqual([c.more["unknown"] for c in answers.turning(self.verdict)], [["rk"]])
        save(self.folder / "measures" / "frequency.csv", [r for r in rows if r[1] != "rk"])  # nor one of which there is no error at all
        self.assertIn("phase, of 2 steady methods, turns best with bad", self.said("frequencies"))


if __name__ == "__main__":
    unittest.main()
