"""The verdict of a case as a LaTeX table: needs booktabs and nothing else, text as small as a column takes."""
import math

from experiment import DIRECTIONS
from figures import with_unit
from verdict import TARGETS
from wording import two_digits

SPECIAL = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", **{c: "\\" + c for c in "&%$#_{}"}}
GREEK = {"µ": r"$\mu$", "–": "--", "×": r"$\times$", "≤": r"$\leq$", "±": r"$\pm$", "ν": r"$\nu$"}


def escaped(text):
    """Text that LaTeX is not to read as commands."""
    return "".join(SPECIAL.get(c) or GREEK.get(c) or c for c in str(text))


def size(x):
    if math.isnan(x):
        return "--"
    if x == 0 or 0.01 <= abs(x) < 99.5:
        return f"{x:.2g}"
    mantissa, _, exponent = f"{x:.0e}".partition("e")
    return rf"${mantissa}\cdot 10^{{{int(exponent)}}}$"


def latex_table(verdict):
    columns = [("l", "", lambda r: escaped(r.label))]
    if verdict.structured:
        columns.append(("l", "structure", structure))
    if verdict.invariant:
        unit = verdict.experiment.expectation(verdict.case, verdict.invariant)[1]
        head = (f"{DIRECTIONS[verdict.expected][1]} of {verdict.invariant}" if verdict.expected in DIRECTIONS else
                with_unit(f"drift of {verdict.invariant}", unit))
        columns.append(("l", escaped(head), lambda r: drift(verdict, r)))
    if verdict.relative:
        columns.append(("r", escaped(verdict.measure.noun), lambda r: "phase lost" if r.error >= 0.5 and verdict.of_state
                        else size(r.error)))
    unit, divisor = time_unit(verdict)
    if verdict.comparable:
        for target in TARGETS:
            columns.append(("r", f"$10^{{{round(math.log10(target))}}}$", lambda r, t=target: time(r, t, divisor)))
    columns.append(("l", "order (claim)", order))
    if verdict.failures:
        columns.append(("r", "failed", lambda r: f"{r.curve.failed} of {r.curve.total}" if r.curve.failed else "--"))
    level = f"at equal cost {escaped(verdict.cost_text(verdict.level))}" if verdict.level > 0 else "at one step"
    rows = [" & ".join(cell(r) for _, _, cell in columns) + r"\\" for r in verdict.rows]
    return "\n".join([
        r"% needs \usepackage{booktabs}", f"% drift and error {level}; columns of powers of ten: {escaped(unit)} to that "
        f"{escaped(verdict.measure.noun) if verdict.measure else 'error'}", r"{\footnotesize\setlength{\tabcolsep}{2pt}%",
        rf"\begin{{tabular}}{{@{{}}{''.join(c[0] for c in columns)}@{{}}}}", r"\toprule",
        " & ".join(head for _, head, _ in columns) + r"\\", r"\midrule", *rows, r"\bottomrule", r"\end{tabular}}", ""])


def time_unit(verdict):
    """(what times are given in, the divisor): milliseconds or microseconds, by the size of the level."""
    if verdict.work != "time":
        return verdict.work, 1.0
    return ("time [s]", 1e9) if verdict.level >= 1e9 else ("time [ms]", 1e6) if verdict.level >= 1e6 else ("time [µs]", 1e3)


def structure(row):
    if row.curve.kept is None:
        return "--"
    exponent = row.curve.residual_power()
    if not row.curve.residuals:
        return "claimed"
    worst = max(x for _, x in row.curve.residuals)
    return "kept" if row.curve.kept else size(worst) if math.isnan(exponent) else f"$h^{{{exponent:.1f}}}$"


def drift(verdict, row):
    kind = "" if verdict.expected in DIRECTIONS else escaped(row.drift_class) + " "
    return kind + size(row.drift) + (", motion lost" if row.astray else "")


def time(row, target, divisor):
    cost, at_most = row.times[target]
    return "--" if math.isnan(cost) else (r"$\leq$" if at_most else "") + two_digits(cost / divisor)


def order(row):
    claim = "" if row.curve.claimed is None else f" ({row.curve.claimed})"
    found = row.curve.order()
    if found is None:
        return "--" + claim
    spread = "" if math.isnan(found.interval) else rf"$\pm${max(found.interval, 0.005):.2f}"
    return f"{found.value:.2f}{spread}{claim}"
