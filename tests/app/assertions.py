"""Evaluates what the sentences of a report assert (bench/report/assertion.py) on its CSV files, without the report's code."""
import itertools
import json
import math
import pathlib
import statistics as st

from experiment_files import Files, number

POWERS = {"as a random walk": [0.5], "in proportion to time": [1.0], "not at all": [0], "with another power": []}


class Judge(Files):
    def cost_to(self, a, label):
        """(cost, slowest cost) of the target between the runs on both sides of it; None where there are none."""
        points = [p for p in self.curve(a, label) if p[1] > 0 and 0 < p[0] < math.inf]
        pairs = [(p, q) for p, q in zip(points, points[1:]) if p[0] > a["target"] * (1 + 1e-8) >= q[0]]
        part = [math.log(p[0] / a["target"]) / math.log(p[0] / q[0]) for p, q in pairs]
        found = sorted((*(p[k] ** (1 - x) * q[k] ** x for k in (1, 2)), p[0]) for (p, q), x in zip(pairs, part))
        lost = found and a["columns"][0] == "error_max" and found[0][2] >= 0.5
        return None if not found or lost or points[0][0] <= a["target"] else found[0][:2]

    def value(self, a, label):
        """Whether the relation holds of a method: True, False or None."""
        rows, unit = [self.rows[w] for w in a["rows"][label]], self.cases[a["case"]]["unit"]
        if a["relation"] == "drifts":
            votes = [2 * sum(self.classes[r[a["columns"][0]]][key] for r in rows) > len(rows) for key in ("grows", "keeps")]
            return True if votes[0] else False if votes[1] else None
        if a["relation"] == "moves-against":
            runs = [[x[0] * (1 if a["expected"] == "decreasing" else -1) for x in self.series(w, a["columns"]).values()]
                    for w in a["rows"][label]]
            moves = [max(x - y for x, y in zip(v, itertools.accumulate(v, min))) / max(1, abs(v[0])) for v in runs]
            return None if any(map(math.isnan, moves)) else st.median(moves) > 1e3 * unit
        claims = [self.cases[a["case"]]["structure"] in s["preserves"] for m in self.head["methods"] if m["label"] == label
                  for s in m["systems"] if s["name"] == self.cases[a["case"]]["system"]]
        seen = [(number(r["time"]) / (n := number(r["steps"])), number(r["structure_residual"]),
                 number(r.get(a["columns"][1])) / n) for r in rows if r["structure_residual"]]
        if any(claims) or not seen or max(s[1] for s in seen) > 1e5 * unit:
            return max(s[1] for s in seen) <= 1e5 * unit if seen else any(claims) and bool(rows) or None
        return False if max(seen)[1] > 1e3 * unit else True if max(seen)[2] > (1e3 * unit) ** 0.5 else None

    def astray(self, a, label):
        """Whether no run has a small error, and where the quantity is said to be lost, half of its range is."""
        runs = [self.rows[w] for w in a["rows"][label]]
        spans = [next(i.get("range") for i in self.summary(r)["invariants"] if f"{i['name']}:class" == a["columns"][0]) for r in runs]
        far = [number(r[a["columns"][0].replace(":class", ":max")]) >= float(x or "inf") / 2 for r, x in zip(runs, spans)]
        return not any(number(r["error_max"]) < 0.5 for r in runs) and (a["astray"][label] == "escaped" or 2 * sum(far) > len(far))

    def at_level(self, a):
        """Whether the runs cost what the words say, where they say that they cost the same."""
        runs = [(m, self.rows[a["rows"][m][0]]) for m in a["subject"] + a["not"] if m not in a.get("own", [])] if a.get("level") else []
        costs = [number(r["level_ns"]) if "level_ns" in r else
                 {p[3]: p[1] for p in self.curve(a | {"columns": ["steps"]}, m)}[self.size(r)] for m, r in runs]
        return all(1 / 1.26 < c / a["level"] < 1.26 for c in costs)

    def power(self, some):
        """The power of time with which the root mean square of errors grows, in the second half of the decades shown."""
        times = sorted(t for t in set.intersection(*map(set, some)) if t > 0)
        points = [(math.log(t), 0.5 * math.log(x)) for t in times if t * t >= times[0] * times[-1] and
                  (x := st.mean((m[t][0] - m[0.0][0]) ** 2 for m in some)) > 0]
        return st.linear_regression(*zip(*points)).slope

    def powers(self, a, method):
        """That power, and the mean of the powers of the drifts of the runs."""
        drifts = [number(self.rows[w][f"{a['columns'][0]}:exponent"]) for w in a["rows"][method]]
        return st.mean(drifts), self.power([self.series(w, a["columns"]) for w in a["rows"][method]])

    def apart(self, a, one, other):
        """The largest distance of two runs at the times that both have, over the largest size of the first."""
        x, y = (self.series(w, a["columns"]) for w in (one, other))
        return max(math.dist(x[t], y[t]) for t in x if t in y) / max(math.hypot(*x[t]) for t in x if t in y)

    def holds(self, a):
        relation, said = a["relation"], a["subject"]
        if relation in ("cheapest", "costs-times", "no-dearer"):
            rivals = [m["label"] for m in self.head["methods"] if not m.get("another_motion")]
            costs = {m: c for m in rivals if (c := self.cost_to(a, m))}
            ends = [costs[m] for m in (a["than"], *said)] if "than" in a else [min(costs.values())] * 2
            times = [ends[1][0] / max(ends[0]), max(ends[1]) / ends[0][0]]
            best = {m for m, c in costs.items() if c[0] <= max(1.1 * ends[0][0], ends[0][1])}
            numbers = [(costs[m][0], x) for m, x in a["costs"].items()] + list(zip(times, a.get("times", [])))
            if relation == "no-dearer":
                return set(said) == {m for m in rivals if m not in costs for p in self.curve(a, m)
                                     if p[0] <= a["target"] * (1 + 1e-8) and p[1] <= ends[0][0]}
            return (all(math.isclose(x, y, rel_tol=1e-3) for x, y in numbers)
                    and ("than" in a or (best == set(said) and set(costs) == set(a["rows"]))))
        if relation in ("keeps", "drifts", "moves-against"):
            groups = ((True, said), (False, a["not"]), (None, a["unknown"]))
            return (self.at_level(a) and all(self.astray(a, m) for m in a.get("astray", {}))
                    and all(self.value(a, m) is x for x, of in groups for m in of))
        if relation == "grows-as":
            return all(any(math.isclose(p, q, abs_tol=1e-6) for q in self.powers(a, m)) and
                       ([x for x in (0, 0.5, 1.0) if abs(x - p) <= max(half, 0.05)] == POWERS[words] and half <= 0.25 if words else True)
                       for words, of in a["groups"].items() for m in of for p, half in [a["powers"][m]])
        if relation == "constraints":
            spans = {m: (min(v), max(v)) for m in a["rows"] for v in [[number(self.rows[w][a["columns"][0]]) for w in a["rows"][m]]]}
            return all((spans[m][1] <= 1e3 * self.cases[a["case"]]["unit"]) == (m in said) for m in spans) and all(
                spans[low][0] <= spans[m][1] * 1.1 for low in a["least"] for m in a["off"]) and all(
                spans[m][0] <= spans[high][1] * 1.1 for high in a["most"] for m in a["off"])
        if relation in ("agree", "differ"):
            far = [self.apart(a, v, w) for one, other in itertools.combinations(a["methods"], 2) for m in one for n in other
                   for v in a["rows"][m] for w in a["rows"][n] if self.rows[v].get("seed") == self.rows[w].get("seed")]
            return max(far) <= 1e-3 if relation == "agree" else min(far) >= 1e-2
        at = {r["method"]: abs(number(r["error"])) for r in self.turns.values() if (r["case"], r["vector"]) == (a["case"], a["vector"])
              and float(r["step"]) == a["step"] and r["method"] in a["among"]}
        return all(at[m] <= 1.1 * min(at.values()) for m in said) and all(1.1 * at[m] >= max(at.values()) for m in a["worst"])


def faults(folder):
    """A line for each assertion of the report that its files do not bear out."""
    judge, report = Judge(folder), json.loads((pathlib.Path(folder) / "report.json").read_text(encoding="utf-8"))
    return [f"{case['case']}: {a['words']}" for case in report["cases"] for a in case["assertions"] if not judge.holds(a)]
