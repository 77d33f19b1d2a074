"""Poincaré's integral invariant: the integral of F·dz, p dq of canonical systems, around a loop of states that each method
carries along. measures/poincare-loop.csv has it at about fifty times, over that at the start, with what it changes by where every other point of
the loop is left out.

The derivative along the loop is that of a trigonometric polynomial, whose error with all points is about the square of that with
half of them. A loop that winds up is drawn while the latter is below one in a million.
"""
import dataclasses

from canvas import MID
from curves import ranks
from experiment import UNIT_ROUND_OFF
from families import style
from figures import Drawing, heading, sentences, step_text, time_label
from lines import Line, Panel, draw, in_grey
from scales import ErrorAxis, time_axis
from wording import counted

MEASURE = "poincare-loop"  # whose table it draws
RESOLVED = 1e-6


@dataclasses.dataclass
class Loop:
    step: float
    times: list = dataclasses.field(default_factory=list)
    deviations: list = dataclasses.field(default_factory=list)  # of the integral over that at the start from 1
    whole: bool = True  # resolved to the end


def loops(experiment, case):
    """{method: Loop}, each up to the time at which it is no longer resolved."""
    found = {}
    for _, cells in experiment.table(MEASURE, case):
        one = found.setdefault(cells["method"], Loop(cells["step"]))
        one.whole = one.whole and cells["uncertainty"] <= RESOLVED
        if one.whole:
            one.times.append(cells["t"])
            one.deviations.append(abs(cells["integral"] - 1))
    return found


def drawings(verdict):
    case, found = verdict.case, loops(verdict.experiment, verdict.case)
    rows = {row.label: row for row in verdict.rows}
    shown = [(rows[label], found[label]) for label in verdict.in_order(found) if len(found[label].times) > 2]
    if not shown:
        return []
    axis = ErrorAxis([one.deviations[1:] for _, one in shown], UNIT_ROUND_OFF["double"], bounded=True)
    steps = {one.step for _, one in shown}
    at = "at " + (step_text(steps.pop(), case) if len(steps) == 1 else "the largest step at which each method finishes")
    told = sentences(
        f"How far the integral of F·dz (p dq of canonical systems) around a loop of states that a method carries along, {at}, has "
        "moved from that at the start, for at most a thousand steps. It stays where every step keeps the structure dF; dashed is unit "
        "round-off.",
        "" if all(one.whole for _, one in shown) else
        "A line ends where the loop is so wound up that its 64 points no longer say where it is.",
        *axis.remarks())
    rank, worst = ranks(verdict.curves), max(shown, key=lambda one: max(one[1].deviations))
    lines = [Line(row.label, one.times[1:], one.deviations[1:], style(row.curve.family, rank[row.label], row.curve.fill),
                  f"{row.label}: largest {max(one.deviations):.1e}") for row, one in shown]
    panel = Panel(lines, axis, time_label(case), "|∮F·dz over the first − 1|",
                  lambda _, axes: time_axis(axes, 0, max(one.times[-1] for _, one in shown)), more=unit_round_off)
    return [Drawing("loop", case, f"{heading(case)}: Poincaré's integral invariant", sentences(told, in_grey([panel])),
                    lambda wide: draw([panel], wide, f"Of {counted(len(shown), 'method')} the integral moves most for {worst[0].label}, by "
                                                     f"{max(worst[1].deviations):.1e} of itself.", tall=250))]


def unit_round_off(_, axes):
    axes.axhline(UNIT_ROUND_OFF["double"], color=MID, linewidth=0.8, linestyle=(0, (4, 2)), zorder=1)
