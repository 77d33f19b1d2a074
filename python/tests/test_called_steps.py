"""Steps that are functions called at every step: their derivatives and digits, and what methods of Python remember."""
import gc
import math
import weakref
from fractions import Fraction

import numpy as np
import pytest

import pfaff

FIRST = {"title": "A", "method": [{"label": "RK4", "integrator": "rk4"}], "case": [{"name": "s", "system": "pendulum", "time": 1, "steps": [0.1]}]}


def euler(**claims):
    return pfaff.method(order=1, **claims)(lambda problem, t, h, z: z + h * problem.field(t, z))


@pytest.mark.parametrize("in_floats", [lambda z: np.asarray(z, float), lambda z: np.array([math.fsum([x]) for x in z])])
def test_a_step_in_floats_has_no_derivatives_and_says_so(in_floats):
    """A float has none, which a Jacobian would not show."""

    @pfaff.method(order=1, traced=False, preserves=["symplectic"])
    def rounded(problem, t, h, z):
        return z + h * np.asarray(problem.field(t, in_floats(z)), float)

    assert pfaff.Integration("kepler", rounded, step=0.1).steps(3).reached  # doubles are floats
    with pytest.raises(pfaff.RunFailed, match="cannot become a float"):
        pfaff.Integration("kepler", rounded, step=0.1).jacobian(5)
    with pytest.raises(pfaff.RunFailed, match="cannot become a float"):
        pfaff.Integration("kepler", rounded, step=0.1, precision="quad").steps(1)
    run = pfaff.run("pendulum", rounded, step=0.1, time=5)
    assert run.summary["structure_residual"] is None
    assert not pfaff.verify(rounded, on="kepler").ok


def test_called_steps_have_the_functions_of_recorded_ones():
    def step(problem, t, h, z, size=np.abs):
        q, p = z
        bent = np.tan(q) + np.sinh(q) * np.cosh(p) + np.tanh(p) + np.arctan(q) + np.arctan2(q, p) + np.hypot(q, p) + np.arcsin(q / 4)
        return np.array([q + h * (+p), p + h * (bent + np.arccos(p / 4) + size(q))])

    def called(problem, t, h, z):
        return step(problem, t, h, z, np.fabs)

    def recorded(problem, t, h, z):
        return step(problem, t, h, z)

    for precision in ("double", "quad"):
        ends = [pfaff.Integration("pendulum", pfaff.method(order=1, traced=traced)(one), step=0.1, initial=[0.5, 0.3], precision=precision)
                for one, traced in ((called, False), (recorded, True))]
        matrices = [it.jacobian(2)[1] for it in ends]
        assert np.allclose(*matrices, rtol=1e-13)
        for it in ends:
            it.steps(2)
        assert np.allclose(ends[0].state, ends[1].state, rtol=1e-14)


@pytest.mark.parametrize("traced", [True, False])
def test_memory_is_that_of_the_step_before(traced):
    """A method that remembers is itself wherever it is put: it begins anew where it does not go on from where it was."""

    def slope(problem, t, h, z, f, old, known):
        started = known * (Fraction(3, 2) * f - Fraction(1, 2) * old)
        return z + h * (started + (1 - known) * problem.field(t + h / 2, z + h / 2 * f))

    if traced:
        @pfaff.method(order=2, memory=lambda n: n + 1)
        def adams(problem, t, h, z, memory):
            f = problem.field(t, z)
            return slope(problem, t, h, z, f, memory[:-1], memory[-1]), np.concatenate([f, [1]])
    else:
        @pfaff.method(order=2, traced=False)
        def adams(problem, t, h, z, work):
            f = problem.field(t, z)
            old, known = (work["f"], 1) if "f" in work else (f, 0)
            work["f"] = f
            return slope(problem, t, h, z, f, old, known)

    checks = pfaff.verify(adams, on="kepler")
    assert checks.ok, checks.verdict
    it = pfaff.Integration("kepler", adams, step=0.1)
    it.steps(5)
    it.go_on_from([1, 0.1, 0, 1])
    it.steps(1)
    fresh = pfaff.Integration("kepler", adams, step=0.1, initial=[1, 0.1, 0, 1])
    fresh.steps(1)
    assert np.array_equal(it.state, fresh.state)
    # The control: in a row it does remember.
    apart = np.array(fresh.state)
    fresh.steps(1)
    again = pfaff.Integration("kepler", adams, step=0.1, initial=list(apart))
    again.steps(1)
    assert not np.array_equal(again.state, fresh.state)


def test_methods_of_one_name_need_labels():
    with pytest.raises(pfaff.InputError, match="labels that differ"):
        pfaff.compare(FIRST, methods=[euler(name="e"), euler(name="e")], timing=0.001)
    assert pfaff.compare(FIRST, methods={"one": euler(name="e"), "two": euler(name="e")}, timing=0.001).runs == 3


def test_a_claim_out_of_whose_scope_the_system_is_is_not_judged_and_shown():
    checks = pfaff.verify(euler(preserves=["energy"]), on="driven-duffing")
    (left,) = [check for check in checks if check.claim == "energy"]
    assert left.not_judged and "out of its scope" in left.reason and "1 could not be judged" in checks.verdict
    # On a system of which it speaks it is judged, and false.
    assert not pfaff.verify(euler(preserves=["energy"]), on="kepler").ok


class Held:
    pass


@pytest.mark.parametrize("traced", [True, False])
def test_methods_go_with_what_they_hold(traced):
    def made(held):
        def step(problem, t, h, z):
            return z + h * problem.field(t, z) * (1 if held else 0)

        pfaff.Integration("kepler", pfaff.method(order=1, traced=traced)(step), step=0.1).steps(1)

    held = Held()
    left = weakref.ref(held)
    made(held)
    del held
    gc.collect()
    assert left() is None


def test_what_a_called_step_has_no_use_for_is_refused():
    for argument, said in (({"memory": 5}, "argument `work`"), ({"compiled": True}, "compiled: expected none")):
        with pytest.raises(pfaff.InputError, match=said):
            euler(traced=False, **argument)
    forgetful = pfaff.method(order=1, memory=2, name="forgetful")(lambda problem, t, h, z, memory: z)
    with pytest.raises(pfaff.InputError, match=r"method forgetful has a memory; expected a tuple \(state, memory\)"):
        pfaff.Integration("kepler", forgetful, step=0.1)
    short = pfaff.method(order=1, traced=False, name="short")(lambda problem, t, h, z: z[:1])
    with pytest.raises(pfaff.InputError, match="the step of method short returned: expected 4 numbers, got 1"):
        pfaff.Integration("kepler", short, step=0.1).steps(1)


def test_what_a_step_raises_passes_through_an_experiment():
    @pfaff.method(order=1, traced=False, name="raising")
    def raising(problem, t, h, z):
        raise KeyError("boom")

    with pytest.raises(KeyError, match="boom"):
        pfaff.compare(FIRST, methods=[raising], timing=0.001)


def test_a_step_that_does_not_converge_is_one_like_any_other():
    @pfaff.method(order=1, traced=False, name="giving-up")
    def giving_up(problem, t, h, z):
        if t > 0.45:
            raise pfaff.NotConverged("no")
        return z + h * problem.field(t, z)

    with pytest.raises(pfaff.NotConverged) as ended:
        pfaff.run("pendulum", giving_up, step=0.1, time=2, structure=False)
    assert np.allclose(ended.value.run.t, np.arange(6) / 10)
    with pytest.raises(pfaff.NotConverged) as ended:
        pfaff.Integration("pendulum", giving_up, step=0.1).steps(20, every=1)
    assert np.allclose(ended.value.run.t, np.arange(1, 6) / 10)
    compared = pfaff.compare(FIRST, methods=[giving_up], timing=0.001)
    assert (compared.runs, compared.failed) == (2, 1)
    several = pfaff.ensemble("pendulum", giving_up, [[1, 0], [2, 0]], step=0.1, steps=10)
    assert len(several.failures) == 2
