"""Whether a run makes another motion than that of its case, which its class of drift does not say: a planet that has escaped keeps
the energy that it escaped with, and this error is bounded. That such an error stays is no merit of the method, and no sentence says so.

lost     the conserved quantity of the case is off by half of its range or more
escaped  all through the last eighth of the run a point, or a kind of coordinates, is more than twice as far from its
         start as it ever is in the most accurate run of the case; a motion that is merely late or early goes as far as the right one

A run whose error is known to be less than that of a lost phase is neither.
Of escapes nothing is known where no run has an error of at most UNSEEN, as in long chaotic motions, and in ensembles. An orbit of another
size on which the quantity is off by less is not seen.
"""
import math
import re

from curves import LOST
from experiment import ROUND_OFF
from recording import read_recording

UNSEEN = 1e-3  # of the size of a motion: the error of a run that is taken for the motion itself
PART = 0.5  # of the range of a quantity, with which it is lost
AWAY = 2.0  # times as far as the motion goes
SHARE = 0.1  # of the farthest that anything of the same unit goes: what moves less is no part of an escape
LAST = 1 / 8  # of the run


def astray(verdict, run):
    """"lost", "escaped" or an empty text; of an ensemble what is so of more than half of the seeds."""
    members = [r for r in verdict.experiment.ensemble_of(run) if not r.failed and not r.number("error_max") < LOST]
    if 2 * sum(lost(verdict, r) for r in members) > len(verdict.experiment.ensemble_of(run)):
        return "lost"
    return "escaped" if not run.seed and run.number("error_max") >= LOST and escaped(verdict, run) else ""


def lost(verdict, run):
    if verdict.expected != "conserved":
        return False
    change, entry = run.drift(verdict.invariant, "max"), verdict.experiment.entry(run, verdict.invariant)
    span, scale = (abs(float(entry.get(key) or 0)) for key in ("range", "scale"))  # quads are text
    return span > 0 and change >= PART * span and change > ROUND_OFF * verdict.unit * scale


def escaped(verdict, run):
    if not verdict.reach or not has_series(verdict.experiment, run):
        return False
    recording = read_recording(verdict.experiment.folder / run.path)
    begin, end = recording.times[0], recording.times[-1]
    late = [k for k, t in enumerate(recording.times) if abs(t - begin) >= (1 - LAST) * abs(end - begin)]
    for kind, sizes in distances(recording).items():
        farthest = max((size for other, size in verdict.reach.items() if other[0] == kind[0]), default=math.inf)
        if min(sizes[k] for k in late) > max(AWAY * verdict.reach.get(kind, math.inf), SHARE * farthest):
            return True
    return False


def reach(experiment, case):
    """{kind of coordinates: how far it ever is from its start} in the most accurate run of the case; empty where none is accurate."""
    known = [r for r in experiment.runs_of(case) if not r.failed and r.number("error_max") <= UNSEEN and has_series(experiment, r)]
    if not known or case.get("seeds"):
        return {}
    best = min(known, key=lambda r: r.number("error_max"))
    return {kind: max(sizes) for kind, sizes in distances(read_recording(experiment.folder / best.path)).items()}


def has_series(experiment, run):
    return bool(run.slug) and all((experiment.folder / run.path / name).exists() for name in ("series.csv", "summary.json"))


def distances(recording):
    """{(unit, kind): distances from the start at each time} of points, of their momenta, and of coordinates whose names differ by a number:
    a track that turns is as far from its start as it was, while its coordinates are not."""
    kinds = {}
    for name in recording.state:
        point = re.fullmatch(r"(p?_?)[xyz]([_0-9].*)?", name)
        kind = f"{point[1]}{point[2] or ''}" if point else re.sub(r"\d+", "", name)
        kinds.setdefault((recording.units[name], kind), []).append(recording.columns[name])
    return {kind: [math.dist(now, tuple(c[0] for c in columns)) for now in zip(*columns)] for kind, columns in kinds.items()}
