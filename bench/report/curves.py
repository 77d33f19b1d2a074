"""What the runs of a case say of each method: cost and error of every run, and what follows from them by interpolation.

cost     the time of a run is that of its fastest repetition, sampling excluded; where nothing was timed, right-hand sides
         stand for it, and steps where a method counts none. A coarser step is never charged more time than a finer one:
         a timing that says so was disturbed.
error    as error_measure.py has it: of the state, or of a conserved quantity.
An ensemble counts as one run, with the median over the seeds that finished. Failed runs enter nothing but their count.
"""
import dataclasses
import math
import statistics

from error_measure import error_measure
from experiment import ABOVE_ROUND_OFF, ROUND_OFF, UNIT_ROUND_OFF, Run
from families import family_named

CONTENDED = 1.3  # a timing whose median is above this times its fastest repetition was disturbed
LOST = 0.5  # a relative error of this size says nothing any more: the phase is lost
GROWN = 1e5  # units of round-off to which a residual that is round-off at the coarsest step may grow at finer ones
RESIDUAL_ABOVE = 1000  # units of round-off above which residuals show their power of the step
REACHED = 1 + 1e-8  # an error that is a target but for its last digits reaches it
SMALLER = 0.9  # times an error, below which another is smaller
ZERO = 0.1  # units of round-off at which an error of zero stands, which has no place on a logarithmic axis
STUDENT = {1: 12.706, 2: 4.303}  # 95 % two-sided quantiles, by degrees of freedom


@dataclasses.dataclass
class Point:
    run: Run  # of an ensemble, the first seed that finished
    cost: float  # ns, right-hand sides or steps; nan where it is not known
    slowest: float  # cost at the median repetition
    error: float

    @property
    def contended(self):
        return self.slowest > CONTENDED * self.cost


@dataclasses.dataclass
class Order:
    value: float
    interval: float  # half the width of the 95 % interval, nan for the finest pair alone
    surprising: bool  # disagrees with the claim


@dataclasses.dataclass
class Curve:
    """A method on a case: its finished runs, from the coarsest to the finest."""
    method: dict
    claimed: int | None
    points: list
    failed: int
    total: int
    residuals: list  # [(step, structure residual)], failed runs left out
    unit: float  # unit round-off
    of_state: bool = True  # errors are of the state, whose order the method claims; those of a quantity may fall faster
    claims: bool = False  # the method claims to keep the structure of the case
    structured: bool = True  # the case has a structure to keep
    kinked: bool = False  # its field has kinks, where the Jacobian of a step does not show what the step does

    @property
    def label(self):
        return self.method["label"]

    @property
    def family(self):
        return family_named(self.method.get("family"))

    @property
    def adaptive(self):
        return any(p.run.tolerance for p in self.points)

    @property
    def kept(self):
        """Whether the structure is kept: True, False, or None where that is not known.

        It is kept where the method claims it, a run finished and no residual says otherwise, and where the residual is round-off at the
        coarsest step although the square of the error of a step is not: what truncation leaves of a residual is largest there,
        of methods that are nearly symplectic no less than that square, and of a step that is more precise a small residual is
        accuracy. At finer steps round-off may grow, because what a method solves for in a step is divided by the step."""
        if any(x > GROWN * self.unit for _, x in self.residuals):
            return False
        if self.claims:
            return True if self.points else None
        if not self.residuals:
            return None
        if max(self.residuals)[1] > ROUND_OFF * self.unit:
            return False
        coarsest = max(self.points, key=lambda p: p.run.step)
        if self.kinked:  # forces that are constant between kinks leave the residual nothing to see
            return None
        seen = self.of_state and (coarsest.error / max(1.0, coarsest.run.steps)) ** 2 > ROUND_OFF * self.unit
        return True if seen else None

    @property
    def fill(self):
        """Of the mark, which is full where the structure is kept and nowhere else; open where there is none to keep."""
        return {True: "full", False: "open", None: "half"}[self.kept] if self.structured else "open"

    def residual_power(self):
        """The power of the step that the residual falls with, or nan."""
        seen = [(math.log(h), math.log(x)) for h, x in self.residuals if RESIDUAL_ABOVE * self.unit < x < math.inf]
        return fitted_slope(seen)[0] if len({x for x, _ in seen}) > 1 else math.nan

    def measured(self):
        """Points with an error and a cost, from the coarsest to the finest."""
        return [p for p in self.points if p.cost > 0 and 0 < p.error < math.inf]

    def bracket(self, target):
        """(coarse, fine): neighbouring runs on both sides of an error, those that reach it first; None where there are none,
        as where the coarsest run is better already. A run whose phase is lost says nothing about errors, and is no side."""
        target *= REACHED
        points = self.measured()
        pairs = [(a, b) for a, b in zip(points, points[1:]) if a.error > target >= b.error]
        if not pairs or points[0].error <= target:
            return None
        first = min(pairs, key=lambda pair: between(*pair, target))
        return None if self.lost(first[0]) else first

    def lost(self, point):
        return self.of_state and point.error >= LOST

    def time_to(self, target):
        """(cost at which the error is at most the target, whether that is no more than a bound): a bound where no runs are on
        both sides of the target, because the coarsest run is better already or the phase is lost at the one before; nan if
        never."""
        sides = self.bracket(target)
        if sides:
            return between(*sides, target * REACHED), False
        reached = [p.cost for p in self.measured() if p.error <= target * REACHED]
        return (min(reached), True) if reached else (math.nan, False)

    def slowest_to(self, target):
        """The cost of a target by the median repetitions; nan where it is not between two runs."""
        sides = self.bracket(target)
        return between(*sides, target * REACHED, lambda p: p.slowest) if sides else math.nan

    def disturbed_at(self, target):
        """Whether a timing on one of the sides of a target was disturbed."""
        return any(p.contended for p in self.bracket(target) or ())

    def floor(self):
        """The error from which round-off rules: where a finer step gains less than half of what the order claims."""
        points = [p for p in self.points if 0 < p.error < LOST / 5]
        for coarse, fine in zip(points, points[1:]):
            ratio = math.log(coarse.run.step / fine.run.step) if coarse.run.step > fine.run.step else 0
            if self.claimed and ratio > 0 and math.log(coarse.error / fine.error) < self.claimed / 2 * ratio:
                # A method that is merely not yet in its asymptotic regime goes on falling after the weak pair.
                if all(p.error > coarse.error / 10 for p in points[points.index(fine):]):
                    return min(p.error for p in points[points.index(coarse):])
        return math.nan

    def order(self):
        """The order at the steps where it can be seen, or None."""
        floor = self.floor()
        if self.adaptive:
            return None
        least = max(ABOVE_ROUND_OFF * self.unit, 0 if math.isnan(floor) else 30 * floor)
        seen = [(math.log(p.run.step), math.log(p.error)) for p in self.points if least < p.error < 0.1][-4:]
        if len({x for x, _ in seen}) < 2:
            return None
        value, interval = fitted_slope(seen)
        if len(seen) > 2:
            interval += abs(value - settled(seen))
        if not interval <= 1:
            value, interval = fitted_slope(seen[-2:])[0], math.nan
        off = math.inf if self.claimed is None else abs(value - self.claimed) if self.of_state else self.claimed - value
        return Order(value, interval, not math.isnan(interval) and off > max(0.15, interval))

    def at_cost(self, level):
        """(run, error, cost): the run nearest to a cost, the error interpolated there, and what the run costs."""
        points = [p for p in self.points if p.cost > 0]
        if not points:
            return None
        near = min(points, key=lambda p: abs(math.log(p.cost / level)))
        for coarse, fine in zip(points, points[1:]):
            if coarse.cost <= level <= fine.cost and min(coarse.error, fine.error) > 0 and coarse.cost < fine.cost:
                part = math.log(level / coarse.cost) / math.log(fine.cost / coarse.cost)
                return near.run, coarse.error ** (1 - part) * fine.error**part, near.cost
        return near.run, near.error, near.cost


def between(coarse, fine, target, cost=lambda point: point.cost):
    """The cost of an error between those of two runs: straight between them in logarithms."""
    part = math.log(coarse.error / target) / math.log(coarse.error / fine.error)
    return cost(coarse) ** (1 - part) * cost(fine) ** part


def settled(points):
    """The slope that those between neighbouring points come to, if they go on as they end."""
    before, last = (fitted_slope(pair)[0] for pair in (points[-3:-1], points[-2:]))
    return 2 * last - before


def fitted_slope(points):
    """(slope, half of its 95 % interval or nan) of a straight line through points by least squares."""
    n = len(points)
    x, y = (sum(p[k] for p in points) / n for k in (0, 1))
    width = sum((p[0] - x) ** 2 for p in points)
    slope = sum((p[0] - x) * (p[1] - y) for p in points) / width
    if n - 2 not in STUDENT:
        return slope, math.nan
    rest = sum((p[1] - y - slope * (p[0] - x)) ** 2 for p in points)
    return slope, STUDENT[n - 2] * math.sqrt(rest / (n - 2) / width)


def curves(experiment, case, work):
    """The curves of all methods that ran on the case, in the experiment's order; `work` is "time", "right-hand sides" or
    "steps"."""
    measure = error_measure(experiment, case)
    error = measure.of if measure else lambda run: math.nan
    out = []
    for method in experiment.methods:
        groups = [experiment.ensemble_of(r) for r in experiment.runs_of(case) if r.method == method["label"]]
        if not groups:
            continue
        points = [p for p in (point(g, error, work) for g in groups) if p]
        for coarse, fine in zip(points[-2::-1], points[:0:-1]):  # from the fine end
            if work == "time" and coarse.cost > fine.cost:
                coarse.cost, coarse.slowest = fine.cost, max(fine.cost, coarse.slowest)
        residuals = [(p.run.step, p.run.number("structure_residual")) for p in points]
        out.append(Curve(method, experiment.declared_order(method, case), points,
                         sum(r.failed for g in groups for r in g), sum(map(len, groups)),
                         [(h, x) for h, x in residuals if not math.isnan(x)], UNIT_ROUND_OFF[case["precision"]],
                         measure is None or measure.of_state, claims_structure(experiment, method, case), bool(case.get("structure")),
                         bool(case.get("kinks"))))
    return out


def claims_structure(experiment, method, case):
    """Whether the method claims to keep the structure of the case, whose name is that of the claim."""
    return any(s["name"] == case.get("system") and case.get("structure") in s["preserves"] for s in method.get("systems") or [])


def point(members, error, work):
    """One run, or the seeds of an ensemble by their median; None where none finished."""
    finished = [r for r in members if not r.failed]
    if not finished:
        return None
    run = finished[0]
    cost = run.cost or members[0].cost  # an ensemble is timed with its first seed
    if work == "time":
        fastest = cost.low if cost and cost.low > 0 else cost.ns if cost else math.nan
        spent = (fastest * run.steps, (cost.ns if cost else math.nan) * run.steps)
    else:
        spent = (statistics.median(r.steps if work == "steps" else r.total_rhs for r in finished),) * 2
    errors = [e for e in map(error, finished) if not math.isnan(e)]
    least = ZERO * UNIT_ROUND_OFF[run.cells["precision"]]
    return Point(run, *spent, max(least, statistics.median(errors)) if errors else math.nan)


def front(some):
    """The points that no other run beats in both cost and error, by rising cost. An error that is smaller by less than a tenth
    is the same error for more cost, as the errors of two methods are whose roundings are what is left."""
    out = []
    for p in sorted((p for c in some for p in c.measured()), key=lambda p: (p.cost, p.error)):
        if not out or p.error < SMALLER * out[-1].error:
            out.append(p)
    return out


def ranks(some):
    """{label: rank within its family, by falling order}, by which lines are solid, dashed or dotted."""
    seen, out = {}, {}
    for c in sorted(some, key=lambda c: -(c.claimed or 0)):
        out[c.label] = seen[c.family.key] = seen.get(c.family.key, -1) + 1
    return out
