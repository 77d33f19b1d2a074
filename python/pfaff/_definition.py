"""What a system written in Python says of itself: its formulas, coordinates, parameters and state."""
from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _pfaff
from ._arguments import dictionary, dictionary_or_none, function, shown, text, texts, unknown, whole
from ._errors import InputError
from ._numbers import text_of_constant, text_of_number
from ._tracing import argument_names, array_of, place_of

# The formulas that a system may write, from the library's own table: name -> (gives a number, signature).
FORMULAS = {name: (is_number, signature) for name, is_number, signature, _ in _pfaff.formula_rows()}
# Members that are formulas and stand in no row of their own: the two brackets, by the rows of their tensors.
BRACKETS = {"bracket": "poisson_tensor", "symmetric_bracket": "symmetric_tensor"}
# What describes a system, besides its name, and what its object has itself.
DESCRIBING = ("units", "behaviours", "time_unit", "part_names", "small_part", "chart_coordinates", "title")
TAKEN = ("compiled", "dimension", "facets", "model", "name", "parameters", "registered_name", "to_toml")
# All that a class or a decorator may write, beside coordinates and what describes them.
MEMBERS = (*FORMULAS, *BRACKETS, "casimirs", "damping", "part_flow")


class Coordinates:
    """The names of the coordinates, one by one and in blocks.

    `of` is a list of names, ["q", "p"], or a dictionary of blocks, {"q": 2, "p": 2}, whose coordinates are q1, q2, p1
    and p2. A count may be the name of a whole-number parameter.
    """

    def __init__(self, of: Any, values: Mapping[str, Any], what: str) -> None:
        self.names: list[str] = []
        self.in_texts: list[str] = []  # as text models call them
        self.blocks: dict[str, slice | int] = {}
        if isinstance(of, Mapping):
            for block, count in of.items():
                count = values.get(count, count) if isinstance(count, str) else count
                if not isinstance(count, (int, np.integer)) or isinstance(count, bool) or count < 1:
                    raise InputError(f"{what}: coordinates['{block}']: expected a whole number >= 1, or the name of a parameter that is one, got {shown(count)}")
                self._take(block, slice(len(self.names), len(self.names) + int(count)), what)
                self.names += [f"{block}{k}" for k in range(1, int(count) + 1)]
                self.in_texts += [f"{block}[{k}]" for k in range(1, int(count) + 1)]
        elif isinstance(of, Sequence) and not isinstance(of, str) and all(isinstance(name, str) for name in of):
            for name in of:
                self._take(name, len(self.names), what)
                self.names.append(name)
                self.in_texts.append(name)
        else:
            raise InputError(f"{what}: coordinates: expected names, such as [\"q\", \"p\"], or blocks, such as {{\"q\": 2, \"p\": 2}}, got {shown(of)}")
        if len(set(self.names)) < len(self.names):
            raise InputError(f"{what}: coordinates: expected different names, got {', '.join(self.names)}")
        if not self.names:
            raise InputError(f"{what}: coordinates: expected one at least")

    def _take(self, name: str, place: slice | int, what: str) -> None:
        if not isinstance(name, str) or not name.isidentifier() or name == "t" or name in self.blocks:
            raise InputError(f"{what}: coordinates: expected names that are identifiers, each once and none of them t, got {shown(name)}")
        self.blocks[name] = place

    def __len__(self) -> int:
        return len(self.names)

    def known(self, numbers: Sequence, first: int = 0, prefix: str = "") -> dict[str, Any]:
        """What formulas may call the numbers of the coordinates from `first` on: z, the halves, and the names."""
        array, n = array_of(numbers), len(self)
        last = first + len(numbers)
        known: dict[str, Any] = {}
        if not prefix:
            if len(numbers) == n:
                known["z"] = array
            if n % 2 == 0 and first == 0:
                known["q"] = array[: n // 2]
            if n % 2 == 0 and last == n:
                known["p"] = array[len(numbers) - n // 2 :]
        for name, place in self.blocks.items():
            start, stop = (place.start, place.stop) if isinstance(place, slice) else (place, place + 1)
            if first <= start and stop <= last:
                known[prefix + name] = array[start - first : stop - first] if isinstance(place, slice) else array[start - first]
        return known


class Definition:
    """The members of a system: formulas by the names of core/system.hpp, coordinates, a state and parameters."""

    def __init__(self, name: str, coordinates: Any, members: Mapping[str, Any], *, initial: Any = None,
                 parameters: Mapping[str, Any] | None = None, invariants: Any = None, title: str = "", units: Mapping[str, str] | None = None,
                 behaviours: Mapping[str, str] | None = None, time_unit: str = "s", part_names: Sequence[str] = (), small_part: int | None = None,
                 chart_coordinates: Sequence[str] = (), of_class: type | None = None) -> None:
        self.name, self.what = name, f"system {name}"
        self.coordinates, self.initial, self.members, self.of_class = coordinates, initial, dict(members), of_class
        self.invariants = invariants if invariants is None or callable(invariants) else self._functions_by_name(invariants)
        self.title, self.time_unit = text(title, f"{self.what}: title"), text(time_unit, f"{self.what}: time_unit")
        self.units, self.behaviours = self._texts_by_name(units, "units"), self._texts_by_name(behaviours, "behaviours")
        self.part_names = texts(part_names, f"{self.what}: part_names", '["kinetic", "potential"]')
        self.chart_coordinates = texts(chart_coordinates, f"{self.what}: chart_coordinates", '["a", "b"]')
        self.small_part = None if small_part is None else whole(small_part, f"{self.what}: small_part", 0)
        for key, member in self.members.items():
            if key != "damping" and not (key in BRACKETS and isinstance(member, str)):
                function(member, f"{self.what}: {key}", "a function or the name of a bracket" if key in BRACKETS else "a function")
        self.parameters: dict[str, Any] = {}
        for key, value in (parameters or {}).items():
            self._take_parameter(key, value, self.what)
        for one in self.functions():
            for key, default in self._own_arguments(one).items():
                self._take_parameter(key, default, place_of(one) + self.what)

    def _texts_by_name(self, given: Any, what: str) -> dict[str, str]:
        found = dictionary_or_none(given, f"{self.what}: {what}", "a dictionary of names and texts")
        return {key: text(value, f"{self.what}: {what}['{key}']") for key, value in found.items()}

    def _functions_by_name(self, given: Any) -> dict[str, Callable]:
        found = dictionary(given, f"{self.what}: invariants", "a dictionary of names and functions, or a function")
        return {key: function(value, f"{self.what}: invariants['{key}']", "a function") for key, value in found.items()}

    def functions(self) -> list[Callable]:
        """The functions that are written without a class, whose arguments with defaults are parameters."""
        found = [*self.members.values(), self.initial]
        found += self.invariants.values() if isinstance(self.invariants, Mapping) else [self.invariants]
        return [one for one in found if callable(one)]

    def _own_arguments(self, function: Callable) -> dict[str, Any]:
        if self.of_class is not None:
            return {}
        return {key: default for key, default in argument_names(function).items() if default is not inspect.Parameter.empty}

    def _take_parameter(self, key: str, value: Any, what: str) -> None:
        if key == "compile":
            raise InputError(f"{what}: parameter 'compile': expected another name, because a system is called with compile=True")
        if text_of_constant(value) is None:
            raise InputError(f"{what}: parameter '{key}': expected a number, got {shown(value)}")
        if key in self.parameters and self.parameters[key] != value:
            raise InputError(f"{what}: parameter '{key}' has the values {self.parameters[key]} and {value}; expected one")
        if not isinstance(value, int) and isinstance(self.parameters.get(key), int):
            del self.parameters[key]  # real where one of its functions says so
        self.parameters.setdefault(key, value)

    def values(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """All parameters with the values that are given, or their own. InputError for unknown names and values that are no numbers."""
        values = dict(self.parameters)
        for key, value in given.items():
            if key not in values:
                raise InputError(unknown("parameter", key, list(values)) + f" (of {self.name})")
            if isinstance(self.parameters[key], int):
                if isinstance(value, (float, np.floating)) and float(value).is_integer():
                    value = int(value)
                if not isinstance(value, (int, np.integer)) or isinstance(value, bool):
                    raise InputError(f"parameter '{key}' of {self.name}: expected a whole number, as its default {self.parameters[key]} is, got {shown(value)} (the annotation float, or a default {self.parameters[key]}.0, makes it real)")
            elif not isinstance(value, str) or not value:
                text_of_number(value, f"parameter '{key}' of {self.name}")
            values[key] = value
        return values

    def arguments(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Parameters as formulas see them: whole numbers, and exact constants of a recording."""
        return {key: int(value) if isinstance(self.parameters[key], int) else self._constant(key, value) for key, value in values.items()}

    def _constant(self, key: str, value: Any) -> Any:
        what = f"parameter '{key}' of {self.name}"
        return _pfaff.constant(text_of_number(value, what), what)
