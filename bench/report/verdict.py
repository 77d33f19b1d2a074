"""The verdict on a case: who keeps the structure, and what an error costs each method. Numbers only; table and sentence say
them in words.

level    the cost at which methods are compared: of 1, 2, 5 times a power of ten the one that most methods' runs span; of
         several the nearest to the best cost at the target. The program chooses it where it made runs at that cost; their
         errors and drifts are then those of the table, and nothing is interpolated.
target   the error that the sentence speaks of: of the powers of ten the one that lies between the errors of two runs of most
         methods; of several the nearest to 1e-6. Methods are ranked at an error only by runs on both sides of it.
rivals   the methods whose motion is that of the case: a formulation that makes another motion is no rival.
"""
import dataclasses
import functools
import math
import statistics

from astray import astray, reach
from curves import GROWN, ZERO, Curve, curves, front
from error_measure import error_measure
from experiment import DIRECTIONS, ROUND_OFF, UNIT_ROUND_OFF, Run
from families import LINES
from findings import largest_setback
from wording import short_count, short_time

TARGETS = (1e-3, 1e-6, 1e-9, 1e-12)
LEAD = 1e-6
TIE = 1.1
EQUAL = 1.25  # costs that differ by less than this factor are called equal
APART = 1.5  # times a step, from which on another step is larger
FALLEN = 4  # times a drift, from which on it falls with the step; of a random walk that doubles the steps it grows 1.4-fold


@dataclasses.dataclass(eq=False)
class Row:
    curve: Curve
    run: Run | None = None  # the one nearest to the level
    error: float = math.nan  # interpolated at the level
    cost: float = math.nan  # of `run`
    off: bool = False  # `run` does not cost the level
    drift: float = math.nan  # of `run`: the largest change, or the largest move against the expected direction
    drift_class: str = ""
    drifts: bool | None = None  # in `run` the quantity drifts away, or moves against its direction; None: not known
    astray: str = ""  # how `run` makes another motion; that its error stays is then no merit, and `drifts` not known
    times: dict = dataclasses.field(default_factory=dict)  # target -> (cost, at most)

    @property
    def label(self):
        return self.curve.label

    def ranked(self, target):
        """Whether runs lie on both sides of the target, so that its cost is known and not merely bounded."""
        cost, at_most = self.times[target]
        return cost > 0 and not at_most

    def sort_key(self, lead, first):
        """Ranked methods before others, which are sorted by what they reach at equal cost."""
        costs = [self.times[t][0] if self.ranked(t) else math.inf for t in (lead, first)]
        return (*costs, *(math.inf if math.isnan(x) else x for x in (self.error, self.drift)))


class Verdict:
    def __init__(self, experiment, case):
        self.experiment, self.case = experiment, case
        self.work = work_of(experiment, case)
        self.curves = curves(experiment, case, self.work)
        self.measure = error_measure(experiment, case)
        self.of_state = self.measure is not None and self.measure.of_state
        self.relative = self.measure is not None and self.measure.relative
        self.comparable = self.measure is not None
        self.invariant = case.get("conserved") or ""
        self.expected = experiment.expectation(case, self.invariant)[0] if self.invariant else ""
        self.unit = UNIT_ROUND_OFF[case["precision"]]
        self.rows = [Row(c, times={t: c.time_to(t) for t in self._asked()}) for c in self.curves]
        self.target = self._target()
        self.level, self.made = (experiment.equal.get(case["name"]) if self.work == "time" else None) or (self._level(), {})
        for row in self.rows:
            self._at_level(row)
        lead = LEAD if self.target is None else self.target
        self.rows.sort(key=lambda r: r.sort_key(lead, TARGETS[0]))

    @staticmethod
    def _asked():
        return (*TARGETS, *(x for k in range(1, 16) if (x := float(f"1e-{k}")) not in TARGETS))

    def _target(self):
        if not self.comparable:
            return None
        counts = {t: len(self.ranked(t)) for t in self._asked()}
        most = max(counts.values())
        return min((t for t, n in counts.items() if n == most), key=lambda t: abs(math.log(t / LEAD))) if most > 1 else None

    @property
    def rivals(self):
        return [r for r in self.rows if not r.curve.method.get("another_motion")] or self.rows

    def ranked(self, target):
        """The rivals of which runs lie on both sides of a target, the cheapest first."""
        return sorted((r for r in self.rivals if r.ranked(target)), key=lambda r: r.times[target][0])

    def best(self, target):
        """The rows that are cheapest at a target within ties, the cheapest first; empty where fewer than two are ranked."""
        ranked = self.ranked(target)
        return [r for r in ranked if tied(ranked[0], r, target)] if len(ranked) > 1 else []

    def _level(self):
        spans = [(min(costs), max(costs)) for c in self.curves if (costs := [p.cost for p in c.points if p.cost > 0])]
        if not spans:
            return math.nan
        low, high = min(s[0] for s in spans), max(s[1] for s in spans)
        grid = [m * 10.0**k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for m in (1, 2, 5)]
        best = self.ranked(self.target) if self.target else []
        goal = best[0].times[self.target][0] if best else math.sqrt(low * high)

        def worth(level):
            return sum(a <= level <= b for a, b in spans), -abs(math.log(level / goal))
        return max(grid, key=worth)

    def _at_level(self, row):
        points = row.curve.points
        found = row.curve.at_cost(self.level) if self.level > 0 else None
        if found:
            row.run, row.error, row.cost = found
            made = self.made.get(row.label)
            if made and not made.failed:
                measured = self.measure.of(made) if self.measure else math.nan
                row.run, row.cost = made, self.level
                row.error = measured if math.isnan(measured) else max(ZERO * self.unit, measured)
        elif points:  # nothing is known of costs: the run at the step that most methods share
            step = self.experiment.common_step(self.case)
            row.run = min(points, key=lambda p: abs(math.log(p.run.step / step))).run
        row.off = not abs(math.log(row.cost / self.level)) <= math.log(EQUAL) if self.level > 0 else bool(row.run)
        if row.run and self.invariant:
            members = [r for r in self.experiment.ensemble_of(row.run) if not r.failed]
            row.drift_class, row.drifts = self.class_of(row.run)
            sizes = [largest_setback(self.experiment, self.case, r, self.invariant, self.expected) if self.expected in DIRECTIONS else
                     r.drift(self.invariant, "max") for r in members]
            row.drift = math.nan if any(map(math.isnan, sizes)) else statistics.median(sizes)
            if self.expected in DIRECTIONS:  # a move against the direction, by more than round-off
                row.drifts = None if math.isnan(row.drift) else row.drift > ROUND_OFF * self.unit
            row.astray = astray(self, row.run) if row.drifts is False else ""
            row.drifts = None if row.astray else row.drifts

    @functools.cached_property
    def reach(self):
        return reach(self.experiment, self.case)

    def of_rounding(self, curve, run):
        """Whether the drift of a run is round-off: GROWN units of the quantity at the start at most, and no less than in the run of the
        method with the next larger step, or no more than in that with the next smaller one. What truncation does falls with the step,
        whatever the size of the quantity, such as a rest energy; of a method with a run at one step alone it is not known."""
        series = self.experiment.series(run, self.invariant)
        own = run.drift(self.invariant, "max")
        if not series or not own <= GROWN * self.unit * abs(series.initial):
            return False
        size = (lambda r: float(r.tolerance)) if curve.adaptive else (lambda r: r.step)
        others = [(size(p.run) / size(run), d) for p in curve.points if not math.isnan(d := p.run.drift(self.invariant, "max"))]
        coarser = min(((ratio, d) for ratio, d in others if ratio >= APART), default=None)
        finer = max(((ratio, d) for ratio, d in others if ratio <= 1 / APART), default=None)
        falls = [coarser and coarser[1] >= FALLEN * own, finer and finer[1] <= own / FALLEN]
        return any((coarser, finer)) and not any(falls)

    def residual(self, row, level):
        """The largest residual of a level of constraints at equal cost, of an ensemble the median over its seeds; nan where
        there is none."""
        members = [r for r in self.experiment.ensemble_of(row.run) if not r.failed] if row.run else []
        sizes = [x for r in members if not math.isnan(x := r.drift(level, "max"))]
        return statistics.median(sizes) if sizes else math.nan

    def which_runs(self):
        """In which runs methods are shown at equal cost, in a sentence; empty where costs are not known."""
        if not self.level > 0:
            return ""
        cost = self.cost_text(self.level)
        return (f"Each method was run at the step at which it takes {cost}, as far as it can." if self.made else
                f"Each method in the run whose cost is nearest to {cost}.")

    def class_of(self, run):
        """(the class of drift of a run, whether the error grows): True, False, or None where the class does not tell. Of an
        ensemble the most frequent class, and what more than half of the seeds say."""
        found = [r.drift_class(self.invariant) for r in self.experiment.ensemble_of(run) if not r.failed]
        classes = [self.experiment.drift_classes.get(name) for name in found]
        grow, keep = (sum(bool(c) and getattr(c, key) for c in classes) for key in ("grows", "keeps"))
        return (statistics.mode(found) if found else "",
                True if 2 * grow > len(found) else False if 2 * keep > len(found) else None)

    @property
    def structured(self):
        """Whether what does not keep the structure could be seen."""
        return any(r.curve.residuals for r in self.rows)

    @property
    def failures(self):
        return sum(r.curve.failed for r in self.rows)

    @property
    def contended(self):
        """(timings whose median is well above their fastest repetition, all timings)"""
        timed = [p for c in self.curves for p in c.points if p.cost > 0] if self.work == "time" else []
        return sum(p.contended for p in timed), len(timed)

    def floor(self):
        """The error below which round-off rules: the median over the methods that reach it; nan if none does."""
        floors = sorted(f for c in self.curves if not math.isnan(f := c.floor()))
        return floors[len(floors) // 2] if floors else math.nan

    def cost_text(self, cost):
        return short_time(cost) if self.work == "time" else short_count(cost)

    def named(self, limit=LINES):
        """Labels of the methods that get colour, the first ones first: those the sentence may name, one whose runs failed and the one
        that drifts most, the best of each family, the front, and then by the time to the largest target."""
        target = self.target or LEAD
        ranked = sorted(self.rows, key=lambda r: r.sort_key(target, TARGETS[0]))
        chosen = [r.label for r in self.best(target)][:LINES - 2]
        chosen += [r.label for r in sorted(ranked, key=lambda r: -r.curve.failed)[:1] if r.curve.failed]
        chosen += [r.label for r in sorted(ranked, key=lambda r: -r.drift if r.drifts else math.inf)[:1] if r.drifts]
        families = []
        for row in ranked:
            if row.curve.family not in families:
                families.append(row.curve.family)
                chosen.append(row.label)
        on_front = [p.run.method for p in front(self.curves)]
        chosen += sorted(set(on_front), key=lambda label: (-on_front.count(label), label))
        return list(dict.fromkeys(chosen + [r.label for r in ranked]))[:limit]

    def in_order(self, labels):
        """Labels in the order in which they get colour."""
        return [label for label in self.named(len(self.rows)) if label in labels]


def tied(one, other, target):
    """Whether two costs of a target differ by no more than timings do: by a tenth, or by the spread of either."""
    costs = sorted((r.times[target][0], r.curve.slowest_to(target)) for r in (one, other))
    return costs[1][0] <= max(TIE * costs[0][0], costs[0][1])


def work_of(experiment, case):
    """What cost is counted in: time if it was measured, otherwise right-hand sides if all methods count them."""
    finished = [r for r in experiment.runs_of(case) if not r.failed]
    if any(r.cost for r in finished):
        return "time"
    return "right-hand sides" if all(r.total_rhs > 0 for r in finished) else "steps"
