"""Verification of what plug-ins and objects claim."""
from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _pfaff
from ._arguments import shown, yes_or_no
from ._errors import InputError, Interrupted
from ._method import Method
from ._numbers import text_of_setting
from ._objects import as_method, as_system
from ._system import System
from ._tables import Judged, bar, frame_of_fields, html_table, text_table

if TYPE_CHECKING:
    import pandas


@dataclasses.dataclass(frozen=True)
class Check:
    """One claim, measured against its tolerance.

    Attributes:
        plugin: what claims it: a method, a system, a bracket, a formulation or a measure.
        parameters: those of the plug-in, as exact texts; those that are not here have their defaults.
        claim: its name, such as "order" or "symplectic".
        scope: of which systems the claim speaks.
        system: the system on which it was measured; empty where it is about coefficients alone.
        precision: "double" or "quad".
        measured, expected, tolerance: a residual holds where measured <= tolerance, an order where it misses what is
            expected by no more than the tolerance.
        result: "pass", "fail", "measured" (not claimed here, only shown), "rejected" (a claim known to be false was
            found false, as it must be) or "skipped".
        in_scope: whether the claim is made and speaks of the system.
        control: whether it is a claim known to be false.
        reason: why it was skipped, or what there is to say.
        good: whether the check is as it should be.
        not_judged: whether its budget or its reference solution ended before there was a result.
    """

    plugin: str
    claim: str
    scope: str
    system: str
    precision: str
    parameters: dict[str, str]
    measured: float
    expected: float
    tolerance: float
    in_scope: bool
    control: bool
    result: str
    reason: str
    good: bool
    not_judged: bool


def _nearness(check: Check) -> float:
    """How near a check is to what is allowed; above one it fails."""
    if check.claim == "order":
        size = (check.expected - check.measured) / check.tolerance
    else:
        size = check.measured / check.tolerance if check.tolerance > 0 else check.measured
    return math.inf if math.isnan(size) else size


class Checks(Judged[Check]):
    """The checks of a verification, in a fixed order, and what they come to.

    It is a sequence of `Check`, prints as a table with a row for each claim, and converts to pandas.

    Attributes:
        ok: True where something was checked and all of it is as it should be.
        verdict: the same in a sentence.
    """

    def __init__(self, checks: Sequence[Check], ok: bool, verdict: str) -> None:
        super().__init__(checks, ok)
        self.verdict = verdict

    @property
    def failed(self) -> tuple[Check, ...]:
        """The checks that are not as they should be."""
        return tuple(check for check in self._items if not check.good)

    def _rows(self) -> list[tuple[Any, ...]]:
        """(claim, holds, fails, not judged, the worst check or None) for every claim, in the order of the checks."""
        claims: dict[str, list[Check]] = {}
        for check in self._items:
            if not check.control and (check.result in ("pass", "fail") or check.not_judged):
                claims.setdefault(check.claim, []).append(check)
        rows: list[tuple[Any, ...]] = []
        for claim, group in claims.items():
            judged = [check for check in group if check.result in ("pass", "fail")]
            worst = max(judged, key=_nearness, default=None)
            held = sum(check.result == "pass" for check in judged)
            rows.append((claim, held, len(judged) - held, sum(check.not_judged for check in group), worst))
        return rows

    def __repr__(self) -> str:
        rows = []
        for claim, held, failed, left, worst in self._rows():
            allowed = (worst.expected if claim == "order" else worst.tolerance) if worst else None
            rows.append((claim, held or "-", failed or "-", left or "-", worst.measured if worst else "-", allowed or "-",
                         worst.system if worst else ""))
        columns = ("claim", "holds", "fails", "not judged", "worst", "allowed", "on")
        return self.verdict + ("\n\n" + text_table(columns, rows) if rows else "")

    def _repr_html_(self) -> str:
        rows = []
        for claim, held, failed, left, worst in self._rows():
            near = _nearness(worst) if worst else 0.0
            # The bar has a decade of the residual in each tenth, and is full where all that is allowed is reached.
            full = min(1.0, near) if claim == "order" else 1 + math.log10(near) / 10 if near > 0 else 0.0
            allowed = (worst.expected if claim == "order" else worst.tolerance) if worst else None
            rows.append((claim, held, failed, left, worst.measured if worst else "", allowed, bar(full, failed == 0),
                         worst.system if worst else ""))
        columns = ("claim", "holds", "fails", "not judged", "worst", "allowed", "", "on")
        return f"<p><b>{self.verdict}</b></p>" + html_table(columns, rows)

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame with a row for each check and a column for each of its attributes."""
        return frame_of_fields(Check, self._items)


def assignments(parameters: dict[str, Any]) -> list[tuple[str, str]]:
    """Parameters of a plug-in as texts."""
    return [(key, text_of_setting(value, f"parameter '{key}'")) for key, value in parameters.items()]


def _checks(verify: Callable[[list], tuple[Any, ...]]) -> Checks:
    """What a verification finds; where Ctrl-C ends it, what it found by then is the attribute `run` of the exception."""
    made: list[tuple[Any, ...]] = []
    try:
        return _checks_of(*verify(made))
    except Interrupted as error:
        for dictionaries, _, _ in made:
            error.run = _checks_of(dictionaries, False, str(error))
        raise


def _checks_of(dictionaries: Sequence[dict[str, Any]], ok: bool, verdict: str) -> Checks:
    return Checks([Check(**one) for one in dictionaries], ok, verdict)


def _is_method(one: Any) -> bool:
    if isinstance(one, str):
        return one in _pfaff.method_names()
    return isinstance(one, (Method, Mapping))


def _claimant(one: Any) -> Any:
    """A name, or an object that claims something."""
    if isinstance(one, os.PathLike):
        return os.fspath(one)
    if not isinstance(one, (str, Mapping, Method, System)) and not (isinstance(one, type) and issubclass(one, System)):
        raise InputError(f"claimants: expected names, pfaff.System and pfaff.Method objects, got {shown(one)}")
    return one


def _targets(on: Any) -> list[Any]:
    """The models of the systems that methods are verified on."""
    if on is None:
        return []
    systems = list(on) if isinstance(on, (list, tuple)) else [on]
    if not systems:
        raise InputError(f"on: expected a system or several, got {shown(on)}")
    return [as_system(one, "on").model for one in systems]


def verify(*claimants: str | System | Method, on: Any = None, full: bool = False, **parameters: Any) -> Checks:
    """Checks what methods, systems, brackets and the rest claim, in double and in quad.

    Args:
        *claimants: names of plug-ins, paths of tables, text models and text brackets, kinds ("integrators", "systems",
            ...), and objects: `pfaff.System` and `pfaff.Method`. Without any, everything that is registered.
        on: a system, or several, on which methods are verified. Without it a method is tried on random systems and on
            every registered one that it fits.
        full: larger orders and more parameters too.
        **parameters: those of the one plug-in that is named, instead of those that it is verified with otherwise.

    Returns:
        The checks. `.ok` says whether all is well, `.failed` has those that are not.

    Raises:
        InputError: an unknown name, or a method that does not fit a system of `on`.
        Interrupted: Ctrl-C; its attribute `run` has the checks that were made by then, which are not `ok`.

    >>> import pfaff
    >>> checks = pfaff.verify("verlet", on="henon-heiles")
    >>> checks.ok, len(checks.failed)
    (True, 0)
    """
    whole_set, named, targets = yes_or_no(full, "full"), [_claimant(one) for one in claimants], _targets(on)
    if on is None and all(isinstance(one, str) for one in named):
        return _checks(lambda made: _pfaff.verify_names(named, assignments(parameters), whole_set, made))
    if not named:
        raise InputError("verify: expected a method whose claims are to be verified on the systems of `on`")
    if whole_set:
        raise InputError("verify: `full` is for names alone; an object is verified with its own parameters")
    if parameters and len(named) != 1:
        raise InputError("verify: expected parameters beside one method or system alone, whose they are")
    methods, systems = [], []
    for one in named:
        if on is not None or _is_method(one):
            method = as_method(one, "claimants", **parameters)
            methods.append((method.instance, list(method.parameters.items())))
        else:
            systems.append(as_system(one, "claimants", **parameters).model)
    return _checks(lambda made: _pfaff.verify_objects(methods, systems, targets, made))
