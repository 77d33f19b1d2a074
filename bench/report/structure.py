"""The structure of a step: the residual of M^T K(z',t') M = K(z,t), M being the Jacobian of one step, against the step and
along the run at equal cost. Methods that keep the structure at every step share one label; the rest are named.
"""
import dataclasses
import math

from assertion import said
from canvas import BAND, GREY, MID, Canvas
from curves import ranks
from experiment import ROUND_OFF, UNIT_ROUND_OFF
from families import style
from figures import Drawing, heading, sentences, with_unit
from labels import right_of
from scales import ErrorAxis, envelope, step_axis, time_axis
from sentence import structure as kept_by
from wording import plain_text


@dataclasses.dataclass
class Panels:
    """Sizes in pixels: margins around panels, and how many stand side by side."""
    width: float
    font: float
    left: float
    top: float
    right: float
    below: float
    tall: float
    columns: int
    scale: float = 1.0  # of lines and marks


WIDE = Panels(1120, 12.5, 72, 14, 116, 46, 250, 2)
NARROW = Panels(368, 11, 60, 12, 84, 44, 200, 1)


def paper(width):
    return Panels(width, 7, 42, 6, 56, 26, 110, 1 if width < 350 else 2, 0.6)


def drawings(verdict):
    if verdict.case.get("seeds") or not verdict.structured:
        return []
    judged = [r for r in verdict.rows if r.curve.residuals]
    along = []
    for row in judged:
        series = verdict.experiment.series(row.run, verdict.invariant or None) if row.run else None
        if series and series.time:
            along.append((row, *envelope(series.time, series.residual, linear=True)))
    along = [a for a in along if a[1]]
    u = UNIT_ROUND_OFF[verdict.case["precision"]]
    axis = ErrorAxis([[x for _, x in r.curve.residuals] for r in judged] + [v for *_, v in along], u)
    caption = sentences(
        "Residual of the structure that the exact flow keeps, of one step from states of the run, over the size of the terms "
        "it is the difference of. A residual that falls with the step is accuracy, not structure.",
        f"The band ends at {ROUND_OFF} units of round-off, where a method that keeps the structure begins at its coarsest step.",
        f"Along the run, at equal cost: {verdict.which_runs()}" if along and verdict.level > 0 else "", *axis.remarks())
    return [Drawing("structure", verdict.case, f"{heading(verdict.case)}: structure of one step", caption,
                    lambda wide: draw(verdict, judged, along, axis, WIDE if wide else NARROW), "",
                    lambda width: draw(verdict, judged, along, axis, paper(width)))]


def lede(verdict):
    """HTML: who keeps the structure, in a sentence."""
    return said(kept_by(verdict)) or "A residual that falls with the step is accuracy, not structure."


def draw(verdict, judged, along, axis, look):
    several = len({h for r in judged for h, _ in r.curve.residuals}) > 1
    panels = (["step"] if several or not along else []) + (["time"] if along else [])
    across = min(len(panels), look.columns)
    part = min(704, look.width / across)
    each, deep = part - look.left - look.right, look.top + look.tall + look.below
    canvas = Canvas(part * across, deep * len(panels) / across, look.font, look.scale)
    canvas.description = plain_text(lede(verdict))
    rank = ranks(verdict.curves)
    for k, panel in enumerate(panels):
        axes = canvas.panel(look.left + part * (k % across), look.top + deep * (k // across), each, look.tall)
        axes.axhspan(1e-300, ROUND_OFF * verdict.unit, color=BAND, linewidth=0, zorder=0)
        ends = []
        lines = [(r, *zip(*r.curve.residuals)) for r in judged] if panel == "step" else along
        for r, x, values in lines:
            kept = r.curve.kept
            shown = style(r.curve.family, rank[r.label], r.curve.fill) | {"linewidth": 1.5, "markersize": 4.5, "zorder": 4}
            shown |= {"color": GREY, "markeredgecolor": GREY, "linewidth": 0.8, "linestyle": "-", "markersize": 3.4,
                      "markerfacecolor": GREY, "zorder": 3} if kept else {}
            if panel == "time":
                shown["marker"] = ""
            placed = axis.place(values)
            exponent = r.curve.residual_power()
            falls = "" if math.isnan(exponent) else f", as h^{exponent:.1f}"
            canvas.line(axes, x, placed, f"{r.label}: {'kept, ' if kept else ''}largest {max(values):.1e}{falls}", **shown)
            ends.append((r, placed[-1]))
        axis.apply(axes)
        if panel == "step":
            step_axis(axes, [h for r in judged for h, _ in r.curve.residuals], lambda label: canvas.measure(label, 0.92)[0])
            axes.invert_xaxis()
        else:
            time_axis(axes, 0, max(x[-1] for _, x, _ in lines))
        unit = verdict.case.get("time_unit") or ""
        canvas.labels(axes, with_unit("step h", unit) + ", finer to the right" if panel == "step" else with_unit("t", unit),
                      "structure residual of a step" if k % across == 0 else "")
        name_ends(canvas, axes, ends)
    return canvas


def name_ends(canvas, axes, ends):
    """Labels to the right of the lines' ends; one for all methods that keep the structure."""
    kept = [(r, y) for r, y in ends if r.curve.kept]
    named = [(r.label, y, r.curve.family.light) for r, y in ends if not r.curve.kept and y > 0]
    if len(kept) == 1:
        named.append((kept[0][0].label, kept[0][1], kept[0][0].curve.family.light))
    elif kept:
        named.append((f"{len(kept)} kept", sorted(y for _, y in kept)[len(kept) // 2], MID))
    right_of(canvas, axes, named)
