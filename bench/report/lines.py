"""Panels of lines, each named in the margin to the right of its panel and joined to its name.

At most LINES lines of a panel have a colour and a name; the worst, those whose runs ended early and those whose errors grow come before
others. The rest is grey. Of lines that belong to a group, as methods that all keep the structure, there is one name for the group. A cross
ends the line of a run that ended early. Lines of a family differ by their dashes and every line is joined to its name, so that
nothing depends on colour.
"""
import dataclasses
import math
import typing

from canvas import GREY, INK, MID, PAPER, RULE, Canvas, plain, sizes
from families import LINES
from labels import SIZE, SMALL, right_of, shown
from scales import positive
from wording import listed


@dataclasses.dataclass
class Line:
    label: str
    x: list
    y: list
    look: dict  # as families.style gives it
    told: str = ""  # where it is pointed at
    note: str = ""  # beside its name
    fails: bool = False  # it is shown before others
    ended: bool = False  # its run ended early
    group: str = ""  # whose name stands for it, if several lines have it
    marks: bool = False


@dataclasses.dataclass
class Panel:
    lines: list
    axis: typing.Any  # ErrorAxis
    x: str  # what it is drawn against
    y: str  # what is drawn
    x_axis: typing.Callable  # sets that axis, of a canvas and a panel of it
    title: str = ""
    colour: str = INK
    behind: list = dataclasses.field(default_factory=list)  # [(x, y)] of lines that stand in other panels
    more: typing.Callable = lambda canvas, axes: None  # draws what else belongs to it

    def named(self):
        """The lines that have a colour and a name, in their order."""
        groups = [line.group for line in self.lines]
        alone = [line for line in self.lines if not line.group or groups.count(line.group) == 1]
        worst = max(alone, key=lambda line: max(positive(line.y), default=0), default=None)
        chosen = sorted(alone, key=lambda line: not (line.fails or line.ended or line is worst))[:LINES]
        return [line for line in alone if any(line is one for one in chosen)]

    def unnamed(self):
        """Labels of the lines without a name, that of a group counting as one."""
        named = self.named()
        groups = [line.group for line in self.lines]
        return [line.label for line in self.lines if not any(line is one for one in named) and groups.count(line.group) < 2 or
                not line.group and not any(line is one for one in named)]


def in_grey(panels):
    """A sentence on the lines that have no name; empty where all have one."""
    rest = list(dict.fromkeys(label for panel in panels for label in panel.unnamed()))
    return f"In grey: {listed(rest)}." if rest else ""


def draw(panels, wide, described="", tall=230):
    """The panels on a Canvas, side by side as far as there is room; `tall` is the height of each on a wide screen."""
    look = sizes(wide)
    several, made = len(panels) > 1, Canvas(look.width, look.width, look.font, look.unit)
    margin = max((name_width(made, line) for panel in panels for line in panel.lines), default=0) + 24 * look.unit
    most = 2 if len(panels) in (2, 4) or margin > look.width / 9 else 3  # a panel is wider than its margin
    columns = min(most, len(panels)) if look.wide else 1
    left, top, right, below, gap, tall = (x * look.unit for x in (
        72 if look.wide else 60, 26 if any(p.title for p in panels) else 14, 4, 46, 30, tall if look.wide else 130 if several else 200))
    part, rows = look.width / columns, math.ceil(len(panels) / columns)
    canvas = Canvas(look.width, rows * (top + tall) + (rows - 1) * gap + below, look.font, look.unit)
    canvas.description = described
    for k, panel in enumerate(panels):
        row, column = divmod(k, columns)
        axes = canvas.panel(left + part * column, top + row * (top + tall + gap), part - left - right - margin, tall)
        last = k + columns >= len(panels)
        fill(canvas, axes, panel, last or len({p.x for p in panels}) > 1, column == 0 or len({p.y for p in panels}) > 1)
    return canvas


def fill(canvas, axes, panel, named_x=True, named_y=True):
    """What belongs into the place of a panel, whose margin to the right is wide enough for names."""
    if panel.title:
        axes.set_title(plain(panel.title), fontsize=canvas.font, color=panel.colour, weight="bold", loc="left", pad=5 * canvas.scale)
    draw_lines(canvas, axes, panel, canvas.scale)
    panel.more(canvas, axes)
    panel.axis.apply(axes)
    panel.x_axis(canvas, axes)
    canvas.labels(axes, panel.x if named_x else "", panel.y if named_y else "")
    name_lines(canvas, axes, panel)


def draw_lines(canvas, axes, panel, unit):
    named = panel.named()
    for x, y in panel.behind:
        axes.plot(x, panel.axis.place(y), color=RULE, linewidth=0.8 * unit, zorder=1)
    for line in panel.lines:
        look = line.look | {"linewidth": 1.5, "markersize": 4.5, "zorder": 4}
        if not any(line is one for one in named):
            look |= {"color": GREY, "markeredgecolor": GREY, "linewidth": 0.8, "linestyle": "-", "markersize": 3.4, "zorder": 3}
            look |= {"markerfacecolor": GREY} if look["markerfacecolor"] != PAPER else {}
        if not line.marks:
            look["marker"] = ""
        canvas.line(axes, line.x, panel.axis.place(line.y), line.told or line.label, **look)
        if line.ended and line.x:
            axes.plot(line.x[-1:], panel.axis.place(line.y[-1:]), color=INK, marker="X", markersize=8 * unit,
                      markeredgecolor=PAPER, markeredgewidth=unit, zorder=5)


def name_width(canvas, line):
    note = canvas.measure(line.note, SMALL)[0] + canvas.measure("  ", SIZE)[0] if line.note else 0
    return max(canvas.measure(shown(canvas, line.label), SIZE)[0] + note, canvas.measure(shown(canvas, line.group), SIZE)[0])


def name_lines(canvas, axes, panel):
    ends, named = [], panel.named()
    for line in named:
        if line.x:
            ends.append((line.label, line.x[-1], panel.axis.place(line.y)[-1], line.look["color"], line.note))
    for group in dict.fromkeys(line.group for line in panel.lines if line.group):
        kin = [line for line in panel.lines if line.group == group and line.x]
        if len(kin) > 1:
            middle = sorted(kin, key=lambda line: panel.axis.place(line.y)[-1])[len(kin) // 2]
            ends.append((group, middle.x[-1], panel.axis.place(middle.y)[-1], MID, ""))
    right_of(canvas, axes, ends)
