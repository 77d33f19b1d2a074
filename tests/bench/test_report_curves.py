"""bench/report: what runs say of a method, against closed forms: costs of errors, orders and whether a structure is kept."""
import math
import random
import unittest

from synthetic import U, reading

import curves  # noqa: E402

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
                cost, at_most = some.time_to(target)
                if target <= some.points[0].error:
                    # A target counts as reached from 1e-8 above it.
                    self.assertAlmostEqual(cost / (target * (1 + 1e-8)) ** (-1 / order), 1, places=12)
                    self.assertFalse(at_most)

    def test_never_extrapolated_to_finer_steps(self):
        self.assertTrue(math.isnan(curve(power_law(2, steps=3)).time_to(1e-9)[0]))

    def test_a_coarsest_run_that_is_better_already_is_a_bound(self):
        self.assertEqual(curve(power_law(4)).time_to(0.5), (10.0, True))

    def test_the_smallest_crossing_counts(self):
        some = curve([(0.4, 1, 1e-2), (0.2, 2, 1e-4), (0.1, 4, 1e-2), (0.05, 8, 1e-4)])
        self.assertAlmostEqual(some.time_to(1e-3)[0], math.sqrt(2))

    def test_a_lost_phase_does_not_count(self):
        """The coarse run is saturated and says nothing about errors: only a bound is known."""
        some = curve([(0.4, 1, 1.9), (0.2, 8, 1e-8)])
        self.assertEqual((some.time_to(1e-4), some.bracket(1e-4)), ((8, True), None))
        some.of_state = False  # of a drift nothing saturates
        self.assertFalse(some.time_to(1e-4)[1])
        # An earlier crossing from the lost phase spoils a later one, which is not the first to reach the error.
        some = curve([(0.8, 1, 1.9), (0.4, 2, 1e-5), (0.2, 4, 1e-3), (0.1, 8, 1e-8)])
        self.assertEqual(some.time_to(1e-4), (2, True))

    def test_both_sides_of_an_error(self):
        some = curve(power_law(4))
        coarse, fine = some.bracket(3e-6)
        self.assertTrue(fine.error <= 3e-6 < coarse.error)
        self.assertLess(coarse.cost, some.time_to(3e-6)[0])
        self.assertIsNone(some.bracket(0.5))  # the coarsest run is better already
        self.assertIsNone(some.bracket(1e-30))
        # Better already at the coarsest, and on both sides further on, by accident.
        self.assertIsNone(curve([(0.4, 1, 1e-9), (0.2, 2, 1e-3), (0.1, 4, 1e-9)]).bracket(1e-6))

    def test_at_equal_cost(self):
        some = curve(power_law(4))
        run_, error, cost = some.at_cost(30.0)
        self.assertAlmostEqual(error * 30.0**4, 1, places=9)
        self.assertEqual((run_.step, cost), (0.025, 40.0))
        self.assertEqual(some.at_cost(1e6)[0].step, some.points[-1].run.step)

    def test_front(self):
        some = [curve([(1, 1, 1e-1), (0.5, 4, 1e-4)]), curve([(1, 2, 1e-3), (0.5, 3, 1e-2)])]
        self.assertEqual([(p.cost, p.error) for p in curves.front(some)], [(1, 1e-1), (2, 1e-3), (4, 1e-4)])

    def test_front_does_not_follow_roundings(self):
        some = [curve([(1, 1, 1e-9), (0.5, 2, 5.3e-12), (0.25, 4, 1.4e-12)]), curve([(1, 3, 5.25e-12), (0.5, 6, 1.3e-12)])]
        self.assertEqual([(p.cost, p.error) for p in curves.front(some)], [(1, 1e-9), (2, 5.3e-12), (4, 1.4e-12)])


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

    def test_round_off_is_never_an_order(self):
        """Errors of the generating function of order 12 in the damped pendulum's runs, and of Gauss of order 8 in the damped
        oscillator's: the last gains are those of round-off."""
        steps = [1.25 / 1.5625**k for k in range(7)]
        some = curve(list(zip(steps, [1 / h for h in steps], (9.6e-2, 7.1e-4, 2.9e-6, 1.1e-8, 5.2e-11, 1.9e-13, 6.3e-15))), 12)
        self.assertAlmostEqual(some.order().value, 12, delta=max(0.15, some.order().interval))
        self.assertFalse(some.order().surprising)
        steps = (0.4, 0.2, 0.1, 0.05)
        some = curve(list(zip(steps, (1, 2, 4, 8), (2.6e-7, 1.0e-9, 5.3e-12, 1.4e-12))), 8)
        self.assertAlmostEqual(some.order().value, 8, delta=0.1)
        self.assertFalse(some.order().surprising)

    def test_a_slope_that_is_not_yet_the_order_has_a_wide_interval(self):
        """Local slopes 5.4, 5.2 and 5.1 come to 5."""
        seen = curve([(h, 1 / h, 3 * h**5 * (1 + 2 * h)) for h in (0.4, 0.2, 0.1, 0.05)], 5).order()
        self.assertGreater(seen.value, 5.1)
        self.assertFalse(seen.surprising)

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
        seen = curve(power_law(4, first=0.4)[:2], 7).order()
        self.assertTrue(math.isnan(seen.interval))
        self.assertAlmostEqual(seen.value, 4)
        self.assertFalse(seen.surprising)  # without an interval nothing is

    def test_a_slope_above_the_order_surprises_of_the_state_alone(self):
        some = curve(power_law(6))
        self.assertTrue(some.order().surprising)
        some.of_state = False
        self.assertFalse(some.order().surprising)
        slow = curve(power_law(2))
        slow.of_state = False
        self.assertTrue(slow.order().surprising)

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
    def test_kept_not_kept_or_not_known(self):
        self.assertIs(curve(power_law(4), residuals=[(0.1, 3e-16), (0.05, 4e-14)]).kept, True)
        self.assertIs(curve(power_law(4), residuals=[(0.1, 1e-9), (0.05, 3e-16)]).kept, False)  # small is accuracy
        self.assertIs(curve(power_law(4)).kept, None)

    def test_a_claim_keeps_what_no_residual_denies(self):
        def claimed(*residuals):
            some = curve(power_law(4), residuals=residuals)
            some.claims = True
            return some.kept
        self.assertIs(claimed(), True)
        self.assertIs(claimed((0.1, 5e-13), (0.05, 3e-16)), True)
        self.assertIs(claimed((0.1, 1e-9), (0.05, 3e-16)), False)

    def test_accuracy_is_no_structure(self):
        """A series of degree 20 is right to round-off in every step, and its residual is as small."""
        exact = [(h, 1 / h, 1e-15) for h in (0.1, 0.05)]
        self.assertIs(curve(exact, residuals=[(0.1, 3e-16), (0.05, 4e-16)]).kept, None)
        of_energy = curve(power_law(4), residuals=[(0.1, 3e-16)])
        of_energy.of_state = False  # what an error of the energy says of a step is not known
        self.assertIs(of_energy.kept, None)

    def test_between_kinks_a_residual_says_nothing(self):
        """Where forces are constant between kinks the Jacobian of every explicit step is that of free motion."""
        kinked = curve(power_law(4), residuals=[(0.1, 0.0), (0.05, 0.0)])
        self.assertIs(kinked.kept, True)
        kinked.kinked = True
        self.assertIs(kinked.kept, None)
        kinked.claims = True
        self.assertIs(kinked.kept, True)

    def test_fills_of_marks(self):
        some = curve(power_law(4))
        self.assertEqual(some.fill, "half")
        some.structured = False
        self.assertEqual(some.fill, "open")  # there is nothing to keep
        self.assertEqual(curve(power_law(4), residuals=[(0.1, 1e-9)]).fill, "open")

    def test_round_off_may_grow_as_steps_become_smaller(self):
        self.assertTrue(curve(power_law(4), residuals=[(0.1, 5e-14), (0.01, 1e-12)]).kept)
        self.assertFalse(curve(power_law(4), residuals=[(0.1, 5e-14), (0.01, 1e-9)]).kept)
        self.assertFalse(curve(power_law(4), residuals=[(0.1, 1e-12), (0.01, 5e-14)]).kept)  # it falls: truncation

    def test_power_of_the_step(self):
        some = curve(power_law(4), residuals=[(h, h**5) for h in (0.1, 0.05)] + [(0.001, 1e-16)])
        self.assertAlmostEqual(some.residual_power(), 5)


if __name__ == "__main__":
    unittest.main()
