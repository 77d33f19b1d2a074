"""Tables of measures: columns by their names, with their units."""
from __future__ import annotations

import html
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ._arguments import unknown
from ._plotted import label_of
from ._tables import data_frame, html_table, text_table

if TYPE_CHECKING:
    import pandas


class MeasureTable(Mapping[str, Any]):
    """What a measure has left of a run: `table[name]` is a column, an array of shape (rows,); one of texts is a list, with None where
    there is nothing to say.

    The column "step" counts the steps that lead to a row; a function of the run has the times "t" of the samples instead.

    >>> import pfaff
    >>> table = pfaff.run("damped-oscillator", "gauss", step=0.05, time=5, measures=["error"]).measures["error"]
    >>> list(table), table.units, table["energy:error"].shape
    (['step', 'error', 'energy:error'], {'step': '', 'error': '', 'energy:error': 'm^2/s^2'}, (101,))
    """

    def __init__(self, measure: str, columns: Mapping[str, Any], units: Mapping[str, str], ended: str = "") -> None:
        self.measure = measure
        """The name of the measure."""
        self.units: dict[str, str] = dict(units)
        """The units of the columns of numbers, by their names: empty of pure numbers, where a unit is not known, and where each row
        has its own, in the column "unit"."""
        self.ended = ended
        """Why the table ends before the run does; empty where it does not."""
        self._columns = dict(columns)

    def __getitem__(self, column: str) -> Any:
        if not isinstance(column, str) or column not in self._columns:
            raise KeyError(unknown("column", column, list(self._columns)))
        return self._columns[column]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def to_pandas(self) -> pandas.DataFrame:
        """The rows as a data frame, whose `attrs["units"]` are the units."""
        return data_frame(list(self._columns), self._rows(), self.units)

    def _rows(self) -> list[tuple[Any, ...]]:
        return list(zip(*self._columns.values()))

    def _head(self) -> str:
        count = len(self._rows())
        return f"measure {self.measure}: {count} row{'' if count == 1 else 's'}" + (f"; it ends early: {self.ended}" if self.ended else "")

    def _shown(self) -> tuple[list[str], list[list[Any]]]:
        """The heads, with units, and the rows, in which long texts are cut."""
        heads = [label_of(name, self.units.get(name, "")) for name in self._columns]
        return heads, [[f"{one[:56]} ..." if isinstance(one, str) and len(one) > 60 else one for one in row] for row in self._rows()]

    def __repr__(self) -> str:
        return f"{self._head()}\n{text_table(*self._shown())}"

    def _repr_html_(self) -> str:
        return f"<p>{html.escape(self._head())}</p>{html_table(*self._shown())}"
