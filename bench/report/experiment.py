"""An experiment as the runner left it: experiment.json, the tables that it names, with their columns, and the series of its runs.

Everything that is read is checked here, so that figures and page can trust it.

A run's drift numbers are those of I(t) - I(0) in the unit of the invariant I; slopes are per unit of time.
`precision` double has unit round-off u = 2^-53, quad u = 2^-113.
"""
import collections
import dataclasses
import math
import pathlib

import drift_classes
from files import InputError, allow, parse, read_json, read_table, require
from series import read_series

UNIT_ROUND_OFF = {"double": 2.0**-53, "quad": 2.0**-113}
ROUND_OFF, ABOVE_ROUND_OFF = 1000, 1e5  # units up to which a residual is round-off, and above which an error owes nothing to it
SCHEMA = 2

# Of a quantity that is expected to move in one direction: the verb for that, and its moves in the other direction.
DIRECTIONS = {"decreasing": ("decrease", "rise"), "increasing": ("increase", "fall")}


def step_key(step):
    """Steps that agree to 12 digits are the same step."""
    return f"{step:.12g}"


@dataclasses.dataclass
class Cost:
    ns: float  # per step, the median
    low: float
    high: float


@dataclasses.dataclass
class Run:
    cells: dict
    where: str  # "results.csv, line 7"
    folder: str = "runs"  # that of its directory
    cost: Cost | None = None

    @property
    def path(self):
        """Its directory, from that of the experiment."""
        return f"{self.folder}/{self.slug}"

    def __post_init__(self):
        self.case, self.method, self.slug = (self.cells[k] for k in ("case", "method", "run"))
        self.status, self.message = self.cells["status"], self.cells["message"]
        self.failed = self.status != "converged"
        self.step, self.steps = self.number("step"), self.number("steps")
        self.seed = int(self.cells.get("seed") or 0)  # of an ensemble, from 1; otherwise 0
        self.tolerance = self.cells.get("tolerance") or ""
        if self.tolerance:  # the method chose its steps: the mean one stands for them
            self.step = abs(self.number("time")) / max(1.0, self.steps)
        if not (self.step > 0 and math.isfinite(self.step)):
            raise InputError(f"{self.where}, column step: expected a positive number, got '{self.cells['step']}'")

    def number(self, column):
        """The cell as a float; an empty cell or an absent column is nan."""
        return parse(self.cells.get(column, ""), f"{self.where}, column {column}")

    def drift(self, invariant, measure):
        return self.number(f"{invariant}:{measure}")

    def drift_class(self, invariant):
        return self.cells.get(f"{invariant}:class", "")

    @property
    def size(self):
        """What was asked for, as cost.csv names it: a step or a tolerance."""
        return f"~{self.tolerance}" if self.tolerance else step_key(self.step)

    @property
    def total_rhs(self):
        return self.number("rhs_per_step") * self.steps


class Experiment:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise InputError(f"{folder}: expected the directory of an experiment")
        self.head = read_json(self.folder / "experiment.json")
        require(self.head, "experiment.json", name=str, title=str, cases=list, methods=list, drift_classes=list)
        allow(self.head, "experiment.json", description=str, reference=list, citation=list, notes=list, versions=dict)
        if self.head.get("schema") != SCHEMA:
            raise InputError(f"experiment.json: expected \"schema\": {SCHEMA}, got {self.head.get('schema')!r}")
        if self.head.get("reference") and "citation" not in self.head:
            raise InputError("experiment.json: 'reference' names sources, but the list 'citation' is missing")
        self.drift_classes = drift_classes.read(self.head["drift_classes"])
        self.cases, self.methods = self.head["cases"], self.head["methods"]
        for i, case in enumerate(self.cases):
            require(case, f"experiment.json, case {i + 1}", name=str, precision=str)
            allow(case, f"experiment.json, case {case['name']}", title=str, parameters=dict, time_unit=str,
                  conserved=str, error=str, structure=str, model=str, motion=list, equation=str, question=str, answer=str, error_rows=int)
            if len(case.get("motion") or []) not in (0, 2):
                raise InputError(f"experiment.json, case {case['name']}: expected 'motion' to name two coordinates")
            if case["precision"] not in UNIT_ROUND_OFF:
                raise InputError(f"experiment.json, case {case['name']}: expected precision double or quad, "
                                 f"got '{case['precision']}'")
        for i, method in enumerate(self.methods):
            require(method, f"experiment.json, method {i + 1}", label=str)
            allow(method, f"experiment.json, method {method['label']}", parameters=dict, systems=list, family=str, another_motion=bool)
            for claimed in method.get("systems") or []:
                require(claimed, f"experiment.json, method {method['label']}, systems", name=str, preserves=list)
                if type(claimed.get("order")) is not int:
                    raise InputError(f"experiment.json, method {method['label']}, system {claimed['name']}: expected "
                                     "'order' to be an integer")
        self.labels = [m["label"] for m in self.methods]
        for kind, names in (("case", [c["name"] for c in self.cases]), ("method", self.labels)):
            for name, n in collections.Counter(names).items():
                if n > 1:
                    raise InputError(f"experiment.json: {kind} '{name}' appears {n} times, expected once")
        self._read_description()
        self.runs = self._read_runs()
        self.timed = self._read_costs()
        self.machine = self._read_machine()
        self.equal = self._read_equal()
        self.spreads, self.claims = self._rows("ensembles.csv"), self._rows("findings.csv")
        self._series, self._summaries = {}, {}

    def _read_description(self):
        """What experiment.json says of tables, {file: table}, those of measures among them, {name: table}, and of quantities."""
        require(self.head, "experiment.json", tables=list)
        allow(self.head, "experiment.json", quantities=list, fields=list)
        for i, table in enumerate(self.head["tables"]):
            where = f"experiment.json, table {i + 1}"
            require(table, where, file=str, columns=list)
            if "measure" in table:
                require(table, where, name=str, title=str, view=str, keys=list)
            allow(table, where, description=str)
            for k, column in enumerate(table["columns"]):
                require(column, f"{where}, column {k + 1}", name=str, kind=str)
        self.tables = {table["file"]: table for table in self.head["tables"]}
        self.measures = {table["name"]: table for table in self.head["tables"] if "measure" in table}
        quantities, fields = self.head.get("quantities") or [], self.head.get("fields") or []
        for kind, rows in (("quantity", quantities), ("field", fields)):
            for i, row in enumerate(rows):
                require(row, f"experiment.json, {kind} {i + 1}", name=str)
        self.invariants = list(dict.fromkeys(q["name"] for q in quantities))
        self.residuals = [q["name"] for q in quantities if q.get("residual")]
        self.fields = fields

    def _read_runs(self):
        rows = self._rows("results.csv", needed=True)
        runs, known = [], {c["name"] for c in self.cases}
        for where, cells in rows:
            run = Run(cells, where)
            if run.case not in known:
                raise InputError(f"{where}: case '{run.case}' is not in experiment.json")
            if run.method not in self.labels:
                raise InputError(f"{where}: method '{run.method}' is not in experiment.json")
            for name in self.invariants:
                drift_classes.check(run.drift_class(name), self.drift_classes, f"{where}, column {name}:class")
            runs.append(run)
        if not runs:
            raise InputError("results.csv: expected at least one run, found none")
        runs.sort(key=lambda r: (self.labels.index(r.method), -r.step) if not r.tolerance else
                  (self.labels.index(r.method), -float(r.tolerance)))
        for case in self.cases:
            name = case.get("conserved")
            if name and name not in self.invariants:
                raise InputError(f"experiment.json: quantity '{name}' is missing, the conserved one of case {case['name']}")
            if case.get("error") and "relative_drift_max" not in rows[0][1]:
                raise InputError(f"results.csv: column 'relative_drift_max' is missing (the error of case {case['name']})")
        return runs

    def _read_costs(self):
        """Attach timings to runs; False where there is none at all."""
        costs = {}
        for where, cells in self._rows("cost.csv"):
            step, ns, low, high = (parse(cells[k], f"{where}, column {k}")
                                   for k in ("step", "ns_per_step", "ns_per_step_min", "ns_per_step_max"))
            if ns > 0:
                size = f"~{cells['tolerance']}" if cells.get("tolerance") else step_key(step)
                costs[cells["case"], cells["method"], size] = Cost(ns, low, high)
        for run in self.runs:
            run.cost = costs.get((run.case, run.method, run.size))
        return any(run.cost for run in self.runs)

    def _read_machine(self):
        """What machine.json says of the machine that measured the timings; empty where nothing was timed."""
        path = self.folder / "machine.json"
        found = read_json(path) if path.exists() else {}
        allow(found, "machine.json", cpu=str, system=str, host=str, date=str, load=list)
        return found

    def _read_equal(self):
        """{case: (level in ns, {method: run at that cost})} of the runs that were made at equal cost."""
        equal = {}
        for where, cells in self._rows("equal_cost.csv"):
            level, run = parse(cells["level_ns"], f"{where}, column level_ns"), Run(cells, where, "equal-cost")
            if not level > 0 or equal.setdefault(run.case, (level, {}))[0] != level:
                raise InputError(f"{where}, column level_ns: expected one positive number for a case")
            for name in self.invariants:
                drift_classes.check(run.drift_class(name), self.drift_classes, f"{where}, column {name}:class")
            equal[run.case][1][run.method] = run
        return equal

    def _rows(self, file, needed=False):
        """[(where, cells)] of a table of experiment.json with the columns that it names; nothing where it is not there, as with
        most experiments some."""
        path = self.folder / file
        if not needed and (file not in self.tables or not path.exists()):
            return []
        if file not in self.tables:
            raise InputError(f"experiment.json: table '{file}' is missing")
        return read_table(path, [column["name"] for column in self.tables[file]["columns"]])[1]

    def table(self, name, case):
        """[(where, cells)] of the rows of a case in the table that a measure left, with numbers where its columns have them; nothing
        where it was not asked for or says nothing of a run. Times are those since the start, also of runs that go back."""
        if name not in self.measures:
            return []
        numbers, rows = [c["name"] for c in self.measures[name]["columns"] if c["kind"] == "number"], []
        for where, cells in self._rows(self.measures[name]["file"]):
            if cells["case"] == case["name"]:
                rows.append((where, cells | {k: parse(cells[k], f"{where}, column {k}") for k in numbers}))
                rows[-1][1]["t"] = abs(rows[-1][1]["t"])
        return rows

    def spreads_of(self, case, measure):
        """[(method, size, median, low, high, finished, runs)] over the seeds of an ensemble, in order."""
        out = []
        for where, cells in self.spreads:
            if cells["case"] == case["name"] and cells["measure"] == measure:
                numbers = [parse(cells[k], f"{where}, column {k}")
                           for k in ("median", "low", "high", "finished", "runs")]
                size = f"~{cells['tolerance']}" if cells["tolerance"] else cells["step"]
                out.append((cells["method"], size, *numbers))
        return out

    def ensemble_of(self, run):
        """The runs that are the same but for the seed, the run itself among them."""
        return [r for r in self.runs if (r.case, r.method, r.size) == (run.case, run.method, run.size)
                and (run.seed == 0) == (r.seed == 0)] if run.seed else [run]

    @staticmethod
    def declared_order(method, case):
        """The order that the method claims on the case's system; None where it claims nothing of it."""
        return next((s["order"] for s in method.get("systems") or [] if s["name"] == case.get("system")), None)

    def runs_of(self, case):
        """The runs of a case; of an ensemble, those of its first seed."""
        return [r for r in self.runs if r.case == case["name"] and r.seed <= 1]

    def common_step(self, case):
        """The step at which most methods finished. Of several such steps the largest, as methods differ most there."""
        runs = self.runs_of(case)
        runs = [r for r in runs if not r.tolerance] or runs
        counts = collections.Counter(step_key(r.step) for r in runs if not r.failed)
        return max({r.step for r in runs}, key=lambda h: (counts[step_key(h)], h), default=math.nan)

    def at_common_step(self, case):
        """One run of each method: at the common step, or at the nearest step the method has."""
        target, chosen = self.common_step(case), {}
        for run in self.runs_of(case):
            best = chosen.get(run.method)
            if best is None or abs(math.log(run.step / target)) < abs(math.log(best.step / target)):
                chosen[run.method] = run
        return list(chosen.values())

    def series(self, run, invariant):
        """The run's series with one invariant (or None), or None where it left none, or of residuals of constraints where its
        motion has no constraints, as vakonomic motion among others."""
        key = (run.path, invariant)
        if key not in self._series:
            path = self.folder / run.path / "series.csv"
            self._series[key] = (read_series(path, invariant, run.cells["precision"], invariant in self.residuals)
                                 if run.slug and path.exists() else None)
        return self._series[key]

    def entries(self, case, invariant):
        """What the summaries of the runs of a case state of an invariant, one after another."""
        yield from filter(None, (self.entry(run, invariant) for run in self.runs_of(case)))

    def entry(self, run, invariant):
        """What the summary of a run states of an invariant; nothing where it does not."""
        path = self.folder / run.path / "summary.json"
        if run.path not in self._summaries:
            self._summaries[run.path] = invariants_of(path) if run.slug and path.exists() else []
        return next((entry for entry in self._summaries[run.path] if entry.get("name") == invariant), {})

    def expectation(self, case, invariant):
        """(expected, unit) of an invariant as the runs' summaries state them; conserved where none does."""
        entry = next(self.entries(case, invariant), {"expected": "conserved"})
        return entry.get("expected") or "none", entry.get("unit") or ""

    def scale(self, case, invariant):
        """What a change of an invariant is compared with: the size of its terms, the least over the runs as one that explodes has
        any, or else its size at the start; one where that is zero."""
        known = [[x for entry in self.entries(case, invariant) if (x := abs(float(entry.get(key) or 0))) > 0]  # quads are text
                 for key in ("scale", "initial")]
        return next((min(sizes) for sizes in known if sizes), 1.0)


def invariants_of(path):
    summary, where = read_json(path), "/".join(path.parts[-3:])
    allow(summary, where, invariants=list)
    for i, entry in enumerate(summary.get("invariants") or []):
        require(entry, f"{where}, invariant {i + 1}", name=str)
    return summary.get("invariants") or []
