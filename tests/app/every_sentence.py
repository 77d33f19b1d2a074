#!/usr/bin/env python3
"""Reads the first screen of every experiment's report as a stranger would:  every_sentence.py REPORTS EXPERIMENTS

Every case has a sentence, which names methods of the experiment or says what the runs do not tell; what the page shows is what
report.json holds; the question of the experiment stands above; and the files bear out every assertion (assertions.py). Of
derived equations it must say of a method how many operations they take and how that grows.
REPORTS holds a directory for each file of EXPERIMENTS, as `pfaff compare --all --out REPORTS` leaves them.
"""
import html
import json
import pathlib
import re
import sys

import assertions

NOTHING = ("The runs do not tell ", "No method is called cheapest: ")


def plain(markup):
    return html.unescape(re.sub(r"<[^>]*>", "", re.sub(r"<sup>(.*?)</sup>", r"^\1", markup)))


def faults_of_derivations(page, head):
    said = re.search(r'<p class="find">(.*?)</p>', page, flags=re.S)
    names = "|".join(re.escape(m["name"]) for m in head["methods"])
    if not said or not re.match(rf"By ({names}) the \d+ equations .*? take \d+ operations, .*? and grow like [Ke]\^",
                                plain(said[1])):
        yield f"does not say how equations grow: {plain(said[1]) if said else 'no sentence'}"


def faults(folder):
    """What a reader misses in the sentences of a report, and what its files deny."""
    page = (folder / "report.html").read_text(encoding="utf-8")
    head = json.loads((folder / "experiment.json").read_text(encoding="utf-8"))
    if head.get("kind") == "derivation":
        yield from faults_of_derivations(page, head)
        return
    labels = {m["label"] for m in head["methods"]}
    finds = re.findall(r'<p class="(?:find|casefind)">(.*?)</p>\s*(?:<p class="notice">.*?</p>\s*)?<p class="where">(.*?)</p>',
                       page, flags=re.S)
    cases = json.loads((folder / "report.json").read_text(encoding="utf-8"))["cases"]
    if not len(finds) == len(cases) == len(head["cases"]):
        yield f"{len(finds)} sentences and {len(cases)} in report.json for {len(head['cases'])} cases"
    for (markup, second), case in zip(finds, cases):
        said, named = plain(markup), {html.unescape(x) for x in re.findall(r"<b [^>]*>(.*?)</b>", markup)}
        if not named <= labels:
            yield f"{case['case']}: names {named - labels}"
        if said != case["sentence"] or not plain(second).startswith(case["below"]):
            yield f"{case['case']}: the page says other than report.json: {said}"
        if not case["assertions"] and not any(x in said + plain(second) for x in NOTHING):
            yield f"{case['case']}: asserts nothing and does not say why: {said}"
        if case["question"] and case["question"] not in plain(page):
            yield f"{case['case']}: the question is not asked"
    yield from assertions.faults(folder)


def main(reports, experiments):
    names = sorted(path.stem for path in pathlib.Path(experiments).glob("*.toml"))
    found = [f"{name}: {fault}" for name in names for fault in faults(pathlib.Path(reports) / name)]
    print("\n".join(found) or f"the files of {len(names)} experiments bear out the sentences of their reports")
    return 1 if found or not names else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
