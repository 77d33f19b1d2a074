"""The motion: tracks of the runs in the plane of two coordinates, as far as a case names them in `motion`.

Both axes have the same scale where the coordinates have the same unit, so that a circle is a circle, unless the tracks
are so much longer than wide that nothing would be seen of their shape. A method's track is
that of its run at the step most methods share; an ensemble shows its first seed. The start is marked.
"""
import math

from figures import Drawing, heading, limits, sentences, step_text, styled, with_unit
from canvas import plain
from sheet import Sheet

LONG = 6  # times as long as wide
FRAME = 4  # a track that leaves the middle one by this many of its widths leaves the frame


def drawings(experiment, case):
    if not case.get("motion"):
        return []
    tracks = [(run, *track(experiment, case, run)) for run in experiment.at_common_step(case)]
    tracks = [t for t in tracks if len(t[1]) > 1]
    return [drawn(experiment, case, tracks)] if tracks else []


def track(experiment, case, run):
    """(values of the first coordinate, values of the second), as far as both are finite."""
    first, second = (experiment.series(run, name) for name in case["motion"])
    if first is None:
        return [], []
    pairs = [(first.initial + a, second.initial + b) for a, b in zip(first.change, second.change)]
    pairs = [p for p in pairs if all(map(math.isfinite, p))]
    return [p[0] for p in pairs], [p[1] for p in pairs]


def drawn(experiment, case, tracks):
    units = [experiment.series(tracks[0][0], name).unit for name in case["motion"]]
    target = experiment.common_step(case)
    title = f"{heading(case)}: {case['motion'][1]} against {case['motion'][0]}"
    frame = limits([t[1:] for t in tracks], FRAME)
    sizes = sorted(high - low for low, high in frame)
    equal = units[0] == units[1] and sizes[1] <= LONG * sizes[0]
    outside = any(min(t[k]) < low or max(t[k]) > high for t in tracks for k, (low, high) in zip((1, 2), frame))

    def draw(wide):
        sheet = Sheet(1, wide, title)
        axes = sheet.axes[0]
        for n, (run, x, y) in enumerate(tracks):
            look, label = styled(experiment, run, target)
            gap = max(1, len(x) // 6)
            sheet.method(axes, x, y, look, label, markevery=(n * gap // len(tracks), gap))
        sheet.cross(axes, tracks[0][1][0], tracks[0][2][0], "start")
        names = [plain(with_unit(name, unit)) for name, unit in zip(case["motion"], units)]
        axes.set(xlabel=names[0], ylabel=names[1])
        pads = [0.05 * ((high - low) or 1) for low, high in frame]
        if equal:
            axes.set_aspect("equal", adjustable="datalim")
        axes.set_xlim(frame[0][0] - pads[0], frame[0][1] + pads[0])
        axes.set_ylim(frame[1][0] - pads[1], frame[1][1] + pads[1])
        return sheet

    return Drawing("motion", case, title, sentences(
        f"Tracks of the motion, {step_text(target, case)}. Methods that are accurate lie on top of each other.",
        "Both axes have the same scale." if equal else
        "The axes have different scales." if units[0] == units[1] else "", "Shown is the first seed." if case.get("seeds") else "",
        "Some tracks leave the frame." if outside else ""), draw)
