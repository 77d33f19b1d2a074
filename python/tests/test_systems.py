"""Systems written in Python: they are the systems that their formulas say, and what cannot be recorded is refused."""
import math
import subprocess
import warnings

import numpy as np
import pytest
from definitions import Pendulum, duffing, henon_heiles, oscillator

import pfaff


def end(system, method="gauss", steps=100, step=0.05, **settings):
    it = pfaff.Integration(system, method, step=step, **settings)
    it.steps(steps)
    return it.state


def test_a_function_is_its_twin_in_c_plus_plus():
    # Both round in another order, some units of round-off a step: 1e-14 is a hundred of them.
    state = [0.1, -0.2, 0.3, 0.15]
    for method in ("gauss", "verlet", "rk4"):
        ours, twin = end(henon_heiles, method), end("henon-heiles", method, initial=state)
        assert np.abs(ours - twin).max() < 1e-14
    other = end("henon-heiles", "gauss", initial=[0.1, -0.2, 0.3, 0.1500001])
    assert np.abs(end(henon_heiles, "gauss") - other).max() > 1e-9  # the comparison sees a changed state


def test_the_oscillator_has_its_closed_form():
    # The flow is a rotation; the method of order 8 with h omega = 0.02 is exact to round-off over 100 steps.
    z = end(oscillator, pfaff.Method("gauss", stages=4), step=0.01)
    assert np.abs(z - [math.cos(2), -2 * math.sin(2)]).max() < 1e-14


def test_a_class_and_a_function_agree():
    @pfaff.system(coordinates=["q", "p"], initial=[1, 0])
    def pendulum(q, p, g=9.81):
        return p**2 / 2 - g * np.cos(q)

    assert np.array_equal(end(Pendulum()), end(pendulum))
    assert not np.array_equal(end(Pendulum(g=9.8)), end(pendulum))


def test_an_energy_that_is_a_sum_is_found_to_be_separable():
    assert "separable" in duffing.facets and "separable" in Pendulum().facets

    @pfaff.system(coordinates=["q", "p"], initial=[1, 0])
    def together(q, p):
        return p**2 * (1 + q**2) / 2

    @pfaff.system(coordinates=["q", "p"], initial=[1, 0])
    def scaled(t, q, p):
        return -2 * ((1 - q**2 / 2) / 2 - (p**2 + t * np.sin(q)) / 4) / 3

    assert "separable" not in together.facets and "separable" in scaled.facets
    # H_p = p/3 and -H_q = -q/3 - t cos(q)/6, seen by a step of Verlet's method against one of Euler's.
    h, t0, q, p = 1e-6, 2.0, 0.3, 0.7
    z = end(scaled, "verlet", steps=1, step=h, t0=t0, initial=[q, p])
    rate = (z - [q, p]) / h
    assert np.abs(rate - [p / 3, -q / 3 - t0 * math.cos(q) / 6]).max() < 1e-6  # of the order of h


def test_parameters_are_exact_and_shape_loops():
    @pfaff.system(coordinates={"q": "n", "p": "n"}, initial=lambda n: [1] * n + [0] * n)
    def chain(q, p, n=3, k=0.1):
        return p @ p / 2 + k * sum((q[i + 1] - q[i]) ** 2 for i in range(n - 1)) / 2

    assert chain.dimension == 6 and chain(n=5).dimension == 10 and chain(n=5).coordinates[4] == "q5"
    assert chain(k="1/3").parameters["k"] == "1/3"
    # With k = 1/10 exactly, quad and the exact fraction agree to the last digit, which a double 0.1 does not.
    start = [1, 2, 4, 0, 0, 0]
    exact = pfaff.Integration(chain(k="1/10"), "verlet", step="1/100", initial=start, precision="quad")
    same = pfaff.Integration(chain, "verlet", step="1/100", initial=start, precision="quad")
    binary = pfaff.Integration(chain(k=f"{float.hex(0.1) and 3602879701896397}/36028797018963968"), "verlet", step="1/100", initial=start, precision="quad")
    for it in (exact, same, binary):
        it.steps(50)
    assert exact.decimals == same.decimals and exact.decimals != binary.decimals
    with pytest.raises(pfaff.InputError, match=r"expected a whole number, as its default 3 is, got 2.5 \(the annotation float, or a default 3.0, makes it real\)"):
        chain(n=2.5)


def test_whole_numbers_that_are_annotated_as_float_are_real():
    @pfaff.system(coordinates=["q", "p"], initial=[1, 0], invariants={"scaled": lambda q, k=1: k * q}, behaviours={"scaled": "free"})
    def spring(q, p, k: float = 1, huge: float = 10**17 + 1):
        return p**2 / 2 + k * q**2 / 2 + (huge - 10**17) * q

    class Spring(pfaff.System):
        coordinates, initial = ["q", "p"], [1, 0]
        k: float = -1

        def hamiltonian(self, q, p):
            return p**2 / 2 + self.k * q**2 / 2

    for one in (spring(k=0.25), Spring(k=0.25)):
        assert one.parameters["k"] == "0.25" and 'k" = "0.25' in one.to_toml()
    run = pfaff.run(spring(k=4), "gauss", step=0.01, time=1)
    assert run.sensitivity("k").shape == (2,)

    @pfaff.method(order=1)
    def euler(problem, t, h, z, weight: float = 1):
        return z + weight * h * problem.field(t, z)

    assert euler(weight="1/2").parameters["weight"] == "1/2"


def test_a_system_is_recorded_once_for_each_set_of_parameters_and_not_kept_for_ever():
    calls = []

    @pfaff.system(coordinates=["q", "p"], initial=[1, 0])
    def counted(q, p, k=1.0):
        calls.append(float(k))
        return p**2 / 2 + k * q**2 / 2

    again = counted(k=1.0)
    assert calls == [1, 1] and again.model is counted.model  # twice for the comparison of the two
    for step in range(200):
        counted(k=step / 7)
    assert len(counted._definition._sources) == 64 and len(counted._definition._models) < 5


def test_rows_of_the_library_can_be_written(tmp_path):
    class Top(pfaff.System):
        coordinates = ["x", "y", "z"]
        initial = [0.3, 0.4, 0.5]
        a: float = 1.0
        b: float = 2.0
        c: float = 3.0

        def hamiltonian(self, x, y, z):
            return x**2 / (2 * self.a) + y**2 / (2 * self.b) + z**2 / (2 * self.c)

        def bracket(self, x, y, z):
            return [[0, -z, y], [z, 0, -x], [-y, x, 0]]

        def casimirs(self, x, y, z):
            return [x**2 + y**2 + z**2]

    class Mapped(Top):
        def bracket(self, x, y, z, covector):
            return np.cross([x, y, z], covector)

    class Rates(pfaff.System):
        coordinates = ["x", "y", "z"]
        initial = [0.3, 0.4, 0.5]

        def field(self, x, y, z):
            return [y * z / 3 - z * y / 2, z * x - x * z / 3, x * y / 2 - y * x]

    class Named(pfaff.System):
        coordinates = ["x", "y", "z"]
        initial = [0.3, 0.4, 0.5]
        bracket = "lie-poisson(algebra=so3)"

        def hamiltonian(self, x, y, z):
            return x**2 / 2 + y**2 / 4 + z**2 / 6

    # Euler's equations x' = y z (1/c - 1/b), written out, as rows of the tensor and as a map of covectors. 1e-15 is some units of round-off.
    ends = [end(system(), "rk4", step=0.1) for system in (Top, Mapped, Rates)]
    assert max(np.abs(one - ends[-1]).max() for one in ends) < 1e-15 * 20
    assert end(Named(), "rk4", step=0.1) == pytest.approx(ends[0], abs=1e-13)
    # The Casimir of a bracket that has a name comes with it, also in the text model.
    assert Top().invariants["casimir1"] == Named().invariants["casimir1"] == "conserved"
    assert pfaff.run(Named(), "rk4", step=0.1, time=1).invariants["casimir1"] == pytest.approx(0.5, abs=1e-4)
    (tmp_path / "named.toml").write_text(Named().to_toml())
    assert pfaff.System(str(tmp_path / "named.toml")).invariants == Named().invariants
    square = ends[0] @ ends[0]
    assert abs(square - 0.5) < 1e-4 and square != 0.5  # a Casimir, which rk4 keeps to its order alone


def test_damping_birkhoffian_and_charts():
    @pfaff.system(coordinates=["q", "p"], initial=[1, 0], formula="kinetic", potential=lambda q, nu=0.5: nu**2 * q**2 / 2, damping=lambda nu: 2 * nu)
    def damped(p):
        return p**2 / 2

    # q'' + 2 nu q' + nu^2 q = 0 has q = (1 + nu t) exp(-nu t); gauss of six stages is exact to round-off here.
    z = end(damped, pfaff.Method("gauss", stages=6), steps=20, step=0.1)
    assert np.abs(z - [2 * math.exp(-1), -math.exp(-1) / 2]).max() < 1e-14

    class Birkhoffian(pfaff.System):
        coordinates = ["r", "p"]
        initial = [1, 0.5]
        nu: float = 0.3
        chart_coordinates = ["x", "y"]

        def birkhoffian(self, t, r, p):
            return np.exp(self.nu * t) * (p**2 / 2 + self.nu * r * p / 2 - np.cos(r))

        def one_form(self, t, r, p):
            return [np.exp(self.nu * t) * p / 2, -np.exp(self.nu * t) * r / 2]

        def chart(self, t, r, p):
            return [r, np.exp(self.nu * t) * p]

        def chart_inverse(self, t, x, y):
            return [x, y / np.exp(self.nu * t)]

    twin = end("damped-pendulum", "gauss", initial=[1, 0.5], system_parameters={"nu": 0.3})
    assert "darboux-chart" in Birkhoffian().facets and "birkhoffian" in Birkhoffian().facets
    assert np.abs(end(Birkhoffian(), "gauss") - twin).max() < 1e-13  # both expand exponentials, 100 steps


def test_constraints_metriplectic_exact_solutions_and_parts():
    @pfaff.system(coordinates={"q": 2, "p": 2}, initial=[1, 0, 0, 0], holonomic=lambda q, l=1: {"rod": q @ q - l**2})
    def pendulum(q, p, g: float = 9.81):
        return p @ p / 2 + g * q[1]

    assert pendulum.model.constraint_names == ["rod", "rod~"] and "holonomic" in pendulum.facets
    z = end(pendulum, "rattle", step=0.01)
    assert abs(z[:2] @ z[:2] - 1) < 1e-14 and abs(z[:2] @ z[2:]) < 1e-13

    class Sleigh(pfaff.System):
        coordinates = {"x": 2, "a": 1, "u": 2, "w": 1}
        initial = [0, 0, 0, 1, 0, 0.2]

        def kinetic(self, u, w):
            return (u @ u + w[0] ** 2) / 2

        def potential(self, x):
            return 0 * x[0]

        def velocity_constraints(self, a):
            return {"blade": [-np.sin(a[0]), np.cos(a[0]), 0]}

    # The blade turns at the constant rate 0.2 and slides along itself at the constant speed 1.
    z = end(Sleigh(), pfaff.Method("gauss", stages=4), step=0.05, steps=20)
    assert np.abs(z[3:] - [math.cos(0.2), math.sin(0.2), 0.2]).max() < 1e-14

    class Relaxing(pfaff.System):
        coordinates = ["q", "p"]
        initial = [1, 0]

        def hamiltonian(self, q, p):
            return q**2 / 2 + p**2 / 2

        def symmetric_bracket(self, z):
            return [[0, 0], [0, 1]]

    class Solved(Relaxing):
        symmetric_bracket = None

        def exact_solution(self, elapsed, q, p):
            return [q * np.cos(elapsed) + p * np.sin(elapsed), p * np.cos(elapsed) - q * np.sin(elapsed)]

        part_names = ["turn", "rest"]

        def part_flow(self, part, h, q, p):
            turned = [q * np.cos(h) + p * np.sin(h) - q, p * np.cos(h) - q * np.sin(h) - p]
            return turned if part == 0 else [0, 0]

    assert "metriplectic" in Relaxing().facets and Relaxing().invariants == {"energy": "free"}
    solved = Solved()
    assert {"exact-solution", "exact-flows"} <= set(solved.facets) and "metriplectic" not in solved.facets
    assert pfaff.run(solved, "gauss", stages=4, step=0.1, time=10, reference="exact").error_max < 1e-11


def test_invariants_are_followed_and_quadratic_ones_found():
    @pfaff.system(coordinates={"q": 2, "p": 2}, initial=[1, 0, 0, 0.9], invariants={"turn": lambda q, p: q[0] * p[1] - q[1] * p[0]}, units={"turn": "J s"})
    def centre(q, p):
        return p @ p / 2 - 1 / np.linalg.norm(q)

    marked = {name: quadratic for name, _, _, quadratic in centre.model.invariants}
    assert marked == {"turn": True, "energy": False}
    result = pfaff.run(centre, "verlet", step=0.01, time=10)
    assert np.ptp(result.invariants["turn"]) < 1e-13 < 1e-6 < np.ptp(result.invariants["energy"])


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: pfaff.system(coordinates=["q", "p"])(lambda q, p: [q, p]), "returned 2 results; expected 1"),
        (lambda: pfaff.system(coordinates=["q", "p"])(lambda q, x: q), "unknown argument 'x'; did you mean 'p'"),
        (lambda: pfaff.system(coordinates=["q", "p"])(lambda q, p: None), "returned nothing"),
        (lambda: pfaff.system(coordinates=["q", "p"])(lambda q, p: "q"), "expected numbers"),
        (lambda: pfaff.system(coordinates=["q", "p", "r"])(lambda q, p: q), "even number"),
        (lambda: pfaff.system(coordinates=["p"], formula="kinetic")(lambda p: p), "even number"),
        (lambda: pfaff.system(coordinates=["q", "p"], formula="kinetic")(lambda p: p**2), "kinetic belongs together with potential"),
        (lambda: pfaff.system(coordinates=["q", "q"])(lambda q: q), "each once"),
        (lambda: pfaff.system(coordinates="qp")(lambda q, p: q), "expected names"),
        (lambda: pfaff.system(coordinates=["q", "p"], initial=[1])(lambda q, p: q * p), "expected 2 numbers"),
        (lambda: pfaff.system(coordinates=["q", "p"], holonomc=lambda q: q)(lambda q, p: q), "did you mean 'holonomic'"),
        (lambda: pfaff.system(coordinates=["q", "p"], entropy=lambda q: q)(lambda q, p: q), "symmetric_bracket, which is missing"),
        (lambda: duffing(gamma=1), "unknown parameter 'gamma'"),
        (lambda: duffing(alpha="x"), "expected"),
        (lambda: duffing(alpha=None), "expected a number"),
        (lambda: pfaff.System("keplr"), "did you mean 'kepler'"),
        (lambda: pfaff.System("kepler", excentricity=1), "did you mean 'eccentricity'"),
        (lambda: pfaff.System("gauss"), "is an integrator; expected a system"),
        (lambda: pfaff.System(3), "expected the name"),
    ],
)
def test_bad_input_is_refused_in_a_line(make, words):
    with pytest.raises(pfaff.InputError, match=words) as caught:
        make()
    assert "\n" not in str(caught.value)


def test_a_class_with_a_misspelt_formula_is_refused():
    with pytest.raises(pfaff.InputError, match="did you mean 'potential'"):

        class Wrong(pfaff.System):
            coordinates = ["q", "p"]

            def kinetic(self, p):
                return p**2

            def potental(self, q):
                return q**2


def test_text_models_and_compiled_formulas(tmp_path):
    model = tmp_path / "spring.toml"
    model.write_text('name = "spring"\ntitle = "a spring"\nparameters = { k = 4 }\ncoordinates = ["q", "p"]\ninitial = [1, 0]\nkinetic = "p^2/2"\npotential = "k*q^2/2"\n')
    spring = pfaff.System(model)
    assert np.array_equal(end(spring), end(oscillator))  # k = omega^2 in the same operations
    assert not np.array_equal(end(spring(k=5)), end(oscillator))
    if subprocess.run(["c++", "--version"], capture_output=True).returncode == 0:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            compiled = henon_heiles(compile=True)
        # Compiled formulas have the operations of the tape in their order.
        assert np.array_equal(end(compiled, "verlet"), end(henon_heiles, "verlet"))


def test_of_what_is_no_invariant_a_run_warns():
    def spring(q, p):
        return p**2 / 2 + q**2 / 2

    false = {"coordinates": ["q", "p"], "initial": [1, 0.3], "invariants": {"product": lambda q, p: q * p}}
    with pytest.warns(pfaff.InvariantWarning, match="system spring: product is said to be conserved, but the motion changes it") as seen:
        assert "product" in pfaff.run(pfaff.system(**false)(spring), "verlet", step=0.1, time=1).drift
    assert seen[0].filename == __file__
    run = pfaff.run(pfaff.system(**false, behaviours={"product": "free"})(spring), "verlet", step=0.1, time=1)
    assert list(run.drift) == ["energy"] and run.invariants["product"][0] == 0.3
