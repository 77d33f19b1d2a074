"""Derivatives with respect to a parameter, as differences in quad precision."""
from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arguments import unknown
from ._errors import InputError, JumpWarning

if TYPE_CHECKING:
    from ._system import System

# The step of a difference, of the size of the parameter: 24 of quad's 34 digits are left to it, 20 after truncation.
_STEP = Fraction(1, 10**10)
# Differences of the second order, as weights of the values at multiples of the step.
_DIFFERENCES: tuple[dict[int, Fraction], ...] = (
    {1: Fraction(1, 2), -1: Fraction(-1, 2)},
    {0: Fraction(-3, 2), 1: Fraction(2), 2: Fraction(-1, 2)},
    {0: Fraction(3, 2), -1: Fraction(-2), -2: Fraction(1, 2)},
)


def warn_of_jumps(system: System, what: str, depth: int) -> None:
    """Warns whoever asked for a derivative, `depth` calls above, of rates that may jump along the motion."""
    if system.model.may_jump:
        warnings.warn(
            f"{what}: the formulas of {system.name} have branches (pfaff.where or abs) that the time or the state chooses; where the motion "
            "passes from one to another and its rates jump, this is the derivative of the map that the steps make, and not of the motion. "
            "Expected rates that do not jump there, or differences of motions",
            JumpWarning, stacklevel=depth + 1)


def sensitivity_of(system: System, parameter: Any, end_of: Callable[[System], Sequence[Any]]) -> np.ndarray:
    """The derivative of what end_of(system) gives, exact numbers, with respect to a parameter of the system."""
    values = system.parameters
    if not isinstance(parameter, str) or parameter not in values:
        raise InputError(unknown("parameter", parameter, list(values)) + f" (of {system.name})")
    try:
        value = Fraction(values[parameter])
    except ValueError:
        raise InputError(f"parameter '{parameter}' of {system.name}: expected one that is a real number, got {values[parameter]!r}") from None
    step = (abs(value) or 1) * _STEP
    weights, systems = _moved(system, parameter, value, step)
    try:
        ends = {k: [Fraction(x) for x in end_of(moved)] for k, moved in systems.items()}
    except InputError as error:  # a state that was given lies on the constraints for one value alone
        raise InputError(f"sensitivity: another '{parameter}' does not fit: {error}") from None
    return np.array([float(sum(weights[k] * end[i] for k, end in ends.items()) / step) for i in range(system.dimension)])


def _moved(system: System, parameter: str, value: Fraction, step: Fraction) -> tuple[dict[int, Fraction], dict[int, System]]:
    """The first of the differences whose systems there are, since a range may end at the value."""
    first: InputError | None = None
    for weights in _DIFFERENCES:
        try:
            return weights, {k: _with(system, parameter, value + k * step) for k in weights}
        except InputError as error:
            first = first or error
    raise InputError(f"sensitivity: no small change of '{parameter}' makes a system: {first}")


def _with(system: System, parameter: str, value: Fraction) -> System:
    moved: dict[str, Any] = {parameter: f"{value.numerator}/{value.denominator}"}
    return system(**moved)
