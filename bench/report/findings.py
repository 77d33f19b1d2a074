"""What an experiment shows, in sentences computed from its data: structure, drift, observed order, cost, failures.

Thresholds, all stated in the text they produce:
- a structure residual is at round-off up to ROUND_OFF u, u the unit round-off of the run's precision;
- the order of a method is the slope of log error over log step between its two smallest steps whose error is above
  ABOVE_ROUND_OFF u, and so free of round-off;
- "cheapest at error e" compares runs that were made, without interpolation.
"""
import math

import constraints
import ensembles
from experiment import DIRECTIONS, UNIT_ROUND_OFF
from error_measure import error_measure
from figures import step_text, with_unit
from wording import duration, listed, number

ROUND_OFF = 1000
ABOVE_ROUND_OFF = 1e5
ORDER_TOLERANCE = 0.3


def slope_unit(unit, time_unit):
    unit = "" if unit == "1" else unit
    return f"{unit or 1}/{time_unit}" if time_unit else unit


def grouped(*groups):
    """["word: names"] of the groups (word, names) that are not empty."""
    return [f"{word}: {listed(names)}" for word, names in groups if names]


def findings(experiment, case):
    """[(subject, sentence, [items])] of one case."""
    makers = (structure, drift, order, cost) if not case.get("seeds") else ()
    makers += (constraints.claims, ensembles.findings, constraints.growth, failures)
    return [found for maker in makers for found in maker(experiment, case)]


def slope(points):
    """Slope of log y over log x between two points."""
    (x1, y1), (x2, y2) = points
    return math.log(y1 / y2) / math.log(x1 / x2)


def limit(case):
    return ROUND_OFF * UNIT_ROUND_OFF[case["precision"]]


def structure(experiment, case):
    keep, lose, kind = [], [], case.get("structure") or "symplectic"
    for method in experiment.labels:
        residuals = [(r.step, r.number("structure_residual")) for r in experiment.runs_of(case)
                     if r.method == method and not r.failed]
        residuals = [p for p in residuals if not math.isnan(p[1])]
        above = [p for p in residuals if p[1] > limit(case)]
        if residuals and not above:
            keep.append(method)
        elif above:
            falls = len(above) > 1 and above[-1][0] != above[-2][0] and math.isfinite(above[-2][1] + above[-1][1])
            rate = f", falling as h^{slope(above[-2:]):.1f}" if falls else ""
            lose.append(f"{method} (up to {number(max(p[1] for p in above))}{rate})")
    if not keep and not lose:
        return []
    text = (f"The {kind} structure is kept to round-off by {len(keep)} of {len(keep) + len(lose)} methods (residual at "
            f"most {ROUND_OFF} u = {number(limit(case))} at every step).")
    return [("Structure", text, grouped(("kept", keep), ("not kept", lose)))]


def drift(experiment, case):
    name = case.get("conserved")
    if not name:
        return []
    expected, unit = experiment.expectation(case, name)
    runs = [r for r in experiment.at_common_step(case) if not r.failed]
    at = "at " + step_text(experiment.common_step(case), case)
    if expected in DIRECTIONS:
        return setbacks(experiment, case, name, runs, at)
    rate = slope_unit(unit, case.get("time_unit") or "")
    items = []
    for kind in experiment.drift_classes.values():
        some = [sized(r, name, kind.measure, rate) for r in runs if r.drift_class(name) == kind.name]
        if some:
            items.append(f"{kind.name}: {listed(some)}")
    if not items:
        return []
    unclassified = [r.method for r in runs if not r.drift_class(name)]
    items += grouped(("without a class, because it was not measured", unclassified))
    subject = "Drift" if expected == "conserved" else "Change"
    return [(subject, f"{subject} of {with_unit(name, unit)} {at}, by class:", items)]


def sized(run, name, measure, rate):
    """The run's method, with the drift number that its class is sized by."""
    top = number(run.drift(name, "max"))
    if measure == "slope":
        return (f"{run.method} at {number(run.drift(name, 'slope'))} [{number(run.drift(name, 'slope_low'))}, "
                f"{number(run.drift(name, 'slope_high'))}] {rate}").rstrip()
    if measure == "exponent":
        return f"{run.method} (as t^{number(run.drift(name, 'exponent'))}, at most {top})"
    return run.method + (f" (at most {top})" if measure == "max" else "")


def largest_setback(experiment, run, name, expected):
    """The largest move of an invariant against its expected direction, over max(1, |I(0)|); nan without a series."""
    series = experiment.series(run, name)
    return series.setbacks(expected)[-1] / series.scale if series and series.time else math.nan


def setbacks(experiment, case, name, runs, at):
    """Findings on a quantity that is expected to move in one direction: who lets it move in the other."""
    expected = experiment.expectation(case, name)[0]
    direction, move = DIRECTIONS[expected]
    sizes = {r.method: largest_setback(experiment, r, name, expected) for r in runs}
    never = [m for m, x in sizes.items() if x <= limit(case)]
    does = [f"{m} (by {number(x)})" for m, x in sizes.items() if x > limit(case)]
    unknown = [m for m, x in sizes.items() if math.isnan(x)]
    text = (f"{name} is expected to {direction}, so its change is not an error. Whether it {move}s {at} by more than "
            f"{ROUND_OFF} u between any two samples:")
    items = grouped((f"never {move}s", never), (f"{move}s", does), ("not known, without a series", unknown))
    return [(direction.capitalize(), text, items)] if items else []


def order(experiment, case):
    agree, differ = [], []
    for method in experiment.methods:
        points = [(r.step, r.number("error_max")) for r in experiment.runs_of(case)
                  if r.method == method["label"] and not r.failed
                  and r.number("error_max") > ABOVE_ROUND_OFF * UNIT_ROUND_OFF[case["precision"]]][-2:]
        if len(points) < 2 or points[0][0] == points[1][0] or not math.isfinite(points[0][1] + points[1][1]):
            continue
        seen, declared = slope(points), experiment.declared_order(method, case)
        if declared is not None and abs(seen - declared) <= ORDER_TOLERANCE:
            agree.append(f"{method['label']} ({seen:.2f})")
        else:
            expected = "" if declared is None else f", declared {declared}"
            differ.append(f"{method['label']} ({seen:.2f}{expected})")
    text = "Order seen in the largest error between the two smallest steps above round-off:"
    items = grouped((f"within {ORDER_TOLERANCE} of the declared order", agree), ("other", differ))
    return [("Order", text, items)] if items else []


def cost(experiment, case):
    measure = error_measure(experiment, case)
    error = measure.of if measure else lambda run: math.nan
    runs = [r for r in experiment.runs_of(case) if not r.failed and math.isfinite(error(r))]
    methods = {r.method for r in runs}
    if len(methods) < 2:
        return []
    if all(r.cost for r in runs):
        work, show, kind = (lambda r: r.total_ns), duration, "processor time"
    elif all(r.total_rhs > 0 for r in runs):
        work, show, kind = (lambda r: r.total_rhs), number, "right-hand sides"
    else:
        return []
    items = []
    for target in targets(min(error(r) for r in runs if r.method == m) for m in methods):
        best = {}
        for r in runs:
            if error(r) <= target * (1 + 1e-8) and (r.method not in best or work(r) < work(best[r.method])):
                best[r.method] = r
        ranked = sorted(best.values(), key=work)
        first = ranked[0]
        next_best = [f"{r.method} ({work(r) / work(first):.2g}×)" for r in ranked[1:4]]
        then = f", then {listed(next_best)}" if next_best else ""
        items.append(f"{measure.noun} at most {number(target)}: {first.method} at {step_text(first.step, case)} "
                     f"({show(work(first))}){then}; {len(ranked)} of {len(methods)} methods reach it")
    return [("Cost", f"Cheapest run in {kind}:", items)] if items else []


def targets(best):
    """Powers of ten worth asking for: the smallest that three quarters of the methods reach, and that two reach."""
    reached = sorted(best)
    wanted = (reached[max(1, math.ceil(0.75 * len(reached)) - 1)], reached[1])
    return sorted({10.0 ** math.ceil(math.log10(x) - 1e-9) for x in wanted if x > 0}, reverse=True)


def failures(experiment, case):
    runs = [r for r in experiment.runs if r.case == case["name"]]
    failed = [f"{r.method} at {step_text(r.step, case)}: {r.status}{', ' + r.message if r.message else ''}"
              for r in runs if r.failed]
    return [("Failures", f"{len(failed)} of {len(runs)} runs failed:", failed)] if failed else []
