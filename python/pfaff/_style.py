"""The style of the report: its settings, and the colours and dashes that its families of methods have."""
from __future__ import annotations

import contextlib
import functools
import inspect
import runpy
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from . import _pfaff
from ._arguments import unknown
from ._errors import InputError
from ._plotted import given_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@functools.cache
def families() -> dict[str, Any]:
    """What the scripts of the report say of families of methods: colours, marks and dashes."""
    return runpy.run_path(_pfaff.shipped_path("report/families.py"))


@contextlib.contextmanager
def style() -> Iterator[None]:
    """The style of the report; ImportError, which says what is missing, without matplotlib.

    What is put back is what the style changes, and not all settings, as matplotlib's own context does: a notebook's
    backend turns others on when the first figure is made.
    """
    try:
        import matplotlib
    except ImportError:
        raise ImportError("plots need matplotlib, which is not installed (Debian's python3-matplotlib)") from None

    of = settings()
    before = {key: matplotlib.rcParams[key] for key in of}
    try:
        matplotlib.rcParams.update(of)
        yield
    finally:
        matplotlib.rcParams.update(before)


@functools.cache
def settings() -> Mapping[str, Any]:
    """The settings of figures of the report, by matplotlib's names."""
    import matplotlib

    return matplotlib.rc_params_from_file(_pfaff.shipped_path("report/screen.mplstyle"), use_default_template=False)


def styled(draw: Callable[..., Any]) -> Callable[..., Any]:
    """Draws in the style of the report, and leaves the settings of the caller as they were. Keywords that are misspelt are refused."""
    known = list(inspect.signature(draw).parameters)

    @functools.wraps(draw)
    def drawn(*arguments: Any, **keywords: Any) -> Any:
        refuse_unknown(keywords, known, draw.__name__)
        with style():
            return draw(*arguments, **keywords)

    return drawn


def refuse_unknown(keywords: Mapping[str, Any], known: list[str], what: str) -> None:
    """InputError, with the nearest name, of keywords that are not known."""
    for name in keywords:
        if name not in known:
            raise InputError(f"{what}: {unknown('argument', name, known)}")


def axes_to_draw_into(axes: Axes | None, size: tuple[float, float] = (6.4, 4.0)) -> Axes:
    """The axes that are given, in the style of the report where nothing is drawn in them yet; those of a new figure of that size without."""
    if axes is None:
        from matplotlib import pyplot

        return pyplot.subplots(figsize=size, layout="constrained")[1]
    if not given_axes(axes).has_data():
        _dress(axes)
    return axes


def _dress(axes: Axes) -> None:
    """What the style says of axes, for axes that were made without it."""
    of = settings()
    axes.set_facecolor(of["axes.facecolor"])
    axes.grid(True, color=f"#{str(of['grid.color']).lstrip('#')}", linewidth=of["grid.linewidth"])
    axes.set_axisbelow(of["axes.axisbelow"])
    for side, spine in axes.spines.items():
        spine.set(edgecolor=of["axes.edgecolor"], linewidth=of["axes.linewidth"], visible=of.get(f"axes.spines.{side}", True))
    for axis, key in ((axes.xaxis, "xtick"), (axes.yaxis, "ytick")):
        axis.set_tick_params(which="both", labelsize=of[f"{key}.labelsize"], color=of[f"{key}.color"], labelcolor=of[f"{key}.labelcolor"])
        axis.label.set(size=of["axes.labelsize"], color=of["axes.labelcolor"])
    axes.title.set(size=of["axes.titlesize"], color=of["text.color"])


@functools.cache
def _in_order() -> list[Any]:
    """The families in an order in which the colour of each is as far as can be from those before it in grey print."""
    from matplotlib.colors import to_rgb

    def grey(family: Any) -> float:
        return sum(weight * part for weight, part in zip((0.299, 0.587, 0.114), to_rgb(family.light)))

    left = list(families()["FAMILIES"])
    taken = [left.pop(0)]
    while left:
        taken.append(max(left, key=lambda one: min(abs(grey(one) - grey(other)) for other in taken)))
        left.remove(taken[-1])
    return taken


def look(number: int, dotted: bool = False) -> dict[str, Any]:
    """Colour, and dashes or marks, of the number-th curve of a figure, which also in grey differs from the others."""
    order, dashes = _in_order(), families()["DASHES"]
    family = order[number % len(order)]
    if dotted:
        return {"color": family.light, "linestyle": "none", "marker": family.mark, "markersize": 2.5, "markeredgewidth": 0.4,
                "fillstyle": "none" if number % 2 else "full"}
    marked = {"marker": family.mark, "markevery": 0.12, "markersize": 4} if number >= len(dashes) else {}  # where dashes come again
    return {"color": family.light, "linestyle": dashes[number % len(dashes)], "linewidth": settings()["lines.linewidth"], **marked}
