"""What a case shows of growth over seeds, of constraints, of formulations that agree or not and of frequencies: clauses in HTML,
each with its assertion as data (assertion.py).

growth       with which power of time the rms error of the conserved quantity grows, with an interval that leaving out one
             seed after the other gives, or the drifts of the seeds where they agree. An interval of at most SHARP to either side
             that holds 0, 1/2 or 1, or is as near to it as NEAR, tells that power.
constraints  who stays on the constraints, which is a residual at round-off, and by how much others leave them
agreement    how far motions are from each other in two formulations of one system, over the size of the motion: AGREE and
             less is agreement; DIFFER and more is none, where methods of formulations that agree are ten times as near
frequencies  with which method a vector turns most nearly as in the solution, and with which least
"""
import functools
import itertools
import math

from astray import astray
from assertion import Clause, labels, three
from drift_sentence import drift, not_counted, wheres
from ensembles import growth_of
from experiment import ROUND_OFF, step_key
from figures import step_text
from frequencies import frequencies
from recording import Recording, read_recording
from sentence import name, names, quantity, some
from verdict import TIE
from wording import counted, hundredths, listed, size, text

AGREE, DIFFER, SHARP, NEAR = 1e-3, 1e-2, 0.25, 0.05
POWERS = {0.5: "as a random walk", 1.0: "in proportion to time", 0.0: "not at all"}


def growth(verdict):
    case = verdict.case
    if not case.get("seeds") or verdict.expected != "conserved":
        return []
    found = {run.method: (run, p, half) for run, p, half in growth_of(verdict.experiment, case) if not math.isnan(half)}
    gone = {r.label: how for r in verdict.rivals if r.label in found and (how := astray(verdict, found[r.label][0]))}
    rows = [r for r in verdict.rivals if r.label in found and r.label not in gone]
    groups = {}
    for row in rows:
        _, p, half = found[row.label]
        holds = [words for power, words in POWERS.items() if abs(p - power) <= max(half, NEAR)]
        groups.setdefault("" if half > SHARP or len(holds) > 1 else (holds or ["with another power"])[0], []).append(row)
    untold = groups.pop("", [])
    if not groups:
        return []

    def told(some):
        return listed(f"{name(r)} (<i>t</i><sup>{hundredths(found[r.label][1])} ± {found[r.label][2]:.2f}</sup>)" for r in some)
    words = (at_steps(verdict, [found[r.label][0] for r in rows])
             + f"rms errors of {quantity(verdict)} over {case['seeds']} seeds grow "
             + "; ".join(f"{words} with {told(some)}" for words, some in groups.items())
             + (f"; with {names(untold)} the power is not told" if untold else "")
             + not_counted(verdict, [r for r in verdict.rivals if r.label in gone], lambda r: gone[r.label]))
    return [Clause(words, "grows-as", labels(r for some in groups.values() for r in some), [case["conserved"]],
                   {r.label: wheres(verdict, found[r.label][0]) for r in rows},
                   {"groups": {words: labels(some) for words, some in groups.items()} | {"": labels(untold)},
                    "powers": {r.label: list(found[r.label][1:]) for r in rows}})]


def drift_beside_growth(verdict):
    """Who lets the quantity drift away, of those whose power of time `growth` does not tell: by its class of drift a walk that is no
    more than round-off adds up to is kept."""
    return drift(verdict, but=[label for clause in growth(verdict) for label in clause.subject])


def constraints(verdict):
    """Of the kinds of constraints of which residuals of two methods are known, at the step that most methods share: the first, and
    each other one on which others stay, as those that are on the positions' constraints alone do not."""
    found = []
    for level in verdict.experiment.residuals:
        found += on_constraints(verdict, level, bool(found))
    return found[:1] + [clause for clause in found[1:] if clause.subject != found[0].subject]


def on_constraints(verdict, level, known):
    """`known`: the step is that of a clause before this one."""
    experiment, runs = verdict.experiment, {r.method: r for r in verdict.experiment.at_common_step(verdict.case)}
    spans = {}
    for row in verdict.rivals:
        members = [r for r in experiment.ensemble_of(runs[row.label]) if not r.failed]
        values = [r.drift(level, "max") for r in members]
        if values and not any(map(math.isnan, values)):
            spans[row.label] = (min(values), max(values))
    rows = [r for r in verdict.rivals if r.label in spans]
    if len(rows) < 2:
        return []
    on, off, _ = three(rows, lambda r: spans[r.label][1] <= ROUND_OFF * verdict.unit)
    off.sort(key=lambda r: spans[r.label])
    first = [r for r in off if spans[r.label][0] <= TIE * spans[off[0].label][1]]
    last = [r for r in off if TIE * spans[r.label][1] >= spans[off[-1].label][0]]
    kind = text(level.replace("-", " ")) + "s"
    missing = [r for r in verdict.rivals if r not in rows]
    none = f"of {counted(len(rows), 'method')} of which it is known none stays" if missing else "no method stays"
    at = "" if known else at_steps(verdict, [runs[r.label] for r in rows])
    parts = [f"{at}{names(on)} {'stays' if len(on) == 1 else 'stay'} on the {kind}" if on else f"{at}{none} on the {kind}"]

    def ends(rows):
        low, high = min(spans[r.label][0] for r in rows), max(spans[r.label][1] for r in rows)
        return size(high) if size(low) == size(high) else f"{size(low)} to {size(high)}"
    if off and (set(labels(first)) & set(labels(last)) or len(first) + len(last) > 6):
        parts.append(f"{names(off) if len(off) <= 4 else f'{len(off)} methods'} {'leaves' if len(off) == 1 else 'leave'} them, "
                     f"by {ends(off)}")
        first = last = []
    elif off:
        parts.append(f"{names(first)} {'leaves' if len(first) == 1 else 'leave'} them least, by {ends(first)}, and {names(last)} "
                     f"most, by {ends(last)}")
    parts += [f"of {some(missing)} it is not known"] if missing else []
    return [Clause("; ".join(parts), "constraints", labels(on), [f"{level}:max"],
                   {r.label: wheres(verdict, runs[r.label]) for r in rows},
                   {"off": labels(off), "least": labels(first), "most": labels(last),
                    "spans": {r.label: list(spans[r.label]) for r in rows}})]


def at_steps(verdict, runs):
    """At the step that most methods share, where all runs are at it, or else at the nearest that a method has."""
    common = verdict.experiment.common_step(verdict.case)
    nearest = "" if all(step_key(r.step) == step_key(common) for r in runs) else " or the nearest that a method has"
    return f"at {text(step_text(common, verdict.case))}{nearest}, "


def motions(verdict):
    """{formulation: {(method, seed): (run, Recording)}} of the case and of those that begin like it: the same system,
    parameters and time."""
    experiment, out = verdict.experiment, {}
    kinds = {m["label"]: m.get("formulation") or "" for m in experiment.methods}
    for case in experiment.cases:
        if any(case.get(k) != verdict.case.get(k) for k in ("system", "parameters", "time", "seeds")):
            continue
        for run in experiment.at_common_step(case):
            if not kinds[run.method]:
                continue
            for one in experiment.ensemble_of(run):
                if not one.failed and (experiment.folder / one.path / "series.csv").exists():
                    out.setdefault(kinds[run.method], {})[run.method, one.seed] = (one, read_recording(experiment.folder / one.path))
    return out


def distance(one: Recording, other: Recording):
    """The largest distance of two motions at the times that both have, over the largest size of the first."""
    at = {t: k for k, t in enumerate(other.times)}
    pairs = [(k, at[t]) for k, t in enumerate(one.times) if t in at]
    if len(pairs) < 2 or one.state != other.state:
        return math.nan
    columns = [(one.columns[n], other.columns[n]) for n in one.state]
    return (math.sqrt(max(sum((a[k] - b[j]) ** 2 for a, b in columns) for k, j in pairs))
            / math.sqrt(max(sum(a[k] ** 2 for a, _ in columns) for k, _ in pairs)))


@functools.cache  # it reads recordings, and is asked for by each line of the first screen
def agreement(verdict):
    found, groups, out = motions(verdict), [], []
    for kind in found:
        group = next((g for g in groups if all(near(found[kind], found[other]) for other in g)), None)
        groups = groups if group else groups + [[kind]]
        group.append(kind) if group else None
    for group in groups:
        if len(group) > 1:
            apart = max(max(distances(found[a], found[b])) for a, b in itertools.combinations(group, 2))
            out.append(motion_clause(f"{listed(map(text, group))} agree, to {size(apart)} of the motion", "agree", found,
                                     [[kind] for kind in group], apart))
    for one, other in itertools.combinations(groups, 2):
        apart = [d for a in one for b in other for d in distances(found[a], found[b])]
        within = [d for group in (one, other) for a, b in itertools.combinations_with_replacement(group, 2)
                  for d in distances(found[a], found[b])]
        if apart and within and min(apart) >= max(DIFFER, 10 * max(within)):  # which nan is not
            out.append(motion_clause(f"{listed(map(text, one))} {'differs' if len(one) == 1 else 'differ'} from "
                                     f"{listed(map(text, other))}, by {size(min(apart))} of the motion or more", "differ", found,
                                     [one, other], min(apart)))
    return out


def near(some, others):
    apart = distances(some, others)
    return bool(apart) and not any(map(math.isnan, apart)) and max(apart) <= AGREE


def motion_clause(words, relation, found, groups, apart):
    """A clause on the motions of groups of formulations, whose distance is `apart`."""
    rows = {}
    for kind in itertools.chain(*groups):
        for (method, _), (run, _) in found[kind].items():
            rows.setdefault(method, []).append(run.where)
    state = next(iter(found[groups[0][0]].values()))[1].state
    methods = [sorted({m for kind in group for m, _ in found[kind]}) for group in groups]
    return Clause(words, relation, list(itertools.chain(*groups)), state, rows, {"methods": methods, "distance": apart})


def distances(some, others):
    return [distance(a[1], b[1]) for (method, seed), a in some.items() for (by, of), b in others.items()
            if seed == of and (some is not others or method < by)]


def agreement_or_constraints(verdict):
    return agreement(verdict) or constraints(verdict)


def constraints_beside_agreement(verdict):
    return constraints(verdict) if agreement(verdict) else []


def turning(verdict):
    out, said = [], None  # the step that the clause before names
    for vector, (_, lines) in frequencies(verdict.experiment, verdict.case).items():
        steps = [h for line in lines.values() for h, steady in zip(line.steps, line.steadies) if steady]
        if not steps:
            continue
        step = max(set(steps), key=lambda h: (steps.count(h), -h))
        at = {m: line.errors[line.steps.index(step)] for m, line in lines.items()
              if step in line.steps and line.steadies[line.steps.index(step)]}
        rows = sorted((r for r in verdict.rivals if r.label in at), key=lambda r: at[r.label])
        if len(rows) < 2:
            continue
        best = [r for r in rows if at[r.label] <= TIE * at[rows[0].label]]
        worst = [r for r in rows if TIE * at[r.label] >= at[rows[-1].label]]
        if best[-1] is worst[0] or len(best) == len(rows):
            continue
        unknown = [r.label for r in verdict.rivals if r.label not in at]
        scope = f", of {len(rows)}{'' if out else ' steady methods'}," if unknown else ""
        place = "" if step == said else f"at step {step:.4g} "
        said = step
        words = (f"{place}{text(vector)}{scope} turns best with {names(best)}, off by {size(at[rows[0].label])}, "
                 f"and worst with {names(worst)}, by {size(at[rows[-1].label])}" + ("" if out else " rad per unit of time"))
        out.append(Clause(words, "turns", labels(best), ["error", "change"], {},
                          {"vector": vector, "step": step, "worst": labels(worst), "among": labels(rows), "unknown": unknown}))
    return out
