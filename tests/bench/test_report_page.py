"""bench/report: what report.py makes of whole, partial and unusual experiments."""
import base64
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from synthetic import SCRIPTS, Fresh, parsed, reading, run, synthetic

import drift  # noqa: E402
import verdict  # noqa: E402
import work_precision  # noqa: E402


class Rows(Fresh):
    def test_the_page_says_at_how_many_rows_errors_are_measured(self):
        path = synthetic(self.folder) / "experiment.json"
        head = json.loads(path.read_text())
        head["cases"][0]["error_rows"] = 200
        path.write_text(json.dumps(head))
        self.assertEqual(run(self.folder)[0], 0)
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertIn("relative to the exact solution at 200 rows of a run at most", page)
        shown = reading.Experiment(self.folder)
        captions = [d.caption for d in work_precision.drawings(verdict.Verdict(shown, shown.cases[0]))]
        self.assertIn("Errors are the largest at 200 rows of a run at most.", captions[0])


class Whole(unittest.TestCase):
    """One experiment, reported once."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = synthetic(cls.temporary.name)
        cls.status, cls.stderr = run(cls.folder)
        cls.page = parsed(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_files(self):
        self.assertEqual(self.status, 0, self.stderr)
        kinds = {"osc": ("work_precision", "work_precision_evaluations", "drift", "drift_at_equal_step", "structure"),
                 "damped": ("structure",)}  # whose energy falls, and never rises
        expected = {f"{kind}_{case}.{end}" for case, some in kinds.items() for kind in some for end in ("svg", "png")} | {
            "small.svg", "made.json"}
        self.assertEqual({p.name for p in (self.folder / "figures").iterdir()}, expected)
        self.assertEqual({p.name for p in self.folder.iterdir()},  # and no temporary name is left
                         {"experiment.json", "results.csv", "cost.csv", "runs", "figures", "report.html", "report.json",
                          "verdict.csv"})
        for path in (self.folder / "figures").glob("*.svg"):
            xml.etree.ElementTree.parse(path)
            self.assertNotIn("<dc:date>", path.read_text())
        for path in (self.folder / "figures").glob("*.png"):
            self.assertEqual(path.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_page_stands_alone(self):
        self.assertEqual(self.page.open, [])
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))
        self.assertTrue(self.page.tags.isdisjoint({"link", "img", "iframe"}))
        inside = [x[1:] for x in self.page.links if x.startswith("#")]
        beside = [x for x in self.page.links if not x.startswith("#") and not x.startswith("https://doi.org/")]
        self.assertEqual([x for x in beside if not (self.folder / x).exists() and not x.endswith("/config.toml")], [])
        for some in ("results.csv", "cost.csv", "figures/drift_osc.svg", "runs/osc-0-0.4/series.csv"):
            self.assertIn(some, beside)
        targets = set(inside)
        self.assertLessEqual(targets, set(self.page.ids))
        source = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertNotRegex(source, r"url\((?!#)|@import")
        self.assertLessEqual(set(re.findall(r"url\(#([^)]*)\)", source)), set(self.page.ids))

    def test_one_script_which_the_policy_names(self):
        source = (self.folder / "report.html").read_text(encoding="utf-8")
        script, = re.findall(r"<script>(.*?)</script>", source, flags=re.S)
        digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
        self.assertIn(f"script-src 'sha256-{digest}'", source)
        self.assertNotRegex(source, r"\son[a-z]+=")

    def test_every_figure_tells_its_finding(self):
        source = (self.folder / "report.html").read_text(encoding="utf-8")
        figures_of_page = re.findall(r"<svg class=\"(?:wide|narrow)\"[^>]*>(<desc>[^<]+</desc>)?", source)
        self.assertGreater(len(figures_of_page), 10)
        self.assertTrue(all(figures_of_page))

    def test_colours_are_those_of_the_style_sheet(self):
        source = (self.folder / "report.html").read_text(encoding="utf-8")
        drawn = "".join(re.findall(r"<svg .*?</svg>", source, flags=re.S))
        self.assertEqual(set(re.findall(r"#[0-9a-f]{6}\b", drawn)) - set(self.page.ids), set())
        for variable in set(re.findall(r"var\(--([a-z]+)\)", drawn)):
            self.assertEqual(len(re.findall(rf"--{variable}:#", source)), 2, variable)  # light and dark
        alone = (self.folder / "figures" / "drift_osc.svg").read_text(encoding="utf-8")
        self.assertNotIn("var(", alone)

    def test_text_is_escaped(self):
        self.assertIn("A & B <script>", self.page.text)
        self.assertIn("Damped <b>", self.page.text)

    def test_findings(self):
        for said in ("The symplectic structure is kept by 1 of 3 methods of which it is known", "kept: mid", "falling as h 5.0",
                     "Drift of energy [J] at step 0.2 s, by class:", "near: mid (at most 1.11e-16)",
                     "rk at 4e-8 [3.2e-8, 5.33e-8] J/s", "energy is expected to decrease",
                     "never rises: mid, rk and bad",
                     "as claimed, as far as it can be told: mid (2.00 ± 0.01; claimed 2), rk (4.00 ± 0.01; claimed 4)",
                     "oscillator: symmetric, symplectic; damped: symmetric", "oscillator: 2; damped: 3",
                     "1 of 9 runs failed: bad at step 0.4 s: non_finite, blew up at t = 12"):
            self.assertIn(said, self.page.text)

    def test_tables_and_provenance(self):
        for said in ("✗ non_finite: blew up at t = 12", "GCC 12", "-O3", "Su and Qin, 2004.", "su-qin", "A note.",
                     "pfaff compare synthetic", "the case has no reference solution", "of which 2 failed"):
            self.assertIn(said, self.page.text)

    def test_what_is_expected_to_decrease_and_does_has_no_figure_of_rises(self):
        shown = reading.Experiment(self.folder)
        titles = [[one.title for one in drift.at_equal_step(verdict.Verdict(shown, case))] for case in shown.cases]
        self.assertEqual(titles, [["Oscillator: drift of energy (step 0.2 s)"], []])

    def test_same_bytes_again(self):
        paths = [self.folder / "report.html", *sorted((self.folder / "figures").iterdir())]
        before = [p.read_bytes() for p in paths]
        done = subprocess.run([sys.executable, SCRIPTS / "report.py", self.folder], capture_output=True,
                              env=os.environ | {"PYTHONHASHSEED": "7"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout), {"report": str(self.folder / "report.html")})
        self.assertEqual(before, [p.read_bytes() for p in paths])


class Variants(Fresh):
    def fine(self):
        status, stderr = run(self.folder)
        self.assertEqual(status, 0, stderr)
        return parsed(self.folder)

    def test_no_timings_one_step(self):
        synthetic(self.folder, steps=(0.1,))
        (self.folder / "cost.csv").unlink()
        page = self.fine()
        self.assertIn("Timings were not measured.", page.text)
        self.assertIn("right-hand sides stand for cost", page.text)

    def test_zero_and_infinite(self):
        synthetic(self.folder)
        self.edit("results.csv", "error_max", lambda x: "0", lambda row: row[2] == "mid")
        self.edit("results.csv", "structure_residual", lambda x: "inf", lambda row: row[2] == "bad")
        shown = reading.Experiment(self.folder)
        self.assertIn("Errors of zero", work_precision.drawings(verdict.Verdict(shown, shown.cases[0]))[0].caption)
        self.fine()

    def test_all_failed(self):
        synthetic(self.folder)
        self.edit("results.csv", "status", lambda x: "singular")
        self.edit("results.csv", "error_max", lambda x: "nan")
        self.assertIn("9 of 9 runs failed", self.fine().text)

    def test_without_series(self):
        synthetic(self.folder)
        for path in self.folder.glob("runs/*/series.csv"):
            path.unlink()
        self.assertIn("no run left a series", self.fine().text)

    def test_unusual_names(self):
        synthetic(self.folder)
        text = (self.folder / "experiment.json").read_text().replace('"rk"', '"r$k$ _{"').replace("Oscillator", "$x")
        (self.folder / "experiment.json").write_text(text)
        self.edit("results.csv", "method", lambda x: "r$k$ _{" if x == "rk" else x)
        self.assertIn("r$k$ _{", self.fine().text)

    def test_steps_stand_in_for_right_hand_sides(self):
        synthetic(self.folder)
        self.edit("results.csv", "rhs_per_step", lambda x: "0", lambda row: row[2] == "mid")
        (self.folder / "cost.csv").unlink()
        page = self.fine()
        self.assertIn("steps stand for cost", page.text)
        self.assertIn("steps of the run", page.text)


if __name__ == "__main__":
    unittest.main()
