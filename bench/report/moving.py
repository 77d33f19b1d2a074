"""The motion of a case, as far as its system says what can be seen of it (recording.py): frames and an animation of points
of the cheapest method; otherwise, or in the plane of the two coordinates that `motion` of the case names, every step early and late
(stretches.py), and a section where there is one. Where no run was measured so, as in ensembles, there are portraits of what series
hold, and behind them in grey the most accurate one, where its error is not seen.
"""
import math

import stretches
from experiment import step_key
from figures import Drawing, heading, sentences, step_text
from frames import Animation, Figure, duration, strip
from portraits import panels, remarks
from recording import read_recording
from wording import listed

PANELS = 6
UNSEEN = 1e-3  # of the size of a motion, an error that nobody sees in a figure


def drawings(verdict):
    names = verdict.case.get("motion")
    shown = recorded(verdict, bool(names))
    if shown and shown[0][1].points() and not names:
        return of_points(verdict.case, *shown[0])
    found, out = stretches.followed(verdict), []
    rows = stretches.rows_of(found, chosen(verdict))
    if rows:
        title, unit = f"{heading(verdict.case)}: the motion, early and late", verdict.case.get("time_unit") or ""
        out.append(Drawing("motion", verdict.case, title, stretches.told(verdict, found, rows),
                           lambda wide: described(stretches.draw(found, rows, wide, unit), title), "Early and late"))
    names = (names or shown[0][1].plane()) if shown else None
    if not names:
        return out
    return (out or portraits(verdict, shown, names)) + sections(verdict, shown)


def chosen(verdict):
    """Rows of the verdict in its order: of the methods that get colour first, and of those that are most wrong at the step that most
    share. Methods with steps of their own choice come last."""
    runs = {r.method: r for r in verdict.experiment.at_common_step(verdict.case)}
    wrong = sorted((r for r in verdict.rows if r.label in runs), key=lambda r: -error_of(runs[r.label]))
    labels = list(dict.fromkeys(verdict.named(3) + [r.label for r in wrong]))[:PANELS]
    return sorted((r for r in verdict.rows if r.label in labels), key=lambda r: r.curve.adaptive)


def recorded(verdict, every=False):
    """[(row, recording)] of the chosen methods, at the step that most share; of points one method, unless `every` is asked for."""
    experiment, out = verdict.experiment, []
    runs = {r.method: r for r in experiment.at_common_step(verdict.case)}
    for row in chosen(verdict):
        run = runs.get(row.label)
        folder = experiment.folder / run.path if run and run.slug else None
        if folder and (folder / "series.csv").exists() and (folder / "summary.json").exists():
            recording = read_recording(folder)
            if len(recording.times) > 2:
                out.append((row, recording))
                if recording.points() and not every:
                    break  # one method is shown
    return out


def error_of(run):
    """The largest error of the state, infinite where the run ended early, zero where none was measured."""
    error = run.number("error_max")
    return math.inf if run.failed else 0.0 if math.isnan(error) else error


def at_which(case, recording):
    tolerance = recording.summary.get("tolerance")
    return f"tolerance {tolerance}" if tolerance else step_text(abs(float(recording.summary.get("step") or "nan")), case)


def of_points(case, row, recording):
    figure = Figure(recording)
    if len(figure.times) < 2:
        return []
    family, unit = row.curve.family, case.get("time_unit") or ""
    told = sentences(
        f"{row.label}, {at_which(case, recording)}, from the start.",
        "Lines join points that a constraint holds apart." if figure.links else "",
        "Grey is the way of the last point.", "Seen obliquely: y points backwards." if figure.depth else "")
    seconds, pace = duration(figure, unit)
    title = f"{heading(case)}: the motion"
    said = f"{heading(case)}, {row.label}, {pace}"
    return [Drawing("motion", case, title, told, lambda wide: described(strip(figure, family.light, unit, wide), said)),
            Drawing("animation", case, said, f"{row.label}, {pace}; a click stops it.",
                    lambda _: Animation(figure, family.light, family.key, said, seconds))]


def common(verdict, shown):
    """A sentence on the step of the runs that are shown."""
    common_step = verdict.experiment.common_step(verdict.case)
    if {step_key(float(r.summary["step"])) for _, r in shown if r.summary.get("step")} != {step_key(common_step)}:
        return "Runs at the step that most methods share or the nearest to it."
    at_it = [r for r in verdict.experiment.runs_of(verdict.case) if step_key(r.step) == step_key(common_step)]
    most = 2 * sum(not r.failed for r in at_it) > len(verdict.experiment.labels)
    return (f"Runs at {step_text(common_step, verdict.case)}"
            + (", the largest step at which most methods finish, where they differ most." if most else "."))


def portraits(verdict, shown, names):
    case, first = verdict.case, shown[0][1]
    tracks = [(row.label, row.curve.family.light, *recording.track(names)) for row, recording in shown]
    tracks = [t for t in tracks if len(t[2]) > 1]
    if not tracks:
        return []
    units = [first.units[name] for name in names]
    exact, whose = as_exact(verdict, names)
    seed = "Shown is the first seed." if case.get("seeds") else ""
    failed = [row.label for row, recording in shown if (recording.summary.get("status") or "converged") != "converged"]
    early = f"Ended early: {listed(failed)}." if failed else ""
    title = f"{heading(case)}: {names[1]} against {names[0]}"
    behind = [exact] * len(tracks) if exact else None
    told = sentences(common(verdict, shown), whose, remarks(tracks, units, behind), seed, early)
    return [Drawing("motion", case, title, told, lambda wide: described(panels(tracks, names, units, wide, behind), title), "Portrait")]


def sections(verdict, shown):
    case, first = verdict.case, shown[0][1]
    cuts = [(row.label, row.curve.family.light, *zip(*cut)) for row, recording in shown if (cut := recording.section())]
    if 2 * len(cuts) <= len(shown):
        return []
    q1, q2, _, p2 = first.state
    axes, scales = (q2, p2), (first.units[q2], first.units[p2])
    named = f"{heading(case)}: section at {q1} = 0, passed upwards"
    told = sentences(f"Each point is a passage of {q1} = 0 upwards. A smooth curve is regular motion, a cloud is chaos, or a method that "
                     "lets the energy drift.", common(verdict, shown))
    return [Drawing("section", case, named, told, lambda wide: described(panels(cuts, axes, scales, wide, start=False), named), "Section")]


def as_exact(verdict, names):
    """(the track of the most accurate of all runs, a sentence on it), where its error is too small to be seen; otherwise (None, "")."""
    known = [p for c in verdict.curves for p in c.points if verdict.of_state and p.error < UNSEEN and not p.run.seed
             and p.run.slug and (verdict.experiment.folder / p.run.path / "series.csv").exists()]
    if not known:
        return None, ""
    best = min(known, key=lambda p: p.error)
    recording = read_recording(verdict.experiment.folder / best.run.path)
    return recording.track(names), (f"Behind, in grey, for the exact motion that of {best.run.method} at "
                                    f"{at_which(verdict.case, recording)}, whose error is at most {best.error:.0e}.")


def described(canvas, said):
    canvas.description = said
    return canvas
