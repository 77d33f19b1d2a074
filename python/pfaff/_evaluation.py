"""Evaluation of a system at one state: its field, energy, structure and constraints, and brackets of functions."""
from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _pfaff
from ._arguments import function, real_array, shown, text, unknown
from ._definition import Coordinates
from ._errors import InputError
from ._numbers import float_of_number, text_of_number, texts_of_coordinates
from ._objects import as_system
from ._system import System, Traced
from ._tables import data_frame, html_table, text_table
from ._tracing import call_by_names, flat, recorded


if TYPE_CHECKING:
    import pandas


class Evaluation(Mapping[str, Any]):
    """What the formulas of a system give at one state and time, by name.

    `evaluation["rhs"]` is the rate of the state, others are energy, K, constraints, W, dirac_bracket and so on;
    docs/birkhoffian-tools.md and docs/formulations.md say which there are. Numbers are floats and arrays; in quad they
    are texts with all digits. What does not exist is None.
    """

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = {key: _array(value) for key, value in values.items() if key != "schema"}

    def __getitem__(self, key: str) -> Any:
        if not isinstance(key, str) or key not in self._values:
            raise InputError(unknown("quantity", key, list(self._values)))
        return self._values[key]

    def __iter__(self):
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __contains__(self, key: object) -> bool:
        return key in self._values

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame with a row for each quantity and its value."""
        return data_frame(("quantity", "value"), list(self._values.items()))

    def _rows(self) -> list[tuple[str, Any]]:
        return [(key, str(value).replace("\n", "")) for key, value in self._values.items()]

    def __repr__(self) -> str:
        return text_table(("quantity", "value"), self._rows())

    def _repr_html_(self) -> str:
        return html_table(("quantity", "value"), self._rows())


def _array(value: Any) -> Any:
    """Lists of numbers, and lists of such lists, as arrays; what is not finite, None among them, as NaN."""
    if isinstance(value, list) and value:
        try:
            array = np.array(value)
            if array.dtype == object and all(x is None or isinstance(x, (int, float)) for x in array.ravel()):
                array = array.astype(float)
        except ValueError:
            return value
        return array if array.dtype.kind == "f" or array.dtype.kind == "i" else value
    return value


def evaluate(
    system: str | System, state: Sequence[Any] | None = None, *, time: Any = 0, formulation: str | None = None,
    precision: str = "double", centre: Sequence[Any] | None = None, **parameters: Any
) -> Evaluation:
    """Everything that the formulas of a system give at one state and time.

    Args:
        system: a registered name, the path of a text model, or a `pfaff.System`.
        state: shape (dimension,); the system's own initial state without it. Texts such as "1/3" are exact.
        time: the time.
        formulation: of the motion of a system with constraints, with parameters or without, such as
            "lmm(friction-form=metriplectic)"; the default one without.
        precision: "double" or "quad".
        centre: the point about which F and B are made of K and D, shape (dimension,).
        **parameters: of the system.

    Raises:
        InputError: unknown names, a state of another size, a formulation that does not fit.

    >>> import pfaff
    >>> at = pfaff.evaluate("pendulum", [1, 0])
    >>> at["status"], at["rhs"].shape
    ('converged', (2,))
    """
    base = as_system(system, **parameters)
    numbers = [] if state is None else texts_of_coordinates(state, "state", base.coordinates)
    about = None if centre is None else texts_of_coordinates(centre, "centre", base.coordinates)
    named = "" if formulation is None else text(formulation, "formulation", "the name of a formulation")
    scalar = text(precision, "precision", "'double' or 'quad'")
    return Evaluation(_pfaff.evaluate(base.model, numbers, text_of_number(time, "time"), named, scalar, about))


def bracket(
    f: Callable[..., Any], g: Callable[..., Any], z: Sequence[float], *, on: str | System, time: float = 0.0, **parameters: Any
) -> float:
    """The bracket {f, g} of two functions at a state, of the structure of a system.

    That is df . Pi(z, t) dg with exact derivatives. A system with constraints has the Dirac bracket of its motion, in
    its default formulation; one with constraints of velocities alone the nonholonomic bracket at momenta whose
    velocities satisfy them.

    Args:
        f, g: functions of the state, recorded once. Their arguments are called as those of the formulas of a system are:
            coordinates and blocks of them by their names, the time `t`, the whole state `z`, its halves `q` and `p`.
        z: the state, shape (dimension,).
        on: the system: a name, the path of a text model, or a `pfaff.System`.
        time: the time.
        **parameters: of the system.

    Raises:
        InputError: a state of another size or without a bracket, as where constraints are first class, a function that
            returns other than one number, a system that states a field alone.
        TraceError: a function that compares values or calls `math`.

    >>> import pfaff
    >>> pfaff.bracket(lambda q: q, lambda p: p, [0.5, 0.2], on="pendulum")
    1.0
    """
    system = as_system(on, "on", **parameters)
    model, coordinates = system.model, _coordinates_of(system)
    names = coordinates.names
    expected = f"shape ({len(names)},), a finite number for each of {', '.join(names)}"
    state = real_array(z, "z", expected)
    if state.shape != (len(names),) or not np.isfinite(state).all():
        raise InputError(f"z: expected {expected}, got {shown(z)}")
    first, second = (_tape(function(one, what, "a function of the state"), what, coordinates) for one, what in ((f, "f"), (g, "g")))
    value = _pfaff.bracket(model, first, second, float_of_number(time, "time"), list(state))
    if not np.isfinite(value):
        raise InputError(f"z: the bracket on {system.name} has no finite value there; of constraints that have none, such as first-class ones, `pfaff.evaluate` says which they are")
    return value


def _coordinates_of(system: System) -> Coordinates:
    """The coordinates as formulas of the system name them; one by one of a system that is not written here."""
    if not isinstance(system._definition, Traced):
        return Coordinates(system.coordinates, {}, f"system {system.name}")
    written = system._definition.definition
    return Coordinates(written.coordinates, written.arguments(written.values(system._given)), written.what)


def _tape(function: Callable[..., Any], what: str, coordinates: Coordinates) -> _pfaff.Tape:
    """A function of the state as a tape with one output."""

    def formula(t: Any, inputs: Sequence[Any]) -> list[Any]:
        known = {"t": t, **dict(zip(coordinates.names, inputs)), **coordinates.known(inputs)}
        values = flat(call_by_names(function, known, what), what)
        if len(values) != 1:
            raise InputError(f"{what}: expected a function that returns one number, got {len(values)}")
        return values

    return recorded(len(coordinates), formula, what)
