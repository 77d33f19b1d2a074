"""Many initial states at once."""
from __future__ import annotations

import html
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _pfaff
from ._arguments import function, real_array, whole
from ._errors import InputError
from ._integration import asked_steps, attach, with_parameters
from ._tables import data_frame

if TYPE_CHECKING:
    import pandas


@dataclass(slots=True, repr=False)
class Ensemble:
    """Trajectories from many initial states."""

    system: str
    """The name of the system."""
    method: str
    """The name of the method."""
    coordinates: tuple[str, ...]
    """The names of the coordinates."""

    t: np.ndarray
    """The times of the rows, shape (rows,); the first is that of the start."""
    y: np.ndarray
    """The states, shape (N, rows, dimension), as doubles; NaN behind the end of a trajectory that ended early.

    Where something was raised, N is the number of those that were begun."""
    failures: dict[int, str]
    """Why trajectories ended early, by their index."""
    done: np.ndarray
    """Which of these have come to their end or to their failure, shape (N,): all unless something was raised."""

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame with a row for each row of each trajectory: its index, t and the coordinates."""
        count, rows, n = self.y.shape
        columns = [np.repeat(np.arange(count), rows), np.tile(self.t, count), *self.y.reshape(-1, n).T]
        return data_frame(("trajectory", "t", *self.coordinates), list(zip(*columns)))

    def __repr__(self) -> str:
        rows = self.y.shape[1]
        text = f"ensemble of {self.system} by {self.method}: {len(self.y)} trajectories, t = {self.t[0]:g} .. {self.t[-1]:g}, {rows} rows each"
        if not self.done.all():
            text += f"; {int(self.done.sum())} of them came to their end"
        if self.failures:
            first = min(self.failures)
            text += f"; {len(self.failures)} ended early, number {first}: {self.failures[first]}"
        return text

    def _repr_html_(self) -> str:
        return f"<p>{html.escape(repr(self))}</p>"


def ensemble(system: Any, method: Any, states: Any, *, step: Any, steps: int, every: int = 0, t0: Any = 0, tolerance: Any = None, absolute: Any = (),
             scales: str = "motion", threads: int | None = None, callback: Callable[[int], Any] | None = None, precision: str = "double",
             system_parameters: Mapping[str, Any] | None = None, method_parameters: Mapping[str, Any] | None = None, **parameters: Any) -> Ensemble:
    """Takes `steps` steps from each of many initial states, over threads and without Python.

    >>> import numpy as np, pfaff
    >>> states = np.random.default_rng(1).normal(scale=0.1, size=(100, 4))
    >>> pfaff.ensemble("henon-heiles", "verlet", states, step=0.01, steps=1000, every=100).y.shape
    (100, 11, 4)

    Each trajectory has the bits that an Integration from its state has; none depends on the number of threads.

    Args:
        system, method: names, paths, or objects.
        states: initial states, shape (N, dimension), converted to doubles; in quad they stand for the decimals that they are
            printed as.
        step, steps, t0: the step, how many, and the time at the start; with a tolerance `step` is a length of time, of which there
            are so many, and the method chooses its steps in between.
        every: the steps between two rows; 0 keeps the start and the end alone.
        tolerance, absolute, scales: for methods that choose their steps, as of an Integration.
        threads: how many; without it as many as the process may use.
        callback: called with the index of each trajectory that has ended, from any of the threads.
        precision: "double", or "quad" with 113 bits; the rows are doubles in both.
        system_parameters, method_parameters: dictionaries, where both know a name.
        **parameters: of the system or the method, by their names.

    Raises:
        InputError: a method that does not fit, wrong shapes, and a first state that cannot be begun at.
        Interrupted: Ctrl-C was pressed.

    Whatever is raised, by the callback too, has the Ensemble so far as its attribute `run`: the trajectories that were begun.
    """
    base, tool = with_parameters(system, method, parameters, system_parameters, method_parameters)
    asked = asked_steps(step=step, t0=t0, tolerance=tolerance, absolute=absolute, scales=scales, precision=precision, formulation=None)
    array = real_array(states, "states", f"real numbers, an array of shape (N, {base.dimension})")
    if array.ndim != 2 or array.shape[1] != base.dimension:
        raise InputError(f"states: expected shape (N, {base.dimension}), got {array.shape}")
    count = whole(steps, "steps", 1)
    stride = whole(every, "every", 0) or count
    if stride > count:
        raise InputError(f"every: expected at most {count}, the number of steps, got {stride}")
    workers = whole(threads, "threads", 1) if threads is not None else len(os.sched_getaffinity(0))
    if callback is not None:
        function(callback, "callback", "a function of the index of a trajectory")
    described, made = (base.name, tool.name, base.coordinates), dict[str, Any]()
    try:
        _pfaff.ensemble(base.model, tool.instance, asked, array, count, stride, workers, callback, made)
    except InputError:
        raise
    except BaseException as error:
        if made:
            attach(error, Ensemble(*described, **made))
        raise
    return Ensemble(*described, **made)
