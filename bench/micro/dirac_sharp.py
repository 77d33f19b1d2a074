#!/usr/bin/env python3
"""Runs the Dirac brackets of pfaff_micro and prints nanoseconds for each K with the exponent fitted to the last four.

    bench/micro/dirac_sharp.py build/bench/bench/micro/pfaff_micro

Each figure is the fastest of five interleaved repetitions. The exponent p of ns ~ K^p is a least-squares line through the
logarithms. Also where the dense solver and the recursion over vectors cross.
"""
import math
import subprocess
import sys

from ratios import time_benchmarks


def measure(program):
    times = {}
    for run in time_benchmarks(program, "^dirac-", repetitions=5, seconds=0.05):
        if run["run_type"] != "iteration":
            continue
        case, solver = run["run_name"].split("/")[:2]
        _, kind, count = case.split("-")
        slot = times.setdefault((kind, solver), {})
        slot[int(count)] = min(slot.get(int(count), math.inf), run["ns_per_sharp"])
    return times


def exponent(points):
    last = sorted(points.items())[-4:]
    if len(last) < 3:
        return None
    x = [math.log(k) for k, _ in last]
    y = [math.log(t) for _, t in last]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    try:
        times = measure(sys.argv[1])
    except (OSError, subprocess.CalledProcessError, ValueError) as error:
        print(f"dirac_sharp.py: {sys.argv[1]}: {error}", file=sys.stderr)
        return 2
    counts = sorted({k for points in times.values() for k in points})
    print(f"{'ns, K =':30}" + "".join(f"{k:>9}" for k in counts) + f"{'p':>6}")
    for (kind, solver), points in times.items():
        p = exponent(points)
        print(f"{kind + ' ' + solver:30}" + "".join(f"{points[k]:9.0f}" if k in points else f"{'':9}" for k in counts)
              + (f"{p:6.1f}" if p is not None else ""))
    dense, vectors = times[("dense", "dense")], times[("dense", "recursive-vectors")]
    faster = [k for k in counts if vectors[k] < dense[k]]
    print("\nThe recursion over vectors is faster than the dense solver at K =",
          ", ".join(map(str, faster)) if faster else "none of these")
    return 0


if __name__ == "__main__":
    sys.exit(main())
