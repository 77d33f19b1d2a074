"""What every figure is drawn with: matplotlib, the colours of the report, and SVG that a page can colour anew.

Text stays text. One unit of an SVG is a pixel. Within the page every colour is a variable of the style sheet, so that dark
paper is a matter of the style sheet alone; in files of their own figures have the colours of light paper. Output is
deterministic: fixed salt for SVG ids, no dates; the font that text is measured with is the one matplotlib ships, which is
wider than those that pages take, so that what fits here fits there. Each SVG's ids carry a prefix, because several share a
page.
"""
import html
import io
import re
import typing
from pathlib import Path

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from families import FAMILIES

PAPER, INK, MID, RULE, GREY, BAND, FRONT = ("#fefefe", "#1c1c1e", "#63636a", "#dcdce0", "#a2a2a8", "#eef0f3", "#f4e7b4")
VARIABLES = {PAPER: "paper", INK: "ink", MID: "mid", RULE: "rule", GREY: "grey", BAND: "band", FRONT: "front",
             **{f.light: f.key for f in FAMILIES}}
FONTS = "'Liberation Sans', Arial, Helvetica, 'DejaVu Sans', sans-serif"

matplotlib.rcdefaults()
matplotlib.rcParams.update(matplotlib.rc_params_from_file(Path(__file__).with_name("screen.mplstyle"), use_default_template=False))


class Sizes(typing.NamedTuple):
    """How large a figure is drawn: lengths are meant for narrow screens and multiplied by `unit`."""
    width: float  # in pixels, on paper in points
    font: float
    unit: float
    wide: bool  # room for several panels side by side


def sizes(wide):
    """Of a wide screen where `wide` is True, of a narrow one where it is False, else of print of that width in points."""
    if isinstance(wide, bool):
        return Sizes(1120, 12.5, 1.0, True) if wide else Sizes(368, 11, 1.0, False)
    font = matplotlib.rcParams["font.size"]
    return Sizes(wide, font, font / 11, wide >= 50 * font)


def plain(text):
    """Text that matplotlib is not to read as mathematics, with squares and cubes, as of units, raised."""
    raised = re.sub(r"(?<=[A-Za-z])\^([23])(?![0-9.])", lambda power: "²³"[int(power[1]) - 2], str(text))
    return raised.replace("$", r"\$")


class Canvas:
    """A figure of a size in pixels, in which panels are placed by their distance from its top left corner."""

    def __init__(self, width, height, font=12.5, scale=1.0):
        self.width, self.height, self.font, self.scale = width, height, font, scale  # scale: of lines and marks
        self.figure = Figure(figsize=(width / 72, height / 72), dpi=72)
        FigureCanvasAgg(self.figure)
        self.axes, self.titles, self.description, self.drawn = [], {}, "", None
        self.printed = False  # on paper a unit is a point
        self.renderer = self.figure.canvas.get_renderer()

    def panel(self, left, top, width, height):
        axes = self.figure.add_axes((left / self.width, 1 - (top + height) / self.height, width / self.width,
                                     height / self.height), label=str(len(self.axes)))
        axes.tick_params(labelsize=0.92 * self.font, length=3 * self.scale, width=0.7 * self.scale, pad=3.5 * self.scale)
        for spine in axes.spines.values():
            spine.set_linewidth(0.7 * self.scale)
        axes.grid(False, axis="x")
        self.axes.append(axes)
        return axes

    def labels(self, axes, x, y):
        axes.set_xlabel(plain(x), fontsize=self.font, labelpad=3 * self.scale)
        axes.set_ylabel(plain(y), fontsize=self.font, labelpad=6 * self.scale)

    def line(self, axes, x, y, told="", **style):
        """A line with a title that is shown when it is pointed at."""
        gid = f"line{len(self.titles)}"
        self.titles[gid] = told
        style |= {k: self.scale * style[k] for k in ("linewidth", "markersize", "markeredgewidth") if k in style}
        return axes.plot(x, y, gid=gid, **style)[0]

    def write(self, axes, x, y, text, size=1.0, **style):
        """Text at display coordinates, in pixels from the bottom left of the figure."""
        return axes.annotate(plain(text), (x, y), xycoords="figure points", fontsize=size * self.font,
                             annotation_clip=False, **style)

    def leader(self, begin, end, colour, dash="-"):
        """A thin straight line between two points, in pixels from the bottom left of the figure."""
        x, y = ([a / 72, b / 72] for a, b in zip(begin, end))
        self.figure.add_artist(Line2D(x, y, color=colour, linewidth=0.7 * self.scale, linestyle=dash, transform=self.figure.dpi_scale_trans))

    def measure(self, text, size=1.0, weight="normal"):
        """(width, height) of a text in pixels."""
        made = self.figure.text(0, 0, plain(text), fontsize=size * self.font, weight=weight)
        box = made.get_window_extent(self.renderer)
        made.remove()
        return box.width, box.height

    def svg(self, prefix, coloured=False):
        """The figure as an SVG element (no XML prologue); with `coloured`, in colours of its own for a file of its own."""
        self.drawn = self.drawn or self.save("svg")
        return svg_text(self.drawn, prefix, self.description, self.titles, coloured, unit="pt" if self.printed else "")

    def png(self):
        return self.save("png")

    def save(self, kind):
        return saved(self.figure, kind)


def saved(figure, kind, dpi=160):
    metadata = {"svg": {"Date": None, "Creator": None, "Format": None, "Type": None}, "png": {"Software": None},
                "pdf": {"Creator": None, "Producer": None, "CreationDate": None}}.get(kind)
    if kind == "pgf":  # text, and without metadata
        buffer = io.StringIO()
        figure.savefig(buffer, format=kind)
        return buffer.getvalue()
    buffer = io.BytesIO()
    figure.savefig(buffer, format=kind, dpi=dpi, metadata=metadata)
    return buffer.getvalue()


def svg_text(content, prefix, description, titles, coloured, scale=1.0, unit=""):
    text = content.decode("utf-8")
    text = text[text.index("<svg"):]
    text = re.sub(r"\s*<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r'\b(?:d|x|y)="[^"]*"', lambda m: re.sub(r"(\.\d)\d+", r"\1", m[0]), text)
    text = re.sub(r'(width|height)="([0-9.]+)pt"', lambda m: f'{m[1]}="{scale * float(m[2]):g}{unit}"', text, count=2)
    text = re.sub(r"'DejaVu Sans'(?:, [^;\"]*)?", FONTS, text)
    for gid, told in titles.items():
        text = text.replace(f'<g id="{gid}">', f'<g id="{gid}" class="mline">'
                            + (f"<title>{html.escape(told)}</title>" if told else ""))
    text = re.sub(r'\bid="([^"]*)"', rf'id="{prefix}-\1"', text)
    text = re.sub(r'href="#([^"]*)"', rf'href="#{prefix}-\1"', text)
    text = re.sub(r"url\(#([^)]*)\)", rf"url(#{prefix}-\1)", text)
    text = text if coloured else recoloured(text)
    told = f"<desc>{html.escape(description)}</desc>" if description else ""
    return re.sub(r"(<svg [^>]*>)", lambda m: m[1] + told, text, count=1)


def recoloured(text):
    """An SVG with the variables of the style sheet in the place of its colours."""
    for colour, variable in VARIABLES.items():
        text = text.replace(colour, f"var(--{variable})")
    return text
