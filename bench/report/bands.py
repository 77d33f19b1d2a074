"""Ensembles: the drift of a conserved quantity over the seeds of a case, a panel for each method.

In each short stretch of time every seed has a largest drift. The line is their median, the band holds the seeds from the
tenth to the ninetieth per cent, and the thin line is the largest of all.
"""
import math

from canvas import MID, Canvas, plain
from constraints import maxima
from experiment import UNIT_ROUND_OFF
from figures import Drawing, heading, sentences, step_text, time_label, with_unit
from scales import ErrorAxis, time_axis


def quantile(values, part):
    """The value below which a part of the values lies, straight between neighbours."""
    ordered = sorted(values)
    at = part * (len(ordered) - 1)
    low = math.floor(at)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (at - low) * (ordered[high] - ordered[low])


def drawings(verdict):
    case, experiment = verdict.case, verdict.experiment
    if not case.get("seeds") or not verdict.invariant or verdict.expected != "conserved":
        return []
    curves = []
    runs = {r.method: r for r in experiment.at_common_step(case)}
    for row in verdict.rows:
        if row.label in verdict.named() and row.label in runs:
            found = [experiment.series(r, verdict.invariant) for r in experiment.ensemble_of(runs[row.label]) if not r.failed]
            shown = [(s.time, [abs(x) for x in s.change]) for s in found if s and s.time]
            times, largest = maxima(shown) if shown else ([], [])
            if times:
                curves.append((row, times, largest))
    return [drawing(verdict, curves)] if curves else []


def drawing(verdict, curves):
    case = verdict.case
    unit = verdict.experiment.expectation(case, verdict.invariant)[1]
    axis = ErrorAxis([[v for values in largest for v in values] for *_, largest in curves],
                     UNIT_ROUND_OFF[case["precision"]])
    title = f"{heading(case)}: drift of {verdict.invariant} over {case['seeds']} seeds"
    told = sentences(
        f"Largest drift of {with_unit(verdict.invariant, unit)} of each seed in short stretches of time, "
        f"{step_text(verdict.experiment.common_step(case), case)}: the median, a band from 10 % to 90 % of the seeds, and thin "
        "the largest of all. Dashed: unit round-off.", *axis.remarks())
    return Drawing("bands", case, title, told, lambda wide: draw(verdict, curves, axis, title, wide), "Bands")


def draw(verdict, curves, axis, title, wide):
    unit = verdict.experiment.expectation(verdict.case, verdict.invariant)[1]
    width, font = (1120, 12.5) if wide else (368, 11)
    left, top, right, below, between, tall = (72 if wide else 60), 24, 10, 46, 14, 210 if wide else 150
    columns = min(len(curves), 4 if wide else 2)
    each = min(420, (width - left - right - between * (columns - 1)) / columns)
    rows = math.ceil(len(curves) / columns)
    canvas = Canvas(left + columns * each + between * (columns - 1) + right, rows * (top + tall) + below, font)
    canvas.description = title
    begin, end = min(c[1][0] for c in curves), max(c[1][-1] for c in curves)
    for k, (row, times, largest) in enumerate(curves):
        line, column = divmod(k, columns)
        axes = canvas.panel(left + column * (each + between), top + line * (top + tall), each, tall)
        colour = row.curve.family.light
        low, middle, high, most = (axis.place([quantile(v, part) for v in largest]) for part in (0.1, 0.5, 0.9, 1.0))
        axes.fill_between(times, low, high, color=colour, alpha=0.22, linewidth=0, zorder=2)
        canvas.line(axes, times, most, f"{row.label}: largest of the seeds", color=colour, linewidth=0.6, zorder=3)
        canvas.line(axes, times, middle, f"{row.label}: median, at the end {middle[-1]:.1e}", color=colour, linewidth=1.6,
                    zorder=4)
        axes.axhline(verdict.unit, color=MID, linewidth=0.8, linestyle=(0, (4, 2)), zorder=1)
        axis.apply(axes)
        time_axis(axes, begin, end)
        axes.set_title(plain(row.label), fontsize=0.95 * font, color=colour, loc="left", pad=4)
        last = k + columns >= len(curves)
        canvas.labels(axes, time_label(verdict.case) if last else "",
                      with_unit(f"drift of {verdict.invariant}", unit) if column == 0 else "")
        if not last:
            axes.tick_params(labelbottom=False)
        if column:
            axes.tick_params(labelleft=False)
    return canvas
