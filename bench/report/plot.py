#!/usr/bin/env python3
"""Pictures of one run:  python3 plot.py RUN_DIR

Reads summary.json and series.csv, as `pfaff run` leaves them, or an experiment for each of its runs. Writes plot/ into the
directory: the motion, its animation or section where there is one, and the quantities of the run against time, as SVG and PNG,
and plot.html, a self-contained page of them all. Exit status: 0 fine, 2 wrong usage or input, with one line on stderr.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))  # which python3 -I leaves out

from files import InputError


def plot(folder):
    import page  # importing matplotlib takes a second
    import run_figures
    from recording import read_recording
    from report import write
    folder = pathlib.Path(folder)
    if not (folder / "summary.json").exists() or not (folder / "series.csv").exists():
        raise InputError(f"{folder}: expected the directory of a run, with summary.json and series.csv")
    recording = read_recording(folder)
    if len(recording.times) < 2:
        raise InputError(f"{folder}: expected a run of two samples or more, got {len(recording.times)}")
    target, shown = folder / "plot", []
    target.mkdir(exist_ok=True)
    for drawing in run_figures.drawings(recording):
        sheet = drawing.draw(True)
        alone = sheet.svg(f"{drawing.kind}-wide", coloured=True)
        write(target / f"{drawing.kind}.svg", f'<?xml version="1.0" encoding="utf-8"?>\n{alone}')
        if drawing.kind == "animation":
            shown.append((drawing, sheet.svg("moving"), ""))
            continue
        write(target / f"{drawing.kind}.png", sheet.png())
        shown.append((drawing, sheet.svg(f"{drawing.kind}-wide"), drawing.draw(False).svg(f"{drawing.kind}-narrow")))
    title = run_figures.title(recording)
    body = [f'<header><p class="kicker">Pfaff run</p><h1>{page.text(title)}</h1>'
            f'<p class="where">{page.text(run_figures.about(recording))}</p></header><main>']
    for drawing, wide, narrow in shown:
        body.append(f"<h3>{page.text(drawing.title)}</h3>")
        body.append(f"<figure>{wide}<figcaption>{page.text(drawing.caption)}</figcaption></figure>"
                    if drawing.kind == "animation" else page.figure([(drawing, wide, narrow)], drawing.kind))
    write(target / "plot.html", page.document(title, run_figures.about(recording), [*body, "</main>"]))
    return target


def main(arguments):
    if arguments in (["-h"], ["--help"]):
        print(__doc__.strip())
        return 0
    try:
        if len(arguments) != 1:
            raise InputError("expected one argument, the directory of a run")
        print(plot(arguments[0]), file=sys.stderr)
    except (InputError, OSError) as error:
        print(f"plot.py: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"plot.py: {error.name} is missing; on Debian, install python3-matplotlib", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
