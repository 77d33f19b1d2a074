"""What an experiment shows, in sentences computed from its data: structure, drift, observed order, failures.

Thresholds, all stated in the text they produce:
- a structure residual is at round-off up to ROUND_OFF u, u the unit round-off of the run's precision;
- the order of a method is the slope of log error over log step where refinement still gains (curves.py).
"""
import math

import constraints
import ensembles
from curves import curves
from experiment import DIRECTIONS, ROUND_OFF, UNIT_ROUND_OFF
from figures import step_text, with_unit
from wording import listed, number



def slope_unit(unit, time_unit):
    unit = "" if unit == "1" else unit
    return f"{unit or 1}/{time_unit}" if time_unit else unit


def grouped(*groups):
    """["word: names"] of the groups (word, names) that are not empty."""
    return [f"{word}: {listed(names)}" for word, names in groups if names]


def findings(experiment, case):
    """[(subject, sentence, [items])] of one case."""
    makers = (structure, drift, order) if not case.get("seeds") else ()
    makers += (constraints.claims, ensembles.findings, constraints.growth, failures)
    return [found for maker in makers for found in maker(experiment, case)]


def limit(case):
    return ROUND_OFF * UNIT_ROUND_OFF[case["precision"]]


def structure(experiment, case):
    judged, kind = curves(experiment, case, "steps"), case.get("structure") or "symplectic"
    keep, lose, unknown = ([c for c in judged if c.kept is value] for value in (True, False, None))
    if not any(c.residuals for c in judged):
        return []

    def lost(c):
        power = c.residual_power()
        return (f"{c.label} (up to {number(max(x for _, x in c.residuals))}"
                + ("" if math.isnan(power) else f", falling as h^{power:.1f}") + ")")
    text = (f"The {kind} structure is kept by {len(keep)} of {len(keep) + len(lose)} methods of which it is known: by claim, or "
            f"with a residual of at most {ROUND_OFF} u = {number(limit(case))} at the coarsest step.")
    return [("Structure", text, grouped(("kept", [c.label for c in keep]), ("not kept", [lost(c) for c in lose]),
                                        ("not known", [c.label for c in unknown])))]


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


def largest_setback(experiment, case, run, name, expected):
    """The largest move of an invariant against its expected direction, over its scale; nan without a series."""
    series = experiment.series(run, name)
    return series.setbacks(expected)[-1] / experiment.scale(case, name) if series and series.time else math.nan


def setbacks(experiment, case, name, runs, at):
    """Findings on a quantity that is expected to move in one direction: who lets it move in the other."""
    expected = experiment.expectation(case, name)[0]
    direction, move = DIRECTIONS[expected]
    sizes = {r.method: largest_setback(experiment, case, r, name, expected) for r in runs}
    never = [m for m, x in sizes.items() if x <= limit(case)]
    does = [f"{m} (by {number(x)})" for m, x in sizes.items() if x > limit(case)]
    unknown = [m for m, x in sizes.items() if math.isnan(x)]
    text = (f"{name} is expected to {direction}, so its change is not an error. Whether it {move}s {at} by more than "
            f"{ROUND_OFF} u between any two samples:")
    items = grouped((f"never {move}s", never), (f"{move}s", does), ("not known, without a series", unknown))
    return [(direction.capitalize(), text, items)] if items else []


def order(experiment, case):
    agree, differ = [], []
    for curve in curves(experiment, case, "steps"):
        seen = curve.order()
        if seen is None:
            continue
        spread = "two runs" if math.isnan(seen.interval) else f"± {max(seen.interval, 0.005):.2f}"
        claim = "" if curve.claimed is None else f"; claimed {curve.claimed}"
        (differ if seen.surprising else agree).append(f"{curve.label} ({seen.value:.2f} {spread}{claim})")
    text = "Order seen at the steps where refinement still gains and round-off is far:"
    items = grouped(("as claimed, as far as it can be told", agree), ("other than claimed", differ))
    return [("Order", text, items)] if items else []


def failures(experiment, case):
    runs = [r for r in experiment.runs if r.case == case["name"]]
    failed = [f"{r.method} at {step_text(r.step, case)}: {r.status}{', ' + r.message if r.message else ''}"
              for r in runs if r.failed]
    return [("Failures", f"{len(failed)} of {len(runs)} runs failed:", failed)] if failed else []
