"""Falsification: the search for systems on which a claim of a method fails."""
from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import _pfaff
from ._arguments import text, whole
from ._method import Method
from ._numbers import float_of_number
from ._objects import as_method
from ._tables import Judged, data_frame, html_table, text_table
from ._verification import assignments

if TYPE_CHECKING:
    import pandas


@dataclasses.dataclass(frozen=True)
class Counterexample:
    """The smallest system found on which a claim fails.

    Attributes:
        name: of the system, such as "rk4-not-symplectic".
        model: the system as a text model, which `pfaff.System` reads once it is a file.
        dimension: the number of its coordinates.
        step, steps, time: the claim was judged after so many steps from that time.
        residuals: with the step h, h/2, h/4, ...
        residual_in_double: with the step h, in double precision.
        exponent: of the power of h as which the residual falls.
    """

    name: str
    model: str = dataclasses.field(repr=False)
    dimension: int
    step: str
    steps: int
    time: str
    residuals: list[float]
    residual_in_double: float
    exponent: float


@dataclasses.dataclass(frozen=True)
class Falsification:
    """What became of one claim of a method.

    Attributes:
        method, parameters, claim: what was put to the test.
        claimed: whether the method makes the claim.
        tried: on how many random systems.
        counterexample: the system on which it fails, or None where it held.
    """

    method: str
    parameters: dict[str, str]
    claim: str
    claimed: bool
    tried: int
    counterexample: Counterexample | None

    @property
    def result(self) -> str:
        """"falsified", "held", or "untested" where no system was in the scope of the claim."""
        return "falsified" if self.counterexample else "held" if self.tried else "untested"


class Falsifications(Judged[Falsification]):
    """A row for each claim that was put to the test.

    Attributes:
        ok: True where claims were tried and none was falsified.
    """

    _COLUMNS = ("method", "claim", "systems", "result", "residual", "step", "system")

    def __init__(self, results: Sequence[Falsification]) -> None:
        falsified = any(one.counterexample for one in results)
        super().__init__(results, not falsified and any(one.tried for one in results))

    @property
    def failed(self) -> tuple[Falsification, ...]:
        """The claims that were falsified."""
        return tuple(one for one in self._items if one.counterexample)

    def _rows(self) -> list[tuple[Any, ...]]:
        rows: list[tuple[Any, ...]] = []
        for one in self._items:
            found = one.counterexample
            name = " ".join([one.method, *(f"{key}={value}" for key, value in one.parameters.items())])
            rows.append((name, one.claim, one.tried, one.result, found.residuals[0] if found else None,
                         found.step if found else None, found.name if found else None))
        return rows

    def __repr__(self) -> str:
        if not self._items:
            return "no claim was tried: the method makes none that random systems could falsify. An order is verified by pfaff.verify; expected claim=, one that is to be tried"
        tried = sum(one.tried for one in self._items)
        line = f"{len(self)} claims on {tried} random systems: {len(self.failed)} falsified"
        return text_table(self._COLUMNS, self._rows()) + "\n" + line

    def _repr_html_(self) -> str:
        return html_table(self._COLUMNS, self._rows())

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame with a row for each claim."""
        return data_frame(self._COLUMNS, self._rows())


def falsify(
    method: str | Method, claim: str | None = None, *, budget: float = 60.0, systems: int | None = None, seed: int = 1,
    **parameters: Any
) -> Falsifications:
    """Searches random systems for one on which a claim of a method fails, and shrinks it to the smallest of its kind.

    Args:
        method: its name, the path of a table, or a `pfaff.Method`.
        claim: the one claim that is put to the test, whether the method makes it or not; all that it makes without.
        budget: how long to search, in seconds, for all claims together.
        systems: at most so many systems for each claim, which makes results independent of the machine's speed.
        seed: of the random systems.
        **parameters: of the method; without, those that verification runs through.

    Returns:
        A row for each claim, with the counterexample where there is one. None, and so not `ok`, where the method makes no claim
        besides its order, which random systems do not try.

    Raises:
        InputError: an unknown method or claim.
        Interrupted: Ctrl-C.

    >>> import pfaff
    >>> found = pfaff.falsify("rk4", "symplectic", systems=5)
    >>> found.ok, found[0].result
    (False, 'falsified')
    """
    endless = isinstance(budget, float) and budget == math.inf  # until there were as many systems as asked for
    seconds = math.inf if endless else float_of_number(budget, "budget", "a time above 0 s", above=0)
    chosen = "" if claim is None else text(claim, "claim", "the name of one or None")
    how = (chosen, seconds, None if systems is None else whole(systems, "systems", 1), whole(seed, "seed", 0))
    if isinstance(method, (str, os.PathLike)):
        found = _pfaff.falsify(None, os.fspath(method), assignments(parameters), *how)
    else:
        made = as_method(method, **parameters)
        found = _pfaff.falsify(made.instance, "", list(made.parameters.items()), *how)
    results = []
    for one in found:
        example = one.pop("counterexample")
        one["parameters"] = dict(one["parameters"])
        results.append(Falsification(**one, counterexample=Counterexample(**example) if example else None))
    return Falsifications(results)
