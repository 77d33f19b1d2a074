"""Work and precision of a case: the error of every run against what it cost, a line for each method over its steps.

At most LINES lines have the colour of their family and a name in the margin to which they are joined, and all of their runs are in
the frame; the rest is grey and behind them. Shaded: the Pareto front, which is what no other run beats in both cost and error, the
latter by a tenth; the band in which the phase is lost; and the band in which round-off rules. The fan of slopes says how steep an
order is where cost goes with 1/h.
"""
import math

from canvas import BAND, FRONT, GREY, MID, Canvas, sizes
from curves import LOST, ZERO, curves, front, ranks
from error_measure import some_rows
from families import style
from first_screen import finding
from figures import Drawing, heading, sentences, step_text, with_unit
from labels import SIZE, right_of, sampled, shown
from scales import power_of_ten
from wording import counted, listed, plain_text, short_count, short_time, tick_time

PLACES = 16  # along a band at which its name may stand
CLIPPED = 4.0  # where relative errors end: what is above says the same, that all is lost


def drawings(verdict):
    """The drawing against time and, where every method counts them, that against right-hand sides."""
    if not verdict.comparable or not any(p.error > 0 for c in verdict.curves for p in c.measured()):
        return []
    out = [drawing(verdict, verdict.work, verdict.curves)]
    finished = [r for r in verdict.experiment.runs_of(verdict.case) if not r.failed]
    if verdict.work == "time" and all(r.total_rhs > 0 for r in finished):
        work = "right-hand sides"
        out.append(drawing(verdict, work, curves(verdict.experiment, verdict.case, work)))
    return out


def drawing(verdict, work, some):
    case = verdict.case
    some = [c for c in some if c.measured()]
    named = [n for n in verdict.named() if n in {c.label for c in some}]
    grey = [c.label for c in some if c.label not in named]
    failed = [f"{r.method} at {step_text(r.step, case)}" for r in verdict.experiment.runs if r.case == case["name"] and r.failed]
    contended, timed = verdict.contended
    caption = sentences(
        f"Errors are those of {verdict.measure.name}, relative to its value at the start." if verdict.measure.kind == "quantity"
        else "",
        f"Errors are the largest{some_rows(case)}." if verdict.of_state and case.get("error_rows") else "",
        "Down and to the left is better: a point is a run, along a line the step becomes smaller.",
        "Shaded in yellow: the Pareto front, on which a run has an error smaller by a tenth or more than every cheaper one.",
        f"Band at the top: error of at least {LOST}, the phase is lost." if verdict.of_state and any(
            p.error >= LOST for c in some for p in c.points) else "",
        "Whiskers run from the fastest repetition to the median." if work == "time" else "",
        f"{contended} of {timed} timings were disturbed (median over 1.3 times the fastest)." if work == "time" and contended
        else "",
        f"Steps of {named[0]}: {', '.join(step_label(p.run) for c in some if c.label == named[0] for p in c.measured())}." if named else "",
        f"In grey: {listed(grey)}." if grey else "",
        "Longer runs leave the frame on the right." if any(p.cost > longest(some, named) for c in some for p in c.measured()) else "",
        f"Not drawn, because they failed: {listed(failed)}." if len(failed) <= 4 and failed else
        f"{counted(len(failed), 'run')} failed and {'is' if len(failed) == 1 else 'are'} not drawn." if failed else "",
        "Errors of zero stand at a tenth of round-off." if any(
            p.error == ZERO * verdict.unit for c in some for p in c.points) else "")
    kind = "work_precision" if work == verdict.work else "work_precision_" + work.replace("right-hand sides", "evaluations")
    return Drawing(kind, case, f"{heading(case)}: work and precision", caption,
                   lambda wide: draw(verdict, work, some, named, wide), work, printed=True)


def frame_of(wide, names):
    """(Canvas, its one panel, which leaves room for the names, sizes): 704 pixels on a wide screen, beside which a table stands."""
    look = sizes(wide)
    look = look._replace(width=704) if wide is True else look
    tall = 520 if wide is True else look.width * (0.81 if wide is not False else 1.05)
    canvas = Canvas(look.width, tall, look.font, look.unit if look.wide or wide is False else 0.6)
    left, top, bottom, gap = (x * look.unit for x in (70 if wide is True else 60, 14, 46, 30))
    right = max((canvas.measure(shown(canvas, name, "bold"), SIZE, "bold")[0] for name in names), default=0) + gap
    return canvas, canvas.panel(left, top, look.width - left - right, tall - top - bottom)


def draw(verdict, work, some, named, wide):
    lost = [f"✗ {row.label}" for row in verdict.rows if row.curve.failed and not row.curve.points]
    canvas, axes = frame_of(wide, [*named, *lost])
    look = canvas
    canvas.description = plain_text(finding(verdict))
    low, high = frame(verdict, axes, some, named)
    rank = ranks(some)
    show = short_time if work == "time" else short_count

    axes.plot([p.cost for p in front(some)], clipped(verdict, [p.error for p in front(some)]), color=FRONT,
              linewidth=13 * look.scale, solid_capstyle="round", solid_joinstyle="round", zorder=1)
    for curve in sorted(some, key=lambda c: c.label in named):
        colour = curve.label in named
        shown = style(curve.family, rank[curve.label], curve.fill)
        shown |= {"linewidth": 1.7, "markersize": 5.5, "zorder": 4}
        if not colour:
            shown |= {"color": GREY, "markeredgecolor": GREY, "linewidth": 0.9, "markersize": 3.4,
                      "linestyle": "-", "zorder": 3} | ({"markerfacecolor": GREY} if curve.fill == "full" else {})
        points = curve.measured()
        costs, errors = [p.cost for p in points], clipped(verdict, [p.error for p in points])
        told = f"{curve.label}: " + "; ".join(
            f"{size_of(p.run)}, error {p.error:.1e}, {show(p.cost)}" for p in points)
        canvas.line(axes, costs, errors, told, **shown)
        if work == "time" and colour:
            for p, e in zip(points, errors):
                axes.plot([p.cost, p.slowest], [e, e], color=shown["color"], linewidth=0.7 * look.scale, zorder=2)
    words = {"time": "time of the run", "right-hand sides": "right-hand sides of the run", "steps": "steps of the run"}
    unit = "" if verdict.relative else verdict.experiment.expectation(verdict.case, verdict.invariant)[1]
    canvas.labels(axes, words[work], with_unit(verdict.measure.axis, unit))
    ticks(canvas, axes, work)
    annotate(canvas, axes, verdict, some, named, lost, (low, high))
    return canvas


def size_of(run):
    return f"tolerance {run.tolerance}" if run.tolerance else f"h = {run.step:.4g}"


def clipped(verdict, errors):
    return [min(e, CLIPPED) for e in errors] if verdict.relative else errors


def frame(verdict, axes, some, named):
    """Set the axes: decades of error, and costs up to all runs with a name and the third quartile of the longest runs."""
    errors = [e for c in some for p in c.measured() for e in clipped(verdict, [p.error])]
    low = 10.0 ** math.floor(math.log10(min(errors)) - 0.3)
    high = 2 * CLIPPED if verdict.of_state and max(errors) > LOST / 2 else 10.0 ** math.ceil(math.log10(max(errors)) + 0.1)
    begin = min(p.cost for c in some for p in c.measured())
    axes.set(xscale="log", yscale="log", xlim=(begin / 1.35, longest(some, named)), ylim=(low, high))
    return low, high


def longest(some, named):
    """The cost at which the axis ends."""
    ends = sorted(max(p.cost for p in c.measured()) for c in some)
    kept = max(ends[(3 * len(ends) - 1) // 4], *(p.cost for c in some if c.label in named for p in c.measured()))
    return 1.35 * max(kept, max(p.cost for p in front(some)))


def ticks(canvas, axes, work):
    low, high = axes.get_ylim()
    powers = [k for k in range(math.ceil(math.log10(low)), math.floor(math.log10(high)) + 1)]
    stride = 3 if len(powers) > 7 else 2 if len(powers) > 5 else 1
    some = [k for k in powers if k % stride == 0]
    axes.set_yticks([10.0**k for k in some], ["1" if k == 0 else power_of_ten(k) for k in some])
    axes.set_yticks([], minor=True)
    low, high = axes.get_xlim()
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    show = tick_time if work == "time" else short_count
    decade = axes.get_window_extent(canvas.renderer).width / math.log10(high / low)

    def have_room(at):
        widest = max((canvas.measure(show(x), 0.92)[0] for x in at), default=0) + 0.6 * canvas.font
        return all(decade * math.log10(b / a) >= widest for a, b in zip(at, at[1:]))
    for steps in ((1, 2, 5), (1, 3), (1,)):
        at = [m * 10.0**k for k in decades for m in steps if low <= m * 10.0**k <= high]
        if have_room(at):
            break
    at = next(some for k in range(1, len(at) + 2) if have_room(some := at[::-k][::-1]))
    axes.set_xticks(at, [show(x) for x in at])
    axes.set_xticks([], minor=True)
    for label in axes.get_xticklabels():  # the last one may stand at the edge of the figure
        if label.get_window_extent(canvas.renderer).x1 > canvas.width:
            label.set_horizontalalignment("right")


def annotate(canvas, axes, verdict, some, named, lost, limits):
    """Bands, the fan of orders, and names in the margin."""
    small = 0.88
    to_pixels = axes.transData.transform
    box = axes.get_window_extent(canvas.renderer)
    every = [pixel for c in some for pixel in sampled([tuple(to_pixels(xy)) for xy in zip(
        [p.cost for p in c.measured()], clipped(verdict, [p.error for p in c.measured()]))])]
    if verdict.of_state and limits[1] > LOST:
        axes.axhspan(LOST, limits[1], color=BAND, zorder=0, linewidth=0)
        band_text(canvas, "phase lost", box, "top", small, every)
    floor = verdict.floor()
    if limits[0] < floor:
        axes.axhspan(limits[0], floor, color=BAND, zorder=0, linewidth=0)
        band_text(canvas, "round-off", box, "bottom", small, every)
    if verdict.relative:
        order_fan(canvas, axes, box, every, small)
    ends = []
    for curve in some:
        if curve.label in named:
            last = curve.measured()[-1]
            ends.append((curve.label, last.cost, clipped(verdict, [last.error])[0], curve.family.light, ""))
    right_of(canvas, axes, ends + [(name, axes.get_xlim()[1], limits[1], MID, "") for name in lost], "bold")


def step_label(run):
    return f"~{run.tolerance}" if run.tolerance else f"{run.step:.4g}"


def band_text(canvas, text, box, side, small, every):
    """What a band at the top or the bottom means, at that end of it which fewer lines cross, or between them where fewer still do."""
    width, height = canvas.measure(text, small)
    low = box.y1 - 3 - height if side == "top" else box.y0 + 2
    left, right = box.x0 + 4, box.x1 - 4 - width
    places = [left, right, *(left + (right - left) * k / PLACES for k in range(1, PLACES))]
    found = min(((x - 2, low - 2, x + width + 2, low + height + 2) for x in places), key=lambda place: inside(every, place))
    canvas.write(canvas.axes[0], found[0] + 2, low, text, small, color=MID, va="bottom", ha="left")


def inside(points, box):
    return sum(box[0] <= x <= box[2] and box[1] <= y <= box[3] for x, y in points)


def order_fan(canvas, axes, box, every, small):
    """Slopes of the orders 2, 4 and 8, in the lower left, where there is room for them."""
    decade = [(box.x1 - box.x0) / math.log10(axes.get_xlim()[1] / axes.get_xlim()[0]),
              (box.y1 - box.y0) / math.log10(axes.get_ylim()[1] / axes.get_ylim()[0])]
    width = min(0.11 * (box.x1 - box.x0), 0.24 * (box.y1 - box.y0) / (8 * decade[1] / decade[0]))
    drop = width * decade[1] / decade[0]
    line = canvas.measure("order", small)[1]
    need = (max(width + 22, 44), 8 * drop + 2.2 * line)
    for part in (0.62, 0.5, 0.42, 0.34, 0.27):
        x, top = box.x0 + 14, box.y0 + part * (box.y1 - box.y0)
        area = (x - 4, top - need[1], x + need[0], top)
        if area[1] < box.y0 + 24 or any(area[0] <= a <= area[2] and area[1] <= b <= area[3] for a, b in every):
            continue
        canvas.write(axes, x, top - line, "order", small, color=MID, va="bottom")
        y = top - 1.4 * line
        last = math.inf
        canvas.leader((x, y), (x + width, y), MID)
        for order in (2, 4, 8):
            canvas.leader((x, y), (x + width, y - order * drop), MID)
            last = min(y - order * drop, last - 0.8 * line)
            canvas.write(axes, x + width + 4, last, str(order), small, color=MID, va="center")
        return
