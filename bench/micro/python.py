#!/usr/bin/env python3
"""What Python costs: steps of systems and methods that are written in Python, against their twins in C++.

    PYTHONPATH=build/release/python python3 bench/micro/python.py

Each number is the least of several short measurements that take turns, so that other work on the machine is in none or in
all of them. Ratios beside their bounds are those of the issue that brought the module.
"""
from __future__ import annotations

import time

import numpy as np

import pfaff

STATE = [0.1, -0.2, 0.3, 0.15]
REPETITIONS = 25


@pfaff.system(coordinates={"q": 2, "p": 2}, initial=STATE, name="traced")
def traced(q, p):
    return p @ p / 2 + q @ q / 2 + q[0] ** 2 * q[1] - q[1] ** 3 / 3


def leap_frog(problem, t, h, z):
    n = problem.size // 2
    q, p = z[:n], z[n:]
    q = q + h / 2 * problem.velocity(t, p)
    p = p + h * problem.force(t + h / 2, q)
    q = q + h / 2 * problem.velocity(t + h, p)
    return np.concatenate([q, p])


def runge_kutta(problem, t, h, z):
    k1 = problem.field(t, z)
    k2 = problem.field(t + h / 2, z + h / 2 * k1)
    k3 = problem.field(t + h / 2, z + h / 2 * k2)
    k4 = problem.field(t + h, z + h * k3)
    return z + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def methods_of(compiled: bool) -> tuple[pfaff.Method, pfaff.Method]:
    kind = "compiled" if compiled else "recorded"
    frog = pfaff.method(order=2, needs=["separable"], compiled=compiled, name=f"leap-frog-{kind}")(leap_frog)
    return frog, pfaff.method(order=4, compiled=compiled, name=f"rk4-{kind}")(runge_kutta)


def stepping(system: object, method: object, steps: int, every: int = 0):
    it = pfaff.Integration(system, method, step=0.01, initial=STATE)
    return lambda: it.steps(steps, every=every), steps


def measured(jobs: dict) -> dict[str, float]:
    """Nanoseconds a step of each job."""
    least = dict.fromkeys(jobs, float("inf"))
    for job, _ in jobs.values():
        job()
    for _ in range(REPETITIONS):
        for name, (job, steps) in jobs.items():
            begin = time.perf_counter_ns()
            job()
            least[name] = min(least[name], (time.perf_counter_ns() - begin) / steps)
    return least


def shown(title: str, base: float, rows: list[tuple[str, float, float | None]]) -> None:
    print(f"{title}: {base:.1f} ns a step")
    for name, value, bound in rows:
        judged = "" if bound is None else f"  (bound {bound:g}){'' if value <= bound * base else '  MISSED'}"
        print(f"  {name:42} {value:8.1f} ns  {value / base:6.2f} x{judged}")


def main() -> None:
    twin, compiled = pfaff.System("henon-heiles"), traced(compile=True)
    for method, steps, bound in (("verlet", 20000, 1.25), (pfaff.Method("gauss", stages=2), 3000, 1.1), (pfaff.Method("gauss", stages=6), 3000, 1.1),
                                 (pfaff.Method("generating-function", order=4), 3000, 1.1), ("rk4", 20000, 1.1)):
        name = method if isinstance(method, str) else f"{method.name} {next(iter(method.parameters.values()))}"
        of = measured({"twin": stepping(twin, method, steps), "interpreted": stepping(traced, method, steps), "compiled": stepping(compiled, method, steps)})
        shown(f"{name}, system in C++", of["twin"], [("system in Python, interpreted", of["interpreted"], 4), ("system in Python, compiled", of["compiled"], bound)])

    for which, name in ((0, "verlet"), (1, "rk4")):
        plain, fast = methods_of(False)[which], methods_of(True)[which]
        of = measured({"twin": stepping(twin, name, 20000), "recorded": stepping(twin, plain, 20000), "compiled": stepping(twin, fast, 20000)})
        shown(f"method {name} in C++", of["twin"], [("method in Python, recorded", of["recorded"], None), ("method in Python, compiled", of["compiled"], 1.25)])

    of = measured({"loop": stepping(twin, "verlet", 20000), "kept": stepping(twin, "verlet", 20000, every=1), "tenth": stepping(twin, "verlet", 20000, every=10)})
    rows = [("Integration.steps, all states kept", of["kept"], 1.5), ("Integration.steps, a tenth kept", of["tenth"], None)]
    for every in (1, 20):
        run = measured({"run": (lambda: pfaff.run(twin, "verlet", step=0.01, time=200, every=every, initial=STATE, reference=None, structure=False), 20000)})
        rows.append((f"pfaff.run, every={every}", run["run"], 1.5 if every == 1 else None))
    shown("loop of verlet", of["loop"], rows)

    states = np.tile(STATE, (64, 1))
    one = measured({"ensemble": (lambda: pfaff.ensemble(twin, "verlet", states, step=0.01, steps=1000, threads=1), 64000)})
    shown("loop of verlet", of["loop"], [("pfaff.ensemble, one thread", one["ensemble"], None)])

    it = pfaff.Integration(twin, "verlet", step=0.01, initial=STATE)
    call = measured({"call": (lambda: [it.steps(1) for _ in range(1000)], 1000)})
    small = measured({"ensemble": (lambda: [pfaff.ensemble(twin, "verlet", states[:1], step=0.01, steps=1, threads=1) for _ in range(200)], 200)})
    print(f"a call of Integration.steps(1): {call['call'] / 1000:.1f} us; of ensemble for a state and a step: {small['ensemble'] / 1000:.1f} us (bound 10)")
    begin = time.perf_counter()
    for k in range(100):
        traced._definition._sources.clear(), traced._definition._models.clear()
        traced()
    print(f"a definition of a system: {(time.perf_counter() - begin) * 10:.2f} ms")


if __name__ == "__main__":
    main()
