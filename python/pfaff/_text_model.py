"""Systems written in Python as text models, whose parameters stay parameters."""
from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any

from . import _pfaff
from ._definition import FORMULAS
from ._errors import InputError
from ._naming import kebab
from ._numbers import text_of_number
from ._toml import toml_of
from ._tracer import Tracer
from ._tracing import flat, recorded

# Formulas whose results are rows of a matrix.
_MATRICES = ("structure",)
# Those that a text model writes as one expression, and those whose results may have names.
_WITH_NAMES = {"holonomic": "constraint_names", "constraints": "constraint_names"}


class SymbolicTracer(Tracer):
    """Records formulas with their parameters as numbers behind the arguments; whole ones stay what they are."""

    def __init__(self, definition: Any, values: dict[str, Any]) -> None:
        super().__init__(definition, values)
        self.symbols = [key for key, value in self.given.items() if not isinstance(value, int)]

    def recorded(self, inputs: int, results: Callable[[Any, list], list], what: str) -> _pfaff.Tape:
        def with_symbols(t: Any, numbers: list) -> list:
            before = self.given
            self.given = {**before, **dict(zip(self.symbols, numbers[inputs:]))}
            self.owner = self._owner()
            try:
                return results(t, numbers[:inputs])
            finally:
                self.given = before
                self.owner = self._owner()

        return recorded(inputs + len(self.symbols), with_symbols, what)

    def damping(self) -> _pfaff.Tape | None:
        """The damping as a formula of the parameters."""
        member = self.definition.members.get("damping")
        if member is None:
            return None

        def result(t: Any, numbers: list) -> list:
            if isinstance(member, str):
                return [self.given.get(member, member)]
            return flat(self.called(member, {}, "damping") if callable(member) else member, "damping")

        return self.recorded(0, result, "damping")


class Writer:
    """The keys of a text model, one after the other."""

    def __init__(self, tracer: SymbolicTracer) -> None:
        self.tracer, self.source = tracer, tracer.source()
        self.lets: dict[str, str] = {}
        self.taken = {*tracer.coordinates.blocks, *tracer.values, "t"}

    def texts(self, tape: _pfaff.Tape, inputs: list[str], key: str, time: str = "t") -> list[str]:
        """The results of a tape as expressions; what is used twice is defined."""
        prefix = re.sub(r"\W", "_", key) + "_v"
        while any(name.startswith(prefix) for name in self.taken):
            prefix += "_"
        results, definitions = _pfaff.text_of_tape(tape, [*inputs, *self.tracer.symbols], time, prefix)
        self.lets.update(definitions)
        return results

    def keys(self) -> dict[str, Any]:
        """What the text model says, key by key."""
        t, d = self.tracer, self.tracer.definition
        names, n = t.coordinates.in_texts, t.n
        keys: dict[str, Any] = {"name": kebab(d.name), "title": d.title or d.name, "time_unit": d.time_unit}
        keys["parameters"] = {key: text_of_number(t.values[key], key) for key in t.symbols}
        keys["coordinates"] = self.coordinates()
        keys["initial"] = self.source["initial"]
        formulas = dict(self.source["formulas"])
        if "hamiltonian" in formulas and "poisson_tensor" not in formulas and "kinetic" not in formulas:
            parts = _pfaff.split_energy(formulas["hamiltonian"], n)
            if parts:
                del formulas["hamiltonian"]
                formulas |= dict(zip(("kinetic", "potential"), parts))
        for key, tape in formulas.items():
            if key not in ("invariants", "velocity_offsets"):
                keys[_KEY_OF.get(key, key)] = self.formula(key, tape)
        damping = t.damping()
        if damping is not None:
            keys["damping"] = self.texts(damping, [], "damping")[0]
        if "velocity_constraints" in formulas:
            keys["velocity_constraints"] = self.velocity_constraints(formulas)
        if self.source["parts"]:
            keys["parts"] = [
                {"name": name, "change": self.texts(tape, names, f"part{k}", "h"), **({"small": True} if k == d.small_part else {})}
                for k, (name, tape) in enumerate(zip(t.names["part_names"], self.source["parts"]))
            ]
        if "invariants" in formulas:
            values = self.texts(formulas["invariants"], names, "invariant")
            keys["invariants"] = {
                name: {"of": text, "behaviour": behaviour, **({"unit": unit} if unit else {})}
                for (name, unit, behaviour), text in zip(self.source["invariants"], values)
            }
        if d.chart_coordinates:
            keys["chart_coordinates"] = d.chart_coordinates
        keys["let"] = self.lets
        return {key: value for key, value in keys.items() if value not in ({}, [], "")}

    def coordinates(self) -> Any:
        units = dict(self.source["coordinates"])
        blocks = self.tracer.coordinates.blocks
        if any(isinstance(place, slice) for place in blocks.values()):
            return {
                name: {"count": place.stop - place.start, "unit": units[f"{name}1"]}
                for name, place in blocks.items()
                if isinstance(place, slice)
            }
        return [{"name": name, "unit": units[name]} if units[name] else name for name in blocks]

    def formula(self, key: str, tape: _pfaff.Tape) -> Any:
        t = self.tracer
        names, n = t.coordinates.in_texts, t.n
        time = "t"
        if key in FORMULAS:
            times = re.findall(r"const T& (\w+)", FORMULAS[key][1])
            ins = re.findall(r"In<T> (\w+)", FORMULAS[key][1])
            time, inputs = times[0], []
            for name in ins:
                if name in ("new_z", "old_z"):
                    inputs += [name[:-1] + one for one in names]
                elif name == "y":
                    inputs += t.definition.chart_coordinates or [f"y[{k}]" for k in range(1, n + 1)]
                else:
                    inputs += names[: n // 2] if name == "q" else names[n // 2 :] if name == "p" else names
            inputs += times[1:]
        else:
            inputs = names
        results = self.texts(tape, inputs, key, time)
        if key in _WITH_NAMES:
            return dict(zip(t.names[_WITH_NAMES[key]], results))
        if key == "alpha":
            return {"w_hat": results[:n], "w": results[n:]}
        if key in _MATRICES or key in ("poisson_tensor", "symmetric_tensor"):
            return [results[k * n : (k + 1) * n] for k in range(n)]
        if key == "velocity_constraints":
            return results
        return results[0] if FORMULAS.get(key, (False,))[0] else results

    def velocity_constraints(self, formulas: dict[str, _pfaff.Tape]) -> list[dict[str, Any]]:
        t = self.tracer
        half = t.n // 2
        rows = self.texts(formulas["velocity_constraints"], t.coordinates.in_texts[:half], "velocity_constraints")
        offsets: Sequence[str | None] = [None] * (len(rows) // half)
        if "velocity_offsets" in formulas:
            offsets = self.texts(formulas["velocity_offsets"], t.coordinates.in_texts[:half], "velocity_offsets")
        return [
            {"name": name, "row": rows[k * half : (k + 1) * half], **({"b": offset} if offset else {})}
            for k, (name, offset) in enumerate(zip(t.names["velocity_constraint_names"], offsets))
        ]


# The keys that are called otherwise than their formulas.
_KEY_OF = {"poisson_tensor": "bracket", "symmetric_tensor": "symmetric_bracket"}


def text_model_of(system: Any) -> str:
    """The text model of a system that is written in Python."""
    definition = getattr(system._definition, "definition", None)
    if definition is None:
        raise InputError(f"to_toml: system {system.name} has no formulas in Python here; expected one that pfaff.system or a class makes")
    writer = Writer(SymbolicTracer(definition, definition.values(system._given)))
    return toml_of(writer.keys(), f"system {system.name}")
