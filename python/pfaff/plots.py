"""Figures in the style of the report, one line each. They need matplotlib.

Each function takes arrays, draws into `axes` where these are given and into a new figure otherwise, and returns the axes.
Times are of shape (n,) and states of shape (n, dimension), in the order of time.
"""
from __future__ import annotations

import inspect
import pathlib
import weakref
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arguments import dictionary, dictionary_or_none, real_array, text, unknown, whole, yes_or_no
from ._arguments import path as path_of
from ._bodies import bodies_of
from ._curves import curves_in, draw, draw_logarithmic, label_axes, name_run
from ._errors import InputError
from ._numbers import float_of_number
from ._plotted import given_axes, given_rods, given_series, given_states, given_times, given_units, label_of, pairs_of, places_of
from ._style import axes_to_draw_into, families as report_families, look, refuse_unknown, settings, style, styled

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

    from ._run import Run


@styled
def trajectory(
    t: Any, z: Any, names: Sequence[str], *, coordinates: str | Sequence[str] | None = None, units: Mapping[str, str] | None = None,
    time_unit: str = "", label: str = "", axes: Axes | None = None
) -> Axes:
    """Coordinates against time; all of them without `coordinates`.

    Args:
        t: times, shape (n,).
        z: states, shape (n, dimension).
        names: of the coordinates, in the order of a state.
        coordinates: the names of those that are drawn.
        units: of coordinates, by their names.
        time_unit: that of t.
        label: what stands before the entries of the legend, such as the name of a run.
        axes: what is drawn into; a new figure without.

    >>> import numpy as np, matplotlib
    >>> matplotlib.use("agg")
    >>> t = np.linspace(0, 6, 50)
    >>> axes = trajectory(t, np.column_stack([np.cos(t), -np.sin(t)]), ["q", "p"], units={"q": "m", "p": "m/s"})
    >>> [line.get_label() for line in axes.get_lines()]
    ['q [m]', 'p [m/s]']
    """
    times, states, names = given_states(t, z, names)
    places, of, along, before = places_of(names, coordinates, names), given_units(units), label_of("t", time_unit), text(label, "label")
    axes = axes_to_draw_into(axes)  # once all else is right, so that no empty figure is left
    for k in places:
        draw(axes, times, states[:, k], names[k], unit=of.get(names[k], ""), label=before)
    label_axes(axes, along)
    return axes


@styled
def phase_portrait(
    t: Any, z: Any, names: Sequence[str], *, coordinates: Sequence[str] | None = None, units: Mapping[str, str] | None = None,
    label: str = "", axes: Axes | None = None
) -> Axes:
    """One coordinate against another: the first position and its momentum, the first of each half of the coordinates.

    `coordinates` names two others, such as ["q1", "q2"]; two positions of one unit have equal scales in a figure of their own. A
    circle is where the motion starts. Other arguments are those of trajectory().
    """
    _, states, names = given_states(t, z, names)
    pair = places_of(names, coordinates, [names[0], names[max(1, len(names) // 2)]] if len(names) > 1 else names)
    if len(pair) != 2:
        raise InputError(f"phase portrait: expected two coordinates, got {len(pair)}")
    (x, y), of, before, own = pair, given_units(units), text(label, "label"), axes is None
    axes = axes_to_draw_into(axes, (4.6, 4.2))
    line = draw(axes, states[:, x], states[:, y], "", unit=of.get(names[y], ""), label=before, quantity=names[y])
    axes.plot(states[:1, x], states[:1, y], marker="o", fillstyle="none", linestyle="none", color=line.get_color(), markersize=settings()["lines.markersize"])
    if own and max(pair) < len(names) // 2 and of.get(names[x]) == of.get(names[y]):
        axes.set_aspect("equal", adjustable="datalim")
    label_axes(axes, label_of(names[x], of.get(names[x], "")))
    return axes


@styled
def drift(
    t: Any, values: Mapping[str, Any], *, units: Mapping[str, str] | None = None, time_unit: str = "", relative: bool = False, label: str = "",
    axes: Axes | None = None
) -> Axes:
    """By how much each named quantity differs from its value at the start, |I(t) - I(0)|, on a logarithmic scale.

    What is less than unit round-off of the largest |I| is drawn on it.

    Args:
        t: times, shape (n,).
        values: arrays of shape (n,) by their names, such as run.invariants.
        units: of these quantities, by their names.
        time_unit: that of t.
        relative: divided by |I(0)|, where that is not 0.
        label: what stands before the entries of the legend, such as the name of a run.
        axes: what is drawn into; a new figure without.
    """
    times, divided = given_times(t), yes_or_no(relative, "relative")
    given = dictionary(values, "values", "a dictionary of arrays by their names")
    listed, along = {name: given_series(one, times, f"values['{name}']") for name, one in given.items()}, label_of("t", time_unit)
    of, before = given_units(units), text(label, "label")
    quantity = "relative difference from the start" if divided else "difference from the start"
    axes = axes_to_draw_into(axes)
    for name, series in listed.items():
        scale = abs(series[0]) if divided and len(series) and series[0] != 0 else 1.0
        least = np.finfo(float).eps / 2 * np.abs(series[np.isfinite(series)]).max(initial=0) / scale
        with np.errstate(invalid="ignore"):  # what is not finite is left out
            differences = np.abs(series - series[:1])[1:] / scale
        draw_logarithmic(axes, times[1:], differences, name, least=least, unit="" if divided else of.get(name, ""), label=before, quantity=quantity)
    label_axes(axes, along, always=True)
    return axes


@styled
def measure(
    t: Any, values: Any, name: str, *, unit: str = "", time_unit: str = "", label: str = "", axes: Axes | None = None
) -> Axes:
    """A measured series against time, such as the structure residual: on a logarithmic scale where nothing is negative.

    What was not measured is not-a-number, and is left out. `label` stands before the entry of the legend.
    """
    times = given_times(t)
    series, along = given_series(values, times, "values"), label_of("t", time_unit)
    what: dict[str, Any] = {"name": text(name, "name"), "unit": text(unit, "unit"), "label": text(label, "label")}
    axes = _measured(axes_to_draw_into(axes), times, series, **what)
    label_axes(axes, along)
    return axes


def _measured(axes: Axes, times: np.ndarray, series: np.ndarray, least: float = 0, **what: Any) -> Axes:
    known = np.isfinite(series)
    scaled = (series[known] > 0).any() or least > 0 or axes.get_yscale() == "log"
    if known.any() and (series[known] >= 0).all() and scaled:
        draw_logarithmic(axes, times[known], series[known], least=least, **what)
    else:
        draw(axes, times[known], series[known], **what)
    return axes


@styled
def _residuals(t: Any, values: Mapping[str, Any], *, time_unit: str = "", label: str = "", axes: Axes | None = None) -> Axes:
    """Series of residuals, by their names, of which zeros stand below all others."""
    times, before = given_times(t), text(label, "label")
    positive = [one for series in values.values() for one in series[series > 0]]
    axes = axes_to_draw_into(axes)
    for name, series in values.items():
        _measured(axes, times, series, min(positive, default=0) / 2, name=name, label=before, quantity="residual")
    label_axes(axes, label_of("t", time_unit), always=True)
    return axes


@styled
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
    axes = axes_to_draw_into(axes, (6.4, 4.6))
    ranks: dict[str, int] = {}
    for label, (cost, errors) in given.items():
        family = report_families()["family_named"](of.get(label, "other"))
        ranks[family.key] = ranks.get(family.key, -1) + 1
        axes.loglog(cost, errors, label=label, **report_families()["style"](family, ranks[family.key], "full"))
    axes.set(**labels)
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    return axes


def of_run(run: Run, kind: str = "trajectory", **keywords: Any) -> Any:
    """What `run.plot(kind, ...)` draws; further arguments are those of the function that draws it.

    The kinds are "trajectory", "phase portrait", "drift" (of conserved invariants), "constraints", "structure residual", "error",
    "animation" (see bodies()), and every column of a measure that was asked for, "MEASURE: COLUMN".

    An animation shows beads and the rods that the constraints of the system are, and the pendula among the registered systems. Of other
    systems `positions` says where something is: a function of a state, shape (dimension,), that gives places, shape (bodies, 2 or 3).
    `rods` are drawn instead of those of the system, as bodies() takes them.

    Raises:
        InputError: an unknown kind or argument, with the nearest, and a kind that the run has nothing for.
    """
    if not isinstance(kind, str):
        raise InputError(unknown("kind", kind, ["trajectory"]))
    series = {"error": run.error, "structure residual": run.structure}
    columns = {
        f"{name}: {column}": (table, column)
        for name, table in run.measures.items()
        for column in table.units
        if column != "step" and "step" in table
    }
    time = {"time_unit": _time_unit(run)}
    if kind == "trajectory":
        return _drawn(run, trajectory, keywords, run.t, run.y, run.coordinates, units=run.units, **time)
    if kind == "phase portrait":
        return _drawn(run, phase_portrait, keywords, run.t, run.y, run.coordinates, units=run.units)
    if kind == "drift" and run.drift:
        return _drawn(run, drift, keywords, run.t, {name: run.invariants[name] for name in run.drift}, units=run.units, **time)
    if kind == "constraints" and run.constraints:
        return _drawn(run, _residuals, keywords, run.t, run.constraints, **time)
    if series.get(kind) is not None:
        return _drawn(run, measure, keywords, run.t, series[kind], kind, unit="", **time)
    if kind == "animation":
        return _animation_of(run, **keywords)
    if kind in columns:
        table, column = columns[kind]
        times = run.t[0] + np.asarray(table["step"], float) * float(run.summary["step"])
        return _drawn(run, measure, keywords, times, table[column], kind, unit=table.units[column], **time)
    known = ["trajectory", "phase portrait", "drift", "constraints", *series, "animation", *columns]
    if kind in known:
        raise InputError(f"plot: the run has no {kind}")
    raise InputError(unknown("plot", kind, known))


def _time_unit(run: Run) -> str:
    """The unit of time, which says nothing where nothing else has a unit."""
    return run.units.get("t", "") if any(unit not in ("", "1") for name, unit in run.units.items() if name != "t") else ""


def _drawn(run: Run, function: Callable[..., Axes], keywords: dict[str, Any], *arguments: Any, **own: Any) -> Axes:
    """What a function draws of a run, with the caller's keywords beside its own; curves know the run that they are of."""
    optional = [name for name, one in inspect.signature(function).parameters.items() if one.kind is one.KEYWORD_ONLY]
    refuse_unknown(keywords, [name for name in optional if name not in own], "plot")
    earlier = list(curves_in(given_axes(keywords["axes"]))) if keywords.get("axes") is not None else []
    unit = run.units.get("t", "")
    if earlier and "time_unit" in own and _TIME_UNITS.get(keywords["axes"], unit) != unit:
        raise InputError(f"axes: expected some without curves, or with times in {unit or '1'}, because those that are there are in {_TIME_UNITS[keywords['axes']] or '1'}")
    axes = function(*arguments, **own, **keywords)
    if "time_unit" in own:
        _TIME_UNITS[axes] = unit
    chosen = f"tolerance {run._asked['tolerance']}" if run._asked["tolerance"] else f"step {run._asked['step']}"
    stepped = f"{run.method.name}, {chosen}"
    values = [f"{key}={value}" for one in (run.method, run.system) for key, value in one._given.items()]
    name_run(axes, earlier, [run.method.name, stepped, f"{stepped}, {run.system.name}", ", ".join([stepped, run.system.name, *values])])
    return axes


# Of the runs in axes that have a curve over time.
_TIME_UNITS: weakref.WeakKeyDictionary[Axes, str] = weakref.WeakKeyDictionary()


def _animation_of(run: Run, **keywords: Any) -> FuncAnimation:
    """The motion of the bodies of a run, see _bodies.py."""
    refuse_unknown(keywords, ["positions", "rods", "frames", "seconds"], "plot")
    places, rods, unit = bodies_of(run, keywords.pop("positions", None), keywords.pop("rods", None))
    return bodies(run.t, places, rods, unit=unit, time_unit=_time_unit(run), **keywords)


@styled
def bodies(
    t: Any, positions: Any, rods: Sequence[tuple[int | Sequence[float], int | Sequence[float]]] | None = None, *, origin: bool = True, frames: int = 120,
    seconds: float = 6.0, unit: str = "", time_unit: str = ""
) -> FuncAnimation:
    """An animation of bodies that rods join, such as pendula and chains: `.to_jshtml()` shows it in a notebook.

    Args:
        t: times, shape (n,).
        positions: shape (n, bodies, 2) or (n, bodies, 3), of which the first and the last component are drawn.
        rods: pairs of ends, which are numbers of bodies, counted from 0, of which -1 is the origin, or fixed places; without, each body
            hangs on the one before it, and the first on the origin where `origin` is True.
        frames: how many pictures there are at most, evenly spaced in the samples.
        seconds: how long it takes.
        unit: that of the positions.
        time_unit: that of t.
    """
    from matplotlib import pyplot
    from matplotlib.animation import FuncAnimation

    times, hangs, most = given_times(t), yes_or_no(origin, "origin"), whole(frames, "frames", 1)
    lasts = float_of_number(seconds, "seconds", "a time above 0 s", above=0)
    expected = f"positions of shape ({len(times)}, bodies, 2 or 3), as there are times"
    places = real_array(positions, "positions", expected)
    if places.ndim != 3 or places.shape[2] not in (2, 3) or len(places) != len(times) or not places.size:
        raise InputError(f"positions: expected {expected}, got shape {places.shape}")
    count, dimension = places.shape[1:]
    pairs = given_rods([(k - 1, k) for k in range(0 if hangs else 1, count)] if rods is None else rods, count, dimension)
    labels, clock = [label_of(name, unit, "unit") for name in ("x", "xyz"[dimension - 1])], text(time_unit, "time_unit").removeprefix("1")
    places = places[:, :, [0, -1]]
    fixed = [[end[0], end[-1]] for pair in pairs for end in pair if not isinstance(end, int)]
    shown = np.unique(np.linspace(0, len(times) - 1, min(most, len(times))).astype(int))
    figure, axes = pyplot.subplots(figsize=(4.6, 4.6), layout="constrained")
    extent = np.concatenate([places.reshape(-1, 2), np.reshape(fixed, (-1, 2))])
    extent = extent[np.isfinite(extent).all(axis=1)] if np.isfinite(extent).all(axis=1).any() else np.zeros((1, 2))
    low, high = extent.min(axis=0), extent.max(axis=0)
    reach, centre = 0.55 * max(high - low) or 1.0, (low + high) / 2
    axes.set(xlim=(centre[0] - reach, centre[0] + reach), ylim=(centre[1] - reach, centre[1] + reach), aspect="equal", xlabel=labels[0], ylabel=labels[1])
    lines = [axes.plot([], [], color=settings()["axes.edgecolor"], linewidth=1.2)[0] for _ in pairs]
    if fixed:
        axes.plot(*np.transpose(fixed), linestyle="none", marker="s", markersize=4, color=settings()["text.color"])
    (dots,) = axes.plot([], [], linestyle="none", marker="o", markersize=7, color=look(0)["color"])
    title = axes.set_title("")

    def picture(frame: int) -> list:
        state = places[frame]
        for line, pair in zip(lines, pairs):
            line.set_data(*np.transpose([state[end] if isinstance(end, int) else [end[0], end[-1]] for end in pair]))
        dots.set_data(state[:, 0], state[:, 1])
        title.set_text(f"t = {times[frame]:.3g} {clock}".strip())
        return [*lines, dots, title]

    animation = FuncAnimation(figure, picture, frames=shown, interval=1000 * lasts / len(shown), blit=False)
    pyplot.close(figure)  # a notebook would also show its first picture
    return animation


def svg(axes: Axes) -> str:
    """A figure as an SVG element, for pages; the figure is closed."""
    import io

    from matplotlib import pyplot

    written = io.StringIO()
    with style():
        given_axes(axes).figure.savefig(written, format="svg")
    pyplot.close(axes.figure)
    return written.getvalue()[written.getvalue().index("<svg") :]


def save(axes: Axes, path: str | pathlib.Path) -> None:
    """Writes the figure to a file, whose ending says what kind it is: .svg, .pdf or .png."""
    with style():
        given_axes(axes).figure.savefig(path_of(path, "path", "that of a file, such as 'run.svg'"))
