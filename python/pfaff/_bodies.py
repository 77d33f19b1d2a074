"""Where the bodies of a run are, and which rods join them, for pictures of its motion.

Of beads, whose coordinates are x0, y0, (z0,) x1, ..., the rods are those constraints of the system that hold two of them, or one
and a fixed place, at a distance: the links of a run's summary. Coordinates of other systems do not say where something is. The
table below does, of the pendula among the registered systems; of others the caller says it.
"""
from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arguments import function, real_array
from ._errors import InputError

if TYPE_CHECKING:
    from ._run import Run

# Positions, shape (rows, bodies, 2 or 3); what joins them, as plots.bodies takes it; and the unit of length.
Bodies = tuple[np.ndarray, list[Any], str]


def bodies_of(run: Run, positions: Any, rods: Any) -> Bodies:
    """The bodies of a run, with the positions and the rods that the caller gives, where these are given.

    Raises:
        InputError: a system whose coordinates do not say where its bodies are, and positions of other shapes.
    """
    if positions is not None:
        return _places_by(positions, run.y), [] if rods is None else rods, ""
    places, joined, unit = _PENDULA.get(getattr(run.system, "registered_name", ""), _beads)(run)
    return places, joined if rods is None else rods, unit


def _places_by(positions: Any, states: np.ndarray) -> np.ndarray:
    expected = "a function of a state that gives the places of bodies, shape (bodies, 2 or 3)"
    of_state = function(positions, "positions", expected)
    places = [real_array(of_state(state), "positions", expected) for state in states]
    for one in places:
        if one.ndim != 2 or one.shape[1] not in (2, 3) or one.shape != places[0].shape:
            raise InputError(f"positions: expected {expected}, got shape {one.shape}")
    return np.array(places)


def _beads(run: Run) -> Bodies:
    for axes in ("xyz", "xy"):
        count = 0
        while run.coordinates[count * len(axes) : (count + 1) * len(axes)] == [f"{axis}{count}" for axis in axes]:
            count += 1
        if count:
            places = run.y[:, : count * len(axes)].reshape(len(run.t), count, len(axes))
            return places, list(run.summary.get("links", [])), run.units.get(run.coordinates[0], "")
    raise InputError(
        f"plot: expected a system of beads, x0, y0, x1, ..., or a registered pendulum, got {run.system.name}; "
        "give positions, a function of a state that says where its bodies are")


def _hanging(angles: np.ndarray, lengths: Any, unit: str) -> Bodies:
    """Bobs below each other, at angles from the downward vertical; both of shape (rows, bobs), or lengths of one that they broadcast to."""
    steps = np.asarray(lengths)[..., np.newaxis] * np.stack([np.sin(angles), -np.cos(angles)], axis=-1)
    return np.cumsum(steps, axis=1), [(k - 1, k) for k in range(angles.shape[1])], unit


def _parameter(run: Run, name: str) -> float:
    return float(Fraction(run.system.parameters[name]))


def _columns(run: Run, names: Sequence[str]) -> np.ndarray:
    return run.y[:, [run.coordinates.index(name) for name in names]]


def _simple(name: str) -> Callable[[Run], Bodies]:
    return lambda run: _hanging(_columns(run, [name]), 1.0, "")  # a pendulum without a length


def _in_angles(run: Run) -> Bodies:
    return _hanging(run.y[:, : len(run.coordinates) // 2], _parameter(run, "length"), "m")


def _in_polar_coordinates(run: Run) -> Bodies:
    return _hanging(_columns(run, ["theta_1", "theta_2"]), _columns(run, ["r_1", "r_2"]), "m")


def _spherical(run: Run) -> Bodies:
    return _columns(run, ["x", "y", "z"])[:, np.newaxis], [(-1, 0)], "m"


def _shaken(run: Run) -> Bodies:
    height = _parameter(run, "amplitude") * np.cos(_parameter(run, "frequency") * run.t)
    support = np.column_stack([np.zeros_like(height), height])
    return np.stack([support, _columns(run, ["x", "y"])], axis=1), [(0, 1)], "m"


_PENDULA: dict[str, Callable[[Run], Bodies]] = {
    "pendulum": _simple("q"), "damped-pendulum": _simple("r"), "n-pendulum-angles": _in_angles, "polar-double-pendulum": _in_polar_coordinates,
    "spherical-pendulum": _spherical, "shaken-pendulum": _shaken,
}
