"""Judges the corpus of sound and false plug-ins with `pfaff verify` and prints both error rates of the judge.

    judge_corpus.py PROGRAM CORPUS [--plugins DIR] [--half NAME] [--jobs N] [--only NAME...]

CORPUS has a folder for each half, such as `seen`, which the checks were mended with, with the folders `sound` and
`false`. A text file (.toml) is verified by its path; a source (.cpp) is verified as the plug-in
DIR/STEM.so, by the name that it registers: its stem, with - for _. A sound item is judged rightly where `verify` ends
with 0 and some claim was judged; a false one where it ends with 1 because a claim fails. An item that does not end
within two minutes, or cannot be read, is judged wrongly.

Exit status: 0 where the items that are judged wrongly are those that CORPUS/missed.txt lists, 1 otherwise.
"""

import argparse
import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys
import time

LONGEST = 120  # seconds for one item


def binomial_tail(n, k, p):
    """The probability of k or more successes among n."""
    return sum(math.comb(n, i) * p**i * (1 - p) ** (n - i) for i in range(k, n + 1))


def exact_interval(k, n, level=0.95):
    """The interval of Clopper and Pearson for a rate of which k of n were seen."""
    tail = (1 - level) / 2

    def root(f):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if f(middle) < tail else (low, middle)
        return (low + high) / 2

    lower = 0.0 if k == 0 else root(lambda p: binomial_tail(n, k, p))
    upper = 1.0 if k == n else 1 - root(lambda q: 1 - binomial_tail(n, k + 1, 1 - q))
    return lower, upper


def command_of(arguments, item):
    """The command that judges an item."""
    command = [arguments.program, "verify", "--json"]
    if item.suffix == ".toml":
        return command + [str(item)]
    plugin = pathlib.Path(arguments.plugins) / (item.stem + ".so")
    return command + [item.stem.replace("_", "-"), "--plugin", str(plugin)]


def judge(arguments, item):
    """How `verify` judged an item: (rightly, seconds, what it said)."""
    begin = time.monotonic()
    try:
        outcome = subprocess.run(command_of(arguments, item), capture_output=True, text=True, timeout=LONGEST, check=False)
    except subprocess.TimeoutExpired:
        return False, time.monotonic() - begin, "did not end"
    seconds = time.monotonic() - begin
    if outcome.returncode < 0:  # by a signal, which nobody takes for a pass
        return item.parent.name == "false", seconds, f"ended by signal {-outcome.returncode}"
    try:
        found = json.loads(outcome.stdout)
    except ValueError:
        return False, seconds, "no verdict: " + (outcome.stderr.strip().splitlines() or ["nothing said"])[0]
    failed = [c for c in found["checks"] if c["result"] == "fail"]
    judged = failed or any(c["result"] == "pass" for c in found["checks"])
    if item.parent.name == "sound":
        rightly = outcome.returncode == 0 and bool(judged)
    else:
        rightly = outcome.returncode == 1 and bool(failed)
    said = found.get("verdict", "")
    if failed:
        claims = sorted({f"{c['claim']} on {c['system']}" for c in failed})
        said = f"{len(failed)} fail: " + "; ".join(claims[:3])
    return rightly, seconds, said


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("corpus", type=pathlib.Path)
    parser.add_argument("--plugins", default=".")
    parser.add_argument("--half", action="append")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", nargs="*", default=[])
    arguments = parser.parse_args()
    items = sorted(item for item in arguments.corpus.glob("*/*/*") if item.suffix in (".toml", ".cpp"))
    if arguments.half:
        items = [item for item in items if item.parts[-3] in arguments.half]
    if arguments.only:
        items = [item for item in items if item.stem in arguments.only]
    if not items:
        sys.exit(f"{arguments.corpus}: expected folders HALF/sound and HALF/false with .toml and .cpp files")
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = dict(zip(items, pool.map(lambda item: judge(arguments, item), items)))
    missed = set()
    groups = {}
    for item, (rightly, seconds, said) in results.items():
        half, kind = item.parts[-3], item.parts[-2]
        groups.setdefault((half, kind), []).append(rightly)
        if not rightly:
            missed.add(f"{half}/{kind}/{item.stem}")
        mark = "" if rightly else "WRONG "
        print(f"{mark}{half}/{kind}/{item.stem}  {seconds:.0f} s  {said}"[:200])
    print()
    for (half, kind), judged in groups.items():
        k, n = sum(judged), len(judged)
        low, high = exact_interval(k, n)
        print(f"{half} {kind}: {k} of {n} judged rightly, rate {k / n:.2f}, 95 % interval {low:.2f} to {high:.2f}")
    known = arguments.corpus / "missed.txt"
    listed = {line for line in known.read_text().splitlines() if line and not line.startswith("#")} if known.exists() else set()
    judged = {f"{item.parts[-3]}/{item.parts[-2]}/{item.stem}" for item in items}
    for name in sorted(missed - listed):
        print(f"{name}: judged wrongly, which missed.txt does not list")
    for name in sorted((listed & judged) - missed):
        print(f"{name}: judged rightly, although missed.txt lists it")
    sys.exit(1 if missed - listed or (listed & judged) - missed else 0)


if __name__ == "__main__":
    main()
