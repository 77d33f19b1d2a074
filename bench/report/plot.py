#!/usr/bin/env python3
"""Pictures of one run:  python3 plot.py RUN_DIR [--coordinates q1,q2] [--figures pdf,svg,pgf,png [--width 85mm] [--style FILE]]

Reads summary.json and series.csv, as `pfaff run` leaves them, or an experiment for each of its runs. Writes plot/ into the
directory: the motion, its animation or section where there is one, and the quantities of the run against time, as SVG and PNG,
and plot.html, a self-contained page of them all that begins with a sentence. With --coordinates the motion is drawn in their plane;
with --figures the figures are made for papers too, in plot/paper/. Exit status: 0 fine, 2 wrong usage or input, with one line on
stderr.
"""
import difflib
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))  # which python3 -I leaves out

from command import FIGURES, ended, parsed, write
from files import InputError
from wanted import wanted as wanted_of


def coordinates_of(text, recording):
    """The names of two coordinates; None where none are asked for."""
    if text is None:
        return None
    names = text.split(",")
    if len(names) != 2:
        raise InputError(f"--coordinates: expected two names with a comma between them, got '{text}'")
    for name in names:
        if name not in recording.state:
            small = {n.lower(): n for n in recording.state}
            near = difflib.get_close_matches(name.lower(), small, 1)
            expected = f"did you mean '{small[near[0]]}'?" if near else f"expected two of {', '.join(recording.state)}"
            raise InputError(f"--coordinates: {recording.system} has no coordinate '{name}'; {expected}")
    return names


def plot(arguments):
    folder, options = parsed(arguments, "the directory of a run", ("--coordinates", *FIGURES))
    from recording import read_recording
    folder = pathlib.Path(folder)
    if not (folder / "summary.json").exists() or not (folder / "series.csv").exists():
        raise InputError(f"{folder}: expected the directory of a run, with summary.json and series.csv")
    recording = read_recording(folder)
    if len(recording.times) < 2:
        raise InputError(f"{folder}: expected a run of two samples or more, got {len(recording.times)}")
    wanted = wanted_of(options) if "--figures" in options else None
    coordinates = coordinates_of(options.get("--coordinates"), recording)
    import page  # importing matplotlib takes a second
    import papers
    import run_figures
    from figures import saved
    drawings = run_figures.drawings(recording, coordinates)
    title, about, said = (make(recording) for make in (run_figures.title, run_figures.about, run_figures.sentence))
    body = [f'<header><p class="kicker">Pfaff run</p><h1>{page.text(title)}</h1><p class="find">{page.text(said)}</p>'
            f'<p class="where">{page.text(about)}</p></header><main>']
    for drawing, wide, narrow in saved(drawings, folder / "plot"):
        body.append(f"<h3>{page.text(drawing.title)}</h3>")
        body.append(f"<figure>{wide}<figcaption>{page.text(drawing.caption)}</figcaption></figure>"
                    if drawing.kind == "animation" else page.figure([(drawing, wide, narrow)], drawing.kind))
    write(folder / "plot" / "plot.html", page.document(title, said, [*body, "</main>"]))
    if wanted:
        with papers.settings(wanted, folder / "plot" / "paper"):
            for drawing in drawings:
                if drawing.printed:
                    papers.figure(drawing, wanted, folder / "plot" / "paper", f"{drawing.title}. {drawing.caption}\n{said}\n")
    return {"sentence": said, "left_out": wanted.left_out if wanted else ""}


def main(arguments):
    return ended("plot.py", __doc__, plot, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
