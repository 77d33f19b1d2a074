"""bench/report: how errors spread over the seeds of an ensemble."""
import json
import math
import unittest

from synthetic import CLASSES, COLUMNS, FIELDS, Fresh, describe, load, reading, run, save

import bands  # noqa: E402
import ensembles  # noqa: E402
import verdict  # noqa: E402
import work_precision  # noqa: E402

SEEDS = 4


def walks(folder, fails=""):
    """`walk` has errors +-1e-9 t^0.5, `drift` 1e-9 t, of either sign over the seeds; `fails` names a run that failed."""
    measures = [f"energy:{m}" for m in FIELDS]
    rows = []
    for label, power in (("walk", 0.5), ("drift", 1)):
        for seed in range(1, SEEDS + 1):
            slug = f"{label}-{seed}"
            row = dict.fromkeys(COLUMNS + measures + ["seed", "run"], "")
            row.update({"case": "many", "system": "chaos", "method": label, "integrator": label, "step": 0.1,
                        "time": 100, "steps": 1000, "precision": "double", "rhs_per_step": 1, "run": slug, "seed": seed,
                        "status": "non_finite" if slug == fails else "converged", "energy:max": 1e-6,
                        "energy:class": "near"})
            rows.append(row)
            path = folder / "runs" / slug
            path.mkdir(parents=True)
            scale = 1e-3 if slug == fails else (-1) ** seed * seed * 1e-9
            save(path / "series.csv", [["t [s]", "energy [J]"]] + [
                [repr(0.5 * k), repr(1 + scale * (0.5 * k) ** power)] for k in range(201)])
            (path / "summary.json").write_text(json.dumps({"schema": 1, "invariants": [
                {"name": "energy", "unit": "J", "expected": "conserved"}]}))
    head = {"schema": reading.SCHEMA, "name": "many", "title": "Many", "drift_classes": CLASSES, "cases": [
        {"name": "many", "title": "Many", "system": "chaos", "precision": "double", "time_unit": "s",
         "conserved": "energy", "seeds": SEEDS}], "methods": [{"label": m} for m in ("walk", "drift")]}
    save(folder / "results.csv", [list(rows[0])] + [list(r.values()) for r in rows])
    describe(folder, head)
    return folder


class Spreads(Fresh):
    def test_rms_and_its_power_of_time(self):
        shown = reading.Experiment(walks(self.folder))
        curves = ensembles.spreads(shown, shown.cases[0])
        self.assertEqual([c[0].method for c in curves], ["walk", "drift"])
        rms = math.sqrt(sum(s * s for s in range(1, SEEDS + 1)) / SEEDS)
        for power, (_, times, values) in zip((0.5, 1), curves):
            self.assertEqual(len(times), 200)  # without the start
            self.assertAlmostEqual(values[-1] / (1e-9 * rms * 100**power), 1, places=5)
            self.assertAlmostEqual(ensembles.exponent(times, values), power, places=3)

    def test_bands_hold_the_seeds(self):
        shown = reading.Experiment(walks(self.folder))
        drawing, = bands.drawings(verdict.Verdict(shown, shown.cases[0]))
        canvas = drawing.draw(True)
        walk = canvas.axes[[a.get_title(loc="left") for a in canvas.axes].index("walk")]
        most, median = (line.get_ydata() for line in walk.lines[:2])
        self.assertAlmostEqual(most[-1] / (SEEDS * 1e-9 * 10), 1, places=5)  # the last seed's at t = 100
        self.assertAlmostEqual(median[-1] / (2.5e-9 * 10), 1, places=5)  # halfway between the second and the third
        self.assertEqual([bands.quantile([4, 1, 3, 2], part) for part in (0, 0.5, 1)], [1, 2.5, 4])
        self.assertAlmostEqual(bands.quantile([1, 2, 3, 4], 0.1), 1.3)

    def test_bands_have_the_unit_of_the_quantity(self):
        shown = reading.Experiment(walks(self.folder))
        drawing, = bands.drawings(verdict.Verdict(shown, shown.cases[0]))
        self.assertEqual(drawing.draw(True).axes[0].get_ylabel(), "drift of energy [J]")
        drawing, = work_precision.drawings(verdict.Verdict(shown, shown.cases[0]))
        self.assertEqual(drawing.draw(True).axes[0].get_ylabel(), "largest drift of energy [J]")

    def test_a_line_of_fewer_than_three_times_is_named_and_not_drawn(self):
        """The seeds of `drift` chose their steps, and have the end alone in common."""
        walks(self.folder)
        for seed in range(1, SEEDS + 1):
            path = self.folder / "runs" / f"drift-{seed}" / "series.csv"
            rows = load(path)
            save(path, rows[:2] + [[repr(float(t) + 0.01 * seed), x] for t, x in rows[2:-1]] + rows[-1:])
        shown = reading.Experiment(self.folder)
        drawing, = ensembles.drawings(verdict.Verdict(shown, shown.cases[0]))
        self.assertIn("Left out is drift, whose seeds have no three times in common.", drawing.caption)
        self.assertEqual({t.get_text() for t in drawing.draw(True).axes[0].texts} & {"walk", "drift"}, {"walk"})

    def test_power_needs_positive_values(self):
        self.assertTrue(math.isnan(ensembles.exponent([1, 2, 3, 4], [0, 0, 0, 0])))
        self.assertTrue(math.isnan(ensembles.exponent([], [])))

    def test_failed_runs_are_left_out(self):
        shown = reading.Experiment(walks(self.folder, fails="walk-2"))
        curve = ensembles.spreads(shown, shown.cases[0])[0]
        rms = math.sqrt((1 + 9 + 16) / 3)
        self.assertAlmostEqual(curve[2][-1] / (1e-9 * rms * 10), 1, places=5)

    def test_report_shows_and_tells_the_spread(self):
        folder = walks(self.folder)
        self.assertEqual(run(folder)[0], 0)
        self.assertTrue((folder / "figures" / "ensemble_many.svg").exists())
        page = (folder / "report.html").read_text()
        self.assertIn("t<sup>0.50</sup>", page)
        self.assertIn("t<sup>1.00</sup>", page)
        self.assertGreater(len(load(folder / "results.csv")), 1)


if __name__ == "__main__":
    unittest.main()
