#!/usr/bin/env python3
"""Figures and report of an experiment:  python3 report.py EXPERIMENT_DIR
and figures for papers:  python3 report.py EXPERIMENT_DIR --figures pdf,svg,pgf,png [--width 85mm] [--style FILE]

Reads experiment.json, results.csv, cost.csv (if timings were measured) and runs/*/series.csv with summary.json, as
`pfaff compare` leaves them. Writes figures/<kind>_<case>.{svg,png}, report.html and report.json, which holds what its sentences assert, the same bytes for the same
data. With --figures it writes figures and tables for papers instead, into figures/paper/: of that width, with text as text,
captions beside them, drawn in matplotlib's style of the file (paper.mplstyle beside this script is the one taken). Needs
matplotlib and nothing else; pgf needs LaTeX. Exit status: 0 fine, 2 wrong usage or input, with one line on stderr.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which python3 -I leaves out

import derivation
from experiment import Experiment
from files import InputError


def write(path, content):
    """Write to a temporary name beside `path`, then rename: a reader never sees half a file."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    with open(temporary, "xb") as file:  # a new file: what a link of this name leads to is not ours
        try:
            file.write(content.encode("utf-8") if isinstance(content, str) else content)
            file.flush()
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)


def report(folder):
    if derivation.is_one(folder):
        import derivation_page
        return derivation_page.report(derivation.Study(folder), write)
    experiment = Experiment(folder)
    import first_screen
    import page  # after the input has been read: importing matplotlib takes a second
    from drawn import drawn
    from verdict import Verdict
    target, pictures = experiment.folder / "figures", {}
    target.mkdir(exist_ok=True)
    verdicts = [Verdict(experiment, case) for case in experiment.cases]
    for verdict in verdicts:
        shown = pictures[verdict.case["name"]] = []
        for drawing in drawn(verdict):
            sheet = drawing.draw(True)
            alone = sheet.svg(f"{drawing.name}-wide", coloured=True)
            write(target / f"{drawing.name}.svg", f'<?xml version="1.0" encoding="utf-8"?>\n{alone}')
            if drawing.kind == "animation":  # scales by itself, and has no picture that stands still
                shown.append((drawing, sheet.svg(f"{drawing.name}-moving"), ""))
                continue
            write(target / f"{drawing.name}.png", sheet.png())
            shown.append((drawing, sheet.svg(f"{drawing.name}-wide"), drawing.draw(False).svg(f"{drawing.name}-narrow")))
    write(experiment.folder / "report.json", first_screen.data(experiment, verdicts))
    write(experiment.folder / "report.html", page.page(experiment, verdicts, pictures))
    return experiment.folder / "report.html"


def paper(folder, options):
    experiment = None if derivation.is_one(folder) else Experiment(folder)
    import papers
    from verdict import Verdict
    kinds, width = papers.kinds_of(options["--figures"]), papers.width_of(options.get("--width", "85mm"))
    if experiment is None:
        import derivation_page
        return derivation_page.papers(derivation.Study(folder), kinds, width, options.get("--style"), write)
    verdicts = [Verdict(experiment, case) for case in experiment.cases]
    return papers.papers(experiment, verdicts, kinds, width, options.get("--style"), write)


def parsed(arguments):
    """(the directory, {option: value})"""
    options, rest = {}, list(arguments)
    for option in ("--figures", "--width", "--style"):
        if option in rest:
            at = rest.index(option)
            if at + 1 == len(rest):
                raise InputError(f"{option}: expected a value")
            options[option] = rest[at + 1]
            del rest[at:at + 2]
    if len(rest) != 1 or rest[0].startswith("--"):
        raise InputError("expected one argument, the directory of an experiment, and options --figures, --width, --style")
    if options and "--figures" not in options:
        raise InputError("--width and --style are about the figures that --figures names")
    return rest[0], options


def main(arguments):
    if arguments in (["-h"], ["--help"]):
        print(__doc__.strip())
        return 0
    try:
        folder, options = parsed(arguments)
        print(paper(folder, options) if options else report(folder), file=sys.stderr)
    except (InputError, OSError) as error:
        print(f"report.py: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"report.py: {error.name} is missing; on Debian, install python3-matplotlib", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
