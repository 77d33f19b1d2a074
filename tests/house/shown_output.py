#!/usr/bin/env python3
"""The pages are true: every command in a block ```console is run, and what it prints is what stands below it.

  shown_output.py PROGRAM PAGE...

The commands of a page run one after another in one directory, which has the folder examples/ of the tree. `...` stands
for lines that are left out, blanks for any number of blanks. Words and whole numbers are the same. Other numbers agree
to two digits; below 1e-11 they are what rounding left, which differs between machines, and agree to a factor of 1000.
Timings are not compared: the last column of a table whose header ends in ns/step.

Exit status: 0 all is as shown, 1 something is not (each command with what it prints), 2 wrong usage.
"""
import argparse
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*\w)")
ROUND_OFF = 1e-11


def steps_of(page):
    """(command, lines shown below it) for every command of a page; a command has what follows it up to END."""
    steps, inside, here_document = [], False, False
    for line in page.splitlines():
        if here_document:
            steps[-1][0].append(line)
            here_document = line != "END"
        elif line.startswith("```"):
            inside = line == "```console"
        elif inside and line.startswith("$ "):
            steps.append(([line[2:]], []))
            here_document = line.endswith("<<'END'")
        elif inside:
            steps[-1][1].append(line)
    return [("\n".join(command), shown) for command, shown in steps]


def numbers_agree(shown, printed):
    if shown == printed:
        return True
    if re.fullmatch(r"[-+]?[1-9]\d*", shown):
        return False
    a, b = float(shown), float(printed)
    if max(abs(a), abs(b)) < ROUND_OFF:
        return a == 0 or b == 0 or max(abs(a), abs(b)) <= 1000 * min(abs(a), abs(b))
    second_digit = 10 ** (math.floor(math.log10(max(abs(a), abs(b)))) - 1)
    return abs(a - b) <= 0.5001 * second_digit


def lines_agree(shown, printed, timed):
    """True where a line is the one shown; the last number of a `timed` one is a timing."""
    shapes = [" ".join(NUMBER.sub("#", line).split()) for line in (shown, printed)]
    if shapes[0] != shapes[1]:
        return False
    pairs = list(zip(NUMBER.findall(shown), NUMBER.findall(printed)))
    return all(numbers_agree(*pair) for pair in (pairs[:-1] if timed else pairs))


def timed_lines(lines):
    """Which of the lines are rows below a header that ends in ns/step."""
    inside, timed = False, []
    for line in lines:
        timed.append(inside and bool(line.strip()))
        inside = line.endswith("ns/step") or timed[-1]
    return timed


def agree(shown, printed):
    """True where the lines are those shown; "..." stands for any lines."""
    timed = timed_lines(printed)
    reached = {0}  # how many of the printed lines those shown so far may have used up
    for line in shown:
        if line == "...":
            reached = set(range(min(reached), len(printed) + 1)) if reached else set()
        else:
            reached = {p + 1 for p in reached if p < len(printed) and lines_agree(line, printed[p], timed[p])}
    return len(printed) in reached


def printed_by(command, program, directory):
    script = f"pfaff() {{ '{program}' \"$@\"; }}\n{command}\n"
    environment = {k: v for k, v in os.environ.items() if k != "COLUMNS"}
    done = subprocess.run(["bash", "-c", script], cwd=directory, env=environment, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    return done.stdout.splitlines()


def faults(page, program):
    """A text for every command of a page that prints something else than what is shown, and how many there are."""
    found, steps = [], steps_of(page)
    with tempfile.TemporaryDirectory() as directory:
        (Path(directory) / "examples").symlink_to(ROOT / "examples")
        # The command of the main job, without building the program first.
        main_job = Path(directory) / "bench" / "run"
        main_job.parent.mkdir()
        main_job.write_text(f"#!/bin/bash\nexec '{program}' compare damped-oscillator --no-report \"$@\"\n")
        main_job.chmod(0o755)
        for command, shown in steps:
            printed = printed_by(command, program, directory)
            if not agree(shown, printed):
                found.append("\n  ".join([f"$ {command}", "prints", *printed]))
    return found, len(steps)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("pages", nargs="+", type=Path)
    arguments = parser.parse_args()
    failed, commands = False, 0
    for path in arguments.pages:
        found, steps = faults(path.read_text(encoding="utf-8"), arguments.program.resolve())
        commands += steps
        for fault in found:
            failed = True
            print(f"{path}: {fault}", file=sys.stderr)
    print(f"{commands} commands of {len(arguments.pages)} pages")
    return 1 if failed or commands == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
