#!/usr/bin/env python3
"""Runs pfaff_micro, prints nanoseconds a step and the ratios that matter, each with its target, and checks them.

    bench/micro/ratios.py build/bench/bench/micro/pfaff_micro [--repetitions N] [--json FILE]
    bench/micro/ratios.py --times FILE        the same for the times that --json left, without measuring
    bench/micro/ratios.py PROGRAM --check     runs each benchmark once and compares no times: whether every run
                                              reaches its error and every benchmark is there

Paths: a loop by hand; static and registered path, each also with forces derived from the energies; the registered path
with derivatives in four directions (tangent); Boost.Odeint. Among the ratios are those of steps by an Integration, which
nobody watches or whose invariants are watched at every step. psi-m is one gradient of the generating function truncated
at degree m, compiled or interpreted, in nanoseconds each.
Structured matrices are factored and solved with in nanoseconds a row, beside loops by hand and Eigen. Of rods (chains,
rings, a humanoid, ensembles) it is one right-hand side or one step of RATTLE, in nanoseconds a rod. Of whole runs it is
nanoseconds a run, beside the error that the run reaches; a run that does not reach the error that is said of it fails.
Repetitions are interleaved at random, so that a disturbance does not fall on one benchmark alone; of each the fastest
is taken, which other programs disturb least.

Exit status 1 when a ratio exceeds its target by more than a quarter, when a whole run does not reach its error, or when one of
these was not measured; 2 for wrong usage, which includes the times of a program that was built without optimisation. A ratio
between the target and that bound is marked `missed`. Times a rod have limits too, but those hold for one machine, so that they
are marked and decide nothing.
"""
import argparse
import json
import subprocess
import sys

SLACK = 1.25  # ratios of two runs on a busy machine vary by less

SYSTEMS = ["harmonic-oscillator", "pendulum", "kepler"]
BY_NAME = ["damped-pendulum", "lotka-volterra", "henon-heiles"]  # on the registered path alone
NONHOLONOMIC = ["sleigh", "contact-oscillator", "quartic-nonholonomic"]
# Methods for velocity constraints, each with the limit of its step in steps of RK4 on the projected equations.
PROJECTED = {"dla": 1.2, "gni": 1.2, "nonholonomic-leap-frog": None, "mclachlan-perlmutter": None,
             "nonholonomic-discrete-gradient": 3.0, "velocity-projected-rk4": None, "odeint-dopri5": None}
CHAIN = [8, 16, 32, 64, 128]
RODS = [16, 64, 256, 1024]
METHODS = ["verlet-merged", "verlet-plain", "verlet", "rk4-plain", "rk4", "implicit-midpoint", "gauss-4", "gauss-8",
           "gauss-12", "generating-function-4", "generating-function-8", "generating-function-12"]
STRUCTURES = {"tridiagonal": [4, 8, 16, 64, 256, 1024], "cyclic": [4, 8, 16, 64, 256, 1024],
              "tree": [12, 16, 64, 256, 1024], "sparse": [16, 64, 256, 1024], "dense": [16, 64]}
SOLVERS = ["library", "shuffled", "quad", "one-end", "both-ends", "eigen"]
TANGENT = ["verlet", "rk4", "gauss-4", "generating-function-4"]  # measured with derivatives too
# Steps by an Integration, with the limit of watching the invariants at every step in bare steps on the registered path.
WATCHED = {("harmonic-oscillator", "verlet"): 1.15, ("kepler", "verlet"): 1.35, ("kepler", "gauss-4"): 1.15,
           ("kepler", "gauss-8"): 1.15, ("damped-pendulum", "generating-function-8"): 1.08}
GRADIENTS = ["psi-4", "psi-8", "psi-12", "psi-16"]
PATHS = {"by-hand": "by hand", "static": "static", "static-derived": "derived", "registered": "registered",
         "registered-derived": "derived", "tangent": "tangent", "odeint": "odeint"}
# Boost.Odeint's nearest: the same method, or the one with as many forces a step. It does not compensate.
RIVALS = {"verlet-plain": "velocity-verlet", "rk4-plain": "rk4"}
ONLY_ODEINT = ["symplectic-euler", "dopri5", "mclachlan"]
# Whole runs: the run, the error that it is to reach, and the run in whose times its own is limited, with the limit. Errors
# do not depend on the machine. Kepler's problem beside Verlet's method by hand with h = 0.02; generating functions beside
# Gauss collocation in the chart, of their own order and the fastest, with the longest steps that reach the error.
REFERENCE_RUN = ("kepler-run", "verlet-h0.02", "by-hand")


def registered(system, method):
    return (f"{system}-run", method, "registered")


# The limits hold for the fastest, of 12 stages with long steps, and at round-off for 8 stages too.
WHOLE_RUNS = [(("kepler-run", method, path), error, REFERENCE_RUN, limit if path == "static" else by_name)
              for method, error, limit, by_name in (
                  ("gauss-12-h0.2", 3.5e-9, None, None), ("gauss-24-h0.5", 3e-9, 1.3, 1.6),
                  ("gauss-16-h0.2", 4e-12, None, None), ("gauss-24-h0.357143", 4e-12, 1.5, 1.6),
                  ("gauss-16-h0.1", 1e-13, 2.5, 2.5), ("gauss-24-h0.25", 1e-14, 2.5, 2.5))
              for path in ("static", "registered")]
WHOLE_RUNS += [(registered(system, method), error, registered(system, rival), limit) for system, method, error, rival, limit in (
    ("damped-pendulum", "generating-function-8+0-h0.645161", 1e-6, "gauss-8-h0.833333", 1.0),
    ("damped-pendulum", "generating-function-8+0-h0.645161", 1e-6, "gauss-16-h2.10526", 1.0),
    ("damped-pendulum", "generating-function-12+0-h0.533333", 1e-9, "gauss-12-h0.869565", 1.2),
    ("damped-pendulum", "generating-function-12+0-h0.533333", 1e-9, "gauss-16-h1.33333", 1.2),
    ("lotka-volterra", "generating-function-8+4-h0.377358", 1e-6, "gauss-8-h0.434783", 1.0),
    ("lotka-volterra", "generating-function-8+4-h0.377358", 1e-6, "gauss-16-h1.17647", 1.0),
    ("lotka-volterra", "generating-function-8+4-h0.20202", 1e-9, "gauss-12-h0.689655", 1.2),
    ("lotka-volterra", "generating-function-8+4-h0.20202", 1e-9, "gauss-16-h1.05263", 1.2))]
# The outer solar system over 1e7 days, beside Verlet's method by hand with steps of 25 days.
WHOLE_RUNS += [(registered("outer-solar-system", method), 7e-12, ("outer-solar-system-run", "verlet-h25", "by-hand"), 1.6)
               for method in ("gauss-16-h800", "quinlan-tremaine-10-h35")]
UNITS = ["ns_per_rod", "ns_per_row", "ns_per_step", "ns_per_run", "ns_per_sharp"]  # counters
ERRORS = {"energy_error": "energy-error", "state_error": "state-error"}  # counters, and what stands for the path


def measure(program, repetitions, seconds):
    """{(system, method, path): fastest ns a step}, or a row of a matrix, or a rod; with the errors of whole runs."""
    # Dirac brackets have a script of their own, dirac_sharp.py.
    return fastest(time_benchmarks(program, "-^dirac-", repetitions, seconds))


def time_benchmarks(program, pattern, repetitions, seconds):
    """The runs of the benchmarks whose names match, in random order; ValueError where their times would say nothing."""
    found = run_benchmarks(program, f"--benchmark_filter={pattern}", f"--benchmark_repetitions={repetitions}",
                           "--benchmark_enable_random_interleaving=true", f"--benchmark_min_time={seconds}")
    if found["context"].get("optimised") == "no":
        raise ValueError("built without optimisation, so that its times say nothing")
    return found["benchmarks"]


def run_benchmarks(program, *options):
    """What Google Benchmark says of the runs and of the machine."""
    command = [program, "--benchmark_format=json", *options]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)


def fastest(runs):
    """{(system, method, path): fastest ns} of the runs that Google Benchmark lists, and the errors that they reach."""
    times = {}
    for run in runs:
        if run["run_type"] == "iteration":
            key = tuple(run["run_name"].split("/")[:3])
            time = next(run[unit] for unit in UNITS if unit in run)
            times[key] = min(times.get(key, float("inf")), time)
            for counter, name in ERRORS.items():
                if counter in run:
                    times[error_of(key, name)] = run[counter]
    return times


def error_of(run, name="energy-error"):
    """The key of the error that a run reaches."""
    return (*run[:2], f"{run[2]}-{name}")


def targets():
    """Rows (what, numerator, denominator, limit or None): every ratio that is to be measured."""
    rows = []
    for system in SYSTEMS:
        for method in ["verlet-plain", "verlet"]:
            rows.append((f"{system} {method}: static / by hand", (system, method, "static"),
                         (system, method, "by-hand"), 1.10))
        rows.append((f"{system} verlet-plain: static / by hand with merged drifts",
                     (system, "verlet-plain", "static"), (system, "verlet-merged", "by-hand"), None))
    for method in METHODS:
        limit = {"verlet-plain": 2.0, "verlet": 2.0, "implicit-midpoint": 2.0, "gauss-4": 1.4, "gauss-8": 1.4}.get(method)
        rows.append((f"kepler {method}: registered / static", ("kepler", method, "registered"),
                     ("kepler", method, "static"), limit))
    for system in SYSTEMS:
        for path in ["static", "registered"]:
            rows.append((f"{system} verlet, {path}: derived / written force", (system, "verlet", path + "-derived"),
                         (system, "verlet", path), None))
    for system in SYSTEMS:
        for method in TANGENT:
            rows.append((f"{system} {method}: with derivatives in four directions / without", (system, method, "tangent"),
                         (system, method, "registered"), None))
    for (system, method), limit in WATCHED.items():
        bare = (system, method, "registered")
        rows.append((f"{system} {method}: an integration / bare steps", (system, method, "integration"), bare, limit))
        rows.append((f"{system} {method}: invariants watched at every step / bare steps", (system, method, "watched"), bare, limit))
    for system in SYSTEMS:
        for method, rival in RIVALS.items():
            rows.append((f"{system} {method}: static / Odeint's {rival}", (system, method, "static"),
                         (system, rival, "odeint"), None))
    # With one short step for both; whole runs, below, are at the steps that are best for each.
    for system, limit in zip(BY_NAME, [None, None, 3.0]):
        rows.append((f"{system} order 8: generating function / Gauss",
                     (system, "generating-function-8", "registered"), (system, "gauss-8", "registered"), limit))
    for system in BY_NAME:
        for gradient in GRADIENTS:
            rows.append((f"{system} {gradient}: interpreted / compiled", (system, gradient, "interpreted"),
                         (system, gradient, "compiled"), None))
    for shorter, longer in zip(CHAIN, CHAIN[1:]):
        rows.append((f"damped pendula, order 8: {longer} / {shorter} of them",
                     (f"damped-pendula-{longer}", "generating-function-8", "registered"),
                     (f"damped-pendula-{shorter}", "generating-function-8", "registered"), 2.2))
    for system in NONHOLONOMIC:
        for method, limit in PROJECTED.items():
            rows.append((f"{system}: {method} / RK4", (system, method, "registered"), (system, "rk4", "registered"),
                         limit))
    for count in RODS:
        rows.append((f"chain of {count} rods with a skate / without: a constraint",
                     (f"skate-chain-{count}", "nonholonomic", "registered"),
                     (f"chain-2d-{count}", "lmm", "registered"), 2.0))
    for run, error, rival, limit in WHOLE_RUNS:
        rows.append((f"{run[0]} to {error:.0e}: {run[1]}, {run[2]} / {rival[1]}, {rival[2]}", run, rival, limit))
    work = "factor-and-solve"
    for rows_of_matrix in STRUCTURES["tridiagonal"]:
        name = f"tridiagonal-{rows_of_matrix}"
        rows.append((f"{name}: library / both ends by hand", (name, work, "library"), (name, work, "both-ends"),
                     1.25 if rows_of_matrix >= 64 else None))
        rows.append((f"{name}: both ends / one end", (name, work, "both-ends"), (name, work, "one-end"), None))
    for structure, sizes in STRUCTURES.items():
        for size in sizes:
            name = f"{structure}-{size}"
            rows.append((f"{name}: library / Eigen", (name, work, "library"), (name, work, "eigen"), 1.0))
    for formulation, limit in (("dirac", 1.5), ("lmm", 1.5)):
        for axes in (2, 3):
            for count in RODS:
                chain = (f"chain-{axes}d-{count}", formulation, "registered")
                rows.append((f"chain of {count} rods in {axes}-d, {formulation}: registered / by hand", chain,
                             (f"chain-{axes}d-{count}", formulation, "by-hand"), limit))
                rows.append((f"ring of {count} rods in {axes}-d, {formulation}: ring / chain",
                             (f"ring-{axes}d-{count}", formulation, "registered"), chain, None))
        for axes in (2, 3):
            rows.append((f"chain of 16 rods in {axes}-d, {formulation}: compiled / by hand",
                         (f"chain-{axes}d-16", formulation, "compiled"), (f"chain-{axes}d-16", formulation, "by-hand"), 1.2))
        rows.append((f"humanoid, {formulation}: humanoid / chain of 16 rods", ("humanoid", formulation, "registered"),
                     ("chain-3d-16", formulation, "registered"), None))
    return rows


def rod_limits(times):
    """Rows (what, ns a rod, limit) of right-hand sides and of steps of RATTLE."""
    limits = {"dirac": 16, "lmm": 12, "rattle": 40}
    return [(f"{shape} {what} {path}", time, limits[what] if shape.startswith("chain") else None)
            for (shape, what, path), time in sorted(times.items()) if what in limits]


def print_runs(times):
    """Whole runs with their errors; the number of errors that are larger than is said of them, or were not measured."""
    print(f"\n{'whole runs':<64}{'us':>10}{'/ Verlet':>10}{'error':>10}")
    for key, time in sorted(times.items(), key=lambda row: (row[0][0], row[1])):
        found = [times[error] for name in ERRORS.values() if (error := error_of(key, name)) in times]
        if found:
            ratio = f"{time / times[REFERENCE_RUN]:>10.2f}" if key[0] == REFERENCE_RUN[0] and REFERENCE_RUN in times else " " * 10
            print(f"{' '.join(key):<64}{time / 1e3:>10.1f}{ratio}{found[0]:>10.1e}")
    return print_inaccurate(times)


def print_inaccurate(times):
    """The number of whole runs whose errors are larger than is said of them, or were not measured."""
    failed = 0
    for run, error in dict((run, error) for run, error, _, _ in WHOLE_RUNS).items():
        reached = next((times[key] for name in ERRORS.values() if (key := error_of(run, name)) in times), None)
        if reached is None or not reached <= error:
            failed += 1
            print(f"{' '.join(run)}: expected an error of at most {error:.1e}, "
                  + ("which was not measured" if reached is None else f"got {reached:.1e}"))
    return failed


def print_times(times):
    print(f"{'ns a step':<30}" + "".join(f"{title:>11}" for title in PATHS.values()))
    for system in SYSTEMS + BY_NAME + [f"damped-pendula-{n}" for n in CHAIN] + NONHOLONOMIC:
        print(system)
        for method in METHODS + ONLY_ODEINT + list(PROJECTED):
            names = [RIVALS.get(method, method if method in ONLY_ODEINT else "") if path == "odeint" else method
                     for path in PATHS]
            cells = [times.get((system, name, path)) for name, path in zip(names, PATHS)]
            if any(cells):
                print(f"  {method:<28}" + "".join(f"{cell:11.2f}" if cell else " " * 11 for cell in cells))
    print(f"\n{'ns a gradient':<30}{'compiled':>11}{'interpreted':>13}")
    for system in BY_NAME:
        for gradient in GRADIENTS:
            pair = [times.get((system, gradient, path)) for path in ("compiled", "interpreted")]
            if all(pair):
                print(f"  {system + ' ' + gradient:<28}{pair[0]:11.1f}{pair[1]:13.1f}")
    print(f"\n{'ns a row':<40}" + "".join(f"{solver:>11}" for solver in SOLVERS))
    for structure, sizes in STRUCTURES.items():
        for size in sizes:
            for work in ["factor-and-solve", "solve", "solve-two"]:
                cells = [times.get((f"{structure}-{size}", work, solver)) for solver in SOLVERS]
                if any(cells):
                    print(f"  {f'{structure}-{size} {work}':<38}"
                          + "".join(f"{cell:11.2f}" if cell else " " * 11 for cell in cells))


def verdict(measured, limit):
    """What is said of a measurement beside its limit."""
    if measured <= limit:
        return ""
    return "  missed" if measured <= SLACK * limit else f"  exceeded by {100 * (measured / limit - 1):.0f} %"


def print_ratios(rows, times):
    """The number of ratios that fail."""
    print(f"\n{'ratio':<64}{'measured':>10}{'target':>10}")
    failed = 0
    for what, numerator, denominator, limit in rows:
        if numerator not in times or denominator not in times:
            if limit is not None:
                failed += 1
                print(f"{what:<64}{'none':>10}{limit:>10.2f}  not measured")
            continue
        ratio = times[numerator] / times[denominator]
        failed += limit is not None and ratio > SLACK * limit
        print(f"{what:<64}{ratio:>10.2f}" + ("" if limit is None else f"{limit:>10.2f}{verdict(ratio, limit)}"))
    return failed


def print_rods(rows):
    print(f"\n{'right-hand side or step of RATTLE, ns a rod':<64}{'measured':>10}{'target':>10}")
    for what, time, limit in rows:
        print(f"{what:<64}{time:>10.2f}" + ("" if limit is None else f"{limit:>10.2f}{verdict(time, limit)}"))


def print_missing(rows, times):
    """The number of benchmarks that ratios with a target need and that were not run."""
    needed = {key for _, *pair, limit in rows if limit is not None for key in pair}
    missing = sorted("/".join(key) for key in needed if key not in times)
    for name in missing:
        print(f"{name}: expected a benchmark of this name")
    return len(missing)


def check(program):
    """The exit status of --check."""
    runs = run_benchmarks(program, "--benchmark_min_time=1e-9")["benchmarks"]
    stopped = [run for run in runs if run.get("error_occurred")]
    for run in stopped:
        print(f"{run['run_name']}: {run['error_message']}")
    times = fastest(run for run in runs if run not in stopped)
    failed = len(stopped) + print_missing(targets(), times) + print_inaccurate(times)
    print(f"{len(runs)} benchmarks ran" if not failed else f"{failed} faults in {len(runs)} benchmarks")
    return 1 if failed else 0


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", nargs="?", help="the built pfaff_micro")
    parser.add_argument("--times", help="check the times in this file, which --json wrote, and measure nothing")
    parser.add_argument("--check", action="store_true", help="run each benchmark once and compare no times")
    parser.add_argument("--repetitions", type=int, default=15)
    parser.add_argument("--seconds", type=float, default=0.01, help="least duration of a repetition")
    parser.add_argument("--json", help="also write the times here")
    options = parser.parse_args(arguments)
    if (options.program is None) == (options.times is None):
        parser.error("expected the program or --times FILE")
    if options.check and options.program is None:
        parser.error("--check: expected the program")
    source = options.times or options.program
    try:
        if options.check:
            return check(options.program)
        if options.times:
            with open(options.times, encoding="utf-8") as file:
                times = {tuple(name.split("/")): float(time) for name, time in json.load(file).items()}
        else:
            times = measure(options.program, options.repetitions, options.seconds)
    except (OSError, subprocess.CalledProcessError, ValueError) as error:
        print(f"ratios.py: {source}: {error}", file=sys.stderr)
        return 2
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"/".join(key): value for key, value in times.items()}, file, indent=1)
    print_times(times)
    print_rods(rod_limits(times))
    inaccurate = print_runs(times)
    failed = print_ratios(targets(), times)
    if failed:
        print(f"ratios.py: {source}: {failed} of the ratios exceed their targets by more than {100 * (SLACK - 1):.0f} %, or "
              "were not measured", file=sys.stderr)
    if inaccurate:
        print(f"ratios.py: {source}: {inaccurate} of the whole runs do not reach the error that is said of them",
              file=sys.stderr)
    return 1 if failed or inaccurate else 0


if __name__ == "__main__":
    sys.exit(main())
