"""Arguments of the wrong kind are refused in one line that names the argument, by all functions, for all arguments."""
import inspect
import pathlib
import sys

import numpy as np
import pytest
from definitions import duffing, henon_heiles

import pfaff

pytestmark = pytest.mark.filterwarnings("ignore:Animation was deleted")


class Thing:
    """Something that is nothing of what is expected, and whose text has two lines."""

    def __repr__(self):
        return "a thing\nof two lines"


# A value of each kind. The kinds that an argument takes stand beside it below; of these a value may be wrong nevertheless.
KINDS = {
    "number": 3, "negative": -1.5, "infinite": float("inf"), "text": "abc", "empty text": "", "nothing": None, "empty": [], "numbers": [1, 2],
    "numbers not finite": [float("nan"), 0], "names": ["a"], "nothings": [None], "matrix": np.eye(3), "rows": [[1, 2], [3]], "dictionary": {"a": 1},
    "empty dictionary": {}, "dictionary of numbers": {1: 2}, "truth": True, "thing": Thing(), "complex": 1j, "bytes": b"x", "function": lambda x: x,
}
NUMBER = {"number", "negative"}


def experiment():
    return {"title": "Swing", "method": [{"label": "Verlet", "integrator": "verlet"}], "case": [{"name": "swing", "system": "pendulum", "time": 1, "steps": [0.1]}]}


def of_system(function=lambda q, p: p**2 / 2 + q**2 / 2, coordinates=("q", "p"), **keywords):
    return pfaff.system(coordinates=coordinates, **keywords)(function)


def of_method(function=lambda problem, t, h, z: z + h * problem.field(t, z), order=1, **keywords):
    return pfaff.method(order=order, **keywords)(function).order("kepler")


def integration():
    return pfaff.Integration(duffing, "verlet", step=0.1)


def rates(t, y):
    return [y[1], -y[0]]


PARAMETERS = {"system_parameters": {"nothing", "empty dictionary"}, "method_parameters": {"nothing", "empty dictionary"}}
STEPPED = {"system": (), "method": (), "step": NUMBER | {"nothing"}, "initial": {"nothing", "numbers"}, "t0": NUMBER, "tolerance": NUMBER | {"nothing", "text"}, "absolute": NUMBER | {"empty", "numbers"},
           "precision": (), "formulation": {"nothing", "empty text"}, "alpha": NUMBER, **PARAMETERS}
# What is called, with the arguments that it needs; then each argument, with the kinds of values that it takes.
CALLS = {
    "run": (pfaff.run, {"system": duffing, "method": "verlet", "step": 0.1, "time": 1}, {
        **STEPPED, "time": NUMBER, "every": {"number"}, "initial_velocities": {"nothing"}, "reference": {"nothing"}, "measures": {"empty", "empty text", "function"}, "structure": {"truth"},
        "project_initial": {"truth"}, "allow_inconsistent": {"truth"}, "out": {"nothing", "text"}, "force": {"truth"}}),
    "Integration": (pfaff.Integration, {"system": duffing, "method": "verlet", "step": 0.1}, STEPPED),
    "Integration.steps": (lambda **k: integration().steps(**k), {"n": 2}, {"n": {"number"}, "every": {"number"}}),
    "Integration.to": (lambda **k: integration().to(**k), {"t": 1}, {"t": NUMBER, "every": {"number"}}),
    "Integration.watch": (lambda **k: integration().watch(**k), {"callback": print}, {"callback": {"function"}, "every": {"number"}}),
    "Integration.beside": (lambda **k: integration().beside(**k), {"state": [1, 2]}, {"state": {"numbers"}}),
    "Integration.go_on_from": (lambda **k: integration().go_on_from(**k), {"state": [1, 2]}, {"state": {"numbers"}, "t0": NUMBER | {"nothing"}, "step": NUMBER | {"nothing"}}),
    "Integration.jacobian": (lambda **k: integration().jacobian(**k), {"n": 2}, {"n": {"number"}}),
    "Run.sensitivity": (lambda **k: pfaff.run(duffing, "verlet", step=0.1, time=1).sensitivity(**k), {}, {"parameter": ()}),
    "Run.plot": (lambda **k: pfaff.run(duffing, "verlet", step=0.1, time=1).plot(**k), {}, {"kind": (), "axes": {"nothing"}, "coordinates": {"nothing"}, "label": {"text", "empty text"}}),
    "Run.plot animation": (lambda **k: pfaff.run("n-pendulum", "rattle", step=0.01, time=0.1).plot("animation", **k), {}, {
        "positions": {"nothing"}, "rods": {"nothing", "empty"}, "frames": {"number"}, "seconds": {"number"}}),
    "ensemble": (pfaff.ensemble, {"system": duffing, "method": "verlet", "states": [[1, 2]], "step": 0.1, "steps": 5}, {
        "system": (), "method": (), "states": (), "step": NUMBER, "steps": {"number"}, "every": {"number"}, "t0": NUMBER, "threads": {"number", "nothing"},
        "tolerance": NUMBER | {"nothing", "text"}, "absolute": NUMBER | {"empty", "numbers"}, "scales": (), "callback": {"function", "nothing"}, "precision": (), **PARAMETERS}),
    "evaluate": (pfaff.evaluate, {"system": duffing}, {
        "system": (), "state": {"nothing", "numbers"}, "time": NUMBER, "formulation": {"nothing", "empty text"}, "precision": (), "centre": {"nothing"}, "alpha": NUMBER}),
    "bracket": (pfaff.bracket, {"f": lambda q: q, "g": lambda p: p, "z": [1, 2], "on": duffing}, {"f": (), "g": (), "z": {"numbers"}, "on": (), "time": NUMBER}),
    "derive": (pfaff.derive, {"system": "spherical-pendulum"}, {
        "system": (), "method": {"nothing"}, "friction_form": {"nothing", "empty text"}, "order": {"number"}, "elimination": {"empty", "names"}, "mass": {"number"}}),
    "Equations.text": (lambda **k: pfaff.derive("spherical-pendulum").text(**k), {}, {"language": ()}),
    "verify": (lambda claimants="verlet", **k: pfaff.verify(claimants, **k), {"on": duffing}, {"claimants": (), "on": {"nothing"}, "full": {"truth"}}),
    "falsify": (pfaff.falsify, {"method": "verlet", "claim": "symplectic", "systems": 1, "budget": 0.1}, {
        "method": (), "claim": {"empty text", "nothing"}, "budget": {"number", "infinite"}, "systems": {"number", "nothing"}, "seed": {"number"}}),
    "compare": (pfaff.compare, {"experiment": experiment(), "timing": 0.001}, {
        "experiment": {"dictionary", "empty dictionary"}, "methods": {"empty", "empty dictionary"}, "out": {"nothing", "text"}, "quick": {"truth"}, "report": {"truth"}, "force": {"truth"}, "compile": {"truth"},
        "timing": {"number", "nothing"}}),
    "reproduce": (pfaff.reproduce, {"paper": "su-qin", "section": "2"}, {"paper": (), "section": {"nothing"}}),
    "solve_ivp": (pfaff.solve_ivp, {"fun": rates, "t_span": (0, 1), "y0": [1, 0]}, {
        "fun": (), "t_span": {"numbers"}, "y0": {"numbers"}, "method": (), "t_eval": {"nothing", "empty"}, "dense_output": (), "events": {"nothing"}, "vectorized": {"truth"},
        "args": {"nothing", "empty"}, "rtol": {"number"}, "atol": {"number", "numbers"}, "step": {"nothing", "number"}, "most_steps": {"nothing"}, "stages": {"number"}}),
    "System": (pfaff.System, {"name": "kepler"}, {"name": (), "compile": {"truth"}, "eccentricity": ()}),
    "system": (of_system, {}, {
        "function": (), "coordinates": (), "initial": {"nothing", "numbers", "empty dictionary", "function"}, "formula": (), "name": {"nothing", "empty text", "text"}, "compile": {"truth"},
        "invariants": {"nothing", "empty dictionary"}, "units": {"nothing", "empty dictionary"}, "behaviours": {"nothing", "empty dictionary"}, "time_unit": {"text", "empty text"},
        "title": {"text", "empty text"}, "part_names": {"names", "empty"}, "chart_coordinates": {"names", "empty"}, "small_part": {"nothing", "number"}, "damping": NUMBER | {"function"},
        "holonomic": (), "bracket": ()}),
    "Method": (pfaff.Method, {"name": "gauss"}, {"name": (), "stages": {"number"}}),
    "method": (of_method, {}, {
        "function": (), "order": {"number"}, "preserves": {"empty"}, "needs": {"empty"}, "name": {"nothing", "text", "empty text"}, "title": {"text", "empty text"},
        "reference": {"text", "empty text"}, "traced": {"truth"}, "compiled": {"truth"}, "memory": {"number"}}),
    "Method.order": (pfaff.Method("gauss").order, {}, {"system": ()}),
    "Method.preserves": (pfaff.Method("gauss").preserves, {}, {"system": ()}),
    "Method.refuses": (pfaff.Method("gauss").refuses, {}, {"system": ()}),
    "table": (pfaff.table, {}, {"table": ()}),
    "where": (pfaff.where, {"condition": 1, "positive": 2, "otherwise": 3}, {
        name: {*NUMBER, "infinite", "truth", "empty", "numbers", "numbers not finite", "matrix"} for name in ("condition", "positive", "otherwise")}),
    "solve": (pfaff.solve, {"matrix": np.eye(2), "right_hand_side": [1, 2]}, {"matrix": (), "right_hand_side": {"numbers", "numbers not finite"}}),
}
T, Z = np.linspace(0, 1, 4), np.ones((4, 2))
AXES = {"axes": {"nothing"}}
UNIT = {"text", "empty text"}
UNITS = {"units": {"nothing", "empty dictionary", "dictionary"}, "label": UNIT}
PLOTS = {
    "trajectory": ({"t": T, "z": Z, "names": ["q", "p"]}, {"t": (), "z": (), "names": (), "coordinates": {"nothing"}, "time_unit": UNIT, **UNITS, **AXES}),
    "phase_portrait": ({"t": T, "z": Z, "names": ["q", "p"]}, {"t": (), "z": (), "names": (), "coordinates": {"nothing"}, **UNITS, **AXES}),
    "drift": ({"t": T, "values": {"energy": T}}, {"t": (), "values": {"empty dictionary"}, "time_unit": UNIT, "relative": {"truth"}, **UNITS, **AXES}),
    "measure": ({"t": T, "values": T, "name": "error"}, {"t": (), "values": (), "name": UNIT, "unit": UNIT, "time_unit": UNIT, "label": UNIT, **AXES}),
    "work_precision": ({"curves": {"one": ([1, 2], [3, 4])}}, {
        "curves": {"empty dictionary"}, "families": {"nothing", "empty dictionary", "dictionary"}, "work": UNIT, "error": UNIT, **AXES}),
    "bodies": ({"t": T, "positions": np.ones((4, 2, 2))}, {
        "t": (), "positions": (), "rods": {"nothing", "empty"}, "origin": {"truth"}, "frames": {"number"}, "seconds": {"number"}, "unit": UNIT, "time_unit": UNIT}),
}
# Arguments that are positional alone, by what messages call them.
POSITIONAL = {pfaff.System: "name", pfaff.Method: "name", pfaff.table: "table"}


@pytest.fixture(autouse=True)
def no_figures():
    yield
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is not None:
        pyplot.close("all")


def said(call, needed, argument, value):
    """What is said of a value of an argument; None where it is taken."""
    keywords = {**needed, argument: value}
    first = [keywords.pop(POSITIONAL[call])] if call in POSITIONAL else []
    try:
        call(*first, **keywords)
    except (pfaff.InputError, pfaff.TraceError) as refused:
        return str(refused)
    return None


def wrong(call, needed, argument, taken):
    """Which kinds of values are not refused as they should be."""
    found = []
    for kind, value in KINDS.items():
        message = said(call, needed, argument, value)
        if kind in taken:
            continue
        named = message is not None and (argument in message or "unknown" in message or message.startswith("table"))
        if not named or "\n" in message or not any(word in message for word in ("expected", "did you mean", "is missing")):
            found.append((kind, message))
    return found


@pytest.mark.parametrize("name, argument", [(name, argument) for name, (_, _, arguments) in CALLS.items() for argument in arguments])
def test_an_argument_of_the_wrong_kind_is_named(name, argument, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call, needed, arguments = CALLS[name]
    assert wrong(call, needed, argument, arguments[argument]) == []


@pytest.mark.parametrize("name, argument", [(name, argument) for name, (_, arguments) in PLOTS.items() for argument in arguments])
def test_an_argument_of_a_plot_is_named(name, argument):
    pytest.importorskip("matplotlib")
    needed, arguments = PLOTS[name]
    assert wrong(getattr(pfaff.plots, name), needed, argument, arguments[argument]) == []


def test_a_plot_that_is_refused_leaves_no_figure():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    for call in (lambda: pfaff.plots.trajectory(T, Z, ["q", "p"], coordinates="x"), lambda: pfaff.plots.drift(T, {"energy": Z}), lambda: pfaff.plots.measure(T, T, 3)):
        with pytest.raises(pfaff.InputError):
            call()
    assert not pyplot.get_fignums()


def test_all_arguments_of_all_functions_are_tried():
    functions = {name: getattr(pfaff, name) for name in pfaff.__all__ if name != "plots"}
    functions = {name: one for name, one in functions.items() if inspect.isfunction(one) and inspect.signature(one).parameters}
    functions |= {f"Integration.{name}": one for name, one in vars(pfaff.Integration).items() if inspect.isfunction(one) and not name.startswith("_")}
    for name, one in functions.items():
        named = [key for key, of in inspect.signature(one).parameters.items() if of.kind is not of.VAR_KEYWORD and key != "self"]
        if name == "table":
            named = ["table"]
        assert not named or set(named) <= set(CALLS[name][2]), name
    for name in PLOTS:
        assert set(inspect.signature(getattr(pfaff.plots, name)).parameters) == set(PLOTS[name][1]), name


def stepped(step, **keywords):
    return pfaff.Integration("kepler", pfaff.method(order=1, **keywords)(step), step=0.1).steps(1)


OSCILLATOR = {"coordinates": ["q", "p"], "initial": [1, 0], "kinetic": lambda self, p: p**2 / 2, "potential": lambda self, q: q**2 / 2}
# What calls functions that give a value of each kind, or are given one.
GIVEN = {
    **{f"a class with {member}": (lambda member: lambda x: type("Spring", (pfaff.System,), {**OSCILLATOR, member: x})())(member)
       for member in ("coordinates", "initial", "kinetic", "potential", "units", "invariants", "title", "system_name", "part_flow", "bracket")},
    "an energy": lambda x: of_system(lambda q, p: x),
    "an invariant": lambda x: of_system(invariants={"one": lambda q: x}),
    "invariants": lambda x: of_system(invariants=lambda q: x),
    "a start": lambda x: of_system(initial=lambda: x),
    "a damping": lambda x: of_system(damping=lambda: x),
    "constraints": lambda x: of_system(lambda p: p @ p, coordinates={"q": 2, "p": 2}, holonomic=lambda q: x),
    "a recorded step": lambda x: stepped(lambda problem, t, h, z: x),
    "a called step": lambda x: stepped(lambda problem, t, h, z: x, traced=False),
    "a called field": lambda x: stepped(lambda problem, t, h, z: z + problem.field(t, x), traced=False),
    "a called field at a time": lambda x: stepped(lambda problem, t, h, z: z + problem.field(x, z), traced=False),
    "a memory": lambda x: stepped(lambda problem, t, h, z, memory: (z, memory), memory=lambda n: x),
    "a function of the state": lambda x: pfaff.bracket(lambda q: x, lambda p: p, [1, 2], on="pendulum"),
    "a measure": lambda x: pfaff.run("pendulum", "verlet", step=0.1, time=1, measures=lambda run: x),
    "a table": lambda x: pfaff.table({"kind": "runge-kutta", "name": "euler", "order": 1, "a": x, "b": [1]}),
    "a case": lambda x: pfaff.compare({**experiment(), "case": [{"name": "swing", "system": x, "time": 1, "steps": [0.1]}]}),
}


@pytest.mark.parametrize("name", GIVEN)
def test_what_functions_and_dictionaries_give_is_refused_in_one_line(name):
    for kind, value in KINDS.items():
        try:
            GIVEN[name](value)
        except (pfaff.InputError, pfaff.TraceError) as refused:
            assert "\n" not in str(refused), kind


@pytest.mark.parametrize("call, words", [
    (lambda: stepped(lambda problem, t, h, z: z + problem.field("now", z), traced=False), "time of field: expected a number, got 'now'"),
    (lambda: stepped(lambda problem, t, h, z: [*z[:3], None], traced=False), "state that the step of method lambda returned: expected a number, got None"),
    (lambda: pfaff.run(duffing, "verlet", step=0.1, time=1, system_parameters=3), "system_parameters: expected a dictionary of names and values, got 3"),
    (lambda: pfaff.run(duffing, "verlet", step=0.1, time=1, out=5), "out: expected the path of a directory, got 5"),
    (lambda: pfaff.run(duffing, "verlet", step=0.1, time=1, initial=np.eye(3)), "got an array of shape (3, 3); pfaff.ensemble takes many initial states"),
    (lambda: pfaff.run(duffing, "verlet", step=0.1, time=1, measures=[lambda run: "x"]), "expected 11 numbers of lambda, one for each sample, got 'x'"),
    (lambda: pfaff.run(duffing, "verlet", step=0.1, time=1, initial=np.ma.array([1.0, 2.0], mask=[0, 1])), "got an array with masked elements"),
    (lambda: pfaff.ensemble(duffing, "verlet", np.ma.array([[1.0, 2.0]], mask=[[0, 1]]), step=0.1, steps=1), "got an array with masked elements"),
    (lambda: pfaff.ensemble(henon_heiles, "verlet", [[1, 2], [3]], step=0.1, steps=1), "states: expected real numbers, an array of shape (N, 4)"),
    (lambda: pfaff.evaluate(duffing, ["x", 1]), "state q of duffing: expected a finite decimal number or a/b, got 'x'"),
    (lambda: duffing(alpha="x"), "parameter 'alpha' of duffing: expected a finite"),
    (lambda: of_system(units={"q": 3}), "units['q']: expected a text, got 3"),
    (lambda: of_system(units={"x1": "m"}), "units: unknown coordinate or invariant 'x1'"),
    (lambda: of_system(behaviours={"energy": "free"}), "behaviours: there is no invariant of which 'energy' could be the name"),
    (lambda: of_system(invariants={"one": lambda z: z}), "invariant one returned 2 results; expected 1"),
    (lambda: of_system(invariants={"one": 1}), "invariants['one']: expected a function, got 1"),
    (lambda: pfaff.compare({"case": 3}), "experiment: case: expected a list of dictionaries, got 3"),
    (lambda: pfaff.compare({"case": [3]}), "experiment: case: expected a list of dictionaries, got [3]"),
    (lambda: pfaff.compare("kepler", methods={1: "verlet"}), "methods: expected labels that are texts, got 1"),
    (lambda: pfaff.plots.work_precision({"one": 3}), "curves['one']: expected a pair of arrays of one shape"),
    (lambda: pfaff.plots.work_precision({}, axes=[1]), "axes: expected one of matplotlib's Axes, got [1]"),
])
def test_what_is_said_of_some(call, words):
    with pytest.raises(pfaff.InputError) as refused:
        call()
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_names_of_results_are_asked_for_by_texts():
    run = pfaff.run(duffing, "verlet", step=0.1, time=1)
    for name in (3, None, ["q"], np.eye(2)):
        with pytest.raises(KeyError, match="column: expected a name, such as 'q'"):
            run[name]
        with pytest.raises(KeyError, match="field: expected a name, such as"):
            run.drift["energy"][name]
        with pytest.raises(pfaff.InputError, match="quantity: expected a name, such as"):
            pfaff.evaluate(duffing)[name]


def test_paths_are_names():
    """A path may be a pathlib.Path wherever it may be a text."""
    path = pathlib.Path("no-such-table.toml")
    for call in (lambda: pfaff.verify(path), lambda: pfaff.falsify(path), lambda: pfaff.derive(path), lambda: pfaff.compare(path)):
        with pytest.raises(pfaff.InputError, match="no-such-table.toml"):
            call()
