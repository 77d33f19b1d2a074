"""Tracks of a motion side by side, a panel for each method: portrait in the plane of two coordinates, or section.

All panels have the same axes. A track whose samples lie far apart is drawn as points, because lines between them would be
chords of a curve that nobody sees.
"""
import math

from canvas import GREY, INK, Canvas, plain, sizes
from figures import limits, sentences, with_unit
from recording import coarse

FRAME = 1.5  # a track that leaves the middle one by this many of its widths leaves the frame
SHOWN = 4000  # points of a track at most


def widened(begin, size, least):
    """(begin, size) of an interval of at least that size, with the same middle."""
    return (begin, size) if size >= least else (begin - (least - size) / 2, least)


def panels(tracks, names, units, wide, behind=None, start=True):
    """The tracks [(label, colour, xs, ys)] on a Canvas, each in a panel with the same axes, with the track (xs, ys) `behind`; sections
    have no start."""
    frame = limits([t[2:] for t in tracks], FRAME)
    equal = units[0] == units[1]
    pads = [0.06 * ((high - low) or 1) for low, high in frame]
    spans = [high - low + 2 * pad for (low, high), pad in zip(frame, pads)]
    look = sizes(wide)
    left, top, right, below, between = (x * look.unit for x in (72 if look.wide else 56, 24, 10, 46, 14))
    columns = min(len(tracks), (3 if len(tracks) in (3, 5, 6) else 4) if look.wide else 2)
    most = (340 if wide else 300) if isinstance(wide, bool) else look.width  # on paper a figure is as wide as was asked for
    each = min(most, (look.width - left - right - between * (columns - 1)) / columns)
    tall = min(1.25 * each, max(0.45 * each, each * spans[1] / spans[0])) if equal else 0.8 * each
    low = [bounds[0] - pad for bounds, pad in zip(frame, pads)]
    if equal:  # the frame is filled, so that a circle is a circle
        (low[0], spans[0]), (low[1], spans[1]) = (widened(low[0], spans[0], spans[1] * each / tall),
                                                  widened(low[1], spans[1], spans[0] * tall / each))
    rows = math.ceil(len(tracks) / columns)
    canvas = Canvas(left + columns * each + between * (columns - 1) + right, rows * (top + tall) + below,
                    look.font, look.unit)
    for k, (label, colour, x, y) in enumerate(tracks):
        row, column = divmod(k, columns)
        axes = canvas.panel(left + column * (each + between), top + row * (top + tall), each, tall)
        axes.grid(False)
        step = max(1, len(x) // SHOWN)
        style = ({"linestyle": "none", "marker": ".", "markersize": 2.2, "markeredgewidth": 0} if not start or coarse(x, y)
                 else {"linewidth": 0.9})
        canvas.line(axes, x[::step], y[::step], label, color=colour, **style)
        if behind:
            axes.plot(*behind, color=GREY, zorder=1, **(
                {"linestyle": "none", "marker": ".", "markersize": 3.5, "markeredgewidth": 0} if coarse(*behind) else
                {"linewidth": 3.0 * look.unit, "alpha": 0.55}))
        if start:
            axes.plot(x[:1], y[:1], marker="x", color=INK, markersize=6 * look.unit, markeredgewidth=1.4 * look.unit, zorder=5)
        axes.set_title(plain(label), fontsize=0.95 * look.font, color=colour, loc="left", pad=4 * look.unit)
        axes.set_xlim(low[0], low[0] + spans[0])
        axes.set_ylim(low[1], low[1] + spans[1])
        axes.locator_params(nbins=4)
        last = k + columns >= len(tracks)
        canvas.labels(axes, with_unit(names[0], units[0]) if last else "", with_unit(names[1], units[1]) if column == 0 else "")
        if not last:
            axes.tick_params(labelbottom=False)
        if column:
            axes.tick_params(labelleft=False)
    return canvas


def remarks(tracks, units):
    """What a reader must know of tracks in panels, in sentences."""
    frame = limits([t[2:] for t in tracks], FRAME)
    outside = [label for label, _, x, y in tracks
               if any(min(v) < low or max(v) > high for v, (low, high) in zip((x, y), frame))]
    return sentences("Axes are the same in all panels." if len(tracks) > 1 else "",
                     "Both axes have the same scale." if units[0] == units[1] else "", "A cross marks the start.",
                     "Points are samples that lie too far apart to be joined." if any(coarse(x, y) for *_, x, y in tracks)
                     else "", f"The track of {', '.join(outside)} leaves the frame." if outside else "")
