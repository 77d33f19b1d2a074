#!/usr/bin/env python3
"""Figures and report of an experiment:  python3 report.py EXPERIMENT_DIR
and figures for papers:  python3 report.py EXPERIMENT_DIR --figures pdf,svg,pgf,png [--width 85mm] [--style FILE]

Reads experiment.json, results.csv, cost.csv (if timings were measured) and runs/*/series.csv with summary.json, as
`pfaff compare` leaves them. Writes figures/<kind>_<case>.{svg,png}, report.html, the verdict as verdict.csv, and report.json,
which holds it too and what its sentences assert, the same bytes for the same data; a report that would be the same stays
(kept.py). With --figures it writes figures and tables for papers instead, into figures/paper/: of that width, with text as
text, captions beside them, drawn in matplotlib's style of the file (paper.mplstyle beside this script is the one taken). Needs
matplotlib and nothing else; pgf needs LaTeX. Exit status: 0 fine, 2 wrong usage or input, with one line on stderr.
"""
import os
import pathlib
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which python3 -I leaves out

import derivation
import kept
from command import FIGURES, ended, parsed, table, write
from experiment import Experiment
from wanted import wanted as wanted_of


def report(folder):
    """Makes the report, unless the one that is there would be the same."""
    of = kept.made_of(pathlib.Path(folder))
    if kept.is_kept(pathlib.Path(folder), of):
        return {"report": str(pathlib.Path(folder) / "report.html")}
    made = derivation_report(folder) if derivation.is_one(folder) else experiment_report(folder)
    kept.note(pathlib.Path(folder), of)
    return made


def derivation_report(folder):
    import derivation_page
    return derivation_page.report(derivation.Study(folder))


def experiment_report(folder):
    experiment = Experiment(folder)
    import first_screen
    import page  # after the input has been read: importing matplotlib takes a second
    from drawn import drawn
    from figures import saved
    from verdict import Verdict
    from verdict_data import rows
    verdicts = [Verdict(experiment, case) for case in experiment.cases]
    pictures = {v.case["name"]: saved(drawn(v), experiment.folder / "figures", small=v is verdicts[0]) for v in verdicts}
    write(experiment.folder / "verdict.csv", table([row for v in verdicts for row in rows(v)]))
    write(experiment.folder / "report.json", first_screen.data(experiment, verdicts))
    write(experiment.folder / "report.html", page.page(experiment, verdicts, pictures))
    return {"report": str(experiment.folder / "report.html")}


def paper(folder, options):
    experiment = None if derivation.is_one(folder) else Experiment(folder)
    wanted = wanted_of(options)
    import papers
    from verdict import Verdict
    if experiment is None:
        import derivation_page
        derivation_page.papers(derivation.Study(folder), wanted)
    else:
        papers.papers(experiment, [Verdict(experiment, case) for case in experiment.cases], wanted)
    return {"left_out": wanted.left_out}


def work(arguments):
    folder, options = parsed(arguments, "the directory of an experiment", FIGURES)
    return paper(folder, options) if options else report(folder)


def main(arguments):
    return ended("report.py", __doc__, work, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
