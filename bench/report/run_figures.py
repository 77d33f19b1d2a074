"""The figures of one run: its motion, and against time the coordinates and everything that was measured.

Of a conserved quantity I its change |I(t) - I(0)| is drawn, of other quantities the value; residuals of constraints, errors
and the structure residual as they are.
"""
import math

from canvas import INK, MID, Canvas, plain, sizes
from experiment import DIRECTIONS, UNIT_ROUND_OFF
from families import FAMILIES, family_named
from figures import Drawing, sentences, with_unit
from frames import Animation, Figure, duration, strip
from labels import pushed_apart
from portraits import panels, remarks
from scales import ErrorAxis, envelope, remarks_of, time_axis
from series import read_series, run_times
from wording import counted

COORDINATES = 6  # of systems with more coordinates the coordinates are not drawn against time


def title(recording):
    return ", ".join(x for x in (recording.system, recording.method, recording.summary.get("formulation") or "") if x)


def about(recording):
    summary, unit = recording.summary, "" if recording.time_unit == "1" else f" {recording.time_unit}"
    size = (f"tolerance {summary['tolerance']}" if summary.get("tolerance") else
            f"step {float(summary['step']):.6g}{unit}" if summary.get("step") else "")
    parameters = ", ".join(f"{k.partition('.')[2] or k} = {v}" for k, v in (summary.get("parameters") or {}).items())
    status = summary.get("status") or ""
    ended = f"ended early: {summary.get('message') or status}" if status not in ("", "converged") else ""
    return "; ".join(x for x in (size, f"to t = {recording.times[-1]:.6g}{unit}", f"{summary.get('precision') or ''} precision",
                                 parameters, ended) if x.strip()) + "."


def sentence(recording):
    """What the figures show, of what the record of the run holds alone."""
    summary, unit = recording.summary, "" if recording.time_unit == "1" else f" {recording.time_unit}"
    said = [f"{title(recording)}: {counted(summary.get('completed') or len(recording.times) - 1, 'step')} to t = "
            f"{recording.times[-1]:.6g}{unit}"]
    if (status := summary.get("status") or "converged") != "converged":
        said[0] += f", where it ended early ({summary.get('message') or status})"
    for entry in summary.get("invariants") or []:
        name, most, unit = entry["name"], entry.get("max"), entry.get("unit")
        if entry.get("expected") in DIRECTIONS:
            verb, move = DIRECTIONS[entry["expected"]]
            against, last = entry.get(f"largest_{move}"), recording.columns[name][-1]
            said.append(f"{name}, which is expected to {verb}, goes from {float(entry['initial']):.4g} to {with_unit_after(last, 4, unit)}"
                        + ("" if against is None else f" and never {move}s" if against == 0 else
                           f" and {move}s by at most {with_unit_after(against, 2, unit)}"))
        elif entry.get("expected") == "conserved" and most is not None and math.isfinite(most):
            scale = entry.get("scale")
            relative = f", which is {most / scale:.2g} of its scale" if scale and most > 0 else ""
            said.append(f"{name} moves from the start by at most {with_unit_after(most, 2, unit)}{relative} "
                        f"({entry.get('class') or 'without a class'})")
    said += [f"the residual of the {entry['name']} is at most {entry['max']:.2g}" for entry in summary.get("constraints") or []
             if entry.get("max") is not None]
    if summary.get("error_max") is not None:
        said.append(f"the relative error of the state is at most {summary['error_max']:.2g}{at_rows(summary.get('error_rows'))}")
    if (ended := summary.get("reference_ended")):
        said.append(f"{'errors end early' if summary.get('error_max') is not None else 'there are no errors'}: {ended}")
    return "; ".join(said) + "."


def with_unit_after(number, digits, unit):
    return f"{number:.{digits}g}" + ("" if not unit or unit == "1" else f" {unit}")


def drawings(recording, coordinates=None):
    """[Drawing]; the motion in the plane of two coordinates where these are named."""
    return [*(plane(recording, coordinates) if coordinates else motion(recording)), *quantities(recording)]


def drawing(kind, what, caption, draw):
    return Drawing(kind, {}, what, caption, draw, printed=True)


def plane(recording, names):
    """The track in the plane of two coordinates."""
    colour, units = family_named(recording.summary.get("family")).light, [recording.units[n] for n in names]
    tracks = [(recording.method, colour, *recording.track(names))]
    return [drawing("motion", f"{names[1]} against {names[0]}", remarks(tracks, units),
                    lambda wide: panels(tracks, names, units, wide))]


def motion(recording):
    family, unit = family_named(recording.summary.get("family")), recording.time_unit
    if recording.points():
        figure = Figure(recording)
        if len(figure.times) < 2:
            return []
        seconds, pace = duration(figure, unit)
        return [drawing("motion", "The motion", sentences(
            "Lines join points that a constraint holds apart." if figure.links else "", "Grey is the way of the last point.",
            "Seen obliquely: y points backwards." if figure.depth else ""),
            lambda wide: strip(figure, family.light, unit, wide)),
            Drawing("animation", {}, "Animation", f"{pace[0].upper()}{pace[1:]}; a click stops it.",
                    lambda _: Animation(figure, family.light, family.key, title(recording), seconds))]
    names = recording.plane()
    if names is None:
        return []
    out = plane(recording, names)
    cut = recording.section()
    if cut:
        q1, q2, _, p2 = recording.state
        cuts, scales = [(recording.method, family.light, *zip(*cut))], (recording.units[q2], recording.units[p2])
        out.append(drawing("section", f"Section at {q1} = 0", f"Each point is one of {len(cut)} passages of {q1} = 0 upwards.",
                           lambda wide: panels(cuts, (q2, p2), scales, wide, start=False)))
    return out


def quantities(recording):
    """One drawing of small panels, each with its lines [(label, times, values)] and whether its axis is logarithmic."""
    shown, precision, times = [], recording.summary.get("precision") or "double", run_times(recording.times)
    if not recording.points() and len(recording.state) <= COORDINATES:
        for unit in dict.fromkeys(recording.units[n] for n in recording.state):
            names = [n for n in recording.state if recording.units[n] == unit]
            alone = len(names) == 1  # it is named above the panel
            lines = [("" if alone else n, times, recording.columns[n]) for n in names]
            shown.append((with_unit(names[0] if alone else "coordinates", unit), lines, False))
    for entry in recording.summary.get("invariants") or []:
        name, unit = entry["name"], entry.get("unit") or ""
        if entry.get("expected") == "conserved":
            series = read_series(recording.folder / "series.csv", name, precision)
            what = f"{name}: |I(t) − I(0)|" + (f", {entry['class']}" if entry.get("class") else "")
            shown.append((with_unit(what, unit), [("", *envelope(series.time, [abs(x) for x in series.change]))], True))
        else:
            expected = entry.get("expected")
            told = f", expected to {DIRECTIONS[expected][0]}" if expected in DIRECTIONS else ""
            shown.append((with_unit(name + told, unit), [("", times, recording.columns[name])], False))
    measured = [e["name"] for e in recording.summary.get("constraints") or []] + ["error", "structure_residual"]
    measured += [name for name in recording.columns if name.endswith(":error")]
    for name in measured:
        if any(not math.isnan(v) for v in recording.columns.get(name, ())):
            what = name.replace("_", " ").replace("hidden-", "hidden ").replace(":error", ": error")
            shown.append((what, [("", *envelope(times, [abs(v) for v in recording.columns[name]], linear=True))],
                          True))
    shown = [(what, lines, log) for what, lines, log in shown if any(t for _, t, _ in lines)]
    if not shown:
        return []
    unit = UNIT_ROUND_OFF.get(precision, UNIT_ROUND_OFF["double"])
    colour = family_named(recording.summary.get("family")).light
    label = "t" if times is recording.times else "time since the start"
    axes = [ErrorAxis([v for *_, v in lines], unit) for _, lines, log in shown if log]
    return [drawing("quantities", "Against time", sentences(
        "Grey: unit round-off." if any(one.seen for one in axes) else "",
        "Lines join the largest values in short stretches of time." if any(log for *_, log in shown) else "",
        f"Errors are measured{at}." if (at := at_rows(recording.summary.get("error_rows"))) else "", *remarks_of(axes)),
        lambda wide: small_panels(shown, with_unit(label, recording.time_unit), unit, colour, wide))]


def at_rows(rows):
    """At how many rows errors are measured, as the summary has it; empty where these are all."""
    return f" at {rows['measured']} of {rows['of']} rows" if rows else ""


def small_panels(shown, time_label, unit, colour, wide):
    look = sizes(wide)
    font, columns = look.font, min(len(shown), 3 if look.wide else 1)
    left, top, right, below, tall, most = (x * look.unit for x in (66, 26, 12, 46, 190, 420))
    measure = Canvas(look.width, look.width, font, look.unit).measure
    right = max([right, *(measure(label, 0.92)[0] + 10 * look.unit for _, lines, _ in shown for label, *_ in lines if label)])
    between = left + right - 10 * look.unit
    each = min(most, (look.width - left - right - between * (columns - 1)) / columns)
    rows = math.ceil(len(shown) / columns)
    canvas = Canvas(left + columns * each + between * (columns - 1) + right, rows * (top + tall + below), font, look.unit)
    for k, (what, lines, log) in enumerate(shown):
        row, column = divmod(k, columns)
        axes = canvas.panel(left + column * (each + between), top + row * (top + tall + below), each, tall)
        axes.set_title(plain(what), fontsize=font, color=INK, loc="left", pad=5 * look.unit)
        axis = ErrorAxis([v for *_, v in lines], unit) if log else None
        ends = []
        for n, (label, times, values) in enumerate(lines):
            colour_of = colour if len(lines) == 1 else FAMILIES[n % len(FAMILIES)].light
            placed = axis.place(values) if axis else values
            canvas.line(axes, times, placed, label or what, color=colour_of, linewidth=1.3)
            ends.append((label, placed[-1], colour_of))
        if axis:
            axes.axhline(unit, color=MID, linewidth=0.8 * look.unit, linestyle=(0, (4, 2)))
            axis.apply(axes)
        time_axis(axes, min(t[0] for _, t, _ in lines) if log else 0, max(t[-1] for _, t, _ in lines))
        canvas.labels(axes, time_label, "")
        box = axes.get_window_extent(canvas.renderer)
        named = [e for e in ends if e[0] and math.isfinite(e[1])]
        heights = [axes.transData.transform((1, y))[1] - font / 2 for _, y, _ in named]
        for (label, _, shade), y in zip(named, pushed_apart(heights, 1.1 * font, box.y0, box.y1)):
            canvas.write(axes, box.x1 + 5, y, label, 0.92, color=shade, ha="left", va="bottom")
    return canvas
