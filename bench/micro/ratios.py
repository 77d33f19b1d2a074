#!/usr/bin/env python3
"""Runs pfaff_micro, prints nanoseconds a step and the ratios that matter, each with its target of targets.toml, and checks them.

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
import itertools
import json
import pathlib
import subprocess
import sys
import tomllib
import typing

SLACK = 1.25  # ratios of two runs on a busy machine vary by less

PATHS = {"by-hand": "by hand", "static": "static", "static-derived": "derived", "registered": "registered",
         "registered-derived": "derived", "tangent": "tangent", "odeint": "odeint"}
SOLVERS = ["library", "shuffled", "quad", "one-end", "both-ends", "eigen"]
UNITS = ["ns_per_rod", "ns_per_row", "ns_per_step", "ns_per_run", "ns_per_sharp"]  # counters
ERRORS = {"energy_error": "energy-error", "state_error": "state-error"}  # counters, and what stands for the path


class Ratio(typing.NamedTuple):
    """A ratio of the times of two benchmarks, each (system, method, path)."""
    what: str
    numerator: tuple
    denominator: tuple
    limit: float | None
    error: float | None  # which the numerator is to reach


def ratios_of(entry, lists):
    """The ratios of a [[ratio]]; ValueError for a list or a name that is not there."""
    try:
        given = {name: lists[values] if isinstance(values, str) else values
                 for name, values in entry.items() if name not in Ratio._fields}
        ratios = []
        for chosen in itertools.product(*given.values()):
            known = {"limit": None, "error": None} | entry
            for name, value in zip(given, chosen):
                known |= value if isinstance(value, dict) else {name: value}
            what, *pair = (known[key].format(**known) for key in ("what", "numerator", "denominator"))
            ratios.append(Ratio(what, *(tuple(name.split("/")) for name in pair), known["limit"], known["error"]))
        return ratios
    except KeyError as name:
        raise ValueError(f"targets.toml: [[ratio]] '{entry.get('what')}': {name} is missing; expected one of its own names "
                         f"or of [lists]: {', '.join(lists)}") from None


TARGETS = tomllib.loads(pathlib.Path(__file__).with_name("targets.toml").read_text(encoding="utf-8"))
LISTS = TARGETS["lists"]
RATIOS = [ratio for entry in TARGETS["ratio"] for ratio in ratios_of(entry, LISTS)]
# Of whole runs, the error that each is to reach, and the run by hand that others of its system are compared with.
ERRORS_TO_REACH = {ratio.numerator: ratio.error for ratio in RATIOS if ratio.error is not None}
RUNS_BY_HAND = {run[0]: run for ratio in RATIOS if ratio.error is not None and (run := ratio.denominator)[2] == "by-hand"}


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


def rod_limits(times):
    """Rows (what, ns a rod, limit) of right-hand sides and of steps of RATTLE."""
    limits = TARGETS["rod_limits"]
    return [(f"{shape} {what} {path}", time, limits[what] if shape.startswith("chain") else None)
            for (shape, what, path), time in sorted(times.items()) if what in limits]


def print_runs(times):
    """Whole runs with their errors; the number of errors that are larger than is said of them, or were not measured."""
    print(f"\n{'whole runs':<64}{'us':>10}{'/ Verlet':>10}{'error':>10}")
    for key, time in sorted(times.items(), key=lambda row: (row[0][0], row[1])):
        found = [times[error] for name in ERRORS.values() if (error := error_of(key, name)) in times]
        if found:
            by_hand = times.get(RUNS_BY_HAND.get(key[0]))
            ratio = f"{time / by_hand:>10.2f}" if by_hand else " " * 10
            print(f"{' '.join(key):<64}{time / 1e3:>10.1f}{ratio}{found[0]:>10.1e}")
    return print_inaccurate(times)


def print_inaccurate(times):
    """The number of whole runs whose errors are larger than is said of them, or were not measured."""
    failed = 0
    for run, error in ERRORS_TO_REACH.items():
        reached = next((times[key] for name in ERRORS.values() if (key := error_of(run, name)) in times), None)
        if reached is None or not reached <= error:
            failed += 1
            print(f"{' '.join(run)}: expected an error of at most {error:.1e}, "
                  + ("which was not measured" if reached is None else f"got {reached:.1e}"))
    return failed


def methods_of(name):
    """The methods of a list of the targets."""
    return [method["method"] if isinstance(method, dict) else method for method in LISTS[name]]


def print_times(times):
    rivals = {pair["method"]: pair["rival"] for pair in LISTS["rivals"]}
    print(f"{'ns a step':<30}" + "".join(f"{title:>11}" for title in PATHS.values()))
    for system in dict.fromkeys(key[0] for ratio in RATIOS for key in (ratio.denominator, ratio.numerator)):
        lines = []
        for method in methods_of("methods") + LISTS["odeint_alone"] + methods_of("projected"):
            names = [rivals.get(method, method if method in LISTS["odeint_alone"] else "") if path == "odeint" else method
                     for path in PATHS]
            cells = [times.get((system, name, path)) for name, path in zip(names, PATHS)]
            if any(cells):
                lines.append(f"  {method:<28}" + "".join(f"{cell:11.2f}" if cell else " " * 11 for cell in cells))
        if lines:
            print(system, *lines, sep="\n")
    print(f"\n{'ns a gradient':<30}{'compiled':>11}{'interpreted':>13}")
    for system in LISTS["by_name"]:
        for gradient in LISTS["gradients"]:
            pair = [times.get((system, gradient, path)) for path in ("compiled", "interpreted")]
            if all(pair):
                print(f"  {system + ' ' + gradient:<28}{pair[0]:11.1f}{pair[1]:13.1f}")
    print(f"\n{'ns a row':<40}" + "".join(f"{solver:>11}" for solver in SOLVERS))
    for matrix in LISTS["matrices"]:
        for work in ["factor-and-solve", "solve", "solve-two"]:
            cells = [times.get((matrix, work, solver)) for solver in SOLVERS]
            if any(cells):
                print(f"  {f'{matrix} {work}':<38}" + "".join(f"{cell:11.2f}" if cell else " " * 11 for cell in cells))


def verdict(measured, limit):
    """What is said of a measurement beside its limit."""
    if measured <= limit:
        return ""
    return "  missed" if measured <= SLACK * limit else f"  exceeded by {100 * (measured / limit - 1):.0f} %"


def print_ratios(times):
    """The number of ratios that fail."""
    print(f"\n{'ratio':<64}{'measured':>10}{'target':>10}")
    failed = 0
    for what, numerator, denominator, limit, _ in RATIOS:
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


def print_missing(times):
    """The number of benchmarks that ratios with a target need and that were not run."""
    needed = {key for ratio in RATIOS if ratio.limit is not None for key in (ratio.numerator, ratio.denominator)}
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
    failed = len(stopped) + print_missing(times) + print_inaccurate(times)
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
    failed = print_ratios(times)
    if failed:
        print(f"ratios.py: {source}: {failed} of the ratios exceed their targets by more than {100 * (SLACK - 1):.0f} %, or "
              "were not measured", file=sys.stderr)
    if inaccurate:
        print(f"ratios.py: {source}: {inaccurate} of the whole runs do not reach the error that is said of them",
              file=sys.stderr)
    return 1 if failed or inaccurate else 0


if __name__ == "__main__":
    sys.exit(main())
