#!/usr/bin/env python3
"""Holds the enumerations of docs/architecture.md against the tree, or writes them.

  map.py [--write] [--root DIRECTORY]

Between `<!-- folders -->` and `<!-- end -->` stands a row for every folder with sources: which folders of its room and
which other rooms it includes, read from the sources, and what it holds, which is written by hand and kept. Between
`<!-- report -->` and `<!-- end -->` stands a row for every script of bench/report/, with the first sentence of it.

Exit status: 0 the page says what the tree is, or was written; 1 it says something else; 2 wrong usage.
"""
import argparse
import ast
import re
import sys
from collections import defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import includes  # noqa: E402

PAGE = Path("docs") / "architecture.md"
ROW = re.compile(r"^\| `([^`]+)/` \| (.*?) \|.*\|$", re.M)


def part(text, name):
    """(begin, end) of what stands between the marks of a part of the page."""
    found = re.search(rf"<!-- {name} -->\n(.*?)<!-- end -->\n", text, re.S)
    if not found:
        raise SystemExit(f"{PAGE}: expected a part from '<!-- {name} -->' to '<!-- end -->'")
    return found.span(1)


def folder_rows(root, by_hand):
    """The table of folders; `by_hand` has what each holds. A folder that nobody has described is an error."""
    folders, within, rooms = set(), defaultdict(set), defaultdict(set)
    for source in includes.sources(root):
        folders.add(source.parent)
        for _, target in includes.includes(root, source):
            if target.parent != source.parent:
                same = target.parts[0] == source.parts[0]
                (within if same else rooms)[source.parent].add(str(target.parent if same else target.parts[0]))
    rows = ["", "| folder | what it holds | includes |", "|---|---|---|"]
    for folder in sorted(folders):
        if not by_hand.get(str(folder)):
            raise SystemExit(f"{PAGE}: expected a row '| `{folder}/` | what it holds | |' in the table of folders")
        # Rooms first, then folders of the same room without its name.
        inside = [name.partition("/")[2] or f"{name}/ itself" for name in sorted(within[folder])]
        rows.append(f"| `{folder}/` | {by_hand[str(folder)]} | {', '.join([*sorted(rooms[folder]), *inside])} |")
    return "\n".join([*rows, "", ""])


def report_rows(root):
    rows = ["", "| script | what it is for |", "|---|---|"]
    for script in sorted((root / "bench" / "report").glob("*.py")):
        words = " ".join((ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or "").split("\n\n")[0].split())
        sentence = re.match(r".*?(?:\.(?= |$)|$)", words).group().rstrip(".")
        if not sentence:
            raise SystemExit(f"{script.relative_to(root)}: expected a docstring that says what it is for")
        rows.append(f"| `{script.name}` | {sentence} |")
    return "\n".join([*rows, "", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    page = root / PAGE
    before = text = page.read_text(encoding="utf-8")
    begin, end = part(text, "folders")
    text = text[:begin] + folder_rows(root, dict(ROW.findall(text[begin:end]))) + text[end:]
    begin, end = part(text, "report")
    text = text[:begin] + report_rows(root) + text[end:]
    if text == before:
        return 0
    if arguments.write:
        page.write_text(text, encoding="utf-8")
        return 0
    for number, (old, new) in enumerate(zip(before.splitlines(), text.splitlines()), 1):
        if old != new:
            print(f"{PAGE}:{number}: expected '{new}' (.ci/map.py --write writes it)", file=sys.stderr)
            return 1
    print(f"{PAGE}: expected {len(text.splitlines())} lines (.ci/map.py --write writes them)", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
