#!/usr/bin/env python3
"""Holds the includes of the sources against the rules of the house.

  Arrows run one way: a room includes only the rooms below it (ROOMS).
  The program includes nothing of the library of studies (STUDIES), which it loads.
  No cycles of folders: what a folder includes, directly or through others, does not include the folder.
  A header compiles by itself, without generating code. Builds do not show it: where sources are compiled
  together, others come before the one that includes its header first.

  includes.py [--no-compile | --changed FILE] [--root DIRECTORY]
                              with --changed it compiles only the headers that the file lists and those that include one of
                              these, through others too
  includes.py --readers FILE  prints the sources that the file lists, and of its headers the sources that include them, through
                              others where none does itself
  includes.py --chains FILE   prints the headers that a file lists as they are compiled, those of a line one after the other

Exit status: 0 the rules hold, 1 a rule is broken (one line for each place), 2 wrong usage.
"""
import argparse
import concurrent.futures
import os
import re
import subprocess
import sys
import sysconfig
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
    "runs": {"core", "brackets", "formulations", "integrators", "systems"},
    "bench": {"core", "brackets", "formulations", "integrators", "systems", "runs"},
    "verify": {"core", "brackets", "formulations", "integrators", "systems", "runs", "bench"},
    "derive": {"core", "brackets", "formulations", "integrators", "systems", "runs", "bench", "verify"},
    "papers": {"core", "brackets", "formulations", "integrators", "systems", "runs", "bench", "verify", "derive"},
    "app": {"core", "brackets", "formulations", "integrators", "systems", "runs", "bench", "verify", "derive", "papers"},
    "python": {"core", "brackets", "formulations", "integrators", "systems", "runs", "bench", "verify", "derive", "papers"},
}
# The rooms that are the library of studies (CMakeLists.txt), which the program is not linked to.
STUDIES = {"verify", "derive", "papers"}
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


def broken_libraries(arrows):
    for source, number, target in arrows:
        if source.parts[0] == "app" and target.parts[0] in STUDIES:
            yield f"{source}:{number}: includes {target} of the library of studies; expected it to be asked for by studies()"


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


# Headers that many others include, in the sets that are precompiled: a header that includes all of a set, directly or
# through others, is compiled after it. That shows as much as compiling it after nothing, because it has the set anyway
# and each header of the set is compiled by itself too. The first set that fits is taken.
PRECOMPILED = [["core/facets/method_instance.hpp", "bench/runner/json.hpp"], ["core/facets/method_instance.hpp"], ["core/facets/model.hpp"],
               ["bench/runner/json.hpp"], ["core/tape/recorder.hpp"], ["core/numbers/real.hpp"]]


def closure(graph, header):
    """The files that a header includes, directly or through others."""
    found, left = set(), [header]
    while left:
        for target in graph[left.pop()]:
            if target not in found:
                found.add(target)
                left.append(target)
    return found


def chains(headers, held):
    """The headers in as few chains as possible, in each of which every header includes the one before, directly or through
    others. A chain is compiled at once, which shows as much: each header comes after what it includes anyway."""
    following, before = {}, {}

    def attach(header, tried):
        for other in headers:
            if header in held[other] and other not in held[header] and other not in tried:
                tried.add(other)
                if other not in before or attach(before[other], tried):
                    following[header], before[other] = other, header
                    return True
        return False

    for header in headers:
        attach(header, set())
    for first in headers:
        if first not in before:
            chain = [first]
            while chain[-1] in following:
                chain.append(following[chain[-1]])
            yield chain


def readers(arrows, changed):
    """Sources in which every one of the files that is of a room is read."""
    users = defaultdict(set)
    for source, _, target in arrows:
        users[target].add(source)
    found, left = set(), list(changed)
    for file in left:  # which grows
        sources = {file} if file.suffix == ".cpp" else {user for user in users[file] if user.suffix == ".cpp"}
        found |= sources
        left += [] if sources else users[file].difference(left)
    return found


def paths_in(listed):
    return [Path(line) for line in listed.read_text().splitlines()]


def graph_of(arrows):
    graph = defaultdict(set)
    for source, _, target in arrows:
        graph[source].add(target)
    return graph


def compiled_alone(root, headers, held):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "pfaff").symlink_to(root)
        compiler = [os.environ.get("CXX", "c++"), "-std=c++20", "-w", "-I", folder, "-isystem", "/usr/include/eigen3",
                    "-isystem", sysconfig.get_path("include")]  # of Python, for the bindings

        def run(*options):
            return subprocess.run([*compiler, *options], capture_output=True, text=True, check=False)

        def precompile(number):
            name = Path(folder) / f"set{number}.hpp"
            name.write_text("".join(f"#include <pfaff/{header}>\n" for header in PRECOMPILED[number]))
            done = run("-x", "c++-header", str(name), "-o", f"{name}.gch")
            return name.name if done.returncode == 0 else None  # what is wrong is said of the header itself

        def compiled(name, chain):
            files = [*([name] if name else []), *(f"pfaff/{header}" for header in chain)]
            return run("-fsyntax-only", "-x", "c++", *(option for file in files for option in ("-include", file)), "/dev/null")

        def faults_of(task):
            name, chain = task
            if compiled(name, chain).returncode == 0:
                return []
            faults = []
            for header in chain:
                done = compiled(name, [header])
                errors = [line for line in done.stderr.splitlines() if "error:" in line]
                if done.returncode != 0:
                    faults.append(f"{header} does not compile by itself: {(errors or ['?'])[0]}")
            return faults or [f"{', '.join(map(str, chain))} do not compile one after the other"]

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            groups = defaultdict(list)
            for header in headers:
                fitting = (number for number, parts in enumerate(PRECOMPILED) if held[header].issuperset(map(Path, parts)))
                groups[next(fitting, None)].append(header)
            made = pool.map(lambda number: None if number is None else precompile(number), groups)
            tasks = [(name, chain) for name, group in zip(made, groups.values()) for chain in chains(group, held)]
            for faults in pool.map(faults_of, tasks):
                yield from faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    parser.add_argument("--no-compile", action="store_true", help="look at arrows and cycles only")
    parser.add_argument("--changed", type=Path, metavar="FILE", help="compile only what changes of the files that it lists may have broken")
    parser.add_argument("--readers", type=Path, metavar="FILE", help="print the sources in which these files are read, and check nothing")
    parser.add_argument("--chains", type=Path, metavar="FILE", help="print headers as they are compiled, and check nothing")
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    files = list(sources(root))
    arrows = [(source, number, target) for source in files for number, target in includes(root, source)]
    graph = graph_of(arrows)
    if arguments.chains:
        listed = paths_in(arguments.chains)
        for chain in chains(listed, {header: closure(graph, header) for header in listed}):
            print(*chain)
        return 0
    if arguments.readers:
        for source in sorted(readers(arrows, paths_in(arguments.readers)).intersection(files)):
            print(source)
        return 0
    problems = [*broken_arrows(arrows), *broken_libraries(arrows), *cycles(arrows)]
    listed = root / "cmake" / "public_headers.txt"
    public = set(paths_in(listed)) if listed.exists() else set()
    others = [f for f in files if f.suffix == ".hpp" and f not in public and f.parts[0] != "app"
              and f.parts[:2] != ("bench", "micro")]
    if not arguments.no_compile:
        held = {header: closure(graph, header) for header in others}
        if arguments.changed:
            changed = set(paths_in(arguments.changed))
            others = [header for header in others if header in changed or not held[header].isdisjoint(changed)]
        problems += compiled_alone(root, others, held)
    print("\n".join(problems), end="\n" if problems else "", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
