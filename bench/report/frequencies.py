"""Frequencies of the motion: how much faster or slower the vectors that a case names turn with each method than in the reference
solution, against the step. frequencies.csv has the rate of the solution, the error of the method's, and by how much that error
differs between the first half of the time and the second.

A wrong frequency is a phase that is lost in proportion to time. A method that keeps the energy at a fixed step may have any
frequency error, and one that loses energy has one that grows.
"""
import dataclasses
import math

from canvas import Canvas
from curves import ranks
from families import style
from figures import Drawing, heading, sentences, with_unit
from files import parse
from labels import right_of
from scales import ErrorAxis, step_axis

STEADY = 1 / 3  # of the error, by which it may change from half to half


@dataclasses.dataclass
class Line:
    steps: list = dataclasses.field(default_factory=list)
    errors: list = dataclasses.field(default_factory=list)  # without their signs
    steadies: list = dataclasses.field(default_factory=list)  # whether the error is the same in both halves of the time

    @property
    def steady(self):
        return all(self.steadies)


def frequencies(experiment, case):
    """{vector: (rate of the solution, {method: Line})}, in the experiment's order, from the largest step to the finest."""
    found = {}
    for where, cells in experiment.frequencies:
        if cells["case"] != case["name"]:
            continue
        step, rate, error, change = (parse(cells[k], f"{where}, column {k}") for k in ("step", "frequency", "error", "change"))
        if math.isnan(error):
            continue
        _, lines = found.setdefault(cells["vector"], (rate, {}))
        line = lines.setdefault(cells["method"], Line())
        line.steps.append(step)
        line.errors.append(abs(error))
        line.steadies.append(abs(change) <= STEADY * abs(error))
    for _, lines in found.values():
        for line in lines.values():
            order = sorted(range(len(line.steps)), key=lambda k: -line.steps[k])
            line.steps, line.errors, line.steadies = ([some[k] for k in order] for some in (line.steps, line.errors, line.steadies))
    return found


def drawings(verdict):
    case, found = verdict.case, frequencies(verdict.experiment, verdict.case)
    if not found:
        return []
    axis = ErrorAxis([line.errors for _, lines in found.values() for line in lines.values()])
    unsteady = sorted({m for _, lines in found.values() for m, line in lines.items() if not line.steady},
                      key=[row.label for row in verdict.rows].index)
    caption = sentences(
        "How much faster or slower than in the reference solution a vector turns, on the average over the same time for every step. "
        "This times the time is the phase that a method has lost, about which its energy says nothing.",
        *(f"In the solution {vector} " + ("stands still." if abs(rate) < 1e-12 else
                                          f"turns by {rate:.6g} rad per {unit_of(case)}.") for vector, (rate, _) in found.items()),
        "Open marks: the error changes by more than a third between the halves of the time at one step or more, as where energy is "
        f"lost or a slow oscillation is left: {', '.join(unsteady)}." if unsteady else "", *axis.remarks())
    return [Drawing("frequencies", case, f"{heading(case)}: errors of frequencies", caption,
                    lambda wide: draw(verdict, found, axis, wide))]


def unit_of(case):
    unit = case.get("time_unit") or ""
    return unit if unit and unit != "1" else "unit of time"


def draw(verdict, found, axis, wide):
    width, font, columns = (1120, 12.5, min(2, len(found))) if wide else (368, 11, 1)
    left, top, right, below, tall = (72, 26, 120, 46, 250) if wide else (60, 24, 92, 44, 200)
    part, deep = min(704, width / columns), top + tall + below
    canvas = Canvas(part * columns, deep * math.ceil(len(found) / columns), font)
    canvas.description = described(verdict, found)
    rank, by_label = ranks(verdict.curves), {row.label: row for row in verdict.rows}
    for k, (vector, (_, lines)) in enumerate(found.items()):
        axes, ends = canvas.panel(left + part * (k % columns), top + deep * (k // columns), part - left - right, tall), []
        for method, line in lines.items():
            if method not in by_label:
                continue
            family = by_label[method].curve.family
            look = style(family, rank[method], "full" if line.steady else "open") | {"linewidth": 1.5, "markersize": 4.5}
            placed = axis.place(line.errors)
            canvas.line(axes, line.steps, placed, f"{method}: {line.errors[0]:.1e} at the largest step", **look)
            ends.append((method, placed[-1], family.light))
        axis.apply(axes)
        step_axis(axes, [h for line in lines.values() for h in line.steps], lambda label: canvas.measure(label, 0.92)[0])
        axes.invert_xaxis()
        axes.set_title(vector.replace("$", r"\$"), fontsize=font, loc="left", pad=5)
        canvas.labels(axes, with_unit("step h", verdict.case.get("time_unit") or "") + ", finer to the right",
                      f"|error| in rad per {unit_of(verdict.case)}" if k % columns == 0 else "")
        right_of(canvas, axes, ends)
    return canvas


def described(verdict, found):
    """Who turns what best at the largest step that most methods have, of those whose errors are steady; a sentence for each
    vector."""
    parts = []
    for vector, (_, lines) in found.items():
        steps = [line.steps[0] for line in lines.values()]
        common = max(set(steps), key=steps.count)
        at = {method: line.errors[0] for method, line in lines.items() if line.steps[0] == common and line.steadies[0]}
        if len(at) < 2:
            continue
        best, worst = min(at, key=at.get), max(at, key=at.get)
        parts.append(f"At step {common:.4g} the frequency of {vector} is best with {best}, wrong by {at[best]:.1e}, and worst with "
                     f"{worst}, by {at[worst]:.1e} rad per {unit_of(verdict.case)}.")
    return " ".join(parts) or "Errors of frequencies against the step."
