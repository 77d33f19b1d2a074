"""bench/report: negative controls. Each breaks one thing and expects exit status 2, one line on stderr that names the
place, and no report."""
import json
import subprocess
import sys
import unittest

from synthetic import SCRIPTS, Fresh, load, run, save, synthetic


class Refused(Fresh):
    """Negative controls: each breaks one thing."""

    def setUp(self):
        super().setUp()
        synthetic(self.folder, steps=(0.2, 0.1))

    def refused(self, *words):
        status, stderr = run(self.folder)
        self.assertEqual(status, 2)
        self.assertEqual(stderr.count("\n"), 1, stderr)
        self.assertTrue(stderr.startswith("report.py: "), stderr)
        for word in words:
            self.assertIn(word, stderr)
        self.assertFalse((self.folder / "report.html").exists())

    def drop(self, name, column):
        rows = load(self.folder / name)
        k = rows[0].index(column)
        save(self.folder / name, [row[:k] + row[k + 1:] for row in rows])

    def change_head(self, change):
        head = json.loads((self.folder / "experiment.json").read_text())
        change(head)
        (self.folder / "experiment.json").write_text(json.dumps(head))

    def test_missing_columns(self):
        whole = (self.folder / "results.csv").read_bytes()
        for column in ("case", "status", "rhs_per_step", "run", "energy:slope", "energy:max"):
            with self.subTest(column):
                (self.folder / "results.csv").write_bytes(whole)
                self.drop("results.csv", column)
                self.refused("results.csv", f"'{column}'", "is missing")

    def test_missing_cost_column(self):
        self.drop("cost.csv", "ns_per_step")
        self.refused("cost.csv", "'ns_per_step'")

    def test_missing_series_column(self):
        self.drop("runs/osc-1-0.1/series.csv", "energy [J]")
        self.refused("runs/osc-1-0.1/series.csv", "'energy'")

    def test_bad_number(self):
        self.edit("results.csv", "error_max", lambda x: "many", lambda row: row[2] == "rk")
        self.refused("results.csv, line 4, column error_max", "'many'")

    def test_bad_step(self):
        self.edit("results.csv", "step", lambda x: "0")
        self.refused("column step", "positive")

    def test_short_row(self):
        rows = load(self.folder / "results.csv")
        save(self.folder / "results.csv", [*rows[:2], rows[2][:5]])
        self.refused("results.csv, line 3", "5")

    def test_unknown_names(self):
        for column in ("case", "method"):
            with self.subTest(column):
                whole = (self.folder / "results.csv").read_bytes()
                self.edit("results.csv", column, lambda x: "nobody")
                self.refused(f"{column} 'nobody'")
                (self.folder / "results.csv").write_bytes(whole)

    def test_no_runs(self):
        save(self.folder / "results.csv", load(self.folder / "results.csv")[:1])
        self.refused("at least one run")

    def test_head(self):
        for change, words in ((lambda h: h.pop("cases"), "'cases'"), (lambda h: h.update(schema=1), "expected \"schema\": 2, got 1"),
                              (lambda h: h["methods"].append(h["methods"][0]), "appears 2 times"),
                              (lambda h: h.pop("citation"), "citation"),
                              (lambda h: h["cases"][0].update(precision="half"), "half"),
                              (lambda h: h["cases"][0].update(parameters=[1]), "'parameters' to be an object"),
                              (lambda h: h["methods"][0]["systems"][0].pop("preserves"), "'preserves'"),
                              (lambda h: h["methods"][0]["systems"][0].update(order="2"), "'order' to be an integer"),
                              (lambda h: h.update(methods={}), "'methods' to be a list")):
            with self.subTest(words):
                text = (self.folder / "experiment.json").read_text()
                self.change_head(change)
                self.refused("experiment.json", words)
                (self.folder / "experiment.json").write_text(text)

    def test_not_json(self):
        (self.folder / "experiment.json").write_text("{\n")
        self.refused("experiment.json", "JSON")

    def test_summary(self):
        (self.folder / "runs/osc-0-0.2/summary.json").write_text('{"schema": 1, "invariants": [{"unit": "J"}]}')
        self.refused("runs/osc-0-0.2/summary.json, invariant 1", "'name'")

    def test_no_directory(self):
        self.folder = self.folder / "absent"
        self.refused("absent", "directory")

    def test_usage(self):
        for arguments in ([], ["a", "b"]):
            done = subprocess.run([sys.executable, SCRIPTS / "report.py", *arguments], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))


if __name__ == "__main__":
    unittest.main()
