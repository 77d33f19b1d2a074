"""bench/report: no class of drift is a merit of a run that makes another motion."""
import json
import math
import unittest

from synthetic import Fresh, load, reading, save
from test_report_drift_sentences import Three
from test_report_ensembles import walks

import answers  # noqa: E402
import astray  # noqa: E402
import verdict  # noqa: E402
import verdict_latex  # noqa: E402
import verdict_table  # noqa: E402
import wording  # noqa: E402


class Astray(Three):
    """In each run q turns about its start."""

    def setUp(self):
        super().setUp()
        self.turn("*", math.sin)

    def turn(self, runs, motion):
        for path in self.folder.glob(f"runs/osc-{runs}/series.csv"):
            rows = load(path)
            save(path, [rows[0]] + [[r[0], repr(motion(float(r[0]))), *r[2:]] for r in rows[1:]])

    def state(self, method, **numbers):
        for path in self.folder.glob(f"runs/osc-{('mid', 'rk', 'bad').index(method)}-*/summary.json"):
            head = json.loads(path.read_text())
            head["invariants"][0] |= numbers
            path.write_text(json.dumps(head))

    def err(self, method, error):
        self.edit("results.csv", "error_max", lambda x: repr(error) if x else x, lambda row: row[2] == method)

    def kinds(self):
        shown = reading.Experiment(self.folder)
        return {row.label: row.astray for row in verdict.Verdict(shown, shown.cases[0]).rows}

    def test_a_planet_that_has_escaped_is_no_merit(self):
        self.err("bad", 40.0)
        self.turn("2-*", lambda t: t)
        self.assertEqual(self.kinds(), {"mid": "", "rk": "", "bad": "escaped"})
        told = self.told()
        self.assertIn("of 2 methods of which it is known none lets the energy drift away; not counted is bad, by whom the motion goes more "
                      "than twice as far as it should.", told)
        self.assertNotIn("no method lets", told)
        shown = reading.Experiment(self.folder)
        table = verdict_table.table(verdict.Verdict(shown, shown.cases[0]))
        self.assertEqual(table.count(", motion lost</small>"), 1)
        self.assertIn("Motion lost: the run makes another motion", table)
        tex = verdict_latex.latex_table(verdict.Verdict(shown, shown.cases[0]))
        self.assertEqual(tex.count(", motion lost"), 1)
        self.assertIn("& drift of energy [J] &", tex)

    def test_a_lost_phase_is_not_another_motion(self):
        """It is late, and comes back; nor is one that goes away for a while, or one whose error is small."""
        self.err("bad", 2.0)
        for motion in (lambda t: math.sin(t - 1), lambda t: math.sin(t) * (5 if t < 30 else 1)):
            self.turn("2-*", motion)
            self.assertEqual(self.kinds()["bad"], "")
            self.assertIn("no method lets the energy drift away", self.told())
        self.turn("2-*", lambda t: t)
        self.assertEqual(self.kinds()["bad"], "escaped")
        self.err("bad", 0.4)
        self.assertEqual(self.kinds()["bad"], "")

    def test_what_is_off_by_half_of_its_range_is_lost(self):
        """Errors are of 1e-3."""
        self.err("bad", 2.0)
        for span, kind in ((2.1e-3, ""), (1.9e-3, "lost"), (0.0, ""), (None, "")):
            self.state("bad", range=span)
            self.assertEqual(self.kinds()["bad"], kind)
        self.state("bad", range=1.9e-3)
        self.assertIn("not counted is bad, by whom the energy is off by half of its range or more", self.told())
        self.err("bad", 0.1)  # the motion is seen to be right
        self.assertEqual(self.kinds()["bad"], "")

    def test_of_those_that_drift_nothing_changes(self):
        self.err("bad", 2.0)
        self.state("bad", range=1e-3)
        self.classes(bad="drifting")
        self.assertIn("bad lets the energy drift (drifting), the other 2 do not", self.told())

    def test_without_an_accurate_run_nothing_is_known_of_escapes(self):
        self.turn("2-*", lambda t: t)
        self.edit("results.csv", "error_max", lambda x: "2.0" if x else x)
        self.assertEqual(self.kinds()["bad"], "")

    def test_points_and_momenta_are_kinds(self):
        one = answers.Recording(self.folder, {}, "s", [0.0, 1.0], dict.fromkeys(("x_sun", "y_sun", "px_sun", "x1", "y1", "q1", "q2"), "1"),
                                {n: [0.0, 3.0 if n[0] == "x" else 4.0] for n in ("x_sun", "y_sun", "px_sun", "x1", "y1", "q1", "q2")},
                                ["x_sun", "y_sun", "px_sun", "x1", "y1", "q1", "q2"])
        self.assertEqual({kind: far[1] for (_, kind), far in astray.distances(one).items()},
                         {"_sun": 5.0, "p_sun": 4.0, "1": 5.0, "q": math.sqrt(32)})


class Seeds(Fresh):
    def test_growth_is_not_told_of_what_is_lost(self):
        folder = walks(self.folder / "seeds")
        for path in folder.glob("runs/walk-*/summary.json"):
            path.write_text(path.read_text().replace('"unit"', '"range": 1e-6, "unit"'))
        shown = reading.Experiment(folder)
        clause, = answers.growth(verdict.Verdict(shown, shown.cases[0]))
        self.assertEqual(clause.subject, ["drift"])
        self.assertIn("not counted is walk, by whom the energy is off by half", wording.plain_text(clause.words))


if __name__ == "__main__":
    unittest.main()
