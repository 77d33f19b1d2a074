"""How methods contract areas, of the systems that state by which law they do: measures/contraction.csv has the area that each method
makes of a small one, beside the law, and the outlines of a disc of states that it carries along.

The law shrinks whatever is drawn. Outlines are therefore seen through a lens: positions and momenta over the square root of
the law, so that the image of a disc keeps its area where the method keeps the law.
"""
import dataclasses
import math

from canvas import MID, Canvas, plain
from curves import ranks
from experiment import UNIT_ROUND_OFF
from families import style
from figures import Drawing, heading, limits, sentences, step_text, time_label, with_unit
from files import InputError, parse
from lines import Line, Panel, fill, name_width
from recording import read_recording
from scales import ErrorAxis, time_axis

MEASURE = "contraction"  # whose table it draws
FRAME = 1.5  # images that leave the middle method's by this many of their width leave the frame


@dataclasses.dataclass
class Carried:
    step: float
    times: list = dataclasses.field(default_factory=list)
    ratios: list = dataclasses.field(default_factory=list)  # the area over the law
    images: list = dataclasses.field(default_factory=list)  # (t, xs, ys) through the lens

    @property
    def deviations(self):
        return [abs(r - 1) for r in self.ratios]


def carried(experiment, case):
    """{method: Carried}"""
    found = {}
    for where, cells in experiment.table(MEASURE, case):
        step, t, area, law = (cells[k] for k in ("step", "t", "area", "law"))
        if not law > 0:
            raise InputError(f"{where}, column law: expected a positive number, got '{cells['law']}'")
        one = found.setdefault(cells["method"], Carried(step))
        one.times.append(t)
        one.ratios.append(area / law)
        if cells["outline"]:
            points = [[parse(x, f"{where}, column outline") for x in pair.split()] for pair in cells["outline"].split(";")]
            if any(len(point) != 2 for point in points):
                raise InputError(f"{where}, column outline: expected pairs of numbers")
            lens = math.sqrt(law)
            one.images.append((t, [q / lens for q, _ in points], [p / lens for _, p in points]))
    return found


def drawings(verdict):
    case, found = verdict.case, carried(verdict.experiment, verdict.case)
    named = verdict.named()
    shown = [(row, found[row.label]) for row in verdict.rows
             if row.label in named and row.label in found and len(found[row.label].times) > 1]
    if not shown:
        return []
    axis = ErrorAxis([one.deviations[1:] for _, one in shown], UNIT_ROUND_OFF[case["precision"]], bounded=True)
    steps = {one.step for _, one in shown}
    at = step_text(steps.pop(), case) if len(steps) == 1 else "the largest step at which each method finishes"
    title = f"{heading(case)}: contraction of areas"
    told = sentences(
        f"A disc of states around the start, carried along by each method, {at}, at six times. Positions and momenta are "
        "divided by the square root of the exact contraction, so that the images of all times have one area where a method "
        "contracts as the system does; beside the name stands the last area over the exact one.",
        "Areas are those that the tangent map of the steps makes of a small one around the start. "
        "Below, how far that ratio is from 1; dashed is unit round-off.", *axis.remarks())
    return [Drawing("contraction", case, title, told, lambda wide: draw(verdict, shown, axis, title, wide))]


def draw(verdict, shown, axis, title, wide):
    width, font = (1120, 12.5) if wide else (368, 11)
    left, top, right, below, between = (72 if wide else 56), 24, 10, 46, 14
    columns = (3 if len(shown) in (3, 5, 6) else 4) if wide else 2
    each = (width - left - right - between * (columns - 1)) / columns
    tall, low_tall = (0.62 if columns == 3 else 0.8) * each, 170
    rows = math.ceil(len(shown) / columns)
    down = rows * (top + tall) + below
    canvas = Canvas(width, down + top + low_tall + below, font)
    canvas.description = title
    names = axes_of(verdict)
    frame = limits([tuple(sum((image[k] for image in one.images), []) for k in (1, 2)) for _, one in shown], FRAME)
    for k, (row, one) in enumerate(shown):
        line, column = divmod(k, columns)
        axes = canvas.panel(left + column * (each + between), top + line * (top + tall), each, tall)
        axes.grid(False)
        colour = row.curve.family.light
        for n, (t, xs, ys) in enumerate(one.images):
            strength = 0.12 + 0.28 * n / max(1, len(one.images) - 1)
            axes.fill(xs, ys, color=colour, alpha=strength, linewidth=0, zorder=2)
            canvas.line(axes, xs + xs[:1], ys + ys[:1], f"{row.label}, t = {t:g}", color=colour, linewidth=0.9, zorder=3)
        axes.set_title(plain(f"{row.label}: {one.ratios[-1]:.3g}"), fontsize=0.95 * font, color=colour, loc="left", pad=4)
        for (low, high), place in zip(frame, (axes.set_xlim, axes.set_ylim)):
            pad = 0.06 * ((high - low) or 1)
            place(low - pad, high + pad)
        axes.locator_params(nbins=4)
        last = k + columns >= len(shown)
        canvas.labels(axes, names[0] if last else "", names[1] if column == 0 else "")
        if not last:
            axes.tick_params(labelbottom=False)
        if column:
            axes.tick_params(labelleft=False)
    deviations(canvas, verdict, shown, axis, (left, down + top, width - left, low_tall))
    return canvas


def axes_of(verdict):
    """What the axes are, with units, as a run of the case names its coordinates."""
    experiment = verdict.experiment
    left = [r for r in experiment.runs_of(verdict.case) if r.slug and (experiment.folder / r.path / "series.csv").exists()
            and (experiment.folder / r.path / "summary.json").exists()]
    recording = read_recording(experiment.folder / left[0].path) if left else None
    if recording is None or len(recording.state) != 2:
        return "position", "momentum"
    return [with_unit(name, recording.units[name]) for name in recording.state]


def deviations(canvas, verdict, shown, axis, place):
    """Of each method, how far its area over the law is from 1, with its name at the end of the line."""
    rank = ranks(verdict.curves)
    lines = [Line(row.label, one.times[1:], one.deviations[1:], style(row.curve.family, rank[row.label], row.curve.fill),
                  f"{row.label}: at the end {one.deviations[-1]:.1e}") for row, one in shown]

    def unit_round_off(_, axes):
        axes.axhline(verdict.unit, color=MID, linewidth=0.8, linestyle=(0, (4, 2)), zorder=1)
    left, top, across, tall = place
    margin = max(name_width(canvas, line) for line in lines) + 28
    fill(canvas, canvas.panel(left, top, across - margin, tall), Panel(lines, axis, time_label(verdict.case), "|area / exact − 1|", lambda _, axes: time_axis(
        axes, 0, max(one.times[-1] for _, one in shown)), more=unit_round_off))
