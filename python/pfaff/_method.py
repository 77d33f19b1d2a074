"""Methods: registered ones by name, tables of coefficients, and steps written in Python."""
from __future__ import annotations

import functools
import importlib
import inspect
import os
import pickle
import tempfile
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _pfaff
from ._errors import InputError
from ._naming import kebab
from ._numbers import noted_constants, text_of_constant, text_of_number, text_of_setting
from ._toml import toml_of
from ._tracing import argument_names, array_of, flat, place_of, recorded

# Formulas that a problem may offer: name -> (right-hand sides that it counts as, the facets that offer it, size).
FORMULAS = _pfaff.formulas_of_problems()


class Method:
    """A method with its parameters: what takes the steps.

    `pfaff.Method(name, **parameters)` is a registered method (`pfaff.methods()` lists them) or, where `name` is the path
    of a file that ends in .toml, a table of coefficients. The decorator `pfaff.method` makes one of a function, and
    `pfaff.table` one of a dictionary. A method is called with other values of its parameters to make another one.

    >>> Method("gauss", stages=3)
    <method gauss, stages=3, ...>

    Args:
        name: that of a registered method, or the path of a table.
        **parameters: numbers, texts, True or False; lists of numbers.

    Raises:
        InputError: unknown names and values that are out of range.
    """

    def __init__(self, name: Any, /, **parameters: Any) -> None:
        if not isinstance(name, str) and not hasattr(name, "__fspath__"):
            raise InputError(f"Method: expected the name of a method or the path of a table, got {name!r}")
        self._begin(RegisteredMethod(str(name)), parameters)

    def _begin(self, definition: Any, parameters: Mapping[str, Any]) -> None:
        self._definition, self._given = definition, dict(parameters)
        self.instance: _pfaff.MethodInstance = definition.instance(parameters)

    @classmethod
    def _made(cls, definition: Any, parameters: Mapping[str, Any]) -> Method:
        method = object.__new__(cls)
        method._begin(definition, parameters)
        return method

    @property
    def name(self) -> str:
        """The name of the method."""
        return self.instance.name

    @property
    def parameters(self) -> dict[str, str]:
        """All parameters with their values, as texts."""
        return dict(self.instance.parameters)

    @property
    def needs(self) -> tuple[str, ...]:
        """The facets that a system must offer."""
        return tuple(self.instance.needs)

    @property
    def adaptive(self) -> bool:
        """Whether it can choose its steps, by a tolerance."""
        return self.instance.adaptive

    def order(self, system: Any) -> int:
        """The order that the method claims on a system."""
        return self.instance.order(_model(system))

    def preserves(self, system: Any) -> tuple[str, ...]:
        """What the method claims to keep on a system."""
        return tuple(self.instance.preserves(_model(system)))

    def refuses(self, system: Any) -> str:
        """Why the method cannot step on a system, a sentence without a full stop; empty where it can."""
        return self.instance.refuses(_model(system))

    def __call__(self, **parameters: Any) -> Method:
        """The method with other values of some of its parameters."""
        return self._made(self._definition, {**self._given, **parameters})

    def __repr__(self) -> str:
        values = "".join(f", {key}={value}" for key, value in self.parameters.items())
        return f"<method {self.name}{values}>"

    def __reduce__(self) -> tuple:
        return _rebuilt, (self._definition.pickled(), dict(self._given))


def _model(system: Any) -> _pfaff.Model:
    from ._objects import as_system

    return as_system(system).model


class RegisteredMethod:
    """A registered method, or the table of a path."""

    def __init__(self, name: str) -> None:
        self.name = name

    def instance(self, parameters: Mapping[str, Any]) -> _pfaff.MethodInstance:
        return _pfaff.make_method(self.name, _assignments(self.name, parameters))

    def pickled(self) -> tuple:
        return RegisteredMethod, (self.name,)


class TableMethod:
    """A table of coefficients, as the text of its file."""

    def __init__(self, text: str) -> None:
        self.text = text

    def instance(self, parameters: Mapping[str, Any]) -> _pfaff.MethodInstance:
        # Read as a file is, so that a message has the line of the text in it.
        with tempfile.TemporaryDirectory(prefix="pfaff-") as folder:
            path = os.path.join(folder, "table.toml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(self.text)
            try:
                return _pfaff.table_method(path, _assignments("table", parameters))
            except InputError as error:
                raise InputError(str(error).replace(path, "table")) from None

    def pickled(self) -> tuple:
        return TableMethod, (self.text,)


def _assignments(name: str, parameters: Mapping[str, Any]) -> list[tuple[str, str]]:
    return [(key, text_of_setting(value, f"parameter '{key}' of {name}")) for key, value in parameters.items()]


class Problem:
    """What a step is given of the system that it steps on.

    A formula of the system is called by its name, with a time and an array: problem.field(t, z) gives dz/dt, shape
    (dimension,); problem.force(t, q) and problem.velocity(t, p) the two halves of a separable system. What there is
    besides is what the facets offer that the method needs: `pfaff list facets`.
    """

    def __init__(self, system: _pfaff.Model, allowed: frozenset[str], evaluate: Callable[[str, Any, Any], Sequence]) -> None:
        self._system, self._allowed, self._evaluate = system, allowed, evaluate

    @property
    def size(self) -> int:
        """The number of coordinates."""
        return self._system.dimension

    def __getattr__(self, name: str) -> Callable:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in FORMULAS:
            raise InputError("problem: " + _pfaff.unknown_name("formula", name, [key for key, (_, facets, _) in FORMULAS.items() if facets]))
        _, facets, writes = FORMULAS[name]
        if not self._allowed.intersection(facets):
            raise InputError(f"problem.{name}: expected one of {', '.join(facets)} among what the method needs, needs=[...]")

        def formula(t: Any, x: Any) -> Any:
            values = self._evaluate(name, t, x)
            if writes == "n * n":
                return values.reshape(self.size, self.size)
            return values[0] if writes == "1" else values

        return formula


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
                    raise InputError(f"{place_of(function)}method {claims['name']}: parameter '{key}': expected a number, True, False or a text, got {value!r}")
                self.parameters[key] = value
        self._instances: dict[tuple, _pfaff.MethodInstance] = {}

    def instance(self, parameters: Mapping[str, Any]) -> _pfaff.MethodInstance:
        what = f"method {self.claims['name']}"
        values = dict(self.parameters)
        for key, value in parameters.items():
            if key not in values:
                raise InputError(_pfaff.unknown_name("parameter", key, list(values)) + f" (of {self.claims['name']})")
            own = values[key]
            if isinstance(own, (bool, str)):
                if type(value) is not type(own):
                    raise InputError(f"parameter '{key}' of {self.claims['name']}: expected {'True or False' if isinstance(own, bool) else 'a text'}, got {value!r}")
            else:
                text_of_number(value, f"parameter '{key}' of {self.claims['name']}")
            values[key] = value
        texts = [(key, text_of_setting(value, key)) for key, value in values.items()]
        if tuple(texts) not in self._instances:
            of = {**self.claims, "parameters": texts, "compiled": self.compiled}
            allowed = frozenset(self.claims["needs"])
            make = self._traced if self.traced else self._called
            self._instances[tuple(texts)] = make(of, values, allowed, what)
        return self._instances[tuple(texts)]

    def _traced(self, of: dict, values: dict, allowed: frozenset[str], what: str) -> _pfaff.MethodInstance:
        place = place_of(self.function)

        def trace(system: _pfaff.Model) -> tuple[_pfaff.Tape, int, int]:
            n = system.dimension
            kept = self.memory(n) if callable(self.memory) else int(self.memory)
            given = {key: value if isinstance(value, (int, str)) else _pfaff.constant(text_of_number(value, key)) for key, value in values.items()}
            fields = 0

            def evaluate(name: str, t: Any, x: Any) -> np.ndarray:
                nonlocal fields
                fields += FORMULAS[name][0]
                return array_of(_pfaff.formula_of(system, name).record(t, flat(x, f"argument of {name}")))

            def step(t: Any, numbers: list) -> list:
                nonlocal fields
                fields = 0
                problem = Problem(system, allowed, evaluate)
                known = {"memory": array_of(numbers[n : n + kept])} if kept else {}
                made = self.function(problem, t, numbers[-1], array_of(numbers[:n]), **known, **given)
                parts = [made] if not kept else made if isinstance(made, tuple) and len(made) == 2 else [None]
                results = [flat(part, f"{place}{what}") for part in parts]
                for one, expected in zip(results, (n, kept)):
                    if len(one) != expected:
                        raise InputError(f"{place}{what} returned {len(one)} numbers; expected {expected}")
                return [number for one in results for number in one]

            with noted_constants() as noted:
                tape = recorded(n + kept + 1, step, f"{place}{what}")
            self._warn_of(noted, what)
            return tape, fields, kept

        return _pfaff.traced_method(of, trace)

    def _called(self, of: dict, values: dict, allowed: frozenset[str], what: str) -> _pfaff.MethodInstance:
        function = self.function

        def step(evaluate: Callable, system: _pfaff.Model, t: Any, h: Any, z: np.ndarray, work: dict) -> Any:
            known = {"work": work} if self.extra else {}
            return function(Problem(system, allowed, evaluate), t, h, z, **known, **values)

        return _pfaff.called_method(of, step)

    def _warn_of(self, noted: list[tuple[str, str]], what: str) -> None:
        if self.claims["order"] <= 0:
            return
        for place, text in dict(noted).items():
            warnings.warn(
                f"{place}: {what} claims an order and has the constant {text}, which a float has rounded: in quad precision its "
                "order is lost. Expected an exact one, such as fractions.Fraction(1, 3)",
                stacklevel=2,
            )

    def pickled(self) -> tuple:
        if _found(*self.reference) is not self:
            raise pickle.PicklingError(
                f"method {self.claims['name']}: its function {'.'.join(self.reference)} cannot be imported by another process; expected "
                "one at the top of a module"
            )
        return _step_function, self.reference


def _found(module: str, name: str) -> Any:
    """The definition of the method that a module has under a name; None where there is none."""
    try:
        found = functools.reduce(getattr, name.split("."), importlib.import_module(module))
    except (ImportError, AttributeError):
        return None
    return getattr(found, "_definition", None)


def _step_function(module: str, name: str) -> StepFunction:
    return _found(module, name)


def _rebuilt(definition: tuple, parameters: Mapping[str, Any]) -> Method:
    make, arguments = definition
    return Method._made(make(*arguments), parameters)


def method(*, order: int, preserves: Sequence[str] = (), needs: Sequence[str] = ("vector-field",), name: str | None = None, title: str = "",
           reference: str = "", traced: bool = True, compiled: bool = False, memory: Callable[[int], int] | int = 0) -> Callable[[Callable], Method]:
    """Makes a method of a function, one step of it.

    >>> import pfaff
    >>> @pfaff.method(order=2, preserves=["symplectic", "symmetric"], needs=["separable"])
    ... def kick(problem, t, h, z):
    ...     n = problem.size // 2
    ...     q, p = z[:n], z[n:]
    ...     p = p + h / 2 * problem.force(t, q)
    ...     q = q + h * problem.velocity(t + h / 2, p)
    ...     p = p + h / 2 * problem.force(t + h, q)
    ...     return np.concatenate([q, p])
    >>> kick.order("kepler")
    2

    The function has the arguments (problem, t, h, z): the system, whose formulas it calls (see Problem), the time, the
    step and the state, an array of shape (dimension,); it gives the state at t + h. Further arguments have defaults and
    are parameters. It is recorded once on each system, and then steps without Python, in double, in quad and with
    derivatives; what it claims is verified like that of any other method.

    Args:
        order: what the method claims; 0 claims none.
        preserves: claims by their names, such as "symplectic" and "energy" (`pfaff list claims`).
        needs: the facets that the function uses, such as "vector-field" and "separable".
        name: that of the method; without it that of the function, in kebab-case.
        title, reference: what reports show.
        traced: False calls the function at every step instead, with floats, or in other scalars with arrays of
            objects; it may then branch on values, and an argument `work` is a dictionary that it keeps things in.
        compiled: compile what was recorded by the system's C++ compiler, in double precision.
        memory: how many numbers a traced step keeps for the next one, a number or a function of the dimension. The
            function then has an argument `memory`, zeros at first, and gives (state, memory).

    Raises:
        InputError: unknown claims and facets, arguments that do not fit.
        TraceError: when it is first used on a system, where the function does something that cannot be recorded.
    """

    def decorate(function: Callable) -> Method:
        own = name or kebab(function.__name__)
        for what, given in (("preserves", preserves), ("needs", needs)):
            if isinstance(given, str):
                raise InputError(f"method {own}: {what}: expected a list of names, such as [{given!r}]")
        claims = {"name": own, "title": title or f"a method of Python, of order {order}", "reference": reference, "description": inspect.getdoc(function) or "",
                  "order": int(order), "preserves": list(preserves), "needs": list(needs)}
        definition = StepFunction(function, claims, traced, compiled, memory, (function.__module__, function.__qualname__))
        made = Method._made(definition, {})
        made.__doc__ = function.__doc__
        return made

    return decorate


def table(coefficients: Mapping[str, Any], /, **parameters: Any) -> Method:
    """Makes a method of a table of coefficients, a dictionary with the keys of the files that docs/tables.md describes.

    >>> import pfaff
    >>> pfaff.table({"kind": "runge-kutta", "name": "ralston", "order": 2, "a": [[], ["2/3"]], "b": ["1/4", "3/4"]}).name
    'ralston'

    Numbers are exact as texts and as fractions.Fraction; the order that the table states is checked.

    Raises:
        InputError: keys that are unknown or missing, and conditions that do not hold.
    """
    return Method._made(TableMethod(toml_of(coefficients, "table")), parameters)


def methods() -> list[str]:
    """The names of all registered methods; `pfaff describe NAME` says what they are.

    >>> "verlet" in methods()
    True
    """
    return _pfaff.method_names()
