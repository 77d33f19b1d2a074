"""The CSV files of an experiment, as assertions.py reads them, without the report's code."""
import csv
import json
import math
import pathlib
import statistics as st


def number(cell):
    return float(cell or "nan")


class Files:
    def __init__(self, folder):
        self.folder, self.head = pathlib.Path(folder), json.loads((pathlib.Path(folder) / "experiment.json").read_text("utf-8"))
        self.cases = {c["name"]: c | {"unit": {"double": 2.0**-53, "quad": 2.0**-113}[c["precision"]]} for c in self.head["cases"]}
        self.classes = {c["name"]: c for c in self.head["drift_classes"]} | {"": {"grows": False, "keeps": False}}
        self.results, equal, cost, self.turns = map(self.read, ("results", "equal_cost", "cost", "measures/frequency"))
        self.rows, self.ns = self.results | equal, {(r["case"], r["method"], self.size(r)): r for r in cost.values()}

    def read(self, name):
        path = self.folder / f"{name}.csv"
        with open(path if path.exists() else "/dev/null", newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            return {f"{name}.csv, line {reader.line_num}": row for row in reader}

    def size(self, row):
        return float(row.get("tolerance") or row["step"])

    def summary(self, row):
        return json.loads((self.folder / ("equal-cost" if "level_ns" in row else "runs") / row["run"] / "summary.json").read_text("utf-8"))

    def series(self, where, columns):
        row = self.rows[where]
        with open(self.folder / ("equal-cost" if "level_ns" in row else "runs") / row["run"] / "series.csv", newline="") as file:
            head, *rows = csv.reader(file)
        at = [[c.rpartition(" [")[0] or c for c in head].index(c) for c in ["t", *columns]]
        return {float(r[at[0]]): [number(r[k]) for k in at[1:]] for r in rows}

    def curve(self, a, label):
        """[[error, cost, slowest cost, size]], from the coarsest: no coarser run costs more time than a finer one."""
        runs, out = {}, []
        for r in (r for r in self.results.values() if (r["case"], r["method"], r["status"]) == (a["case"], label, "converged")):
            runs.setdefault(self.size(r), []).append(r)
        for key, rows in sorted(runs.items()):
            timed = [number(self.ns.get((a["case"], label, key), {}).get(c)) for c in ("ns_per_step_min", "ns_per_step")]
            per = {"time": timed, "steps": (1, 1)}.get(a["work"], (number(rows[0]["rhs_per_step"]),) * 2)
            error = max(0.1 * self.cases[a["case"]]["unit"], st.median(number(r.get(a["columns"][0], "0")) for r in rows))
            out.append([error, *(x * number(rows[0]["steps"]) for x in per), key])
            if a["work"] == "time" and len(out) > 1 and out[-1][1] > out[-2][1]:
                out[-1][1:3] = [out[-2][1], max(out[-2][1], out[-1][2])]
        return out[::-1]
