"""Verification of what plug-ins and objects claim, and the search for systems on which a claim fails."""
from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from . import _pfaff
from ._errors import InputError
from ._numbers import text_of_setting
from ._objects import as_method, as_system
from ._tables import bar, data_frame, html_table, text_table

if TYPE_CHECKING:
    import pandas

    from ._method import Method
    from ._system import System


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


class Checks(Sequence[Check]):
    """The checks of a verification, in a fixed order, and what they come to.

    It is a sequence of `Check`, prints as a table with a row for each claim, and converts to pandas.

    Attributes:
        ok: True where something was checked and all of it is as it should be.
        verdict: the same in a sentence.
    """

    def __init__(self, checks: Sequence[Check], ok: bool, verdict: str) -> None:
        self._checks = tuple(checks)
        self.ok = ok
        self.verdict = verdict

    @property
    def failed(self) -> tuple[Check, ...]:
        """The checks that are not as they should be."""
        return tuple(check for check in self._checks if not check.good)

    def __getitem__(self, index: Any) -> Any:
        return self._checks[index]

    def __len__(self) -> int:
        return len(self._checks)

    def __iter__(self) -> Iterator[Check]:
        return iter(self._checks)

    def __bool__(self) -> bool:
        return self.ok

    def _rows(self) -> list[tuple[Any, ...]]:
        """(claim, holds, fails, not judged, the worst check or None) for every claim, in the order of the checks."""
        claims: dict[str, list[Check]] = {}
        for check in self._checks:
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
        names = [field.name for field in dataclasses.fields(Check)]
        return data_frame(names, [[getattr(check, name) for name in names] for check in self._checks])


def _assignments(parameters: dict[str, Any]) -> list[tuple[str, str]]:
    return [(key, text_of_setting(value, f"parameter '{key}'")) for key, value in parameters.items()]


def _checks(result: tuple[Any, ...]) -> Checks:
    dictionaries, ok, verdict = result
    return Checks([Check(**one) for one in dictionaries], ok, verdict)


def _is_method(one: Any) -> bool:
    if isinstance(one, str):
        return one in _pfaff.method_names()
    from ._method import Method

    return isinstance(one, Method)


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
        Interrupted: Ctrl-C.

    >>> import pfaff
    >>> checks = pfaff.verify("verlet", on="henon-heiles")
    >>> checks.ok, len(checks.failed)
    (True, 0)
    """
    if on is None and all(isinstance(one, str) for one in claimants):
        return _checks(_pfaff.verify_names([str(one) for one in claimants], _assignments(parameters), full))
    if not claimants:
        raise InputError("verify: expected a method whose claims are to be verified on the systems of `on`")
    if full:
        raise InputError("verify: `full` is for names alone; an object is verified with its own parameters")
    if parameters and len(claimants) != 1:
        raise InputError("verify: expected parameters beside one method or system alone, whose they are")
    methods, systems = [], []
    for one in claimants:
        if on is not None or _is_method(one):
            method = as_method(one, **parameters)
            methods.append((method.instance, list(method.parameters.items())))
        else:
            systems.append(as_system(one, **parameters).model)
    targets = [] if on is None else list(on) if isinstance(on, (list, tuple)) else [on]
    return _checks(_pfaff.verify_objects(methods, systems, [as_system(target).model for target in targets]))


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
    model: str
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


class Falsifications(Sequence[Falsification]):
    """A row for each claim that was put to the test.

    Attributes:
        ok: True where claims were tried and none was falsified.
    """

    _COLUMNS = ("method", "claim", "systems", "result", "residual", "step", "system")

    def __init__(self, results: Sequence[Falsification]) -> None:
        self._results = tuple(results)
        self.ok = not self.failed and any(one.tried for one in results)

    @property
    def failed(self) -> tuple[Falsification, ...]:
        """The claims that were falsified."""
        return tuple(one for one in self._results if one.counterexample)

    def __getitem__(self, index: Any) -> Any:
        return self._results[index]

    def __len__(self) -> int:
        return len(self._results)

    def __bool__(self) -> bool:
        return self.ok

    def _rows(self) -> list[tuple[Any, ...]]:
        rows: list[tuple[Any, ...]] = []
        for one in self._results:
            found = one.counterexample
            name = " ".join([one.method, *(f"{key}={value}" for key, value in one.parameters.items())])
            rows.append((name, one.claim, one.tried, one.result, found.residuals[0] if found else None,
                         found.step if found else None, found.name if found else None))
        return rows

    def __repr__(self) -> str:
        tried = sum(one.tried for one in self._results)
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
        A row for each claim, with the counterexample where there is one.

    Raises:
        InputError: an unknown method or claim.
        Interrupted: Ctrl-C.

    >>> import pfaff
    >>> found = pfaff.falsify("rk4", "symplectic", systems=5)
    >>> found.ok, found[0].result
    (False, 'falsified')
    """
    if not budget > 0:
        raise InputError(f"budget: expected a time above 0 s, got {budget}")
    how = (claim or "", budget, systems, seed)
    if isinstance(method, str):
        found = _pfaff.falsify(None, method, _assignments(parameters), *how)
    else:
        made = as_method(method, **parameters)
        found = _pfaff.falsify(made.instance, "", list(made.parameters.items()), *how)
    results = []
    for one in found:
        example = one.pop("counterexample")
        one["parameters"] = dict(one["parameters"])
        results.append(Falsification(**one, counterexample=Counterexample(**example) if example else None))
    return Falsifications(results)
