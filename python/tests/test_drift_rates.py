"""How often an energy whose error is the same over a long run has, over shorter ones, another class than `bounded`.

The systems, states and steps are not those at which the thresholds of runs/support/drift_rules.hpp were looked at. A run
of 12,000 steps tells the truth: the error is bounded where its maximum is at most 1.6 times that of the first 2,000
steps. Runs of 100 to 1,700 steps whose largest error is at least .6 of that have seen all of it, and are classed. The
shares in docs/drift-and-cost.md are printed by `pytest -s python/tests/test_drift_rates.py`.
"""

from collections import Counter
from random import Random

import numpy as np

import pfaff

LENGTHS = [100, 150, 225, 340, 500, 750, 1100, 1700]


@pfaff.system(coordinates=["a", "b", "p", "q"], initial=[1.0, 0.4, 0.0, 0.3])
def coupled_pendula(t, a, b, p, q, coupling: float = 0.05, ratio: float = 0.35):
    return p**2 / 2 + q**2 / 2 - np.cos(a) - ratio * np.cos(b) + coupling * (a - b) ** 2 / 2


SEPARABLE = [("verlet", {}, 1), ("yoshida", {}, 2), ("gauss", {"stages": 2}, 3)]
CANONICAL = [("gauss", {"stages": 1}, 1), ("gauss", {"stages": 2}, 2)]
CONSTRAINED = [("rattle", {}, 1), ("lobatto-spark", {}, 2)]
PROBLEMS = [
    ("henon-heiles", {}, [0.13, 0.06], SEPARABLE),
    ("henon-heiles", {"initial": [0.1, -0.3, 0.2, 0.1]}, [0.17, 0.08], SEPARABLE),
    ("henon-heiles", {"initial": [0.0, 0.35, 0.3, 0.0]}, [0.15, 0.07], SEPARABLE),
    ("pendulum", {"initial": [2.9, 0.0]}, [0.23, 0.07], SEPARABLE),
    ("pendulum", {"initial": [0.6, 0.5]}, [0.3, 0.12], SEPARABLE),
    ("harmonic-oscillator", {"omega": 1.7}, [0.21, 0.09], SEPARABLE),
    ("kepler", {"eccentricity": 0.3}, [0.09, 0.04], SEPARABLE),
    ("kepler", {"eccentricity": 0.7}, [0.03, 0.015], SEPARABLE),
    (coupled_pendula, {}, [0.2, 0.08], SEPARABLE),
    (coupled_pendula, {"coupling": 0.01, "ratio": 0.8}, [0.25, 0.1], SEPARABLE),
    (coupled_pendula, {"coupling": 0.2, "ratio": 0.1}, [0.15, 0.06], SEPARABLE),
    (coupled_pendula, {"initial": [1.7, 1.2, 0.0, 0.0]}, [0.2, 0.1], SEPARABLE),
    ("n-pendulum-angles", {"initial": [0.3, -0.2, 0.1, 0.0]}, [0.07, 0.03], CANONICAL),
    ("n-pendulum-angles", {"initial": [1.2, 0.9, 0.0, 0.3]}, [0.04, 0.02], CANONICAL),
    ("spherical-pendulum", {}, [0.07, 0.03], CONSTRAINED),
    ("torus-particle", {}, [0.13, 0.07], CONSTRAINED),
    ("ring", {}, [0.02], CONSTRAINED),
    ("four-bar", {}, [0.03], CONSTRAINED),
    ("chain-molecule", {}, [0.02], CONSTRAINED),
]


def energy(system, method, step, steps, asked):
    """The drift of the energy, or None where the run fails."""
    try:
        run = pfaff.run(system, method, step=step, time=step * steps, every=max(1, steps // 1000), reference=None,
                        structure=False, **asked)
    except pfaff.RunFailed:
        return None
    return run.drift["energy"]


def classed():
    """(system, method, step, number of steps, class, evidence) of every run that has seen all of a bounded error."""
    for system, asked, steps, methods in PROBLEMS:
        for method, parameters, factor in methods:
            for step in (h * factor for h in steps):
                def of(n):
                    return energy(system, method, step, n, asked | parameters)

                whole, start = of(12000), of(2000)
                if whole is None or whole["max"] > 1.6 * start["max"] or "round-off" in whole["class"]:
                    continue
                for n in LENGTHS:
                    drift = of(n)
                    if drift["max"] >= 0.6 * whole["max"]:
                        yield getattr(system, "name", system), method, step, n, drift["class"], drift["evidence"]


def test_bounded_energies_are_seldom_called_anything_else():
    rows = list(classed())
    found = Counter(row[4] for row in rows)
    odd = [row for row in rows if row[4] not in ("bounded", "undetermined")]
    print("", len(rows), {name: round(100 * k / len(rows), 1) for name, k in found.most_common()}, *odd, sep="\n")
    assert len(rows) > 500
    # The docs say .2 %, which are two. Without what the rules know of beats there are ten; two are left for the roundings
    # of another machine.
    assert len(odd) <= 4
    assert found["bounded"] >= 0.7 * len(rows)


def test_energies_that_drift_are_seldom_called_bounded():
    # RK4 loses energy near the perihelion, where these runs begin, and keeps it until the next one. Where a level alone is
    # taken for a bound, 72 are. The docs say .7 %, which are two, in which a little more than a period is seen; two are left
    # for the roundings of another machine.
    random, found = Random(5), Counter()
    for _ in range(300):
        asked = {"eccentricity": random.uniform(0.05, 0.8)}
        step, steps = 10 ** random.uniform(-1.7, -0.7), random.choice([100, 120, 140, 200, 400])
        found[energy("kepler", "rk4", step, steps, asked)["class"]] += 1
    print("", dict(found))
    assert found["bounded"] <= 4 and found["linear"] >= 50


def test_an_exchange_within_the_motion_is_no_trend():
    # In the chain of Fermi, Pasta, Ulam and Tsingou energy goes from the first mode to others and comes back after some 2,000
    # units of time. The error follows, and is the same from one exchange to the next. Without what the rules ask of curves 15 of
    # these 24 runs are `polynomial` or `exponential`.
    found = Counter()
    for method, parameters in (("verlet", {}), ("yoshida", {}), ("gauss", {})):
        for step in (0.1, 0.2):
            for time in (800, 1000, 1500, 2500):
                found[energy("fermi-pasta-ulam-tsingou", method, step, round(time / step), parameters)["class"]] += 1
    print("", dict(found))
    assert sum(found[name] for name in ("linear", "polynomial", "exponential")) <= 2
