"""A small synthetic experiment with known drift, structure and cost, and what tests of bench/report share."""
import contextlib
import csv
import html.parser
import io
import json
import math
import pathlib
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "bench" / "report"
sys.path.insert(0, str(SCRIPTS))

import experiment as reading  # noqa: E402
import figures  # noqa: E402, F401  (for the tests)
import report  # noqa: E402
import scales  # noqa: E402, F401

COLUMNS = ("case,system,method,integrator,parameters,step,time,steps,precision,status,message,error_max,error_final,"
           "structure_residual,rhs_per_step,jacobians_per_step,iterations_per_step,factorisations_per_step").split(",")
U = 2.0**-53
FIELDS = ("max", "rms", "final", "slope", "slope_low", "slope_high", "oscillation", "exponent", "class")
OF_RESIDUALS = ("growth", "growth_rate")
CLAIM_COLUMNS = "case,measure,method,relation,factor,than,bound,step,runs,holding,needed,holds,ratio_median".split(",")
# Classes of drift of a program that nobody has written: the report knows those that experiment.json lists, no others.
CLASSES = [{"name": "still", "meaning": "does not move & never will", "measure": "", "grows": False, "keeps": True},
           {"name": "near", "meaning": "stays near", "measure": "max", "grows": False, "keeps": True},
           {"name": "drifting", "meaning": "drifts along", "measure": "slope", "grows": True, "keeps": False},
           {"name": "spread-out", "meaning": "spreads out", "measure": "exponent", "grows": True, "keeps": False},
           {"name": "unused", "meaning": "is in no run", "measure": "max", "grows": False, "keeps": False}]


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
    measures = [f"{i}:{m}" for i in ("energy", "momentum") for m in FIELDS]
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
                    "energy:class": "near" if label == "mid" else "drifting",
                    "momentum:max": 0, "momentum:class": "still"})
                rows.append(row)
                if not fails:
                    costs.append([case["name"], label, h, 100 if label == "mid" else 50, 40, 120, 5, 0.1])
                write_run(folder / "runs" / slug, case, label, h, size, 12 if fails else 40)
    head = {"schema": reading.SCHEMA, "name": "synthetic", "title": "A & B <script>", "description": "Made up.", "quick": False,
            "drift_classes": CLASSES, "reference": ["su-qin"], "citation": ["Su and Qin, 2004."], "cases": cases, "notes": ["A note."],
            "versions": {"pfaff": "0.1", "compiler": "GCC 12", "flags": "-O3", "eigen": "3.4", "boost": "1.74"},
            "methods": [{"label": m, "integrator": m, "parameters": {}, "systems": [
                {"name": "oscillator", "order": 2 if m == "mid" else 4,
                 "preserves": ["symmetric", "symplectic"] if m == "mid" else ["none"]},
                {"name": "damped", "order": 3 if m == "mid" else 4,
                 "preserves": ["symmetric"] if m == "mid" else ["none"]}]} for m in labels]}
    save(folder / "results.csv", [list(rows[0])] + [list(r.values()) for r in rows])
    save(folder / "cost.csv", ["case,method,step,ns_per_step,ns_per_step_min,ns_per_step_max,repetitions,seconds".split(","), *costs])
    describe(folder, head)
    return folder


def describe(folder, head=None):
    """Writes experiment.json, with the tables that stand in the folder and the quantities of results.csv."""
    path = pathlib.Path(folder) / "experiment.json"
    head = head or json.loads(path.read_text())
    of_measures = [table for table in head.get("tables", []) if "measure" in table]
    tables = {csv_file.name: load(csv_file)[0] for csv_file in sorted(path.parent.glob("*.csv"))}
    head["tables"] = of_measures + [{"file": name, "columns": columns_of(columns)} for name, columns in tables.items()]
    results = tables["results.csv"]
    head["quantities"] = [{"name": c[:-4], "residual": f"{c[:-4]}:growth" in results} for c in results if c.endswith(":max")]
    head["fields"] = [{"name": name, "meaning": f"the {name}"} for name in FIELDS + OF_RESIDUALS]
    path.write_text(json.dumps(head))


def columns_of(names, texts=()):
    return [{"name": name, "kind": "text" if name in texts else "number"} for name in names]


def write_run(folder, case, label, h, size, end):
    folder.mkdir(parents=True)
    damped = case["name"] == "damped"
    rows = [["t [s]", "q [m]", "energy [J]", "momentum [N s]", "error", "structure_residual"]]
    for k in range(int(end / h) + 1):
        energy = math.exp(-0.1 * k * h) if damped else 1 + (0 if label == "mid" else size * k * h / 40)
        rows.append([repr(k * h), 0, repr(energy), 0, "", size if k % 3 == 0 else ""])
    save(folder / "series.csv", rows)
    (folder / "summary.json").write_text(json.dumps({"schema": 1, "invariants": [
        {"name": "energy", "unit": "J", "expected": "decreasing" if damped else "conserved"},
        {"name": "momentum", "unit": "N s", "expected": "conserved"}]}))


def save(path, rows):
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows(rows)


def measured(folder, name, rows, texts=(), over="time"):
    """Adds a measure to the experiment: the table that it left, whose first row is its head. `texts` are columns of text."""
    path = pathlib.Path(folder) / "experiment.json"
    head = json.loads(path.read_text())
    head.setdefault("tables", []).append({
        "name": name, "measure": name, "title": name, "view": over, "keys": list(rows[0][:4]), "file": f"measures/{name}.csv",
        "columns": columns_of(rows[0], ("case", "method", *texts))})
    path.write_text(json.dumps(head))
    (path.parent / "measures").mkdir(exist_ok=True)
    save(path.parent / "measures" / f"{name}.csv", rows)


def load(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


def run(folder):
    """(exit status, stderr) of report.py in this process."""
    return ended(report, folder)[::2]


def ended(script, *arguments):
    """(exit status, what it says that it made or None, stderr) of a script in this process."""
    with contextlib.redirect_stderr(io.StringIO()) as stderr, contextlib.redirect_stdout(io.StringIO()) as stdout:
        status = script.main([str(a) for a in arguments])
    return status, json.loads(stdout.getvalue()) if stdout.getvalue() else None, stderr.getvalue()


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
        if self.open[-1:] not in (["style"], ["script"]):
            self.words.append(data)


def parsed(folder):
    parser = Balance()
    parser.feed((folder / "report.html").read_text(encoding="utf-8"))
    parser.text = " ".join(" ".join(parser.words).split())
    return parser


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
