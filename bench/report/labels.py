"""Labels at the lines of a figure instead of a legend. All coordinates are pixels from the bottom left of the figure.

A label may stand at every point and in the middle of every segment of its own line, in twelve places around it. Each place
has a price: other labels under it, other lines and its own, and the distance from the line's last point. Labels are placed
one after the other, each at its cheapest place. Those that may be left out are left out where no place is free.
"""
import dataclasses
import math

OVERLAP, FOREIGN, OWN, NEAR, FROM_END = 400.0, 3.0, 1.2, 0.5, 0.4
SPACING = 5.0  # between the samples of a line
FREE = 10.0  # a price up to which a place is free


@dataclasses.dataclass
class Label:
    text: str
    points: list  # of its line, [(x, y)]; the last one is where the label would stand best
    width: float
    height: float
    needed: bool = True
    box: tuple | None = None  # (x0, y0, x1, y1) once it is placed
    anchor: tuple | None = None
    far: bool = False  # stands so far from its anchor that a thin line is to lead there


def sampled(points):
    """Points along a line, close enough together that a label over it covers some."""
    out = list(points[:1])
    for (x1, y1), (x2, y2) in zip(points, points[1:]):
        n = max(1, math.ceil(math.hypot(x2 - x1, y2 - y1) / SPACING))
        out += [(x1 + (x2 - x1) * k / n, y1 + (y2 - y1) * k / n) for k in range(1, n + 1)]
    return out


def place(labels, frame, lines, taken=()):
    """Place labels, those that come first before the others. `lines` are all lines of the figure, `taken` boxes that are
    occupied already. Afterwards a label without a box has no place."""
    boxes = list(taken)
    samples = [sampled(line) for line in lines]
    for label in labels:
        own = sampled(label.points)
        best = None
        for rank, anchor in enumerate(anchors(label.points)):
            for box, far in places(label, anchor):
                if not within(box, frame):
                    continue
                price = FROM_END * rank + (2.0 if far else 0.0)
                price += OVERLAP * sum(overlap(box, other) for other in boxes)
                if best is not None and price >= best[0]:
                    continue
                price += OWN * inside(own, box) + NEAR * inside(own, grown(box, 2))
                price += FOREIGN * sum(inside(line, box) for line in samples if line[:1] != own[:1] or line[-1] != own[-1])
                if best is None or price < best[0]:
                    best = (price, box, anchor, far)
        if best and (label.needed or best[0] <= FREE):
            label.box, label.anchor, label.far = best[1], best[2], best[3]
            boxes.append(label.box)
    return [label for label in labels if label.box]


def anchors(points):
    """The points from the last to the first, with the middles of the segments between them."""
    out = []
    for k in range(len(points) - 1, -1, -1):
        out.append(points[k])
        if k:
            out.append(tuple((a + b) / 2 for a, b in zip(points[k], points[k - 1])))
    return out


def places(label, anchor):
    """[(box, far)] around an anchor."""
    (x, y), w, h = anchor, label.width, label.height
    near, far = 7.0, 20.0
    out = []
    for gap in (near, far):
        out += [((x + gap, y - h / 2), gap == far), ((x - gap - w, y - h / 2), gap == far),
                ((x - w / 2, y + gap), gap == far), ((x - w / 2, y - gap - h), gap == far)]
    out += [((x + 5, y + 4), False), ((x + 5, y - 4 - h), False), ((x - 5 - w, y + 4), False), ((x - 5 - w, y - 4 - h), False)]
    return [((left, low, left + w, low + h), is_far) for (left, low), is_far in out]


def within(box, frame):
    return box[0] >= frame[0] and box[1] >= frame[1] and box[2] <= frame[2] and box[3] <= frame[3]


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def grown(box, by):
    return box[0] - by, box[1] - by, box[2] + by, box[3] + by


def inside(points, box):
    return sum(box[0] <= x <= box[2] and box[1] <= y <= box[3] for x, y in points)


def right_of(canvas, axes, ends):
    """Writes names to the right of the lines that end at the right side of a panel: [(name, y of the end, colour)]."""
    size, box = 0.86, axes.get_window_extent(canvas.renderer)
    tall = canvas.measure("Xg", size)[1] + 1
    wanted = [axes.transData.transform((1, y))[1] - tall / 2 for _, y, _ in ends]
    for (name, _, colour), y in zip(ends, pushed_apart(wanted, tall, box.y0 - tall / 2, box.y1 - tall / 2)):
        canvas.write(axes, box.x1 + 6, y, name, size, color=colour, ha="left", va="bottom", zorder=6)


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
