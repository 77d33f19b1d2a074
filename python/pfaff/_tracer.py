"""Records the formulas of a system that is written in Python."""
from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from . import _pfaff
from ._definition import BRACKETS, FORMULAS, Coordinates, Definition
from ._arguments import shown, unknown
from ._errors import InputError
from ._numbers import text_of_number
from ._tracing import argument_names, array_of, call_by_names, flat, place_of, recorded

# What is counted, such as constraints: what counts it -> (member that says how many, member of names, letter).
COUNTS = _pfaff.count_rows()
# Formulas whose results may have names: a dictionary gives both.
NAMED = {
    "holonomic": "constraint_names",
    "constraints": "constraint_names",
    "velocity_constraints": "velocity_constraint_names",
}
_LABEL = re.compile(r'^[^",\x00-\x1f]+$')


class Tracer:
    """Records the formulas of a definition with one set of parameters."""

    def __init__(self, definition: Definition, values: Mapping[str, Any]) -> None:
        self.definition, self.values = definition, dict(values)
        self.given = definition.arguments(values)
        self.coordinates = Coordinates(definition.coordinates, self.given, definition.what)
        for key in self.values:
            if key in ("t", *self.coordinates.blocks, *self.coordinates.names):
                meaning = "the time" if key == "t" else "a coordinate"
                raise InputError(f"{definition.what}: parameter '{key}': formulas call {meaning} so; expected another name, or the argument {key} without a default")
        self.n = len(self.coordinates)
        self.sizes = {"n": self.n}
        self.names: dict[str, list[str]] = {member: [] for _, member, _ in COUNTS.values()}
        self.owner = self._owner()

    def _owner(self) -> Any:
        """What methods of a class get as self: an object with the parameters as its attributes."""
        cls = self.definition.of_class
        if cls is None:
            return None
        owner: Any = object.__new__(cls)
        vars(owner).update(self.given)
        return owner

    def recorded(self, inputs: int, results: Callable[[Any, list], list], what: str) -> _pfaff.Tape:
        """The tape of a formula of so many numbers, with the parameters that it is recorded with."""
        return recorded(inputs, results, what)

    def called(self, member: Any, known: Mapping[str, Any], what: str) -> Any:
        function = member.__get__(self.owner) if self.owner is not None and hasattr(member, "__get__") else member
        if self.owner is None:
            # An argument with a default is a parameter, also where a half of the state could be called so.
            own = {key: self.given[key] for key, default in argument_names(function).items() if default is not inspect.Parameter.empty and key in self.given}
            known = {**self.given, **known, **own}
        return call_by_names(function, known, what)

    def source(self) -> dict[str, Any]:
        """What the library makes a model of (`_pfaff.traced_model`)."""
        d = self.definition
        formulas: dict[str, _pfaff.Tape] = {}
        for key in FORMULAS:
            if key in d.members:
                formulas[key] = self.formula(key, d.members[key])
        for key, row in BRACKETS.items():
            if isinstance(name := d.members.get(key), str):
                formulas[row], casimirs = _pfaff.named_bracket(name, self.n)
                if key == "bracket" and casimirs is not None:
                    formulas["casimirs"] = casimirs
            elif key in d.members:
                formulas[row] = self.bracket(d.members[key], key)
        if "casimirs" in d.members:
            formulas["casimirs"] = self.of_state(d.members["casimirs"], "casimirs", None)
        invariants, tape = self.invariants()
        if tape is not None:
            formulas["invariants"] = tape
        parts = self.parts()  # before the names below, to which it adds theirs
        return {"name": d.name, "time_unit": d.time_unit, "coordinates": self.coordinates_with_units(),
                "initial": self.initial(), "parameters": [(key, text_of_number(value, key)) for key, value in self.values.items()],
                "formulas": formulas, **self.names, "invariants": invariants, "damping": self.constant("damping"),
                "parts": parts, "small_part": d.small_part}

    def coordinates_with_units(self) -> list[tuple[str, str]]:
        """Names and units; a block has one unit for all of its coordinates."""
        units, pairs = self.definition.units, []
        for block, place in self.coordinates.blocks.items():
            for name in self.coordinates.names[place] if isinstance(place, slice) else [block]:
                pairs.append((name, units.get(name, units.get(block, ""))))
        return pairs

    def formula(self, key: str, member: Any) -> _pfaff.Tape:
        """The tape of a formula that has a row in the library's table."""
        is_number, signature = FORMULAS[key]
        what = f"{place_of(member)}{key} of {self.definition.what}"
        times, ins = re.findall(r"const T& (\w+)", signature), re.findall(r"In<T> (\w+)", signature)
        if self.n % 2 and not {"q", "p"}.isdisjoint(ins):
            raise InputError(f"{what}: there are {self.n} coordinates; expected an even number, first all positions and then their momenta")
        inputs, _ = _pfaff.formula_size(key, self.sizes)
        each = (inputs - (len(times) - 1)) // len(ins)

        def results(t: Any, numbers: list) -> list:
            known = dict(zip(times, [t, numbers[-1]]))
            for k, name in enumerate(ins):
                known |= self.named(name, numbers[k * each : (k + 1) * each])
            given = self.called(member, known, what)
            if key in NAMED:
                self._name_results(NAMED[key], given, key)
            values = flat(given, what)
            self._count(key, values, what)
            expected = 1 if is_number else _pfaff.formula_size(key, self.sizes)[1]
            if len(values) != expected:
                raise InputError(f"{what} returned {len(values)} results; expected {expected}")
            return values

        return self.recorded(inputs, results, what)

    def named(self, argument: str, numbers: list) -> dict[str, Any]:
        """What the numbers of one argument of a formula may be called."""
        if argument in ("new_z", "old_z"):
            prefix = argument[:-1]
            return {argument: array_of(numbers), **self.coordinates.known(numbers, 0, prefix)}
        if argument == "y":
            names = self.definition.chart_coordinates
            return {"y": array_of(numbers), **dict(zip(names, numbers))}
        known = self.coordinates.known(numbers, self.n // 2 if argument == "p" else 0)
        return {**known, argument: array_of(numbers)} if argument not in self.coordinates.blocks else known

    def of_state(self, member: Any, what: str, expected: int | None) -> _pfaff.Tape:
        """The tape of a function of the time and the state that gives so many numbers."""
        what = f"{place_of(member)}{what} of {self.definition.what}"

        def results(t: Any, numbers: list) -> list:
            values = flat(self.called(member, {"t": t, **self.coordinates.known(numbers)}, what), what)
            if expected is not None and len(values) != expected:
                raise InputError(f"{what} returned {len(values)} results; expected {expected}")
            return values

        return self.recorded(self.n, results, what)

    def bracket(self, member: Any, key: str) -> _pfaff.Tape:
        """The tensor of a bracket: of its rows, or column by column of its map of covectors to vectors."""
        if "covector" not in argument_names(member):
            return self.of_state(member, key, self.n**2)
        what = f"{place_of(member)}{key} of {self.definition.what}"

        def results(t: Any, numbers: list) -> list:
            columns = []
            for j in range(self.n):
                covector = array_of([int(i == j) for i in range(self.n)])
                known = {"t": t, "covector": covector, **self.coordinates.known(numbers)}
                columns.append(flat(self.called(member, known, what), what))
                if len(columns[-1]) != self.n:
                    raise InputError(f"{what} returned {len(columns[-1])} results; expected {self.n}")
            return [columns[j][i] for i in range(self.n) for j in range(self.n)]

        return self.recorded(self.n, results, what)

    def invariants(self) -> tuple[list[tuple[str, str, str]], _pfaff.Tape | None]:
        """Names, units and behaviours of the invariants, and their tape."""
        written = self.definition.invariants
        names: list[str] = []
        if not written:
            self._check_described([])
            return [], None

        def values_by_name(known: dict[str, Any]) -> dict[str, Any]:
            if callable(written):
                values = self.called(written, known, "invariants")
                if not isinstance(values, Mapping):
                    raise InputError(f"{place_of(written)}invariants of {self.definition.what}: expected a dictionary of names and values")
                return dict(values)
            return {name: self.called(one, known, f"invariant {name}") for name, one in written.items()}

        def results(t: Any, numbers: list) -> list:
            values = values_by_name({"t": t, **self.coordinates.known(numbers)})
            names[:] = values
            for name in names:
                if not isinstance(name, str) or not _LABEL.match(name):
                    raise InputError(f"invariants of {self.definition.what}: expected names without quotation marks and commas, got {shown(name)}")
            return [_only(flat(value, f"invariant {name}"), f"invariant {name}") for name, value in values.items()]

        tape = self.recorded(self.n, results, f"invariants of {self.definition.what}")
        d = self.definition
        self._check_described(names)
        return [(name, d.units.get(name, ""), d.behaviours.get(name, "conserved")) for name in names], tape

    def _check_described(self, invariants: Sequence[str]) -> None:
        """InputError where units or behaviours are those of a name that the system does not have."""
        coordinates = [*self.coordinates.blocks, *self.coordinates.names]
        for what, given, names in (("units", self.definition.units, [*coordinates, *invariants]), ("behaviours", self.definition.behaviours, invariants)):
            for name in given:
                if name not in names:
                    kind = "coordinate or invariant" if what == "units" else "invariant"
                    raise InputError(f"{self.definition.what}: {what}: {unknown(kind, name, names) if names else f'there is no invariant of which {name!r} could be the name'}")

    def initial(self) -> list[str]:
        """The initial state as texts; empty where there is none."""
        written, what = self.definition.initial, f"initial of {self.definition.what}"
        if written is None:
            return []
        if callable(written):
            written = self.called(written, {}, what)
        if isinstance(written, Mapping):
            state: list[Any] = [0] * self.n
            for name, numbers in written.items():
                if name not in self.coordinates.blocks:
                    raise InputError(what + ": " + unknown("coordinate", name, list(self.coordinates.blocks)))
                place = self.coordinates.blocks[name]
                values = flat(numbers, what)
                if len(state[place] if isinstance(place, slice) else [0]) != len(values):
                    raise InputError(f"{what}: '{name}' has {len(values)} numbers")
                state[place if isinstance(place, slice) else slice(place, place + 1)] = values
            written = state
        texts = [text_of_number(value, what) for value in flat(written, what)]
        if len(texts) != self.n:
            raise InputError(f"{what}: expected {self.n} numbers, one for each coordinate, got {len(texts)}")
        return texts

    def constant(self, key: str) -> str | None:
        """The text of a member that is a number, such as the damping; None where it is not written."""
        if key not in self.definition.members:
            return None
        value = self.definition.members[key]
        if isinstance(value, str) and value in self.given:
            value = self.given[value]
        elif callable(value):
            value = self.called(value, {}, key)
        return text_of_number(value, f"{key} of {self.definition.what}")

    def parts(self) -> list[_pfaff.Tape]:
        """The tapes of the changes of the parts that are solved exactly."""
        if "part_flow" not in self.definition.members:
            return []
        member = self.definition.members["part_flow"]
        names = self.definition.part_names
        if not names:
            raise InputError(f"part_flow of {self.definition.what}: expected part_names beside it, a name for each part")
        small = self.definition.small_part
        if small is not None and small >= len(names):
            raise InputError(f"small_part of {self.definition.what}: expected the number of one of {len(names)} parts, counted from 0, got {small}")
        self.names["part_names"] = list(names)

        def change(part: int) -> Callable[[Any, list], list]:
            def results(h: Any, numbers: list) -> list:
                values = flat(self.called(member, {"part": part, "h": h, **self.coordinates.known(numbers)}, "part_flow"), "part_flow")
                if len(values) != self.n:
                    raise InputError(f"{place_of(member)}part_flow of {self.definition.what} returned {len(values)} results; expected {self.n}")
                return values

            return results

        return [self.recorded(self.n, change(part), f"part {name} of {self.definition.what}") for part, name in enumerate(names)]

    def _name_results(self, member: str, results: Any, key: str) -> None:
        count = len(results) if isinstance(results, Mapping) else None
        letter = next(letter for _, names, letter in COUNTS.values() if names == member)
        if count is None:
            total = len(flat(results, key))
            count = total // max(1, self.n // 2) if key == "velocity_constraints" else total
            self.names[member] = [f"{letter}{k}" for k in range(1, count + 1)]
        else:
            self.names[member] = [str(name) for name in results]

    def _count(self, key: str, values: list, what: str) -> None:
        if key in ("holonomic", "constraints"):
            self.sizes["constraints"] = len(values)
        if key == "velocity_constraints":
            half = self.n // 2
            if half == 0 or len(values) % half or not values:
                raise InputError(f"{what} returned {len(values)} results; expected rows of {half}, one number for each position")
            self.sizes["velocity_constraints"] = len(values) // half


def _only(numbers: list, what: str) -> Any:
    """The number of a list of one."""
    if len(numbers) != 1:
        raise InputError(f"{what} returned {len(numbers)} results; expected 1")
    return numbers[0]
