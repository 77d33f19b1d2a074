"""The verdict on a case: who keeps the structure, and what an error costs each method. Numbers only; table and sentence say
them in words.

level    the cost at which methods are compared: of 1, 2, 5 times a power of ten the one that most methods' runs span; of
         several the nearest to the best cost at the target. The program chooses it where it made runs at that cost; their
         errors and drifts are then those of the table, and nothing is interpolated.
target   the error that the sentence speaks of: 1e-6, or where nobody reaches it the smallest power of ten that two do.
"""
import dataclasses
import math
import statistics

from curves import ZERO, Curve, curves, front
from error_measure import error_measure
from experiment import DIRECTIONS, UNIT_ROUND_OFF, Run
from findings import largest_setback
from wording import short_count, short_time

TARGETS = (1e-3, 1e-6, 1e-9, 1e-12)
LEAD = 1e-6
TIE = 1.1


@dataclasses.dataclass
class Row:
    curve: Curve
    run: Run | None = None  # the one nearest to the level
    error: float = math.nan  # interpolated at the level
    off: bool = False  # the method cannot cost the level
    drift: float = math.nan  # of `run`: the largest change, or the largest move against the expected direction
    drift_class: str = ""
    times: dict = dataclasses.field(default_factory=dict)  # target -> (cost, at most)

    @property
    def label(self):
        return self.curve.label

    def sort_key(self, lead, first):
        return tuple(math.inf if math.isnan(x) else x for x in (
            self.times[lead][0], self.times[first][0], self.error, self.drift))


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
        self.rows = [Row(c, times={t: c.time_to(t, self.of_state) for t in self._asked()}) for c in self.curves]
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
        if self.best(LEAD):
            return LEAD
        reached = [t for t in sorted(self._asked()) if sum(r.times[t][0] > 0 for r in self.rows) >= min(2, len(self.rows))]
        return reached[0] if reached else None

    def best(self, target):
        """The rows that are cheapest at a target within ties, the cheapest first; empty if nobody reaches it."""
        reached = sorted((r for r in self.rows if r.times[target][0] > 0), key=lambda r: r.times[target][0])
        if not reached:
            return []
        limit = reached[0].times[target][0] * max(TIE, reached[0].curve.spread_at(reached[0].times[target][0]))
        return [r for r in reached if r.times[target][0] <= limit]

    def _level(self):
        spans = [(min(costs), max(costs)) for c in self.curves if (costs := [p.cost for p in c.points if p.cost > 0])]
        if not spans:
            return math.nan
        low, high = min(s[0] for s in spans), max(s[1] for s in spans)
        grid = [m * 10.0**k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for m in (1, 2, 5)]
        best = self.best(self.target) if self.target else []
        goal = best[0].times[self.target][0] if best else math.sqrt(low * high)

        def worth(level):
            return sum(a <= level <= b for a, b in spans), -abs(math.log(level / goal))
        return max(grid, key=worth)

    def _at_level(self, row):
        points = row.curve.points
        found = row.curve.at_cost(self.level) if self.level > 0 else None
        if found:
            row.run, row.error, row.off = found
            made = self.made.get(row.label)
            if made and not made.failed:
                measured = self.measure.of(made) if self.measure else math.nan
                row.run, row.off = made, False
                row.error = measured if math.isnan(measured) else max(ZERO * self.unit, measured)
        elif points:  # nothing is known of costs: the run at the step that most methods share
            step = self.experiment.common_step(self.case)
            row.run = min(points, key=lambda p: abs(math.log(p.run.step / step))).run
        if row.run and self.invariant:
            members = [r for r in self.experiment.ensemble_of(row.run) if not r.failed]
            row.drift_class = statistics.mode(r.drift_class(self.invariant) for r in members)
            row.drift = statistics.median(
                largest_setback(self.experiment, r, self.invariant, self.expected) if self.expected in DIRECTIONS else
                r.drift(self.invariant, "max") for r in members)

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

    def loses(self, row):
        """Whether the conserved quantity drifts away at equal cost."""
        classes = self.experiment.drift_classes
        return bool(row.drift_class) and self.expected not in DIRECTIONS and classes[row.drift_class].grows

    def untold(self, row):
        """Whether it is not known if the conserved quantity drifts away at equal cost."""
        classes = self.experiment.drift_classes
        return (bool(row.drift_class) and self.expected not in DIRECTIONS and not classes[row.drift_class].grows
                and not classes[row.drift_class].keeps)

    @property
    def structured(self):
        return any(r.curve.kept is not None for r in self.rows)

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

    def named(self, limit=8):
        """Labels of the methods that get colour: those the sentence may name, the best of each family, the front, and
        then by the time to the largest target."""
        target = self.target or LEAD
        ranked = sorted(self.rows, key=lambda r: r.sort_key(target, TARGETS[0]))
        chosen = [r.label for r in self.best(target)]
        families = []
        for row in ranked:
            if row.curve.family not in families:
                families.append(row.curve.family)
                chosen.append(row.label)
        on_front = [p.run.method for p in front(self.curves)]
        chosen += sorted(set(on_front), key=lambda label: (-on_front.count(label), label))
        return list(dict.fromkeys(chosen + [r.label for r in ranked]))[:limit]


def work_of(experiment, case):
    """What cost is counted in: time if it was measured, otherwise right-hand sides if all methods count them."""
    finished = [r for r in experiment.runs_of(case) if not r.failed]
    if any(r.cost for r in finished):
        return "time"
    return "right-hand sides" if all(r.total_rhs > 0 for r in finished) else "steps"
