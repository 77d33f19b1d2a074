"""Figures and tables for papers: `report.py DIRECTORY --figures pdf,svg,pgf --width 85mm`.

Writes, into figures/paper/, every figure of a case that is made for print, without a title and with text as text; beside
each a caption in a text file; for each case its verdict as a LaTeX table (booktabs); and the works that the experiment names as
BibTeX. What matplotlib draws with can be
changed in a style file of matplotlib's (`--style FILE`), beginning with paper.mplstyle beside this script.
"""
import pathlib
import re
import shutil

import matplotlib

from bibliography import bibtex
from drawn import drawn
from figures import slug
from files import InputError
from first_screen import holds
from verdict_latex import latex_table
from wording import plain_text

KINDS = ("pdf", "svg", "pgf", "png")
POINTS = {"mm": 72 / 25.4, "cm": 72 / 2.54, "in": 72.0, "pt": 72 / 72.27}
STYLE = pathlib.Path(__file__).parent / "paper.mplstyle"


def kinds_of(text):
    kinds = [k for k in text.split(",") if k]
    for kind in kinds:
        if kind not in KINDS:
            raise InputError(f"--figures: expected some of {', '.join(KINDS)}, got '{kind}'")
    if not kinds:
        raise InputError(f"--figures: expected some of {', '.join(KINDS)}")
    return kinds


def width_of(text):
    """A width like 85mm, in points of PostScript."""
    found = re.fullmatch(r"([0-9]+(?:\.[0-9]+)?)(mm|cm|in|pt)", text)
    width = float(found[1]) * POINTS[found[2]] if found else 0
    if not 140 <= width <= 1000:
        raise InputError(f"--width: expected a width between 50mm and 350mm like 85mm, got '{text}'")
    return width


def papers(experiment, verdicts, kinds, width, style, write):
    """Write everything; returns the directory."""
    target = experiment.folder / "figures" / "paper"
    with settings(kinds, style, target):
        for verdict in verdicts:
            for drawing in drawn(verdict):
                if not drawing.paper:
                    continue
                figure(drawing, kinds, width, target, write)
                write(target / f"{drawing.name}.txt", caption(experiment.head, drawing, plain_text(holds(verdict)), experiment.machine))
            write(target / f"verdict_{slug(verdict.case)}.tex", latex_table(verdict))
    write(target / "references.bib", bibtex(experiment.head))
    return target


def settings(kinds, style, target):
    """The style as a context, in which figures for papers are drawn into the directory, which is made."""
    if "pgf" in kinds and not any(shutil.which(tex) for tex in ("xelatex", "pdflatex", "lualatex")):
        raise InputError("--figures: pgf needs LaTeX, with which it measures text, and none is installed")
    target.mkdir(parents=True, exist_ok=True)
    # LaTeX, and many a font that a style may name, has no characters for exponents.
    formulas = {"axes.formatter.use_mathtext": True}
    return matplotlib.rc_context(formulas | matplotlib.rc_params_from_file(str(style or STYLE), use_default_template=False))


def figure(drawing, kinds, width, target, write):
    for kind in kinds:
        # LaTeX sets the text of a pgf figure in the fonts of the document, which it calls by family.
        with matplotlib.rc_context({"font.family": "sans-serif"} if kind == "pgf" else {}):
            canvas = drawing.paper(width)
            canvas.printed = True
            write(target / f"{drawing.name}.{kind}", as_file(canvas, drawing.name, kind))


def as_file(canvas, name, kind):
    if kind == "svg":
        return '<?xml version="1.0" encoding="utf-8"?>\n' + canvas.svg(name, coloured=True)
    return canvas.save(kind)


def caption(head, drawing, held, machine):
    """What the figure shows, for what it holds, and by which program and command it is made again."""
    versions = head.get("versions") or {}
    built = ", ".join(str(versions[k]).strip() for k in ("compiler", "flags") if versions.get(k))
    again = f"pfaff compare {head['name']}" + (" --quick" if head.get("quick") else "")
    measured = ", ".join(machine[k] for k in ("cpu", "system", "date") if machine.get(k))
    return "\n".join([f"{drawing.title}. {drawing.caption}", held,
                      f"Pfaff {versions.get('pfaff', '')}".rstrip() + (f", {built}" if built else "") + f"; {again}"
                      + (f". Timed on {measured}" if measured else ""), ""])
