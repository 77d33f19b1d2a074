"""bench/report: the verdict of a case, and the sentence and table that say it."""
import json
import math
import re
import unittest

from synthetic import SCRIPTS, Fresh, describe, load, parsed, reading, run, save, synthetic

import families  # noqa: E402
import first_screen  # noqa: E402
import sentence  # noqa: E402
import verdict  # noqa: E402
import verdict_table  # noqa: E402
import wording  # noqa: E402
import work_precision  # noqa: E402


class Families(Fresh):
    def test_families_are_those_that_plug_ins_name(self):
        """Every family that a source names is known, and every family but the last is named."""
        named = set()
        for path in (SCRIPTS.parents[1] / "integrators").glob("*/*.cpp"):
            named |= set(re.findall(r'\.?family = "([a-z]+)"', path.read_text(encoding="utf-8")))
        self.assertEqual(named, {f.key for f in families.FAMILIES[:-1]})

    def test_a_method_of_a_family_that_is_not_known_is_another_method(self):
        synthetic(self.folder)
        path = self.folder / "experiment.json"
        head = json.loads(path.read_text())
        head["methods"][0]["family"] = "gauss"
        head["methods"][1]["family"] = "rosenbrock"
        path.write_text(json.dumps(head))
        shown = reading.Experiment(self.folder)
        self.assertEqual({r.label: r.curve.family.key for r in verdict.Verdict(shown, shown.cases[0]).rows},
                         {"mid": "gauss", "rk": "other", "bad": "other"})


class Said(Fresh):
    """The synthetic experiment, whose runs take 40 ns a step: 4 us at step 0.4, 8 us at 0.2, 16 us at 0.1."""

    def verdict(self, case=0):
        shown = reading.Experiment(self.folder)
        return verdict.Verdict(shown, shown.cases[case])

    def said(self, case=0):
        return wording.plain_text(first_screen.finding(self.verdict(case)))

    def test_the_target_is_one_that_somebody_reaches(self):
        synthetic(self.folder)
        self.assertEqual(self.verdict().target, 1e-5)  # 0.1 h^4 at h = 0.1, for two methods
        self.edit("results.csv", "error_max", lambda x: "1e-7" if x == repr(0.1 * 0.1**4) else x)
        self.assertEqual(self.verdict().target, 1e-6)
        # Most methods are ranked where three of them have runs on both sides.
        self.edit("results.csv", "error_max", lambda x: "1e-4", lambda row: row[2] == "mid" and row[5] == "0.1")
        self.assertEqual((self.verdict().target, len(self.verdict().ranked(1e-4))), (1e-4, 3))

    def test_cheapest_loses_and_somebody_keeps(self):
        synthetic(self.folder)
        self.assertEqual(self.said(), "At state error 10^−5 rk and bad cost the same, of 2 ranked methods, "
                         "16 µs, but both let the energy drift (drifting); only mid keeps the symplectic structure.")

    def test_cheapest_keeps(self):
        synthetic(self.folder)
        for step, error in (("0.4", "1e-4"), ("0.2", "1e-7"), ("0.1", "1e-9")):
            self.edit("results.csv", "error_max", lambda x: error, lambda row: row[2] == "mid" and row[5] == step)
        said = self.said()
        self.assertIn("mid is cheapest, 5.0 µs (disturbed); only mid keeps the symplectic structure", said)
        self.assertNotIn("drift", said)

    def test_a_bound_is_never_ranked(self):
        """The coarsest run of mid is better than anything asked for: whatever it costs, it is called neither cheap nor dear."""
        synthetic(self.folder)
        before = self.said()
        self.edit("results.csv", "error_max", lambda x: "1e-16", lambda row: row[2] == "mid")
        self.assertEqual(self.said().replace(" mid, not ranked, reaches it for no more;", ""), before)
        self.assertIn("of 2 ranked methods", before)
        shown = self.verdict()
        mid = next(r for r in shown.rows if r.label == "mid")
        self.assertEqual(verdict_table.time_cell(shown, mid, shown.target)[:3], ("", verdict_table.NEVER / 2, "≤ 4.0 µs"))
        self.assertIs(shown.rows[-1], mid)

    def test_a_disturbed_timing_stands_beside_what_it_made(self):
        synthetic(self.folder)
        self.assertNotIn("disturbed", self.said())
        self.edit("cost.csv", "ns_per_step", lambda x: "90", lambda row: row[1] == "rk")
        self.assertIn("16 µs (disturbed)", self.said())

    def test_nobody_keeps_and_everybody(self):
        synthetic(self.folder)
        self.edit("results.csv", "structure_residual", lambda x: "1e-5")
        self.assertIn("no method keeps the symplectic structure", self.said())
        self.edit("results.csv", "structure_residual", lambda x: "1e-16")
        self.assertIn("all methods keep the symplectic structure", self.said())

    def test_a_claim_of_a_method_of_which_no_run_finished_is_not_known_to_hold(self):
        synthetic(self.folder)
        self.assertIn("only mid keeps the symplectic structure", self.said())
        self.edit("results.csv", "status", lambda x: "singular", lambda row: row[2] == "mid")
        self.assertIn("of 2 methods of which it is known none keeps the symplectic structure; of mid it is not known", self.said())

    def test_no_claim_without_data(self):
        synthetic(self.folder)
        self.edit("results.csv", "structure_residual", lambda x: "")
        self.edit("results.csv", "energy:class", lambda x: "")
        self.assertNotIn("structure", self.said())
        self.assertNotIn("drift", self.said())

    def test_the_subject_beside_gauss_of_equal_order(self):
        synthetic(self.folder)
        path = self.folder / "experiment.json"
        text = path.read_text().replace('"integrator": "mid"', '"family": "generating"').replace(
            '"integrator": "bad"', '"family": "gauss"').replace('"order": 2', '"order": 4')
        path.write_text(text)
        for step, mid, bad in (("0.4", "1e-3", ""), ("0.2", "1e-5", "1e-4"), ("0.1", "1e-8", "1e-7")):
            self.edit("results.csv", "error_max", lambda x: mid, lambda row: row[2] == "mid" and row[5] == step)
            self.edit("results.csv", "error_max", lambda x: bad, lambda row: row[2] == "bad" and row[5] == step)
        self.edit("cost.csv", "ns_per_step", lambda x: "44")

        def told():
            return wording.plain_text(first_screen.below(self.verdict()))
        # At 1e-5 mid costs 8 us, and bad 2^(1/3) times that; the median timing is a tenth above the fastest.
        self.assertIn("Bad costs 1.1 to 1.4 times as much as mid of equal order (10 µs)", told().replace("bad costs", "Bad costs"))
        self.edit("cost.csv", "ns_per_step", lambda x: "60")  # and now half as much again: they cost the same
        self.assertNotIn("times as much", told())
        # Of the dearer one nothing but a bound is known, its coarsest run being better already: no ratio is claimed.
        self.edit("cost.csv", "ns_per_step", lambda x: "44")
        self.edit("results.csv", "error_max", lambda x: "1e-9" if x else x, lambda row: row[2] == "bad")
        self.assertNotIn("times as much", told())

    def test_table_is_sorted_and_says_what_it_is_sorted_by(self):
        synthetic(self.folder)
        shown = self.verdict()
        self.assertEqual([r.label for r in shown.rows], ["rk", "bad", "mid"])
        page = verdict_table.table(shown)
        self.assertIn('aria-sort="ascending"', page)
        self.assertEqual(page.count("<tr data-family"), 3)
        for told in ("1 of 3", "finest pair", "4.00", "kept", "drifting"):
            self.assertIn(told, page)
        for row in shown.rows:
            for target in verdict.TARGETS:
                if not row.times[target][0] > 0:
                    self.assertIn("–", verdict_table.time_cell(shown, row, target)[2])

    def test_failed_runs_enter_nothing_but_their_count(self):
        synthetic(self.folder)
        save(self.folder / "cost.csv", [*load(self.folder / "cost.csv"), ["osc", "bad", "0.4", 10, 1, 12, 5, 0.1]])
        before = {r.label: r.times for r in self.verdict().rows}
        self.edit("results.csv", "error_max", lambda x: "1e-30", lambda row: row[9] != "converged")
        self.assertEqual({r.label: r.times for r in self.verdict().rows}, before)
        self.assertEqual({r.label: r.curve.failed for r in self.verdict().rows}, {"rk": 0, "bad": 1, "mid": 0})

    def test_a_coarser_step_is_never_charged_more_than_a_finer_one(self):
        synthetic(self.folder)
        self.edit("cost.csv", "ns_per_step_min", lambda x: "4000", lambda row: row[1] == "rk" and row[2] == "0.4")
        costs = [p.cost for p in next(r for r in self.verdict().rows if r.label == "rk").curve.points]
        self.assertEqual(costs, [8000, 8000, 16000])

    def of_energy(self):
        """The oscillator's case, compared by the relative error of its energy: 10^-k for rk and mid at their steps."""
        path = self.folder / "experiment.json"
        head = json.loads(path.read_text())
        head["cases"][0]["error"] = "energy"
        path.write_text(json.dumps(head))
        rows = load(self.folder / "results.csv")
        steps = {"rk": {"0.4": 1e-4, "0.2": 1e-8, "0.1": 1e-13}, "mid": {"0.4": 0.1, "0.2": 1e-3, "0.1": 1e-8}}
        for row in rows:
            row.append("relative_drift_max" if row is rows[0] else "" if row[9] != "converged" else
                       repr(steps[row[2]][row[5]]) if row[2] in steps else "0.5" if row[0] == "osc" else "")
        save(self.folder / "results.csv", rows)
        describe(self.folder)

    def test_the_error_of_a_conserved_quantity(self):
        synthetic(self.folder)
        before = self.verdict()
        self.of_energy()
        shown = self.verdict()
        rk = next(r for r in shown.rows if r.label == "rk")
        self.assertEqual(shown.target, 1e-6)
        # From 4 us and 1e-4 to 8 us and 1e-8, straight in logarithms: 1e-6 is in the middle.
        self.assertAlmostEqual(rk.times[1e-6][0] / (4000 * math.sqrt(2)), 1, places=6)
        self.assertAlmostEqual(rk.times[1e-12][0] / (8000 * 2 ** (4 / 5)), 1, places=6)
        self.assertNotEqual(before.rows[0].times, rk.times)
        said = self.said()
        self.assertTrue(said.startswith("At energy error 10^−6 rk is cheapest of 2 ranked methods, 5.7 µs"),
                        said)
        page = verdict_table.table(shown)
        for told in ("time to reach energy error", ">energy error<", "slope of energy error", "10<sup>−12</sup>"):
            self.assertIn(told, page)
        self.assertIn("|I − I(0)| / |I(0)| of energy", wording.plain_text(first_screen.holds(shown)))
        self.assertNotIn("state error", said + page)
        self.assertEqual(shown.measure.axis, "largest relative error of energy, |ΔI/I(0)|")
        self.assertEqual(before.measure.axis, "largest relative error of the state")
        # An error of the state that is false is not looked at; one of the energy is.
        self.edit("results.csv", "error_max", lambda x: "1e-30" if x else x)
        self.assertEqual([r.times for r in self.verdict().rows], [r.times for r in shown.rows])
        self.edit("results.csv", "relative_drift_max", lambda x: "1e-30" if x else x)
        self.assertNotEqual([r.times for r in self.verdict().rows], [r.times for r in shown.rows])

    def test_an_error_that_is_not_in_the_results_is_refused(self):
        synthetic(self.folder)
        path = self.folder / "experiment.json"
        path.write_text(path.read_text().replace('"conserved": "energy"', '"conserved": "energy", "error": "energy"', 1))
        status, told = run(self.folder)
        self.assertEqual(status, 2)
        self.assertIn("column 'relative_drift_max' is missing", told)

    def test_ties_are_both_named_and_both_bold(self):
        synthetic(self.folder)
        self.assertEqual([r.label for r in self.verdict().best(1e-4)], ["rk", "bad"])
        self.edit("cost.csv", "ns_per_step_min", lambda x: "60", lambda row: row[1] == "bad")
        self.assertEqual([r.label for r in self.verdict().best(1e-4)], ["rk"])
        self.edit("cost.csv", "ns_per_step", lambda x: "61", lambda row: row[1] == "rk")  # the median reaches what bad takes
        self.assertEqual([r.label for r in self.verdict().best(1e-4)], ["rk", "bad"])

    def test_the_first_screen_says_it(self):
        synthetic(self.folder)
        self.assertEqual(run(self.folder)[0], 0)
        page = parsed(self.folder).text
        head = page[:page.index("method structure")]
        for told in ("cost the same, of 2 ranked methods, 16 µs", "At equal cost, 10 µs", "Holds for Oscillator to t = 40 s"):
            self.assertIn(told, head)

    def test_methods_of_which_it_is_not_known_what_they_keep_are_named(self):
        synthetic(self.folder)
        self.edit("results.csv", "structure_residual", lambda x: "1e-6", lambda row: row[2] == "rk")
        self.edit("results.csv", "structure_residual", lambda x: "", lambda row: row[2] == "bad")
        told = [wording.plain_text(c.words) for c in sentence.structure(self.verdict())]
        self.assertEqual(told, ["of 2 methods of which it is known only mid keeps the symplectic structure; of bad it is not known"])

    def test_no_method_keeps_a_quantity_of_which_it_is_not_known(self):
        synthetic(self.folder)

        def told():
            return wording.plain_text(first_screen.below(self.verdict()))
        self.edit("results.csv", "energy:class", lambda x: "near" if x else x)
        self.assertIn("no method lets the energy drift away.", told())
        self.edit("results.csv", "energy:class", lambda x: "unused" if x else x, lambda row: row[2] == "rk")
        said = told()
        self.assertNotIn("no method lets", said)
        self.assertIn("of 2 methods of which it is known none lets the energy drift away; of rk it is not known", said)
        # What others are known to do is said beside it.
        self.edit("results.csv", "energy:class", lambda x: "drifting" if x else x, lambda row: row[2] == "bad")
        self.assertIn("bad lets the energy drift (drifting), mid does not; of rk it is not known", told())

    def test_what_round_off_adds_up_to_is_told_apart(self):
        synthetic(self.folder)
        self.edit("results.csv", "energy:max", lambda x: "3e-13", lambda row: row[2] == "rk")
        self.assertIn("bad lets the energy drift (drifting) and round-off alone grows with rk (drifting of at most 3·10^−13), the "
                      "other does not", wording.plain_text(first_screen.below(self.verdict())))
        # Of a quantity of a ten thousandth the same is no round-off.
        for path in self.folder.glob("runs/osc-1-*/series.csv"):
            rows = load(path)
            save(path, [rows[0]] + [[*row[:2], "1e-4", *row[3:]] for row in rows[1:]])
        self.assertIn("rk and bad let the energy drift (drifting), the other does not",
                      wording.plain_text(first_screen.below(self.verdict())))

    def test_long_names_leave_room_for_their_figures(self):
        # Grids name their methods by all of their parameters.
        synthetic(self.folder, extra_methods=1)
        long = "Gauss, formulation.friction-form = metriplectic, stages = 3, " * 3
        for path in [*self.folder.rglob("*.csv"), self.folder / "experiment.json"]:
            path.write_text(path.read_text().replace("a method with a rather long name, number 0", long.strip(", ").replace(", ", "; ")))
        for wide in (True, False, 252, 510):
            for one in work_precision.drawings(self.verdict()):
                one.draw(wide)

    def test_what_falls_with_the_step_is_no_round_off(self):
        # A loss of a method beside a rest energy: small in units of it, and thirty times smaller at half the step.
        synthetic(self.folder)
        steps = []
        self.edit("results.csv", "step", lambda x: steps.append(x) or x, lambda row: row[2] == "rk")
        losses = iter(f"{1e-13 * (float(x) / max(map(float, steps))) ** 5}" for x in steps)
        self.edit("results.csv", "energy:max", lambda x: next(losses), lambda row: row[2] == "rk")
        self.assertIn("rk and bad let the energy drift (drifting), the other does not",
                      wording.plain_text(first_screen.below(self.verdict())))

    def test_equal_cost_is_said_of_runs_that_cost_the_same(self):
        synthetic(self.folder)

        def told():
            return wording.plain_text(first_screen.below(self.verdict()))
        self.assertIn("At equal cost, 10 µs, rk and bad let the energy drift (drifting), the other does not", told())
        self.edit("cost.csv", "ns_per_step_min", lambda x: "4000", lambda row: row[1] == "mid")
        self.assertIn("at equal cost, 10 µs, rk and bad let the energy drift (drifting); at its own step, for 400 µs, mid "
                      "does not let the energy drift away", told().lower())
        self.edit("cost.csv", "ns_per_step_min", lambda x: "200", lambda row: row[1] == "bad")
        said = told()
        self.assertNotIn("equal cost", said)
        self.assertIn("ach at its own step, for ", said)
        self.assertIn('class="star"', verdict_table.table(self.verdict()))

    def test_equal_cost_is_not_said_where_most_methods_have_no_run_there(self):
        """Three of five methods have none, and of two of them it is not known if they drift."""
        synthetic(self.folder, extra_methods=2)
        others = ("a method with a rather long name, number 0", "a method with a rather long name, number 1")
        self.edit("results.csv", "energy:class", lambda x: "unused" if x else x, lambda row: row[2] in others)
        for label, cost in ((others[0], "4e3"), ("bad", "4e5")):
            self.edit("cost.csv", "ns_per_step_min", lambda x, cost=cost: cost, lambda row, label=label: row[1] == label)

        def told():
            return wording.plain_text(first_screen.below(self.verdict())).lower()
        self.assertIn("at equal cost, 10 µs, rk let", told())  # of three, which are most of them
        self.edit("cost.csv", "ns_per_step_min", lambda x: "4e7", lambda row: row[1] == others[1])
        said = told()
        self.assertNotIn("equal cost", said)
        self.assertIn("each at its own step, for ", said)

    def test_another_motion_is_no_rival(self):
        synthetic(self.folder)
        path = self.folder / "experiment.json"
        head = json.loads(path.read_text())
        head["methods"][2]["another_motion"] = True
        path.write_text(json.dumps(head))
        shown = self.verdict()
        self.assertEqual([r.label for r in shown.ranked(shown.target)], ["rk", "mid"])
        self.assertIn("bad is another motion, and no rival of the others, of which alone the sentences speak.", wording.plain_text(first_screen.below(shown)))
        self.assertNotIn("bad", self.said())
        self.assertIn("rk is cheapest, ", self.said())  # of all that it is compared with

    def test_every_class_stands_in_the_table(self):
        synthetic(self.folder)
        for name in [c["name"] for c in json.loads((self.folder / "experiment.json").read_text())["drift_classes"]]:
            self.edit("results.csv", "energy:class", lambda x, name=name: name)
            self.assertIn(f'<span class="cls">{name}</span>', verdict_table.table(self.verdict()))


class Words(unittest.TestCase):
    def test_numbers(self):
        self.assertEqual([wording.short_time(x) for x in (3.2e3, 17.4e6, 9.99e8, 1.23e9)], ["3.2 µs", "17 ms", "999 ms", "1.2 s"])
        self.assertEqual(wording.size(3.2e-8), "3·10<sup>−8</sup>")
        self.assertEqual(wording.plain_text("<b>a</b> 10<sup>−6</sup> &lt;"), "a 10^−6 <")


if __name__ == "__main__":
    unittest.main()
