"""Figures and tables for papers: `report.py DIRECTORY --figures pdf,svg,pgf --width 85mm`.

Writes, into figures/paper/, every figure of a case that is made for print, without a title and with text as text; beside
each a caption in a text file; for each case its verdict as a LaTeX table (booktabs); and the works that the experiment names as
BibTeX. What matplotlib draws with can be changed in a style file of matplotlib's (`--style FILE`), whose keys take the place
of those in paper.mplstyle beside this script.
"""
import matplotlib

from bibliography import bibtex
from command import write
from drawn import drawn
from figures import PROLOGUE, slug
from first_screen import holds
from verdict_latex import latex_table
from wording import plain_text

def papers(experiment, verdicts, wanted):
    """Write everything that an experiment has for papers."""
    target = experiment.folder / "figures" / "paper"
    with settings(wanted, target):
        for verdict in verdicts:
            for drawing in drawn(verdict):
                if drawing.printed:
                    told = caption(experiment.head, drawing, plain_text(holds(verdict)), experiment.machine)
                    figure(drawing, wanted, target, told)
            write(target / f"verdict_{slug(verdict.case)}.tex", latex_table(verdict))
    write(target / "references.bib", bibtex(experiment.head))


def settings(wanted, target):
    """The style as a context, in which figures for papers are drawn into the directory, which is made."""
    target.mkdir(parents=True, exist_ok=True)
    # LaTeX, and many a font that a style may name, has no characters for exponents.
    formulas = {"axes.formatter.use_mathtext": True}
    return matplotlib.rc_context(formulas | wanted.style)


def figure(drawing, wanted, target, told):
    """One figure in every kind that is wanted, and its caption."""
    for kind in wanted.kinds:
        # LaTeX sets the text of a pgf figure in the fonts of the document, which it calls by family.
        with matplotlib.rc_context({"font.family": "sans-serif"} if kind == "pgf" else {}):
            canvas = drawing.draw(wanted.width)
            canvas.printed = True
            write(target / f"{drawing.name}.{kind}", as_file(canvas, drawing.name, kind))
    write(target / f"{drawing.name}.txt", told)


def as_file(canvas, name, kind):
    if kind == "svg":
        return PROLOGUE + canvas.svg(name, coloured=True)
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
