"""Residuals of constraints: how far methods and formulations are from the constraint surface, against time.

One panel for the drift of the conserved quantity where the case names one, then one for each level of constraints:
the largest |phi|, and the largest of the hidden constraints, |phi~|. Time is cut into BINS stretches. A line shows the
largest value in each of them; for an ensemble it shows the median of these largest values over the seeds.
"""
import bisect
import math
import statistics

from canvas import MID
from curves import ranks
from families import style
from figures import Drawing, heading, sentences, step_text, time_label, with_unit
from lines import Line, Panel, draw, in_grey
from scales import ErrorAxis, logarithmic, remarks_of, time_axis
from wording import listed

BINS = 60
LABELS = {"constraint": "constraints, max |φ|", "hidden-constraint": "hidden constraints"}


def drawings(verdict):
    """One drawing with a panel for each quantity; none where no residual was measured."""
    experiment, case = verdict.experiment, verdict.case
    names = [n for n in experiment.residuals if any(not math.isnan(r.drift(n, "max")) for r in experiment.runs_of(case))]
    conserved = verdict.invariant and verdict.expected == "conserved"
    by_label = {run.method: run for run in experiment.at_common_step(case)}
    runs = [by_label[label] for label in verdict.in_order(by_label)]
    curves = {name: panel_curves(experiment, case, name, runs) for name in ([verdict.invariant] if conserved else []) + names}
    curves = {name: some for name, some in curves.items() if some}
    if not names or not curves:
        return []
    seeds, unit = case.get("seeds") or 0, experiment.expectation(case, verdict.invariant)[1] if conserved else ""
    labels = LABELS | {verdict.invariant: with_unit(f"drift of {verdict.invariant}", unit)}
    panels = [panel(verdict, labels.get(name, name), some) for name, some in curves.items()]
    what = (f"Medians over {seeds} seeds of the largest values in short stretches of time." if seeds else
            "Each line joins the largest values in short stretches of time.")
    tolerances = sorted({r.tolerance for r in runs if r.tolerance}, key=float)
    steps = sentences("" if all(r.tolerance for r in runs) else f"Methods of fixed steps: {step_text(experiment.common_step(case), case)}.",
                      f"Others: tolerance {listed(tolerances)}." if tolerances else "")
    caption = sentences(
        what, steps, "Residuals have the units of the constraints as the system states them; a method on the constraint surface stays "
        "near unit round-off, the dashed line.", "A cross: the run ended early." if any(
            line.ended for one in panels for line in one.lines) else "", in_grey(panels), *remarks_of([one.axis for one in panels]))
    title = f"{heading(case)}: errors against time" + (f", medians over {seeds} seeds" if seeds else "")
    return [Drawing("constraints", case, title, caption, lambda wide: draw(panels, wide, title), printed=True)]


def panel(verdict, what, curves):
    """The panel of one quantity, of which `curves` are [(run, times, values)]."""
    axis, rows, rank = ErrorAxis([v for *_, v in curves], verdict.unit), {r.label: r for r in verdict.rows}, ranks(verdict.curves)
    seeds = verdict.case.get("seeds")
    lines = [Line(run.method, times, values, style(rows[run.method].curve.family, rank[run.method], rows[run.method].curve.fill),
                  f"{run.method}: {max(values):.1e}", ended=run.failed and not seeds) for run, times, values in curves]

    def unit_round_off(_, axes):
        axes.axhline(verdict.unit, color=MID, linewidth=0.8, linestyle=(0, (4, 2)), zorder=1)
    return Panel(lines, axis, time_label(verdict.case), "", lambda _, axes: time_axis(
        axes, min(line.x[0] for line in lines), max(line.x[-1] for line in lines)), what, more=unit_round_off)


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
