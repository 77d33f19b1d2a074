"""Logarithmic axes for errors: where they end, where zero goes, where an explosion ends, which ticks are labelled; and envelopes.

Zero has no place on a logarithmic axis: it is drawn on a line of its own below the smallest positive value, labelled 0, or at
the level below which nothing is drawn. Values far above everything useful (a method that exploded) leave the frame at the top.
"""
import bisect
import math

import matplotlib

EXPLOSION = 1e4  # values above this times max(1, the smallest of the lines' maxima) leave the frame
NEAR = 1e3  # a level that is below all errors by more than this is not shown
MANY = 20  # values of a line, of which the smallest tenth may leave the frame
MARGIN = 0.04  # of the decades between the ends of an axis
TICK_GAP = 9  # pixels between the labels of neighbouring ticks
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power_of_ten(k):
    """The label of a tick: plain characters, which take a tenth of the time of a formula, unless the style asks for one."""
    if matplotlib.rcParams["axes.formatter.use_mathtext"]:
        return f"$10^{{{k}}}$"
    return "10" + str(k).translate(SUPERSCRIPTS)


def positive(values):
    return [v for v in values if v > 0 and math.isfinite(v)]


class ErrorAxis:
    """The y axis for several lines of errors >= 0 and a level (round-off) that is to be seen where errors come near it.

    Of a long line the smallest tenth does not move the lower end: what an error is after its first steps, and where it passes zero, would
    leave most of the panel empty. With `bounded` nothing is drawn below the level, as of errors that are over the size of what they are of,
    where less than round-off says nothing."""

    def __init__(self, lines, level=None, explosion=EXPLOSION, bounded=False):
        self.level, self.bounded = level, bounded
        tops = [max(p) for p in map(positive, lines) if p]
        limit = explosion * max(1.0, min(tops)) if tops else 1.0
        every = [v for line in lines for v in line if not math.isnan(v)]
        self.clipped, self.zeros = any(v > limit for v in every), not bounded and any(v == 0 for v in every)
        self.raised = bounded and any(v < level for v in every)
        shown = [[v for v in positive(map(self.raise_to_level, line)) if v <= limit] for line in lines]
        ends = [x for values in shown if values for x in (least(values), max(values))] or [level or 1e-16]
        self.seen = bool(level) and level * NEAR >= min(ends)
        low, high = (math.log10(pick(ends + [level] * self.seen)) for pick in (min, max))
        self.low, self.high = low - MARGIN * (high - low), high + MARGIN * (high - low)
        if math.floor(self.high) - math.ceil(self.low) < 1:  # no two ticks
            self.low, self.high = math.floor(low - MARGIN), max(math.ceil(high + MARGIN), math.floor(low - MARGIN) + 1)
        self.stride = math.ceil((self.high - self.low) / 7)
        self.floor = 10.0 ** (self.low - 0.6 * self.stride)
        bottom = self.floor if self.zeros else 10.0**self.low
        self.cut = any(0 < v < bottom for line in lines for v in map(self.raise_to_level, line))

    def raise_to_level(self, value):
        return self.level if self.bounded and value < self.level else value

    def place(self, values):
        """The values with zeros moved to the line for zero, and there with what is too small to be in the frame; what is not a number
        leaves a gap."""
        return [self.floor if self.zeros and 0 <= v < self.floor else v if math.isfinite(v) else math.nan
                for v in map(self.raise_to_level, values)]

    def apply(self, axes):
        axes.set_yscale("log")
        powers = list(range(math.floor(self.high), math.ceil(self.low) - 1, -self.stride))
        ticks, labels = [10.0**k for k in powers], [power_of_ten(k) for k in powers]
        bottom = 10.0**self.low
        if self.zeros:
            bottom = self.floor * 10.0 ** (-0.3 * self.stride)
            ticks.append(self.floor)
            labels.append("≈ 0" if self.cut else "0")
        axes.set_yticks(ticks, labels)
        axes.set_yticks([], minor=True)
        axes.set_ylim(bottom, 10.0**self.high)

    def remarks(self, of_level=True):
        """What a reader must know of it, in sentences; without `of_level` not whether the level is seen."""
        small = "Zeros, and what is too small to be in the frame, are drawn on the line labelled ≈ 0."
        return (([small if self.cut else "Exact zeros are drawn on the line labelled 0."] if self.zeros else [])
                + (["Nothing is drawn below unit round-off."] if self.raised else [])
                + (["The smallest values leave the frame at the bottom."] if self.cut and not self.zeros else [])
                + (["Values far beyond the rest leave the frame at the top."] if self.clipped else [])
                + (["Unit round-off is below the frame."] if of_level and self.level and not self.seen else []))


def remarks_of(axes):
    """What a reader must know of several axes, each once; of the level where none of them shows it."""
    return list(dict.fromkeys(r for axis in axes for r in axis.remarks(of_level=not any(one.seen for one in axes))))


def least(values):
    """The smallest value, of many that which a tenth are below."""
    return sorted(values)[len(values) // 10 if len(values) >= MANY else 0]


def time_axis(axes, begin, end):
    """Logarithmic over two decades or more, otherwise (and for begin = 0) linear."""
    if not logarithmic(begin, end):
        axes.set_xlim(0, 1.02 * end if end > 0 else 1)
        axes.locator_params(axis="x", nbins=5)
        return
    low, high = math.ceil(math.log10(begin) - 1e-9), math.floor(math.log10(end) + 1e-9)
    log_ticks(axes, range(low, high + 1, max(1, math.ceil((high - low) / 5))))
    axes.set_xlim(begin / 1.1, end * 1.1)


def logarithmic(begin, end):
    return begin > 0 and end / begin >= 100


def log_ticks(axes, powers):
    axes.set_xscale("log")
    axes.set_xticks([10.0**k for k in powers], [power_of_ten(k) for k in powers])
    axes.set_xticks([], minor=True)


def step_axis(axes, steps, width_of):
    """A logarithmic x axis that labels the steps themselves, as many as have room; `width_of` a label, in pixels."""
    steps = sorted(set(steps))
    span = math.log(steps[-1] / steps[0]) or 1.0
    around = 0.06  # of the span, on either side
    pixels = axes.get_window_extent().width / (1 + 2 * around)
    labelled, free_from = [], -math.inf
    for h in steps:
        at, half = pixels * math.log(h / steps[0]) / span, width_of(f"{h:.3g}") / 2
        if at - half >= free_from:
            labelled.append(h)
            free_from = at + half + TICK_GAP
    axes.set_xscale("log")
    axes.set_xticks(labelled, [f"{h:.3g}" for h in labelled])
    axes.set_xticks([], minor=True)
    axes.set_xlim(steps[0] * math.exp(-around * span), steps[-1] * math.exp(around * span))


def envelope(times, values, linear=False):
    """(times, values): the largest value in each of 80 parts of the time after 0, where it occurs.

    Parts are equal in log t where a time axis over them is logarithmic; in linear time they hold ten samples or more
    on average, so that residuals which are zero now and then still make a line. Few samples are returned as they are.
    """
    points = [(t, v) for t, v in zip(times, values) if t > 0 and not math.isnan(v)]
    bins = min(80, max(10, len(points) // 10)) if linear else 80
    if len(points) <= bins:
        return [t for t, _ in points], [v for _, v in points]
    begin, end = points[0][0], points[-1][0]
    if not linear and logarithmic(begin, end):
        edges = [begin * (end / begin) ** (k / bins) for k in range(1, bins)]
    else:
        edges = [begin + (end - begin) * k / bins for k in range(1, bins)]
    best = {}
    for t, v in points:
        k = bisect.bisect_left(edges, t)
        if k not in best or v > best[k][1]:
            best[k] = (t, v)
    kept = [best[k] for k in sorted(best)]
    return [t for t, _ in kept], [v for _, v in kept]
