"""Figures in the style of the report, one line each. They need matplotlib.

Each function takes arrays, draws into `axes` where these are given and into a new figure otherwise, and returns the axes.
Times are of shape (n,) and states of shape (n, dimension), in the order of time.
"""
from __future__ import annotations

import contextlib
import functools
import pathlib
import runpy
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _pfaff
from ._arguments import dictionary, dictionary_or_none, real_array, text, unknown, whole, yes_or_no
from ._arguments import path as path_of
from ._errors import InputError
from ._numbers import float_of_number
from ._plotted import given_axes, given_rods, given_series, given_states, given_times, label_of, pairs_of, places_of

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

    from ._run import Run


@functools.cache
def _families() -> dict[str, Any]:
    """What the scripts of the report say of families of methods: colours, marks and dashes."""
    return runpy.run_path(_pfaff.shipped_path("report/families.py"))


@contextlib.contextmanager
def _style() -> Iterator[None]:
    """The style of the report; ImportError, which says what is missing, without matplotlib.

    What is put back is what the style changes, and not all settings, as matplotlib's own context does: a notebook's
    backend turns others on when the first figure is made.
    """
    try:
        import matplotlib
    except ImportError:
        raise ImportError("plots need matplotlib, which is not installed (Debian's python3-matplotlib)") from None
    from cycler import cycler

    style = matplotlib.rc_params_from_file(_pfaff.shipped_path("report/screen.mplstyle"), use_default_template=False)
    style["axes.prop_cycle"] = cycler(color=[family.light for family in _families()["FAMILIES"]])
    before = {key: matplotlib.rcParams[key] for key in style}
    try:
        matplotlib.rcParams.update(style)
        yield
    finally:
        matplotlib.rcParams.update(before)


def _styled(draw: Callable[..., Any]) -> Callable[..., Any]:
    """Draws in the style of the report, and leaves the settings of the caller as they were."""

    @functools.wraps(draw)
    def drawn(*arguments: Any, **keywords: Any) -> Any:
        with _style():
            return draw(*arguments, **keywords)

    return drawn


def _axes(axes: Axes | None, size: tuple[float, float] = (6.4, 4.0), **keywords: Any) -> Axes:
    if axes is not None:
        return given_axes(axes)
    from matplotlib import pyplot

    return pyplot.subplots(figsize=size, layout="constrained", **keywords)[1]


@_styled
def trajectory(
    t: Any, z: Any, names: Sequence[str], *, coordinates: str | Sequence[str] | None = None, time_unit: str = "",
    axes: Axes | None = None
) -> Axes:
    """Coordinates against time; all of them without `coordinates`.

    >>> import numpy as np, matplotlib
    >>> matplotlib.use("agg")
    >>> t = np.linspace(0, 6, 50)
    >>> axes = trajectory(t, np.column_stack([np.cos(t), -np.sin(t)]), ["q", "p"])
    >>> [line.get_label() for line in axes.get_lines()]
    ['q', 'p']
    """
    times, states, names = given_states(t, z, names)
    places, label = places_of(names, coordinates, names), label_of("t", time_unit)
    axes = _axes(axes)  # once all else is right, so that no empty figure is left
    for k in places:
        axes.plot(times, states[:, k], label=names[k])
    axes.set_xlabel(label)
    if len(axes.get_lines()) > 1:
        axes.legend(frameon=False)
    else:
        axes.set_ylabel(axes.get_lines()[0].get_label())
    return axes


@_styled
def phase_portrait(
    t: Any, z: Any, names: Sequence[str], *, coordinates: Sequence[str] | None = None, axes: Axes | None = None
) -> Axes:
    """One coordinate against another: the first position and its momentum, the first of each half of the coordinates.

    `coordinates` names two others, such as ["q1", "q2"].
    """
    _, states, names = given_states(t, z, names)
    pair = places_of(names, coordinates, [names[0], names[max(1, len(names) // 2)]] if len(names) > 1 else names)
    if len(pair) != 2:
        raise InputError(f"phase portrait: expected two coordinates, got {len(pair)}")
    axes = _axes(axes, (4.6, 4.2))
    axes.plot(states[:, pair[0]], states[:, pair[1]])
    axes.plot(states[0, pair[0]], states[0, pair[1]], marker="o", fillstyle="none", linestyle="none", color=axes.get_lines()[-1].get_color())
    axes.set(xlabel=names[pair[0]], ylabel=names[pair[1]])
    return axes


@_styled
def drift(t: Any, values: Mapping[str, Any], *, time_unit: str = "", relative: bool = False, axes: Axes | None = None) -> Axes:
    """By how much each named quantity differs from its value at the start, |I(t) - I(0)|, on a logarithmic scale.

    Args:
        t: times, shape (n,).
        values: arrays of shape (n,) by their names, such as run.invariants.
        relative: divided by |I(0)|, where that is not 0.
    """
    times, divided = given_times(t), yes_or_no(relative, "relative")
    given = dictionary(values, "values", "a dictionary of arrays by their names")
    listed, label = {name: given_series(one, times, f"values['{name}']") for name, one in given.items()}, label_of("t", time_unit)
    axes = _axes(axes)
    for name, series in listed.items():
        difference = np.abs(series - series[0])
        if divided and series[0] != 0:
            difference = difference / abs(series[0])
        _logarithmic(axes, times[1:], difference[1:], name)
    axes.set(xlabel=label, ylabel="relative difference from the start" if divided else "difference from the start")
    axes.legend(frameon=False)
    return axes


@_styled
def measure(t: Any, values: Any, name: str, *, unit: str = "", time_unit: str = "", axes: Axes | None = None) -> Axes:
    """A measured series against time, such as the structure residual: on a logarithmic scale where nothing is negative.

    What was not measured is not-a-number, and is left out.
    """
    times = given_times(t)
    series, labels = given_series(values, times, "values"), (label_of("t", time_unit), label_of(text(name, "name"), unit, "unit"))
    known = np.isfinite(series)
    axes = _axes(axes)
    if known.any() and (series[known] >= 0).all() and (series[known] > 0).any():
        _logarithmic(axes, times[known], series[known], name)
    else:
        axes.plot(times[known], series[known], label=name)
    axes.set(xlabel=labels[0], ylabel=labels[1])
    return axes


def _logarithmic(axes: Axes, times: np.ndarray, values: np.ndarray, name: str) -> None:
    """A line on a logarithmic scale. Zeros, which have no place on it, stand a tenth below the smallest of the others."""
    positive = values[values > 0]
    least = positive.min() / 10 if len(positive) else 1e-17
    axes.plot(times, np.where(values > 0, values, least), label=name)
    axes.set_yscale("log")


@_styled
def work_precision(
    curves: Mapping[str, tuple[Any, Any]], *, families: Mapping[str, str] | None = None, work: str = "time of computation for a unit of time [ns]",
    error: str = "largest error", axes: Axes | None = None
) -> Axes:
    """Error against work, a line for each method over its steps. Down and to the left is better.

    Args:
        curves: (work, error), two arrays of one shape, by the label of the method.
        families: the family of each method, which gives its colour and its mark.
    """
    given, labels = pairs_of(curves), {"xlabel": text(work, "work"), "ylabel": text(error, "error")}
    of = {key: text(value, f"families['{key}']") for key, value in dictionary_or_none(families, "families").items()}
    axes = _axes(axes, (6.4, 4.6))
    ranks: dict[str, int] = {}
    for label, (cost, errors) in given.items():
        family = _families()["family_named"](of.get(label, "other"))
        ranks[family.key] = ranks.get(family.key, -1) + 1
        axes.loglog(cost, errors, label=label, **_families()["style"](family, ranks[family.key], "full"))
    axes.set(**labels)
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    return axes


def of_run(run: Run, kind: str = "trajectory", **keywords: Any) -> Any:
    """What `run.plot(kind, ...)` draws; further arguments are those of the function that draws it.

    The kinds are "trajectory", "phase portrait", "drift" (of conserved invariants), "constraints", "structure residual", "error",
    "animation" (of beads and rods, see bodies()), and every column of a measure that was asked for, "MEASURE: COLUMN".

    Raises:
        InputError: an unknown kind, with the nearest, and one that the run has nothing for.
    """
    if not isinstance(kind, str):
        raise InputError(unknown("kind", kind, ["trajectory"]))
    unit = run.units.get("t", "")
    series = {"error": run.error, "structure residual": run.structure}
    columns = {
        f"{name}: {column}": (table, column)
        for name, table in run.measures.items()
        for column, values in table.items()
        if column != "step" and "step" in table and not any(isinstance(value, str) for value in values)
    }
    if kind == "trajectory":
        return trajectory(run.t, run.y, run.coordinates, time_unit=unit, **keywords)
    if kind == "phase portrait":
        return phase_portrait(run.t, run.y, run.coordinates, **keywords)
    if kind == "drift" and run.drift:
        return drift(run.t, {name: run.invariants[name] for name in run.drift}, time_unit=unit, **keywords)
    if kind == "constraints" and run.constraints:
        axes = keywords.pop("axes", None)
        for name, values in run.constraints.items():
            axes = measure(run.t, values, name, time_unit=unit, axes=axes, **keywords)
        axes.set_ylabel("residual")
        axes.legend(frameon=False)
        return axes
    if series.get(kind) is not None:
        return measure(run.t, series[kind], kind, time_unit=unit, **keywords)
    if kind == "animation":
        return _animation_of(run, **keywords)
    if kind in columns:
        table, column = columns[kind]
        times = run.t[0] + np.asarray(table["step"], float) * float(run.summary["step"])
        return measure(times, table[column], kind, time_unit=unit, **keywords)
    known = ["trajectory", "phase portrait", "drift", "constraints", *series, "animation", *columns]
    if kind in known:
        raise InputError(f"plot: the run has no {kind}")
    raise InputError(unknown("plot", kind, known))


def _animation_of(run: Run, **keywords: Any) -> FuncAnimation:
    """The positions of beads are the coordinates x0, y0, z0, x1, ... of a state."""
    of_beads = [name for name in run.coordinates if name[0] in "xyz" and name[1:].isdigit()]
    dimension = len({name[0] for name in of_beads})
    if dimension not in (2, 3) or run.coordinates[: len(of_beads)] != of_beads:
        raise InputError(f"plot: expected a system of beads and rods, got {run.system.name}; plots.bodies draws any positions")
    return bodies(run.t, run.y[:, : len(of_beads)].reshape(len(run.t), -1, dimension), **keywords)


@_styled
def bodies(
    t: Any, positions: Any, rods: Sequence[tuple[int, int]] | None = None, *, origin: bool = True, frames: int = 120,
    seconds: float = 6.0
) -> FuncAnimation:
    """An animation of bodies that rods join, such as pendula and chains: `.to_jshtml()` shows it in a notebook.

    Args:
        t: times, shape (n,).
        positions: shape (n, bodies, 2) or (n, bodies, 3), of which the first and the last component are drawn.
        rods: pairs of numbers of bodies, counted from 0, of which -1 is the origin; without, each body hangs on the one
            before it, and the first on the origin where `origin` is True.
        frames: how many pictures there are at most, evenly spaced in the samples.
        seconds: how long it takes.
    """
    from matplotlib import pyplot
    from matplotlib.animation import FuncAnimation

    times, hangs, most = given_times(t), yes_or_no(origin, "origin"), whole(frames, "frames", 1)
    lasts = float_of_number(seconds, "seconds", "a time above 0 s", above=0)
    expected = f"positions of shape ({len(times)}, bodies, 2 or 3), as there are times"
    places = real_array(positions, "positions", expected)
    if places.ndim != 3 or places.shape[2] not in (2, 3) or len(places) != len(times):
        raise InputError(f"positions: expected {expected}, got shape {places.shape}")
    places = places[:, :, [0, -1]]
    count = places.shape[1]
    pairs = given_rods(rods, count) if rods is not None else [(k - 1, k) for k in range(0 if hangs else 1, count)]
    pinned = np.concatenate([np.zeros((len(times), 1, 2)), places], axis=1)
    shown = np.unique(np.linspace(0, len(times) - 1, min(most, len(times))).astype(int))
    figure, axes = pyplot.subplots(figsize=(4.6, 4.6), layout="constrained")
    joined = {k for pair in pairs for k in pair}
    extent = pinned if -1 in joined else places
    low, high = extent.min(axis=(0, 1)), extent.max(axis=(0, 1))
    reach = 0.55 * max(high - low) + 1e-12
    centre = (low + high) / 2
    axes.set(xlim=(centre[0] - reach, centre[0] + reach), ylim=(centre[1] - reach, centre[1] + reach), aspect="equal")
    lines = [axes.plot([], [], color="#63636a", linewidth=1.2)[0] for _ in pairs]
    (dots,) = axes.plot([], [], linestyle="none", marker="o", markersize=7)
    title = axes.set_title("")

    def draw(frame: int) -> list:
        state = pinned[frame]
        for line, (a, b) in zip(lines, pairs):
            line.set_data(state[[a + 1, b + 1], 0], state[[a + 1, b + 1], 1])
        dots.set_data(state[1:, 0], state[1:, 1])
        title.set_text(f"t = {times[frame]:.3g}")
        return [*lines, dots, title]

    animation = FuncAnimation(figure, draw, frames=shown, interval=1000 * lasts / len(shown), blit=False)
    pyplot.close(figure)  # a notebook would also show its first picture
    return animation


def svg(axes: Axes) -> str:
    """A figure as an SVG element, for pages; the figure is closed."""
    import io

    from matplotlib import pyplot

    written = io.StringIO()
    with _style():
        given_axes(axes).figure.savefig(written, format="svg")
    pyplot.close(axes.figure)
    return written.getvalue()[written.getvalue().index("<svg") :]


def save(axes: Axes, path: str | pathlib.Path) -> None:
    """Writes the figure to a file, whose ending says what kind it is: .svg, .pdf or .png."""
    with _style():
        given_axes(axes).figure.savefig(path_of(path, "path", "that of a file, such as 'run.svg'"))
