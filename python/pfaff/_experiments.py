"""Experiments: every case with every method and step size, run, timed and compared."""
from __future__ import annotations

import csv
import dataclasses
import hashlib
import html
import json
import os
import pathlib
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _pfaff
from ._arguments import path as path_of
from ._arguments import shown, unknown, yes_or_no
from ._errors import InputError, Interrupted
from ._naming import absolute
from ._numbers import float_of_number
from ._objects import as_method
from ._system import System
from ._tables import data_frame
from ._toml import toml_of

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


class Table(Sequence[Mapping[str, Any]]):
    """Rows of a CSV file of an experiment, as dictionaries: numbers are floats, what is empty is None.

    `table["error_max"]` is a column as a NumPy array, `table[0]` a row.
    """

    def __init__(self, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        self.columns = tuple(columns)
        self._rows = [dict(zip(columns, map(_value, row))) for row in rows]

    @classmethod
    def read(cls, path: pathlib.Path) -> Table:
        """The table of a file."""
        with path.open(newline="", encoding="utf-8") as file:
            columns, *rows = csv.reader(file)
        return cls(columns, rows)

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return self._rows[key]
        if key not in self.columns:
            raise InputError(unknown("column", key, self.columns))
        values = [row[key] for row in self._rows]
        if all(value is None or isinstance(value, float) for value in values):
            return np.array([np.nan if value is None else value for value in values])
        return np.array(["" if value is None else value for value in values], dtype=object)

    def __len__(self) -> int:
        return len(self._rows)

    def to_pandas(self) -> pandas.DataFrame:
        """The rows as a data frame."""
        return data_frame(self.columns, [list(row.values()) for row in self._rows])

    def __repr__(self) -> str:
        return f"<table of {len(self)} rows: {', '.join(self.columns[:12])}{', ...' if len(self.columns) > 12 else ''}>"


def _value(text: str) -> float | str | None:
    try:
        return float(text) if text else None
    except ValueError:
        return text


class WorkPrecision:
    """What the runs of an experiment cost and how large their errors are.

    Attributes:
        curves: for each case a dictionary that has, by the label of a method, (nanoseconds for a unit of time, largest
            error), two arrays over its steps, by rising cost.
    """

    def __init__(self, comparison: Comparison) -> None:
        settings = json.loads((comparison.directory / "experiment.json").read_text(encoding="utf-8"))
        self._families = {method["label"]: method.get("family", "other") for method in settings["methods"]}
        self._titles = {case["name"]: case["title"] or case["name"] for case in settings["cases"]}
        timings = {(row["case"], row["method"], row["step"]): row for row in comparison.cost}
        self.curves: dict[str, dict[str, tuple[np.ndarray, np.ndarray]]] = {}
        points: dict[tuple[str, str], list[tuple[float, float]]] = {}
        for row in comparison.table:
            timing = timings.get((row["case"], row["method"], row["step"]))
            if timing and row["status"] == "converged" and row["error_max"] and isinstance(row["step"], float):
                work = timing["ns_per_step"] / row["step"]
                points.setdefault((row["case"], row["method"]), []).append((work, row["error_max"]))
        for (case, method), pairs in points.items():
            work, error = np.array(sorted(pairs)).T
            self.curves.setdefault(case, {})[method] = (work, error)

    def plot(self, case: str | None = None, *, axes: Axes | None = None) -> Axes:
        """Error against time of computation of a case, the first one without a name, on logarithmic scales."""
        if not self.curves:
            raise InputError("work-precision: no run of the experiment has both an error and a timing")
        case = next(iter(self.curves)) if case is None else case
        if not isinstance(case, str) or case not in self.curves:
            raise InputError(unknown("case", case, list(self.curves)))
        from . import plots

        axes = plots.work_precision(self.curves[case], families=self._families, axes=axes)
        axes.set_title(self._titles[case])
        return axes

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame with a row for each point of the curves."""
        return data_frame(("case", "method", "work", "error"), [
            (case, method, *point) for case, curves in self.curves.items() for method, (work, error) in curves.items() for point in zip(work, error)])

    def __repr__(self) -> str:
        return f"<work and precision of {', '.join(f'{case} ({len(curves)} methods)' for case, curves in self.curves.items())}>"

    def _repr_html_(self) -> str:
        try:
            from . import plots

            return "".join(plots.svg(self.plot(case)) for case in self.curves)
        except ImportError as missing:
            return f"<p>{html.escape(str(missing))}</p>"


@dataclasses.dataclass(frozen=True)
class Comparison:
    """An experiment that was run.

    Attributes:
        name, title: of the experiment.
        directory: where its files are: results.csv, cost.csv, the runs and the report.
        runs: how many runs it has; `resumed` of them were there already, `failed` of them ended early.
        text: the table that the terminal shows.
        report: the path of report.html; None where no report was made.
        verdicts: what the report says of each case, as report.json holds it.
        findings: what became of the statements of the experiment.
        left_out: (case, method, reason) for every method that does not fit a case.
        ok: True where some run came to its end and every statement holds.
    """

    name: str
    title: str
    directory: pathlib.Path
    runs: int
    resumed: int
    failed: int
    text: str
    report: pathlib.Path | None
    verdicts: list[dict[str, Any]]
    findings: list[dict[str, Any]]
    left_out: list[tuple[str, str, str]]
    ok: bool
    _held: Any = dataclasses.field(default=None, repr=False)  # a temporary directory, which goes with the object

    @property
    def table(self) -> Table:
        """A row for each run, with its errors, the drift of invariants and counts of work: results.csv."""
        return Table.read(self.directory / "results.csv")

    @property
    def cost(self) -> Table:
        """A row for each run with the time that a step takes: cost.csv."""
        return Table.read(self.directory / "cost.csv")

    @property
    def work_precision(self) -> WorkPrecision:
        """Error against cost, to plot: `comparison.work_precision.plot()`."""
        return WorkPrecision(self)

    @property
    def sentences(self) -> list[str]:
        """The sentence with which the report answers the question of each case."""
        return [f"{one['case']}: {one['sentence']}" if len(self.verdicts) > 1 else one["sentence"] for one in self.verdicts]

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a data frame."""
        return self.table.to_pandas()

    def __repr__(self) -> str:
        said = "".join(f"\n{sentence}" for sentence in self.sentences)
        return f"{self.title}\n{self.text}\n{self.runs} runs, {self.failed} ended early, in {self.directory}{said}"

    def _repr_html_(self) -> str:
        said = "".join(f"<p>{html.escape(sentence)}</p>" for sentence in self.sentences)
        table = f"<pre>{html.escape(self.text)}</pre>"
        curves = self.work_precision
        return f"<h4>{html.escape(self.title)}</h4>{said}{curves._repr_html_() if curves.curves else ''}{table}"


def experiments() -> tuple[str, ...]:
    """The names of the experiments that ship with Pfaff."""
    return tuple(_pfaff.experiment_names())


def compare(
    experiment: str | os.PathLike[str] | Mapping[str, Any], *, methods: Sequence[Any] = (), out: str | os.PathLike[str] | None = None,
    quick: bool = False, report: bool = False, force: bool = False, compile: bool = False, timing: float | None = None
) -> Comparison:
    """Runs an experiment: every case with every method and step size, in parallel, and each timed alone.

    Args:
        experiment: the name of one that ships (`pfaff.experiments()`), the path of a TOML file, or a dictionary with the
            keys of such a file (docs/experiments.md), in which `case` and `method` are lists of dictionaries. The
            `system` of a case may be a `pfaff.System` written in Python.
        methods: more methods, which are run in every case that they fit: names, `pfaff.Method` objects, or a dictionary
            of them by the label that tables and figures are to show.
        out: the directory for results, which an interrupted experiment resumes from. Without it they are in a temporary
            one, which is removed with the object.
        quick: shorter horizons and fewer steps, to look at.
        report: make figures and report.html too, which takes some seconds for each case.
        force: make runs anew that were made from other files or builds.
        compile: compile the formulas of the systems.
        timing: how long each run is timed, in seconds; 0.3 without it, 0.05 of quick ones.

    Returns:
        The comparison: `.table`, `.work_precision.plot()`, `.report`, `.ok`.

    Raises:
        InputError: what does not fit, before any run; a directory that holds another experiment.
        Interrupted: Ctrl-C. With `out`, the same call resumes; without it the message says where the runs are that were made.

    >>> import pfaff
    >>> result = pfaff.compare({
    ...     "title": "A pendulum", "method": [{"label": "Verlet", "integrator": "verlet"}],
    ...     "case": [{"name": "swing", "system": "pendulum", "time": 10, "steps": [0.1, 0.05]}]}, timing=0.01)
    >>> result.runs, result.failed, bool(result.table["error_max"][1] < result.table["error_max"][0])
    (2, 0, True)
    """
    seconds = None if timing is None else float_of_number(timing, "timing", "a time above 0 s", above=0)
    for value, what in ((quick, "quick"), (report, "report"), (force, "force"), (compile, "compile")):
        yes_or_no(value, what)
    folder = None if out is None else path_of(out, "out")
    held = tempfile.TemporaryDirectory(prefix="pfaff-")
    # An experiment that is a dictionary is left as a file beside its report, which names it.
    written = ""
    if isinstance(experiment, Mapping):
        path = str(_written(experiment, pathlib.Path(held.name)))
        written = os.path.basename(path)
    else:
        path = path_of(experiment, "experiment", "the name of one, the path of a file or a dictionary")
    objects = [(label, as_method(method, "methods").instance) for label, method in _labelled(methods).items()]
    directory = pathlib.Path(held.name) / "results" if folder is None else pathlib.Path(folder)
    if objects and out is not None and directory.exists() and any(directory.iterdir()):
        raise InputError(
            f"out: expected a new directory, because runs of methods that are objects are not told apart from earlier ones, got {directory}"
        )
    try:
        found = _pfaff.compare(path, written, objects, str(directory), quick, force, compile, report, seconds)
    except Interrupted as error:
        if out is not None or not any(directory.glob("runs/*/summary.json")):
            raise
        kept = shutil.move(directory, tempfile.mkdtemp(prefix="pfaff-"))
        raise Interrupted(str(error).replace(str(directory), kept).replace("the same call resumes", "with out= of it the same call resumes")) from None
    if written:
        shutil.copy(path, directory)
    report_path = found["report"] and pathlib.Path(found["report"])
    return Comparison(
        name=found["name"], title=found["title"], directory=directory, runs=found["runs"], resumed=found["resumed"],
        failed=found["failed"], text=found["table"], report=report_path, verdicts=found["verdicts"], findings=found["findings"],
        left_out=found["left_out"], ok=found["failed"] < found["runs"] and not found["failed_claims"],
        _held=held if out is None else None,
    )


def _labelled(methods: Any) -> dict[str, Any]:
    """Methods by their labels."""
    if isinstance(methods, Mapping):
        for label in methods:
            if not isinstance(label, str) or not label:
                raise InputError(f"methods: expected labels that are texts, got {shown(label)}")
        return dict(methods)
    if not isinstance(methods, (list, tuple)):
        raise InputError(f"methods: expected a list of methods, or a dictionary of them by their labels, got {shown(methods)}")
    labelled: dict[str, Any] = {}
    for method in methods:
        label = _label(method)
        if label in labelled:
            raise InputError(f"methods: two of them are called '{label}'; expected a dictionary of them by labels that differ")
        labelled[label] = method
    return labelled


def _label(method: Any) -> str:
    """The name of a method with the parameters that were given to it."""
    made = as_method(method, "methods")
    return " ".join([made.name, *(f"{key}={value}" for key, value in made._given.items())])


def _written(experiment: Mapping[str, Any], folder: pathlib.Path) -> pathlib.Path:
    """The file of an experiment that is a dictionary."""
    document: dict[str, Any] = {"schema": 1, **experiment}
    for table, key in (("case", "system"), ("method", "integrator")):
        if table in document:
            rows = document[table]
            if not isinstance(rows, (list, tuple)) or not all(isinstance(one, Mapping) for one in rows):
                raise InputError(f"experiment: {table}: expected a list of dictionaries, got {shown(rows)}")
            document[table] = [_with_path(one, key) for one in rows]
    path = folder / "experiment.toml"
    path.write_text(toml_of(document, "experiment"), encoding="utf-8")
    return path


def _with_path(table: Mapping[str, Any], key: str) -> dict[str, Any]:
    """The table with the path of a file, if it is one, made absolute, since it is one from the working directory."""
    value = table.get(key)
    if isinstance(value, System):
        return {**table, key: str(_model_file(value))}
    return {**table, key: absolute(value)} if value is not None else dict(table)


def _model_file(system: System) -> pathlib.Path:
    """The system as a text model, in a file named by its contents, which runs can be resumed with and made again from."""
    text = system.to_toml()
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache")
    path = cache / "pfaff" / "models" / f"{system.name}-{hashlib.sha1(text.encode()).hexdigest()[:16]}.toml"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, encoding="utf-8") as file:
            file.write(text)
        os.replace(file.name, path)
    return path
