"""bench/report: how far methods miss their start when they turn round, and who is said to come back."""
import math
import types
import unittest

from synthetic import Fresh, reading, run, measured, synthetic

import reversibility  # noqa: E402
import verdict  # noqa: E402

U = 2.0**-53


class Reversibility(Fresh):
    def setUp(self):
        super().setUp()
        synthetic(self.folder)

    def write(self, mid=lambda k: 3e-14 * 2**k, rows=(), by="reversal"):
        """A rounding doubles from look to look: `mid` grows with it, `rk` misses its start."""
        table = [["case", "method", "step", "t", "distance", "rounding", "by"]]
        for k in range(11):
            t, rounding = 0.4 * (k + 1), U * 2**k
            table.append(["osc", "mid", "0.4", repr(t), repr(mid(k)), repr(rounding), by])
            table.append(["osc", "rk", "0.4", repr(t), repr(1e-6 * (k + 1)), repr(rounding), "reversal"])
        measured(self.folder, "reversibility", table + list(rows), texts=("by",))
        return reading.Experiment(self.folder)

    def drawing(self, shown):
        drawing, = reversibility.drawings(verdict.Verdict(shown, shown.cases[0]))
        return drawing

    def test_who_grows_with_rounding_comes_back(self):
        shown = self.write()
        found = reversibility.returns(shown, shown.cases[0])
        middle = reversibility.in_the_middle(found.values())
        self.assertEqual([(label, one.comes_back(middle)) for label, one in found.items()], [("mid", True), ("rk", False)])
        self.assertIn("mid comes back to the start but for rounding. The start is missed by rk by up to 1.1e-05.",
                      self.drawing(shown).caption)
        self.assertIn("at step 0.4 s", self.drawing(shown).caption)
        self.assertEqual(reversibility.returns(shown, shown.cases[1]), {})
        self.assertEqual(reversibility.drawings(verdict.Verdict(shown, shown.cases[1])), [])

    def test_a_rounding_of_later_excuses_nothing_before(self):
        # What is lost at the first look is more than rounding has made by then, and less than it makes at the end.
        late = self.write(lambda k: 1.5e-13)
        found = reversibility.returns(late, late.cases[0])
        self.assertLess(found["mid"].farthest, 1000 * found["mid"].rounding)
        self.assertFalse(found["mid"].comes_back(None))
        early = self.write(lambda k: 1.05e-13)
        self.assertTrue(reversibility.returns(early, early.cases[0])["mid"].comes_back(None))
        self.assertIn("No method that was turned round comes back to the start", self.drawing(self.write(lambda k: 1.5e-13)).caption)

    def test_methods_without_a_rounding_are_judged_by_the_one_in_the_middle(self):
        shown = self.write(rows=[["osc", "bad", "0.2", repr(0.2 * k), repr(5e-14 * k), "", "negative steps"] for k in (1, 2, 4, 8)])
        found = reversibility.returns(shown, shown.cases[0])
        self.assertTrue(found["bad"].comes_back(found["mid"]))
        self.assertFalse(found["bad"].comes_back(None))  # 4e-13 against unit round-off
        caption = self.drawing(shown).caption
        self.assertIn("2 of 3 methods come back", caption)
        self.assertIn("bad goes back by negative steps; for the others the system's own reversal", caption)
        self.assertIn("at the largest step at which it finishes", caption)

    def test_a_way_back_that_fails_has_no_point(self):
        shown = self.write(rows=[["osc", "bad", "0.2", "0.2", "1e-3", "", "reversal"], ["osc", "bad", "0.2", "0.4", "", "", "reversal"],
                                 ["osc", "bad", "0.2", "0.8", "1e-2", "", "reversal"]])
        bad = reversibility.returns(shown, shown.cases[0])["bad"]
        self.assertEqual((bad.times, bad.distances, bad.whole), ([0.2, 0.8], [1e-3, 1e-2], False))
        self.assertIn("no point where a step of the way back fails", self.drawing(shown).caption)
        self.assertNotIn("Left out", self.drawing(shown).caption)
        self.assertIn("The start is missed by bad by up to 1.0e-02; rk by 1.1e-05.", self.drawing(shown).caption)

    def test_the_one_in_the_middle_has_the_median_rounding(self):
        three = [reversibility.Returns(0.1, "reversal", [1], [1e-16], [x]) for x in (3e-16, math.nan, 1e-10, 2e-16)]
        self.assertIs(reversibility.in_the_middle(three), three[0])
        self.assertIsNone(reversibility.in_the_middle(three[1:2]))

    def test_of_many_that_miss_the_start_the_worst_are_named(self):
        def shown(*missed):
            return [reversibility.Shown(types.SimpleNamespace(label=f"m{k}, odd"), reversibility.Returns(0.1, "reversal", [1], [x], [x]),
                                        x < 1e-15) for k, x in enumerate(missed)]
        some = shown(1e-6, 1e-2, 1e-3, 1e-5, 1e-4, 1e-16, 1e-16)
        self.assertEqual(reversibility.finding(some, some),
                         "2 of 7 methods come back to the start but for rounding. The start is missed by m1, odd by up to 1.0e-02; "
                         "m2, odd by 1.0e-03; m4, odd by 1.0e-04; 2 more by less.")
        self.assertEqual(reversibility.finding(shown(1e-16, 1e-16), range(2)), "Every method comes back to its start but for rounding.")
        self.assertEqual(reversibility.finding(shown(1e-16), range(1)), "m0, odd comes back to its start but for rounding.")

    def test_every_method_is_said_where_every_method_was_turned_round(self):
        """One that chooses its steps is not."""
        two = [reversibility.Shown(types.SimpleNamespace(label=label), reversibility.Returns(0.1, "reversal", [1], [x], [x]), back)
               for label, x, back in (("a", 1e-16, True), ("b", 1e-16, True))]
        self.assertEqual(reversibility.finding(two, range(3)), "Every method that was turned round comes back to its start but for rounding.")
        for one in two:
            one.back = False
        self.assertIn("No method that was turned round comes back to the start", reversibility.finding(two, range(3)))

    def test_methods_of_which_nothing_is_known_are_named(self):
        caption = self.drawing(self.write()).caption
        self.assertIn("Left out is bad: a method that remembers earlier steps cannot be turned round by its state", caption)
        self.assertIn("The way back is one of negative steps.", self.drawing(self.only_negative()).caption)

    def only_negative(self):
        measured(self.folder, "reversibility", [["case", "method", "step", "t", "distance", "rounding", "by"]]
             + [["osc", "mid", "0.4", repr(0.4 * k), "1e-16", "1e-16", "negative steps"] for k in (1, 2, 4)],
                 texts=("by",))
        return reading.Experiment(self.folder)

    def test_the_page_shows_it(self):
        self.write()
        self.assertEqual(run(self.folder)[0], 0)
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertIn('<h3 id="reversibility-osc">Reversibility along the run</h3>', page)
        self.assertIn("<title>rk: at most 1.1e-05</title>", page)
        self.assertIn("<title>mid: at most 3.1e-11, comes back</title>", page)
        self.assertIn("<title>one rounding at the turn</title>", page)
        self.assertIn('href="measures/reversibility.csv"', page)
        self.assertTrue((self.folder / "figures" / "reversibility_osc.svg").exists())
        self.assertFalse((self.folder / "figures" / "reversibility_damped.svg").exists())

    def test_nothing_is_drawn_below_round_off(self):
        shown = self.write(lambda k: 0.0 if k == 3 else 1e-19 if k == 4 else 2e-16)
        one = reversibility.returns(shown, shown.cases[0])["mid"]
        self.assertEqual(reversibility.visible(one)[2:6], [2e-16, U, U, 2e-16])
        self.assertNotIn("Exact zeros", self.drawing(shown).caption)

    def test_what_cannot_be_read_is_refused(self):
        for row, column in ((["osc", "mid", "0.4", "5", "far", "1e-16", "reversal"], "distance"),
                            (["osc", "mid", "0.4", "5", "1e-16", "1e-16", "sideways"], "by")):
            self.write(rows=[row])
            status, stderr = run(self.folder)
            self.assertEqual(status, 2)
            self.assertIn(f"reversibility.csv, line 24, column {column}", stderr)


if __name__ == "__main__":
    unittest.main()
