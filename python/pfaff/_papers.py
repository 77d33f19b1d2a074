"""Reproduction: what papers print beside what is computed here."""
from __future__ import annotations

import dataclasses
import math
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import _pfaff
from ._arguments import text
from ._errors import InputError
from ._tables import Judged, bar, frame_of_fields, html_table, text_table

if TYPE_CHECKING:
    import pandas


@dataclasses.dataclass(frozen=True)
class Reproduced:
    """One published value.

    Attributes:
        id: what it is, in a few words; `section` and `equation` say where the paper prints it.
        printed, ours: the value that the paper prints, and the one that is computed here.
        difference, tolerance: of the two.
        status: "reproduced", "improved" (better than stated), "erratum" (a misprint, shown to be one), "qualitative" (no
            printed number says it) or "failed".
        erratum: the misprint, or the statement that was tested.
    """

    id: str
    section: str
    equation: str
    printed: str
    ours: str
    difference: float
    tolerance: float
    status: str
    erratum: str


class Reproduction(Judged[Reproduced]):
    """The rows of a paper, in its order.

    Attributes:
        paper: its key in references.bib.
        ok: True where no row failed.
    """

    _COLUMNS = ("published", "printed", "ours", "difference", "status")

    def __init__(self, paper: str, rows: Sequence[Reproduced], ok: bool) -> None:
        super().__init__(rows, ok)
        self.paper = paper

    @property
    def counts(self) -> dict[str, int]:
        """How many rows have each status."""
        return dict(Counter(row.status for row in self._items))

    def _shown(self) -> list[tuple]:
        return [(row.id, row.printed, row.ours, row.difference, row.status) for row in self._items]

    def __repr__(self) -> str:
        rows = [tuple(cell if not isinstance(cell, str) or len(cell) <= 30 else cell[:28] + ".." for cell in row) for row in self._shown()]
        counts = ", ".join(f"{count} {status}" for status, count in self.counts.items())
        return f"{self.paper}\n{text_table(self._COLUMNS, rows)}\n{len(self)} rows: {counts}"

    def _repr_html_(self) -> str:
        # The bar has a decade of the difference in each tenth, and is full where all that is allowed is reached.
        bars = [bar(1 + math.log10(row.difference / row.tolerance) / 10 if row.difference > 0 < row.tolerance else 0.0, row.status != "failed")
                for row in self._items]
        rows = [(*shown[:4], one, *shown[4:]) for shown, one in zip(self._shown(), bars)]
        return f"<h4>{self.paper}</h4>" + html_table((*self._COLUMNS[:4], "", *self._COLUMNS[4:]), rows)

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame with a row for each published value."""
        return frame_of_fields(Reproduced, self._items)


def papers() -> tuple[str, ...]:
    """The names of the papers that can be reproduced."""
    return tuple(_pfaff.papers())


def reproduce(paper: str, section: str | None = None) -> Reproduction:
    """Computes what a paper prints, and puts both side by side.

    Args:
        paper: one of `pfaff.papers()`.
        section: one of its sections alone, such as "2".

    Raises:
        InputError: an unknown paper or section.
        Interrupted: Ctrl-C.

    >>> import pfaff
    >>> rows = pfaff.reproduce("su-qin", "2")
    >>> rows.ok, rows[0].status
    (True, 'erratum')
    """
    key = text(paper, "paper", "one of pfaff.papers()")
    if section is not None and not text(section, "section", f"the name of a section of {key} or None"):
        raise InputError(f"section: expected the name of a section of {key}, got ''")
    found = _pfaff.reproduce(key, section or "")
    names = [field.name for field in dataclasses.fields(Reproduced)]
    return Reproduction(found["paper"], [Reproduced(**{name: row[name] for name in names}) for row in found["rows"]], found["ok"])
