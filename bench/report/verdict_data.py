"""The verdict on a case as data, a row for each method: what verdict.csv and report.json hold, and the index of experiments.

structure   kept, not kept or not known; its largest residual, and the power of the step that residuals fall with
at level    the run at equal cost or nearest to it: its step, drift, class of drift, whether the quantity drifts away, how the run makes
            another motion (astray.py), and error
cost_to_    what an error costs, in nanoseconds where `work` is time; `bounds` names the errors of which it is a bound alone
ratio       the cost of the target, which is the error that the sentence speaks of, over that of the cheapest method
Cells of which nothing is known are empty in CSV and null in JSON.
"""
import math

from curves import ZERO
from verdict import TARGETS

KNOWN = {True: "yes", False: "no", None: "not known"}


def number(x):
    return None if x is None or math.isnan(x) else x


def rows(verdict):
    best = verdict.best(verdict.target) if verdict.target else []
    return [row_of(verdict, row, best) for row in verdict.rows]


def row_of(verdict, row, best):
    curve, order, target = row.curve, row.curve.order(), verdict.target
    ranked = bool(target) and row in verdict.rivals and row.ranked(target) and bool(best)
    cells = {"case": verdict.case["name"], "method": row.label, "family": curve.family.key,
             "structure_kept": KNOWN[curve.kept] if verdict.structured else "",
             "structure_residual": max((x for _, x in curve.residuals), default=None),
             "structure_power": number(curve.residual_power()),
             "work": verdict.work, "level": number(verdict.level), "cost": number(row.cost),
             "step": row.run.step if row.run else None, "quantity": verdict.invariant,
             "drift_class": row.drift_class, "drift": number(row.drift),
             "drifts": KNOWN[row.drifts] if verdict.invariant else "", "astray": row.astray,
             "error": 0.0 if row.error == ZERO * verdict.unit else number(row.error)}
    cells |= {f"cost_to_{t:.0e}": number(row.times[t][0]) for t in TARGETS}
    return cells | {"bounds": " ".join(f"{t:.0e}" for t in TARGETS if row.times[t][1]), "target": target,
                    "ratio": row.times[target][0] / best[0].times[target][0] if ranked else None,
                    "cheapest": "yes" if row in best else "", "order_claimed": curve.claimed,
                    "order_measured": order.value if order else None, "order_interval": number(order.interval) if order else None,
                    "failed": curve.failed, "runs": curve.total}
