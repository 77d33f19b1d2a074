#!/usr/bin/env python3
"""Holds the includes of the sources against the rules of the house.

  Arrows run one way: a room includes only the rooms below it (ROOMS).
  No cycles of folders: what a folder includes, directly or through others, does not include the folder.
  A public header compiles by itself. Headers that a source of the same name includes first are compiled so by
  every build; the others are compiled here, without generating code.

  includes.py [--no-compile] [--root DIRECTORY]

Exit status: 0 the rules hold, 1 a rule is broken (one line for each place), 2 wrong usage.
"""
import argparse
import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

# What each room may include, besides itself.
ROOMS = {
    "core": set(),
    "brackets": {"core"},
    "formulations": {"core"},
    "integrators": {"core"},
    "systems": {"core", "brackets"},
    "bench": {"core", "brackets", "formulations", "integrators", "systems"},
    "app": {"core", "brackets", "formulations", "integrators", "systems", "bench"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def sources(root):
    """Every header and source of the rooms, relative to the root."""
    for room in ROOMS:
        for path in sorted((root / room).rglob("*")):
            if path.suffix in (".hpp", ".cpp"):
                yield path.relative_to(root)


def includes(root, source):
    """(line number, included file relative to the root) for every include of a file of the rooms."""
    for number, line in enumerate((root / source).read_text().splitlines(), 1):
        if not (found := INCLUDE.match(line)):
            continue
        quoted, name = found.group(1) == '"', found.group(2)
        if quoted and (root / source.parent / name).exists():
            yield number, Path(os.path.normpath(source.parent / name))
        elif name.startswith("pfaff/"):
            yield number, Path(name.removeprefix("pfaff/"))


def broken_arrows(arrows):
    for source, number, target in arrows:
        room, other = source.parts[0], target.parts[0]
        if other != room and other not in ROOMS[room]:
            allowed = ", ".join(sorted(ROOMS[room])) or "nothing but itself"
            yield f"{source}:{number}: {room} includes {target}; expected {allowed}"


def cycles(arrows):
    """One line for every cycle of folders, with an include for each of its arrows."""
    graph, example = defaultdict(set), {}
    for source, number, target in arrows:
        if source.parent != target.parent:
            graph[source.parent].add(target.parent)
            example.setdefault((source.parent, target.parent), f"{source}:{number} includes {target}")
    seen = set()

    def path_back(start):
        trail, done = [(start, [start])], set()
        while trail:
            folder, path = trail.pop()
            for following in sorted(graph[folder]):
                if following == start:
                    return path + [start]
                if following not in done:
                    done.add(following)
                    trail.append((following, path + [following]))
        return None

    for folder in sorted(graph):
        path = path_back(folder) if folder not in seen else None
        if path:
            seen.update(path)
            steps = "; ".join(example[pair] for pair in zip(path, path[1:]))
            yield f"cycle of folders {' -> '.join(map(str, path))}: {steps}"


def compiled_alone(root, headers):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "pfaff").symlink_to(root)
        flags = ["-std=c++20", "-fsyntax-only", "-w", "-x", "c++", "-I", folder, "-isystem", "/usr/include/eigen3"]
        compiler = os.environ.get("CXX", "c++")

        def compile_one(header):
            done = subprocess.run([compiler, *flags, "-include", f"pfaff/{header}", "/dev/null"],
                                  capture_output=True, text=True, check=False)
            errors = [line for line in done.stderr.splitlines() if "error:" in line]
            return None if done.returncode == 0 else f"{header} does not compile by itself: {(errors or ['?'])[0]}"

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            yield from filter(None, pool.map(compile_one, headers))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    parser.add_argument("--no-compile", action="store_true", help="look at arrows and cycles only")
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    files = list(sources(root))
    arrows, first = [], set()
    for source in files:
        for position, (number, target) in enumerate(includes(root, source)):
            arrows.append((source, number, target))
            if position == 0 and target == source.with_suffix(".hpp"):
                first.add(target)
    problems = [*broken_arrows(arrows), *cycles(arrows)]
    # The program's own headers and those of single benchmarks are not installed.
    public = [f for f in files if f.suffix == ".hpp" and f.parts[0] != "app" and f.parts[:2] != ("bench", "micro")]
    if not arguments.no_compile:
        problems += compiled_alone(root, [h for h in public if h not in first])
    print("\n".join(problems), end="\n" if problems else "", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
