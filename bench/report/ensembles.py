"""Ensembles: how the error of the conserved quantity spreads over the seeds of a case.

At each of the times that all finished runs of a method share, the root mean square over the seeds of I(t) - I(0), and
the power of time that it grows with: the slope of a straight line through log rms against log t in the second half of
the decades shown. An unbiased error that is independent from step to step grows as t^0.5, one with a bias as t^1.
"""
import bisect
import math
import statistics

from canvas import MID
from curves import ranks
from families import style
from figures import Drawing, heading, sentences, step_text, time_label, with_unit
from lines import Line, Panel, draw, in_grey
from scales import ErrorAxis, time_axis
from wording import hundredths, listed

STUDENT = {1: 12.71, 2: 4.30, 3: 3.18, 4: 2.78, 5: 2.57, 7: 2.36, 10: 2.23, 15: 2.13, 20: 2.09, 30: 2.04, 60: 2.0}  # 95 %
TOLD = 0.1  # half of an interval


def is_one(experiment, case):
    """Whether the case has seeds, and a conserved quantity whose errors spread over them."""
    invariant = case.get("conserved")
    return bool(case.get("seeds") and invariant and experiment.expectation(case, invariant)[0] == "conserved"
                and spreads(experiment, case))


def squares(experiment, case):
    """[(run, times, [squared errors of each seed])] of each method at the common step; runs that failed are left out."""
    out = []
    for run in experiment.at_common_step(case):
        members = [experiment.series(r, case["conserved"]) for r in experiment.ensemble_of(run) if not r.failed]
        members = [dict(zip(m.time, m.change)) for m in members if m is not None and m.time]
        times = sorted(t for t in set.intersection(*map(set, members)) if t > 0) if members else []
        if times:
            out.append((run, times, [[m[t] * m[t] for t in times] for m in members]))
    return out


def rms(members):
    return [math.sqrt(sum(at) / len(at)) for at in zip(*members)]


def spreads(experiment, case):
    """[(run, times, rms over the seeds)] of each method at the common step."""
    return [(run, times, rms(members)) for run, times, members in squares(experiment, case)]


def growth_of(experiment, case):
    """[(run, power of time that the rms error grows with, half of its 95 % interval)]: that of the drifts of its seeds where these
    agree to TOLD, because they are found from all steps, and samples may always meet an oscillation in one phase; elsewhere that of
    the root mean square, with an interval that comes from leaving out one seed after the other. It is nan for fewer than three."""
    out = []
    for run, times, members in squares(experiment, case):
        n = len(members)
        power, half = exponent(times, rms(members)), math.nan
        if n > 2:
            without = [exponent(times, rms(members[:k] + members[k + 1:])) for k in range(n)]
            mean = sum(without) / n
            half = student(n) * math.sqrt((n - 1) / n * sum((p - mean) ** 2 for p in without))
        out.append((run, *(of_drifts(experiment, case, run) or (power, half))))
    return out


def of_drifts(experiment, case, run):
    """(mean of the powers of time that the drifts of all seeds have, half of its interval) where that is at most TOLD; or None."""
    powers = [r.drift(case["conserved"], "exponent") for r in experiment.ensemble_of(run) if not r.failed]
    if len(powers) < 3 or any(map(math.isnan, powers)):
        return None
    half = student(len(powers)) * statistics.stdev(powers) / math.sqrt(len(powers))
    return (statistics.mean(powers), half) if half <= TOLD else None


def student(count):
    """The factor of a 95 % interval of a mean of so many values."""
    known = sorted(STUDENT)
    return STUDENT[known[bisect.bisect_right(known, count - 1) - 1]]


def exponent(times, values):
    """The power of time that the values grow with, or nan where too few are positive."""
    if not times:
        return math.nan
    begin = math.sqrt(times[0] * times[-1])
    points = [(math.log(t), math.log(v)) for t, v in zip(times, values) if t >= begin and v > 0 and math.isfinite(v)]
    if len(points) < 3:
        return math.nan
    x, y = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    width = sum((p[0] - x) ** 2 for p in points)
    return sum((p[0] - x) * (p[1] - y) for p in points) / width if width > 0 else math.nan


def findings(experiment, case):
    """[(subject, sentence, [items])]: the size of the spread at the end and the power of time it grows with."""
    if not is_one(experiment, case):
        return []
    items = [f"{run.method}: {values[-1]:.1e}, as " + ("–" if math.isnan(p) else f"t^{hundredths(p)}" + (
        "" if math.isnan(half) else f" ± {half:.2f}"))
             for (run, _, values), (_, p, half) in zip(spreads(experiment, case), growth_of(experiment, case))]
    return [("Spread", f"Root mean square of the error of {case['conserved']} over {case['seeds']} seeds at the end, and "
             "the power of time that it grows with in the second half of the decades:", items)]


def drawings(verdict):
    experiment, case, name = verdict.experiment, verdict.case, verdict.invariant
    if not is_one(experiment, case):
        return []
    by_label = {curve[0].method: curve for curve in spreads(experiment, case)}
    curves = [by_label[label] for label in verdict.in_order(by_label) if len(by_label[label][1]) > 2]
    short = [label for label in verdict.in_order(by_label) if len(by_label[label][1]) < 3]
    if not curves:
        return []
    rows, rank = {r.label: r for r in verdict.rows}, ranks(verdict.curves)
    axis = ErrorAxis([values for *_, values in curves], verdict.unit)
    begin, end = min(c[1][0] for c in curves), max(c[1][-1] for c in curves)
    largest = max((v for *_, values in curves for v in values if math.isfinite(v)), default=1.0)
    lines = [Line(run.method, times, values, style(rows[run.method].curve.family, rank[run.method], rows[run.method].curve.fill),
                  f"{run.method}: at the end {values[-1]:.1e}") for run, times, values in curves]

    def guides(_, axes):
        axes.axhline(verdict.unit, color=MID, linewidth=0.8, linestyle=(0, (8, 2)), zorder=1)
        for power, dash in ((0.5, (0, (1, 1.5))), (1, (0, (4, 1.5)))):
            axes.plot([begin, end], [largest * (t / end) ** power for t in (begin, end)], color=MID, linewidth=0.9, linestyle=dash,
                      zorder=2)
    panel = Panel(lines, axis, time_label(case),
                  with_unit(f"rms of I(t) − I(0), {name}", experiment.expectation(case, name)[1]),
                  lambda _, axes: time_axis(axes, begin, end), more=guides)
    title = f"{heading(case)}: rms error of {name} over {case['seeds']} seeds"
    return [Drawing("ensemble", case, title, sentences(
        f"Root mean square over the seeds that finished, {step_text(experiment.common_step(case), case)}. Independent errors without a "
        "bias grow as t^0.5, dotted, errors with a bias as t^1, short dashes. Long dashes: unit round-off.",
        f"Left out {'is' if len(short) == 1 else 'are'} {listed(short)}, whose seeds have no three times in common." if short else "",
        in_grey([panel]),
        *axis.remarks()), lambda wide: draw([panel], wide, title, tall=250), "Root mean square", printed=True)]
