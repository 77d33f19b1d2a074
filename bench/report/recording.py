"""One run as its directory holds it, summary.json and series.csv, and what can be seen of its motion.

What is drawn follows from what the system says of itself, the names and units of its coordinates and its constraints, so
that a new system is drawn without a word about pictures:

points   coordinates x0, y0, x1, ... (or x0, y0, z0, x1, ...) of one unit are points, which `links` of summary.json joins:
         frames of the motion and an animation.
plane    otherwise the track in the plane of two coordinates, which `plane` of summary.json names.
section  of two positions and two momenta also where the track passes q1 = 0 upwards as time goes on, as p2 against q2.
"""
import dataclasses
import math
import pathlib

from files import InputError, allow, parse, read_csv, read_json
from series import split_unit

CROSSINGS = 30  # fewer show nothing of a section
SAMPLES_BETWEEN = 8  # crossings are interpolated between samples, which must follow the curve


@dataclasses.dataclass
class Recording:
    folder: pathlib.Path
    summary: dict
    time_unit: str
    times: list
    units: dict  # of every column but the time
    columns: dict  # name -> values
    state: list  # names of the coordinates, in the system's order

    @property
    def system(self):
        return self.summary.get("system") or ""

    @property
    def method(self):
        return self.summary.get("method") or self.summary.get("integrator") or ""

    @property
    def links(self):
        """[(end, end)]: an end is the number of a point, or the coordinates of a fixed place."""
        return [tuple(pair) for pair in self.summary.get("links") or []]

    def points(self):
        """[[names of the coordinates of a point]], or [] where the state does not begin with points."""
        for axes in ("xyz", "xy"):
            found = []
            while [f"{a}{len(found)}" for a in axes] == self.state[len(found) * len(axes):(len(found) + 1) * len(axes)]:
                found.append([f"{a}{len(found)}" for a in axes])
            if found and len({self.units[name] for point in found for name in point}) == 1:
                return found
        return []

    def plane(self):
        """The names of the two coordinates in whose plane the track is drawn, which the run states, or None where there are none."""
        return tuple(self.summary.get("plane") or ()) or None

    def section(self):
        """[(q2, p2)] where q1 passes zero upwards as time goes on, in a run back in time too, whose section is that of the same
        motion; empty where the state is not two positions and two momenta, where the track seldom passes, and where samples lie
        too far apart."""
        if len(self.state) != 4 or self.points() or self.units[self.state[0]] != self.units[self.state[1]]:
            return []
        forwards = 1 if self.times[-1:] >= self.times[:1] else -1
        q1, q2, _, p2 = (self.columns[name][::forwards] for name in self.state)
        out = []
        for k in range(1, len(q1) - 2):
            if q1[k] < 0 <= q1[k + 1] and all(map(math.isfinite, q1[k - 1:k + 3])):
                s = cubic_root(q1[k - 1:k + 3])
                out.append((cubic(q2[k - 1:k + 3], s), cubic(p2[k - 1:k + 3], s)))
        return out if CROSSINGS <= len(out) <= len(q1) / SAMPLES_BETWEEN else []

    def track(self, names):
        """(values of the first coordinate, values of the second), as far as both are finite."""
        for name in names:
            if name not in self.columns:
                raise InputError(f"{self.folder.name}/series.csv: column '{name}' is missing")
        return finite(*(self.columns[name] for name in names))


def finite(x, y):
    """(xs, ys) of the pairs of which both numbers are finite."""
    pairs = [p for p in zip(x, y) if all(map(math.isfinite, p))]
    return [p[0] for p in pairs], [p[1] for p in pairs]


def cubic(values, s):
    """The cubic through four equidistant values, at s in [0, 1] between the second and the third."""
    a, b, c, d = values
    return (-a * s * (s - 1) * (s - 2) / 6 + b * (s + 1) * (s - 1) * (s - 2) / 2 - c * (s + 1) * s * (s - 2) / 2
            + d * (s + 1) * s * (s - 1) / 6)


def cubic_root(values):
    """Where the cubic passes zero between its second and third value, of which the former is negative."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if cubic(values, middle) < 0 else (low, middle)
    return high


def read_recording(folder):
    """The run in a directory. InputError where it holds none."""
    folder = pathlib.Path(folder)
    summary, where = read_json(folder / "summary.json"), f"{folder.name}/summary.json"
    allow(summary, where, system=str, integrator=str, family=str, method=str, invariants=list, links=list, plane=list, constraints=list,
          error_rows=dict)
    columns, rows = read_csv(folder / "series.csv", f"{folder.name}/series.csv")
    names, units = zip(*map(split_unit, columns)) if columns else ((), ())
    if not names or names[0] != "t":
        raise InputError(f"{folder.name}/series.csv: the first column is expected to be 't [unit]'")
    values = list(zip(*([parse(x, f"{folder.name}/series.csv, line {line}") for x in row] for line, row in rows)))
    values = values or [()] * len(names)
    measured = {entry["name"] for key in ("invariants", "constraints") for entry in summary.get(key) or []}
    state = [n for n in names[1:] if n not in measured and n not in ("error", "structure_residual")
             and not n.endswith(":error")]
    return Recording(folder, summary, units[0], list(values[0]), dict(zip(names[1:], units[1:])),
                     {n: list(v) for n, v in zip(names[1:], values[1:])}, state)


def coarse(x, y):
    """Whether the samples of a track lie so far apart that lines between them would show chords and no curve."""
    turns = []
    for k in range(1, len(x) - 1):
        a, b = (x[k] - x[k - 1], y[k] - y[k - 1]), (x[k + 1] - x[k], y[k + 1] - y[k])
        if math.hypot(*a) > 0 and math.hypot(*b) > 0:
            turns.append(abs(math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])))
    return bool(turns) and sorted(turns)[len(turns) * 3 // 4] > 0.35

