"""What is drawn: arrays, names and axes as the functions of pfaff.plots take them."""
from __future__ import annotations

from collections.abc import Sequence
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


def given_rods(rods: Any, count: int) -> list[tuple[int, int]]:
    """Pairs of numbers of so many bodies, of which -1 is the origin."""
    expected = f"rods between bodies 0 .. {count - 1}, as pairs of their numbers, of which -1 is the origin"
    array = real_array(rods, "rods", expected)
    if array.size and (array.ndim != 2 or array.shape[1] != 2):
        raise InputError(f"rods: expected {expected}, got {shown(rods)}")
    for pair in array.reshape(-1, 2):
        if not all(-1 <= k < count and k == int(k) for k in pair):
            raise InputError(f"rods: expected {expected}, got ({pair[0]:g}, {pair[1]:g})")
    return [(int(a), int(b)) for a, b in array.reshape(-1, 2)]
