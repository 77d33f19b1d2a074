"""Tracks of a motion side by side, a panel for each method: portrait in the plane of two coordinates, or section.

All panels have the same axes. A track whose samples lie far apart is drawn as points, because lines between them would be
chords of a curve that nobody sees.
"""
import math

from canvas import GREY, INK, Canvas, plain, sizes
from figures import limits, sentences, with_unit
from recording import coarse
from wording import listed

FRAME = 1.5  # a track that leaves the middle one by this many of its widths leaves the frame
SHOWN = 4000  # points of a track at most


def widened(begin, size, least):
    """(begin, size) of an interval of at least that size, with the same middle."""
    return (begin, size) if size >= least else (begin - (least - size) / 2, least)


class Frame:
    """The axes that all panels have: of tracks [(xs, ys)], but those that leave the exact ones, or the middle one."""

    def __init__(self, tracks, units, exact=()):
        frame = limits(tracks, FRAME, exact)
        self.equal = units[0] == units[1]
        pads = [0.06 * ((high - low) or 1) for low, high in frame]
        self.begin = [low - pad for (low, _), pad in zip(frame, pads)]
        self.span = [high - low + 2 * pad for (low, high), pad in zip(frame, pads)]

    def height(self, width):
        """Of a panel of that width, which the frame then fills."""
        if not self.equal:
            return 0.8 * width
        tall = min(1.25 * width, max(0.45 * width, width * self.span[1] / self.span[0]))
        self.fill(width, tall)
        return tall

    def fill(self, width, tall):
        """Where both axes have one unit, a circle is a circle in a panel of this size: the frame is widened to fill it."""
        if self.equal:
            for k, least in ((0, self.span[1] * width / tall), (1, self.span[0] * tall / width)):
                self.begin[k], self.span[k] = widened(self.begin[k], self.span[k], least)

    def apply(self, axes, ticks=4):
        axes.set_xlim(self.begin[0], self.begin[0] + self.span[0])
        axes.set_ylim(self.begin[1], self.begin[1] + self.span[1])
        axes.locator_params(nbins=ticks)


STEPS = {"linewidth": 0.9, "marker": ".", "markersize": 3.0, "markeredgewidth": 0}  # of a track that has every step


def panels(tracks, names, units, wide, behind=None, start=True, every_step=False):
    """The tracks [(label, colour, xs, ys)] on a Canvas, each in a panel with the same axes, with its track (xs, ys) of those `behind`;
    sections have no start. What has every step is joined, however far these lie apart."""
    frame, look = Frame([t[2:] for t in tracks], units, joined(behind)), sizes(wide)
    left, top, right, below, between = (x * look.unit for x in (72 if look.wide else 56, 24, 10, 46, 14))
    columns = min(len(tracks), (3 if len(tracks) in (3, 5, 6) else 4) if look.wide else 2)
    most = (340 if wide else 300) if isinstance(wide, bool) else look.width  # on paper a figure is as wide as was asked for
    each = min(most, (look.width - left - right - between * (columns - 1)) / columns)
    tall, rows = frame.height(each), math.ceil(len(tracks) / columns)
    canvas = Canvas(left + columns * each + between * (columns - 1) + right, rows * (top + tall) + below,
                    look.font, look.unit)
    for k, (label, colour, x, y) in enumerate(tracks):
        row, column = divmod(k, columns)
        axes = canvas.panel(left + column * (each + between), top + row * (top + tall), each, tall)
        axes.grid(False)
        step = max(1, len(x) // SHOWN)
        alone = {"linestyle": "none", "marker": ".", "markersize": 2.2, "markeredgewidth": 0}
        style = STEPS if every_step else alone if not start or coarse(x, y) else {"linewidth": 0.9}
        canvas.line(axes, x[::step], y[::step], label, color=colour, **style)
        if behind and len(behind[k][0]) > 1:
            axes.plot(*behind[k], color=GREY, zorder=1, **(
                {"linestyle": "none", "marker": ".", "markersize": 3.5, "markeredgewidth": 0} if coarse(*behind[k]) and not every_step else
                {"linewidth": 3.0 * look.unit, "alpha": 0.55}))
        if start:
            axes.plot(x[:1], y[:1], marker="x", color=INK, markersize=6 * look.unit, markeredgewidth=1.4 * look.unit, zorder=5)
        axes.set_title(plain(label), fontsize=0.95 * look.font, color=colour, loc="left", pad=4 * look.unit)
        frame.apply(axes)
        outer(canvas, axes, names, units, last=k + columns >= len(tracks), first=column == 0)
    return canvas


def joined(behind):
    """Of the tracks behind some, those that have points."""
    return [track for track in behind or () if len(track[0])]


def outer(canvas, axes, names, units, last, first):
    """Axes named and numbered at the edge of the panels alone: in the last row, and in the first column."""
    canvas.labels(axes, with_unit(names[0], units[0]) if last else "", with_unit(names[1], units[1]) if first else "")
    axes.tick_params(labelbottom=last, labelleft=first)


def outside(tracks, exact=()):
    """The labels of the tracks [(label, xs, ys)] that leave the frame of all and of the exact ones [(xs, ys)]."""
    frame = limits([t[1:] for t in tracks], FRAME, exact) if tracks else ()
    return [label for label, *track in tracks
            if any(min(v) < low or max(v) > high for v, (low, high) in zip(track, frame))]


def leaving(labels, which=""):
    """A sentence on the tracks that leave a frame; empty where none does."""
    if not labels:
        return ""
    tracks = f"The track of {labels[0]} leaves" if len(labels) == 1 else f"The tracks of {listed(labels)} leave"
    return f"{tracks} the frame{which}."


def remarks(tracks, units, behind=None):
    """What a reader must know of tracks in panels, in sentences."""
    return sentences("Axes are the same in all panels." if len(tracks) > 1 else "",
                     "Both axes have the same scale." if units[0] == units[1] else "", "A cross marks the start.",
                     "Points are samples that lie too far apart to be joined." if any(coarse(x, y) for *_, x, y in tracks)
                     else "", leaving(outside([(label, x, y) for label, _, x, y in tracks], joined(behind))))
