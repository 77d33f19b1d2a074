"""Frequencies of the motion: how much faster or slower the vectors that a case names turn with each method than in the reference
solution, against the step. The measure `frequency` gives the rate of the solution, the error of the method's, and by how much that
error differs between the first half of the time and the second.

A wrong frequency is a phase that is lost in proportion to time. A method that keeps the energy at a fixed step may have any
frequency error, and one that loses energy has one that grows.
"""
import dataclasses
import math

from curves import ranks
from experiment import UNIT_ROUND_OFF
from families import style
from figures import Drawing, heading, sentences, with_unit
from lines import Line, Panel, draw, in_grey
from scales import ErrorAxis, step_axis

MEASURE = "frequency"  # whose table it draws
STEADY = 1 / 3  # of the error, by which it may change from half to half
ROUNDINGS = 64  # units of round-off of an angle over the time, below which nothing is known of an error


@dataclasses.dataclass
class Errors:
    steps: list = dataclasses.field(default_factory=list)
    errors: list = dataclasses.field(default_factory=list)  # without their signs
    steadies: list = dataclasses.field(default_factory=list)  # whether the error is the same in both halves of the time, or rounding

    @property
    def steady(self):
        return all(self.steadies)


def frequencies(experiment, case):
    """{vector: (rate of the solution, {method: Errors})}, in the experiment's order, from the largest step to the finest."""
    found = {}
    for _, cells in experiment.table(MEASURE, case):
        step, rate, error, change, time = (cells[k] for k in ("step", "frequency", "error", "change", "t"))
        if math.isnan(error):
            continue
        _, lines = found.setdefault(cells["vector"], (rate, {}))
        line = lines.setdefault(cells["method"], Errors())
        line.steps.append(step)
        line.errors.append(abs(error))
        rounding = ROUNDINGS * UNIT_ROUND_OFF["double"] * (abs(rate) + 1 / time if time > 0 else abs(rate))  # angles are doubles
        line.steadies.append(abs(change) <= STEADY * abs(error) or max(abs(change), abs(error)) <= rounding)
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
    panels = [panel(verdict, vector, lines, axis) for vector, (_, lines) in found.items()]
    caption = sentences(
        "How much faster or slower than in the reference solution a vector turns, on the average over the same time for every step. "
        "This times the time is the phase that a method has lost, about which its energy says nothing.",
        *(f"In the solution {vector} " + ("stands still." if abs(rate) < 1e-12 else
                                          f"turns by {rate:.6g} rad per {unit_of(case)}.") for vector, (rate, _) in found.items()),
        "Unsteady: the error changes by more than a third between the halves of the time at one step or more, as where energy is "
        f"lost or a slow oscillation is left: {', '.join(unsteady)}." if unsteady else "", in_grey(panels), *axis.remarks())
    return [Drawing("frequencies", case, f"{heading(case)}: errors of frequencies", caption,
                    lambda wide: draw(panels, wide, described(verdict, found), tall=250))]


def unit_of(case):
    unit = case.get("time_unit") or ""
    return unit if unit and unit != "1" else "unit of time"


def panel(verdict, vector, found, axis):
    rank, by_label, unit = ranks(verdict.curves), {row.label: row for row in verdict.rows}, verdict.case.get("time_unit") or ""
    lines = [Line(method, line.steps, line.errors,
                               style(by_label[method].curve.family, rank[method], by_label[method].curve.fill),
                               f"{method}: {line.errors[0]:.1e} at the largest step", "" if line.steady else "unsteady", marks=True)
             for method, line in ((method, found[method]) for method in verdict.in_order(found))]

    def steps(canvas, axes):
        step_axis(axes, [h for line in lines for h in line.x], lambda label: canvas.measure(label, 0.92)[0])
        axes.invert_xaxis()
    return Panel(lines, axis, with_unit("step h", unit) + ", finer to the right",
                 f"|error| in rad per {unit_of(verdict.case)}", steps, vector)


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
