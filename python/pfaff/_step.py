"""Steps that are functions of Python: what they are given, and how they become methods of the library."""
from __future__ import annotations

import fractions
import functools
import importlib
import inspect
import pickle
import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from . import _pfaff
from ._arguments import shown, unknown, whole
from ._errors import InputError
from ._numbers import noted_constants, text_of_constant, text_of_number, text_of_setting
from ._tracing import argument_names, array_of, flat, place_of, recorded

# Formulas that a problem may offer: name -> (right-hand sides that it counts as, the facets that it belongs to, size).
FORMULAS = _pfaff.formulas_of_problems()


_WARNED: dict[Any, Any] = {}  # which constants were told of, each once


class Problem:
    """What a step is given of the system that it steps on.

    A formula of the system is called by its name, with a time and an array: problem.field(t, z) gives dz/dt, shape
    (dimension,); problem.force(t, q) and problem.velocity(t, p) the two halves of a separable system, or, without its
    friction, of a conformal one, whose rate of friction is problem.damping; problem.applied_force(t, z) the forces beside
    the energy. What there is besides is what belongs to the facets that the method needs: `pfaff list facets`. A formula
    of two times has the second one behind its numbers.
    """

    def __init__(self, system: _pfaff.Model, allowed: frozenset[str], evaluate: Callable[[str, Any, Any], np.ndarray]) -> None:
        self._system, self._allowed, self._evaluate = system, allowed, evaluate

    @property
    def size(self) -> int:
        """The number of coordinates."""
        return self._system.dimension

    @property
    def damping(self) -> Any:
        """The rate nu of the friction of a conformal system, p' = -V_q - nu p: a number of the step's own kind."""
        self._require("damping", ["conformal"])
        return self._evaluate("damping", 0, [])[0]

    def _require(self, name: str, facets: list[str]) -> None:
        if not self._allowed.intersection(facets):
            raise InputError(f"problem.{name}: expected {'one of ' if len(facets) > 1 else ''}{', '.join(facets)} among what the method needs, needs=[...]")

    def __getattr__(self, name: str) -> Callable:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in FORMULAS:
            raise InputError("problem: " + unknown("formula", name, [*FORMULAS, "damping"]))
        _, facets, writes = FORMULAS[name]
        self._require(name, facets)

        def formula(t: Any, x: Any) -> Any:
            values = self._evaluate(name, t, x)
            if writes == "n * n":
                return values.reshape(self.size, self.size)
            return values[0] if writes == "1" else values

        return formula


_MOST_INSTANCES = 64  # of one function, with other values of its parameters each


class StepFunction:
    """A step that is a function of Python, with what it claims."""

    def __init__(self, function: Callable, claims: dict[str, Any], traced: bool, compiled: bool, memory: Callable[[int], int] | int, reference: tuple[str, str]) -> None:
        self.function, self.claims, self.traced, self.compiled, self.memory, self.reference = function, claims, traced, compiled, memory, reference
        self.parameters = {}
        names = argument_names(function)
        expected = ["problem", "t", "h", "z"]
        if list(names)[:4] != expected:
            raise InputError(f"{place_of(function)}method {claims['name']}: expected a function of (problem, t, h, z), got ({', '.join(names)})")
        self.extra = [key for key in list(names)[4:] if names[key] is inspect.Parameter.empty]
        if self.extra != (["memory"] if memory and traced else []) and not (not traced and self.extra == ["work"]):
            raise InputError(f"{place_of(function)}method {claims['name']}: expected defaults for parameters, got {', '.join(self.extra) or 'no argument memory'}")
        for key, value in names.items():
            if value is not inspect.Parameter.empty:
                if text_of_constant(value) is None and not isinstance(value, (bool, str)):
                    raise InputError(f"{place_of(function)}method {claims['name']}: parameter '{key}': expected a number, True, False or a text, got {shown(value)}")
                self.parameters[key] = value
        self._instances: dict[tuple, _pfaff.MethodInstance] = {}

    def instance(self, parameters: Mapping[str, Any]) -> _pfaff.MethodInstance:
        what = f"method {self.claims['name']}"
        values = dict(self.parameters)
        for key, value in parameters.items():
            if key not in values:
                raise InputError(unknown("parameter", key, list(values)) + f" (of {self.claims['name']})")
            values[key] = self._value(key, value)
        texts = [(key, text_of_setting(parameters.get(key, value), key)) for key, value in values.items()]
        if tuple(texts) not in self._instances:
            of = {**self.claims, "parameters": texts, "compiled": self.compiled}
            allowed = frozenset(self.claims["needs"])
            make = self._traced if self.traced else self._called
            if len(self._instances) >= _MOST_INSTANCES:
                del self._instances[next(iter(self._instances))]
            self._instances[tuple(texts)] = make(of, values, allowed, what)
        return self._instances[tuple(texts)]

    def _value(self, key: str, value: Any) -> Any:
        """The value of a parameter, of the kind of its own one: an exact text of a number becomes a fraction."""
        own, place = self.parameters[key], f"parameter '{key}' of {self.claims['name']}"
        if isinstance(own, (bool, str)):
            if type(value) is not type(own):
                raise InputError(f"{place}: expected {'True or False' if isinstance(own, bool) else 'a text'}, got {shown(value)}")
            return value
        _pfaff.constant(text_of_number(value, place), place)  # refuses texts that are no numbers
        return fractions.Fraction(value) if isinstance(value, str) else value

    def _traced(self, of: dict, values: dict, allowed: frozenset[str], what: str) -> _pfaff.MethodInstance:
        # Without this object itself, which holds the instance that holds what is made here: the collector of Python does not see
        # through the instance.
        function, memory, order, place = self.function, self.memory, self.claims["order"], place_of(self.function)

        def trace(system: _pfaff.Model) -> tuple[_pfaff.Tape, int, int]:
            n = system.dimension
            kept = whole(memory(n), "memory", 0) if callable(memory) else memory
            given = {key: value if isinstance(value, (int, str)) else _pfaff.constant(text_of_number(value, key), key) for key, value in values.items()}
            fields = 0

            def evaluate(name: str, t: Any, x: Any) -> np.ndarray:
                nonlocal fields
                if name == "damping":
                    return array_of([_pfaff.constant(system.damping, name)])
                fields += FORMULAS[name][0]
                return array_of(_pfaff.formula_of(system, name).record(t, flat(x, f"argument of {name}")))

            def step(t: Any, numbers: list) -> list:
                nonlocal fields
                fields = 0
                problem = Problem(system, allowed, evaluate)
                known = {"memory": array_of(numbers[n : n + kept])} if kept else {}
                made = function(problem, t, numbers[-1], array_of(numbers[:n]), **known, **given)
                if kept and not (isinstance(made, tuple) and len(made) == 2):
                    raise InputError(f"{place}{what} has a memory; expected a tuple (state, memory), got {shown(made)}")
                parts = made if kept else [made]
                results = [flat(part, f"{place}{what}") for part in parts]
                for one, expected in zip(results, (n, kept)):
                    if len(one) != expected:
                        raise InputError(f"{place}{what} returned {len(one)} numbers; expected {expected}")
                return [number for one in results for number in one]

            with noted_constants() as noted:
                tape = recorded(n + kept + 1, step, f"{place}{what}")
            if order > 0:
                _warn_of(noted, what)
            return tape, fields, kept

        return _pfaff.traced_method(of, trace)

    def _called(self, of: dict, values: dict, allowed: frozenset[str], what: str) -> _pfaff.MethodInstance:
        function, keeps = self.function, bool(self.extra)  # without this object itself, as above

        def step(evaluate: Callable, system: _pfaff.Model, t: Any, h: Any, z: np.ndarray, work: dict) -> Any:
            known = {"work": work} if keeps else {}
            return function(Problem(system, allowed, evaluate), t, h, z, **known, **values)

        return _pfaff.called_method(of, step)

    def pickled(self) -> tuple:
        if _found(*self.reference) is not self:
            raise pickle.PicklingError(
                f"method {self.claims['name']}: its function {'.'.join(self.reference)} cannot be imported by another process; expected "
                "one at the top of a module"
            )
        return _step_function, self.reference


def _warn_of(noted: list[tuple[str, str]], what: str) -> None:
    for place in dict.fromkeys(place for place, _ in noted):
        texts = dict.fromkeys(text for at, text in noted if at == place)
        many = len(texts) > 1
        file, _, line = place.rpartition(":")
        warnings.warn_explicit(
            f"{what} claims an order and has the constant{'s' if many else ''} {', '.join(texts)}, which a float has rounded: in quad "
            f"precision its order is lost. Expected {'exact ones' if many else 'an exact one'}, such as fractions.Fraction(1, 3)",
            UserWarning, file or "<unknown>", int(line or 0), registry=_WARNED)


def _found(module: str, name: str) -> Any:
    """The definition of the method that a module has under a name; None where there is none."""
    try:
        found = functools.reduce(getattr, name.split("."), importlib.import_module(module))
    except (ImportError, AttributeError):
        return None
    return getattr(found, "_definition", None)


def _step_function(module: str, name: str) -> StepFunction:
    return _found(module, name)
