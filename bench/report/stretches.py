"""The motion early and late: every step of some stretches of a run, as measures/motion.csv has them, a row of panels for each method
and a column for each stretch, with the exact motion behind. All panels have the same axes; where the motion dies away or grows, the
panels of a column have. Above stand the times of the stretches: over the columns where they are those of all rows, otherwise over each
panel, since a stretch is as long as the method takes for a turn.
"""
import math

from canvas import GREY, INK, Canvas, plain, sizes
from figures import sentences, step_text
from portraits import STEPS, Frame, leaving, outer, outside, panels
from recording import finite
from scales import power_of_ten
from series import split_unit

MEASURE = "motion"  # whose table it draws
ROWS = 4  # of panels
ROUND = 96  # points of a curve at least
OWN = 4  # by this factor the motion is smaller in one column than in another where each has axes of its own


class Followed:
    """The stretches of one method: {number: (times, xs, ys, exact xs, exact ys)}. The exact motion has more points, those between."""

    def __init__(self):
        self.step, self.axes, self.stretches = math.nan, ("", ""), {}

    def add(self, cells):
        self.step, self.axes = cells["step"], (cells["x axis"], cells["y axis"])
        stretch = self.stretches.setdefault(int(cells["stretch"]), ([], [], [], [], []))
        for values, name in zip(stretch, ("t", "x", "y")):
            values.append(cells[name])
        for values, name in zip(stretch[3:], ("exact_x", "exact_y")):
            values += cells[f"{name}_between"], cells[name]


def followed(verdict):
    """{method: Followed}"""
    found = {}
    for _, cells in verdict.experiment.table(MEASURE, verdict.case):
        found.setdefault(cells["method"], Followed()).add(cells)
    return {label: one for label, one in found.items() if any(len(s[0]) > 2 for s in one.stretches.values())}


def rows_of(found, rows):
    """Of the rows of a verdict those that are drawn: with several stretches as many of the first as of the last ones, which differ most."""
    rows = [row for row in rows if row.label in found]
    several = any(len(found[row.label].stretches) > 1 for row in rows)
    return rows[:ROWS // 2] + rows[max(ROWS // 2, len(rows) - ROWS // 2):] if several else rows


def draw(found, rows, wide, time_unit=""):
    """Of {method: Followed} those of the rows of a verdict, on a Canvas."""
    shown = [(row, found[row.label]) for row in rows]
    (names, units) = zip(*map(split_unit, shown[0][1].axes))
    if all(len(one.stretches) == 1 for _, one in shown):  # side by side
        whole = [next(iter(one.stretches.values())) for _, one in shown]
        spans = [span(stretch[0], time_unit) for stretch in whole]
        titles = [row.label + ("" if len(set(spans)) == 1 else f", {when}") for (row, _), when in zip(shown, spans)]
        tracks = [(title, row.curve.family.light, *finite(*stretch[1:3])) for title, (row, _), stretch in zip(titles, shown, whole)]
        return panels(tracks, names, units, wide, [finite(*stretch[3:]) for stretch in whole], every_step=True)
    look = sizes(wide)
    chosen = [some_of(sorted(one.stretches), look.wide) for _, one in shown]
    columns = max(map(len, chosen))
    frames, own = frames_of(shown, chosen, units)
    left, top, right, below, between = (x * look.unit for x in (72 if look.wide else 56, 24, 14, 46, 38 if own else 12))
    each = min(200 * look.unit, (look.width - left - right - between * (columns - 1)) / columns)
    tall = frames[0].height(each)
    for frame in frames:
        frame.fill(each, tall)
    powers = [power_of(frame) if own else 0 for frame in frames]
    multiples = [f"\naxes in {power_of_ten(power)}" if power else "" for power in powers]
    times = [[span(one.stretches[number][0], time_unit) for number in numbers] for (_, one), numbers in zip(shown, chosen)]
    alike = all(len({of[c] for of in times if c < len(of)}) == 1 for c in range(columns))
    heading = (18 + 15 * any(powers)) * look.unit
    line = 0 if alike else heading  # between a name and its panels, where their times stand
    head = heading + 6 * look.unit if alike else 0
    canvas = Canvas(left + columns * (each + between) - between + right, head + len(shown) * (top + line + tall) + below, look.font, look.unit)
    for k, (row, one) in enumerate(shown):
        colour = row.curve.family.light
        for column, number in enumerate(chosen[k]):
            axes = canvas.panel(left + column * (each + between), head + k * (top + line + tall) + top + line, each, tall)
            axes.grid(False)
            frames[column].apply(axes, 3)
            outer(canvas, axes, names, units, last=all(column >= len(of) for of in times[k + 1:]), first=column == 0)
            if own:
                axes.tick_params(labelleft=True)
                for axis in (axes.xaxis, axes.yaxis):
                    axis.set_major_formatter(in_multiples(powers[column]))
            if column == 0:
                axes.set_title(plain(row.label), fontsize=0.95 * look.font, color=colour, loc="left", pad=4 * look.unit + line)
            _, x, y, exact_x, exact_y = one.stretches[number]
            axes.plot(*round_track(*finite(exact_x, exact_y)), color=GREY, linewidth=2.6 * look.unit, alpha=0.6, zorder=1)
            told, first = times[k][column], all(column >= len(of) for of in times[:k])
            canvas.line(axes, *finite(x, y), f"{row.label}, {told}", color=colour, **STEPS)
            if first or not alike:
                above = told + multiples[column]
                room = each + min(between, right)
                box, size = axes.get_window_extent(), min(0.92, 0.92 * room / canvas.measure(above, 0.92)[0])
                canvas.write(axes, box.x0, box.y1 + (top + k * (top + tall) if alike else 5 * look.unit), above, size, color=INK)
    return canvas


def round_track(x, y):
    """A track of few points as a curve through them, of cubics whose slopes are those of the neighbours."""
    count = math.ceil(ROUND / max(1, len(x)))
    if len(x) < 4 or count == 1:
        return x, y

    def through(v):
        ends = [2 * v[0] - v[1], *v, 2 * v[-1] - v[-2]]
        curve = [0.5 * (2 * b + (c - a) * s + (2 * a - 5 * b + 4 * c - d) * s * s + (3 * b - a - 3 * c + d) * s**3)
                 for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:]) for s in (k / count for k in range(count))]
        return [*curve, v[-1]]
    return through(x), through(y)


def frames_of(shown, chosen, units):
    """The frame of each column, and whether each has its own."""
    columns = columns_of(shown, chosen)
    own = [Frame([t[1:] for t in tracks] or exact, units, exact) for tracks, exact in columns if tracks or exact]
    if len(own) == len(columns) and any(max(of) > OWN * min(of) for of in zip(*(frame.span for frame in own))):
        return own, True
    return [Frame(tracks_of(shown), units, [track for _, exact in columns for track in exact])] * len(columns), False


def columns_of(shown, chosen):
    """Of each column the tracks [(label, xs, ys)] of the methods, and those of the exact motion [(xs, ys)], as far as they are numbers."""
    found = []
    for column in range(max(map(len, chosen))):
        stretches = [(row.label, one.stretches[numbers[column]]) for (row, one), numbers in zip(shown, chosen) if column < len(numbers)]
        tracks, exact = ([(label, *finite(*s[1:3])) for label, s in stretches], [finite(*s[3:]) for _, s in stretches])
        found.append(([track for track in tracks if len(track[1])], [track for track in exact if len(track[0])]))
    return found


def power_of(frame):
    """The power of ten in which numbers of a frame are short; 0 for one in which they need none, or of numbers that no axis can show."""
    power = math.floor(math.log10(max(abs(x) for begin, size in zip(frame.begin, frame.span) for x in (begin, begin + size))))
    return power if 2 < abs(power) < 300 else 0


def in_multiples(power):
    """Numbers beside an axis, in multiples of that power of ten."""
    return lambda value, _: f"{value / 10.0**power:.3g}".replace("-", "\N{MINUS SIGN}")


def some_of(numbers, wide):
    """On a narrow screen the first, the one in the middle and the last."""
    return numbers if wide or len(numbers) < 4 else [numbers[0], numbers[len(numbers) // 2], numbers[-1]]


def span(times, unit):
    """From when to when a stretch is, in words."""
    return f"t = {times[0]:.6g} to {times[-1]:.6g} {unit}".rstrip()


def tracks_of(shown):
    """[(xs, ys)] of all stretches of a method together: what leaves the frame is a method, not a late stretch."""
    return [tuple(sum((list(finite(*s[1:3])[k]) for s in one.stretches.values()), []) for k in (0, 1)) for _, one in shown]


def told(verdict, found, rows):
    """What stands below, in sentences."""
    shown = [(row, found[row.label]) for row in rows]
    steps = {one.step for _, one in shown}
    several = any(len(one.stretches) > 1 for _, one in shown)
    spans = {span(s[0], verdict.case.get("time_unit") or "") for _, one in shown for s in one.stretches.values()}
    exact = any(math.isfinite(v) for _, one in shown for s in one.stretches.values() for v in s[3])
    chosen = [sorted(one.stretches) for _, one in shown]
    own = several and frames_of(shown, chosen, [split_unit(axis)[1] for axis in shown[0][1].axes])[1]
    columns = columns_of(shown, chosen)
    astray = {label for tracks, of_column in columns for label in outside(tracks, of_column)} if own else ()
    return sentences(
        "Every step of the run, early and late: a stretch is one turn of the track, as far as it turns." if several else
        f"Every step of the run from its start{', ' + spans.pop() if len(spans) == 1 else ''}.",
        "Points are the steps.",
        f"At {step_text(steps.pop(), verdict.case)}." if len(steps) == 1 else "At the largest step at which each method finishes.",
        "Behind, in grey, the exact motion at the same times and between them." if exact else "",
        "Axes are the same in the panels of a column, in multiples of the power of ten above it." if own else
        "Axes are the same in all panels." if several or len(shown) > 1 else "",
        leaving([row.label for row, _ in shown if row.label in astray], " of some columns") if own else
        leaving(outside([(row.label, *track) for (row, _), track in zip(shown, tracks_of(shown))],
                        [track for _, of_column in columns for track in of_column])))
