"""Drift at equal cost: small multiples by family on shared axes.

Each method is drawn in its run at the level of the verdict, or the nearest to it. A curve joins the largest deviations in short
stretches of time; those of other families stand behind in the lightest grey. Dashed: a fitted trend, |slope| t, of methods
whose class of drift is sized by a slope. Dotted: 2 u sqrt(n) after n steps, what round-off alone adds up to.

Of a quantity that is expected to decrease or to increase the error is drawn: its difference from that of the reference
solution.
"""
import dataclasses
import math
import statistics

from assertion import said
from canvas import MID, RULE, Canvas
from curves import ranks
from experiment import DIRECTIONS, UNIT_ROUND_OFF
from families import FAMILIES, style
from first_screen import finding
from figures import Drawing, heading, sentences, step_text, with_unit
from labels import pushed_apart
from scales import ErrorAxis, envelope, logarithmic, time_axis
from sentence import drift
from wording import plain_text


@dataclasses.dataclass
class Panels:
    """Sizes in pixels: margins around and between panels, and how many stand side by side."""
    width: float
    font: float
    left: float
    top: float
    between: float
    below: float
    tall: float
    columns: int
    title: float = 1.0  # size of the families' names
    scale: float = 1.0  # of lines


WIDE = Panels(1120, 12.5, 72, 24, 16, 46, 230, 4)
NARROW = Panels(368, 11, 60, 22, 8, 44, 170, 2, 0.88)


def paper(width):
    return Panels(width, 7, 42, 15, 6, 26, 100, 2 if width < 350 else 4, 0.88, 0.6)


def drawings(verdict):
    if verdict.case.get("seeds") or not verdict.invariant:
        return []
    found, told = deviations(verdict)
    return [drawing(verdict, found, told)] if any(times for _, times, _ in found) else []


def deviations(verdict):
    """([(row, times, deviations over max(1, |I(0)|))], what they are deviations from)."""
    of_error = verdict.expected in DIRECTIONS
    found = []
    for row in verdict.rows:
        series = verdict.experiment.series(row.run, verdict.invariant) if row.run else None
        values = (series.error if of_error else series.change) if series else []
        if any(not math.isnan(x) for x in values):
            found.append((row, *envelope(series.time, [abs(x) / series.scale for x in values])))
    return found, (f"Error of {verdict.invariant} against the reference solution."
                   if of_error else f"Deviation of {verdict.invariant} from its value at the start.")


def drawing(verdict, found, told):
    case = verdict.case
    u = UNIT_ROUND_OFF[case["precision"]]
    axis = ErrorAxis([v for *_, v in found], u)
    level = verdict.which_runs()
    what = "" if verdict.expected in DIRECTIONS else (
        "Flat is bounded, slope ½ on logarithmic axes is the growth of round-off, slope 1 a loss in proportion to time. Dashed: "
        "the fitted trend; dotted: 2u√n, what n steps of round-off add up to.")
    caption = sentences(told, level, what, "A curve joins the largest values in short stretches of time.", *axis.remarks())
    return Drawing("drift", case, f"{heading(case)}: drift at equal cost", caption,
                   lambda wide: draw(verdict, found, axis, WIDE if wide else NARROW), "",
                   lambda width: draw(verdict, found, axis, paper(width)))


def draw(verdict, found, axis, look):
    families = [f for f in FAMILIES if any(row.curve.family is f for row, *_ in found)]
    columns = min(len(families), look.columns)
    rows = math.ceil(len(families) / columns)
    panel = min(520, (look.width - look.left - 6 - look.between * (columns - 1)) / columns)
    canvas = Canvas(look.width, rows * (look.top + look.tall) + look.below, look.font, look.scale)
    canvas.description = plain_text(said(drift(verdict)) or finding(verdict))
    times = [t for _, ts, _ in found for t in ts]
    begin, end = min(times), max(times)
    rank = ranks(verdict.curves)
    for k, family in enumerate(families):
        row, col = divmod(k, columns)
        axes = canvas.panel(look.left + col * (panel + look.between), look.top + row * (look.top + look.tall), panel,
                            look.tall)
        for other, ts, values in found:
            if other.curve.family is not family:
                axes.plot(ts, axis.place(values), color=RULE, linewidth=0.8 * look.scale, zorder=1)
        own = [(r, ts, values) for r, ts, values in found if r.curve.family is family and ts]
        for r, ts, values in own:
            shown = style(family, rank[r.label], r.curve.fill) | {"linewidth": 1.5, "marker": ""}
            told = f"{r.label}, {step_text(r.run.step, verdict.case)}: {r.drift_class} {r.drift:.1e}"
            canvas.line(axes, ts, axis.place(values), told, **shown, zorder=3)
            trend(axes, verdict, r, begin, end, family)
        round_off(axes, verdict, [r for r, *_ in own], begin, end)
        time_axis(axes, begin if logarithmic(begin, end) else 0, end)
        axis.apply(axes)
        axes.tick_params(axis="x", labelbottom=k >= len(families) - columns)
        axes.tick_params(axis="y", labelleft=col == 0, length=3 * look.scale if col == 0 else 0)
        axes.set_title(family.plural[:1].upper() + family.plural[1:], loc="left", fontsize=look.font * look.title,
                       color=family.light, weight="bold", pad=5)
        unit = verdict.case.get("time_unit") or ""
        canvas.labels(axes, with_unit("t", unit) if k >= len(families) - columns else "",
                      (f"error of {verdict.invariant}" if verdict.expected in DIRECTIONS else
                       f"deviation of {verdict.invariant}") if col == 0 else "")
        end_labels(canvas, axes, [(r.label, axis.place(values)[-1], family.light) for r, ts, values in own])
    return canvas


def trend(axes, verdict, row, begin, end, family):
    """The line |slope| t, where the class is sized by a slope."""
    classes = verdict.experiment.drift_classes
    if verdict.expected in DIRECTIONS or not row.drift_class or classes[row.drift_class].measure != "slope":
        return
    series = verdict.experiment.series(row.run, verdict.invariant)
    slope = abs(row.run.drift(verdict.invariant, "slope")) / series.scale
    if slope > 0:
        ts = [begin * (end / begin) ** (k / 40) for k in range(41)]
        axes.plot(ts, [slope * t for t in ts], color=family.light, linewidth=0.6, linestyle=(0, (4, 3)), zorder=2)


def round_off(axes, verdict, rows, begin, end):
    if verdict.expected in DIRECTIONS or not rows:
        return
    u, step = UNIT_ROUND_OFF[verdict.case["precision"]], statistics.median(r.run.step for r in rows)
    ts = [begin * (end / begin) ** (k / 40) for k in range(41)]
    axes.plot(ts, [2 * u * math.sqrt(max(1.0, t / step)) for t in ts], color=MID, linewidth=0.7, linestyle=(0, (1, 2)), zorder=2)


def end_labels(canvas, axes, ends):
    """Labels above the right ends of lines, inside the panel, pushed apart."""
    size = 0.86
    box = axes.get_window_extent(canvas.renderer)
    tall = canvas.measure("Xg", size)[1] + 1
    ends = [(label, y, colour) for label, y, colour in ends if y > 0]
    wanted = [axes.transData.transform((axes.get_xlim()[1], y))[1] + 3 for _, y, _ in ends]
    for (label, _, colour), y in zip(ends, pushed_apart(wanted, tall, box.y0 + 2, box.y1 - tall)):
        canvas.write(axes, box.x1 - 4, y, label, size, color=colour, ha="right", va="bottom", zorder=6)
