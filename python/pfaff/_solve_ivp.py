"""solve_ivp: SciPy's call, for any method of Pfaff."""
from __future__ import annotations

import inspect
import math
import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _pfaff
from ._arguments import real_array, shown, whole, yes_or_no
from ._errors import InputError, NotConverged, RunFailed
from ._halving import FEWEST_STEPS, integration_from, states_at, steps_that_meet
from ._integration import Integration
from ._method import Method
from ._numbers import float_of_number, texts_of_coordinates
from ._objects import as_method, as_system
from ._system import System
from ._tracing import flat, place_of

if TYPE_CHECKING:
    from scipy.integrate._ivp.ivp import OdeResult

# The steps that may be taken where nothing is said, fewer of fields of more operations than these: some minutes' work.
_MOST_STEPS, _OPERATIONS = 2**24, 256


def solve_ivp(
    fun: Callable[..., Any] | str | System, t_span: Sequence[float], y0: Sequence[float] | None = None, method: str | Method = "gauss",
    t_eval: Sequence[float] | None = None, dense_output: bool = False, events: Any = None, vectorized: bool = False,
    args: Sequence[Any] | None = None, *, rtol: float = 1e-3, atol: float | Sequence[float] = 1e-6, step: float | None = None,
    most_steps: int | None = None, **parameters: Any
) -> OdeResult:
    """Solves y' = fun(t, y), y(t_span[0]) = y0, as scipy.integrate.solve_ivp does, by any method of Pfaff.

    Methods with fixed steps keep one step from beginning to end, on which the structure that they keep rests. Without
    `step` it is chosen: it is halved until the error, estimated from three runs, meets the tolerances, and a run in other
    steps agrees, since a jump of fun may escape steps that are halves of each other. A state at a time of `t_eval` between
    two steps is that after one shorter step from the last of them, beside the integration, which goes on in its own steps.
    Methods that choose their steps take `rtol` and `atol` as SciPy's do.

    Args:
        fun: fun(t, y, *args) gives the rates, shape (n,). It is called a few times, with numbers that record what is done
            with them, and then runs at the speed of C++: NumPy's functions and operators work, `math` and comparisons of
            values do not (`pfaff.where` stands for them). Instead of a function a system: its name, the path of a text
            model or a `pfaff.System`, which methods that need its energies can step on.
        t_span: (begin, end); the end may lie before the begin.
        y0: the state at the begin, shape (n,); of a system its own without it.
        method: a name, the path of a table, or a `pfaff.Method`.
        t_eval: the times at which states are wanted, in order; without it those of all steps, or of a method that chooses its steps
            101 at even distances.
        dense_output, events: refused; `t_eval` and `pfaff.Integration.watch` take their places.
        vectorized: not used, since fun is not called again.
        args: further arguments of fun.
        rtol, atol: the error of a component y_i is to be below atol + rtol |y_i|.
        step: the size of a fixed step; the end of the span is reached in whole steps of at most this size.
        most_steps: how many steps a run may take, 16 or more. Without it 2**24, and of a field of more than 256 operations fewer. A
            method that chooses its steps ends where it has taken them, and the result says so; no more fixed ones are tried.
        **parameters: of the method, such as stages=3. SciPy's max_step, first_step and jac are refused with what takes their places.

    Returns:
        SciPy's result: t, shape (points,), y, shape (n, points), success, status (0, or -1 where a step failed), message,
        nfev, njev and nlu of the run whose states these are, without the runs that found its step, and besides `step`, the step
        that was taken; None of a method that chooses its steps. Where a
        step failed, t and y have what there was by then.

    Raises:
        InputError: wrong arguments, and a method that does not fit.
        TraceError: fun compares values, calls `math` or returns something else each time.
        RunFailed: without `step`, no step meets the tolerances within `most_steps`.
        ImportError: SciPy is not installed.

    >>> import pfaff
    >>> result = pfaff.solve_ivp(lambda t, y: [y[1], -y[0]], (0, 6.283185307179586), [1, 0], "gauss", rtol=1e-9, atol=1e-9)
    >>> result.success, bool(abs(result.y[0, -1] - 1) < 1e-8)
    (True, True)
    """
    result_type = _result_type()
    _refuse(dense_output, events, parameters)
    yes_or_no(vectorized, "vectorized")
    begin, end = _span(t_span)
    system, state = _system_and_state(fun, y0, args)
    chosen = as_method(method, **parameters)
    times = None if t_eval is None else _times(t_eval, begin, end)
    relative, absolute = _tolerances(rtol, atol, len(state))
    size = None if step is None else float_of_number(step, "step", "a size above 0", above=0)
    most = _most_steps(system) if most_steps is None else whole(most_steps, "most_steps", FEWEST_STEPS)
    if chosen.adaptive and size is None:
        return _adaptive(result_type, system, chosen, state, begin, end, times, relative, absolute, most)
    if size is None:
        count = steps_that_meet(system, chosen, state, begin, end, relative, absolute, most)
    else:
        wanted = abs(end - begin) / size * (1 - 1e-12)
        if wanted > most:
            raise InputError(f"step: {size} makes {wanted:.4g} steps, more than {most}; expected a larger one, or most_steps=, how many may be taken")
        count = max(1, math.ceil(wanted))
    return _fixed(result_type, system, chosen, state, begin, end, times, count)


def _result_type() -> Any:
    try:
        from scipy.integrate._ivp.ivp import OdeResult  # SciPy has no public name for it
    except ImportError:
        raise ImportError("solve_ivp needs SciPy, which is not installed (Debian's python3-scipy)") from None
    return OdeResult


# Options of SciPy's methods that no method here has, and what to do instead.
_INSTEAD = {
    "max_step": "expected step=, the size of all steps",
    "first_step": "expected step=, the size of all steps",
    "min_step": "expected most_steps=, how many steps may be taken",
    "jac": "expected nothing, since derivatives are taken of fun itself",
    "jac_sparsity": "expected nothing, since derivatives are taken of fun itself",
    "lband": "expected nothing, since derivatives are taken of fun itself",
    "uband": "expected nothing, since derivatives are taken of fun itself",
}


def _refuse(dense_output: bool, events: Any, options: Mapping[str, Any]) -> None:
    for key in options:
        if key in _INSTEAD:
            raise InputError(f"{key}: not there; {_INSTEAD[key]}")
    if events is not None:
        raise InputError("events: not there; expected pfaff.Integration with watch(callback), which ends where the callback gives True")
    if yes_or_no(dense_output, "dense_output"):
        raise InputError("dense_output: not there, since a polynomial between steps keeps nothing; expected t_eval, the times wanted")


def _span(t_span: Sequence[float]) -> tuple[float, float]:
    span = real_array(t_span, "t_span", "two different finite times")
    if span.shape != (2,) or not np.isfinite(span).all() or span[0] == span[1]:
        raise InputError(f"t_span: expected two different finite times, got {shown(t_span)}")
    return float(span[0]), float(span[1])


def _times(t_eval: Sequence[float], begin: float, end: float) -> np.ndarray:
    expected = f"times in {begin} .. {end}, shape (points,), in the order of the span, each once"
    times = real_array(t_eval, "t_eval", expected)
    ahead = (times - begin) * np.sign(end - begin)
    if times.ndim != 1 or not ((ahead >= 0) & (ahead <= abs(end - begin))).all() or (np.diff(ahead) <= 0).any():
        raise InputError(f"t_eval: expected {expected}, got {shown(t_eval)}")
    return times


def _tolerances(rtol: float, atol: float | Sequence[float], size: int) -> tuple[float, np.ndarray]:
    relative, expected = float_of_number(rtol, "rtol", "a number above 0", above=0), f"a number >= 0, or {size} of them"
    if relative < np.finfo(float).eps:
        raise InputError(f"rtol: {relative} is below round-off, which is {np.finfo(float).eps:.3g}; expected at least that")
    absolute = real_array(atol, "atol", expected)
    if absolute.ndim > 1 or absolute.size not in (1, size) or not (np.isfinite(absolute) & (absolute >= 0)).all():
        raise InputError(f"atol: expected {expected}, got {shown(atol)}")
    return relative, np.broadcast_to(absolute, (size,))


def _system_and_state(fun: Any, y0: Any, args: Any) -> tuple[System, np.ndarray]:
    """The system itself, or that whose vector field the function is, and the state at the begin."""
    if args is not None and not isinstance(args, (list, tuple)):
        raise InputError(f"args: expected a tuple of further arguments of fun, such as (2.0,), got {shown(args)}")
    if callable(fun) and not isinstance(fun, (System, type)):
        expected = "real numbers, all finite, shape (n,)"
        state = real_array(y0, "y0", expected)
        if state.ndim != 1 or state.size == 0 or not np.isfinite(state).all():
            raise InputError(f"y0: expected {expected}, got {shown(y0)}")
        return _system_of(fun, state, tuple(args or ())), state
    if not isinstance(fun, (str, os.PathLike, System, type)):
        raise InputError(f"fun: expected a function of (t, y) or a system, got {shown(fun)}")
    if args is not None:
        raise InputError("args: expected them beside a function alone; a system has parameters")
    system = as_system(fun, "fun")
    if y0 is None and not len(system.initial):
        raise InputError(f"y0: expected {system.dimension} numbers, because {system.name} has no initial state of its own")
    if y0 is None:
        return system, system.initial
    return system, np.array([float_of_number(text, "y0") for text in texts_of_coordinates(y0, "y0", system.coordinates)])


def _system_of(fun: Callable[..., Any], state: np.ndarray, extra: tuple[Any, ...]) -> System:
    """The system whose vector field a function is."""
    what = f"{place_of(fun)}fun"
    try:
        inspect.signature(fun).bind(0, state, *extra)
    except TypeError as error:
        further = f" and what args has, {len(extra)}" if extra else ""
        raise InputError(f"{what}: expected a function of t and y{further}: {error}") from None
    except ValueError:
        pass  # some functions that are written in C do not tell their arguments

    def field(self: Any, t: Any, z: Any) -> list:
        rates = flat(fun(t, z, *extra), what)
        if len(rates) != len(state):
            raise InputError(f"{what} returned a list of length {len(rates)}; expected {len(state)}, a rate for each number of y0")
        return rates

    # What is said of the field names the line of the user's function; its arguments are those of the field.
    for name, value in (("__signature__", inspect.signature(field)), ("__wrapped__", fun)):
        setattr(field, name, value)
    members = {
        "__doc__": "The vector field of a call of solve_ivp.",
        "__module__": __name__,
        "coordinates": [f"y{k + 1}" for k in range(len(state))],
        "initial": [float(x) for x in state],
        "field": field,
    }
    return type("SolveIvp", (System,), members)()


def _most_steps(system: System) -> int:
    """The steps that may be taken where nothing is said."""
    formulas = _pfaff.formulas_of_problems()["field"][1]
    operations = _pfaff.formula_of(system.model, "field").operations if set(formulas) & set(system.facets) else 0
    return max(1024, _MOST_STEPS * _OPERATIONS // max(_OPERATIONS, operations))


def _fixed(
    result_type: Any, system: System, method: Method, state: np.ndarray, begin: float, end: float, times: np.ndarray | None, count: int
) -> OdeResult:
    size = (end - begin) / count
    integration = integration_from(system, method, state, begin, step=size)
    if times is None:
        message = ""
        try:
            outcome = integration.steps(count, every=1)
        except (NotConverged, RunFailed) as error:
            outcome, message = error.run, str(error)
        t, y = np.concatenate([[begin], outcome.t]), np.concatenate([state[None, :], outcome.y])
        return _result(result_type, t, y, message, integration, size)
    rows, message = [], ""
    try:
        for row in states_at(integration, times, begin, size, count):
            rows.append(row)
    except (NotConverged, RunFailed) as error:
        message = str(error)
    return _result(result_type, times[: len(rows)], np.array(rows).reshape(len(rows), len(state)), message, integration, size)


def _adaptive(
    result_type: Any, system: System, method: Method, state: np.ndarray, begin: float, end: float, times: np.ndarray | None,
    rtol: float, atol: np.ndarray, most: int
) -> OdeResult:
    if rtol > 1:
        raise InputError(f"rtol: expected a number in (0, 1] for {method.name}, got {rtol}")
    if times is None:
        times = np.linspace(begin, end, 101)
    integration = integration_from(system, method, state, begin, step=end - begin, tolerance=rtol, absolute=[float(x) for x in atol], scales="step")
    integration._it.allowed = most
    reached, rows, message = [], [], ""
    for time in times:
        try:
            if time != begin:
                integration.to(float(time))
        except (NotConverged, RunFailed) as error:
            message = str(error)
            if integration._it.allowed == 0:
                message = (f"{most} steps were taken by t = {integration.time:.10g}, as happens at a singularity and, with explicit methods, where the "
                           "motion is stiff; expected a t_span that ends before, larger rtol and atol, an implicit method, or most_steps=, how many "
                           "may be taken")
            break
        reached.append(time)
        rows.append(integration.state)
    return _result(result_type, np.array(reached), np.array(rows).reshape(len(rows), len(state)), message, integration, None)


def _result(
    result_type: Any, t: np.ndarray, y: np.ndarray, message: str, integration: Integration, size: float | None
) -> OdeResult:
    work = integration.counters
    return result_type(
        t=t, y=y.T, sol=None, t_events=None, y_events=None, nfev=work["right_hand_sides"], njev=work["jacobians"], nlu=work["factorisations"],
        status=-1 if message else 0, message=message or "The solver successfully reached the end of the integration interval.",
        success=not message, step=size,
    )
