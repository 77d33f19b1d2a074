#!/usr/bin/env python3
"""What figures for papers are asked for:  python3 wanted.py --figures pdf,svg,pgf,png [--width 85mm] [--style FILE]

Refuses what cannot be made, so that the program asks here before it begins to work. Exit status: 0 fine, 2 wrong usage, with one
line on stderr.
"""
import dataclasses
import difflib
import logging
import os
import pathlib
import re
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # which python3 -I leaves out

from command import FIGURES, ended, parsed
from files import InputError

KINDS = ("pdf", "svg", "pgf", "png")
POINTS = {"mm": 72 / 25.4, "cm": 72 / 2.54, "in": 72.0, "pt": 72 / 72.27}
STYLE = pathlib.Path(__file__).parent / "paper.mplstyle"


@dataclasses.dataclass
class Wanted:
    """What figures are asked for, and what of it cannot be made, in words."""
    kinds: list
    width: float  # in points of PostScript
    style: dict  # matplotlib's parameters
    left_out: str = ""


def wanted(options):
    """What the options ask for. What needs a program that is not there is left out, unless nothing else is asked for."""
    kinds, left_out = kinds_of(options["--figures"]), ""
    if "pgf" in kinds and not any(shutil.which(tex) for tex in ("xelatex", "pdflatex", "lualatex")):
        why = "pgf needs LaTeX, with which it measures text, and none is installed"
        if kinds == ["pgf"]:
            raise InputError(f"--figures: {why}")
        kinds, left_out = [k for k in kinds if k != "pgf"], f"figures of the kind pgf were left out, because {why}"
    return Wanted(kinds, width_of(options.get("--width", "85mm")), style_of(options.get("--style")), left_out)


def kinds_of(text):
    kinds = list(dict.fromkeys(k for k in text.split(",") if k))
    for kind in kinds:
        if kind not in KINDS:
            near = difflib.get_close_matches(kind, KINDS, 1)
            raise InputError(f"--figures: expected some of {', '.join(KINDS)}, got '{kind}'"
                             + (f"; did you mean '{near[0]}'?" if near else ""))
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


def style_of(path):
    """The parameters of Pfaff's own style with those of the file, where one is given, in their place."""
    import matplotlib  # here, where what is missing is said

    complaints = []
    heard = logging.Handler(logging.WARNING)
    heard.emit = lambda record: complaints.append(record.getMessage())
    logger = logging.getLogger("matplotlib")
    logger.addHandler(heard)
    logger.propagate = False
    try:
        own, given = (matplotlib.rc_params_from_file(file, use_default_template=False) for file in (STYLE, path or STYLE))
    except UnicodeDecodeError:
        raise InputError(f"--style {path}: expected text in UTF-8") from None
    finally:
        logger.removeHandler(heard)
        logger.propagate = True
    if complaints:
        key = re.match(r"\s*Bad key '?\"?([^\s'\"]+)", complaints[0])
        near = difflib.get_close_matches(key[1], matplotlib.rcParams, 1) if key else []
        raise InputError(f"--style {path}: " + (f"matplotlib has no key '{key[1]}'" if key else " ".join(complaints[0].split()))
                         + (f"; did you mean '{near[0]}'?" if near else ""))
    return dict(own) | dict(given)


def work(arguments):
    return {"left_out": wanted(parsed(arguments, None, FIGURES)[1]).left_out}


def main(arguments):
    return ended("wanted.py", __doc__, work, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
