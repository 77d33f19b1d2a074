"""Methods written in Python: they step as their twins do, in every scalar, traced or called; and bad ones are refused."""
import subprocess
import warnings
from fractions import Fraction

import numpy as np
import pytest
from definitions import duffing, henon_heiles, kick, oscillator, runge_kutta

import pfaff


def end(system, method, steps=50, step=0.05, **settings):
    it = pfaff.Integration(system, method, step=step, **settings)
    it.steps(steps)
    return it.state


def order_of(method, system, precision="quad"):
    """The order of a method, from one step of two sizes against Taylor's method in quad: log2 of the ratio, less one."""
    errors = []
    for step in ("1/50", "1/100"):
        ours = pfaff.Integration(system, method, step=step, precision=precision)
        ours.steps(1)
        exact = pfaff.Integration(system, "taylor", step=step, tolerance="1e-28", precision="quad")
        exact.steps(1)
        errors.append(max(abs(a - b) for a, b in zip(ours.decimals, exact.decimals)))
    return float(np.log2(float(errors[0] / errors[1]))) - 1


def test_a_recorded_step_is_its_twin():
    twin = end(henon_heiles, "rk4")
    # Both round in another order; rk4 of the library compensates: 1e-14 is a unit of round-off a step.
    assert np.abs(end(henon_heiles, runge_kutta) - twin).max() < 1e-14
    assert np.abs(end(henon_heiles, kick) - twin).max() > 1e-5  # another method is seen


def test_recorded_and_called_are_the_same_numbers_in_double_and_quad():
    called = pfaff.method(order=2, needs=["separable"], traced=False, name="called")(kick._definition.function)
    assert np.array_equal(end(henon_heiles, called), end(henon_heiles, kick))
    ends = []
    for method in (called, kick):
        it = pfaff.Integration(duffing, method, step="1/20", precision="quad")
        it.steps(20)
        ends.append((it.decimals, it.jacobian(3)[1]))
    assert ends[0][0] == ends[1][0] and np.array_equal(ends[0][1], ends[1][1])


def test_orders_are_those_that_are_claimed():
    # The slope of the local error of a method of order p is p + 1, to a tenth at these steps.
    assert abs(order_of(kick, duffing) - 2) < 0.1
    assert abs(order_of(runge_kutta, duffing) - 4) < 0.1
    assert kick.order("kepler") == 2 and kick.preserves("kepler") == ("symplectic", "symmetric")


def test_a_step_of_a_symplectic_method_is_symplectic():
    n = 2
    j = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    residual = {}
    for method in (kick, runge_kutta):
        m = pfaff.Integration(henon_heiles, method, step=0.1).jacobian(1)[1]
        residual[method.name] = np.abs(m.T @ j @ m - j).max()
    assert residual["kick"] < 1e-14 < 1e-9 < residual["runge-kutta"]  # round-off, and the order of the other


def test_constants_that_a_float_has_rounded_are_warned_of():
    def thirds(third):
        def step(problem, t, h, z):
            k1 = problem.field(t, z)
            k2 = problem.field(t + third * h, z + third * h * k1)
            k3 = problem.field(t + 2 * third * h, z + 2 * third * h * k2)
            return z + h * (k1 + 3 * k3) / 4

        return pfaff.method(order=3, name="heun")(step)

    with pytest.warns(UserWarning, match=r"^method heun claims an order and has the constant 0\.33333") as told:
        end(duffing, thirds(1 / 3))
    assert told[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        end(duffing, thirds(Fraction(1, 3)))
    assert abs(order_of(thirds(Fraction(1, 3)), duffing) - 3) < 0.1


@pytest.mark.parametrize("traced", [True, False])
def test_parameters_may_be_exact_texts(traced):
    @pfaff.method(order=1, traced=traced)
    def relaxed(problem, t, h, z, part=0.5):
        return z + part * h * problem.field(t, z)

    assert np.array_equal(end(duffing, relaxed(part="1/4")), end(duffing, relaxed(part=0.25))) and relaxed(part="1/4").parameters == {"part": "1/4"}
    with pytest.raises(pfaff.InputError, match="parameter 'part' of relaxed: expected a finite decimal number"):
        relaxed(part="half")


def test_parameters_and_memory():
    @pfaff.method(order=1)
    def theta(problem, t, h, z, weight=0.5):
        k = problem.field(t, z)
        return z + h * ((1 - weight) * k + weight * problem.field(t + h, z + h * k))

    assert np.array_equal(end(duffing, theta(weight=0)), end(duffing, theta(weight="0"))) and theta(weight=1).parameters == {"weight": "1"}
    assert np.abs(end(duffing, theta) - end(duffing, theta(weight=0))).max() > 1e-4
    assert abs(order_of(theta, duffing) - 2) < 0.1 and abs(order_of(theta(weight=0), duffing) - 1) < 0.1

    # Adams and Bashforth's step of order 2, of which the first step, with nothing remembered, is one of Euler.
    @pfaff.method(order=2, memory=lambda n: n + 1)
    def adams(problem, t, h, z, memory):
        k = problem.field(t, z)
        before = pfaff.where(memory[-1], memory[:-1], k)
        return z + h * (3 * k - before) / 2, np.concatenate([k, [1]])

    it = pfaff.Integration(oscillator, adams, step=0.1)
    it.steps(3)
    z, rate = np.array([1.0, 0.0]), lambda z: np.array([z[1], -4 * z[0]])
    before = rate(z)
    for _ in range(3):
        k = rate(z)
        z, before = z + 0.1 * (3 * k - before) / 2, k
    assert np.abs(it.state - z).max() < 1e-15

    @pfaff.method(order=2, traced=False)
    def remembering(problem, t, h, z, work):
        k = problem.field(t, z)
        before, work["k"] = work.get("k", k), k
        return z + h * (3 * k - before) / 2

    again = pfaff.Integration(oscillator, remembering, step=0.1)
    again.steps(3)
    assert np.abs(again.state - z).max() < 1e-15
    again.forget()
    again.steps(1)
    assert np.abs(again.state - (z + 0.1 * rate(z))).max() < 1e-15


def test_methods_are_parts_of_others():
    whole = pfaff.Method("composition", scheme="yoshida", order=4, base=pfaff.Method("verlet", compensated=False))
    named = pfaff.Method("composition", scheme="yoshida", order=4, base="verlet(compensated=no)")
    assert whole.parameters == named.parameters and np.array_equal(end(duffing, whole), end(duffing, named))
    assert abs(order_of(whole, duffing) - 4) < 0.1
    with pytest.raises(pfaff.InputError, match="expected a registered method"):
        pfaff.Method("composition", base=kick)


def test_tables_are_checked_as_files_are():
    ralston = {"kind": "runge-kutta", "name": "ralston", "order": 2, "a": [[], ["2/3"]], "b": [Fraction(1, 4), "3/4"]}
    z, rate = np.array([0.5, 0.0]), lambda z: np.array([z[1], z[0] - z[0] ** 3])
    k1 = rate(z)
    k2 = rate(z + 2 / 3 * 0.05 * k1)
    assert np.abs(end(duffing, ralston, steps=1) - (z + 0.05 * (k1 + 3 * k2) / 4)).max() < 1e-16
    with pytest.raises(pfaff.InputError, match="a condition of order 3, is off by"):
        pfaff.table({**ralston, "order": 3})
    with pytest.raises(pfaff.InputError, match="^table: key 'a': is missing"):
        pfaff.table({key: value for key, value in ralston.items() if key != "a"})
    with pytest.raises(pfaff.InputError, match="did you mean 'name'"):
        pfaff.table({**ralston, "nme": "x"})


def test_compiled_steps_have_the_bits_of_recorded_ones():
    if subprocess.run(["c++", "--version"], capture_output=True).returncode != 0:
        pytest.skip("there is no C++ compiler here")
    compiled = pfaff.method(order=2, needs=["separable"], compiled=True, name="compiled")(kick._definition.function)
    assert np.array_equal(end(henon_heiles, compiled), end(henon_heiles, kick))


def test_counters_count_right_hand_sides():
    it = pfaff.Integration(henon_heiles, runge_kutta, step=0.1)
    it.steps(10)
    assert it.counters["right_hand_sides"] == 40 and it.counters["steps"] == 10


def bad(step, **claims):
    return pfaff.method(**{"order": 1, "name": "bad", **claims})(step)


@pytest.mark.parametrize(
    "make, kind, words",
    [
        (lambda: pfaff.Method("gaus"), pfaff.InputError, "did you mean 'gauss'"),
        (lambda: pfaff.Method("gauss", stage=2), pfaff.InputError, "did you mean 'stages'"),
        (lambda: pfaff.Method("gauss", stages=200), pfaff.InputError, "stages"),
        (lambda: bad(lambda t, h, z: z), pfaff.InputError, r"expected a function of \(problem, t, h, z\)"),
        (lambda: bad(lambda problem, t, h, z, a: z), pfaff.InputError, "expected defaults"),
        (lambda: bad(lambda problem, t, h, z: z, preserves=["symplctic"]), pfaff.InputError, "did you mean 'symplectic'"),
        (lambda: bad(lambda problem, t, h, z: z, preserves="energy"), pfaff.InputError, r"expected a list of names, such as \['energy'\]"),
        (lambda: bad(lambda problem, t, h, z: z, needs=["separabl"]), pfaff.InputError, "did you mean 'separable'"),
        (lambda: end(duffing, bad(lambda problem, t, h, z: z[:1])), pfaff.InputError, "returned 1 numbers; expected 2"),
        (lambda: end(duffing, bad(lambda problem, t, h, z: None)), pfaff.InputError, "returned nothing"),
        (lambda: end(duffing, bad(lambda problem, t, h, z: z if h > 1 else -z)), pfaff.TraceError, "pfaff.where"),
        (lambda: end(duffing, bad(lambda problem, t, h, z: problem.force(t, z))), pfaff.InputError, "expected one of separable"),
        (lambda: end(duffing, bad(lambda problem, t, h, z: problem.feild(t, z))), pfaff.InputError, "did you mean 'field'"),
        (lambda: end(duffing, bad(lambda problem, t, h, z: z[:1], traced=False)), pfaff.InputError, "expected 2 numbers, got 1"),
        (lambda: end(duffing, bad(lambda problem, t, h, z: 1 / 0, traced=False)), ZeroDivisionError, ""),
        (lambda: end(duffing, bad(lambda problem, t, h, z: 1 / 0)), ZeroDivisionError, ""),
        (lambda: end("lotka-volterra", kick), pfaff.InputError, "kick needs separable; lotka-volterra offers"),
    ],
)
def test_bad_methods_are_refused(make, kind, words):
    with pytest.raises(kind, match=words):
        make()


@pytest.mark.parametrize("answer", [lambda z: z + 1j, lambda z: [complex(x) for x in z]])
def test_a_called_step_has_no_imaginary_parts_to_lose(answer):
    with pytest.raises(pfaff.InputError, match="returned: expected a number, got .*j"):
        pfaff.Integration("kepler", pfaff.method(order=0, traced=False)(lambda problem, t, h, z: answer(z)), step=0.1).steps(1)


damped = pfaff.system(coordinates=["q", "p"], initial=[1, 0], formula="kinetic", potential=lambda q: q**2 / 2, damping="1/10", name="damped")(lambda p: p**2 / 2)
forced = pfaff.system(coordinates=["q", "p"], initial=[1, 0], applied_force=lambda p: [-p / 10], name="forced")(lambda q, p: p**2 / 2 + q**2 / 2)


def damped_motion(t, rate=0.1):
    """q and p of q'' + rate q' + q = 0 from (1, 0)."""
    w = np.sqrt(1 - rate**2 / 4)
    return np.exp(-rate * t / 2) * np.array([np.cos(w * t) + rate / 2 / w * np.sin(w * t), -np.sin(w * t) / w])


def half_and_half(problem, t, h, z):
    n = problem.size // 2
    q, p = z[:n], z[n:]
    p = np.exp(-problem.damping * h / 2) * p + h / 2 * problem.force(t, q)
    q = q + h * problem.velocity(t + h / 2, p)
    return np.concatenate([q, np.exp(-problem.damping * h / 2) * (p + h / 2 * problem.force(t + h, q))])


def without_damping(problem, t, h, z):
    q, p = z[:1], z[1:]
    p = p + h / 2 * problem.force(t, q)
    q = q + h * problem.velocity(t + h / 2, p)
    return np.concatenate([q, p + h / 2 * problem.force(t + h, q)])


def forces_apart(problem, t, h, z):
    """Half a step of the applied force, one of the energy, and half a step of the force again."""
    def pushed(t, z):
        middle = z + h / 4 * np.concatenate([0 * z[:1], problem.applied_force(t, z)])
        return z + h / 2 * np.concatenate([0 * z[:1], problem.applied_force(t, middle)])

    def rate(t, z):
        return problem.field(t, z) - np.concatenate([0 * z[:1], problem.applied_force(t, z)])

    z = pushed(t, z)
    z = z + h * rate(t + h / 2, z + h / 2 * rate(t, z))
    return pushed(t + h, z)


@pytest.mark.parametrize("traced", [True, False])
@pytest.mark.parametrize("step, needs, system", [(half_and_half, ["conformal"], damped), (forces_apart, ["vector-field"], forced)])
def test_a_step_has_the_parts_of_the_facets_that_it_needs(step, needs, system, traced):
    method = pfaff.method(order=2, needs=needs, traced=traced, name="parts")(step)
    errors = [np.abs(end(system, method, steps, 5 / steps) - damped_motion(5)).max() for steps in (100, 200)]
    # The error of order 2 falls by 4 when the step is halved, to a twentieth of the exponent at these steps.
    assert errors[1] < 2e-3 and abs(np.log2(errors[0] / errors[1]) - 2) < 0.05
    in_quad = pfaff.Integration(system, method, step="1/20", precision="quad")
    in_quad.steps(100)
    assert np.abs(np.array(in_quad.decimals, float) - end(system, method, 100, 0.05)).max() < 1e-13  # a hundred roundings and more
    if step is half_and_half:
        assert pfaff.Integration(system, method, step=0.05).jacobian(20)[1][0, 0] == pytest.approx(end(system, method, 20, 0.05)[0], abs=1e-14)  # linear, from (1, 0)


def test_a_conformal_step_keeps_what_it_claims_and_one_without_friction_does_not():
    sound, unsound = (pfaff.method(order=2, preserves=["conformal"], needs=["conformal"])(step) for step in (half_and_half, without_damping))
    assert pfaff.verify(sound, on="damped-pendulum").ok
    assert {check.claim for check in pfaff.verify(unsound, on="damped-pendulum").failed} >= {"conformal"}


@pytest.mark.parametrize("traced", [True, False])
def test_formulas_that_are_not_there_are_named(traced):
    def stepping(call, needs, system):
        end(system, pfaff.method(order=0, needs=needs, traced=traced, name="asking")(lambda problem, t, h, z: z + 0 * call(problem, t, z)), steps=1)

    for call, needs, system, words in (
        (lambda problem, t, z: problem.applied_force(t, z), ["separable"], duffing, r"problem.applied_force: expected one of vector-field, holonomic, velocity-constraints among"),
        (lambda problem, t, z: problem.applied_force(t, z), ["vector-field"], damped, "system damped has no applied_force"),
        (lambda problem, t, z: problem.damping, ["vector-field"], damped, "problem.damping: expected conformal among"),
        (lambda problem, t, z: problem.reversal(t, z), ["vector-field"], damped, "problem: unknown formula 'reversal'"),
        (lambda problem, t, z: problem.damping, ["conformal"], duffing, "needs conformal"),
    ):
        with pytest.raises(pfaff.InputError, match=words):
            stepping(call, needs, system)
