#!/usr/bin/env python3
"""Reads the first screen of every experiment's report as a stranger would:  every_sentence.py REPORTS EXPERIMENTS

It must name the method that is cheapest at an error, with what it costs, or say that no error is known; say who stays closest
to the constraints where no method is called cheapest; and say of a conserved quantity which methods let it drift, if any. Of derived
equations it must say of a method how many operations they take and how that grows.
REPORTS holds a directory for each file of EXPERIMENTS, as `pfaff compare --all --out REPORTS` leaves them.
"""
import html
import json
import pathlib
import re
import sys

COST = r"(at most )?[0-9.]+ (ns|µs|ms|s|million|[a-z-]+ sides|steps)"


def plain(markup):
    return html.unescape(re.sub(r"<[^>]*>", "", re.sub(r"<sup>(.*?)</sup>", r"^\1", markup)))


def faults_of_derivations(page, head):
    said = re.search(r'<p class="find">(.*?)</p>', page, flags=re.S)
    names = "|".join(re.escape(m["name"]) for m in head["methods"])
    if not said or not re.match(rf"By ({names}) the \d+ equations .*? take \d+ operations, .*? and grow like [Ke]\^",
                                plain(said[1])):
        yield f"does not say how equations grow: {plain(said[1]) if said else 'no sentence'}"


def faults(folder):
    """What a reader misses in the sentences of a report."""
    page = (folder / "report.html").read_text(encoding="utf-8")
    head = json.loads((folder / "experiment.json").read_text(encoding="utf-8"))
    if head.get("kind") == "derivation":
        yield from faults_of_derivations(page, head)
        return
    labels = {m["label"] for m in head["methods"]}
    finds = re.findall(r'<p class="(?:find|casefind)">(.*?)</p>\s*(?:<p class="notice">.*?</p>\s*)?<p class="where">(.*?)</p>',
                       page, flags=re.S)
    if len(finds) != len(head["cases"]):
        yield f"{len(finds)} sentences for {len(head['cases'])} cases"
    for (markup, second), case in zip(finds, head["cases"]):
        said, below = plain(markup), plain(second)
        named = {html.unescape(x) for x in re.findall(r"<b [^>]*>(.*?)</b>", markup)}
        if not named or not named <= labels:
            yield f"{case['name']}: names {named or 'no method'}"
        cheapest = re.match(rf"At (.*? error|drift of .*?) 10\^−\d+ .+? (is|are) cheapest, {COST}", said)
        if not cheapest and "No error is known here" not in below:
            yield f"{case['name']}: does not say who is cheapest: {said}"
        if not cheapest and "stays closest to the constraints" not in said:
            yield f"{case['name']}: says nothing of what the methods keep: {said}"
        if case.get("conserved") and not re.search(r"\bdrift\b|is expected to (de|in)crease", below):
            yield f"{case['name']}: does not say what drifts: {below}"


def main(reports, experiments):
    names = sorted(path.stem for path in pathlib.Path(experiments).glob("*.toml"))
    found = [f"{name}: {fault}" for name in names for fault in faults(pathlib.Path(reports) / name)]
    print("\n".join(found) or f"the sentences of {len(names)} experiments say who is cheapest and what drifts")
    return 1 if found or not names else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
