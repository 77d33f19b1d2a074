"""What a case shows of drift: clauses in HTML, each with its assertion as data (assertion.py).

losing   whether the cheapest let the conserved quantity drift away in the run that is nearest to the target
drift    who lets the conserved quantity drift away, or move against its direction: of each method its run at equal cost, and of one that
         cannot cost this its nearest run. "No method" is said where that is known of every rival, in whichever of these runs; where
         one lets the quantity drift, methods at equal cost and the others have a clause each, which says of whom it is.
A run that makes another motion (astray.py) is not counted, whatever its class of drift, and its method is named. What two clauses say
of one method in two of its runs they say of which run, so that they do not deny each other.
"""
import math

from assertion import Clause, labels, three
from experiment import DIRECTIONS
from sentence import name, names, quantity, some, with_work
from wording import counted, listed, power, size, text


def wheres(verdict, run):
    return [r.where for r in verdict.experiment.ensemble_of(run) if not r.failed]


def losing(verdict):
    best = verdict.best(verdict.target) if verdict.target else []
    if not best or best[0].curve.kept or not verdict.invariant or verdict.expected in DIRECTIONS:
        return []
    near = {r.label: min(r.curve.measured(), key=lambda p: abs(math.log(p.error / verdict.target))).run for r in best[:2]}
    lost = [r for r in best[:2] if verdict.class_of(near[r.label])[1]
            and not verdict.of_rounding(r.curve, near[r.label])]
    if not lost:
        return []
    kinds = dict.fromkeys(verdict.class_of(near[r.label])[0] for r in lost)
    who = "" if len(best) == 1 else "both " if len(lost) == len(best) else f"{names(lost)} "
    return [Clause(f"but {who}{'lets' if len(lost) == 1 else 'let'} {quantity(verdict)} drift ({listed(map(text, kinds))})",
                   "drifts", labels(lost), [f"{verdict.invariant}:class"],
                   {r.label: wheres(verdict, near[r.label]) for r in lost}, {"not": [], "unknown": []}, ", ")]


def drift_beside_losing(verdict):
    """Who lets the quantity drift where `losing` has said it already of others, in other runs."""
    return drift(verdict, said=[label for clause in losing(verdict) for label in clause.subject])


def drift(verdict, but=(), said=()):
    """Of all rivals but those with a label in `but`, of whom another clause tells it; of those in `said` another clause has said that
    they let it drift in the run that is nearest to the target."""
    rivals = [r for r in verdict.rivals if r.label not in but]
    rows = [r for r in rivals if r.run and not r.astray]
    grow, stay, _ = three(rows, lambda r: r.drifts)
    if not verdict.invariant or len(grow) + len(stay) < 2:
        return []
    level = comparable(rows)
    apart = [r for r in rows if r not in level and r.drifts is not None]
    groups = [[r for r in rows if r not in apart], apart] if apart and grow else [rows]
    clauses = [clause(verdict, group, rivals, bool(but) or group != rows, said, apart) for group in groups]
    clauses[0].words = begin(verdict) + clauses[0].words
    unfinished = [r for r in rivals if not r.run]
    clauses[-1].words += f"; no run of {some(unfinished)} finished" if unfinished else ""
    gone = [r for r in rivals if r.astray]
    clauses[-1].words += not_counted(verdict, gone, lambda r: r.astray)
    clauses[-1].more["astray"] = {r.label: r.astray for r in gone}
    clauses[-1].rows |= {r.label: wheres(verdict, r.run) for r in gone}
    return clauses


def not_counted(verdict, rows, how):
    """Who makes another motion, and how; empty where nobody does."""
    out = ""
    for kind, why in (("lost", f"by whom {quantity(verdict)} is off by half of its range or more"),
                      ("escaped", "by whom the motion goes more than twice as far as it should")):
        of = [r for r in rows if how(r) == kind]
        out += f"; not counted {'is' if len(of) == 1 else 'are'} {some(of)}, {why}" if of else ""
    return out


def begin(verdict):
    verb = DIRECTIONS[verdict.expected][0] if verdict.expected in DIRECTIONS else ""
    return f"{quantity(verdict)} is expected to {verb}, and " if verb else ""


def clause(verdict, rows, rivals, part, said, apart):
    """Of some of the rivals; in `part` where others are told of elsewhere, and `apart` are those that are not at equal cost."""
    directed = verdict.expected in DIRECTIONS
    grow, stay, unknown = three(rows, lambda r: r.drifts)
    own = [r for r in rows if r in apart] if len(rows) > len(apart) else []
    away = f"{'it' if directed else quantity(verdict)} " + (
        f"{DIRECTIONS[verdict.expected][1]} by more than round-off" if directed else "drift away")
    if grow:
        out = listed(moving(verdict, grow))
        rest = f"the other{'' if len(stay) == 1 else f' {len(stay)}'}" if len(grow + stay) == len(rivals) else some(stay)
        out += f", {rest} {'does' if len(stay) == 1 else 'do'} not" if stay else ""
    elif len(stay) == len(rivals) and not part:
        out = f"no method lets {away}"
    elif part:
        out = (f"{name(stay[0])} does not let {away}" if len(stay) == 1 else
               f"neither {name(stay[0])} nor {name(stay[1])} lets {away}" if len(stay) == 2 else f"of {some(stay)} none lets {away}")
    else:
        out = f"of {counted(len(stay), 'method')} of which it is known none lets {away}"
    elsewhere = [r for r in stay + unknown if r.label in said]
    if elsewhere:
        out += (f" ({names(elsewhere)} {'does' if len(elsewhere) == 1 else 'do'} in the run nearest to {text(verdict.measure.noun)} "
                f"{power(round(math.log10(verdict.target)))})")
    if unknown:
        out += f"; of {some(unknown)} it is not known"
    known = grow + stay
    return Clause(at_cost(verdict, [r for r in known if r not in own], own) + out, "moves-against" if directed else "drifts", labels(grow),
                  [verdict.invariant if directed else f"{verdict.invariant}:class"], {r.label: wheres(verdict, r.run) for r in rows},
                  {"not": labels(stay), "unknown": labels(unknown), "own": labels(own)}
                  | equal(verdict, [r for r in known if r not in own]) | ({"expected": verdict.expected} if directed else {}))


def moving(verdict, rows):
    """What the rows let the quantity do: by class of drift, or against its direction; round-off that adds up comes last."""
    if verdict.expected in DIRECTIONS:
        return [f"{some(rows)} {'lets' if len(rows) == 1 else 'let'} it {DIRECTIONS[verdict.expected][1]}"]
    kinds, small = {}, [r for r in rows if verdict.of_rounding(r.curve, r.run)]
    for row in rows:
        if row not in small:
            kinds.setdefault(row.drift_class, []).append(row)
    out = [f"{some(of)} {'lets' if len(of) == 1 else 'let'} {quantity(verdict)} drift ({text(kind)})" for kind, of in kinds.items()]
    if small:
        out.append(f"round-off alone grows with {some(small)} ({listed(dict.fromkeys(text(r.drift_class) for r in small))} of at most "
                   f"{size(max(r.drift for r in small))})")
    return out


def comparable(rows):
    """The rows whose runs are at equal cost, where these are at least half of the rows, half of those of which it is known if the
    quantity drifts, and two of these; otherwise all rows."""
    at_level = [r for r in rows if not r.off]
    known, of_all = (sum(r.drifts is not None for r in some) for some in (at_level, rows))
    return at_level if known >= 2 and 2 * known >= of_all and 2 * len(at_level) >= len(rows) else rows


def equal(verdict, rows):
    """Of an assertion on runs at equal cost: the level; null where their costs differ."""
    agree = verdict.level > 0 and not any(r.off for r in rows)
    return {"level": verdict.level if agree else None, "work": verdict.work}


def at_cost(verdict, rows, own=()):
    """In which runs: at equal cost where that is what the rows cost, otherwise each at its own step, with what it cost; those in `own`
    at their own steps beside rows at equal cost."""
    if equal(verdict, rows)["level"]:
        beside = f"and with {some(own)} at {'its own step' if len(own) == 1 else 'their own steps'}, {costing(verdict, own)}" if own else ""
        return f"at equal cost, {with_work(verdict, verdict.level)}, {beside}"
    return f"{'each ' if len(rows) > 1 else ''}at its own step, {costing(verdict, rows)}"


def costing(verdict, rows):
    costs = sorted(r.cost for r in rows if r.cost > 0)
    ends = list(dict.fromkeys(with_work(verdict, x) for x in costs[:1] + costs[-1:]))
    return f"for {' to '.join(ends)}, " if ends else ""
