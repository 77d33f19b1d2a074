"""The three figures of a case: drift against time, work against precision, structure residual.

drift           |I(t) - I(0)| / max(1, |I(0)|) of the conserved quantity I at the step most methods share; the unit
                1 keeps the measure meaningful for I(0) near 0. Grey: unit round-off u, and u sqrt(n) after n steps,
                Brouwer's law for a random walk of roundings. Where I is expected to decrease or to increase: I
                itself, and its largest move in the other direction so far, which is zero where there is none.
work-precision  largest error against processor time and against right-hand sides (steps where a method counts no
                right-hand sides), one line over the steps of each method, finished runs only.
structure       the residual of M^T K(z',t') M = K(z,t), M the Jacobian of one step, against step and against time.

Each figure function returns a Drawing, or None where the case has nothing to draw.
"""
import dataclasses
import math
import re
import statistics
import typing

from experiment import DIRECTIONS, UNIT_ROUND_OFF
from scales import EXPLOSION, ErrorAxis, decade_axis, envelope, step_axis, time_axis
from sheet import Sheet, plain

EXACT = r"$|z-z_\mathrm{exact}|\,/\,|z_\mathrm{exact}|$"
ENVELOPE = "Each line joins the largest values within short stretches of time."


@dataclasses.dataclass
class Drawing:
    kind: str
    case: dict
    title: str
    caption: str
    draw: typing.Callable[[bool], Sheet]  # wide? -> sheet

    @property
    def name(self):
        """The file name without its ending."""
        return f"{self.kind}_{slug(self.case)}"


def drawings(experiment, case):
    if case.get("seeds"):
        return []  # one run of many: see constraints.py
    made = (f(experiment, case) for f in (drift, work_precision, structure))
    return [d for d in made if d is not None]


def slug(case):
    return re.sub(r"[^A-Za-z0-9._-]+", "-", case["name"])


def heading(case):
    return case.get("title") or case["name"]


def with_unit(label, unit):
    return f"{label} [{unit}]" if unit and unit != "1" else label


def step_text(step, case):
    return f"step {step:.4g} {case.get('time_unit') or ''}".strip()


def sentences(*parts):
    return " ".join(p for p in parts if p)


def round_off(case):
    u = UNIT_ROUND_OFF[case["precision"]]
    return u, f"unit round-off u = {u:.1e}"


def styled(experiment, run, target):
    """Index of the run's method and its legend label, which names a step other than the common one."""
    other = abs(run.step / target - 1) > 1e-9
    told = f" (tolerance {run.tolerance})" if run.tolerance else f" (step {run.step:.4g})" if other else ""
    return experiment.labels.index(run.method), run.method + told


def draw_over_time(sheet, axes, axis, experiment, target, curves, begin):
    """Curves [(run, times, values)] with a few markers each, and a cross where a run ended early."""
    for n, (run, times, values) in enumerate(curves):
        if not times:
            continue
        index, label = styled(experiment, run, target)
        gap = max(1, len(times) // 6)
        sheet.method(axes, times, axis.place(values), index, label, markevery=(n * gap // max(1, len(curves)), gap))
        if run.failed:
            seen = [p for p in zip(times, axis.place(values)) if p[1] <= 10.0**axis.high]
            if seen:
                sheet.cross(axes, *seen[-1], "run ended early")
    time_axis(axes, begin, max(t[-1] for _, t, _ in curves if t))
    axis.apply(axes)


def shared_series(experiment, case, invariant):
    """([(run, series)] at the common step, a sentence on runs without series)."""
    pairs = [(r, experiment.series(r, invariant)) for r in experiment.at_common_step(case)]
    lost = [r.method for r, s in pairs if s is None or not s.time]
    return ([(r, s) for r, s in pairs if s is not None and s.time],
            f"No series for: {', '.join(lost)}." if lost else "")


def drift(experiment, case):
    invariant = case.get("conserved")
    if not invariant:
        return None
    pairs, lost = shared_series(experiment, case, invariant)
    curves = [(r, *envelope(s.time, [abs(x) / s.scale for x in s.change])) for r, s in pairs]
    if not any(times for _, times, _ in curves):
        return None
    expected, unit = experiment.expectation(case, invariant)
    unit = unit or pairs[0][1].unit
    one = f"1 {unit}" if unit and unit != "1" else "1"
    time_label = with_unit("time t", case.get("time_unit") or pairs[0][1].time_unit)
    target = experiment.common_step(case)
    at_step = step_text(target, case)
    u, u_label = round_off(case)
    directed = expected in DIRECTIONS
    if directed:
        direction, move = DIRECTIONS[expected]
        setbacks = [(r, *envelope(s.time, [x / s.scale for x in s.setbacks(expected)])) for r, s in pairs]
        title = f"{heading(case)}: {invariant}, expected to {direction} ({at_step})"
    elif expected == "conserved":
        title = f"{heading(case)}: drift of {invariant} ({at_step})"
    else:
        title = f"{heading(case)}: change of {invariant}, not a conserved quantity ({at_step})"
    axis = ErrorAxis([v for *_, v in (setbacks if directed else curves)], u)
    begin = min(t[0] for _, t, _ in curves if t)

    def draw(wide):
        sheet = Sheet(2 if directed else 1, wide, title)
        last = sheet.axes[-1]
        sheet.level(last, u, u_label)
        if directed:
            values_of_directed(sheet, experiment, target, pairs, expected)
            sheet.axes[0].set(xlabel=plain(time_label), ylabel=plain(with_unit(f"{invariant}: I(t)", unit)))
            draw_over_time(sheet, last, axis, experiment, target, setbacks, begin)
            last.set_ylabel(plain(f"largest {move} of {invariant} so far\n/ max({one}, |I(0)|)"))
        else:
            end = max(c[1][-1] for c in curves if c[1])
            times = [begin * (end / begin) ** (k / 60) for k in range(61)]
            walk = [u * math.sqrt(max(1.0, t / target)) for t in times]
            sheet.level(last, (times, walk), "u √n after n steps", linestyle=(0, (1, 1.5)))
            draw_over_time(sheet, last, axis, experiment, target, curves, begin)
            last.set_ylabel(plain(f"{'drift' if expected == 'conserved' else 'change'} of {invariant}\n"
                                  f"|I(t) − I(0)| / max({one}, |I(0)|)"))
        last.set_xlabel(plain(time_label))
        return sheet

    what = (f"{invariant} is expected to {direction}, so its change is no error: shown are its value and its largest "
            f"{move} from any earlier value, which should stay at round-off." if directed else
            f"Change of {invariant} since the start, at {at_step}. The lower grey lines are unit round-off u and the "
            "growth u √n of a random walk of n roundings.")
    return Drawing("drift", case, title, sentences(what, ENVELOPE, *axis.remarks(), lost), draw)


def values_of_directed(sheet, experiment, target, pairs, expected):
    """Left panel for a quantity that is expected to decrease or to increase: the quantity itself, against time."""
    axes = sheet.axes[0]
    for n, (run, s) in enumerate(pairs):
        index, label = styled(experiment, run, target)
        keep = range(0, len(s.time), max(1, len(s.time) // 200))
        shown = [(s.time[k], s.initial + s.change[k]) for k in keep]
        gap = max(1, len(shown) // 6)
        sheet.method(axes, *zip(*shown), index, label, markevery=(n * gap // len(pairs), gap))
    finite = [s for _, s in pairs if math.isfinite(s.initial)]
    backward, forward = (max, min) if expected == "decreasing" else (min, max)
    start = backward((s.initial for s in finite), default=math.nan)
    ends = [s.initial + forward(x for x in s.change if math.isfinite(x)) for s in finite]
    if ends and forward(start, statistics.median(ends)) != start:  # a method that exploded leaves the frame
        low, high = sorted((start, statistics.median(ends)))
        axes.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))
    time_axis(axes, 0, max(s.time[-1] for _, s in pairs))


def precision_measure(experiment, case):
    """(function run -> error, axis label): the largest error, or the largest drift without a reference solution.

    With None as function where there is neither.
    """
    runs, invariant = experiment.runs_of(case), case.get("conserved")
    if any(math.isfinite(r.number("error_max")) for r in runs):
        return lambda r: r.number("error_max"), "largest relative error\n" + EXACT
    if invariant and experiment.expectation(case, invariant)[0] == "conserved":
        unit = experiment.expectation(case, invariant)[1]
        return lambda r: r.drift(invariant, "max"), plain(
            with_unit(f"no reference solution: largest drift\nof {invariant}", unit))
    return None, ""


def work_measures(experiment, case):
    """[(function run -> cost, axis label)]: processor time if measured, and right-hand sides or steps."""
    finished = [r for r in experiment.runs_of(case) if not r.failed]
    out = [(lambda r: r.total_ns, "processor time of the run [ns]")] if any(r.cost for r in finished) else []
    if all(r.total_rhs > 0 for r in finished):
        return out + [(lambda r: r.total_rhs, "right-hand sides evaluated")]
    return out + [(lambda r: r.steps, "steps")]


def work_precision(experiment, case):
    error, y_label = precision_measure(experiment, case)
    finished = [r for r in experiment.runs_of(case) if not r.failed]
    if error is None or not any(math.isfinite(error(r)) for r in finished):
        return None
    works = work_measures(experiment, case)
    lines = {m: [r for r in finished if r.method == m] for m in experiment.labels}
    lines = {m: rs for m, rs in lines.items() if rs}
    axis = ErrorAxis([[error(r) for r in rs] for rs in lines.values()], explosion=10 if EXACT in y_label else EXPLOSION)
    title = f"{heading(case)}: work and precision"

    def draw(wide):
        sheet = Sheet(len(works), wide, title)
        for axes, (work, x_label) in zip(sheet.axes, works):
            for method, runs in lines.items():
                points = [(work(r), e) for r, e in zip(runs, axis.place([error(r) for r in runs])) if work(r) > 0]
                if points:
                    sheet.method(axes, *zip(*points), experiment.labels.index(method), method)
            decade_axis(axes, [work(r) for r in finished])
            axis.apply(axes)
            axes.set(xlabel=plain(x_label), ylabel=y_label)
        return sheet

    failed = [f"{r.method} at {step_text(r.step, case)} ({r.status})" for r in experiment.runs_of(case) if r.failed]
    timing = "" if any(r.cost for r in finished) else "Timings were not measured."
    counted = "" if all(r.total_rhs > 0 for r in finished) else (
        "Steps stand for work here, because not every method counts right-hand sides; steps of different methods cost "
        "different amounts.")
    return Drawing("work_precision", case, title, sentences(
        "Below and to the left is better: each point is a finished run, each line a method over its steps.", timing,
        counted, *axis.remarks(), f"Not drawn, because they failed: {', '.join(failed)}." if failed else ""), draw)


def structure(experiment, case):
    runs = [r for r in experiment.runs_of(case) if not math.isnan(r.number("structure_residual"))]
    by_step = {m: [r for r in runs if r.method == m] for m in experiment.labels}
    by_step = {m: rs for m, rs in by_step.items() if rs}
    pairs, _ = shared_series(experiment, case, case.get("conserved") or None)
    curves = [(r, *envelope(s.time, s.residual, linear=True)) for r, s in pairs]
    curves = [c for c in curves if c[1]]
    if not by_step and not curves:
        return None
    panels = ["step"] if by_step and len({r.step for r in runs}) > 1 or not curves else []
    panels += ["time"] if curves else []
    u, u_label = round_off(case)
    values = [[r.number("structure_residual") for r in rs] for rs in by_step.values()] if "step" in panels else []
    axis = ErrorAxis(values + [v for *_, v in curves], u)
    target, unit = experiment.common_step(case), case.get("time_unit")
    title = f"{heading(case)}: {case.get('structure') or 'symplectic'} structure of one step"

    def draw(wide):
        sheet = Sheet(len(panels), wide, title)
        for axes, panel in zip(sheet.axes, panels):
            sheet.level(axes, u, u_label)
            axes.set_ylabel("structure residual\n" + r"$\Vert M^{T}K(\hat{z},\hat{t}\,)\,M-K(z,t)\Vert$")
            if panel == "step":
                for method, some in by_step.items():
                    residuals = axis.place([r.number("structure_residual") for r in some])
                    sheet.method(axes, [r.step for r in some], residuals, experiment.labels.index(method), method)
                step_axis(axes, [r.step for r in runs])
                axes.set_xlabel(plain(with_unit("step h", unit)))
                axis.apply(axes)
            else:
                draw_over_time(sheet, axes, axis, experiment, target, curves, 0)
                axes.set_xlabel(plain(with_unit("time t", unit)))
        return sheet

    time = f"Against time: {step_text(target, case)}." if "time" in panels and "step" in panels else ""
    return Drawing("structure", case, title, sentences(
        "Residual of the structure that the exact flow keeps, M being the Jacobian of one step. A method that has the "
        "structure stays near the grey line of unit round-off at every step.", time, *axis.remarks()), draw)
