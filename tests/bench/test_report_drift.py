"""bench/report: classes of drift come from experiment.json alone, and quantities that are expected to move one way."""
import json
import math
import unittest

from synthetic import CLASSES, Fresh, load, parsed, reading, run, save, synthetic

import drift  # noqa: E402
import findings  # noqa: E402
import verdict  # noqa: E402
import verdict_table  # noqa: E402

NAMES = [c["name"] for c in CLASSES]


class Classes(Fresh):
    """As many methods as classes; each method is given one of the classes."""

    def setUp(self):
        super().setUp()
        synthetic(self.folder, steps=(0.1,), extra_methods=len(CLASSES) - 3)
        head = json.loads((self.folder / "experiment.json").read_text())
        self.labels = [m["label"] for m in head["methods"]]
        self.classify(dict(zip(self.labels, NAMES)))
        self.edit("results.csv", "status", lambda x: "converged")

    def classify(self, classes):
        rows = load(self.folder / "results.csv")
        method, kind = rows[0].index("method"), rows[0].index("energy:class")
        for row in rows[1:]:
            row[kind] = classes[row[method]]
        save(self.folder / "results.csv", rows)

    def drift(self):
        """The items of the finding on drift."""
        shown = reading.Experiment(self.folder)
        found = findings.drift(shown, shown.cases[0])
        return found[0][2] if found else []

    def test_every_method_stands_in_one_class(self):
        items = self.drift()
        self.assertEqual([item.partition(": ")[0] for item in items], NAMES)
        for label, name in zip(self.labels, NAMES):
            holding = [item for item in items if label in item]
            self.assertEqual(len(holding), 1, label)
            self.assertTrue(holding[0].startswith(f"{name}: {label}"), holding)
        self.assertEqual(items[0], f"still: {self.labels[0]}")
        self.assertIn(" [", items[NAMES.index("drifting")])
        self.assertIn("(as t^", items[NAMES.index("spread-out")])

    def test_a_run_without_a_class_is_named(self):
        self.classify(dict(zip(self.labels, [*NAMES[:-1], ""])))
        self.assertEqual(self.drift()[-1], f"without a class, because it was not measured: {self.labels[-1]}")
        self.classify(dict.fromkeys(self.labels, ""))
        self.assertEqual(self.drift(), [])  # a quantity that is free to change has no classes at all

    def test_an_unknown_class_is_refused(self):
        for name, told in (("spread_out", "did you mean 'spread-out'?"),
                           ("zigzag", "expected one of still, near, drifting, spread-out, unused")):
            self.classify(dict(zip(self.labels, [name, *NAMES[1:]])))
            status, stderr = run(self.folder)
            self.assertEqual(status, 2)
            self.assertEqual(stderr, "report.py: results.csv, line 2, column energy:class: unknown drift class "
                             f"'{name}'; {told}\n")
            self.assertFalse((self.folder / "report.html").exists())

    def test_the_page_tells_what_classes_mean(self):
        self.classify(dict(zip(self.labels, [*NAMES[:-1], "near"])))
        self.assertEqual(run(self.folder)[0], 0)
        page = parsed(self.folder)
        for entry in CLASSES[:-1]:
            self.assertIn(entry["meaning"], page.text)
        self.assertNotIn(CLASSES[-1]["meaning"], page.text)  # no run is in it

    def test_the_list_is_checked(self):
        path = self.folder / "experiment.json"
        whole = json.loads(path.read_text())
        for classes, told in ((None, "key 'drift_classes' is missing"),
                              ([{"name": "near"}], "drift class 1: key 'meaning' is missing"),
                              ([*CLASSES, CLASSES[1]], "drift class 'near' appears 2 times, expected once"),
                              ([CLASSES[0] | {"measure": "rms"}], "one of max, slope, exponent, got 'rms'")):
            head = {k: v for k, v in whole.items() if k != "drift_classes"}
            path.write_text(json.dumps(head if classes is None else head | {"drift_classes": classes}))
            status, stderr = run(self.folder)
            self.assertEqual(status, 2)
            self.assertIn(told, stderr)


class Directed(Fresh):
    """The damped case's energy falls; declared as one that is expected to decrease, then to increase."""

    def expect(self, behaviour):
        synthetic(self.folder, steps=(0.2, 0.1))  # `bad` fails at the larger one
        for path in self.folder.glob("runs/damped-*/summary.json"):
            path.write_text(path.read_text().replace("decreasing", behaviour))
        self.shown = reading.Experiment(self.folder)
        return findings.drift(self.shown, self.shown.cases[1])[0]

    def test_what_falls_may_fall(self):
        subject, sentence, items = self.expect("decreasing")
        self.assertEqual((subject, items), ("Decrease", ["never rises: mid, rk and bad"]))
        self.assertEqual(drift.at_equal_step(verdict.Verdict(self.shown, self.shown.cases[1])), [])  # a panel of zeros says less
        self.assertIn("energy is expected to decrease", sentence)

    def test_what_falls_is_expected_to_increase(self):
        subject, sentence, items = self.expect("increasing")
        self.assertEqual(subject, "Increase")
        self.assertIn("energy is expected to increase", sentence)
        self.assertEqual(items, ["falls: mid (by 0.982), rk (by 0.982) and bad (by 0.982)"])  # 1 - exp(-4)
        drawn, = drift.at_equal_step(verdict.Verdict(self.shown, self.shown.cases[1]))
        self.assertIn("expected to increase", drawn.title)
        self.assertEqual("fall of energy / scale", drawn.draw(True).axes[0].get_ylabel())
        self.assertEqual(run(self.folder)[0], 0)
        self.assertIn("falls by 0.982", parsed(self.folder).text)

    def test_what_moves_is_over_its_scale(self):
        """An energy of 1e-19 J that rises by all of it rises by more than round-off."""
        synthetic(self.folder, steps=(0.2, 0.1))
        for path in self.folder.glob("runs/damped-*/series.csv"):
            rows = load(path)
            k = rows[0].index("energy [J]")
            save(path, [rows[0]] + [row[:k] + [repr(1e-19 * (2 - float(row[k])))] + row[k + 1:] for row in rows[1:]])
        for path in self.folder.glob("runs/damped-*/summary.json"):
            written = json.loads(path.read_text())
            for entry in written["invariants"]:
                entry["scale"] = 1e-19
            path.write_text(json.dumps(written))
        shown = reading.Experiment(self.folder)
        _, _, items = findings.drift(shown, shown.cases[1])[0]
        self.assertEqual(items, ["rises: mid (by 0.982), rk (by 0.982) and bad (by 0.982)"])

    def test_the_error_of_what_falls_is_drawn(self):
        self.expect("decreasing")
        said = verdict.Verdict(self.shown, self.shown.cases[1])
        self.assertEqual(drift.drawings(said), [])  # there is no reference solution, and no error
        for path in self.folder.glob("runs/damped-*/series.csv"):
            rows = load(path)
            save(path, [rows[0] + ["energy:error [J]"]] + [row + [repr(1e-6 * math.sin(float(row[0])))] for row in rows[1:]])
        said = verdict.Verdict(reading.Experiment(self.folder), self.shown.cases[1])
        found = drift.moved(said, [(row, row.run) for row in said.rows], lambda series: series.error)
        self.assertEqual({row.label for row, *_ in found}, {row.label for row in said.rows if row.run})
        for *_, times, errors, _ in found:
            self.assertGreater(len(times), 30)
            self.assertAlmostEqual(max(errors), 1e-6, places=9)
            for t, error in zip(times, errors):
                self.assertAlmostEqual(error, abs(1e-6 * math.sin(t)), places=12)
        drawn, = drift.drawings(said)
        self.assertIn("Error of energy against the reference solution, over its scale, 1 J.", drawn.caption)

    def test_a_run_without_a_series_is_named(self):
        self.expect("increasing")
        (self.folder / "runs" / "damped-0-0.1" / "series.csv").unlink()
        self.shown = reading.Experiment(self.folder)
        items = findings.drift(self.shown, self.shown.cases[1])[0][2]
        self.assertEqual(items[-1], "not known, without a series: mid")


class Scale(Fresh):
    def state(self, **of_energy):
        """The summaries of the case `osc`, each with `scale` or `initial` of its energy, which are given by method."""
        shown = reading.Experiment(synthetic(self.folder, steps=(0.1,)))
        for path in self.folder.glob("runs/osc-*/summary.json"):
            head = json.loads(path.read_text())
            for key, sizes in of_energy.items():
                head["invariants"][0][key] = sizes[int(path.parent.name.split("-")[1])]
            path.write_text(json.dumps(head))
        return shown

    def test_it_is_the_least_size_of_the_terms(self):
        self.assertEqual(self.state(scale=(4.0, 9e9, 5.0), initial=(0.5, 0.5, 0.5)).scale({"name": "osc"}, "energy"), 4.0)

    def test_without_terms_it_is_the_size_at_the_start(self):
        self.assertEqual(self.state(scale=(None,) * 3, initial=(-0.5,) * 3).scale({"name": "osc"}, "energy"), 0.5)

    def test_of_quads_it_is_text(self):
        self.assertEqual(self.state(initial=("0", "-0.5", "0.75")).scale({"name": "osc"}, "energy"), 0.5)

    def test_without_either_it_is_one(self):
        self.assertEqual(self.state(initial=(0.0,) * 3).scale({"name": "osc"}, "energy"), 1.0)

    def test_drift_is_drawn_over_it_with_the_value_beside_the_name(self):
        """rk drifts by 1e-3 h^4 = 1e-7 in its own unit, which is 2.5e-8 of a scale of 4."""
        shown = self.state(scale=(4.0, 4.0, 4.0))
        said = verdict.Verdict(shown, shown.cases[0])
        found = {row.label: (values, most) for row, _, _, values, most in
                 drift.moved(said, [(row, row.run) for row in said.rows], lambda series: series.change)}
        values, most = found["rk"]
        self.assertAlmostEqual(most / 1e-7, 1, places=6)  # energies near 1 hold seven digits of it
        self.assertAlmostEqual(max(values) * 4, most, places=20)
        row = next(row for row in said.rows if row.label == "rk")
        self.assertIn("3·10<sup>−8</sup> <small>1·10<sup>−7</sup></small>", verdict_table.drift_cell(said, row)[2])
        drawn, = drift.at_equal_step(said)
        canvas = drawn.draw(True)
        self.assertIn("1e-7 J", [t.get_text() for axes in canvas.axes for t in axes.texts])
        self.assertIn("over its scale, 4 J", drawn.caption)

    def test_a_long_unit_is_said_once(self):
        self.state(scale=(4.0, 4.0, 4.0))
        for path in self.folder.glob("runs/osc-*/summary.json"):
            path.write_text(path.read_text().replace('"J"', '"Msun au^2/d^2"'))
        shown = reading.Experiment(self.folder)
        drawn, = drift.at_equal_step(verdict.Verdict(shown, shown.cases[0]))
        self.assertIn("Beside the names: the largest, in Msun au²/d².", drawn.caption)
        self.assertIn("1e-7", [t.get_text() for axes in drawn.draw(True).axes for t in axes.texts])


if __name__ == "__main__":
    unittest.main()
