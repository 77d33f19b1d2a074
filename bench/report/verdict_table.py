"""The verdict table of a case: a row for each method, sorted by the time to the target.

Every cell carries the number that it is sorted by; columns of which nothing is known are left out. On narrow screens only
method, structure, drift, error and the time to the target stay, until a box is ticked that shows the rest.
"""
import math

from experiment import DIRECTIONS
from families import mark
from figures import slug, step_text
from verdict import TARGETS
from wording import minus, power, raised, size, text, two_digits

NEVER = 1e9  # sorts after everything

STRIP = (-16.0, 1.0)  # decades of error that a strip shows


def table(verdict):
    rows = [r for r in verdict.rows if r.curve.total]
    columns = [c for c in all_columns(verdict) if any(c["cell"](r)[1] is not None for r in rows)]
    groups = []
    for c in columns:
        if groups and groups[-1][0] == c["group"] != "":
            groups[-1][1].append(c)
        else:
            groups.append((c["group"], [c]))
    top = "".join(
        f'<th scope="colgroup" colspan="{len(some)}" class="grp">{group}</th>' if group else
        f'<th scope="col" rowspan="2"{attributes(some[0])}>{some[0]["head"]}</th>' for group, some in groups)
    second = "".join(f'<th scope="col"{attributes(c)}>{c["head"]}</th>' for g, some in groups if g for c in some)
    name = slug(verdict.case)
    out = [f'<input type="checkbox" class="allcols" id="all-{name}"><label class="allcols" for="all-{name}">all columns'
           '</label>', '<div class="scroll" tabindex="0" role="region" aria-label="verdict table">',
           f'<table class="verdict"><caption>{caption(verdict)}</caption>', f"<thead><tr>{top}</tr>",
           f"<tr>{second}</tr></thead><tbody>"]
    for row in rows:
        cells = [f'<th scope="row">{mark(row.curve.family, row.curve.fill)}<span class="c-{row.curve.family.key}">'
                 f"{text(row.label)}</span></th>"]
        for c in columns[1:]:
            classes, value, shown, *title = c["cell"](row)
            told = f' title="{text(title[0])}"' if title and title[0] else ""
            classes = " ".join(x for x in (c["class"], classes) if x)
            cells.append(f'<td class="{classes}" data-v="{NEVER if value is None else f"{value:.6g}"}"{told}>{shown}</td>')
        out.append(f'<tr data-family="{row.curve.family.key}">{"".join(cells)}</tr>')
    return "\n".join(out + ["</tbody></table></div>"])


def attributes(column):
    sort = ' aria-sort="ascending"' if column.get("sorted") else ""
    return (f' class="{column["class"]}"' if column["class"] else "") + sort


def column(head, classes, cell, group="", **rest):
    return {"head": head, "class": classes, "cell": cell, "group": group} | rest


def all_columns(verdict):
    level = f"at equal cost, {verdict.cost_text(verdict.level)}" if verdict.level > 0 else "at one step"
    if verdict.work != "time" and verdict.level > 0:
        level += f" {verdict.work}"
    what = text(verdict.measure.noun) if verdict.measure else "error"
    spent = {"time": "time", "right-hand sides": "right-hand sides", "steps": "steps"}[verdict.work]
    lead = verdict.target or TARGETS[1]
    asked = TARGETS if lead in TARGETS else tuple(sorted((*TARGETS, lead), reverse=True))
    columns = [column("method", "", lambda r: ("", 0, "")),
               column("structure <small>residual per step</small>", "", structure_cell)]
    if verdict.invariant:
        moves = DIRECTIONS.get(verdict.expected)
        unit = verdict.experiment.expectation(verdict.case, verdict.invariant)[1]
        head = f"{moves[1]} of {verdict.invariant}" if moves else f"drift of {verdict.invariant} / scale"
        beside = "" if moves else f" <small>and in {raised(text(unit))}</small>" if unit not in ("", "1") else " <small>and its size</small>"
        columns.append(column(raised(text(head)) + beside, "", lambda r: drift_cell(verdict, r), level))
    for level_name in verdict.experiment.residuals:
        columns.append(column(text(level_name.replace("hidden-", "hidden ")), "r more",
                              lambda r, n=level_name: level_cell(verdict, r, n), level))
    if verdict.comparable and verdict.relative:
        columns.append(column(what, "r", lambda r: error_cell(verdict, r), level))
    for target in asked:
        head = f'<span class="short">{spent} to </span>{power(round(math.log10(target)))}'
        columns.append(column(head, "r lead" if target == lead else "r more",
                              lambda r, t=target: time_cell(verdict, r, t), f"{spent} to reach {what}",
                              sorted=target == lead))
    columns += [column("claim", "r more", claim_cell, "order"),
                column("measured" if verdict.of_state else f"slope of {what}", "r more", order_cell, "order")]
    if verdict.failures:
        columns.append(column("failed", "r more", lambda r: ("", r.curve.failed, f"{r.curve.failed} of {r.curve.total}"
                                                             if r.curve.failed else "·")))
    return columns


def structure_cell(row):
    if row.curve.kept is None:
        small = [x for _, x in row.curve.residuals]
        return (("na", math.log10(max(max(small), 1e-40)), f"not known <small>{size(max(small))}</small>",
                 "the error of a step is as small, so that this may be accuracy") if small else ("na", None, "–"))
    if not row.curve.residuals:
        return "", -40.0, '<span class="tick">claimed</span>'
    worst = max(x for _, x in row.curve.residuals)
    if row.curve.kept:
        return "", math.log10(max(worst, 1e-40)), f'<span class="tick">kept</span> <small>{size(worst)}</small>'
    residual = row.run.number("structure_residual") if row.run else math.nan
    residual = worst if math.isnan(residual) else residual
    exponent = row.curve.residual_power()
    falls = f" <small>∝ <i>h</i><sup>{minus(f'{exponent:.1f}')}</sup></small>" if not math.isnan(exponent) else ""
    return "", math.log10(max(residual, 1e-40)), f'<span class="kv">{size(residual)}</span>{falls}'


def drift_cell(verdict, row):
    if row.run is None or math.isnan(row.drift):
        return "na", None, "–"
    sorted_by = math.log10(max(row.drift, 1e-40))
    if verdict.expected in DIRECTIONS:
        move = DIRECTIONS[verdict.expected][1]
        return ("bad" if row.drifts else "", sorted_by,
                f'<span class="cls">{move if row.drifts else "none"}</span> {size(row.drift)}{star(row)}', at_which(verdict, row))
    return ("bad" if row.drifts else "", sorted_by,
            f'<span class="cls">{text(row.drift_class or "–")}</span> '
            f"{size(row.drift / verdict.experiment.scale(verdict.case, verdict.invariant))} <small>{size(row.drift)}"
            f"{', motion lost' if row.astray else ''}</small>{star(row)}", at_which(verdict, row))


def star(row):
    return '<span class="star" title="does not cost this much: its nearest run">*</span>' if row.off else ""


def at_which(verdict, row):
    at = f"tolerance {row.run.tolerance}" if row.run.tolerance else step_text(row.run.step, verdict.case)
    return f"{'the run at equal cost' if row.label in verdict.made else 'the run nearest to equal cost'}: {at}"


def level_cell(verdict, row, name):
    top = verdict.residual(row, name)
    if math.isnan(top):
        return "na", None, "–"
    return "r", math.log10(max(top, 1e-40)), size(top) + star(row), row.run.drift_class(name)


def error_cell(verdict, row):
    if math.isnan(row.error):
        return "na", None, "–"
    shown = "phase lost" if row.error >= 0.5 and verdict.of_state else size(row.error)
    return "", math.log10(max(row.error, 1e-40)), (
        "" if verdict.experiment.residuals else strip(row)) + f'<span class="num">{shown}</span>{star(row)}'


def strip(row):
    """A dot on a short logarithmic axis with ticks at 1e-9, 1e-6 and 1e-3."""
    low, high = STRIP

    def x(decade):
        return 4 + 60 * (min(max(decade, low), high) - low) / (high - low)
    ticks = "".join(f'<path class="st" d="M{x(k):.1f} 2V10"/>' for k in (-9, -6, -3))
    return (f'<svg class="strip" width="68" height="12" viewBox="0 0 68 12" aria-hidden="true"><path class="sl" d="M4 6H64"/>'
            f'{ticks}<circle cx="{x(math.log10(max(row.error, 1e-40))):.1f}" cy="6" r="3" '
            f'style="fill:var(--{row.curve.family.key})"/></svg>')


def time_cell(verdict, row, target):
    cost, at_most = row.times[target]
    if math.isnan(cost):
        points = row.curve.measured()
        last = min(points, key=lambda p: p.error) if points else None
        return "na", None, "–", f"error {last.error:.1e} after {verdict.cost_text(last.cost)} at best" if last else ""
    if at_most or row not in verdict.rivals:
        return "", NEVER / 2, f"{'≤ ' if at_most else ''}{verdict.cost_text(cost)}", (
            "no runs on both sides of this error" if at_most else "another motion")
    ratio = cost / verdict.ranked(target)[0].times[target][0]
    return ("best" if row in verdict.best(target) else "", cost, f"{verdict.cost_text(cost)} <small>×{two_digits(ratio)}</small>")


def claim_cell(row):
    return ("", row.curve.claimed, str(row.curve.claimed)) if row.curve.claimed is not None else ("na", None, "–")


def order_cell(row):
    order = row.curve.order()
    if order is None:
        if row.curve.claimed is None or not any(p.error > 0 for p in row.curve.points):
            return "na", None, "–"
        why = ("the method chooses its steps" if row.curve.adaptive else
               "fewer than two runs lie between the lost phase and round-off")
        return "na unseen", -1.0, "not measurable here", why
    spread = "finest pair" if math.isnan(order.interval) else f"± {max(order.interval, 0.005):.2f}"
    return "warn" if order.surprising else "", order.value, f"{order.value:.2f} <small>{spread}</small>"


def caption(verdict):
    lead = verdict.target or TARGETS[1]
    parts = []
    if verdict.target is not None:
        spent = "time" if verdict.work == "time" else f"number of {verdict.work}"
        parts.append(f"Sorted by the {spent} to {text(verdict.measure.noun)} {power(round(math.log10(lead)))} "
                     "where runs lie on both sides of it, and then by the error; × is the ratio to the best, ≤ a bound where "
                     "there is no run on one side, – says that no run reaches it.")
    if verdict.level > 0:
        level = verdict.cost_text(verdict.level) + ("" if verdict.work == "time" else f" {verdict.work}")
        parts.append(f"At equal cost, {level}: " + (
            "each method was run at the step that costs this; a star marks one that does not cost it, by its nearest run."
            if verdict.made else "the error is interpolated between runs, drift and residual are of the nearest run, with a star "
            "where that costs another."))
    if verdict.structured:
        parts.append("Filled marks keep the structure, open ones do not, and of those filled by half it is not known.")
    if any(r.astray for r in verdict.rows):
        parts.append("Motion lost: the run makes another motion, of which no class of drift is a merit.")
    if verdict.case.get("seeds"):
        parts.append(f"Medians over {verdict.case['seeds']} seeds, and their most frequent class.")
    if verdict.failures:
        parts.append("Failed runs enter nothing but their count.")
    return " ".join(parts)
