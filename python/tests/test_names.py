"""Names that mean two things: parameters that are called as the time, coordinates, halves of the state, or members are."""
import numpy as np
import pytest

import pfaff


def test_an_argument_with_a_default_is_a_parameter_also_where_a_half_could_be_called_so():
    charged = pfaff.system(coordinates=["x", "v"])(lambda x, v, q=3.0, p=2.0, z=0.5: p * v**2 / 2 + q * z * x**2)
    assert charged.parameters == {"q": "3.0", "p": "2.0", "z": "0.5"}
    assert np.array_equal(pfaff.evaluate(charged, [2, 1])["rhs"], [2, -6])
    # Another formula of the same system may take the halves, which it writes without defaults.
    with_force = pfaff.system(coordinates=["x", "v"], formula="kinetic", potential=lambda q, k=3.0: k * q[0] ** 2 / 2)(lambda p: p[0] ** 2 / 2)
    assert np.array_equal(pfaff.evaluate(with_force, [2, 1])["rhs"], [1, -6])


@pytest.mark.parametrize("formula, words", [
    (lambda q, p, t=0: p**2 / 2 + t * q, "parameter 't': formulas call the time so; expected another name, or the argument t without a default"),
    (lambda q, p=1.0: q * p, "parameter 'p': formulas call a coordinate so"),
    (lambda q, p, compile=1.0: q * p * compile, "parameter 'compile': expected another name"),
])
def test_parameters_that_formulas_could_not_tell_are_refused(formula, words):
    with pytest.raises(pfaff.InputError, match=words):
        pfaff.system(coordinates=["q", "p"])(formula)


@pytest.mark.parametrize("member, words", [
    ({"name": "spring"}, "Spring: name: a system has this itself; expected system_name"),
    ({"dimension": 3.0, "__annotations__": {"dimension": float}}, "Spring: dimension: a system has this itself; expected another name"),
])
def test_a_class_does_not_write_over_what_a_system_has(member, words):
    with pytest.raises(pfaff.InputError, match=words):
        type("Spring", (pfaff.System,), {"coordinates": ["q", "p"], "hamiltonian": lambda self, q, p: p**2 / 2 + q**2 / 2, **member})


def test_a_method_has_no_order_where_it_cannot_step():
    for claims in (pfaff.Method("lincs").order, pfaff.Method("lincs").preserves, pfaff.Method("verlet").order):
        with pytest.raises(pfaff.InputError, match="(lincs needs|verlet needs)"):
            claims("free-rigid-body")
    with pytest.raises(pfaff.InputError, match="lincs needs"):
        pfaff.solve_ivp(lambda t, y: [y[1], -y[0]], (0, 1), [1, 0], "lincs")
    assert pfaff.Method("gauss").order("spherical-pendulum") == 4  # on the motion that its formulation makes


@pytest.mark.parametrize("name, kebab", [("<lambda>", "lambda"), ("a__b", "a-b"), ("_2d", "d"), ("größe", "groe"), ("ψ", "unnamed"), ("MySystem2", "my-system2")])
def test_names_of_functions_are_names_of_text_models(name, kebab, tmp_path):
    def formula(q, p):
        return p**2 / 2 + q**2 / 2

    formula.__name__ = name
    for system in (pfaff.system(coordinates=["q", "p"], initial=[1, 0])(formula), pfaff.system(coordinates=["q", "p"], initial=[1, 0], name=name)(formula)):
        (tmp_path / "model.toml").write_text(system.to_toml())
        assert pfaff.System(tmp_path / "model.toml").name == kebab
