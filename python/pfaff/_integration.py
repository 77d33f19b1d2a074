"""An integration as an object: a system, a method, a state and the time that it has reached."""
from __future__ import annotations

import decimal
import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _pfaff
from ._arguments import dictionary_or_none, function, text, unknown, whole
from ._errors import InputError, NotConverged, RunFailed
from ._numbers import text_of_number, texts_of_coordinates, texts_of_tolerances
from ._objects import as_method, as_system
from ._sensitivity import warn_of_jumps


@dataclass(slots=True)
class Outcome:
    """How a call that takes steps ended, with the states that were asked for."""

    reached: bool
    """Whether all steps that were asked for were taken."""
    status: str
    """'converged', 'not_converged', 'singular' or 'non_finite': how the last step ended."""
    message: str
    """What ended the call and where; empty where all steps were taken."""
    steps: int
    """How many steps were taken."""
    t: np.ndarray = field(repr=False)
    """The times of the states, shape (rows,); empty where none were asked for. Arrays are of doubles, in quad precision too."""
    y: np.ndarray = field(repr=False)
    """The states, shape (rows, dimension); the one at which the call began is not among them."""


class _Callbacks(dict):
    """The callbacks of an integration by their numbers, a dictionary that can be referred to weakly."""


class Watching:
    """A callback that watches an integration until remove() is called, or the end of the block where it is used as a context manager.

    >>> import pfaff
    >>> it, seen = pfaff.Integration("kepler", "verlet", step=0.01), []
    >>> with it.watch(lambda t, z: seen.append(t), every=5):
    ...     taken = it.steps(10)
    >>> taken = it.steps(10)
    >>> seen
    [0.05, 0.1]
    """

    def __init__(self, of: Integration, number: int) -> None:
        self._of, self._number = of, number

    def remove(self) -> None:
        """The callback is not called from now on; nothing happens where it was removed before.

        It may be removed by itself, by another callback and by another thread while steps are taken.
        """
        self._of._it.unwatch(self._number)
        self._of._callbacks.pop(self._number, None)

    def __repr__(self) -> str:
        return f"<callback of {self._of}>"

    def __enter__(self) -> Watching:
        return self

    def __exit__(self, *raised: object) -> None:
        self.remove()


class Integration:
    """An integration, which is stepped by its user.

    >>> import pfaff
    >>> it = pfaff.Integration("kepler", "verlet", step=0.01)
    >>> it.steps(100, every=10).y.shape
    (10, 4)
    >>> it.time
    1.0

    Times are t0 + n h, computed from the number n of steps. A number that is a float stands for the decimal that it is
    printed as; one of float32, and of float16, for its value.

    Args:
        system: a name, the path of a text model, or a pfaff.System.
        method: a name, the path of a table, a dictionary of coefficients, or a pfaff.Method.
        step: the step, of either sign; with a tolerance the time between two states that are looked at.
        initial: the state, shape (dimension,); without it the system's own.
        t0: the time at the start.
        tolerance: for methods that choose their steps, the error allowed in a step in each coordinate, relative to the
            largest size that it has had so far in the motion.
        absolute: absolute tolerances beside it, one number or one for each coordinate.
        scales: the size of a coordinate to which `tolerance` is relative: "motion", the largest that it has had so far, or
            "step", that at the ends of the step alone.
        precision: "double", or "quad" with 113 bits; arrays are of doubles in both, `decimals` has all digits.
        formulation: of a system with constraints, for a method that needs a vector field, with parameters or without,
            such as "lmm(friction-form=metriplectic)"; without it the usual one.
        system_parameters, method_parameters: dictionaries, where both know a name; others are given as **parameters.
        **parameters: of the system or the method, by their names.

    Raises:
        InputError: a method that does not fit, wrong names, sizes and numbers, a state off the constraints.
    """

    def __init__(self, system: Any, method: Any, *, step: Any = None, initial: Any = None, t0: Any = 0, tolerance: Any = None, absolute: Any = (),
                 scales: str = "motion", precision: str = "double", formulation: str | None = None, system_parameters: Mapping[str, Any] | None = None,
                 method_parameters: Mapping[str, Any] | None = None, **parameters: Any) -> None:
        self.system, self.method = with_parameters(system, method, parameters, system_parameters, method_parameters)
        asked = asked_steps(step=step, t0=t0, tolerance=tolerance, absolute=absolute, scales=scales, precision=precision, formulation=formulation)
        self.precision = precision
        asked["initial"] = self._own_state() if initial is None else self._state(initial, "initial")
        self._it = _pfaff.Integration(self.system.model, self.method.instance, asked)
        self._callbacks = _Callbacks()
        self.outcome: Outcome | None = None

    def _own_state(self) -> list[str]:
        texts = self.system.model.exact_initial
        if not texts:
            raise InputError(f"system {self.system.name} has no initial state of its own; expected initial=, {self.system.dimension} numbers")
        return texts

    def _state(self, state: Any, what: str = "state") -> list[str]:
        return texts_of_coordinates(state, what, self.system.coordinates)

    def _around(self, it: _pfaff.Integration) -> Integration:
        other = object.__new__(Integration)
        other.system, other.method, other.precision = self.system, self.method, self.precision
        other._it, other._callbacks, other.outcome = it, _Callbacks(), None
        return other

    @property
    def time(self) -> float:
        """The time of the state."""
        return self._it.time

    @property
    def state(self) -> np.ndarray:
        """The state that was reached, shape (dimension,), a copy; after a step that failed the last finite one."""
        return self._it.state

    @property
    def decimals(self) -> tuple[decimal.Decimal, ...]:
        """The state with all digits of the precision."""
        return tuple(decimal.Decimal(text) for text in self._it.texts)

    @property
    def step(self) -> float:
        """The step."""
        return self._it.step

    @property
    def steps_taken(self) -> int:
        """The number of steps that lead from t0 to the state; with a tolerance, of all that were taken."""
        return self._it.steps_taken

    @property
    def counters(self) -> dict[str, int]:
        """The work that was done: steps, right_hand_sides, jacobians, iterations, factorisations."""
        return self._it.counters

    def steps(self, n: int, *, every: int = 0) -> Outcome:
        """Takes `n` steps. With `every`, the states after each so many steps, counted from t0, are kept.

        Raises:
            NotConverged: a step did not converge, a linear system in it was singular, or no step meets the tolerance.
            RunFailed: a state is not finite.
            Interrupted: Ctrl-C was pressed.

        Whatever is raised, by a callback too, has the Outcome with the states so far as its attribute `run`.
        """
        return self._take(lambda: self._it.steps(whole(n, "n", 0), whole(every, "every", 0)))

    def to(self, t: Any, *, every: int = 0) -> Outcome:
        """Takes whole steps until the time `t` is reached, or passed by less than one. Raises what steps() raises."""
        return self._take(lambda: self._it.to(text_of_number(t, "t"), whole(every, "every", 0)))

    def _take(self, take: Callable[[], None]) -> Outcome:
        try:
            take()
        except InputError:
            raise
        except BaseException as error:
            self.outcome = Outcome(*self._it.taken())
            attach(error, self.outcome)
            raise
        self.outcome = outcome = Outcome(*self._it.taken())
        if not outcome.reached and outcome.status != "converged":
            failed = (RunFailed if outcome.status == "non_finite" else NotConverged)(outcome.message)
            attach(failed, outcome)
            raise failed
        return outcome

    def watch(self, callback: Callable[[float, np.ndarray], Any], *, every: int = 1) -> Watching:
        """Calls callback(t, z) with the state after each `every` steps, counted from t0, from now on, until what it gives is removed.

        z is a copy, shape (dimension,). The integration ends at the state at which the callback gives True; what it raises ends
        it there too, and reaches who asked for the steps. Of several callbacks each is called with a state before any is with
        the next one. Callbacks cannot step the integration, whose own time and state may be ahead of t and z by then: steps are
        taken many at a time.
        """
        wanted, times, kept = function(callback, "callback", "a function of (t, z)"), whole(every, "every", 1), weakref.ref(self._callbacks)

        # The callback may hold this integration, and Python's collector does not see what the extension holds: that has a function
        # which finds the callback for as long as the integration lives.
        def called(t: float, z: np.ndarray) -> Any:
            found = (kept() or _Callbacks()).get(number)
            return None if found is None else found(t, z)

        number = self._it.watch(called, times)
        self._callbacks[number] = wanted
        return Watching(self, number)

    def beside(self, state: Any) -> Integration:
        """The same method from another state, at the time reached and with the same step. It remembers nothing."""
        return self._around(self._it.beside(self._state(state)))

    def reversed(self) -> Integration:
        """The integration from here back, with steps of the other sign. It remembers nothing."""
        return self._around(self._it.reversed())

    def turn(self) -> None:
        """Turns round where it is, with what the method remembers. Steps are counted anew."""
        self._it.turn()

    def forget(self) -> None:
        """What the method remembers of past steps is forgotten."""
        self._it.forget()

    def go_on_from(self, state: Any, *, t0: Any = None, step: Any = None) -> None:
        """Goes on from another state, with what the method remembers; steps are counted from there."""
        self._it.go_on_from(self._state(state), *("" if x is None else text_of_number(x, what) for x, what in ((t0, "t0"), (step, "step"))))

    def jacobian(self, n: int) -> tuple[np.ndarray, np.ndarray]:
        """The state after `n` steps from here, and its derivative M[i, k] = d z_i / d z_k with respect to the state here.

        Derivatives go through every step, through the iteration of implicit ones too, so that M is the Jacobian of the
        map that the method is, and not of the motion where that passes a jump of its rates (JumpWarning). The integration
        stays where it is; methods that remember steps begin anew.

        >>> import numpy as np, pfaff
        >>> z, M = pfaff.Integration("harmonic-oscillator", "gauss", step=0.1).jacobian(10)
        >>> bool(abs(np.linalg.det(M) - 1) < 1e-13)
        True
        """
        warn_of_jumps(self.system, "jacobian", 2)
        return self._jacobian(n)

    def _jacobian(self, n: int) -> tuple[np.ndarray, np.ndarray]:
        end, derivative = self._it.jacobian(whole(n, "n", 0))
        return end, derivative

    def __repr__(self) -> str:
        return f"<integration of {self.system.name} by {self.method.name}, step {self.step:g}, at t = {self.time:g}>"

    def __reduce__(self) -> Any:
        raise TypeError("an integration cannot be pickled, since its method may remember steps; expected its system, its method and its state")


def asked_steps(*, step: Any, t0: Any, tolerance: Any, absolute: Any, scales: Any, precision: Any, formulation: Any) -> dict[str, Any]:
    """What is asked of an integration, but for its state, in the form that the library takes. InputError for what is of the wrong kind."""
    if not isinstance(precision, str) or precision not in ("double", "quad"):
        raise InputError(unknown("precision", precision, ["double", "quad"]))
    if step is None and tolerance is None:
        raise InputError("step: expected a number other than 0, or a tolerance for a method that chooses its steps")
    if not isinstance(scales, str) or scales not in ("motion", "step"):
        raise InputError(unknown("scales", scales, ["motion", "step"]))
    return {
        "step": text_of_number(0 if step is None else step, "step"),
        "initial": [],
        "t0": text_of_number(t0, "t0"),
        "tolerance": "" if tolerance is None else text_of_number(tolerance, "tolerance"),
        "absolute": texts_of_tolerances(absolute, "absolute"),
        "scales": scales,
        "formulation": "" if formulation is None else text(formulation, "formulation", "the name of a formulation"),
        "quad": precision == "quad",
    }


def attach(error: BaseException, run: Any) -> None:
    """Gives an exception the samples up to it, as its attribute `run`."""
    try:
        error.run = run  # type: ignore[attr-defined]
    except AttributeError:
        pass  # one without attributes goes without them


def with_parameters(system: Any, method: Any, parameters: Mapping[str, Any], of_system: Mapping[str, Any] | None, of_method: Mapping[str, Any] | None) -> tuple[Any, Any]:
    """A system and a method, each with those of the parameters that it knows.

    InputError for a name that neither knows, with the nearest, and for one that both know.
    """
    split = (dictionary_or_none(of_system, "system_parameters"), dictionary_or_none(of_method, "method_parameters"))
    if not parameters:
        return as_system(system, **split[0]), as_method(method, **split[1])
    # Names are known before objects are made, since some systems cannot be made without their parameters.
    known = (_names_of(system, as_system, _pfaff.system_parameter_names), _names_of(method, as_method, _pfaff.method_parameter_names))
    for key, value in parameters.items():
        owners = [k for k in (0, 1) if key in known[k] or key.split(".")[0] in known[k]]
        if len(owners) == 2:
            raise InputError(f"parameter '{key}' belongs to both the system and the method; expected it in system_parameters or method_parameters")
        if not owners:
            raise InputError(unknown("parameter", key, [*known[0], *known[1]]) + " (of the system or the method)")
        split[owners[0]][key] = value
    return as_system(system, **split[0]), as_method(method, **split[1])


def _names_of(x: Any, made: Callable, names: Callable[[str], list[str]]) -> list[str]:
    """The names of the parameters of a system or a method."""
    return names(str(x)) if isinstance(x, str) or hasattr(x, "__fspath__") else list(made(x).parameters)
