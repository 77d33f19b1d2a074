"""What a case shows of growth over seeds, of constraints, of formulations that agree or not and of frequencies: clauses in HTML,
each with its assertion as data (assertion.py).

growth       with which power of time the rms error of the conserved quantity grows, with an interval that leaving out one
             seed after the other gives. A power is called that of a random walk or a proportion to time where its interval
             holds 1/2 or 1 and not the other.
constraints  who stays on the constraints, which is a residual at round-off, and by how much others leave them
agreement    how far motions are from each other in two formulations of one system, over the size of the motion: AGREE and
             less is agreement, DIFFER and more is none, where methods of one formulation are ten times as near to each other
frequencies  with which method a vector turns most nearly as in the solution, and with which least
"""
import itertools
import math

from assertion import Clause, labels, three
from ensembles import growth_of
from experiment import ROUND_OFF
from frequencies import frequencies
from recording import Recording, read_recording
from sentence import name, names, quantity, wheres
from verdict import TIE
from wording import listed, size, text

AGREE, DIFFER = 1e-3, 1e-2
POWERS = ((0.5, "as a random walk does"), (1.0, "in proportion to time"))


def growth(verdict):
    case = verdict.case
    if not case.get("seeds") or verdict.expected != "conserved":
        return []
    found = {run.method: (run, p, half) for run, p, half in growth_of(verdict.experiment, case) if not math.isnan(half)}
    rows = [r for r in verdict.rivals if r.label in found]
    groups = {"": []}
    for row in rows:
        _, p, half = found[row.label]
        holds = [words for power, words in POWERS if abs(p - power) <= half]
        groups.setdefault(holds[0] if len(holds) == 1 else "" if holds else "with another power", []).append(row)
    untold = groups.pop("")

    def told(some):
        return listed(f"{name(r)} (<i>t</i><sup>{found[r.label][1]:.2f} ± {found[r.label][2]:.2f}</sup>)" for r in some)
    if not groups:
        return []
    words = (f"the rms error of {quantity(verdict)} over {case['seeds']} seeds grows "
             + "; ".join(f"{words} with {told(some)}" for words, some in groups.items())
             + (f"; with {told(untold)} the power is not told" if untold else ""))
    return [Clause(words, "grows-as", labels(r for some in groups.values() for r in some), [case["conserved"]],
                   {r.label: wheres(verdict, found[r.label][0]) for r in rows},
                   {"groups": {words: labels(some) for words, some in groups.items()} | {"": labels(untold)},
                    "powers": {r.label: list(found[r.label][1:]) for r in rows}})]


def constraints(verdict):
    """Of the first kind of constraints of which residuals of two methods are known, at the step that most methods share."""
    experiment, runs = verdict.experiment, {r.method: r for r in verdict.experiment.at_common_step(verdict.case)}
    for level in experiment.residuals:
        spans = {}
        for row in verdict.rivals:
            members = [r for r in experiment.ensemble_of(runs[row.label]) if not r.failed]
            values = [r.drift(level, "max") for r in members]
            if values and not any(map(math.isnan, values)):
                spans[row.label] = (min(values), max(values))
        rows = [r for r in verdict.rivals if r.label in spans]
        if len(rows) < 2:
            continue
        on, off, _ = three(rows, lambda r: spans[r.label][1] <= ROUND_OFF * verdict.unit)
        off.sort(key=lambda r: spans[r.label])
        first = [r for r in off if spans[r.label][0] <= TIE * spans[off[0].label][1]]
        last = [r for r in off if TIE * spans[r.label][1] >= spans[off[-1].label][0]]
        kind = text(level.replace("-", " ")) + "s"
        parts = [f"{names(on)} {'stays' if len(on) == 1 else 'stay'} on the {kind}" if on else f"no method stays on the {kind}"]

        def ends(some):
            low, high = min(spans[r.label][0] for r in some), max(spans[r.label][1] for r in some)
            return size(high) if size(low) == size(high) else f"{size(low)} to {size(high)}"
        if off and (set(labels(first)) & set(labels(last)) or len(first) + len(last) > 6):
            parts.append(f"{names(off) if len(off) <= 4 else f'{len(off)} methods'} {'leaves' if len(off) == 1 else 'leave'} them, "
                         f"by {ends(off)}")
            first = last = []
        elif off:
            between = "" if len(off) == len(first) + len(last) else ", the others by sizes between"
            parts.append(f"{names(first)} {'leaves' if len(first) == 1 else 'leave'} them by {ends(first)}{between}, "
                         f"{names(last)} by {ends(last)}, the most")
        return [Clause("; ".join(parts), "constraints", labels(on), [f"{level}:max"],
                       {r.label: wheres(verdict, runs[r.label]) for r in rows},
                       {"off": labels(off), "least": labels(first), "most": labels(last),
                        "spans": {r.label: list(spans[r.label]) for r in rows}})]
    return []


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


def agreement(verdict):
    found, out = motions(verdict), []
    for kind, other in itertools.combinations(found, 2):
        apart = distances(found[kind], found[other])
        within = distances(found[kind], found[kind]) + distances(found[other], found[other])
        if not apart or not within or any(map(math.isnan, apart + within)):
            continue
        if max(apart) <= AGREE:
            words, relation = f"{text(kind)} and {text(other)} agree, to {size(max(apart))} of the motion", "agree"
        elif min(apart) >= DIFFER and min(apart) > 10 * max(within):
            words, relation = f"{text(kind)} and {text(other)} differ, by {size(min(apart))} of the motion or more", "differ"
        else:
            continue
        runs = {key: run for some in (kind, other) for key, (run, _) in found[some].items()}
        state = next(iter(found[kind].values()))[1].state
        rows = {}
        for (method, _), run in runs.items():
            rows.setdefault(method, []).append(run.where)
        out.append(Clause(words, relation, [kind, other], state, rows,
                          {"methods": [sorted({m for m, _ in found[k]}) for k in (kind, other)],
                           "distance": max(apart) if relation == "agree" else min(apart), "within": max(within)}))
    return out


def distances(some, others):
    return [distance(a[1], b[1]) for (method, seed), a in some.items() for (by, of), b in others.items()
            if seed == of and (some is not others or method < by)]


def turning(verdict):
    out = []
    for vector, (rate, lines) in frequencies(verdict.experiment, verdict.case).items():
        steps = [line.steps[0] for line in lines.values()]
        if not steps:
            continue
        step = max(set(steps), key=lambda h: (steps.count(h), h))
        at = {m: line.errors[line.steps.index(step)] for m, line in lines.items() if step in line.steps and line.steady}
        rows = sorted((r for r in verdict.rivals if r.label in at), key=lambda r: at[r.label])
        if len(rows) < 2:
            continue
        best = [r for r in rows if at[r.label] <= TIE * at[rows[0].label]]
        worst = [r for r in rows if TIE * at[r.label] >= at[rows[-1].label]]
        if best[-1] is worst[0] or len(best) == len(rows):
            continue
        unknown = [m for m in lines if m not in at]
        scope = f", of {len(rows)} methods whose error is steady," if unknown else ""
        begin = f"at step {step:.4g} " if not out else ""
        words = (f"{begin}{text(vector)}{scope} turns best with {names(best)}, wrong by {size(at[rows[0].label])} rad per unit of time, and "
                 f"worst with {names(worst)}, by {size(at[rows[-1].label])}")
        out.append(Clause(words, "turns", labels(best), ["error", "change"], {},
                          {"vector": vector, "step": step, "worst": labels(worst), "among": labels(rows), "unknown": unknown}))
    return out
