"""Methods: registered ones by name, tables of coefficients, and steps written in Python."""
from __future__ import annotations

import inspect
import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from . import _pfaff
from ._arguments import named_function, shown, text, texts, whole, yes_or_no
from ._errors import InputError
from ._naming import absolute, kebab
from ._numbers import text_of_setting
from ._step import StepFunction
from ._toml import toml_of


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
            raise InputError(f"name: expected the name of a method or the path of a table, got {shown(name)}")
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
        """The order that the method claims on a system. InputError where it cannot step on it."""
        return self.instance.order(_model(system))

    def preserves(self, system: Any) -> tuple[str, ...]:
        """What the method claims to keep on a system. InputError where it cannot step on it."""
        return tuple(self.instance.preserves(_model(system)))

    def refuses(self, system: Any) -> str:
        """Why the method cannot step on a system, a sentence without a full stop; empty where it can."""
        return self.instance.refuses(_model(system))

    def as_value(self) -> str:
        """The method as the value of a parameter of another one, such as the base of a composition."""
        if not isinstance(self._definition, RegisteredMethod):
            raise InputError(f"method {self.name}: expected a registered method as a part of another one")
        return f"{self.name}({', '.join(f'{key}={value}' for key, value in self.parameters.items())})"

    @property
    def registered_name(self) -> str:
        """The name of a registered method, or the path of a table; empty for methods written in Python."""
        return absolute(self._definition.name) if isinstance(self._definition, RegisteredMethod) else ""

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
        import tempfile  # here, since it takes a tenth of the time in which the package is imported

        # Read as a file is, so that a message has the line of the text in it.
        with tempfile.TemporaryDirectory(prefix="pfaff-") as folder:
            path = os.path.join(folder, "table.toml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(self.text)
            try:
                return _pfaff.table_method(path, _assignments("table", parameters))
            except InputError as error:
                raise InputError(re.sub(re.escape(path) + r"(:1:1)?", "table", str(error))) from None

    def pickled(self) -> tuple:
        return TableMethod, (self.text,)


def _assignments(name: str, parameters: Mapping[str, Any]) -> list[tuple[str, str]]:
    return [(key, text_of_setting(value, f"parameter '{key}' of {name}")) for key, value in parameters.items()]


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
            objects; it may then branch on values, and an argument `work` is a dictionary that it keeps things in. A step that
            does not converge raises pfaff.NotConverged.
        compiled: compile what was recorded by the system's C++ compiler, in double precision.
        memory: how many numbers a traced step keeps for the next one, a number or a function of the dimension. The
            function then has an argument `memory`, zeros at first and where a step does not begin where the last one, of
            the same size, ended, and gives (state, memory).

    Raises:
        InputError: unknown claims and facets, arguments that do not fit.
        TraceError: when it is first used on a system, where the function does something that cannot be recorded.
    """
    claimed: dict[str, Any] = {
        "title": text(title, "title") or f"a method of Python, of order {order}", "reference": text(reference, "reference"),
        "order": whole(order, "order", 0), "preserves": texts(preserves, "preserves", '["symplectic"]'),
        "needs": texts(needs, "needs", '["vector-field"]'),
    }
    own = text("" if name is None else name, "name")
    how = (yes_or_no(traced, "traced"), yes_or_no(compiled, "compiled"))
    kept: Callable[[int], int] | int = memory if callable(memory) else whole(memory, "memory", 0)
    if not traced and (compiled or kept):
        raise InputError(f"{'compiled' if compiled else 'memory'}: expected none with traced=False" + ("" if compiled else ", whose step keeps things in an argument `work`"))

    def decorate(function: Callable) -> Method:
        named_function(function, "method", "a function of (problem, t, h, z)")
        claims = {"name": own or kebab(function.__name__), "description": inspect.getdoc(function) or "", **claimed}
        definition = StepFunction(function, claims, *how, kept, (function.__module__, function.__qualname__))
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
