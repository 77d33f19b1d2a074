"""An experiment of the kind `derivation` as the runner left it: how large derived equations are and how long they took.

Read from experiment.json, results.csv, cost.csv and fits.csv; everything is checked here, so that page and figures can trust
it. K is the number of constraints.
"""
import dataclasses
import json
import math
import pathlib

from files import InputError, allow, parse, read_json, read_table, require

RESULT_COLUMNS = ("method", "size", "constraints", "equations", "operations", "nodes", "tree_operations")
COST_COLUMNS = ("method", "size", "seconds")
FIT_COLUMNS = ("method", "quantity", "law", "points", "from", "to", "exponent", "low", "high")
QUANTITIES = ("operations", "seconds", "tree")


def is_one(folder):
    """True where the directory holds such an experiment; what is wrong with others is said where they are read."""
    try:
        head = json.loads((pathlib.Path(folder) / "experiment.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(head, dict) and head.get("kind") == "derivation"


@dataclasses.dataclass
class Fit:
    law: str  # power or exponential
    exponent: float
    low: float
    high: float
    begin: float
    end: float


@dataclasses.dataclass
class Method:
    name: str
    title: str
    points: list = dataclasses.field(default_factory=list)  # {"K", "equations", "operations", "nodes", "tree", "seconds"}
    fits: dict = dataclasses.field(default_factory=dict)  # by quantity

    def line(self, quantity):
        """(K, values) where there are some."""
        some = [(p["K"], p[quantity]) for p in self.points if math.isfinite(p[quantity]) and p[quantity] > 0]
        return [k for k, _ in some], [v for _, v in some]


class Study:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.head = read_json(self.folder / "experiment.json")
        self.tables = ("results.csv", "cost.csv", "fits.csv")
        require(self.head, "experiment.json", name=str, title=str, system=str, methods=list, published=list)
        allow(self.head, "experiment.json", description=str, reference=list, citation=list, notes=list, versions=dict)
        if self.head.get("schema") != 1:
            raise InputError(f"experiment.json: expected \"schema\": 1, got {self.head.get('schema')!r}")
        for published in self.head["published"]:
            require(published, "experiment.json, published", label=str)
            if not all(isinstance(published.get(k), (int, float)) and published[k] > 0 for k in ("factor", "rate")):
                raise InputError("experiment.json, published: expected numbers > 0 as 'factor' and 'rate'")
        self.published = self.head["published"]
        # Nothing is run, and its timings are processor time of derivations, for which no machine.json is written.
        self.runs, self.machine = (), {}
        self.methods = [Method(m["name"], m.get("title", "")) for m in self.head["methods"]]
        self._read()
        self.methods = [m for m in self.methods if m.points]
        if not self.methods:
            raise InputError("results.csv: expected at least one derivation, found none")

    def method(self, name, where):
        found = next((m for m in self.methods if m.name == name), None)
        if found is None:
            raise InputError(f"{where}: method '{name}' is not in experiment.json")
        return found

    def _read(self):
        seconds = {}
        for where, cells in read_table(self.folder / "cost.csv", COST_COLUMNS)[1]:
            seconds[cells["method"], cells["size"]] = parse(cells["seconds"], f"{where}, column seconds")
        for where, cells in read_table(self.folder / "results.csv", RESULT_COLUMNS)[1]:
            point = {"K": parse(cells["constraints"], f"{where}, column constraints"),
                     "tree": parse(cells["tree_operations"], f"{where}, column tree_operations"),
                     "seconds": seconds.get((cells["method"], cells["size"]), math.nan)}
            point |= {k: parse(cells[k], f"{where}, column {k}") for k in ("equations", "operations", "nodes")}
            if not point["K"] >= 1:
                raise InputError(f"{where}, column constraints: expected 1 or more, got '{cells['constraints']}'")
            self.method(cells["method"], where).points.append(point)
        for where, cells in read_table(self.folder / "fits.csv", FIT_COLUMNS)[1]:
            if cells["quantity"] not in QUANTITIES:
                raise InputError(f"{where}: expected one of {', '.join(QUANTITIES)}, got '{cells['quantity']}'")
            numbers = [parse(cells[k], f"{where}, column {k}") for k in ("exponent", "low", "high", "from", "to")]
            self.method(cells["method"], where).fits[cells["quantity"]] = Fit(cells["law"], *numbers)
