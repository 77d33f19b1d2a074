"""bench/report: a small synthetic experiment with known drift, structure and cost, and what report.py makes of it.

The negative controls break one thing each and expect exit status 2, one line on stderr that names the place, and no
report. Run by  python3 -m unittest tests/bench/test_report.py  or directly.
"""
import contextlib
import csv
import html.parser
import io
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "bench" / "report"
sys.path.insert(0, str(SCRIPTS))

import experiment as reading  # noqa: E402
import figures  # noqa: E402
import report  # noqa: E402
import scales  # noqa: E402

COLUMNS = ("case,system,method,integrator,parameters,step,time,steps,precision,status,message,error_max,error_final,"
           "structure_residual,rhs_per_step,jacobians_per_step,iterations_per_step,factorisations_per_step").split(",")
U = 2.0**-53


def synthetic(folder, steps=(0.4, 0.2, 0.1), extra_methods=0):
    """Two cases, three methods: `mid` keeps everything, `rk` drifts with h^4, `bad` fails at its largest step."""
    folder = pathlib.Path(folder)
    labels = ["mid", "rk", "bad"] + [f"a method with a rather long name, number {k}" for k in range(extra_methods)]
    cases = [{"name": "osc", "title": "Oscillator", "system": "oscillator", "parameters": {"omega": 1}, "time": 40,
              "time_unit": "s", "precision": "double", "conserved": "energy", "structure": "symplectic",
              "reference_solution": "exact"},
             {"name": "damped", "title": "Damped <b>", "system": "damped", "parameters": {}, "time": 40,
              "time_unit": "s", "precision": "quad", "conserved": "energy", "structure": "K-symplectic",
              "reference_solution": None}]
    measures = [f"{i}:{m}" for i in ("energy", "momentum") for m in reading.MEASURES]
    rows, costs = [], []
    for case in cases:
        for label in labels:
            for h in steps:
                slug = f"{case['name']}-{labels.index(label)}-{h}"
                fails = label == "bad" and h == max(steps)
                row = dict.fromkeys(COLUMNS + measures + ["run"], "")
                size = {"mid": U, "rk": 1e-3 * h**4}.get(label, 1e-2 * h)
                row.update({
                    "case": case["name"], "system": case["system"], "method": label, "integrator": label, "step": h,
                    "time": 40, "steps": round(40 / h), "precision": case["precision"],
                    "status": "non_finite" if fails else "converged", "message": "blew up at t = 12" if fails else "",
                    "error_max": "" if fails or case["name"] == "damped" else 0.1 * h**(2 if label == "mid" else 4),
                    "structure_residual": 2e-16 if label == "mid" and case["name"] == "osc" else 0 if label == "mid"
                    else h**5, "rhs_per_step": 4, "run": slug, "energy:max": size, "energy:slope": size / 40,
                    "energy:slope_low": size / 50, "energy:slope_high": size / 30,
                    "energy:class": "bounded" if label == "mid" else "linear",
                    "momentum:max": 0, "momentum:class": "exact"})
                rows.append(row)
                if not fails:
                    costs.append([case["name"], label, h, 100 if label == "mid" else 50, 40, 120, 5, 0.1])
                write_run(folder / "runs" / slug, case, label, h, size, 12 if fails else 40)
    head = {"schema": 1, "name": "synthetic", "title": "A & B <script>", "description": "Made up.", "quick": False,
            "reference": ["su-qin"], "citation": ["Su and Qin, 2004."], "cases": cases, "notes": ["A note."],
            "versions": {"pfaff": "0.1", "compiler": "GCC 12", "flags": "-O3", "eigen": "3.4", "boost": "1.74"},
            "methods": [{"label": m, "integrator": m, "parameters": {}, "order": 2 if m == "mid" else 4, "claims": []}
                        for m in labels]}
    (folder / "experiment.json").write_text(json.dumps(head))
    save(folder / "results.csv", [list(rows[0])] + [list(r.values()) for r in rows])
    save(folder / "cost.csv", [list(reading.COST_COLUMNS) + ["repetitions", "seconds"]] + costs)
    return folder


def write_run(folder, case, label, h, size, end):
    folder.mkdir(parents=True)
    damped = case["name"] == "damped"
    rows = [["t [s]", "q [m]", "energy [J]", "momentum [N s]", "error", "structure_residual"]]
    for k in range(int(end / h) + 1):
        energy = math.exp(-0.1 * k * h) if damped else 1 + (0 if label == "mid" else size * k * h / 40)
        rows.append([repr(k * h), 0, repr(energy), 0, "", size if k % 3 == 0 else ""])
    save(folder / "series.csv", rows)
    (folder / "summary.json").write_text(json.dumps({"schema": 1, "invariants": [
        {"name": "energy", "unit": "J", "expected": "decreasing" if damped else "conserved"}]}))


def save(path, rows):
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows(rows)


def load(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


def run(folder):
    """(exit status, stderr) of report.py in this process."""
    with contextlib.redirect_stderr(io.StringIO()) as stderr:
        status = report.main([str(folder)])
    return status, stderr.getvalue()


class Balance(html.parser.HTMLParser):
    """Collects ids and everything a page could fetch, and checks that tags are closed in order."""
    VOID = {"meta", "br", "link", "img", "input", "hr"}

    def __init__(self):
        super().__init__()
        self.open, self.ids, self.links, self.tags, self.words = [], [], [], set(), []

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            if name in ("src", "href", "xlink:href", "data", "action"):
                self.links.append(value)
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        self.handle_endtag(tag)

    def handle_endtag(self, tag):
        if tag not in self.VOID:
            assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-3:]}"
            self.open.pop()

    def handle_data(self, data):
        self.words.append(data)


def parsed(folder):
    parser = Balance()
    parser.feed((folder / "report.html").read_text(encoding="utf-8"))
    parser.text = " ".join(" ".join(parser.words).split())
    return parser


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
        expected = {f"{kind}_{case}.{end}" for kind in ("drift", "work_precision", "structure")
                    for end in ("svg", "png") for case in ("osc", "damped")}
        expected -= {"work_precision_damped.svg", "work_precision_damped.png"}
        self.assertEqual({p.name for p in (self.folder / "figures").iterdir()}, expected)
        self.assertEqual({p.name for p in self.folder.iterdir()},  # and no temporary name is left
                         {"experiment.json", "results.csv", "cost.csv", "runs", "figures", "report.html"})
        for path in (self.folder / "figures").glob("*.svg"):
            xml.etree.ElementTree.parse(path)
            self.assertNotIn("<dc:date>", path.read_text())
        for path in (self.folder / "figures").glob("*.png"):
            self.assertEqual(path.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_page_stands_alone(self):
        self.assertEqual(self.page.open, [])
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))
        self.assertTrue(self.page.tags.isdisjoint({"script", "link", "img", "iframe"}))
        self.assertEqual([x for x in self.page.links if not x.startswith("#")], [])
        targets = {x[1:] for x in self.page.links}
        self.assertLessEqual(targets, set(self.page.ids))
        source = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertNotRegex(source, r"url\((?!#)|@import")
        self.assertLessEqual(set(re.findall(r"url\(#([^)]*)\)", source)), set(self.page.ids))

    def test_text_is_escaped(self):
        self.assertIn("A & B <script>", self.page.text)
        self.assertIn("Damped <b>", self.page.text)

    def test_findings(self):
        for said in ("The symplectic structure is kept to round-off by 1 of 3 methods", "kept: mid", "falling as h 5.0",
                     "Drift of energy [J] at step 0.2 s, by class:", "bounded: mid (at most 1.11e-16)",
                     "rk at 4e-8 [3.2e-8, 5.33e-8] J/s", "energy is expected to decrease",
                     "never rises: mid, rk and bad",
                     "within 0.3 of the declared order: mid (2.00), rk (4.00) and bad (4.00)",
                     "error at most 1e-3: rk at step 0.2 s (10 µs), then bad (1×) and mid (4×); 3 of 3",
                     "1 of 9 runs failed: bad at step 0.4 s: non_finite, blew up at t = 12"):
            self.assertIn(said, self.page.text)

    def test_tables_and_provenance(self):
        for said in ("✗ non_finite: blew up at t = 12", "GCC 12", "-O3", "Su and Qin, 2004.", "su-qin", "A note.",
                     "pfaff compare synthetic", "the case has no reference solution", "of which 2 failed"):
            self.assertIn(said, self.page.text)

    def test_decreasing_is_in_the_title(self):
        shown = reading.Experiment(self.folder)
        self.assertIn("expected to decrease", figures.drift(shown, shown.cases[1]).title)
        self.assertNotIn("expected to decrease", figures.drift(shown, shown.cases[0]).title)

    def test_same_bytes_again(self):
        paths = [self.folder / "report.html", *sorted((self.folder / "figures").iterdir())]
        before = [p.read_bytes() for p in paths]
        done = subprocess.run([sys.executable, SCRIPTS / "report.py", self.folder], capture_output=True,
                              env=os.environ | {"PYTHONHASHSEED": "7"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, b"")
        self.assertEqual(before, [p.read_bytes() for p in paths])


class Fresh(unittest.TestCase):
    """An empty directory for each test."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def edit(self, name, column, change, only=lambda row: True):
        rows = load(self.folder / name)
        k = rows[0].index(column)
        for row in rows[1:]:
            if only(row):
                row[k] = change(row[k])
        save(self.folder / name, rows)


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
        self.assertIn("Cheapest run in right-hand sides", page.text)

    def test_many_methods_fit_the_sheet(self):
        shown = reading.Experiment(synthetic(self.folder, extra_methods=9))
        for case in shown.cases:
            for drawing in figures.drawings(shown, case):
                for wide in (True, False):
                    with self.subTest(drawing.name, wide=wide):
                        self.check_layout(drawing.draw(wide))

    def check_layout(self, sheet):
        """Legend below every panel; nothing sticks out of the sheet; no two tick labels of an axis overlap."""
        sheet.png()
        figure, renderer = sheet.figure, sheet.figure.canvas.get_renderer()
        width, height = figure.bbox.size
        legend = figure.legends[0].get_window_extent(renderer)
        self.assertEqual(len(figure.legends[0].get_texts()), len(sheet.methods) + len(sheet.levels))
        boxes = [a.get_tightbbox(renderer) for a in figure.axes]
        self.assertLess(legend.y1, min(b.y0 for b in boxes))
        for box in [legend, *boxes, *(t.get_window_extent(renderer) for t in figure.texts)]:
            self.assertGreaterEqual(min(box.x0, box.y0), -0.5)
            self.assertLessEqual(box.x1, width + 0.5)
            self.assertLessEqual(box.y1, height + 0.5)
        for i, box in enumerate(boxes):
            self.assertFalse(any(box.overlaps(other) for other in boxes[:i]))
        for axes in figure.axes:
            for axis in (axes.xaxis, axes.yaxis):
                low, high = sorted(axis.get_view_interval())
                labels = [t.label1.get_window_extent(renderer) for t in axis.get_major_ticks()
                          if low <= t.get_loc() <= high]
                for i, box in enumerate(labels):
                    self.assertFalse(any(box.overlaps(other) for other in labels[:i]))

    def test_failed_at_the_common_step_is_marked(self):
        shown = reading.Experiment(synthetic(self.folder, steps=(0.4,)))
        sheet = figures.drift(shown, shown.cases[0]).draw(True)
        self.assertIn("run ended early", sheet.levels)
        self.assertIn("bad at step 0.4 s (non_finite)", figures.work_precision(shown, shown.cases[0]).caption)

    def test_zero_and_infinite(self):
        synthetic(self.folder)
        self.edit("results.csv", "error_max", lambda x: "0", lambda row: row[2] == "mid")
        self.edit("results.csv", "structure_residual", lambda x: "inf", lambda row: row[2] == "bad")
        shown = reading.Experiment(self.folder)
        self.assertIn("zeros", figures.work_precision(shown, shown.cases[0]).caption)
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
        self.assertIn("not every method counts right-hand sides", self.fine().text)

    def test_quad_difference_keeps_its_digits(self):
        path = self.folder / "series.csv"
        save(path, [["t [s]", "H [J]"], ["0", "1.333333333333333333333333333333333331"],
                    ["1", "1.333333333333333333333333333333333335"]])
        self.assertEqual(reading.read_series(path, "H", "quad").change, [0, 4e-36])
        self.assertEqual(reading.read_series(path, "H", "double").change, [0, 0])  # control: double cannot see it

    def test_zero_has_a_line_of_its_own(self):
        axis = scales.ErrorAxis([[0.0, 1e-12, math.nan], [1e-3, 1e9]], U)
        zero, small, gap = axis.place([0.0, 1e-12, math.nan])
        self.assertTrue(0 < zero < U and small == 1e-12 and math.isnan(gap))
        self.assertLess(10.0**axis.high, 1e9)  # what exploded leaves the frame
        self.assertEqual(len(axis.remarks()), 2)
        self.assertEqual(scales.ErrorAxis([[1e-12]], U).remarks(), [])

    def test_envelope_keeps_the_largest(self):
        times = [0.01 * k for k in range(5001)]
        values = [abs(math.sin(7 * t)) * (3 if k == 1234 else 1) for k, t in enumerate(times)]
        t, v = scales.envelope(times, values)
        self.assertLessEqual(len(t), 80)
        self.assertIn((times[1234], values[1234]), list(zip(t, v)))
        self.assertEqual(t, sorted(t))

    def test_largest_rise(self):
        series = reading.Series([0, 1, 2, 3, 4], "s", 5, [0, -2, -1, -4, -3.5], "J", [])
        self.assertEqual(series.rises(), [0, 0, 1, 1, 1])


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
        for column in (*reading.RUN_COLUMNS, "energy:slope", "energy:max"):
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
        for change, words in ((lambda h: h.pop("cases"), "'cases'"), (lambda h: h.update(schema=2), "schema"),
                              (lambda h: h["methods"].append(h["methods"][0]), "appears 2 times"),
                              (lambda h: h.pop("citation"), "citation"),
                              (lambda h: h["cases"][0].update(precision="half"), "half"),
                              (lambda h: h["cases"][0].update(parameters=[1]), "'parameters' to be an object"),
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
