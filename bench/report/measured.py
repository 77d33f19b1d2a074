"""Tables of measures that have no figure of their own: each column of numbers, over the time or over the size of the step."""
import math

from curves import ranks
from families import style
from figures import Drawing, heading, sentences, step_text, with_unit
from lines import Line, Panel, draw, in_grey
from scales import ErrorAxis, positive, step_axis, time_axis

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


def drawings(verdict, own=()):
    """Those of all measures but `own`, which are drawn elsewhere."""
    measures = verdict.experiment.measures
    return [drawing for name in measures if name not in own for drawing in of_measure(verdict, measures[name])]


def curves_of(verdict, measure, numbers, things):
    """{method: {thing: {"x": [...], column: [...]}}}, and the steps; a thing is a row's cells of the columns `things`."""
    x, steps, found = "step" if measure["view"] == "step" else "t", set(), {}
    for _, cells in verdict.experiment.table(measure["name"], verdict.case):
        steps.add(cells["step"])
        of_method = found.setdefault(cells["method"], {})
        at = of_method.setdefault(tuple(cells[name] for name in things), {"x": [], **{name: [] for name in numbers}})
        at["x"].append(cells[x])
        for name in numbers:
            at[name].append(cells[name])
    return found, steps


def of_measure(verdict, measure):
    case, over_step, keys = verdict.case, measure["view"] == "step", measure["keys"]
    # What a table names first its rows belong to; then the first number of each is shown.
    things = [c["name"] for c in measure["columns"] if c["kind"] == "text" and c["name"] in keys[4:]]
    numbers = [c for c in measure["columns"] if c["kind"] == "number" and c["name"] not in keys][:1 if things else None]
    found, steps = curves_of(verdict, measure, [c["name"] for c in numbers], things)
    rows, rank = {row.label: row for row in verdict.rows}, ranks(verdict.curves)
    unit = case.get("time_unit") or ""

    def x_axis(canvas, axes):
        if over_step:
            step_axis(axes, steps, lambda text: canvas.measure(text, 0.92)[0])
        else:
            time_axis(axes, 0, max(x for of_method in found.values() for curve in of_method.values() for x in curve["x"]))

    def panel(thing, column):
        shown = [label for label in verdict.in_order(found) if thing in found[label]]
        curves = [(found[label][thing]["x"], found[label][thing][column["name"]]) for label in shown]
        lines = [Line(label, *curve, style(rows[label].curve.family, rank[label], rows[label].curve.fill), marks=over_step)
                 for label, curve in zip(shown, curves)]
        told = f"{thing[0]}: {column['name']}" if thing else column["name"]
        units = dict(zip(things, thing)).get("unit") or column.get("unit") or ""
        return Panel(lines, axis_of(curves), with_unit("step" if over_step else "t", unit), with_unit(told, units), x_axis)

    all_things = dict.fromkeys(thing for of_method in found.values() for thing in of_method)
    panels = [panel(thing, column) for thing in all_things for column in numbers]
    panels = [panel for panel in panels if any(math.isfinite(y) for line in panel.lines for y in line.y)]
    if not panels:
        return []
    at = "" if over_step else f"At {step_text(steps.pop(), case)}." if len(steps) == 1 else \
        "At the largest step at which each method finishes."
    told = sentences(measure.get("description", ""), at, *dict.fromkeys(remark for panel in panels for remark in panel.axis.remarks()), in_grey(panels))
    return [Drawing(f"measure-{measure['name']}", case, f"{heading(case)}: {measure['title']}", told,
                    lambda wide: draw(panels, wide, measure["title"]))]
