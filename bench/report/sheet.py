"""The sheet a figure with a legend is drawn on: panels side by side (wide) or stacked (narrow), one legend below them all.

A line has the colour and mark of its method's family, as in every figure; within a family lines differ by dash.
"""
import math
import textwrap

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from canvas import INK, MID, PAPER, plain, saved, svg_text


class Sheet:
    def __init__(self, panels, wide, title):
        self.wide, self.title = wide, title
        self.columns = panels if wide else 1
        self.rows = panels // self.columns
        self.figure = Figure()
        FigureCanvasAgg(self.figure)
        self.axes = [self.figure.add_axes((0.1, 0.1, 0.8, 0.8), label=str(i)) for i in range(panels)]
        self.placed, self.drawn = False, None
        self.methods, self.levels = {}, {}  # legend: label -> handle; methods come first

    def method(self, axes, x, y, look, label, **style):
        axes.plot(x, y, zorder=3, **(look | style))
        self.methods.setdefault(plain(label), Line2D([], [], **look))

    def level(self, axes, y, label, **style):
        """A thin grey line: one level, or a curve as (x, y)."""
        style = {"color": MID, "linewidth": 0.9, "linestyle": (0, (8, 2))} | style
        if isinstance(y, tuple):
            axes.plot(*y, zorder=2, **style)
        else:
            axes.axhline(y, zorder=2, **style)
        self.levels.setdefault(label, Line2D([], [], **style))

    def cross(self, axes, x, y, label):
        style = {"color": INK, "marker": "X", "linestyle": "none", "markersize": 9, "markeredgecolor": PAPER}
        axes.plot(x, y, zorder=4, **style)
        self.levels.setdefault(label, Line2D([], [], **style))

    def _place(self):
        """Place title, panels and legend: sizes in inches, the height follows from the legend."""
        width = 4.4 if not self.wide else {1: 6.6, 2: 7.6}.get(self.columns, 10.6)
        left, right, between, below = 0.95, 0.15, 0.9, 0.55
        panel_w = (width - left - right - between * (self.columns - 1)) / self.columns
        panel_h = 2.9 if self.wide else 2.5
        title = "\n".join(textwrap.wrap(self.title, int(width * 11.5)))
        top = 0.2 + 0.17 * (title.count("\n") + 1)
        legend, legend_h = self._legend(width)
        height = top + self.rows * (panel_h + below) + 0.2 * (self.rows - 1) + legend_h + 0.05
        self.figure.set_size_inches(width, height)
        for i, axes in enumerate(self.axes):
            row, column = divmod(i, self.columns)
            x = left + column * (panel_w + between)
            y = height - top - row * (panel_h + below + 0.2) - panel_h
            axes.set_position((x / width, y / height, panel_w / width, panel_h / height))
        self.figure.text(0.1 / width, 1 - 0.08 / height, plain(title), va="top", ha="left", fontsize=9.5, weight="bold")
        if legend:
            legend.set_bbox_to_anchor((0.5, 0.03 / height), transform=self.figure.transFigure)

    def _legend(self, width):
        """The legend with as many columns as fit; (legend, its height in inches)."""
        entries = self.methods | self.levels
        if not entries:
            return None, 0
        labels = [textwrap.fill(label, int((width - 1) * 14)) for label in entries]
        self.figure.set_size_inches(width, 6)
        for columns in (4, 3, 2, 1):
            rows = math.ceil(len(entries) / columns)
            if columns > 1 and math.ceil(len(entries) / rows) < columns:
                continue  # would leave a column empty
            legend = self.figure.legend(list(entries.values()), labels, loc="lower center",
                                        ncol=columns, frameon=False, handlelength=3.4, columnspacing=1.4,
                                        borderpad=0.1, borderaxespad=0)
            box = legend.get_window_extent(self.figure.canvas.get_renderer())
            if box.width / self.figure.dpi <= width - 0.1 or columns == 1:
                return legend, box.height / self.figure.dpi + 0.08
            legend.remove()
        return None, 0

    def svg(self, prefix, coloured=False):
        """The figure as an SVG element, as Canvas.svg gives it."""
        self.drawn = self.drawn or self._save("svg")
        return svg_text(self.drawn, prefix, self.title, {}, coloured, scale=4 / 3)

    def png(self):
        return self._save("png")

    def _save(self, kind):
        if not self.placed:
            self._place()
            self.placed = True
        return saved(self.figure, kind)
