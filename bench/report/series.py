"""The series of one run, series.csv, with one of its invariants.

Series in quad hold 36 digits: the difference I(t) - I(0) is formed in decimal arithmetic before anything is rounded to double.
"""
import dataclasses
import decimal
import math

from files import InputError, parse, read_csv


@dataclasses.dataclass
class Series:
    time: list  # of a run that goes back in time that since its start
    time_unit: str
    initial: float  # I(0)
    change: list  # I(t) - I(0)
    unit: str
    residual: list  # structure residual, nan where it was not measured
    error: list  # of what is not conserved: I(t) less that of the reference solution, nan where there is none

    def setbacks(self, expected):
        """The largest move against the expected direction up to t: of a quantity that is expected to decrease the rise
        max of I(t2) - I(t1) over t1 <= t2 <= t, of one that is expected to increase the fall; zero where there is none.
        """
        sign = {"decreasing": 1, "increasing": -1}[expected]
        lowest, largest, out = math.inf, 0.0, []
        for x in self.change:
            lowest = min(lowest, sign * x)
            largest = max(largest, sign * x - lowest)
            out.append(largest)
        return out


def run_times(times):
    """Times that grow along a run: of one that goes back those since its start."""
    return [times[0] - t for t in times] if len(times) > 1 and times[-1] < times[0] else times


def read_series(path, invariant, precision, may_lack=False):
    where = "/".join(path.parts[-3:])
    columns, rows = read_csv(path, where)
    names, units = zip(*map(split_unit, columns)) if columns else ((), ())
    if not names or names[0] != "t":
        raise InputError(f"{where}: the first column is expected to be 't [unit]'")
    if invariant is not None and invariant not in names:
        if may_lack:
            return None
        raise InputError(f"{where}: column '{invariant}' is missing")

    def column(name):
        if name not in names:
            return [math.nan] * len(rows)
        k = names.index(name)
        return [parse(row[k], f"{where}, line {line}, column {name}") for line, row in rows]

    values = column(invariant)
    initial = values[0] if values else math.nan
    change = [x - initial for x in values]
    if precision == "quad" and math.isfinite(initial):
        k = names.index(invariant)
        start = decimal.Decimal(rows[0][1][k])  # operands keep all their digits; only the difference is rounded
        change = [float(decimal.Decimal(row[k]) - start) if math.isfinite(x) else x
                  for (_, row), x in zip(rows, values)]
    unit = units[names.index(invariant)] if invariant is not None else ""
    return Series(run_times(column("t")), units[0], initial, change, unit, column("structure_residual"), column(f"{invariant}:error"))


def split_unit(cell):
    """'energy [J]' -> ('energy', 'J')"""
    name, bracket, unit = cell.rpartition(" [")
    return (name, unit[:-1]) if bracket and unit.endswith("]") else (cell, "")
