"""Runs: a system integrated by a method, with all that is measured of it."""
from __future__ import annotations

import decimal
import functools
import pickle
import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _pfaff
from ._arguments import real_array, unknown
from ._asked_run import asked_run, listed_measures, name_of
from ._errors import InputError, InvariantWarning, NotConverged, RunFailed
from ._integration import Integration, attach, with_parameters
from ._measure_table import MeasureTable
from ._objects import as_system
from ._run_shown import html_of, text_of
from ._sensitivity import sensitivity_of, warn_of_jumps
from ._tables import data_frame
from ._watched import Watched

if TYPE_CHECKING:
    import pandas


class Run:
    """What a run has left: samples as arrays, and what was measured.

    `run[name]` is a coordinate, a block of coordinates (shape (rows, count)), or an invariant.
    """

    def __init__(self, system: Any, method: Any, going: Any, asked: dict[str, Any], raised: BaseException | None = None) -> None:
        of = going.samples()
        self._going = going  # for the summary
        self.system, self.method, self._asked = system, method, asked
        self.t: np.ndarray = of["t"]
        """The times of the samples, shape (rows,). All arrays are of doubles, in quad precision too."""
        self.y: np.ndarray = of["y"]
        """The states, shape (rows, dimension)."""
        self.invariants: dict[str, np.ndarray] = dict(zip(of["invariant_names"], of["invariants"].T))
        """The values of each invariant, shape (rows,)."""
        self.constraints: dict[str, np.ndarray] = dict(zip(of["constraint_names"], of["constraints"].T))
        """The largest residual of each level of constraints, shape (rows,)."""
        self.error: np.ndarray | None = of["error"]
        """The relative error against the reference, shape (rows,), NaN where it was not measured; None without one."""
        self.structure: np.ndarray | None = of["structure"]
        """The residual of the structure of one step, shape (rows,), NaN where it was not measured; or None."""
        self.measures: dict[str, MeasureTable] = {name: MeasureTable(name, *table) for name, table in of["tables"].items()}
        """The tables of the measures that were asked for, by their names."""
        self.status: str = of["status"]
        """'converged', how the last step failed, or 'interrupted' where the steps were ended by Ctrl-C or by something that was raised."""
        self.message: str = of["message"] or (str(raised).partition("\n")[0] or type(raised).__name__ if raised is not None else "")
        """Why the run ended early, or is without what was asked for; empty where all is there."""
        self.coordinates: list[str] = of["coordinates"]
        self.units: dict[str, str] = of["units"]
        self._steps, self._initial, self._step, self._t0 = of["steps"], of["initial"], of["step"], of["t0"]

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """All that summary.json of `pfaff run` holds. It is made when it is first asked for, since classing drifts takes some
        milliseconds a quantity."""
        found: dict[str, Any] = self._going.summary()
        self._going = None
        return found

    @functools.cached_property
    def drift(self) -> dict[str, Watched]:
        """Of each invariant that is conserved its drift: class, slope with its interval, max, rms, ..."""
        return {one["name"]: Watched(one) for one in self.summary.get("invariants", []) if "class" in one}

    @functools.cached_property
    def constraint_drift(self) -> dict[str, Watched]:
        """The same of the residual of each level of constraints."""
        return {one["name"]: Watched(one) for one in self.summary.get("constraints", [])}

    @property
    def error_max(self) -> float | None:
        """The largest error against the reference, relative; None where none was measured."""
        return self.summary.get("error_max")

    @property
    def error_final(self) -> float | None:
        """The last error that was measured."""
        return self.summary.get("error_final")

    @property
    def counters(self) -> dict[str, int]:
        """The work that was done: steps, right_hand_sides, jacobians, iterations, factorisations."""
        return dict(self.summary.get("counts", {}))

    @functools.cached_property
    def jacobian(self) -> np.ndarray:
        """The derivative of the last state with respect to the first, shape (dimension, dimension), through all steps.

        It is that of the map that the steps make. Where the motion passes a jump of its rates, as at a pfaff.where, that is not
        the derivative of the motion, which a JumpWarning says of systems that have branches.

        InputError for a run whose method chose its steps.
        """
        if self._asked["tolerance"]:
            raise InputError("jacobian: expected a run with steps of one size")
        warn_of_jumps(as_system(self.system), "jacobian", 3)  # a property that is kept is asked for by functools
        it = self._integration(self.system, self._initial, self._asked["precision"])
        return it._jacobian(self.summary.get("completed", self._steps))[1]

    def sensitivity(self, parameter: str) -> np.ndarray:
        """The derivative of the last state with respect to a parameter of the system, shape (dimension,), of the run as a whole.

        The state at the start moves along where it depends on the parameter: the system's own one, momenta of velocities, and
        a state that is moved onto the constraints. What was given in numbers stays: a state, the times and the step.

        It is a difference of two runs in quad precision, to both sides, of which 1e-10 of the parameter is the step: its error
        is about 1e-20 of the third derivative, and the result as good as one of derivatives through the steps. At an end
        of the parameter's range it is one to a single side, of three runs, which is as good. It is of the map that the steps
        make: of jumps of the rates the same holds as of the jacobian.

        >>> import pfaff
        >>> run = pfaff.run("kepler", "gauss", eccentricity=0.3, step=0.05, time=5)
        >>> more, less = (pfaff.run("kepler", "gauss", eccentricity=e, step=0.05, time=5).y[-1] for e in (0.3001, 0.2999))
        >>> bool(abs(run.sensitivity("eccentricity") - (more - less) / 0.0002).max() < 1e-5)
        True

        Raises:
            InputError: an unknown parameter, one that is no real number, and a run whose method chose its steps or has
                coefficients in double only.
        """
        if self._asked["tolerance"]:
            raise InputError("sensitivity: expected a run with steps of one size")
        try:
            self._begun_in_quad(as_system(self.system))
        except InputError as error:
            reason = str(error).partition("; expected")[0]
            raise InputError(f"sensitivity: it is a difference of runs in quad precision, and {reason}; expected a method that runs in quad") from None
        warn_of_jumps(as_system(self.system), "sensitivity", 2)
        return sensitivity_of(as_system(self.system), parameter, self._end_of)

    def _begun_in_quad(self, system: Any) -> Any:
        return _pfaff.RunInProgress(system.model, self.method.instance, {**self._asked, "precision": "quad", "measures": [], "out": ""})

    def _end_of(self, system: Any) -> tuple[decimal.Decimal, ...]:
        """The last state that the run has with another system, in quad precision."""
        start = self._begun_in_quad(system).samples()["initial"]
        it = self._integration(system, start, "quad")
        it.steps(self.summary.get("completed", self._steps))
        return it.decimals

    def _integration(self, system: Any, start: list[str], precision: str) -> Integration:
        return Integration(system, self.method, step=self._step, initial=start, t0=self._t0, precision=precision, formulation=self._asked["formulation"])

    def __getitem__(self, name: str) -> np.ndarray:
        if not isinstance(name, str):
            raise KeyError(unknown("column", name, self.coordinates))
        if name in self.coordinates:
            return self.y[:, self.coordinates.index(name)]
        block = [k for k, one in enumerate(self.coordinates) if re.fullmatch(re.escape(name) + r"\d+", one)]
        if block:
            return self.y[:, block[0] : block[-1] + 1] if block == list(range(block[0], block[-1] + 1)) else self.y[:, block]
        if name in self.invariants:
            return self.invariants[name]
        raise KeyError(unknown("column", name, [*self.coordinates, *self.invariants]))

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each sample: t, the coordinates, invariants, residuals of constraints, and the error where there is one."""
        columns = {"t": self.t, **dict(zip(self.coordinates, self.y.T)), **self.invariants, **self.constraints}
        if self.error is not None:
            columns["error"] = self.error
        return data_frame(list(columns), list(zip(*columns.values())), {**self.units, **dict.fromkeys(self.constraints, "1")})

    def plot(self, kind: str = "trajectory", **keywords: Any) -> Any:
        """Draws the run in the style of the report, and returns matplotlib's axes, or an animation.

        The kinds are "trajectory", "phase portrait", "drift", "constraints", "structure residual", "error", "animation" and
        "MEASURE: COLUMN" of the measures that were asked for; `pfaff.plots` has what each takes besides. All but animations take
        `axes`, which may have curves of other runs, and `label`, which stands before the entries of the legend.

        An animation shows beads and the rods that constraints are, and registered pendula; of other systems `positions` says
        where something is, a function of a state that gives places, shape (bodies, 2 or 3), and `rods` what joins it.

        >>> import matplotlib, pfaff
        >>> matplotlib.use("agg")
        >>> pfaff.run("pendulum", "verlet", step=0.1, time=10).plot("drift").get_xlabel()
        't [s]'

        Raises:
            InputError: an unknown kind or argument, and a kind that the run has nothing for.
            ImportError: matplotlib is not installed.
        """
        from . import plots

        return plots.of_run(self, kind, **keywords)

    def __repr__(self) -> str:
        return text_of(self)

    def _repr_html_(self) -> str:
        return html_of(self)

    def __getstate__(self) -> dict[str, Any]:
        _ = self.summary
        state = dict(self.__dict__)
        for key in ("system", "method"):
            try:
                pickle.dumps(state[key])
            except (pickle.PicklingError, AttributeError, TypeError):
                state[key] = Unavailable(state[key].name)  # its samples are worth keeping without it
        return state


class Unavailable:
    """A system or a method of a pickled run that could not be pickled itself: its name is what is left."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __repr__(self) -> str:
        return f"<{self.name}, which was not pickled>"


def run(system: Any, method: Any, *, step: Any = None, tolerance: Any = None, time: Any = None, every: int = 0, initial: Any = None, initial_velocities: Any = None, t0: Any = 0,
        absolute: Any = (), precision: str = "double", reference: str | None = "exact", measures: Sequence[str | Callable[[Run], Any]] = (), structure: bool = True,
        project_initial: bool = False, allow_inconsistent: bool = False, formulation: str | None = None, out: Any = None, force: bool = False, system_parameters: Mapping[str, Any] | None = None,
        method_parameters: Mapping[str, Any] | None = None, **parameters: Any) -> Run:
    """Runs a method on a system, and measures what drifts and what it costs, as `pfaff run` does.

    >>> import pfaff
    >>> result = pfaff.run("kepler", "gauss", stages=3, eccentricity=0.3, step=0.05, time=100)
    >>> result.y.shape, result["q"].shape, result.drift["energy"]["class"]
    ((1001, 4), (1001, 2), 'bounded')

    Args:
        system: a name, the path of a text model, or a pfaff.System.
        method: a name, the path of a table, a dictionary of coefficients, or a pfaff.Method.
        step: the step, > 0; or `tolerance`, for a method that chooses its steps: the error of a step in each coordinate,
            relative to the largest size that the coordinate has had so far in the motion.
        time: the duration; a negative one goes back in time. The last whole step ends within it, which the run says where
            it is no multiple of the step.
        every: the steps between two samples; 0 chooses for about a thousand samples.
        initial: the state, shape (dimension,); without it the system's own.
        initial_velocities: beside it, with the positions alone: the velocities, from which the momenta follow.
        t0: the time at the start.
        absolute: absolute tolerances beside `tolerance`, one number or one for each coordinate.
        precision: "double", or "quad" with 113 bits; samples are doubles in both, drift and errors are found in quad.
        reference: what errors are measured against: "exact", the system's own solution where it has one; "solution",
            that or Taylor series in quad; None. "solution,every" measures them at every sample, else at 200 at most.
        measures: names of measures (`pfaff list measures`), whose tables are in `measures` of the result; and functions
            of the run that give an array of shape (rows,), or a dictionary of such arrays.
        structure: measure the residual of the structure of steps, where the system has one.
        project_initial: move an initial state that is off the constraints onto them.
        allow_inconsistent: or take it as it is.
        formulation: of a system with constraints, for a method that needs a vector field, with parameters or without,
            such as "lmm(friction-form=metriplectic)"; without it the usual one.
        out: a directory in which the samples, series.csv, and the summary, summary.json, are left; with a registered
            method also what `pfaff run --config` makes the run again from, config.toml, and a system written in
            Python as the text model system.toml. A directory that holds another run, or a longer one, is refused
            unless `force` is true, which replaces it.
        system_parameters, method_parameters: dictionaries, where both know a name.
        **parameters: of the system or the method, by their names.

    Returns:
        A Run, with samples as NumPy arrays.

    Raises:
        InputError: whatever does not fit, before work starts.
        NotConverged, RunFailed: a step failed.
        Interrupted: Ctrl-C was pressed.

    Warns:
        InvariantWarning: what is said to be conserved is not, at the initial state or near it.

    All but InputError have the Run with the samples so far as their attribute `run`.
    """
    base, tool = with_parameters(system, method, parameters, system_parameters, method_parameters)
    if time is None:
        raise InputError("time: expected the duration of the run")
    wanted = listed_measures(measures)
    asked = asked_run(
        base, tool, step=step, tolerance=tolerance, time=time, every=every, initial=initial, initial_velocities=initial_velocities, t0=t0,
        absolute=absolute, precision=precision, reference=reference, measures=wanted, structure=structure, project_initial=project_initial,
        allow_inconsistent=allow_inconsistent, formulation=formulation, out=out, force=force)
    going = _pfaff.RunInProgress(base.model, tool.instance, asked)
    if going.not_conserved:
        warnings.warn(going.not_conserved, InvariantWarning, stacklevel=2)
    try:
        going.execute()
    except InputError:
        raise
    except BaseException as error:
        attach(error, Run(base, tool, going, asked, error))
        raise
    result = Run(base, tool, going, asked)
    try:
        for function in wanted:
            if callable(function):
                result.measures[name_of(function)] = _measured(function, result)
    except BaseException as error:
        attach(error, result)
        raise
    if result.status != "converged":
        failed = (RunFailed if result.status == "non_finite" else NotConverged)(result.message)
        attach(failed, result)
        raise failed
    return result


def _measured(function: Callable[[Run], Any], result: Run) -> MeasureTable:
    """The table of a measure that is a function of the run."""
    given, measure = function(result), name_of(function)
    columns = dict(given) if isinstance(given, Mapping) else {measure: given}
    table = {"t": result.t}
    for name, values in columns.items():
        expected = f"{len(result.t)} numbers of {name}, one for each sample"
        table[name] = real_array(values, f"measure {measure}", expected)
        if table[name].shape != result.t.shape:
            raise InputError(f"measure {measure}: expected {expected}, got shape {table[name].shape}")
    return MeasureTable(measure, table, {"t": result.units["t"], **dict.fromkeys(columns, "")})
