"""What is drawn: arrays, names and axes as the functions of pfaff.plots take them."""
from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arguments import dictionary, dictionary_or_none, real_array, shown, text, texts, unknown
from ._errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def given_axes(axes: Any) -> Axes:
    """Axes that are drawn into, which an array of them is not."""
    if not hasattr(axes, "plot") or not hasattr(axes, "figure"):
        raise InputError(f"axes: expected one of matplotlib's Axes, got {shown(axes)}")
    return axes


def given_times(t: Any) -> np.ndarray:
    """An array of times."""
    times = real_array(t, "t", "times of shape (n,)")
    if times.ndim != 1:
        raise InputError(f"t: expected times of shape (n,), got shape {times.shape}")
    return times


def given_series(values: Any, times: np.ndarray, what: str) -> np.ndarray:
    """An array of a number for each time."""
    expected = f"{len(times)} numbers, one for each time"
    series = real_array(values, what, expected)
    if series.shape != times.shape:
        raise InputError(f"{what}: expected {expected}, got shape {series.shape}")
    return series


def given_states(t: Any, z: Any, names: Any) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Times, states, and the names of their coordinates."""
    times, columns = given_times(t), texts(names, "names", '["q", "p"]')
    expected = f"states of shape ({len(times)}, {len(columns)}), as there are times and names"
    states = real_array(z, "z", expected)
    if states.shape != (len(times), len(columns)) or not columns:
        raise InputError(f"z: expected {expected}, got shape {states.shape}")
    return times, states, columns


def places_of(names: Sequence[str], chosen: str | Sequence[str] | None, default: Sequence[str]) -> list[int]:
    """The numbers of the columns that are chosen by name."""
    wanted = [chosen] if isinstance(chosen, str) else texts(default if chosen is None else chosen, "coordinates", f"{list(names[:2])}")
    for name in wanted:
        if name not in names:
            raise InputError(unknown("coordinate", name, list(names)))
    if not wanted:
        raise InputError(f"coordinates: expected one at least, such as {list(names[:1])}")
    return [list(names).index(name) for name in wanted]


def label_of(name: str, unit: str = "", what: str = "time_unit") -> str:
    """The label of an axis; the unit was given as the argument `what`."""
    return f"{name} [{unit}]" if text(unit, what) not in ("", "1") else name


def pairs_of(curves: Any) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Two arrays of one shape by each label."""
    expected = "a dictionary of pairs of arrays, (work, error), by the labels of methods"
    pairs = {}
    for label, pair in dictionary(curves, "curves", expected).items():
        rows = real_array(pair, f"curves['{label}']", "a pair of arrays of one shape")
        if rows.ndim != 2 or len(rows) != 2:
            raise InputError(f"curves['{label}']: expected a pair of arrays of one shape, got shape {rows.shape}")
        pairs[label] = (rows[0], rows[1])
    return pairs


def given_units(units: Any) -> dict[str, str]:
    """Units by the names of what has them."""
    given = dictionary_or_none(units, "units", "a dictionary of units by the names of what has them")
    return {name: text(unit, f"units['{name}']") for name, unit in given.items()}


Rod = tuple["int | list[float]", "int | list[float]"]


def given_rods(rods: Any, count: int, dimension: int) -> list[Rod]:
    """Pairs of the numbers of so many bodies, of which -1 is the origin, or of fixed places instead."""
    expected = f"rods between bodies 0 .. {count - 1}, as pairs of their numbers, of which -1 is the origin, or of places, [x, y]"
    if not isinstance(rods, Iterable) or isinstance(rods, (str, bytes, Mapping)):
        raise InputError(f"rods: expected {expected}, got {shown(rods)}")
    pairs: list[Rod] = []
    for rod in rods:
        ends = [_end(one, count, dimension) for one in rod] if isinstance(rod, Iterable) and not isinstance(rod, (str, bytes, Mapping)) else []
        if len(ends) != 2 or ends[0] is None or ends[1] is None:
            raise InputError(f"rods: expected {expected}, got {shown(rod)}")
        pairs.append((ends[0], ends[1]))
    return pairs


def _end(given: Any, count: int, dimension: int) -> int | list[float] | None:
    """The end of a rod: the number of a body or a place; None where it is neither."""
    try:
        one = real_array(given, "rods", "numbers")
    except InputError:
        return None
    if one.shape == (dimension,) and np.isfinite(one).all():
        return [float(x) for x in one]
    if one.shape or not -1 <= one < count or one != int(one):
        return None
    return [0.0] * dimension if one == -1 else int(one)
