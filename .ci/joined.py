#!/usr/bin/env python3
"""Names that would mean something else where sources are compiled together (PFAFF_JOINED).

    .ci/joined.py     prints what is wrong; exit status 1 if something is

What a source declares in an unnamed namespace is seen by the sources that follow it in the same joined file. One that
uses the same name for what a header declares would then silently get the other. Therefore no source uses a name that
another source of the same target declares in an unnamed namespace, unless it declares the name itself. Names are looked
for as words, without reading C++: a local variable counts as a declaration of its name, and members do not count.

Types are looked for in the whole of an unnamed namespace. Functions and variables are looked for only up to the first
line that begins with a closing brace: further down many have the names of other functions, from whose overloads the
compiler tells them by their arguments.
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TARGETS = {
    "pfaff": ["core", "brackets", "formulations", "systems", "integrators"],
    "pfaff_bench": ["bench/measure", "bench/runner"],
    "pfaff_bench_cold": ["bench/evaluation", "bench/experiment", "bench/studies"],
    "pfaff_studies": ["bench/derivation", "bench/tuning"],
    "pfaff_studies_cold": ["bench/commands", "bench/derivation_growth", "bench/falsification", "bench/random_systems",
                           "bench/reproduce", "bench/verification"],
    "pfaff_app": ["app"],
    **{f"{room}_tests": [f"tests/{room}"]
       for room in ("core", "brackets", "formulations", "systems", "integrators", "bench", "app")},
}
REGISTERED = "registered"  # has a name of its own in each source (cmake/PfaffTargets.cmake)

IGNORED = re.compile(r'R"(\w*)\(.*?\)\1"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^#[^\n]*', re.S | re.M)
KEYWORDS = re.compile(r"\b(?:return|throw|else|case|new|delete|goto|and|or|not|co_return)\b")  # no types before a name
UNNAMED = re.compile(r"^namespace \{\n(.*?)^\}", re.S | re.M)
UNNAMED_BEGINS = re.compile(r"^namespace \{\n", re.M)
TYPE = re.compile(r"^(?:template\s*<.*>\s*)?(?:struct|class|enum class|enum|union|concept|using(?! namespace))\s+(\w+)", re.M)
TYPEDEF = re.compile(r"^(?:__extension__ )?typedef [\w ]+?(\w+);", re.M)
FUNCTION = re.compile(r"^(?!return|using|else|for|if|while|struct|class|enum|template|requires)"
                      r"[\w:\[][\w:<>,&*\s\[\]]*?[\s&*](\w+)\(", re.M)
VARIABLE = re.compile(r"^(?:constexpr|const|static|thread_local|inline|std::)[^;(){}=]*?[\s&*>](\w+)\s*(?:\{|=|\[|;)", re.M)


def unnamed(text):
    """What stands in the unnamed namespaces of a text, each up to the brace that ends it."""
    for begin in UNNAMED_BEGINS.finditer(text):
        depth, rest = 1, text[begin.end():]
        for brace in re.finditer(r"[{}]", rest):
            depth += 1 if brace.group() == "{" else -1
            if depth == 0:
                yield rest[:brace.start()]
                break


def declared(text):
    """The names that a text declares in unnamed namespaces, each with the pattern of a use."""
    names = {}
    types = [name for block in unnamed(text) for name in TYPE.findall(block) + TYPEDEF.findall(block)]
    for block in [*UNNAMED.findall(text), ""]:
        for name in types + VARIABLE.findall(block):
            names[name] = rf"(?<![\w.:>])(?<!-> ){name}\b(?!::)"
        for name in FUNCTION.findall(block):
            names.setdefault(name, rf"(?<![\w.:>]){name}\s*(?:<[^;(){{}}]*>)?\(")
    names.pop(REGISTERED, None)
    return names


def declares(text, name):
    """True where a text declares the name anywhere: as a type, a function, a variable or a parameter."""
    return re.search(rf"\b(?:struct|class|typename|using|enum|concept|auto)\s*[&*]*\s*{name}\b"
                     rf"|[\w>\]]\s*[&*]*\s+[&*]*{name}\b(?=\s*[({{=;,)\[:])|\[[^\]\n]*\b{name}\b[^\]\n]*\]\s*[:=(]"
                     rf"|\bauto&? \[[^\]]*\b{name}\b", text) is not None


def clashes(sources):
    """Lines about the sources, {path: text}, of one target."""
    texts = {path: KEYWORDS.sub(";", IGNORED.sub(" ", text)) for path, text in sources.items()}
    words = {path: set(re.findall(r"\w+", text)) for path, text in texts.items()}
    where = collections.defaultdict(list)
    for path, text in texts.items():
        for name, use in declared(text).items():
            where[name].append((path, use))
    lines = []
    for name, places in sorted(where.items()):
        for path, text in texts.items():
            if any(path == place for place, _ in places):
                continue
            if name in words[path] and re.search(places[0][1], text, re.M) and not declares(text, name):
                others = ", ".join(place for place, _ in places)
                lines.append(f"{path}: uses the name '{name}', declared in unnamed namespaces of {others}")
    return lines


def main():
    found = []
    for folders in TARGETS.values():
        # The folders below those of tests hold what is built otherwise.
        sources = [path for folder in folders
                   for path in sorted((ROOT / folder).glob("*.cpp" if folder.startswith("tests") else "**/*.cpp"))]
        found += clashes({str(path.relative_to(ROOT)): path.read_text() for path in sources})
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
