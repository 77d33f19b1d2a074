"""The sheet a figure is drawn on: panels side by side (wide) or stacked (narrow), one legend below them all.

Lines differ by colour (Okabe and Ito's palette), marker and dash, so that they stay apart for colour-blind readers
and in grey; a method has the same look in every figure of a report. Output is deterministic: fixed salt for SVG
ids, no dates, the font that matplotlib ships; each SVG's ids carry a prefix, so that several fit in one page.
"""
import io
import math
import re
import textwrap

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

matplotlib.rcdefaults()
matplotlib.rcParams.update({
    "svg.hashsalt": "pfaff", "svg.fonttype": "path", "font.family": "DejaVu Sans", "mathtext.fontset": "dejavusans",
    "font.size": 9, "axes.labelsize": 9, "axes.titlesize": 9, "xtick.labelsize": 8, "ytick.labelsize": 8,
    "legend.fontsize": 8, "axes.linewidth": 0.7, "lines.linewidth": 1.3, "lines.markersize": 5,
    "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.5, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False, "axes.unicode_minus": True,
})

COLOURS = ("#000000", "#D55E00", "#0072B2", "#009E73", "#CC79A7", "#56B4E9", "#B8860B")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", "p", ">", "*", "h")
DASHES = ("-", (0, (5, 1.6)), (0, (1.4, 1.2)), (0, (6, 1.5, 1.2, 1.5)), (0, (3, 1, 1, 1, 1, 1)))


def look(index):
    """Line and marker of the index-th method; every other marker is hollow, so that one shows behind another."""
    colour = COLOURS[index % len(COLOURS)]
    return {"color": colour, "linestyle": DASHES[index % len(DASHES)], "marker": MARKERS[index % len(MARKERS)],
            "markerfacecolor": "white" if index % 2 else colour, "markeredgecolor": colour, "markeredgewidth": 1.1}


def plain(text):
    """Text that matplotlib is not to read as mathematics."""
    return str(text).replace("$", r"\$")


class Sheet:
    def __init__(self, panels, wide, title):
        self.wide, self.title = wide, title
        self.columns = panels if wide else 1
        self.rows = panels // self.columns
        self.figure = Figure()
        FigureCanvasAgg(self.figure)
        self.axes = [self.figure.add_axes((0.1, 0.1, 0.8, 0.8), label=str(i)) for i in range(panels)]
        self.placed = False
        self.methods, self.levels = {}, {}  # legend: label -> handle; methods come first

    def method(self, axes, x, y, index, label, **style):
        shown = look(index) | style
        axes.plot(x, y, zorder=3, **shown)
        self.methods.setdefault(plain(label), Line2D([], [], **look(index)))

    def level(self, axes, y, label, **style):
        """A thin grey line: one level, or a curve as (x, y)."""
        style = {"color": "#555555", "linewidth": 0.9, "linestyle": (0, (8, 2))} | style
        if isinstance(y, tuple):
            axes.plot(*y, zorder=2, **style)
        else:
            axes.axhline(y, zorder=2, **style)
        self.levels.setdefault(label, Line2D([], [], **style))

    def cross(self, axes, x, y, label):
        style = {"color": "#000000", "marker": "X", "linestyle": "none", "markersize": 9, "markeredgecolor": "white"}
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

    def svg(self, prefix):
        """The figure as an SVG element (no XML prologue) whose ids start with `prefix`."""
        text = self._save("svg", {"Date": None, "Creator": None, "Format": None, "Type": None}).decode("utf-8")
        text = text[text.index("<svg"):]
        text = re.sub(r"\s*<metadata>.*?</metadata>", "", text, flags=re.S)
        text = re.sub(r'\b(?:d|x|y)="[^"]*"', lambda m: re.sub(r"(\.\d\d\d)\d+", r"\1", m[0]), text)  # a third smaller
        text = re.sub(r'\bid="([^"]*)"', rf'id="{prefix}-\1"', text)
        text = re.sub(r'href="#([^"]*)"', rf'href="#{prefix}-\1"', text)
        return re.sub(r"url\(#([^)]*)\)", rf"url(#{prefix}-\1)", text)

    def png(self):
        return self._save("png", {"Software": None})

    def _save(self, kind, metadata):
        if not self.placed:
            self._place()
            self.placed = True
        buffer = io.BytesIO()
        self.figure.savefig(buffer, format=kind, dpi=160, metadata=metadata)
        return buffer.getvalue()
