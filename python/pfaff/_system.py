"""Systems: registered ones by name, text models by path, and those written in Python."""
from __future__ import annotations

import functools
import importlib
import inspect
import weakref
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _pfaff
from ._definition import DESCRIBING, MEMBERS, TAKEN, Definition
from ._arguments import named_function, shown, text, unknown, yes_or_no
from ._errors import InputError
from ._naming import absolute, kebab
from ._numbers import text_of_setting
from ._tracer import Tracer
from ._tracing import argument_names, as_annotated, place_of


class System:
    """A system with its parameters: what is integrated, verified and compared.

    `pfaff.System(name, **parameters)` is a registered system (`pfaff.systems()` lists them) or, where `name` is the
    path of a file that ends in .toml, a text model. The decorator `pfaff.system` makes one of a function. A subclass
    is a system of several formulas; its methods are called by the names that systems in C++ give theirs, and its
    annotated attributes are its parameters:

    >>> import pfaff
    >>> class Pendulum(pfaff.System):
    ...     coordinates = ["q", "p"]
    ...     initial = [1, 0]
    ...     g: float = 9.81
    ...     def kinetic(self, p):
    ...         return p**2 / 2
    ...     def potential(self, q):
    ...         return -self.g * np.cos(q)
    >>> Pendulum(g=1).parameters
    {'g': '1'}

    Formulas: hamiltonian, or kinetic and potential (with damping), field, birkhoffian and one_form, structure and
    covector, each with what `core/system.hpp` lists beside them: bracket and casimirs, chart and chart_inverse,
    holonomic and friction, velocity_constraints and velocity_offsets, constraints, applied_force, symmetric_bracket and
    entropy, invariants, exact_solution, part_flow, alpha, reversal. Their arguments are the time t, the coordinates by
    their names, the whole state z and its halves q and p, all but the time as NumPy arrays where they are several. They
    are called once for each set of parameters, with numbers that record what is done with them.

    A system is called with other values of its parameters to make another system: kepler(eccentricity=0.5).

    Args:
        name: that of a registered system, or the path of a text model.
        compile: compile the formulas by the system's C++ compiler (kept in a cache), in double precision.
        **parameters: numbers; texts such as "1/3" are exact.

    Raises:
        InputError: unknown names, values out of range, formulas that do not belong together.
        TraceError: a formula does something that cannot be recorded, such as comparing values.
    """

    _definition: Any = None
    _written: dict[str, Any] = {}

    def __init__(self, name: Any = None, /, *, compile: bool = False, **parameters: Any) -> None:
        cls = type(self)
        if cls is not System and cls._definition is None:
            raise InputError(f"{cls.__name__}: expected a class with formulas, such as hamiltonian")
        if cls is not System:
            if name is not None:
                raise InputError(f"{cls.__name__}: expected parameters by their names, got {shown(name)}")
            definition = cls._definition
        elif isinstance(name, str) or hasattr(name, "__fspath__"):
            definition = Registered(str(name))
        else:
            raise InputError(f"name: expected the name of a system or the path of a text model, got {shown(name)}")
        self._begin(definition, parameters, compile)

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        # What a class writes of itself is kept apart, where instances have properties of these names.
        cls._written = {key: vars(cls)[key] for key in ("coordinates", "initial", "invariants") if key in vars(cls)}
        for key in cls._written:
            delattr(cls, key)
        cls._definition = _definition_of_class(cls)

    def _begin(self, definition: Any, parameters: Mapping[str, Any], compile: bool) -> None:
        self._definition = definition
        self._given = dict(parameters)
        self._compile = yes_or_no(compile, "compile")
        self.model: _pfaff.Model = definition.model(parameters, self._compile)

    @classmethod
    def _made(cls, definition: Any, parameters: Mapping[str, Any], compile: bool) -> System:
        system = object.__new__(cls)
        system._begin(definition, parameters, compile)
        return system

    @functools.cached_property
    def name(self) -> str:
        """The name of the system."""
        return self.model.name

    @functools.cached_property
    def dimension(self) -> int:
        """The number of coordinates."""
        return self.model.dimension

    @functools.cached_property
    def coordinates(self) -> tuple[str, ...]:
        """The names of the coordinates, in the order of a state."""
        return tuple(name for name, _ in self.model.coordinates)

    @property
    def invariants(self) -> dict[str, str]:
        """The named quantities that a run follows, each with what is expected of it: conserved, decreasing, ..."""
        return {name: behaviour for name, _, behaviour, _ in self.model.invariants}

    @property
    def parameters(self) -> dict[str, str]:
        """All parameters with their values, as exact texts."""
        return dict(self.model.parameters)

    @property
    def initial(self) -> np.ndarray:
        """The state from which runs start where none is given, shape (dimension,); empty where there is none."""
        return self.model.initial

    @property
    def facets(self) -> tuple[str, ...]:
        """What the system offers to methods, such as 'vector-field' and 'separable'."""
        return tuple(self.model.facets)

    @property
    def registered_name(self) -> str:
        """The name of a registered system, or the path of a text model; empty for systems written in Python."""
        return absolute(self._definition.name) if isinstance(self._definition, Registered) else ""

    def compiled(self) -> System:
        """The same system with compiled formulas; the same object where they are, or where there is no compiler."""
        return self if self._compile else self._made(self._definition, self._given, True)

    def to_toml(self) -> str:
        """The system as a text model, with its parameters as parameters. See docs/text-models.md.

        Raises:
            InputError: of registered systems and text models, which are not written in Python.
        """
        from ._text_model import text_model_of

        return text_model_of(self)

    def __call__(self, *, compile: bool | None = None, **parameters: Any) -> System:
        """The system with other values of some of its parameters."""
        chosen = self._compile if compile is None else compile
        return self._made(self._definition, {**self._given, **parameters}, chosen)

    def __repr__(self) -> str:
        values = "".join(f", {key}={value}" for key, value in self.parameters.items())
        return f"<system {self.name}{values}: {', '.join(self.coordinates)}>"

    def __reduce__(self) -> tuple:
        return self._definition.pickled(self._given, self._compile)


class Registered:
    """A registered system, or the text model of a path."""

    def __init__(self, name: str) -> None:
        self.name = name

    def model(self, parameters: Mapping[str, Any], compile: bool) -> _pfaff.Model:
        values = [(key, text_of_setting(value, f"parameter '{key}' of {self.name}")) for key, value in parameters.items()]
        return _compiled(_pfaff.make_system(self.name, values), compile)

    def pickled(self, parameters: Mapping[str, Any], compile: bool) -> tuple:
        return _registered, (self.name, dict(parameters), compile)


class Traced:
    """A system written in Python; what its formulas are with given parameters is recorded once.

    Models are kept as long as somebody has them, and recordings of the last sets of parameters.
    """

    MOST = 64

    def __init__(self, definition: Definition, reference: tuple[str, str] | None) -> None:
        self.definition, self.reference = definition, reference
        self._sources: dict[tuple, dict] = {}
        self._models: weakref.WeakValueDictionary[tuple, _pfaff.Model] = weakref.WeakValueDictionary()

    def source(self, parameters: Mapping[str, Any]) -> dict:
        """What the library makes a model of, with these parameters."""
        values = self.definition.values(parameters)
        key = tuple(text_of_setting(value, name) for name, value in values.items())
        if key not in self._sources:
            if len(self._sources) >= self.MOST:
                del self._sources[next(iter(self._sources))]
            self._sources[key] = Tracer(self.definition, values).source()
        return self._sources[key]

    def model(self, parameters: Mapping[str, Any], compile: bool) -> _pfaff.Model:
        source = self.source(parameters)
        key = (tuple(source["parameters"]), compile)
        model = self._models.get(key)
        if model is None:
            model = self._models[key] = _compiled(_pfaff.traced_model(source), compile)
        return model

    def pickled(self, parameters: Mapping[str, Any], compile: bool) -> tuple:
        # By reference where the other process can import it, as pickle does with functions; otherwise what was recorded.
        if self.reference is not None and _referred(*self.reference) is self:
            return _by_reference, (*self.reference, dict(parameters), compile)
        return _frozen, (self.source(parameters), compile)


class Frozen:
    """A system written in Python, as it was recorded, in a process that does not have its functions."""

    def __init__(self, source: dict) -> None:
        self.recorded = source

    def source(self, parameters: Mapping[str, Any]) -> dict:
        if parameters:
            raise InputError(f"system {self.recorded['name']}: its functions are not here, so that its parameters stay what they were")
        return self.recorded

    def model(self, parameters: Mapping[str, Any], compile: bool) -> _pfaff.Model:
        return _compiled(_pfaff.traced_model(self.source(parameters)), compile)

    def pickled(self, parameters: Mapping[str, Any], compile: bool) -> tuple:
        return _frozen, (self.recorded, compile)


def _compiled(model: _pfaff.Model, compile: bool) -> _pfaff.Model:
    return model.compiled() if compile else model


def _referred(module: str, name: str) -> Any:
    """The definition that a module has under a name; None where there is none."""
    try:
        found = functools.reduce(getattr, name.split("."), importlib.import_module(module))
    except (ImportError, AttributeError):
        return None
    return getattr(found, "_definition", None)


def _registered(name: str, parameters: Mapping[str, Any], compile: bool) -> System:
    return System(name, compile=compile, **parameters)


def _by_reference(module: str, name: str, parameters: Mapping[str, Any], compile: bool) -> System:
    found: Any = functools.reduce(getattr, name.split("."), importlib.import_module(module))
    return System._made(found._definition, parameters, compile) if isinstance(found, System) else found(compile=compile, **parameters)


def _frozen(source: dict, compile: bool) -> System:
    return System._made(Frozen(source), {}, compile)


def _definition_of_class(cls: type) -> Traced:
    parameters: dict[str, Any] = {}
    members: dict[str, Any] = {}
    described: dict[str, Any] = {}
    for base in reversed(cls.__mro__[: cls.__mro__.index(System)]):
        for key, annotation in inspect.get_annotations(base).items():
            if key in vars(base) and key not in (*DESCRIBING, *MEMBERS, "coordinates", "initial", "invariants"):
                parameters[key] = as_annotated(vars(base)[key], annotation)
        for key, value in (*vars(base).items(), *getattr(base, "_written", {}).items()):
            if key in TAKEN:
                raise InputError(f"{cls.__name__}: {key}: a system has this itself; expected {'system_name' if key == 'name' else 'another name'}")
            if key in MEMBERS or key in ("coordinates", "initial", "invariants"):
                members[key] = value  # None takes back what a base class writes
            elif key in DESCRIBING or key == "system_name":
                described[key] = value
            elif inspect.isfunction(value) and not key.startswith("_"):
                if near := _pfaff.nearest(key, [*MEMBERS, "invariants", "initial"]):
                    raise InputError(f"{place_of(value)}{cls.__name__}: unknown formula '{key}'; did you mean '{near}'? (a name of your own begins with _)")
    members = {key: value for key, value in members.items() if value is not None}
    coordinates, initial, invariants = (members.pop(key, None) for key in ("coordinates", "initial", "invariants"))
    if coordinates is None:
        raise InputError(f"{cls.__name__}: expected coordinates, such as coordinates = [\"q\", \"p\"]")
    name = text(described.pop("system_name", kebab(cls.__name__)), f"{cls.__name__}: system_name")
    definition = Definition(name, coordinates, members, initial=initial, invariants=invariants, parameters=parameters, of_class=cls, **described)
    return Traced(definition, (cls.__module__, cls.__qualname__))


def system(*, coordinates: Sequence[str] | Mapping[str, Any], initial: Any = None, formula: str = "hamiltonian", name: str | None = None,
           compile: bool = False, invariants: Any = None, **members: Any) -> Callable[[Callable], System]:
    """Makes a system of a function, which is called once, with numbers that record what is done with them.

    >>> import pfaff
    >>> @pfaff.system(coordinates=["q", "p"], initial=[0.5, 0.0])
    ... def duffing(t, q, p, alpha: float = -1.0, beta: float = 1.0):
    ...     return p**2 / 2 + alpha * q**2 / 2 + beta * q**4 / 4
    >>> duffing.facets[:3]
    ('vector-field', 'hamiltonian', 'separable')

    The function gives the Hamiltonian, or another `formula`. Its arguments are found by their names: the time t, the
    coordinates, the whole state z, its halves q and p; arguments with defaults are parameters, whole numbers of which
    may shape loops, unless they are annotated as float, and others of which are exact constants. NumPy's functions work on the numbers; instead of `if` and
    comparisons there are pfaff.where and, for linear systems, pfaff.solve. An energy that is a sum T(p, t) + V(q, t) is
    found to be separable.

    Args:
        coordinates: names, ["q", "p"], or blocks, {"q": 2, "p": 2}, which are arrays in formulas and whose coordinates
            are q1, q2, p1 and p2. Of canonical systems positions stand before momenta. A count may be the name of a
            whole-number parameter.
        initial: the state from which runs start, shape (dimension,); or a dictionary by the names of coordinates; or a
            function of the parameters.
        formula: what the function gives, such as "field".
        name: that of the system; without it that of the function, in kebab-case.
        compile: compile the formulas by the system's C++ compiler, in double precision.
        invariants: named quantities to follow, {"momentum": lambda p: p[0]}, or a function that gives a dictionary of
            their values. The energy of an autonomous system is followed untold.
        **members: other formulas by the names that pfaff.System lists, such as holonomic=lambda q, l=1.0: q @ q - l**2;
            and what describes them: units and behaviours (dictionaries by the names of coordinates and invariants),
            time_unit, part_names, small_part, chart_coordinates, title.

    Raises:
        InputError: formulas that do not belong together, wrong numbers of results, unknown names.
        TraceError: a formula does something that cannot be recorded.
    """
    described = {key: members.pop(key) for key in DESCRIBING if key in members}
    for key in (*members, formula):
        if not isinstance(key, str) or key not in MEMBERS:
            raise InputError("system: " + unknown("formula", key, [*MEMBERS, *DESCRIBING]))
    if formula in members:
        raise InputError(f"system: '{formula}' is what the function gives; expected it once")

    def decorate(function: Callable) -> System:
        argument_names(named_function(function, "system", f"a function that gives the {formula}"))
        own = text("" if name is None else name, "name") or kebab(function.__name__)
        definition = Definition(own, coordinates, {**members, formula: function}, initial=initial, invariants=invariants, **described)
        made = System._made(Traced(definition, (function.__module__, function.__qualname__)), {}, compile)
        made.__doc__ = function.__doc__
        return made

    return decorate


def systems() -> list[str]:
    """The names of all registered systems; `pfaff describe NAME` says what they are.

    >>> "kepler" in systems()
    True
    """
    return _pfaff.system_names()
