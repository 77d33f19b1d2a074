"""Drift of the conserved quantity: small multiples by family on shared axes, at equal cost and at equal step.

Drawn is |I(t) - I(0)| over the scale of the quantity, which is the size of its terms (`scale` of summary.json); beside a name
stands the largest change in the quantity's own unit. A line joins the largest values in short stretches of time; those of other
families stand behind in the lightest grey. Dashed: a fitted trend, |slope| t, of methods whose class of drift is sized by a slope.
Dotted: 2 u sqrt(n) after n steps, what round-off alone adds up to.

Nothing is drawn below round-off u, which says nothing of a quantity of that scale.

Of a quantity that is expected to decrease or to increase the error is drawn at equal cost, its difference from that of the
reference solution, and at equal step its largest move in the other direction so far, where any method moves so by more than round-off.
"""
import math
import statistics

from assertion import said
from canvas import MID
from curves import ranks
from drift_sentence import drift
from error_measure import some_rows
from experiment import DIRECTIONS, UNIT_ROUND_OFF
from families import FAMILIES, style
from figures import Drawing, heading, sentences, step_text, time_label
from first_screen import finding
from lines import Line, Panel, draw, in_grey
from scales import ErrorAxis, envelope, logarithmic, time_axis
from wording import number, plain_text

BESIDE = 8  # letters of a unit that stands beside each name; a longer one is said once, and leaves the panel its width


def drawings(verdict):
    """At equal cost; a method of which no run finished by the run that came farthest."""
    if verdict.case.get("seeds") or not verdict.invariant:
        return []
    directed = verdict.expected in DIRECTIONS
    found = moved(verdict, [(row, row.run or failed_run(verdict, row)) for row in verdict.rows],
                  (lambda series: series.error) if directed else (lambda series: series.change))
    told = (f"Error of {verdict.invariant} against the reference solution{some_rows(verdict.case)}" if directed else
            f"Deviation of {verdict.invariant} from its value at the start")
    return drawn(verdict, "drift", "drift at equal cost", found, sentences(f"{told}{over(verdict)}.", verdict.which_runs()),
                 f"|error of {verdict.invariant}| / scale" if directed else f"|Δ {verdict.invariant}| / scale")


def at_equal_step(verdict):
    """At the step that most methods share, or the nearest."""
    if verdict.case.get("seeds") or not verdict.invariant:
        return []
    runs = {run.method: run for run in verdict.experiment.at_common_step(verdict.case)}
    at = step_text(verdict.experiment.common_step(verdict.case), verdict.case)
    name = verdict.invariant
    if verdict.expected in DIRECTIONS:
        direction, move = DIRECTIONS[verdict.expected]
        title, what = f"{name}, expected to {direction} ({at})", f"{move} of {name} / scale"
        told = (f"{name} is expected to {direction}, so its change is no error: shown is its largest {move} from any earlier value"
                f"{over(verdict)}, which should stay at round-off.")
        values = (lambda series: series.setbacks(verdict.expected))
    else:
        kind = "drift" if verdict.expected == "conserved" else "change"
        title = f"drift of {name} ({at})" if kind == "drift" else f"change of {name}, not a conserved quantity ({at})"
        what, told = f"|Δ {name}| / scale", f"Change of {name} since the start{over(verdict)}, at {at}."
        values = (lambda series: series.change)
    found = moved(verdict, [(row, runs[row.label]) for row in verdict.rows if row.label in runs], values)
    if verdict.expected in DIRECTIONS and all(v <= verdict.unit for *_, sizes, _ in found for v in sizes):
        return []  # what moves nowhere in the other direction is said in numbers; an empty panel says less
    lost = [row.label for row in verdict.rows if row.label in runs and row.label not in {r.label for r, *_ in found}]
    return drawn(verdict, "drift_at_equal_step", title, found,
                 sentences(told, f"No series for: {', '.join(lost)}." if lost else ""), what)


def failed_run(verdict, row):
    """Of a method of which no run finished the one that came farthest; None where there is none."""
    runs = [r for r in verdict.experiment.runs_of(verdict.case) if r.method == row.label and r.failed]
    return max(runs, key=lambda r: r.steps * r.step, default=None)


def over(verdict):
    """What the deviation is relative to, for a sentence."""
    scale = verdict.experiment.scale(verdict.case, verdict.invariant)
    return f", over its scale, {number(scale)} {unit_of(verdict)}".rstrip()


def unit_of(verdict):
    """The unit of the conserved quantity as it stands beside a number; empty where it has none."""
    unit = verdict.experiment.expectation(verdict.case, verdict.invariant)[1]
    return "" if unit == "1" else unit.replace("^2", "²").replace("^3", "³")


def moved(verdict, runs, values_of):
    """[(row, run, times, values over the scale, the largest value)] of the runs that left a series."""
    scale, out = verdict.experiment.scale(verdict.case, verdict.invariant), []
    for row, run in runs:
        series = verdict.experiment.series(run, verdict.invariant) if run else None
        sizes = [abs(x) for x in values_of(series)] if series else []
        times, values = envelope(series.time, [x / scale for x in sizes]) if sizes else ([], [])
        if times:
            out.append((row, run, times, values, max(x for x in sizes if not math.isnan(x))))
    return out


def drawn(verdict, kind, title, found, told, y):
    if not found:
        return []
    case, u = verdict.case, UNIT_ROUND_OFF[verdict.case["precision"]]
    axis = ErrorAxis([values for *_, values, _ in found], u, bounded=True)
    begin, end = (pick(t for _, _, times, *_ in found for t in times) for pick in (min, max))
    rank, unit = ranks(verdict.curves), unit_of(verdict)
    beside = unit if len(unit) <= BESIDE else ""
    panels = []

    def x_axis(_, axes):
        time_axis(axes, begin if logarithmic(begin, end) else 0, end)
    for family in FAMILIES:
        own = [one for one in found if one[0].curve.family is family]
        lines = [Line(row.label, times, values, style(family, rank[row.label], row.curve.fill),
                      f"{row.label}, {step_text(run.step, case)}: {run.drift_class(verdict.invariant)} {most:.1e}",
                      f"{number(float(f'{most:.1g}'))} {beside}".rstrip(), bool(row.drifts), run.failed)
                 for row, run, times, values, most in own]
        if lines:
            behind = [(times, values) for row, _, times, values, _ in found if row.curve.family is not family]
            panels.append(Panel(lines, axis, time_label(case), y, x_axis,
                                family.plural[:1].upper() + family.plural[1:], family.light, behind,
                                guides(verdict, own, begin, end, family)))
    what = "" if verdict.expected in DIRECTIONS else (
        "Flat is bounded, slope ½ on logarithmic axes is the growth of round-off, slope 1 a loss in proportion to time. Dashed: "
        f"the fitted trend{'; dotted: 2u√n, what n steps of round-off add up to' if axis.seen else ''}.")
    caption = sentences(told, f"Beside the names: the largest, in {'the unit of the quantity' if beside == unit else unit}.", what,
                        "A line joins the largest values in short stretches of time.",
                        "A cross: the run ended early." if any(run.failed for _, run, *_ in found) else "", in_grey(panels),
                        *axis.remarks())

    def picture(wide):
        return draw(panels, wide, plain_text(said(drift(verdict)) or finding(verdict)))
    return [Drawing(kind, case, f"{heading(case)}: {title}", caption, picture, printed=True)]


def guides(verdict, own, begin, end, family):
    """What draws the fitted trends of a panel and the growth of round-off."""
    ts = [begin * (end / begin) ** (k / 40) for k in range(41)]

    def guide(_, axes):
        if verdict.expected in DIRECTIONS:
            return
        for row, run, *_ in own:
            kind = verdict.experiment.drift_classes.get(run.drift_class(verdict.invariant))
            slope = abs(run.drift(verdict.invariant, "slope")) / verdict.experiment.scale(verdict.case, verdict.invariant)
            if kind and kind.measure == "slope" and slope > 0:
                axes.plot(ts, [slope * t for t in ts], color=family.light, linewidth=0.6, linestyle=(0, (4, 3)), zorder=2)
        u, step = UNIT_ROUND_OFF[verdict.case["precision"]], statistics.median(run.step for _, run, *_ in own)
        axes.plot(ts, [2 * u * math.sqrt(max(1.0, t / step)) for t in ts], color=MID, linewidth=0.7, linestyle=(0, (1, 2)), zorder=2)
    return guide
