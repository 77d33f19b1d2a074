"""What is asked of a run: its arguments, checked, in the form that the library takes."""
from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from ._arguments import path, shown, text, whole, yes_or_no
from ._errors import InputError
from ._naming import kebab
from ._numbers import text_of_number, texts_of_coordinates, texts_of_state, texts_of_tolerances


def listed_measures(given: Any) -> list[str | Callable[[Any], Any]]:
    """Measures as a list; one may be given alone."""
    alone = isinstance(given, str) or callable(given) or not isinstance(given, Iterable) or isinstance(given, (Mapping, bytes))
    measures = [given] if alone else list(given)
    for one in measures:
        if not isinstance(one, str) and not callable(one):
            raise InputError(f"measures: expected names of measures and functions of the run, got {shown(one)}")
    names = [name_of(one) if callable(one) else one.partition("(")[0] for one in measures]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"measures: '{name}' is the name of {names.count(name)} of them; expected names that differ")
    return measures


def name_of(function: Callable[[Any], Any]) -> str:
    """The name of the table of a measure that is a function of the run."""
    return kebab(getattr(function, "__name__", type(function).__name__))


def asked_run(
    system: Any, method: Any, *, step: Any, tolerance: Any, time: Any, every: Any, initial: Any, initial_velocities: Any, t0: Any, absolute: Any,
    precision: Any, reference: Any, measures: Sequence[Any], structure: Any, project_initial: Any, allow_inconsistent: Any, formulation: Any, out: Any, force: Any
) -> dict[str, Any]:
    """The arguments of pfaff.run. InputError for those of the wrong kind."""
    folder = "" if out is None else path(out, "out")
    return {
        "step": "" if step is None else text_of_number(step, "step"),
        "tolerance": "" if tolerance is None else text_of_number(tolerance, "tolerance"),
        "time": text_of_number(time, "time"),
        "every": whole(every, "every", 0),
        **_start(system.coordinates, initial, initial_velocities),
        "t0": text_of_number(t0, "t0"),
        "absolute": texts_of_tolerances(absolute, "absolute"),
        "precision": text(precision, "precision", "'double' or 'quad'"),
        "reference": "none" if reference is None else text(reference, "reference", "the name of a reference or None"),
        "measures": [one for one in measures if isinstance(one, str)],
        "structure": yes_or_no(structure, "structure"),
        "project_initial": yes_or_no(project_initial, "project_initial"),
        "allow_inconsistent": yes_or_no(allow_inconsistent, "allow_inconsistent"),
        "formulation": "" if formulation is None else text(formulation, "formulation", "the name of a formulation"),
        "out": folder,
        "force": yes_or_no(force, "force"),
        **_written_as(system, method, folder),
    }


def _start(coordinates: Sequence[str], initial: Any, velocities: Any) -> dict[str, list[str]]:
    """The state that is asked for; or positions and velocities, of how many the library says, since not every system has them."""
    if velocities is None:
        return {"initial": [] if initial is None else texts_of_coordinates(initial, "initial", coordinates), "initial_velocities": []}
    return {"initial": [] if initial is None else _half(initial, "initial"), "initial_velocities": _half(velocities, "initial_velocities")}


def _half(values: Any, what: str) -> list[str]:
    expected = "a list of numbers, one for each position"
    texts = texts_of_state(values, what, expected)
    if not texts:
        raise InputError(f"{what}: expected {expected}, got {shown(values)}")
    return texts


def _written_as(system: Any, method: Any, out: str) -> dict[str, str]:
    """What a config.toml calls a system and a method, both empty where one of them has no name; and the text of a system that is written in Python."""
    names = {"system": "", "integrator": "", "system_text": ""}
    if not out or not method.registered_name:
        return names
    if system.registered_name:
        return {**names, "system": system.registered_name, "integrator": method.registered_name}
    try:
        system_text = system.to_toml()
    except InputError:  # its formulas are not written as text
        return names
    return {"system": os.path.join(os.path.abspath(out), "system.toml"), "integrator": method.registered_name, "system_text": system_text}
