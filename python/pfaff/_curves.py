"""Curves in axes: how they look, and what axes and legends say of them when several calls draw into one figure."""
from __future__ import annotations

import dataclasses
import weakref
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._plotted import label_of
from ._style import look, settings

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

MOST_ENTRIES = 16  # of a legend; more do not stand beside the axes


@dataclasses.dataclass
class Curve:
    """What is known of a line that was drawn here."""

    name: str  # of what it shows
    unit: str
    label: str  # what the caller puts before the name
    quantity: str  # what the axis is called; the name where this is empty
    run: Sequence[str] = ()  # what tells its run from others, the shortest first
    entry: str = ""  # what the legend was last made to say of it


# Lines and axes do not keep what they are not made for, and figures are closed when nobody has them.
_CURVES: weakref.WeakKeyDictionary[Line2D, Curve] = weakref.WeakKeyDictionary()
_LABELS: weakref.WeakKeyDictionary[Axes, str] = weakref.WeakKeyDictionary()


def curves_in(axes: Axes) -> dict[Line2D, Curve]:
    """The lines in axes that were drawn here, and what they are."""
    return {line: _CURVES[line] for line in axes.get_lines() if line in _CURVES}


def draw(axes: Axes, x: np.ndarray, y: np.ndarray, name: str, *, unit: str = "", label: str = "", quantity: str = "", dotted: bool = False) -> Line2D:
    """A curve in the next colour and dashes of the axes, or in the next marks. One point alone has a mark."""
    points = np.isfinite(x) & np.isfinite(y)
    marked: dict[str, Any] = {"marker": "o", "markersize": settings()["lines.markersize"]} if points.sum() == 1 else {}
    of_look = look(len(curves_in(axes)), dotted)
    if points.sum() < 2:
        of_look.pop("markevery", None)  # marks at equal ways along a curve, which has no length
    (line,) = axes.plot(x, y, **{**of_look, **marked})
    _CURVES[line] = Curve(name, "" if unit == "1" else unit, label, quantity, entry=line.get_label())
    return line


def draw_logarithmic(axes: Axes, x: np.ndarray, y: np.ndarray, name: str, *, least: float = 0, **what: Any) -> None:
    """A curve on a logarithmic scale. What is below `least` stands on it, and zeros at half of the smallest of the others.

    Noise, such as that of round-off, is drawn as points: lines between them would fill the axes.
    """
    positive = y[y > 0]
    floor = least or (positive.min() / 2 if len(positive) else 1e-17)
    shown = np.where(y <= floor, floor, y)
    draw(axes, x, shown, name, dotted=_is_noise(shown), **what)
    axes.set_yscale("log")


def _is_noise(values: np.ndarray) -> bool:
    """Whether many values go up and down more often than on in one direction, as independent ones do at two thirds of them."""
    values = values[np.isfinite(values)]
    ways = np.sign(np.diff(values))
    ways = ways[ways != 0]
    return len(values) >= 100 and len(ways) > 0.2 * len(values) and float(np.mean(ways[1:] != ways[:-1])) > 0.5


def label_axes(axes: Axes, x: str, always: bool = False) -> None:
    """Labels of the axes and a legend, of all curves that are in them; the legend of a single one where it is `always` or has a label.

    What the caller has changed stays: labels of axes and of lines, and limits.
    """
    if not axes.get_xlabel():
        axes.set_xlabel(x)
    _name_curves(axes)
    curves = curves_in(axes).values()
    if len(curves) > 1 or always or any(curve.label for curve in curves):
        _legend(axes)
    _widen(axes)


def name_run(axes: Axes, earlier: Sequence[Line2D], told: Sequence[str]) -> None:
    """Says of the curves that are not `earlier` ones what tells their run from others, for legends that would repeat themselves."""
    for line, curve in curves_in(axes).items():
        if line not in earlier:
            curve.run = told
    _name_curves(axes)
    if axes.get_legend() is not None:
        _legend(axes)


def _name_curves(axes: Axes) -> None:
    """The axis has the unit that all curves share, and otherwise the legend has the units."""
    curves = curves_in(axes)
    units = {curve.unit for curve in curves.values()}
    shared = units.pop() if len(units) == 1 else ""
    for (line, curve), name in zip(curves.items(), _names(list(curves.values()))):
        if line.get_label() == curve.entry:
            curve.entry = label_of(name, "" if shared else curve.unit).strip()
            line.set_label(curve.entry)
    said = list(dict.fromkeys(curve.quantity or curve.name for curve in curves.values()))
    few = len(said) == 1 or shared and len(said) <= 3
    label = label_of(", ".join(said) if few else "", shared).strip()
    if axes.get_ylabel() in ("", _LABELS.get(axes, "")):
        axes.set_ylabel(label)
        _LABELS[axes] = label


def _names(curves: Sequence[Curve]) -> list[str]:
    """The entries of a legend: labels and names; where one would be there twice, also what tells the runs without a label apart."""
    names: list[str] = []
    for level in range(1 + max((len(curve.run) for curve in curves), default=0)):
        runs = [("", *curve.run)[min(level, len(curve.run))] for curve in curves]
        names = [": ".join(part for part in (curve.label or run, curve.name) if part) for curve, run in zip(curves, runs)]
        if len(set(names)) == len(names):
            break
    return names


def _legend(axes: Axes) -> None:
    """Beside the axes, where nothing is under it, if the figure makes room for it; otherwise where it hides least."""
    from matplotlib.lines import Line2D

    of = settings()
    handles = axes.get_legend_handles_labels()[0]
    if not handles:
        return
    if len(handles) > MOST_ENTRIES:
        left = len(handles) - MOST_ENTRIES + 1
        handles = [*handles[: MOST_ENTRIES - 1], Line2D([], [], linestyle="none", label=f"and {left} more")]
    beside = axes.figure.get_layout_engine() is not None
    place = {"loc": "upper left", "bbox_to_anchor": (1, 1), "frameon": False} if beside else {"loc": "best", "facecolor": of["figure.facecolor"], "edgecolor": "none", "framealpha": 0.8}
    axes.legend(handles=handles, fontsize=of["legend.fontsize"], labelcolor=of["text.color"], handlelength=3, markerscale=1.4, **place)


def _widen(axes: Axes) -> None:
    """Wider ranges where an axis holds nothing but round-off, or less than a decade of a logarithmic scale."""
    lines = list(curves_in(axes))
    for axis, get, fixed in (("x", axes.get_xscale, axes.get_autoscalex_on), ("y", axes.get_yscale, axes.get_autoscaley_on)):
        drawn = [np.asarray(line.get_data()[axis == "y"], float) for line in lines]
        values = np.concatenate(drawn) if drawn else np.empty(0)
        range_of = _decades if get() == "log" else _beyond_rounding
        wider = range_of(values[np.isfinite(values)]) if fixed() else None
        if wider:
            getattr(axes, f"set_{axis}lim")(*wider, auto=True)  # what is drawn afterwards makes it anew


def _decades(values: np.ndarray) -> tuple[float, float] | None:
    """The decades around values that are within one; below ten times the least, ticks have labels of many digits."""
    if not len(values) or values.min() <= 0 or values.max() >= 10 * values.min():
        return None
    low, high = np.floor(np.log10(values.min())), np.ceil(np.log10(values.max()))
    return float(10.0**low / 1.2), float(10.0 ** max(high, low + 1) * 1.2)


def _beyond_rounding(values: np.ndarray) -> tuple[float, float] | None:
    """A twentieth to both sides of values that differ by what is rounded."""
    size = abs(values).max() if len(values) > 1 else 0
    if not 0 < size < np.inf or values.max() - values.min() >= 1e-12 * size:
        return None
    return float(values.mean() - 0.05 * size), float(values.mean() + 0.05 * size)
