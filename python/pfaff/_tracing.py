"""Tracing: a function is called once with numbers that record what is done with them."""
from __future__ import annotations

import functools
import inspect
import os
import re
import sys
import types
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

import numpy as np

from . import _pfaff
from ._arguments import shown, unknown
from ._errors import InputError, TraceError
from ._numbers import text_of_constant

# NumPy's functions that formulas may call, and what takes the place of others.
_FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "arcsin", "arccos", "arctan", "arctan2", "sinh", "cosh", "tanh", "hypot", "abs")
_INSTEAD = {
    "expm1": "numpy.exp(x) - 1",
    "log1p": "numpy.log(1 + x)",
    "exp2": "2**x",
    "log2": "numpy.log(x) / numpy.log(2)",
    "log10": "numpy.log(x) / numpy.log(10)",
    "cbrt": "x ** fractions.Fraction(1, 3), for x > 0",
    "arcsinh": "numpy.log(x + numpy.sqrt(x**2 + 1))",
    "arccosh": "numpy.log(x + numpy.sqrt(x**2 - 1))",
    "arctanh": "numpy.log((1 + x) / (1 - x)) / 2",
    "degrees": "x * 180 / numpy.pi",
    "radians": "x * numpy.pi / 180",
    "deg2rad": "x * numpy.pi / 180",
    "rad2deg": "x * 180 / numpy.pi",
    "fabs": "abs(x)",
    "signbit": "pfaff.where(-x, 1, 0)",
}
# Code that stands between a user's formula and the numbers in it.
_OWN = (os.path.dirname(os.path.abspath(__file__)) + os.sep, os.path.dirname(os.path.abspath(np.__file__)) + os.sep, "<__array_function__")


def place_of_caller() -> str:
    """FILE:LINE of the innermost line of the user's code that is being run; empty where there is none."""
    frame: types.FrameType | None = sys._getframe(1)
    while frame is not None:
        if not frame.f_code.co_filename.startswith(_OWN):
            return f"{frame.f_code.co_filename}:{frame.f_lineno}"
        frame = frame.f_back
    return ""


def trace_error(message: str) -> TraceError:
    """The error of an operation that has no meaning while a formula is recorded, with the user's line."""
    place = place_of_caller()
    return TraceError(f"{place}: {message}" if place else message)


def place_of(function: Callable) -> str:
    """FILE:LINE of a function, with a colon behind it; empty where it has none."""
    own = inspect.unwrap(function)
    while isinstance(own, functools.partial):
        own = inspect.unwrap(own.func)
    code = getattr(own, "__code__", None) or getattr(getattr(type(own), "__call__", None), "__code__", None)
    return f"{code.co_filename}:{code.co_firstlineno}: " if code else ""


def array_of(numbers: Any) -> np.ndarray:
    """An array of one dimension of numbers of a recording."""
    array = np.empty(len(numbers), dtype=object)
    for k, number in enumerate(numbers):
        array[k] = number
    return array


def argument_names(function: Callable) -> dict[str, Any]:
    """The names of a function's arguments, each with its default, or inspect.Parameter.empty."""
    parameters = inspect.signature(function).parameters.values()
    for parameter in parameters:
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD, parameter.POSITIONAL_ONLY):
            raise InputError(f"{place_of(function)}expected arguments with names, got '{parameter}'")
    return {parameter.name: as_annotated(parameter.default, parameter.annotation) for parameter in parameters}


def as_annotated(value: Any, annotation: Any) -> Any:
    """A default that is a whole number as the real number that its annotation says it is; other values as they are."""
    if type(value) is not int or annotation not in (float, "float"):
        return value
    return float(value) if int(float(value)) == value else Fraction(value)


def call_by_names(function: Callable, known: Mapping[str, Any], what: str) -> Any:
    """Calls a function with those of the known arguments that it names."""
    arguments = {}
    for name, default in argument_names(function).items():
        if name in known:
            arguments[name] = known[name]
        elif default is inspect.Parameter.empty:
            raise InputError(f"{what}: {unknown('argument', name, sorted(known))}")
    return function(**arguments)


def flat(results: Any, what: str) -> list:
    """The numbers of a result: a number, or lists and arrays of them, row by row."""
    if results is None:
        raise InputError(f"{what} returned nothing; expected numbers")
    if isinstance(results, dict):
        results = list(results.values())
    try:
        numbers = list(np.asarray(results, dtype=object).ravel())
    except ValueError:
        raise InputError(f"{what} returned rows of different lengths") from None
    for k, number in enumerate(numbers):
        if isinstance(number, np.ndarray) and number.ndim == 0:  # as numpy.real and numpy.tensordot give
            numbers[k] = number = number.item()
        if not isinstance(number, _pfaff.Number) and text_of_constant(number) is None:
            raise InputError(f"{what} returned {shown(number)}; expected numbers")
    return numbers


def recorded(inputs: int, formula: Callable[[Any, list], list], what: str) -> _pfaff.Tape:
    """The tape of a formula of the time and `inputs` numbers, which gives a list of numbers.

    It is recorded twice: one that gives something else the second time, by random numbers or a counter, is
    refused (TraceError), since a run would see only what it gave once.
    """
    tapes = []
    for _ in range(2):
        recording = _pfaff.Recording(inputs)
        try:
            tapes.append(recording.finish(formula(recording.time, recording.inputs)))
        except (TypeError, AttributeError) as error:
            if isinstance(error, TraceError) or not _refused_by_numpy(error):
                raise
            raise TraceError(f"{what}: {_not_recorded(error)}") from error
        finally:
            recording.close()
    if not tapes[0].same(tapes[1]):
        raise TraceError(
            f"{what} is another formula each time that it is called (random numbers, counters, the clock); expected one "
            "that depends on its arguments alone, since it is recorded once"
        )
    return tapes[0]


def _not_recorded(error: TypeError | AttributeError) -> str:
    """What NumPy cannot do with numbers that are recorded, and what to write instead."""
    missing = re.search(r"no callable (\w+) method|^ufunc '(\w+)'", str(error))
    name = str(error.name) if isinstance(error, AttributeError) else missing[1] or missing[2] if missing else ""
    if name in _INSTEAD:
        return f"numpy.{name} cannot be recorded; expected {_INSTEAD[name]}"
    if name in _FUNCTIONS:
        return f"numpy.{name} cannot be recorded with a first argument that is a plain number; expected one that is recorded, such as 1.0 + 0 * x"
    if name and isinstance(getattr(np, name), np.ufunc):
        return f"numpy.{name} cannot be recorded; expected {_expected()}"
    return f"NumPy cannot do this with numbers that are recorded ({error}); expected {_expected()}"


def _expected() -> str:
    return f"+ - * / **, numpy's {', '.join(_FUNCTIONS)}, pfaff.where, and pfaff.solve for linear systems and inverses"


def _refused_by_numpy(error: TypeError | AttributeError) -> bool:
    """Whether NumPy refused numbers that are no floats: its functions of arrays of objects call the methods of the first
    argument that have their names, numpy.arctan2(1.0, x) for one 1.0.arctan2(x)."""
    if isinstance(error, AttributeError):
        return isinstance(error.obj, (_pfaff.Number, int, float)) and hasattr(np, error.name)
    return "ufunc" in str(error) or "einsum" in str(error)


def where(condition: Any, positive: Any, otherwise: Any) -> Any:
    """`positive` where `condition` > 0, and `otherwise` elsewhere.

    In formulas it takes the place of `if` and of comparisons: where(x - y, a, b) is a where x > y. Arguments are
    numbers or arrays of one shape; both branches are evaluated.

    >>> import numpy as np
    >>> where(np.array([1.0, -1.0]), 2, 3)
    array([2, 3])
    """
    arguments = (condition, positive, otherwise)
    for name, x in zip(("condition", "positive", "otherwise"), arguments):
        _require_numbers(x, name)
    if not any(isinstance(x, _pfaff.Number) or np.asarray(x).dtype == object for x in arguments):
        return np.where(np.asarray(condition) > 0, positive, otherwise)
    if all(np.ndim(x) == 0 for x in arguments):
        return _pfaff.where(*arguments)
    return np.vectorize(_pfaff.where, otypes=[object])(*arguments)


def solve(matrix: Any, right_hand_side: Any) -> np.ndarray:
    """x of the linear system `matrix` x = `right_hand_side`, of shapes (n, n) and (n,).

    In formulas it takes the place of numpy.linalg.solve and inv: the system is solved, with pivots, whenever the
    formula is evaluated.

    >>> solve([[2, 0], [0, 4]], [2, 2])
    array([1. , 0.5])
    """
    _require_numbers(matrix, "matrix")
    _require_numbers(right_hand_side, "right_hand_side")
    a, b = np.asarray(matrix), np.asarray(right_hand_side)
    if a.ndim != 2 or a.shape[0] != a.shape[1] or b.shape != a.shape[:1]:
        raise InputError(f"solve: expected a matrix of shape (n, n) and a right_hand_side of shape (n,), got {a.shape} and {b.shape}")
    if object not in (a.dtype, b.dtype):
        return np.linalg.solve(a, b)
    return array_of(_pfaff.solve(list(a.ravel()), list(b)))


def _require_numbers(x: Any, what: str) -> None:
    """Refuses what is no number and no array of numbers, recorded ones or others."""
    try:
        entries = np.asarray(x)
    except ValueError:  # rows of different lengths
        entries = np.array(None)
    if entries.dtype.kind in "biuf":
        return
    for one in entries.astype(object).ravel():
        if not isinstance(one, _pfaff.Number) and text_of_constant(one) is None:
            raise trace_error(f"{what}: expected a number or an array of numbers, got {shown(x)}")
