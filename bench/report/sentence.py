"""What a case shows, in one sentence and two lines below it, all of it HTML and computed from the verdict.

1. Who is cheapest at the target, whether it keeps the structure, and if not, whether the conserved quantity drifts away.
2. Where the cheapest does not keep the structure: who does, and the cheapest of them. Where no structure was measured: who
   stays closest to the constraints.
3. The experiment's subject, which is the family of the method it lists first, against the Gauss method of equal order,
   the cheaper one first, whoever that is.
A claim that the data do not make is not printed.
"""
import math

from curves import GROWN
from experiment import DIRECTIONS
from families import family_of
from figures import heading
from findings import ROUND_OFF
from verdict import TIE
from wording import counted, listed, plain_text, power, size, text, two_digits


def name(row):
    return f'<b class="c-{row.curve.family.key}">{text(row.label)}</b>'


def names(rows):
    return listed(name(r) for r in rows)


def structure_of(case):
    return f"the {text(case.get('structure') or 'symplectic')} structure"


def target_text(target):
    return power(round(math.log10(target)))


def finding(verdict):
    """The sentence, without a full stop at its end only where there is nothing to say at all."""
    said = [cheapest(verdict), keepers(verdict) or surface(verdict), subject(verdict)]
    said = [s for s in said if s]
    if not said:
        said = [trends(verdict)]
    joined = "; ".join(s for s in said if s)
    return joined[:1].upper() + joined[1:] + "." if joined else "Nothing to compare"


def spent(verdict, row, target):
    cost, at_most = row.times[target]
    return ("at most " if at_most else "") + with_work(verdict, cost)


def with_work(verdict, cost):
    return verdict.cost_text(cost) + ("" if verdict.work == "time" else f" {verdict.work}")


def cheapest(verdict):
    if verdict.target is None or len(verdict.rows) < 2:
        return ""
    best = verdict.best(verdict.target)
    who = names(best) if len(best) <= 3 else f"{names(best[:2])} and {len(best) - 2} others"
    out = (f"at {text(verdict.measure.noun)} {target_text(verdict.target)} {who} {'is' if len(best) == 1 else 'are'} cheapest, "
           f"{spent(verdict, best[0], verdict.target)}")
    if best[0].curve.kept:
        return out + along_with(verdict)
    named = best if len(best) <= 3 else best[:2]
    losing = [(r, kind) for r in named if (kind := losing_class(verdict, r))]
    kinds = dict.fromkeys(kind for _, kind in losing)
    if not losing:
        return out
    which = ("" if len(best) == 1 else "both " if len(losing) == len(best) == 2 else "all " if len(losing) == len(best)
             else names(r for r, _ in losing) + " ")
    return out + (f", but {which}{'lets' if len(losing) == 1 else 'let'} {quantity(verdict)} drift "
                  f"({listed(text(k) for k in kinds)})")


def quantity(verdict):
    """The conserved quantity with its article; one that is called by a letter has none."""
    name = text(verdict.invariant)
    return f"<i>{name}</i>" if len(name) == 1 else f"the {name}"


def losing_class(verdict, row):
    """The class of drift of the row's run that is nearest to the target where the quantity drifts away in it, by more than
    round-off adds up to; otherwise nothing."""
    near = run_near(row, verdict.target)
    kind = near.drift_class(verdict.invariant) if near and verdict.invariant else ""
    grows = kind and verdict.expected not in DIRECTIONS and verdict.experiment.drift_classes[kind].grows
    return kind if grows and near.drift(verdict.invariant, "max") > GROWN * verdict.unit else ""


def run_near(row, target):
    """The run whose error is nearest to the target."""
    points = row.curve.measured()
    return min(points, key=lambda p: abs(math.log(p.error / target))).run if points else None


def kept_split(verdict):
    """(rows that keep the structure, rows that do not); methods on which it was not measured are in neither."""
    judged = [r for r in verdict.rows if r.curve.kept is not None]
    return [r for r in judged if r.curve.kept], [r for r in judged if not r.curve.kept]


def collective(rows, others):
    """The rows as families, where none of a family is among the others; as methods where they are few; or their count."""
    families = list(dict.fromkeys(r.curve.family for r in rows))
    if not {f.key for f in families} & {r.curve.family.key for r in others}:
        return names(rows) if len(rows) <= len(families) else listed(f.plural for f in families)
    return names(rows) if len(rows) <= 4 else f"{len(rows)} of {len(rows) + len(others)} methods"


def few(rows, said):
    """Whether they were too many to name: all that is said of them is how many."""
    return said.startswith(f"{len(rows)} of ")


def along_with(verdict):
    """How the cheapest, which keeps the structure, stands among the others."""
    keep, lose = kept_split(verdict)
    structure = f"keeps {structure_of(verdict.case)} at round-off"
    if not lose:
        return f", and like all others {structure}" if len(keep) > 1 else f", and {structure}"
    if len(keep) == 1:
        return f", and alone {structure}"
    whose = collective(lose, keep)
    if few(lose, whose):
        return f", and like {len(keep) - 1} others {structure}"
    return f", and like all but {whose} {structure}"


def keepers(verdict):
    best = verdict.best(verdict.target) if verdict.target else []
    keep, lose = kept_split(verdict)
    if not (keep or lose) or best and best[0].curve.kept:
        return ""
    structure = f"{structure_of(verdict.case)} at round-off"
    if not keep:
        return f"no method keeps {structure}"
    if not lose:
        return f"all methods keep {structure}"
    who, whose = collective(keep, lose), collective(lose, keep)
    only = "" if few(keep, who) and len(keep) >= len(lose) else "only "
    shorter = len(plain_text(whose)) < len(plain_text(who)) and not few(lose, whose)
    out = f"all but {whose} keep {structure}" if shorter else (
        f"{only}{who} {'keeps' if len(keep) == 1 else 'keep'} {structure}")
    cheap = cheapest_keeper(verdict)
    if not cheap:
        return out
    cost = spent(verdict, cheap, verdict.target) + times_as_much(verdict, cheap)
    return out + (f", for {cost}" if len(keep) == 1 else f", cheapest of them {name(cheap)}, {cost}")


def cheapest_keeper(verdict):
    """The row that is cheapest at the target among those that keep the structure, or None."""
    reached = [r for r in kept_split(verdict)[0] if verdict.target and r.times[verdict.target][0] > 0]
    return min(reached, key=lambda r: r.times[verdict.target][0], default=None)


def times_as_much(verdict, row):
    """How many times what the cheapest costs a row costs at the target; empty where bounds alone are known of it."""
    cost, at_most = row.times[verdict.target]
    least, bound = verdict.best(verdict.target)[0].times[verdict.target]
    if at_most or cost / least < TIE:
        return ""
    return f" ({'at least ' if bound else ''}{two_digits(cost / least)}×)"


def surface(verdict):
    """Where no structure was measured: who stays closest to the constraints, and who leaves them most."""
    if verdict.structured:
        return ""
    for level in verdict.experiment.residuals:
        sized = sorted(((x, r) for r in verdict.rows if not math.isnan(x := verdict.residual(r, level))), key=lambda s: s[0])
        if len(sized) > 1 and sized[0][0] < sized[-1][0]:
            (near, first), (far, last) = sized[0], sized[-1]
            return (f"{name(first)} stays closest to the constraints, {size(near)}, and {name(last)} leaves them by most, "
                    f"{size(far)}")
    return ""


def subject(verdict):
    if verdict.target is None:
        return ""
    family = family_of(verdict.experiment.methods[0].get("integrator") or "")
    reached = [r for r in verdict.rows if r.times[verdict.target][0] > 0]
    ours = next((r for r in reached if r.curve.family is family), None)
    if not ours or family.key == "gauss":
        return ""
    gauss = [r for r in reached if r.curve.family.key == "gauss" and r.curve.claimed == ours.curve.claimed]
    if not gauss:
        return ""
    best = verdict.best(verdict.target)
    cheap, dear = sorted((ours, gauss[0]), key=lambda r: r.times[verdict.target][0])
    ratio = dear.times[verdict.target][0] / cheap.times[verdict.target][0]
    times = [f"{name(r)} ({spent(verdict, r, verdict.target)})" for r in (cheap, dear)]
    if dear.times[verdict.target][1]:
        return ""  # no more than a bound is known of it
    least = "at least " if cheap.times[verdict.target][1] else ""
    which = ", which keeps it" if dear.curve.kept and cheap.curve.kept is False else ""
    if ratio < 1.1:
        return "" if cheap in best and dear in best else f"{times[0]} and {times[1]} cost the same"
    if cheap is best[0] and dear is cheapest_keeper(verdict) and not cheap.curve.kept:
        return ""  # its cost was told where it was said to keep the structure
    if cheap is best[0]:
        return f"{name(dear)} costs {least}{two_digits(ratio)} times as much ({spent(verdict, dear, verdict.target)}){which}"
    return f"{times[0]} is {least}{two_digits(ratio)}× cheaper than {times[1]}{which}"


def trends(verdict):
    """Who lets the conserved quantity drift away, by class; empty where nobody does or nothing is known."""
    losing = {}
    for row in verdict.rows:
        if verdict.loses(row):
            losing.setdefault(row.drift_class, []).append(row)
    return "; ".join(f"{some(rows)} {'lets' if len(rows) == 1 else 'let'} {quantity(verdict)} drift ({text(kind)}"
                     f"{by_round_off(verdict, rows)})" for kind, rows in losing.items())


def some(rows):
    return names(rows) if len(rows) <= 6 else f"{len(rows)} methods"


def by_round_off(verdict, rows):
    """How large drifts are that are no more than what round-off adds up to."""
    largest = max(r.drift for r in rows)
    return f", {size(largest)} at most" if largest <= GROWN * verdict.unit else ""


def drifting(verdict):
    """The second line."""
    if not verdict.invariant:
        return ""
    if verdict.expected in DIRECTIONS:
        verb, move = DIRECTIONS[verdict.expected]
        wrong = [r for r in verdict.rows if r.drift > ROUND_OFF * verdict.unit]
        begin = "" if verdict.comparable else "No error is known here, so that no method is called cheapest. "
        what = quantity(verdict)
        return (f"{begin}{what[0].upper()}{what[1:]} is expected to {verb}; " + (
            f"{names(wrong)} {'lets' if len(wrong) == 1 else 'let'} it {move} at equal cost." if wrong
            else f"no method lets it {move} by more than round-off."))
    if not any(r.drift_class for r in verdict.rows):
        return ""
    out = trends(verdict)
    begin = f"At equal cost, {with_work(verdict, verdict.level)}, " if verdict.level > 0 else ""
    quiet = [r for r in verdict.rows if r.curve.kept is False and r.drift_class and not verdict.loses(r)
             and not verdict.untold(r)]
    untold = [r for r in verdict.rows if verdict.untold(r)]
    nobody = f"no method {'is seen to let' if untold else 'lets'} {quantity(verdict)} drift away"
    said = [begin + (out or nobody) + "."]
    if untold:
        said.append(f"Whether {some(untold)} {'does' if len(untold) == 1 else 'do'} is "
                    f"{listed(text(k) for k in dict.fromkeys(r.drift_class for r in untold))}.")
    if quiet:
        said.append(f"{some(quiet)} {'does' if len(quiet) == 1 else 'do'} not keep the structure but "
                    f"{'shows' if len(quiet) == 1 else 'show'} no trend.")
    return " ".join(said)


def holds(verdict):
    """The third line: for what it holds."""
    case, runs = verdict.case, verdict.experiment.runs_of(verdict.case)
    unit = case.get("time_unit") or ""
    parts = [text(heading(case)) + (f" to t = {text(case['time'])} {text(unit)}".rstrip() if "time" in case else ""),
             f"{case['precision']} precision"]
    if verdict.measure:
        which = {"exact": "the exact solution", "30-digit": "a solution of up to 30 digits"}.get(
            case.get("reference_solution") or "", "the reference solution")
        parts.append(text(verdict.measure.defined(which)))
    steps = sorted({r.step for r in runs if not r.tolerance}, reverse=True)
    between = ("" if not steps else f" at step {steps[0]:.4g}" if len(steps) == 1 else
               f" at {len(steps)} steps between {steps[0]:.4g} and {steps[-1]:.4g}") + (f" {unit}" if unit and steps else "")
    parts.append(counted(len(verdict.rows), "method") + text(between))
    timing = {"time": "times are the fastest repetition of a run on one core, and differences within 10 % or the spread of "
              "timings count as ties", "right-hand sides": "timings were not measured: right-hand sides stand for cost",
              "steps": "timings were not measured: steps stand for cost"}[verdict.work]
    if case.get("seeds"):
        parts.append(f"medians over {case['seeds']} seeds")
    return f"Holds for {', '.join(parts[:-1])}{', ' if len(parts) > 1 else ''}{parts[-1]}; {timing}."
