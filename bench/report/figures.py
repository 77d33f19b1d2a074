"""What figures of a case share, and its drift at equal step.

The drift is |I(t) - I(0)| / max(1, |I(0)|) of the conserved quantity I at the step most methods share; the unit 1 keeps the
measure meaningful for I(0) near 0. Grey: unit round-off u, and u sqrt(n) after n steps, Brouwer's law for a random walk of
roundings. Where I is expected to decrease or to increase: I itself, and its largest move in the other direction so far, which
is zero where there is none.
"""
import dataclasses
import math
import re
import statistics
import typing

from canvas import plain
from command import write
from experiment import DIRECTIONS, UNIT_ROUND_OFF
from families import family_named, style
from scales import ErrorAxis, envelope, time_axis
from sheet import Sheet

PROLOGUE = '<?xml version="1.0" encoding="utf-8"?>\n'  # of an SVG that is a file of its own
ENVELOPE = "Each line joins the largest values within short stretches of time."


@dataclasses.dataclass
class Drawing:
    kind: str
    case: dict
    title: str
    caption: str
    draw: typing.Callable[[bool], typing.Any]  # wide? -> Sheet or Canvas
    tab: str = ""  # of several drawings of which one is shown at a time: what this one is called
    paper: typing.Callable[[float], typing.Any] | None = None  # width in points -> Canvas for print, without a title

    @property
    def name(self):
        """The file name without its ending; a drawing of one run has no case."""
        return f"{self.kind}_{slug(self.case)}" if self.case else self.kind


def saved(drawings, target, small=False):
    """Draw them as files of the directory; [(drawing, wide SVG, narrow SVG)] for a page. With `small`, the first one, as narrow
    screens have it, is small.svg too, for the index."""
    target.mkdir(exist_ok=True)
    out = []
    for drawing in drawings:
        sheet = drawing.draw(True)
        write(target / f"{drawing.name}.svg", PROLOGUE + sheet.svg(f"{drawing.name}-wide", coloured=True))
        if drawing.kind == "animation":  # scales by itself, and has no picture that stands still
            out.append((drawing, sheet.svg(f"{drawing.name}-moving"), ""))
            continue
        write(target / f"{drawing.name}.png", sheet.png())
        narrow = drawing.draw(False)
        if small and not out:
            write(target / "small.svg", PROLOGUE + narrow.svg("small", coloured=True))
        out.append((drawing, sheet.svg(f"{drawing.name}-wide"), narrow.svg(f"{drawing.name}-narrow")))
    return out


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


def look_of(experiment, label):
    """How the lines of a method look: its family's colour and mark, and a dash by its place among those of the family."""
    families = {m["label"]: family_named(m.get("family")) for m in experiment.methods}
    kin = [other for other, family in families.items() if family is families[label]]
    return style(families[label], kin.index(label), "full" if kin.index(label) % 2 == 0 else "open")


def styled(experiment, run, target):
    """How the run's line looks, and its legend label, which names a step other than the common one."""
    other = abs(run.step / target - 1) > 1e-9
    told = f" (tolerance {run.tolerance})" if run.tolerance else f" (step {run.step:.4g})" if other else ""
    return look_of(experiment, run.method), run.method + told


def draw_over_time(sheet, axes, axis, experiment, target, curves, begin):
    """Curves [(run, times, values)] with a few markers each, and a cross where a run ended early."""
    for n, (run, times, values) in enumerate(curves):
        if not times:
            continue
        look, label = styled(experiment, run, target)
        gap = max(1, len(times) // 6)
        sheet.method(axes, times, axis.place(values), look, label, markevery=(n * gap // max(1, len(curves)), gap))
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


def drift_at_equal_step(experiment, case):
    """The Drawing, or None where there is nothing to draw."""
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
    return Drawing("drift_at_equal_step", case, title, sentences(what, ENVELOPE, *axis.remarks(), lost), draw)


def values_of_directed(sheet, experiment, target, pairs, expected):
    """Left panel for a quantity that is expected to decrease or to increase: the quantity itself, against time."""
    axes = sheet.axes[0]
    for n, (run, s) in enumerate(pairs):
        look, label = styled(experiment, run, target)
        keep = range(0, len(s.time), max(1, len(s.time) // 200))
        shown = [(s.time[k], s.initial + s.change[k]) for k in keep]
        gap = max(1, len(shown) // 6)
        sheet.method(axes, *zip(*shown), look, label, markevery=(n * gap // len(pairs), gap))
    finite = [s for _, s in pairs if math.isfinite(s.initial)]
    backward, forward = (max, min) if expected == "decreasing" else (min, max)
    start = backward((s.initial for s in finite), default=math.nan)
    ends = [s.initial + forward(x for x in s.change if math.isfinite(x)) for s in finite]
    if ends and forward(start, statistics.median(ends)) != start:  # a method that exploded leaves the frame
        low, high = sorted((start, statistics.median(ends)))
        axes.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))
    time_axis(axes, 0, max(s.time[-1] for _, s in pairs))


def limits(tracks, frame):
    """[(low, high)] of both axes: of all tracks (x, y) but those that leave the middle one by `frame` of its widths."""
    found = []
    for k in (0, 1):
        spans = sorted((min(t[k]), max(t[k])) for t in tracks)
        low, high = spans[len(spans) // 2]
        size = frame * ((high - low) or 1)
        kept = [s for s in spans if s[0] >= low - size and s[1] <= high + size]
        found.append((min(s[0] for s in kept), max(s[1] for s in kept)))
    return found
