"""bench/report: residuals of constraints, ensembles over seeds, claims."""
import json
import math
import unittest

from synthetic import CLAIM_COLUMNS, CLASSES, COLUMNS, FIELDS, Fresh, U, describe, reading, run, save

import constraints  # noqa: E402
import verdict  # noqa: E402

SEEDS = 3


def ensemble(folder):
    """`mild` grows like t and `wild` like t^2, three seeds each, a tolerance instead of steps."""
    names = ("energy", "constraint")
    measures = [f"{n}:{m}" for n in names for m in FIELDS]
    rows, spreads = [], []
    for label, power in (("mild", 1), ("wild", 2)):
        for seed in range(1, SEEDS + 1):
            slug = f"{label}-{seed}"
            row = dict.fromkeys(COLUMNS + measures + ["constraint:growth", "constraint:growth_rate", "tolerance", "seed",
                                                      "run"], "")
            row.update({"case": "many", "system": "pendula", "method": label, "integrator": label, "time": 20,
                        "steps": 1000, "precision": "double", "status": "converged", "rhs_per_step": 7, "run": slug,
                        "tolerance": "1e-8", "seed": seed, "energy:max": 1e-6, "energy:class": "drifting",
                        "constraint:max": seed * 1e-9 * 20**power, "constraint:class": "drifting",
                        "constraint:growth": power})
            rows.append(row)
            path = folder / "runs" / slug
            path.mkdir(parents=True)
            save(path / "series.csv", [["t [s]", "energy [J]", "constraint [1]"]] + [
                [repr(0.1 * k), repr(1 + 1e-8 * k), repr(U + seed * 1e-9 * (0.1 * k)**power)] for k in range(201)])
            (path / "summary.json").write_text(json.dumps({"schema": 1, "invariants": [
                {"name": "energy", "unit": "J", "expected": "conserved"}]}))
        for measure, scale in (("constraint:max", 1e-9 * 20**power), ("constraint:growth", power)):
            spreads.append(["many", label, "", "1e-8", SEEDS, SEEDS, measure, SEEDS, 2 * scale, scale, 3 * scale])
    head = {"schema": reading.SCHEMA, "name": "ensemble", "title": "Many", "drift_classes": CLASSES, "cases": [
        {"name": "many", "title": "Many <b>", "system": "pendula", "precision": "double", "time_unit": "s",
         "conserved": "energy", "seeds": SEEDS}], "methods": [{"label": m} for m in ("mild", "wild")]}
    save(folder / "results.csv", [list(rows[0])] + [list(r.values()) for r in rows])
    save(folder / "ensembles.csv", ["case,method,step,tolerance,runs,finished,measure,measured,median,low,high".split(","), *spreads])
    save(folder / "findings.csv", [CLAIM_COLUMNS, [
        "many", "constraint:max", "wild", "exceeds", 1, "mild", "", "", SEEDS, SEEDS, SEEDS, "yes", 20]])
    describe(folder, head)
    return folder


class Ensembles(Fresh):
    def test_lines_are_medians_over_the_seeds(self):
        shown = reading.Experiment(ensemble(self.folder))
        case = shown.cases[0]
        curves = constraints.panel_curves(shown, case, "constraint", shown.at_common_step(case))
        self.assertEqual([c[0].method for c in curves], ["mild", "wild"])
        for power, (_, times, values) in zip((1, 2), curves):
            self.assertAlmostEqual(times[-1], 20)
            self.assertAlmostEqual(values[-1] / (2e-9 * 20**power), 1, places=6)  # the median seed is the second
            seen = math.log(values[-1] / values[0]) / math.log(times[-1] / times[0])
            self.assertAlmostEqual(seen, power, delta=0.05)  # a stretch ends up to 9 % after its last sample

    def test_page_tells_medians_growth_and_claims(self):
        self.assertEqual(run(ensemble(self.folder))[0], 0)
        page = (self.folder / "report.html").read_text()
        for told in ("holds: constraint:max of wild exceeds that of mild in 3 of 3 runs", "t<sup>2.00</sup>",
                     "Median and range over 3 seeds", "medians over 3 seeds"):
            self.assertIn(told, page)
        self.assertNotIn("There is no figure", page)
        self.assertTrue((self.folder / "figures" / "constraints_many.svg").exists())
        self.assertFalse((self.folder / "figures" / "drift_many.svg").exists())

    def test_runs_whose_motion_has_no_constraints_are_left_out(self):
        folder = ensemble(self.folder)
        for seed in range(1, SEEDS + 1):
            path = folder / "runs" / f"mild-{seed}" / "series.csv"
            save(path, [line.split(",")[:2] for line in path.read_text().splitlines()])
        shown = reading.Experiment(folder)
        curves = constraints.panel_curves(shown, shown.cases[0], "constraint", shown.runs_of(shown.cases[0]))
        self.assertEqual([c[0].method for c in curves], ["wild"])
        self.assertEqual(run(folder)[0], 0)

    def test_three_panels_have_room(self):
        shown = reading.Experiment(ensemble(self.folder))
        drawing, = constraints.drawings(verdict.Verdict(shown, shown.cases[0]))
        for wide in (True, False):
            sheet = drawing.draw(wide)
            sheet.png()
            boxes = [a.get_tightbbox(sheet.figure.canvas.get_renderer()) for a in sheet.axes]
            self.assertFalse(any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i]))

    def test_missing_columns_are_named(self):
        folder = ensemble(self.folder)
        save(folder / "ensembles.csv", [["case", "method"]])
        status, told = run(folder)
        self.assertEqual(status, 2)
        self.assertIn("ensembles.csv: column 'step' is missing", told)


if __name__ == "__main__":
    unittest.main()
