"""The step that meets tolerances, found by halving it."""
from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from ._errors import InputError, NotConverged, RunFailed
from ._integration import Integration
from ._method import Method
from ._system import System

# The first of the numbers of steps that are tried.
FEWEST_STEPS = 16
# A step is chosen by comparing states at times that are spread evenly: at all of the steps, up to so many numbers.
_COMPARED = 2**20
# So many times the steps has a run whose steps are no halves or doubles of those that it is compared with.
_OTHER_STEPS = 0.7


def integration_from(system: System, method: Method, state: np.ndarray, begin: float, **how: Any) -> Integration:
    return Integration(system, method, initial=[float(x) for x in state], t0=begin, **how)


def states_at(integration: Integration, times: np.ndarray, begin: float, size: float, count: int) -> Iterator[np.ndarray]:
    """The states at times in order, of which those between two steps are after one shorter step, beside the integration."""
    near = 8 * np.finfo(float).eps * max(abs(begin), abs(begin + count * size))  # what round-off makes of times
    for time in times:
        whole = min(count, math.floor((time - begin) / size * (1 + 1e-12)))
        integration.steps(whole - integration.steps_taken)
        row, rest = integration.state, time - (begin + whole * size)
        if abs(rest) > near:
            beside = integration.beside(row)
            beside.go_on_from(row, t0=begin + whole * size, step=rest)
            beside.steps(1)
            row = beside.state
        yield row


def steps_that_meet(
    system: System, method: Method, state: np.ndarray, begin: float, end: float, rtol: float, atol: np.ndarray, most: int
) -> int:
    """The least number of steps, a power of two times FEWEST_STEPS, whose estimated error meets the tolerances.

    Where what two runs differ by becomes r times as much whenever the step is halved, the error of the second is r/(1 - r)
    times that. The order p of the method lets expect 2^-p for r, which jumps and kinks of a field and stiffness raise, so
    that r is measured, and taken as one half until it is. A difference that has become less than r times that before it is
    so by chance.

    A method sees a jump of the field only by the nodes of its steps: runs in steps that are halves of each other agree on
    it where it lies just behind a step of all of them. So what meets the tolerances is compared with a run in other steps.
    """
    order = method.order(system)
    if order < 1:
        raise InputError(f"step: expected one, because {method.name} claims no order on {system.name} by which it could be chosen")
    compared = 2 ** int(math.log2(max(FEWEST_STEPS, _COMPARED // len(state))))
    places = np.arange(1, FEWEST_STEPS + 1) / FEWEST_STEPS
    count, before, difference, failure = FEWEST_STEPS, None, None, None

    def agrees_in_other_steps(now: np.ndarray, error: float, ratio: float) -> bool:
        other = int(_OTHER_STEPS * count) | 1  # an odd number, so that no step begins where one of the other run does
        allowed = error + error * (count / other) ** -math.log2(ratio)  # the errors of both runs
        integration = integration_from(system, method, state, begin, step=(end - begin) / other)
        try:
            found = list(states_at(integration, begin + (end - begin) * places, begin, (end - begin) / other, other))
        except (NotConverged, RunFailed):
            return False
        same = now[len(now) // FEWEST_STEPS - 1 :: len(now) // FEWEST_STEPS]
        return _difference(same, np.array(found), rtol, atol) <= max(1, allowed)

    while count <= most:
        integration = integration_from(system, method, state, begin, step=(end - begin) / count)
        try:
            now, failure = integration.steps(count, every=max(1, count // compared)).y, None
        except (NotConverged, RunFailed) as failed:
            now, failure = None, failed
        last, difference = difference, None
        if now is not None and before is not None:
            same = now[1::2] if len(now) > len(before) else now  # those at the times of the run before
            difference = _difference(same, before, rtol, atol)
            ratio = 0.5 if last is None else max(2.0**-order, min(difference / last if last > 0 else 0.5, 0.7))
            error = max(difference, ratio * (last or 0)) * ratio / (1 - ratio)
            if error <= 1 and agrees_in_other_steps(now, error, ratio):
                return count
        count, before = 2 * count, now
    tried = f"step of {method.name} down to {abs(end - begin) / (count // 2):.3g}"
    if failure is None:
        raise RunFailed(f"solve_ivp: no {tried} meets rtol and atol; expected larger ones, calls that end and begin where the field jumps, step=, the size that is to be taken, or a larger most_steps=")
    raise RunFailed(
        f"solve_ivp: {failure} with every {tried}; expected a t_span that ends before, another method, or step=, with which there are the "
        "states up to the failure", failure.run)


def _difference(states: np.ndarray, others: np.ndarray, rtol: float, atol: np.ndarray) -> float:
    """The largest difference of states, in units of what the tolerances allow."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.nan_to_num(np.abs(states - others) / (atol + rtol * np.abs(states)), posinf=math.inf).max())
