"""The structure of a step: the residual of M^T K(z',t') M = K(z,t), M being the Jacobian of one step, against the step and
along the run at equal cost. Methods that keep the structure at every step share one label; the rest are named.
"""
import math

from assertion import said
from canvas import BAND
from curves import ranks
from experiment import ROUND_OFF, UNIT_ROUND_OFF
from families import style
from figures import Drawing, heading, sentences, time_label, with_unit
from lines import Line, Panel, draw, in_grey
from scales import ErrorAxis, envelope, step_axis, time_axis
from sentence import structure as kept_by
from wording import plain_text


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
    panels = panels_of(verdict, judged, along, axis)
    return [Drawing("structure", verdict.case, f"{heading(verdict.case)}: structure of one step",
                    sentences(caption, in_grey(panels)), lambda wide: draw(panels, wide, plain_text(lede(verdict)), tall=250),
                    printed=True)]


def lede(verdict):
    """HTML: who keeps the structure, in a sentence."""
    return said(kept_by(verdict)) or "A residual that falls with the step is accuracy, not structure."


def panels_of(verdict, judged, along, axis):
    """Against the step where there are several, and along the run."""
    several = len({h for r in judged for h, _ in r.curve.residuals}) > 1
    rank, kept = ranks(verdict.curves), sum(r.curve.kept is True for r in judged)

    def lines(some, marks):
        out = []
        for r, x, values in some:
            exponent = r.curve.residual_power()
            falls = "" if math.isnan(exponent) else f", as h^{exponent:.1f}"
            out.append(Line(r.label, x, values, style(r.curve.family, rank[r.label], r.curve.fill),
                            f"{r.label}: {'kept, ' if r.curve.kept else ''}largest {max(values):.1e}{falls}",
                            group=f"{kept} kept" if r.curve.kept else "", marks=marks))
        return out

    def band(_, axes):
        axes.axhspan(1e-300, ROUND_OFF * verdict.unit, color=BAND, linewidth=0, zorder=0)

    def steps(canvas, axes):
        step_axis(axes, [h for r in judged for h, _ in r.curve.residuals], lambda label: canvas.measure(label, 0.92)[0])
        axes.invert_xaxis()
    unit, what, out = verdict.case.get("time_unit") or "", "structure residual of a step", []
    if several or not along:
        by_step = lines([(r, *map(list, zip(*r.curve.residuals))) for r in judged], True)
        out.append(Panel(by_step, axis, with_unit("step h", unit) + ", finer to the right", what, steps, more=band))
    if along:
        out.append(Panel(lines(along, False), axis, time_label(verdict.case), what,
                         lambda _, axes: time_axis(axes, 0, max(x[-1] for _, x, _ in along)), more=band))
    return out
