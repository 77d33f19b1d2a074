"""bench/report: the numbers of the verdict, against closed forms, and the sentence and table that say them."""
import json
import math
import random
import unittest

from synthetic import SCRIPTS, Fresh, U, load, parsed, reading, run, save, synthetic

import curves  # noqa: E402
import families  # noqa: E402
import sentence  # noqa: E402
import verdict  # noqa: E402
import verdict_table  # noqa: E402
import wording  # noqa: E402

METHOD = {"label": "m", "integrator": "m"}
CELLS = {"case": "c", "method": "m", "run": "r", "status": "converged", "message": "", "steps": "1", "precision": "double"}


def curve(points, claimed=4, residuals=(), tolerance=""):
    """Of (step, cost, error), from the coarsest to the finest."""
    some = [curves.Point(reading.Run(CELLS | {"step": repr(h), "tolerance": tolerance, "time": repr(h)}, "line"), cost, cost, e)
            for h, cost, e in points]
    return curves.Curve(METHOD, claimed, some, 0, len(some), list(residuals), U)


def power_law(order, floor=0.0, factor=1.0, steps=8, first=0.1):
    """Error (factor h)^order + floor at cost 1/h."""
    return [(h, 1 / h, (factor * h)**order + floor) for h in (first / 2**k for k in range(steps))]


class Times(unittest.TestCase):
    def test_straight_in_logarithms_is_exact_for_a_power_law(self):
        for order in (2, 4, 8):
            some = curve(power_law(order))
            for target in (3e-4, 1e-5):
                cost, at_most = some.time_to(target, True)
                if target <= some.points[0].error:
                    # A target counts as reached from 1e-8 above it.
                    self.assertAlmostEqual(cost / (target * (1 + 1e-8)) ** (-1 / order), 1, places=12)
                    self.assertFalse(at_most)

    def test_never_extrapolated_to_finer_steps(self):
        self.assertTrue(math.isnan(curve(power_law(2, steps=3)).time_to(1e-9, True)[0]))

    def test_a_coarsest_run_that_is_better_already_is_a_bound(self):
        self.assertEqual(curve(power_law(4)).time_to(0.5, True), (10.0, True))

    def test_the_smallest_crossing_counts(self):
        some = curve([(0.4, 1, 1e-2), (0.2, 2, 1e-4), (0.1, 4, 1e-2), (0.05, 8, 1e-4)])
        self.assertAlmostEqual(some.time_to(1e-3, True)[0], math.sqrt(2))

    def test_a_lost_phase_does_not_count(self):
        """The coarse run is saturated: straight lines would say 10^(..) between 1 and 2; the claimed order leads instead."""
        some = curve([(0.4, 1, 1.9), (0.2, 8, 1e-8)])
        self.assertAlmostEqual(some.time_to(1e-4, True)[0], max(1, 8 * (1e-8 / 1e-4) ** 0.25))
        self.assertNotAlmostEqual(some.time_to(1e-4, False)[0], some.time_to(1e-4, True)[0])  # of a drift nothing saturates

    def test_at_equal_cost(self):
        some = curve(power_law(4))
        run_, error, off = some.at_cost(30.0)
        self.assertAlmostEqual(error * 30.0**4, 1, places=9)
        self.assertEqual((run_.step, off), (0.025, False))
        self.assertEqual(some.at_cost(1e6)[0].step, some.points[-1].run.step)
        self.assertTrue(some.at_cost(1e6)[2])  # it cannot cost that much

    def test_front(self):
        some = [curve([(1, 1, 1e-1), (0.5, 4, 1e-4)]), curve([(1, 2, 1e-3), (0.5, 3, 1e-2)])]
        self.assertEqual([(p.cost, p.error) for p in curves.front(some)], [(1, 1e-1), (2, 1e-3), (4, 1e-4)])


class Orders(unittest.TestCase):
    def test_of_power_laws(self):
        for order in (1, 2, 4, 5, 8):
            seen = curve(power_law(order, steps=5, first=0.2), order).order()
            self.assertAlmostEqual(seen.value, order, places=9)
            self.assertLess(seen.interval, 1e-6)
            self.assertFalse(seen.surprising)

    def test_round_off_is_left_out(self):
        """Steps down to where the error is round-off; the order is that of the steps above."""
        some = curve(power_law(8, floor=1e-13, first=0.4, factor=0.7), 8)
        self.assertAlmostEqual(some.floor() / 1e-13, 1, delta=0.2)
        self.assertAlmostEqual(some.order().value, 8, delta=0.1)
        self.assertTrue(math.isnan(curve(power_law(8, steps=3, first=0.4), 8).floor()))  # control: nothing flattens

    def test_a_false_claim_is_seen(self):
        self.assertTrue(curve(power_law(4), 5).order().surprising)
        self.assertTrue(curve(power_law(4), None).order().surprising)

    def test_not_measurable(self):
        flat = [(h, 1 / h, 1e-14 * (1 + k % 2)) for k, h in enumerate((0.1, 0.05, 0.025))]
        self.assertIsNone(curve(flat).order())
        self.assertIsNone(curve([(h, 1 / h, 1.3) for h in (0.1, 0.05)]).order())  # all saturated
        self.assertIsNone(curve(power_law(4), tolerance="1e-6").order())  # driven by a tolerance
        self.assertIsNone(curve(power_law(4)[:1]).order())

    def test_two_runs_are_a_pair(self):
        seen = curve(power_law(4, first=0.4)[:2]).order()
        self.assertTrue(math.isnan(seen.interval))
        self.assertAlmostEqual(seen.value, 4)

    def test_intervals_hold_what_they_promise(self):
        """Of 2000 lines with normal noise 95 % of the intervals hold the slope; 2.2 % is 4.5 standard deviations."""
        noise = random.Random(5)
        for n in (3, 4):
            held = 0
            for _ in range(2000):
                slope, half = curves.fitted_slope([(k, 4 * k + noise.gauss(0, 0.1)) for k in range(n)])
                held += abs(slope - 4) <= half
            self.assertAlmostEqual(held / 2000, 0.95, delta=0.022)


class Structure(unittest.TestCase):
    def test_kept_at_every_step_or_not(self):
        self.assertTrue(curve(power_law(4), residuals=[(0.1, 3e-16), (0.05, 4e-14)]).kept)
        self.assertFalse(curve(power_law(4), residuals=[(0.1, 1e-9), (0.05, 3e-16)]).kept)  # small is accuracy
        self.assertIsNone(curve(power_law(4)).kept)

    def test_round_off_may_grow_as_steps_become_smaller(self):
        self.assertTrue(curve(power_law(4), residuals=[(0.1, 5e-14), (0.01, 1e-12)]).kept)
        self.assertFalse(curve(power_law(4), residuals=[(0.1, 5e-14), (0.01, 1e-9)]).kept)
        self.assertFalse(curve(power_law(4), residuals=[(0.1, 1e-12), (0.01, 5e-14)]).kept)  # it falls: truncation

    def test_power_of_the_step(self):
        some = curve(power_law(4), residuals=[(h, h**5) for h in (0.1, 0.05)] + [(0.001, 1e-16)])
        self.assertAlmostEqual(some.residual_power(), 5)


class Families(unittest.TestCase):
    def test_methods_that_ship_have_families(self):
        page = (SCRIPTS.parents[1] / "docs" / "plugins.md").read_text(encoding="utf-8")
        part = page[page.index("## Integrators"):]
        part = part[:part.index("\n## ", 5)] if "\n## " in part[5:] else part
        names = [line.split("`")[1] for line in part.splitlines() if line.startswith("| `")]
        self.assertGreater(sum(families.family_of(n).key != "other" for n in names), 25)
        self.assertEqual(families.family_of("somebodys-rule").key, "other")
        for name, key in (("gauss-darboux", "darboux"), ("odeint-mclachlan", "splitting"), ("odeint-rk4", "explicit"),
                          ("mclachlan-perlmutter", "nonholonomic"), ("projected-gauss", "constrained")):
            self.assertEqual(families.family_of(name).key, key)


class Said(Fresh):
    """The synthetic experiment, whose runs take 40 ns a step: 4 us at step 0.4, 8 us at 0.2, 16 us at 0.1."""

    def verdict(self, case=0):
        shown = reading.Experiment(self.folder)
        return verdict.Verdict(shown, shown.cases[case])

    def said(self, case=0):
        return wording.plain_text(sentence.finding(self.verdict(case)))

    def test_the_target_is_one_that_somebody_reaches(self):
        synthetic(self.folder)
        self.assertEqual(self.verdict().target, 1e-5)  # 0.1 h^4 at h = 0.1
        self.edit("results.csv", "error_max", lambda x: "1e-7", lambda row: row[2] == "mid" and row[5] == "0.1")
        self.assertEqual(self.verdict().target, 1e-6)

    def test_cheapest_loses_and_somebody_keeps(self):
        synthetic(self.folder)
        said = self.said()
        self.assertTrue(said.startswith("At state error 10^−5 rk and bad are cheapest, 16 µs, but both let the energy drift "
                                        "(drifting); only mid keeps the symplectic structure at round-off"), said)

    def test_cheapest_keeps(self):
        synthetic(self.folder)
        self.edit("results.csv", "error_max", lambda x: "1e-7", lambda row: row[2] == "mid")
        said = self.said()
        self.assertIn("mid is cheapest, at most 4.0 µs, and alone keeps the symplectic structure at round-off", said)
        self.assertNotIn("drift", said)

    def test_nobody_keeps_and_everybody(self):
        synthetic(self.folder)
        self.edit("results.csv", "structure_residual", lambda x: "1e-5")
        self.assertIn("no method keeps the symplectic structure", self.said())
        self.edit("results.csv", "structure_residual", lambda x: "1e-16")
        self.assertIn("and like all others keeps the symplectic structure", self.said())

    def test_no_claim_without_data(self):
        synthetic(self.folder)
        self.edit("results.csv", "structure_residual", lambda x: "")
        self.edit("results.csv", "energy:class", lambda x: "")
        self.assertNotIn("structure", self.said())
        self.assertNotIn("drift", self.said())

    def test_the_subject_beside_gauss_of_equal_order(self):
        synthetic(self.folder)
        path = self.folder / "experiment.json"
        text = path.read_text().replace('"integrator": "mid"', '"integrator": "generating-function"').replace(
            '"integrator": "bad"', '"integrator": "gauss"').replace('"order": 2', '"order": 4')
        path.write_text(text)
        self.edit("results.csv", "error_max", lambda x: repr(float(x) / 2e4) if x else x, lambda row: row[2] == "mid")
        self.edit("results.csv", "error_max", lambda x: repr(float(x) / 10) if x else x, lambda row: row[2] == "bad")
        self.assertIn("bad costs", self.said())
        self.assertIn("times as much", self.said())
        # Of the dearer one nothing but a bound is known, its coarsest run being better already: no ratio is claimed.
        self.edit("results.csv", "error_max", lambda x: "1e-9" if x else x, lambda row: row[2] == "bad")
        self.edit("results.csv", "error_max", lambda x: "1e-7", lambda row: row[2] == "mid")
        self.assertNotIn("times as much", self.said())
        self.assertNotIn("cheaper than", self.said())

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
        """The oscillator's case, compared by the relative error of its energy: 10^-k for rk at its steps, from the coarsest."""
        path = self.folder / "experiment.json"
        head = json.loads(path.read_text())
        head["cases"][0]["error"] = "energy"
        path.write_text(json.dumps(head))
        rows = load(self.folder / "results.csv")
        steps = {"0.4": 1e-4, "0.2": 1e-8, "0.1": 1e-13}
        for row in rows:
            row.append("relative_drift_max" if row is rows[0] else "" if row[9] != "converged" else
                       repr(steps[row[5]]) if row[2] == "rk" else "0.5" if row[0] == "osc" else "")
        save(self.folder / "results.csv", rows)

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
        self.assertTrue(said.startswith("At energy error 10^−6 rk is cheapest, 5.7 µs"), said)
        page = verdict_table.table(shown)
        for told in ("time to reach energy error", ">energy error<", "slope of energy error", "10<sup>−12</sup>"):
            self.assertIn(told, page)
        self.assertIn("|I − I(0)| / |I(0)| of energy", wording.plain_text(sentence.holds(shown)))
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

    def test_a_slope_above_the_order_surprises_of_the_state_alone(self):
        some = curve(power_law(6))
        self.assertTrue(some.order().surprising)
        some.of_state = False
        self.assertFalse(some.order().surprising)
        slow = curve(power_law(2))
        slow.of_state = False
        self.assertTrue(slow.order().surprising)

    def test_ties_are_both_named_and_both_bold(self):
        synthetic(self.folder)
        self.assertEqual([r.label for r in self.verdict().best(1e-4)], ["rk", "bad"])
        self.edit("cost.csv", "ns_per_step_min", lambda x: "60", lambda row: row[1] == "bad")
        self.assertEqual([r.label for r in self.verdict().best(1e-4)], ["rk"])

    def test_the_first_screen_says_it(self):
        synthetic(self.folder)
        self.assertEqual(run(self.folder)[0], 0)
        page = parsed(self.folder).text
        head = page[:page.index("method structure")]
        for told in ("are cheapest, 16 µs", "At equal cost, 10 µs", "Holds for Oscillator to t = 40 s"):
            self.assertIn(told, head)

    def test_no_method_keeps_a_quantity_of_which_it_is_not_known(self):
        synthetic(self.folder)

        def told():
            return wording.plain_text(sentence.drifting(self.verdict()))
        self.edit("results.csv", "energy:class", lambda x: "near" if x else x)
        self.assertIn("no method lets the energy drift away.", told())
        self.edit("results.csv", "energy:class", lambda x: "unused" if x else x, lambda row: row[2] == "rk")
        said = told()
        self.assertNotIn("no method lets", said)
        self.assertIn("no method is seen to let the energy drift away. Whether rk does is unused.", said)
        self.assertNotIn("rk does not keep the structure but shows no trend", said)
        # What others are known to do is said beside it.
        self.edit("results.csv", "energy:class", lambda x: "drifting" if x else x, lambda row: row[2] == "bad")
        said = told()
        self.assertIn("bad lets the energy drift (drifting). Whether rk does is unused.", said)

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
