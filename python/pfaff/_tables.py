"""Tables of results: rows that print as text and as HTML, and become pandas' data frames."""
from __future__ import annotations

import dataclasses
import html
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    import pandas

Item = TypeVar("Item")


class Judged(Sequence[Item]):
    """Results in a fixed order, which count as true where all of them together are as they should be."""

    def __init__(self, items: Sequence[Item], ok: bool) -> None:
        self._items = tuple(items)
        self.ok = ok

    def __getitem__(self, index: Any) -> Any:
        return self._items[index]

    def __len__(self) -> int:
        return len(self._items)

    def __iter__(self) -> Iterator[Item]:
        return iter(self._items)

    def __bool__(self) -> bool:
        return self.ok


def cell(value: Any) -> str:
    """A value as it stands in a table: numbers with four digits."""
    if isinstance(value, float):
        return f"{value:.4g}"
    return "" if value is None else str(value)


def text_table(columns: Sequence[str], rows: Sequence[Sequence[Any]], most: int = 40) -> str:
    """Rows below their columns, as wide as the widest of their cells; at most so many rows."""
    cells = [list(columns), *([cell(value) for value in row] for row in rows[:most])]
    widths = [max(len(row[k]) for row in cells) for k in range(len(columns))]
    lines = ["  ".join(word.ljust(width) for word, width in zip(row, widths)).rstrip() for row in cells]
    if len(rows) > most:
        lines.append(f"... {len(rows) - most} more rows")
    return "\n".join(lines)


def html_table(columns: Sequence[str], rows: Sequence[Sequence[Any]], most: int = 100) -> str:
    """The same as HTML. Cells that begin with <svg are taken as they are."""

    def shown(value: Any) -> str:
        text = cell(value)
        return text if text.startswith("<svg ") else html.escape(text)

    head = "".join(f"<th>{html.escape(name)}</th>" for name in columns)
    body = "".join("<tr>" + "".join(f"<td>{shown(value)}</td>" for value in row) + "</tr>" for row in rows[:most])
    more = f"<p>... {len(rows) - most} more rows</p>" if len(rows) > most else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def bar(fraction: float, good: bool) -> str:
    """A bar as inline SVG, filled to the fraction 0 .. 1, green where all is well and red where not."""
    width = 80 * min(max(fraction, 0.0), 1.0)
    colour = "#2a7f3f" if good else "#b3261e"
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" width="82" height="10" role="img">'
        f'<rect x="1" y="1" width="80" height="8" fill="none" stroke="#888"/>'
        f'<rect x="1" y="1" width="{width:.1f}" height="8" fill="{colour}"/></svg>'
    )


def data_frame(columns: Sequence[str], rows: Sequence[Sequence[Any]], units: Mapping[str, str] | None = None) -> pandas.DataFrame:
    """The rows as a data frame, whose attrs["units"] are the units where there are some; ImportError, which says what is missing, without pandas."""
    try:
        import pandas
    except ImportError:
        raise ImportError("to_pandas() needs pandas, which is not installed (Debian's python3-pandas)") from None
    frame = pandas.DataFrame([list(row) for row in rows], columns=list(columns))
    if units is not None:
        frame.attrs["units"] = {name: units[name] for name in columns if name in units}
    return frame


def frame_of_fields(kind: Any, items: Sequence[Any]) -> pandas.DataFrame:
    """A data frame of objects of a dataclass: a row for each, a column for each of its fields."""
    names = [field.name for field in dataclasses.fields(kind)]
    return data_frame(names, [[getattr(item, name) for name in names] for item in items])
