"""Derivation: equations of motion in symbols, as text and code and for SymPy."""
from __future__ import annotations

import html
import os
import tempfile
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import _pfaff
from ._arguments import text, texts, whole
from ._errors import InputError
from ._numbers import text_of_setting
from ._objects import as_system
from ._tables import data_frame

if TYPE_CHECKING:
    import pandas
    import sympy

    from ._system import System


class Equations:
    """Equations of motion, one rate for each coordinate.

    Attributes:
        system, method: what they are of, and what made them.
        coordinates: the names of the coordinates, in the order of the rates.
        parameters: those that are symbols in the equations, with the values that they have in the system, as texts.
        further: the names of quantities behind the rates, such as multipliers.
        operations: how many operations evaluating them takes.
    """

    def __init__(self, equations: _pfaff.Equations) -> None:
        self._equations = equations
        self.system: str = equations.system
        self.method: str = equations.method
        self.coordinates: tuple[str, ...] = tuple(equations.coordinates)
        self.parameters: dict[str, str] = dict(equations.parameters)
        self.further: tuple[str, ...] = tuple(equations.further_outputs)
        self.operations: int = equations.operations

    def text(self, language: str) -> str:
        """The equations in a language: "cpp", "latex", "sympy", "mathematica" or "julia"."""
        return self._equations.written(text(language, "language", 'the name of one, such as "latex"'))

    def to_sympy(self) -> dict[str, sympy.Expr]:
        """The rate of each coordinate as an expression of SymPy, by the coordinate's name, and what is further there.

        Symbols have the names of the coordinates and parameters, and t is the time. Constants are exact.
        """
        try:
            import sympy
        except ImportError:
            raise ImportError("to_sympy() needs SymPy, which is not installed (Debian's python3-sympy)") from None
        module: dict[str, Any] = {}
        exec(compile(self.text("sympy"), f"<equations of {self.system}>", "exec"), module)
        rates = module["rates"](
            sympy.Symbol("t"), [sympy.Symbol(name) for name in self.coordinates], [sympy.Symbol(name) for name in self.parameters]
        )
        return dict(zip((*self.coordinates, *self.further), rates))

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame with a row for each rate, and for what is further there: its name and SymPy's expression."""
        return data_frame(("quantity", "rate"), list(self.to_sympy().items()))

    def __repr__(self) -> str:
        symbols = ", ".join(self.parameters) or "the coordinates alone"
        return f"<equations of {self.system} by {self.method}: {len(self.coordinates)} rates, {self.operations} operations, symbols: {symbols}>"

    def _repr_html_(self) -> str:
        return f"<p>{html.escape(repr(self)[1:-1])}</p><pre>{html.escape(self.text('sympy'))}</pre>"


def derivation_methods() -> dict[str, str]:
    """The methods that derive equations, with their titles."""
    return dict(_pfaff.derivation_methods())


def derive(
    system: str | System, method: str | None = None, *, friction_form: str | None = None, order: int = 4, elimination: Sequence[str] = (),
    **parameters: Any
) -> Equations:
    """Derives the equations of motion of a system from its energy and its constraints.

    Args:
        system: a registered name, a text model or a `pfaff.System`, whose parameters become symbols where that is possible;
            whole numbers that shape a system stay numbers.
        method: one of `pfaff.derivation_methods()`; without it the first that fits the system.
        friction_form: "metriplectic", "stokes" or "none"; without it that of the formulation that the method derives.
        order: the degree of a generating function, of the method "generating-function".
        elimination: the order in which constraints are eliminated, by their names, of methods that take one after the
            other.
        **parameters: of the system.

    Raises:
        InputError: unknown names, a method that does not fit, with those that do.

    >>> import pfaff
    >>> rates = pfaff.derive("magnetic-induction", "birkhoffian").to_sympy()
    >>> len(rates) == pfaff.System("magnetic-induction").dimension
    True
    """
    if "friction-form" in parameters:
        raise InputError("'friction-form' is how the command line calls it; expected friction_form=")
    friction = "" if friction_form is None else text(friction_form, "friction_form", "the name of one or None")
    if method is not None and not text(method, "method", "the name of one or None"):
        raise InputError("method: expected the name of one, or None for the first that fits, got ''")
    chosen = (method or "", friction, whole(order, "order", 1), texts(elimination, "elimination", '["phi1"]'))
    if isinstance(system, (str, os.PathLike)):
        name = os.fspath(system)
        values = [(key, text_of_setting(value, f"parameter '{key}' of {name}")) for key, value in parameters.items()]
        return Equations(_pfaff.derive_named(name, values, *chosen))
    made = as_system(system, **parameters)
    if made.registered_name:
        return Equations(_pfaff.derive_named(made.registered_name, list(made.parameters.items()), *chosen))
    with tempfile.TemporaryDirectory(prefix="pfaff-") as folder:
        path = os.path.join(folder, f"{made.name}.toml")
        try:
            with open(path, "w", encoding="utf-8") as file:
                file.write(made.to_toml())
        except InputError:  # it has what no text model says, and derivation may not need
            return Equations(_pfaff.derive_object(made.model, *chosen))
        return Equations(_pfaff.derive_named(path, [], *chosen))
