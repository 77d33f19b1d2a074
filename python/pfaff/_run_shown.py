"""A run in a line and a table of what was watched: as text, and for notebooks with a picture."""
from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any

from ._plotted import label_of
from ._tables import html_table, text_table

if TYPE_CHECKING:
    from ._run import Run

_FIELDS = ("class", "max", "slope", "slope_low", "slope_high")


def text_of(run: Run) -> str:
    rows = _rows(run)
    return _head(run) + ("\n" + text_table(_columns(run), rows) if rows else "")


def html_of(run: Run) -> str:
    rows = _rows(run)
    table = html_table(_columns(run), rows) if rows else ""
    return f"<p>{html.escape(_head(run))}</p>{table}{_picture(run)}"


def _rows(run: Run) -> list[list[Any]]:
    watched = [*run.drift.items(), *run.constraint_drift.items()]
    return [[label_of(name, run.units.get(name, "")), *(one[field] for field in _FIELDS)] for name, one in watched]


def _columns(run: Run) -> list[str]:
    """Heads: the quantity stands with its unit, in which its largest error is; slopes are that by the unit of time."""
    time = run.units.get("t", "")
    return ["quantity", *(f"{field} per {time}" if time and field.startswith("slope") else field for field in _FIELDS)]


def _head(run: Run) -> str:
    span = f"t = {run.t[0]:g} .. {run.t[-1]:g}, {len(run.t)} samples" if len(run.t) else "no samples"
    error = f", largest error {run.error_max:.3g}" if run.error_max is not None else ""
    if "reference_ended" in run.summary:
        error += f", {'errors end early' if error else 'no errors'}: {run.summary['reference_ended']}"
    ended = run.message or run.summary.get("duration", "")
    return f"run of {run.system.name} by {run.method.name}: {span}{error}{f'; {ended}' if ended else ''}"


def _picture(run: Run) -> str:
    """Its drift or its trajectory as SVG; empty where there is nothing to draw, and without matplotlib."""
    from . import plots

    if len(run.t) < 2:
        return ""
    try:
        return plots.svg(run.plot("drift" if run.invariants else "trajectory"))
    except ImportError:
        return ""
