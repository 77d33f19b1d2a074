#!/usr/bin/env python3
"""Shows that the library takes no function for optimised code from a source that is hardly optimised.

    hot_code.py LIBRARY OPTIMISED OTHERS COMPILER

OPTIMISED and OTHERS are files that list objects, one a line.

Inline functions and templates are compiled in every source that uses them, and the linker keeps one copy of each, the
first that it meets. Where an optimised source has a copy, the copy that is kept has to be one of those. Copies are told
apart by their sizes: of a function whose copies differ in size between the two kinds of objects, the one in the library
has to have a size that optimised copies have. The control links the objects in the wrong order, of which most must be found. How
many can be told apart depends on the processor that is compiled for; where hardly any can, nothing is shown.
"""
import pathlib
import subprocess
import sys
import tempfile
from collections import defaultdict


FEWEST = 30  # functions, told apart


def weak_functions(files):
    """name -> sizes of the weak functions in object files"""
    sizes = defaultdict(set)
    text = subprocess.run(["nm", "--defined-only", "-S", *map(str, files)], check=True, capture_output=True, text=True)
    for line in text.stdout.splitlines():
        fields = line.split()
        if len(fields) == 4 and fields[2] == "W":
            sizes[fields[3]].add(int(fields[1], 16))
    return sizes


def wrongly_taken(library, optimised, other):
    """Functions of the library that are copies of hardly optimised ones, and how many could be told apart."""
    hot, cold, kept = weak_functions(optimised), weak_functions(other), weak_functions([library])
    told_apart = [name for name in hot if name in cold and name in kept and not hot[name] & cold[name]]
    return [name for name in told_apart if not kept[name] & hot[name]], len(told_apart)


def main(library, optimised, other, compiler):
    hot, cold = ([line for line in pathlib.Path(objects).read_text(encoding="utf-8").split("\n") if line.endswith(".o")]
                 for objects in (optimised, other))
    wrong, count = wrongly_taken(library, hot, cold)
    print(f"{len(wrong)} of {count} functions that can be told apart are the hardly optimised copies")
    for name in wrong[:20]:
        print("   ", name)
    with tempfile.TemporaryDirectory() as folder:
        reversed_library = pathlib.Path(folder) / "reversed.so"
        subprocess.run([compiler, "-shared", "-o", reversed_library, *cold, *hot, "-lquadmath"], check=True)
        found, _ = wrongly_taken(reversed_library, hot, cold)
    print(f"control, linked in the wrong order: {len(found)} found")
    return 1 if wrong or count < FEWEST or len(found) < count / 2 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:5]))
