"""Reversibility along the run: how far a method misses its start when it goes forward to t, turns round and goes back as many
steps. measures/reversibility.csv has it at about a dozen times, as |z − z(0)|/|z(0)|, with what one rounding of the state at the turn makes
of the same distance.

A method is said to come back where it never misses its start by more than ROUND_OFF times what one rounding has made so far,
and that is at least unit round-off: the limit within which residuals of the structure are at round-off too. Methods without
such a number of their own are judged by that of the method in the middle, which is drawn.
"""
import dataclasses
import math

from canvas import MID
from curves import ranks
from experiment import ROUND_OFF, UNIT_ROUND_OFF
from families import style
from figures import Drawing, heading, sentences, step_text, time_label
from files import InputError
from lines import Line, Panel, draw, in_grey
from scales import ErrorAxis, time_axis
from verdict import Row
from wording import listed

MEASURE = "reversibility"  # whose table it draws
WAYS = ("reversal", "negative steps")
UNIT = UNIT_ROUND_OFF["double"]  # whatever the precision of the case
NAMED = 4  # methods that miss the start, with by how much


@dataclasses.dataclass
class Returns:
    step: float
    by: str  # one of WAYS
    times: list = dataclasses.field(default_factory=list)
    distances: list = dataclasses.field(default_factory=list)
    roundings: list = dataclasses.field(default_factory=list)  # nan where it is not known
    whole: bool = True  # steps of every way back end well

    @property
    def farthest(self):
        return max(self.distances)

    @property
    def rounding(self):
        """The largest of what a rounding makes; nan where none is known."""
        return max((x for x in self.roundings if not math.isnan(x)), default=math.nan)

    def comes_back(self, middle):
        """Whether it misses the start by no more than rounding makes of it; `middle` are returns with known roundings."""
        judge = self if not math.isnan(self.rounding) else middle
        known = [(t, x) for t, x in zip(judge.times, judge.roundings) if not math.isnan(x)] if judge else []
        return all(d <= ROUND_OFF * max([UNIT] + [x for s, x in known if s <= t * (1 + 1e-9)])
                   for t, d in zip(self.times, self.distances))


@dataclasses.dataclass
class Shown:
    row: Row
    returns: Returns
    back: bool  # it comes back

    @property
    def label(self):
        return self.row.label


def returns(experiment, case):
    """{method: Returns}"""
    found = {}
    for where, cells in experiment.table(MEASURE, case):
        step, t, distance, rounding = (cells[k] for k in ("step", "t", "distance", "rounding"))
        if cells["by"] not in WAYS:
            raise InputError(f"{where}, column by: expected {' or '.join(WAYS)}, got '{cells['by']}'")
        one = found.setdefault(cells["method"], Returns(step, cells["by"]))
        if math.isnan(distance):
            one.whole = False
            continue
        for values, x in ((one.times, t), (one.distances, distance), (one.roundings, rounding)):
            values.append(x)
    return {label: one for label, one in found.items() if len(one.times) > 1}


def in_the_middle(found):
    """Of several returns those whose largest rounding is the median; None where none is known."""
    known = sorted((one for one in found if not math.isnan(one.rounding)), key=lambda one: one.rounding)
    return known[len(known) // 2] if known else None


def drawings(verdict):
    case, found = verdict.case, returns(verdict.experiment, verdict.case)
    middle = in_the_middle(found.values())
    shown = [Shown(row, found[row.label], found[row.label].comes_back(middle)) for row in verdict.rows if row.label in found]
    if not shown:
        return []
    axis = ErrorAxis([visible(one.returns) for one in shown], UNIT)
    steps = {one.returns.step for one in shown}
    at = "at " + (step_text(steps.pop(), case) if len(steps) == 1 else "the largest step at which it finishes")
    told = sentences(
        finding(shown, verdict.rows),
        f"Each method goes forward to time t {at}, turns round and goes back as many steps: how far it then is from its start, over "
        "the size of the start.", way(shown),
        "A method that treats both directions of time alike comes back; others miss the start by about the error of their steps. "
        "Nothing is drawn below unit round-off, the dashed line."
        + (" Dotted is what one rounding of the state at the turn becomes on the way back, as the motion makes it grow." if middle
           else ""),
        left_out(verdict, found),
        "" if all(one.returns.whole for one in shown) else "A line has no point where a step of the way back fails.",
        *axis.remarks())
    panel = panel_of(verdict, shown, middle, axis)
    return [Drawing("reversibility", case, f"{heading(case)}: reversibility along the run", sentences(told, in_grey([panel])),
                    lambda wide: draw([panel], wide, finding(shown, verdict.rows), tall=250))]


def visible(one):
    """The distances, those below unit round-off on it: they say nothing."""
    return [max(UNIT, d) for d in one.distances]


def finding(shown, rows):
    """Who comes back, of the rows of a verdict that were turned round, and by how much others miss the start."""
    back, gone = [one for one in shown if one.back], [one for one in shown if not one.back]
    turned = "" if len(shown) == len(rows) else " that was turned round"
    who = (f"Every method{turned} comes" if len(back) == len(shown) > 1 else f"{back[0].label} comes" if len(back) == 1 else
           f"{len(back)} of {len(shown)} methods come" if back else f"No method{turned} comes")
    if not gone:
        return f"{who} back to its start but for rounding."
    gone.sort(key=lambda one: -one.returns.farthest)
    first = gone if len(gone) <= NAMED else gone[:NAMED - 1]
    by = [f"{one.label} by {'up to ' if k == 0 else ''}{one.returns.farthest:.1e}" for k, one in enumerate(first)]
    by += [f"{len(gone) - len(first)} more by less"] if len(first) < len(gone) else []
    return (f"{who} back to the start" + (" but for rounding. The start is missed by " if back else ": it is missed by ")
            + "; ".join(by) + ".")


def way(shown):
    mirrored = "the system's own reversal, as a rule that of the signs of momenta, turns the state round"
    against = [one.label for one in shown if one.returns.by == "negative steps"]
    if len(against) == len(shown):
        return "The way back is one of negative steps."
    if not against:
        return f"{mirrored[:1].upper()}{mirrored[1:]}."
    return f"{listed(against)} {'goes' if len(against) == 1 else 'go'} back by negative steps; for the others {mirrored}."


def left_out(verdict, found):
    """A sentence on the methods that have ended well at a fixed step, but of which nothing is known."""
    runs = [r for r in verdict.experiment.runs_of(verdict.case) if not r.failed and not r.tolerance]
    missing = [row.label for row in verdict.rows if row.label not in found and any(r.method == row.label for r in runs)]
    if not missing:
        return ""
    return (f"Left out {'is' if len(missing) == 1 else 'are'} {listed(missing)}: a method that remembers earlier steps cannot be turned "
            "round by its state, and on some ways back a step fails.")


def panel_of(verdict, shown, middle, axis):
    rank, times = ranks(verdict.curves), [t for one in shown for t in one.returns.times]
    group = f"{sum(one.back for one in shown)} come back"
    lines = [Line(one.label, one.returns.times, visible(one.returns), style(one.row.curve.family, rank[one.label], one.row.curve.fill),
                  f"{one.label}: at most {one.returns.farthest:.1e}" + (", comes back" if one.back else ""),
                  group=group if one.back else "") for one in shown]

    def one_rounding(canvas, axes):
        axes.axhline(UNIT, color=MID, linewidth=0.8, linestyle=(0, (4, 2)), zorder=1)
        if middle:
            known = [(t, max(UNIT, x)) for t, x in zip(middle.times, middle.roundings) if not math.isnan(x)]
            canvas.line(axes, *zip(*known), "one rounding at the turn", color=MID, linewidth=1.2, linestyle=(0, (1, 1.6)), zorder=2)
    return Panel(lines, axis, time_label(verdict.case, "t at the turn"), "distance from the start",
                 lambda _, axes: time_axis(axes, min(times), max(times)), more=one_rounding)
