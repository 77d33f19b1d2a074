"""Evaluation, brackets, derivation and reproduction, against closed forms."""
import numpy as np
import pytest

import pfaff


def test_a_pendulum_at_a_state():
    at = pfaff.evaluate("pendulum", [1, 0.5])
    parameters = pfaff.System("pendulum").parameters
    assert at["status"] == "converged" and at["coordinates"] == ["q", "p"]
    # q' = p and p' = -sin q with the parameters' defaults, to round-off
    assert np.allclose(at["rhs"], [0.5, -np.sin(1)], rtol=0, atol=1e-15), parameters
    assert "rhs" in repr(at) and "<td>rhs</td>" in at._repr_html_()


def test_quad_has_all_digits_and_a_system_of_python_is_evaluated():
    @pfaff.system(coordinates=["q", "p"], initial=[1, 0])
    def well(q, p):
        return p**2 / 2 + q**4 / 4

    at = pfaff.evaluate(well, ["1/3", 0], precision="quad")
    # -(1/3)^3 = -1/27
    assert at["rhs"][1].startswith("-0.037037037037037037037037037037037")


def test_constraints_have_a_dirac_bracket_that_is_skew():
    tensor = pfaff.evaluate("spherical-pendulum")["dirac_bracket"]
    assert tensor.shape == (6, 6) and np.abs(tensor).max() > 0.1
    assert np.abs(tensor + tensor.T).max() < 1e-15  # sums of the same products in the other order


def test_brackets_of_functions_are_dirac_s_where_there_are_constraints():
    z = [0.6, 0.0, -0.8, 0.4, 0.9, 0.3]  # on the unit sphere, with p along it
    of = lambda f, g: pfaff.bracket(f, g, z, on="spherical-pendulum")  # noqa: E731
    assert of(lambda x: x, lambda p_x: p_x) == pytest.approx(1 - 0.6**2, abs=1e-15)
    assert of(lambda p_x: p_x, lambda p_y: p_y) == pytest.approx(0 * 0.4 - 0.6 * 0.9, abs=1e-15)  # y p_x - x p_y


def test_brackets_of_functions_are_nonholonomic_where_velocities_are_constrained():
    class Skate(pfaff.System):
        coordinates = {"q": 3, "p": 3}
        initial = [0.1, 0.5, 0, 0.6, 0.4, 0.3]  # p[2] = q[1] p[0]

        def kinetic(self, p):
            return p @ p / 2

        def potential(self, q):
            return q @ q / 2

        def velocity_constraints(self, q):
            return {"c": [-q[1], 0, 1]}

    z = [0.1, 0.5, 0, 0.6, 0.4, 0.3]
    normal = np.array([-0.5, 0, 1]) / np.sqrt(1.25)
    assert pfaff.bracket(lambda q: q[0], lambda p: p[0], z, on=Skate()) == pytest.approx(1 - normal[0] ** 2, abs=1e-15)
    force = np.array([-0.1, -0.5, 0])  # and the reaction, for which p[2]' = q[1]' p[0] + q[1] p[0]'
    along = force - normal * (force @ normal - 0.4 * 0.6 / np.sqrt(1.25))
    for k in range(3):
        rate = pfaff.bracket(lambda p, k=k: p[k], lambda q, p: (p @ p + q @ q) / 2, z, on=Skate())
        assert rate == pytest.approx(along[k], abs=1e-15)


def test_a_field_alone_has_no_bracket():
    class Decay(pfaff.System):
        coordinates = ["x"]
        initial = [1]

        def field(self, x):
            return [-x]

    with pytest.raises(pfaff.InputError, match="decay states a field alone"):
        pfaff.bracket(lambda x: x, lambda x: x, [1], on=Decay())


def test_first_class_constraints_have_no_bracket():
    class Held(pfaff.System):
        coordinates = {"q": 2, "p": 2}
        initial = [0.5, 0.2, 0, 0]

        def hamiltonian(self, p):
            return p @ p / 2

        def constraints(self, q):
            return {"phi1": q[0] - 0.5, "phi2": q[1] - 0.2}

    with pytest.raises(pfaff.InputError, match="no finite value there; .* first-class"):
        pfaff.bracket(lambda q1: q1, lambda p1: p1, [0.5, 0.2, 0, 0], on=Held())


def test_brackets_of_functions():
    z = [0.3, 0.4, 0.5, 0.6]
    # {q1 p2 - q2 p1, q1} = q2 and {H, q1} = -p1, by hand
    spin = lambda q1, q2, p1, p2: q1 * p2 - q2 * p1  # noqa: E731
    assert pfaff.bracket(spin, lambda q1: q1, z, on="henon-heiles") == pytest.approx(z[1], abs=1e-15)
    assert pfaff.bracket(lambda z: z[2] ** 2 / 2, lambda q1: q1, z, on="henon-heiles") == pytest.approx(-0.5, abs=1e-15)
    # the structure of so(3)*, {x, y} = -z or z by its convention, and it depends on the state
    body = "free-rigid-body"
    names = pfaff.System(body).coordinates
    value = pfaff.bracket(lambda z: z[0], lambda z: z[1], [0.1, 0.2, 0.3], on=body)
    assert len(names) == 3 and abs(value) == pytest.approx(0.3, abs=1e-16)
    assert pfaff.bracket(lambda z: z @ z, lambda z: z[1], [0.1, 0.2, 0.3], on=body) == pytest.approx(0, abs=1e-16)  # a Casimir


def test_a_constraint_is_a_casimir_of_the_dirac_bracket():
    system = pfaff.System("spherical-pendulum")
    at = pfaff.bracket(lambda x, y, z: x**2 + y**2 + z**2, lambda p_x, y: p_x * y, system.initial, on=system)
    assert abs(at) < 1e-14  # round-off of numbers of the size of 1
    free = pfaff.bracket(lambda x, y, z: y, lambda p_y: p_y, system.initial, on=system)
    assert abs(free) > 0.1  # a pair that is canonical but for the constraint


@pytest.mark.parametrize("call, words", [
    (lambda: pfaff.evaluate("pendulum", [1]), "state: expected shape (2,), a number for each of q, p, got 1 number"),
    (lambda: pfaff.evaluate("pendulun"), "did you mean 'pendulum'?"),
    (lambda: pfaff.evaluate("pendulum", precision="single"), "double"),
    (lambda: pfaff.evaluate("pendulum")["rsh"], "did you mean 'rhs'?"),
    (lambda: pfaff.bracket(lambda q: q, lambda p: p, [1, 2, 3], on="pendulum"), "expected shape (2,)"),
    (lambda: pfaff.bracket(lambda q: [q, q], lambda p: p, [1, 2], on="pendulum"), "expected a function that returns one number"),
    (lambda: pfaff.bracket(lambda x: x, lambda p: p, [1, 2], on="pendulum"), "argument 'x'"),
    (lambda: pfaff.derive("pendulum", "ldll"), "did you mean 'ldl'?"),
    (lambda: pfaff.derive("spherical-pendulum", "ldl", **{"friction-form": "none"}), "expected friction_form="),
    (lambda: pfaff.derive("damped-oscillator", "birkhoffian").text("cp"), "did you mean 'cpp'?"),
    (lambda: pfaff.derive("spherical-pendulum", friction_form="stoke"), "did you mean 'stokes'?"),
    (lambda: pfaff.reproduce("su-quin"), "did you mean 'su-qin'?"),
    (lambda: pfaff.reproduce("su-qin", "99"), "99"),
])
def test_bad_input_is_refused_in_one_line(call, words):
    with pytest.raises(pfaff.InputError) as refused:
        call()
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_derived_equations_are_those_that_are_evaluated():
    sympy = pytest.importorskip("sympy")
    equations = pfaff.derive("spherical-pendulum")
    rates = equations.to_sympy()
    state = pfaff.System("spherical-pendulum").initial
    values = {sympy.Symbol(name): value for name, value in zip(equations.coordinates, state)}
    values |= {sympy.Symbol(name): sympy.Rational(value) for name, value in equations.parameters.items()}
    numbers = [float(rates[name].subs(values)) for name in equations.coordinates]
    assert np.allclose(numbers, pfaff.evaluate("spherical-pendulum")["rhs"], rtol=0, atol=1e-13)
    assert "gravity" in equations.parameters and equations.operations > 10
    assert "rates" in equations.text("sympy") and "<pre>" in equations._repr_html_()


def test_equations_of_a_system_of_python_have_its_parameters():
    sympy = pytest.importorskip("sympy")

    @pfaff.system(coordinates={"q": 2, "p": 2}, initial=[1, 0, 0, 0], holonomic=lambda q: q @ q - 1)
    def swing(q, p, g: float = 2):
        return p @ p / 2 + g * q[1]

    equations = pfaff.derive(swing, "lmm")
    rates = equations.to_sympy()
    q1, q2, p1, p2 = map(sympy.Symbol, equations.coordinates)
    # On the circle: p' = -g e2 - (p.p - g q2) q, by hand
    point = {q1: sympy.Rational(3, 5), q2: sympy.Rational(4, 5), p1: sympy.Rational(4, 5), p2: sympy.Rational(-3, 5)}
    assert equations.parameters == {"g": "2"} and list(equations.to_pandas()["rate"]) == list(rates.values())
    second = list(rates.values())[3].subs(point).subs(sympy.Symbol("g"), 2)
    assert second == -2 - (1 - 2 * sympy.Rational(4, 5)) * sympy.Rational(4, 5)


def test_equations_are_derived_by_a_method_that_fits():
    for system, method in (("kepler", "birkhoffian"), ("spherical-pendulum", "ldl"), (pfaff.System("kepler"), "birkhoffian"), ("sleigh", "nonholonomic")):
        equations = pfaff.derive(system)
        assert equations.method == method and len(equations.coordinates) == pfaff.System(system if isinstance(system, str) else "kepler").dimension


def test_a_paper_is_reproduced():
    rows = pfaff.reproduce("su-qin", "2")
    assert rows.ok and rows.counts.get("failed", 0) == 0 and rows.counts["erratum"] > 0
    assert "su-qin" in pfaff.papers() and "erratum" in repr(rows) and "<table>" in rows._repr_html_()
    pytest.importorskip("pandas")
    assert len(rows.to_pandas()) == len(rows)


def test_what_is_not_finite_is_nan_in_an_array():
    at = pfaff.evaluate("kepler", [0, 0, 1, 2])
    assert at["status"] == "non_finite" and np.array_equal(at["rhs"], [1, 2, np.nan, np.nan], equal_nan=True)


def test_brackets_take_functions_as_systems_take_formulas():
    assert pfaff.bracket(lambda q: q[1], lambda p: p @ p, [1, 2, 3, 4], on="kepler") == 8
    plane = pfaff.system(coordinates={"x": 2, "u": 2})(lambda x, u: u @ u / 2 + x @ x)
    assert pfaff.bracket(lambda x: x @ x, lambda u, u2: u[0] + u2, [1, 2, 3, 4], on=plane) == 6
