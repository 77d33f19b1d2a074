"""solve_ivp: SciPy's call, for any method of Pfaff."""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import InputError, NotConverged, RunFailed
from ._integration import Integration
from ._method import Method
from ._objects import as_method, as_system
from ._system import System

if TYPE_CHECKING:
    from scipy.integrate._ivp.ivp import OdeResult

# A step is chosen by comparing states at so many times, spread evenly.
_COMPARED = 16
# More steps than these are not tried when a step is chosen.
_MOST_STEPS = 2**24


def solve_ivp(
    fun: Callable[..., Any] | str | System, t_span: Sequence[float], y0: Sequence[float] | None = None, method: str | Method = "gauss",
    t_eval: Sequence[float] | None = None, dense_output: bool = False, events: Any = None, vectorized: bool = False,
    args: Sequence[Any] | None = None, *, rtol: float = 1e-3, atol: float | Sequence[float] = 1e-6, step: float | None = None,
    **parameters: Any
) -> OdeResult:
    """Solves y' = fun(t, y), y(t_span[0]) = y0, as scipy.integrate.solve_ivp does, by any method of Pfaff.

    Methods with fixed steps keep one step from beginning to end, on which the structure that they keep rests. Without
    `step` it is chosen: it is halved until the error, estimated from two runs, meets the tolerances. A state at a time of
    `t_eval` between two steps is that after one shorter step from the last of them, beside the integration, which goes on
    in its own steps. Methods that choose their steps take `rtol` and `atol` as SciPy's do.

    Args:
        fun: fun(t, y, *args) gives the rates, shape (n,). It is called a few times, with numbers that record what is done
            with them, and then runs at the speed of C++: NumPy's functions and operators work, `math` and comparisons of
            values do not (`pfaff.where` stands for them). Instead of a function a system: its name, the path of a text
            model or a `pfaff.System`, which methods that need its energies can step on.
        t_span: (begin, end); the end may lie before the begin.
        y0: the state at the begin, shape (n,); of a system its own without it.
        method: a name, the path of a table, or a `pfaff.Method`.
        t_eval: the times at which states are wanted, in order; all steps without it.
        dense_output, events: refused; `t_eval` and `pfaff.Integration.watch` take their places.
        vectorized: not used, since fun is not called again.
        args: further arguments of fun.
        rtol, atol: the error of a component y_i is to be below atol + rtol |y_i|.
        step: the size of a fixed step; the end of the span is reached in whole steps of at most this size.
        **parameters: of the method, such as stages=3.

    Returns:
        SciPy's result: t, shape (points,), y, shape (n, points), success, status (0, or -1 where a step failed), message,
        nfev, njev, nlu, and besides `step`, the step that was taken; None of a method that chooses its steps. Where a
        step failed, t and y have what there was by then.

    Raises:
        InputError: wrong arguments, and a method that does not fit.
        TraceError: fun compares values, calls `math` or returns something else each time.
        ImportError: SciPy is not installed.

    >>> import pfaff
    >>> result = pfaff.solve_ivp(lambda t, y: [y[1], -y[0]], (0, 6.283185307179586), [1, 0], "gauss", rtol=1e-9, atol=1e-9)
    >>> result.success, bool(abs(result.y[0, -1] - 1) < 1e-8)
    (True, True)
    """
    result_type = _result_type()
    _refuse(dense_output, events)
    begin, end = _span(t_span)
    system = _system(fun, y0, args)
    state = system.initial if y0 is None else np.asarray(y0, float)
    chosen = as_method(method, **parameters)
    times = None if t_eval is None else _times(t_eval, begin, end)
    relative, absolute = _tolerances(rtol, atol, len(state))
    if step is not None and not step > 0:
        raise InputError(f"step: expected a size above 0, got {step}")
    if chosen.adaptive and step is None:
        return _adaptive(result_type, system, chosen, state, begin, end, times, relative, absolute)
    if step is None:
        count = _steps(system, chosen, state, begin, end, relative, absolute)
    else:
        count = max(1, math.ceil(abs(end - begin) / step * (1 - 1e-12)))
    return _fixed(result_type, system, chosen, state, begin, end, times, count)


def _result_type() -> Any:
    try:
        from scipy.integrate._ivp.ivp import OdeResult  # SciPy has no public name for it
    except ImportError:
        raise ImportError("solve_ivp needs SciPy, which is not installed (Debian's python3-scipy)") from None
    return OdeResult


def _refuse(dense_output: bool, events: Any) -> None:
    if events is not None:
        raise InputError("events: not there; expected pfaff.Integration with watch(callback), which ends where the callback gives True")
    if dense_output:
        raise InputError("dense_output: not there, since a polynomial between steps keeps nothing; expected t_eval, the times wanted")


def _span(t_span: Sequence[float]) -> tuple[float, float]:
    span = np.asarray(t_span, float)
    if span.shape != (2,) or not np.isfinite(span).all() or span[0] == span[1]:
        raise InputError(f"t_span: expected two different finite times, got {t_span!r}")
    return float(span[0]), float(span[1])


def _times(t_eval: Sequence[float], begin: float, end: float) -> np.ndarray:
    times = np.asarray(t_eval, float)
    ahead = (times - begin) * np.sign(end - begin)
    if times.ndim != 1 or (ahead < 0).any() or (ahead > abs(end - begin)).any() or (np.diff(ahead) <= 0).any():
        raise InputError(f"t_eval: expected times in {begin} .. {end}, shape (points,), in the order of the span, each once")
    return times


def _tolerances(rtol: float, atol: float | Sequence[float], size: int) -> tuple[float, np.ndarray]:
    absolute = np.asarray(atol, float)
    if not (isinstance(rtol, (int, float, np.floating)) and rtol > 0) or absolute.ndim > 1 or absolute.size not in (1, size) or not (absolute >= 0).all():
        raise InputError(f"rtol, atol: expected rtol > 0 and atol >= 0, one number or {size}, got {rtol!r} and {atol!r}")
    return float(rtol), np.broadcast_to(absolute, (size,))


def _system(fun: Any, y0: Any, args: Sequence[Any] | None) -> System:
    """The system itself, or that whose vector field the function is."""
    if not callable(fun) or isinstance(fun, (System, type)):
        if args is not None:
            raise InputError("args: expected them beside a function alone; a system has parameters")
        return as_system(fun)
    state = np.asarray(y0 if y0 is not None else [])
    if state.ndim != 1 or state.size == 0 or state.dtype.kind not in "iuf":
        raise InputError(f"y0: expected real numbers, shape (n,), got {y0!r}")
    extra = tuple(args) if args is not None else ()
    members = {
        "__doc__": "The vector field of a call of solve_ivp.",
        "__module__": __name__,
        "coordinates": [f"y{k + 1}" for k in range(len(state))],
        "initial": [float(x) for x in state],
        "field": lambda self, t, z: fun(t, z, *extra),
    }
    return type("SolveIvp", (System,), members)()


def _integration(system: System, method: Method, state: np.ndarray, begin: float, **how: Any) -> Integration:
    return Integration(system, method, initial=[float(x) for x in state], t0=begin, **how)


def _steps(
    system: System, method: Method, state: np.ndarray, begin: float, end: float, rtol: float, atol: np.ndarray
) -> int:
    """The least number of steps, a power of two times _COMPARED, whose estimated error meets the tolerances.

    The error of the longer of two steps is 2^p/(2^p - 1) times what both differ by, and that of the shorter one 1/(2^p - 1)
    times, p the order of the method.
    """
    order = method.order(system)
    if order < 1:
        raise InputError(f"step: expected one, because {method.name} claims no order on {system.name} by which it could be chosen")
    count, before = _COMPARED, None
    while count <= _MOST_STEPS:
        integration = _integration(system, method, state, begin, step=(end - begin) / count)
        try:
            now = integration.steps(count, every=count // _COMPARED).y
        except (NotConverged, RunFailed):
            now = None
        if now is not None and before is not None:
            error = np.abs(now - before) / (2**order - 1)
            if (error <= atol + rtol * np.abs(now)).all():
                return count
        count, before = 2 * count, now
    raise RunFailed(f"solve_ivp: no step of {method.name} down to {abs(end - begin) / _MOST_STEPS:.3g} meets the tolerances; expected larger ones, or a step")


def _fixed(
    result_type: Any, system: System, method: Method, state: np.ndarray, begin: float, end: float, times: np.ndarray | None, count: int
) -> OdeResult:
    size = (end - begin) / count
    integration = _integration(system, method, state, begin, step=size)
    if times is None:
        message = ""
        try:
            outcome = integration.steps(count, every=1)
        except (NotConverged, RunFailed) as error:
            outcome, message = error.run, str(error)
        t, y = np.concatenate([[begin], outcome.t]), np.concatenate([state[None, :], outcome.y])
        return _result(result_type, t, y, message, integration, size)
    reached, rows, message = [], [], ""
    for time in times:
        whole = min(count, math.floor((time - begin) / size * (1 + 1e-12)))
        try:
            integration.steps(whole - integration.steps_taken)
            row, rest = integration.state, time - (begin + whole * size)
            if abs(rest) > 1e-9 * abs(size):
                beside = integration.beside(row)
                beside.go_on_from(row, t0=begin + whole * size, step=rest)
                beside.steps(1)
                row = beside.state
        except (NotConverged, RunFailed) as error:
            message = str(error)
            break
        reached.append(time)
        rows.append(row)
    return _result(result_type, np.array(reached), np.array(rows).reshape(len(rows), len(state)), message, integration, size)


def _adaptive(
    result_type: Any, system: System, method: Method, state: np.ndarray, begin: float, end: float, times: np.ndarray | None,
    rtol: float, atol: np.ndarray
) -> OdeResult:
    if times is None:
        times = np.linspace(begin, end, 101)
    integration = _integration(system, method, state, begin, step=end - begin, tolerance=rtol, absolute=[float(x) for x in atol])
    reached, rows, message = [], [], ""
    for time in times:
        try:
            if time != begin:
                integration.to(float(time))
        except (NotConverged, RunFailed) as error:
            message = str(error)
            break
        reached.append(time)
        rows.append(integration.state)
    return _result(result_type, np.array(reached), np.array(rows).reshape(len(rows), len(state)), message, integration, None)


def _result(
    result_type: Any, t: np.ndarray, y: np.ndarray, message: str, integration: Integration, size: float | None
) -> OdeResult:
    work = integration.counters
    return result_type(
        t=t, y=y.T, sol=None, t_events=None, y_events=None, nfev=work["fields"], njev=work["jacobians"], nlu=work["factorisations"],
        status=-1 if message else 0, message=message or "The solver successfully reached the end of the integration interval.",
        success=not message, step=size,
    )
