"""Names of lines in the margin to the right of a panel, each joined to its line. All coordinates are pixels from the bottom left of
the figure.
"""
import math

from canvas import MID

SIZE, SMALL = 0.86, 0.75  # of names, and of what stands beside them
MARGIN, LEAST = 0.3, 150  # of the width of a figure that names may take, and pixels that they may take of a narrow one


def shown(canvas, name, weight="normal"):
    """The name, without its middle where it is wider than a margin may be: grids tell their methods apart at the end."""
    room = max(MARGIN * canvas.width, LEAST * canvas.scale)
    text, kept = name, len(name)
    while kept > 4 and canvas.measure(text, SIZE, weight)[0] > room:
        kept -= 1
        text = f"{name[:kept - kept // 2]}…{name[-(kept // 2):]}"
    return text


def right_of(canvas, axes, ends, weight="normal"):
    """Names to the right of a panel, as near to the height of their lines' ends as there is room: [(name, x and y of the end in
    data, colour, what stands beside the name)]. A thin line leads from the end to the name."""
    box, unit = axes.get_window_extent(canvas.renderer), canvas.scale
    tall = canvas.measure("Xg", SIZE)[1] + unit
    ends = [end for end in ends if math.isfinite(end[2])]
    at = [tuple(axes.transData.transform((x, y))) for _, x, y, *_ in ends]
    at = [(min(max(x, box.x0), box.x1), min(max(y, box.y0), box.y1)) for x, y in at]
    heights = pushed_apart([y - tall / 2 for _, y in at], tall, box.y0 - tall / 2, max(box.y0, box.y1 - tall / 2))
    for (name, _, _, colour, note), (x, y), low in zip(ends, at, heights):
        left, name = box.x1 + 20 * unit, shown(canvas, name, weight)
        canvas.leader((x + 3 * unit, y), (box.x1 + 4 * unit, y), colour, (0, (1, 2)))
        canvas.leader((box.x1 + 4 * unit, y), (left - 3 * unit, low + tall / 2), colour)
        canvas.write(axes, left, low, name, SIZE, color=colour, ha="left", va="bottom", zorder=6, weight=weight)
        if note:
            canvas.write(axes, left + canvas.measure(f"{name}  ", SIZE, weight)[0], low, note, SMALL, color=MID, ha="left", va="bottom",
                         zorder=6)


def sampled(points, spacing=5.0):
    """Points along a line, close enough together that a text over it covers some."""
    out = list(points[:1])
    for (x1, y1), (x2, y2) in zip(points, points[1:]):
        n = max(1, math.ceil(math.hypot(x2 - x1, y2 - y1) / spacing))
        out += [(x1 + (x2 - x1) * k / n, y1 + (y2 - y1) * k / n) for k in range(1, n + 1)]
    return out


def pushed_apart(heights, least, low, high):
    """Heights as near to those wanted as possible, at least `least` apart and between low and high as far as there is room."""
    order = sorted(range(len(heights)), key=lambda k: heights[k])
    placed = [min(max(heights[k], low), high) for k in order]
    for _ in range(200):
        moved = False
        for k in range(len(placed) - 1):
            lack = least - (placed[k + 1] - placed[k])
            if lack > 1e-6:
                placed[k], placed[k + 1], moved = placed[k] - lack / 2, placed[k + 1] + lack / 2, True
        if placed and placed[0] < low:
            placed[0], moved = low, True
        if placed and placed[-1] > high:
            placed[-1], moved = high, True
        if not moved:
            break
    out = [0.0] * len(heights)
    for k, height in zip(order, placed):
        out[k] = height
    return out
