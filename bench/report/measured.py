"""Tables of measures that have no figure of their own: each column of numbers, over the time or over the size of the step."""
import math

from curves import ranks
from families import style
from figures import Drawing, heading, sentences, step_text, with_unit
from lines import Line, Panel, draw, in_grey
from scales import ErrorAxis, positive, step_axis, time_axis

OWN = ("poincare-loop", "reversibility", "contraction", "frequency")  # which loops.py and others draw
DECADES = 2  # from which on numbers that are not negative stand on a logarithmic axis


class PlainAxis:
    """A linear y axis, with the methods of an ErrorAxis."""

    def place(self, values):
        return [v if math.isfinite(v) else math.nan for v in values]

    def apply(self, axes):
        axes.locator_params(axis="y", nbins=6)

    def remarks(self):
        return []


def axis_of(curves):
    values = [v for _, values in curves for v in values if math.isfinite(v)]
    above = positive(values)
    spread = bool(above) and max(above) >= 10**DECADES * min(above)
    return ErrorAxis([values for _, values in curves]) if spread and min(values) >= 0 else PlainAxis()


def drawings(verdict):
    measures = verdict.experiment.measures
    return [drawing for name in measures if name not in OWN for drawing in of_measure(verdict, measures[name])]


def of_measure(verdict, measure):
    case, over_step = verdict.case, measure["view"] == "step"
    x, steps, found = "step" if over_step else "t", set(), {}
    numbers = [c for c in measure["columns"] if c["kind"] == "number" and c["name"] not in measure["keys"]]
    for _, cells in verdict.experiment.table(measure["name"], case):
        steps.add(cells["step"])
        at = found.setdefault(cells["method"], {"x": [], **{column["name"]: [] for column in numbers}})
        at["x"].append(cells[x])
        for column in numbers:
            at[column["name"]].append(cells[column["name"]])
    rows, rank = {row.label: row for row in verdict.rows}, ranks(verdict.curves)
    shown = [label for label in verdict.in_order(found) if found[label]["x"]]
    if not shown:
        return []
    unit = case.get("time_unit") or ""
    span = max(max(found[label]["x"]) for label in shown)

    def x_axis(canvas, axes):
        if over_step:
            step_axis(axes, steps, lambda text: canvas.measure(text, 0.92)[0])
        else:
            time_axis(axes, 0, span)

    panels = []
    for column in numbers:
        name = column["name"]
        curves = [(found[label]["x"], found[label][name]) for label in shown]
        lines = [Line(label, *curve, style(rows[label].curve.family, rank[label], rows[label].curve.fill), marks=over_step)
                 for label, curve in zip(shown, curves)]
        panels.append(Panel(lines, axis_of(curves), with_unit("step" if over_step else "t", unit),
                            with_unit(name, column.get("unit") or ""), x_axis))
    at = "" if over_step else f"At {step_text(steps.pop(), case)}." if len(steps) == 1 else \
        "At the largest step at which each method finishes."
    told = sentences(measure.get("description", ""), at, *(remark for panel in panels for remark in panel.axis.remarks()), in_grey(panels))
    return [Drawing(f"measure-{measure['name']}", case, f"{heading(case)}: {measure['title']}", told,
                    lambda wide: draw(panels, wide, measure["title"]))]
