"""Points and what joins them, as a strip of frames and as an animation.

Shown is the first stretch of a run, as long as the points need to travel a few times the size of their figure: later frames
would have nothing to do with each other. Three dimensions are seen from above and aside: x to the right, z up, y backwards.

The animation is SVG that moves by itself (SMIL), without a script; the page's script stops it for readers who asked for
less motion, and on a click.
"""
import math

from canvas import GREY, INK, MID, PAPER, RULE, Canvas, plain, sizes
from portraits import widened
from wording import number, text

TRAVELS = 5.0  # sizes of the figure that the points travel in what is shown
LEAST = 24  # samples that are shown at least
KEYS = 96  # frames of the animation, at most
NUMBERS = 9000  # numbers in an animation, at most
DEPTH = (0.35, 0.2)  # how far y moves a point to the right and up


class Figure:
    """The points of a run in the plane of the picture, [[(x, y)] of every sample], and what joins them."""

    def __init__(self, recording):
        points = recording.points()
        columns = [[recording.columns[name] for name in point] for point in points]
        flat = len(points[0]) == 2
        self.depth = not flat
        self.unit = recording.units[points[0][0]]
        self.links = [tuple(e if isinstance(e, int) else place(e) for e in pair) for pair in recording.links]
        self.times, self.places = [], []
        for k, t in enumerate(recording.times):
            now = [place([c[k] for c in point]) for point in columns]
            if not all(math.isfinite(v) for p in now for v in p):
                break
            self.times.append(t)
            self.places.append(now)
        self.end = self._stretch()
        del self.times[self.end:], self.places[self.end:]

    def _stretch(self):
        """The number of samples that are shown."""
        if not self.places:
            return 0
        size = max(max(v) - min(v) for v in zip(*self.places[0])) or 1.0
        fixed = [e for pair in self.links for e in pair if not isinstance(e, int)]
        size = max([size, *(math.dist(e, p) for e in fixed for p in self.places[0])])
        way = 0.0
        for k in range(1, len(self.places)):
            way += max(math.dist(a, b) for a, b in zip(self.places[k - 1], self.places[k]))
            if way > TRAVELS * size and k >= LEAST:
                return k + 1
        return len(self.places)

    def box(self):
        """(x, y, width, height) of all that is shown, with a margin."""
        every = [p for now in self.places for p in now] + [e for pair in self.links for e in pair if not isinstance(e, int)]
        (x0, x1), (y0, y1) = ((min(v), max(v)) for v in zip(*every))
        margin = 0.07 * (max(x1 - x0, y1 - y0) or 1.0)
        return x0 - margin, y0 - margin, x1 - x0 + 2 * margin, y1 - y0 + 2 * margin

    def ends(self, pair, k):
        """The two places that a link joins in sample k."""
        return [self.places[k][e] if isinstance(e, int) else e for e in pair]


def place(coordinates):
    """A place in the plane of the picture."""
    if len(coordinates) == 2:
        return coordinates[0], coordinates[1]
    x, y, z = coordinates
    return x + DEPTH[0] * y, z + DEPTH[1] * y


def strip(figure, colour, time_unit, wide):
    """Six frames side by side on a Canvas, with a scale."""
    count = min(6, len(figure.times))
    chosen = [round(k * (len(figure.times) - 1) / max(1, count - 1)) for k in range(count)]
    look = sizes(wide)
    columns = count if look.wide else min(3, count)
    x, y, w, h = figure.box()
    gap, line = 10 * look.unit, 26 * look.unit
    each = look.width / columns - gap
    tall = min(1.6 * each, max(0.4 * each, each * h / w))
    x, w, y, h = *widened(x, w, h * each / tall), *widened(y, h, w * tall / each)  # equal scales fill the frame
    rows = math.ceil(count / columns)
    canvas = Canvas(look.width, rows * (tall + line) + line, look.font, look.unit)
    last = len(figure.places[0]) - 1
    for n, k in enumerate(chosen):
        row, column = divmod(n, columns)
        axes = canvas.panel(gap / 2 + column * (each + gap), 24 * look.unit + row * (tall + line), each, tall)
        axes.set(xlim=(x, x + w), ylim=(y, y + h), xticks=[], yticks=[])
        axes.grid(False)
        for spine in axes.spines.values():
            spine.set_visible(False)
        axes.plot(*zip(*(now[last] for now in figure.places[:k + 1])), color=GREY, linewidth=0.8 * look.unit, zorder=1)
        for pair in figure.links:
            axes.plot(*zip(*figure.ends(pair, k)), color=colour, linewidth=1.8 * look.unit, solid_capstyle="round", zorder=2)
        dots = figure.places[k]
        size = 5.0 if len(dots) < 20 else 3.0 if len(dots) < 60 else 1.8
        axes.plot(*zip(*dots), linestyle="none", marker="o", color=colour, markersize=size * look.unit, markeredgecolor=PAPER,
                  markeredgewidth=0.5 * look.unit, zorder=3)
        for end in {e for pair in figure.links for e in pair if not isinstance(e, int)}:
            axes.plot(*zip(end), marker="s", color=INK, markersize=4 * look.unit, zorder=4)
        axes.set_title(plain(f"t = {number(figure.times[k])} {'' if time_unit == '1' else time_unit}".strip()), fontsize=look.font,
                       color=INK, pad=3 * look.unit)
    ruler(canvas, canvas.axes[0], figure.unit, look.unit)
    return canvas


def ruler(canvas, axes, unit, scale):
    """A scale below the first frame: of 1, 2, 5 times a power of ten the one next to a third of the frame's width."""
    (x0, x1), box = axes.get_xlim(), axes.get_window_extent(canvas.renderer)
    third = (x1 - x0) / 3
    long = max((m * 10.0**math.floor(math.log10(third)) for m in (1, 2, 5)), key=lambda v: -abs(math.log(v / third)))
    pixels = long / (x1 - x0) * box.width
    begin, tick = 12 * scale, 3 * scale
    canvas.leader((begin, begin), (begin + pixels, begin), MID)
    for end in (begin, begin + pixels):
        canvas.leader((end, begin - tick), (end, begin + tick), MID)
    canvas.write(axes, begin + pixels + 2 * tick, begin, f"{long:g} {'' if unit == '1' else unit}".strip(), 0.95, color=MID, va="center")


def duration(figure, time_unit):
    """(seconds that the animation takes, how that compares with the motion, in words)"""
    whole = abs(figure.times[-1] - figure.times[0])
    slow = min(24.0, max(3.0, whole))
    if time_unit != "s":
        return slow, f"{number(slow / whole)} s for a unit of time"
    return slow, ("in true time" if slow == whole else f"{number(slow / whole)} times slower than the motion" if slow > whole
                  else f"{number(whole / slow)} times faster than the motion")


class Animation:
    """An SVG that moves; drawn for the page, and as a file of its own."""

    def __init__(self, figure, colour, variable, said, seconds):
        self.figure, self.colour, self.variable, self.said, self.seconds = figure, colour, variable, said, seconds

    def svg(self, prefix, coloured=False):
        figure = self.figure
        x, y, w, h = figure.box()
        scale = 460 / max(w, h)

        def at(p):
            return f"{(p[0] - x) * scale:.0f} {(y + h - p[1]) * scale:.0f}"
        joined = 4 * len(figure.links) + 2 * len(figure.places[0])
        count = max(2, min(KEYS, len(figure.times), NUMBERS // joined))
        keys = [round(k * (len(figure.times) - 1) / (count - 1)) for k in range(count)]
        rods = [" ".join(f"M{at(a)}L{at(b)}" for a, b in (figure.ends(pair, k) for pair in figure.links)) for k in keys]
        dots = [" ".join(f"M{at(p)}h0" for p in figure.places[k]) for k in keys]
        colour, ink, rule = ((self.colour, INK, RULE) if coloured else
                             (f"var(--{self.variable})", "var(--ink)", "var(--rule)"))
        times = ";".join(f"{(figure.times[k] - figure.times[0]) / (figure.times[-1] - figure.times[0]):.4g}" for k in keys)

        def moving(shapes, width):
            if not shapes[0]:
                return ""
            return (f'<path d="{shapes[0]}" fill="none" stroke="{colour}" style="stroke-width:{width};stroke-linecap:round">'
                    f'<animate attributeName="d" dur="{self.seconds:.4g}s" repeatCount="indefinite" keyTimes="{times}" '
                    f'values="{";".join(shapes)}"/></path>')
        size = 11 if len(figure.places[0]) < 20 else 7 if len(figure.places[0]) < 60 else 4
        fixed = "".join(f'<path d="M{at(e)}h0" fill="none" stroke="{ink}" style="stroke-width:8;stroke-linecap:square"/>'
                        for e in sorted({e for pair in figure.links for e in pair if not isinstance(e, int)}))
        return (f'<svg xmlns="http://www.w3.org/2000/svg" id="{prefix}" class="moving" tabindex="0" role="img" '
                f'width="{w * scale:.0f}" height="{h * scale:.0f}" viewBox="0 0 {w * scale:.0f} {h * scale:.0f}">'
                f"<title>{text(self.said)}</title><rect width=\"100%\" height=\"100%\" fill=\"none\" stroke=\"{rule}\"/>"
                f"{moving(rods, 3)}{fixed}{moving(dots, size)}</svg>")
