#!/usr/bin/env python3
"""One page of the reports of several experiments:  python3 index.py PAGE EXPERIMENT_DIR...

Reads report.json, experiment.json and figures/small.svg of each directory, as report.py leaves them. Writes the page: of every
experiment its sentences, its first figure and a link to its report, and a table of all methods and problems. Needs matplotlib,
whose colours the figures have. Exit status: 0 fine, 2 wrong usage or input, with one line on stderr.
"""
import os
import pathlib
import sys
import urllib.parse

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which python3 -I leaves out

from command import ended, write
from files import InputError, read_json, require


class Reported:
    """An experiment that has a report."""

    def __init__(self, folder, page):
        self.folder = pathlib.Path(folder)
        self.head, report = (read_json(self.folder / f"{name}.json") for name in ("experiment", "report"))
        require(self.head, f"{folder}/experiment.json", name=str, title=str)
        require(report, f"{folder}/report.json", cases=list)
        self.cases = report["cases"]
        for case in self.cases:
            require(case, f"{folder}/report.json", case=str, title=str, sentence=str, methods=list)
        path = self.folder / "figures" / "small.svg"
        self.picture = path.read_text(encoding="utf-8") if path.exists() else ""
        self.link = urllib.parse.quote(os.path.relpath(self.folder, page.parent)) + "/report.html"

    @property
    def problems(self):
        """Its cases of which methods were run; derived equations are no problem for a method."""
        return [case for case in self.cases if any("structure_kept" in row for row in case["methods"])]


def index(arguments):
    if len(arguments) < 2:
        raise InputError("expected the path of the page, and the directories of experiments")
    path = pathlib.Path(arguments[0])
    reported = [Reported(folder, path) for folder in arguments[1:]]
    import index_page  # importing matplotlib takes a second
    write(path, index_page.page(reported))
    return {"index": str(path)}


def main(arguments):
    return ended("index.py", __doc__, index, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
