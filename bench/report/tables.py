"""The tables of the report: what was run, the results of a case, and its other invariants."""
import math

from figures import heading, step_text, with_unit
from experiment import DIRECTIONS
from findings import largest_setback, slope_unit
from wording import duration, number, text


def settings(parameters):
    return ", ".join(f"{k} = {v}" for k, v in (parameters or {}).items()) or "–"


def table(caption, columns, bodies):
    """A table of [[row]] grouped by body; a row is (class, cells); a column is (title, class).

    The first cell heads its row, and all rows of the body that begin with the same one. Cells and titles are HTML.
    Columns whose cells are all a dash are left out.
    """
    rows = [cells for body in bodies for _, cells in body]
    kept = [k for k in range(len(columns)) if k == 0 or any(cells[k] != "–" for cells in rows)]
    out = [f'<p class="caption">{caption}</p>', '<div class="scroll" tabindex="0"><table>', "<thead><tr>"]
    out += [f'<th scope="col"{cell_class(columns[k][1])}>{columns[k][0]}</th>' for k in kept]
    out.append("</tr></thead>")
    for body in bodies:
        out.append("<tbody>")
        above = None
        for row_class, cells in body:
            span = sum(other[0] == cells[0] for _, other in body)
            head = f'<th scope="{"row" if span == 1 else "rowgroup"}" rowspan="{span}">{cells[0]}</th>'
            out.append(f"<tr{cell_class(row_class)}>" + (head if cells[0] != above else "")
                       + "".join(f"<td{cell_class(columns[k][1])}>{cells[k]}</td>" for k in kept[1:]) + "</tr>")
            above = cells[0]
        out.append("</tbody>")
    return "\n".join(out + ["</table></div>"])


def cell_class(name):
    return f' class="{name}"' if name else ""


def cases(experiment):
    columns = [("Case", ""), ("System", ""), ("Parameters", "wrap"), ("Duration", "number"), ("Steps", "wrap"),
               ("Precision", ""), ("Drift of", ""), ("Structure", ""), ("Reference solution", "")]
    rows = []
    for case in experiment.cases:
        steps = sorted({r.step for r in experiment.runs_of(case) if not r.tolerance}, reverse=True)
        rows.append(("", [text(x if x not in (None, "") else "–") for x in (
            heading(case), case.get("model") or case.get("system"), settings(case.get("parameters")),
            f"{case['time']} {case.get('time_unit') or ''}".strip() if "time" in case else "",
            f"{', '.join(f'{h:.4g}' for h in steps)} {case.get('time_unit') or ''}".strip(), case["precision"],
            case.get("conserved"), case.get("structure"), case.get("reference_solution"))]))
    return table("Cases", columns, [rows])


def methods(experiment):
    columns = [("Method", ""), ("Integrator", ""), ("Parameters", "wrap"), ("Order", "number"), ("Claims", "wrap")]
    return table("Methods", columns, [[("", [text(x if x not in (None, "") else "–") for x in (
        m["label"], m.get("integrator"), settings(m.get("parameters")), by_system(m, lambda s: str(s["order"])),
        by_system(m, lambda s: ", ".join(s["preserves"])))]) for m in experiment.methods]])


def by_system(method, say):
    """What say() gives for each system that the method claims something of; said once where it is the same for all."""
    said = {s["name"]: say(s) for s in method.get("systems") or []}
    if len(set(said.values())) <= 1:
        return next(iter(said.values()), "")
    return "; ".join(f"{name}: {what}" for name, what in said.items())


def overview(experiment):
    """Method by case: class and size of the drift at the common step, and the structure residual."""
    columns = [("Method", "")]
    for case in experiment.cases:
        name = case.get("conserved")
        about = with_unit(name, experiment.expectation(case, name)[1]) if name else "no conserved quantity"
        columns.append((f"{text(heading(case))}<br><small>{text(about)}</small>", ""))
    chosen = {(c["name"], r.method): (c, r) for c in experiment.cases for r in experiment.at_common_step(c)}
    rows = []
    for label in experiment.labels:
        cells = [chosen.get((c["name"], label)) for c in experiment.cases]
        if any(cells):
            rows.append(("", [text(label), *(overview_cell(experiment, *cell) if cell else "–" for cell in cells)]))
    steps = ", ".join(f"{heading(c)}: {step_text(experiment.common_step(c), c)}" for c in experiment.cases)
    return table("<strong>At a glance.</strong> Class and size of the drift of each case's conserved quantity (of one "
                 "that is expected to decrease or increase, its largest move in the other direction over its "
                 f"scale), and the structure residual, at the step that most methods share ({text(steps)}).",
                 columns, [rows])


def overview_cell(experiment, case, run):
    if run.failed:
        return f"<strong>✗ {text(run.status)}</strong>"
    name, residual = case.get("conserved"), run.number("structure_residual")
    shown = []
    expected = experiment.expectation(case, name)[0] if name else ""
    if expected in DIRECTIONS:
        shown = [f"{DIRECTIONS[expected][1]}s by {number(largest_setback(experiment, case, run, name, expected))}"]
    elif name:
        shown = [f"{text(run.drift_class(name))} {number(run.drift(name, 'max'))}".strip()]
    shown += [] if math.isnan(residual) else [f"<small>structure {number(residual)}</small>"]
    return "<br>".join(shown) or "–"


def results(experiment, case):
    name, time_unit = case.get("conserved"), case.get("time_unit") or ""
    expected, unit = experiment.expectation(case, name) if name else ("", "")
    word = "drift" if expected == "conserved" else "change"
    columns = [("Method", ""), (text(with_unit("Step", time_unit)), "number"), ("Status", "status"),
               ("Largest error<br>of the state", "number"), ("Final error<br>of the state", "number"),
               (f"Largest relative error<br>of {text(case.get('error') or '')}", "number"),
               (f"Largest {word}" + (f"<br>of {text(with_unit(name, unit))}" if name else ""), "number"),
               (f"Class of {word}", ""), (f"Slope [interval]<br>in {text(slope_unit(unit, time_unit))}", ""),
               ("Structure<br>residual", "number"), ("Time per step<br>(range)", "number"), ("Time of run", "number"),
               ("Work per step", ""), ("Run", "wrap")]
    bodies = {}
    equal = experiment.equal.get(case["name"], (math.nan, {}))[1]
    for r in experiment.runs_of(case) + list(equal.values()):
        status = text(r.status) + (f": {text(r.message)}" if r.failed and r.message else "")
        bodies.setdefault(r.method, []).append(("failed" if r.failed else "", [
            text(r.method), size_text(r) + ("<br><small>equal cost</small>" if r in equal.values() else ""), ("✗ " if r.failed else "") + status, number(r.number("error_max")),
            number(r.number("error_final")), number(r.number("relative_drift_max")), number(r.drift(name, "max")) if name else "–",
            drift_class(experiment, r, name), slope(r, name), number(r.number("structure_residual")), per_step(r),
            duration(r.cost.ns * r.steps if r.cost else math.nan), work(r), files(r)]))
    about = ["Errors of the state are relative to the norm of the reference solution."] if case.get("reference_solution") else []
    if expected in DIRECTIONS:
        about.append(f"{text(name)} is expected to {DIRECTIONS[expected][0]}: its change is not an error.")
    about.append("Work per step: f right-hand sides, J Jacobians, it Newton iterations, LU factorisations.")
    if not any(r.cost for r in experiment.runs_of(case)):
        about.append("Timings were not measured.")
    return table(f"<strong>Results: {text(heading(case))}.</strong> {' '.join(about)}", columns, list(bodies.values()))


def files(run):
    """The name of a run, with links to its files."""
    if not run.slug:
        return "–"
    links = " ".join(f'<a href="{text(run.path)}/{name}">{what}</a>' for what, name in (
        ("settings", "config.toml"), ("samples", "series.csv"), ("summary", "summary.json")))
    return f"{text(run.slug)}<br><small>{links}</small>"


def spreads(experiment, case):
    """Median and range over the seeds of an ensemble, of everything that was measured."""
    columns = [("Method", ""), ("Step or tolerance", "number"), ("Finished", "number")]
    measures = []
    for _, cells in experiment.spreads:
        if cells["case"] == case["name"] and cells["measure"] not in measures and cells["measured"] != "0":
            measures.append(cells["measure"])
    columns += [(text(m), "number") for m in measures]
    cells_of = {m: {(method, size): rest for method, size, *rest in experiment.spreads_of(case, m)} for m in measures}
    rows = []
    for method, size, *_, finished, runs in experiment.spreads_of(case, measures[0]) if measures else []:
        shown = [cells_of[m].get((method, size), [math.nan] * 3)[:3] for m in measures]
        rows.append(("", [text(method), text(size), f"{finished:.0f} of {runs:.0f}", *(
            f"{number(median)}<br><small>{number(low)} … {number(high)}</small>" if not math.isnan(median) else "–"
            for median, low, high in shown)]))
    return table(f"<strong>Results: {text(heading(case))}.</strong> Median and range over {case['seeds']} seeds; ~ marks a "
                 "tolerance.", columns, [rows])


def drift_classes(experiment):
    """What each class says, of those that a run of the experiment is in."""
    seen = {r.drift_class(n) for r in experiment.runs for n in experiment.invariants}
    rows = [("", [text(c.name), text(c.meaning)]) for c in experiment.drift_classes.values() if c.name in seen]
    return table("<strong>Classes of drift.</strong> How an error grows over a run, or does not; the size is another "
                 "question.", [("Class", ""), ("What the error does", "")], [rows]) if rows else ""


def fields(experiment):
    """What the numbers of a quantity are."""
    rows = [("", [text(f["name"]), text(f.get("unit") or "1"), text(f.get("meaning") or "")]) for f in experiment.fields]
    return table("<strong>Numbers of a quantity.</strong> Columns of results.csv, behind the name of the quantity and a colon. The unit of "
                 "the quantity is [e], that of the time [t].", [("Number", ""), ("Unit", ""), ("What it is", "")], [rows]) if rows else ""


def drift_class(experiment, run, name):
    name_of_class = run.drift_class(name) if name else ""
    kind = text(name_of_class)
    exponent, oscillation = (run.drift(name, m) if name else math.nan for m in ("exponent", "oscillation"))
    if kind and experiment.drift_classes[name_of_class].measure == "exponent" and not math.isnan(exponent):
        kind += f", t<sup>{number(exponent)}</sup>"
    if not math.isnan(oscillation):
        kind += f"<br><small>oscillation {number(oscillation)}</small>"
    return kind or "–"


def slope(run, name):
    if not name or math.isnan(run.drift(name, "slope")):
        return "–"
    low, high = number(run.drift(name, "slope_low")), number(run.drift(name, "slope_high"))
    interval = f"<br><small>[{low}, {high}]</small>" if "–" not in (low, high) else ""
    return number(run.drift(name, "slope")) + interval


def size_text(run):
    return f"~{run.tolerance}" if run.tolerance else f"{run.step:.4g}"


def per_step(run):
    if not run.cost:
        return "–"
    low, high = number(run.cost.low), number(run.cost.high)
    return f"{number(run.cost.ns)} ns" + (f"<br><small>({low}–{high})</small>" if "–" not in (low, high) else "")


def work(run):
    parts = [(run.number(f"{column}_per_step"), symbol) for column, symbol in (
        ("rhs", "f"), ("jacobians", "J"), ("iterations", "it"), ("factorisations", "LU"))]
    return " · ".join(f"{number(x)} {symbol}" for x, symbol in parts if x > 0) or "–"


def invariants(experiment, case):
    """The largest change of every other invariant at the common step, with its class."""
    runs = experiment.at_common_step(case)
    names = [n for n in experiment.invariants if n != case.get("conserved")
             and any(not math.isnan(r.drift(n, "max")) for r in runs)]
    if not names:
        return ""
    columns = [("Method", ""), (text(with_unit("Step", case.get("time_unit"))), "number")]
    for n in names:
        expected, unit = experiment.expectation(case, n)
        columns.append((text(with_unit(n, unit)) + (f"<br><small>expected: {text(expected)}</small>"), ""))
    rows = [("failed" if r.failed else "", [text(r.method), size_text(r), *(
        f"{number(r.drift(n, 'max'))}<br><small>{text(r.drift_class(n))}</small>" if not math.isnan(r.drift(n, "max"))
        else "–" for n in names)]) for r in runs]
    return table(f"<strong>Other invariants and constraints: {text(heading(case))}.</strong> Largest change since the "
                 "start and its class.", columns, [rows])
