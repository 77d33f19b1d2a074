"""Residuals of constraints: how far methods and formulations are from the constraint surface, against time.

One panel for the drift of the conserved quantity where the case names one, then one for each level of constraints:
the largest |phi|, and the largest of the hidden constraints, |phi~|. Time is cut into BINS stretches. A line shows the
largest value in each of them; for an ensemble it shows the median of these largest values over the seeds.
"""
import bisect
import math
import statistics

from figures import Drawing, heading, round_off, sentences, step_text, styled, with_unit
from scales import ErrorAxis, logarithmic, time_axis
from canvas import plain
from sheet import Sheet

BINS = 60
LABELS = {"constraint": r"constraints, max $|\varphi|$", "hidden-constraint": r"hidden constraints, max $|\tilde\varphi|$"}


def drawings(experiment, case):
    names = [n for n in experiment.residuals if any(not math.isnan(r.drift(n, "max")) for r in experiment.runs_of(case))]
    if not names:
        return []
    drawn = constraints(experiment, case, names)
    return [drawn] if drawn else []


def panel_curves(experiment, case, name, runs):
    """[(run, times, values)]: the largest size of the quantity in each stretch of time, the median over the seeds."""
    curves = []
    for run in runs:
        shown = []
        for one in experiment.ensemble_of(run):
            series = experiment.series(one, name)
            if series and series.time and (not one.failed or not run.seed):
                size = [abs(x + (series.initial if name in experiment.residuals else 0)) for x in series.change]
                shown.append((series.time, size))
        if shown:
            curves.append((run, *stretches(shown)))
    return [c for c in curves if c[1]]


def stretches(shown):
    """(times, medians over the members of the largest value in each stretch of time)."""
    times, largest = maxima(shown)
    return times, [statistics.median(values) for values in largest]


def maxima(shown):
    """(times, [the largest value of each member in the stretch of time that ends there])."""
    begin = max(min((t for t in times if t > 0), default=math.inf) for times, _ in shown)
    end = max(times[-1] for times, _ in shown)
    if not begin < end:
        return [], []
    wide = logarithmic(begin, end)
    edges = [begin * (end / begin) ** (k / BINS) if wide else begin + (end - begin) * k / BINS
             for k in range(1, BINS + 1)]
    found = [[[] for _ in shown] for _ in edges]
    for member, (times, values) in enumerate(shown):
        for t, v in zip(times, values):
            if t > 0 and not math.isnan(v):
                found[min(bisect.bisect_left(edges, t * (1 - 1e-12)), BINS - 1)][member].append(v)
    out_t, out_v = [], []
    for edge, members in zip(edges, found):
        largest = [max(m) for m in members if m]
        if 2 * len(largest) > len(shown):
            out_t.append(edge)
            out_v.append(largest)
    return out_t, out_v


def constraints(experiment, case, names):
    invariant = case.get("conserved")
    conserved = invariant and experiment.expectation(case, invariant)[0] == "conserved"
    panels = ([invariant] if conserved else []) + names
    runs = experiment.at_common_step(case)
    curves = {name: panel_curves(experiment, case, name, runs) for name in panels}
    if not any(curves.values()):
        return None
    target, seeds = experiment.common_step(case), case.get("seeds") or 0
    unit = experiment.expectation(case, invariant)[1] if conserved else ""
    u, u_label = round_off(case)
    axes_of = {name: ErrorAxis([v for *_, v in curves[name]], u) for name in panels}
    title = f"{heading(case)}: errors against time" + (f", medians over {seeds} seeds" if seeds else "")
    labels = LABELS | ({invariant: plain(with_unit(f"drift of {invariant}, |I(t) − I(0)|", unit))} if conserved else {})

    def draw(wide):
        sheet = Sheet(len(panels), wide, title)
        for axes, name in zip(sheet.axes, panels):
            axis = axes_of[name]
            sheet.level(axes, u, u_label)
            for n, (run, times, values) in enumerate(curves[name]):
                look, label = styled(experiment, run, target)
                gap = max(1, len(times) // 6)
                sheet.method(axes, times, axis.place(values), look, label,
                             markevery=(n * gap // max(1, len(curves[name])), gap))
                if run.failed and not seeds:
                    sheet.cross(axes, times[-1], axis.place(values)[-1], "run ended early")
            if curves[name]:
                time_axis(axes, min(t[0] for _, t, _ in curves[name]), max(t[-1] for _, t, _ in curves[name]))
            axis.apply(axes)
            axes.set(xlabel=plain(with_unit("time t", case.get("time_unit"))), ylabel=labels.get(name, plain(name)))
        return sheet

    what = (f"Medians over {seeds} seeds of the largest values in short stretches of time." if seeds else
            "Each line joins the largest values in short stretches of time.")
    steps = "" if all(r.tolerance for r in runs) else f"Methods of fixed steps: {step_text(target, case)}."
    return Drawing("constraints", case, title, sentences(
        what, steps, "Residuals have the units of the constraints as the system states them; a method on the constraint "
        "surface stays near unit round-off.", *(remark for name in panels for remark in axes_of[name].remarks()[:1]
                                                if name == panels[0])), draw)


def growth(experiment, case):
    """[(subject, sentence, [items])]: size of the residuals and the power of time they grow with."""
    out = []
    for name in experiment.residuals:
        if case.get("seeds"):
            sizes = experiment.spreads_of(case, f"{name}:max")
            powers = {(m, s): median for m, s, median, *_ in experiment.spreads_of(case, f"{name}:growth")}
            items = [f"{m} ({s.replace('~', 'tolerance ')}): {size(median)} ({size(low)} to {size(high)}), "
                     f"as {power(powers.get((m, s), math.nan))}" for m, s, median, low, high, *_ in sizes
                     if not math.isnan(median)]
            text = f"Largest {name} residual of a run, median and range over {case['seeds']} seeds, and the median power " \
                   "of time that the largest value so far grows with:"
        else:
            runs = [r for r in experiment.at_common_step(case) if not r.failed and not math.isnan(r.drift(name, "max"))]
            items = [f"{r.method}: {size(r.drift(name, 'max'))}, as {power(r.number(f'{name}:growth'))}" for r in runs]
            text = f"Largest {name} residual of a run, and the power of time that the largest value so far grows with:"
        if items:
            out.append((name.replace("-", " ").capitalize() + "s", text, items))
    return out


def claims(experiment, case):
    """[(subject, sentence, [items])]: the claims that the experiment makes of its methods, and whether they hold."""
    items = []
    for _, c in experiment.claims:
        if c["case"] != case["name"]:
            continue
        times = "" if float(c["factor"]) == 1 else f"{float(c['factor']):g} times "
        than = f"that of {c['than']}" if c["than"] else f"{float(c['bound']):g}"
        relation = "exceeds" if c["relation"] == "exceeds" else "stays below"
        items.append(f"{'holds' if c['holds'] == 'yes' else 'FAILS'}: {c['measure']} of {c['method']} {relation} "
                     f"{times}{than} in {c['holding']} of {c['runs']} runs (expected in {c['needed']}; median ratio "
                     f"{float(c['ratio_median']):.3g})")
    return [("Claims", "Stated by the experiment and checked on its runs:", items)] if items else []


def size(x):
    return f"{x:.1e}"


def power(x):
    return "–" if math.isnan(x) else f"t^{x:.2f}"
