"""to_toml(): the text model of a system in Python gives the same numbers, and its parameters stay parameters."""
import pathlib

import numpy as np
import pytest
from definitions import Pendulum, duffing, henon_heiles

import pfaff


def end(system, method, step=0.05, steps=40):
    it = pfaff.Integration(system, method, step=step)
    it.steps(steps)
    return it.state


def as_text(system, folder):
    path = folder / f"{system.name}.toml"
    path.write_text(system.to_toml())
    return pfaff.System(path)


class Everything(pfaff.System):
    """Constraints of positions, friction, invariants of all behaviours."""

    coordinates = {"q": 2, "p": 2}
    initial = [1, 0, 0, 0.5]
    units = {"q": "m", "spin": "J s"}
    behaviours = {"height": "free"}
    g: float = 9.81
    n: int = 2

    def kinetic(self, p):
        return p @ p / 2

    def potential(self, t, q):
        return self.g * q[1] + pfaff.where(q[0], q[0] ** 3, 0) * np.sin(t) / 10 + sum(q[k] ** 4 for k in range(self.n))

    def holonomic(self, q):
        return {"rod": q @ q - 1}

    def invariants(self, q, p):
        return {"spin": q[0] * p[1] - q[1] * p[0], "height": q[1]}

    behaviours = {"height": "free", "spin": "free"}


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


class Top(pfaff.System):
    coordinates = ["x", "y", "z"]
    initial = [0.3, 0.4, 0.5]
    a: float = 2.0

    def hamiltonian(self, x, y, z):
        return x**2 / 2 + y**2 / (2 * self.a) + z**2 / 6

    def bracket(self, x, y, z):
        return [[0, -z, y], [z, 0, -x], [-y, x, 0]]

    def casimirs(self, x, y, z):
        return [x**2 + y**2 + z**2]


class Sleigh(pfaff.System):
    coordinates = {"x": 2, "a": 1, "u": 2, "w": 1}
    initial = [0, 0, 0, 1, 0, 0.2]
    mass: float = 2.0

    def kinetic(self, u, w):
        return (u @ u + w[0] ** 2) / (2 * self.mass)

    def potential(self, x):
        return x[1] / 10

    def velocity_constraints(self, a):
        return {"blade": [-np.sin(a[0]), np.cos(a[0]), 0]}

    def velocity_offsets(self, t, a):
        return [0 * t]


class Damped(pfaff.System):
    coordinates = ["q", "p"]
    initial = [1, 0]
    nu: float = 0.5

    def kinetic(self, p):
        return p**2 / 2

    def potential(self, q):
        return self.nu**2 * q**2 / 2

    def damping(self):
        return 2 * self.nu

    def exact_solution(self, elapsed, q, p):
        growth = np.exp(-self.nu * elapsed)
        return [growth * (q + (p + self.nu * q) * elapsed), growth * (p - self.nu * (p + self.nu * q) * elapsed)]


class Alpha(pfaff.System):
    """The damped pendulum with a transformation alpha of pairs of states, as examples/models/damped-pendulum.toml has it."""

    coordinates = ["r", "p"]
    initial = [1, 0.5]
    nu: float = 0.3

    def birkhoffian(self, t, r, p):
        return np.exp(self.nu * t) * (p**2 / 2 + self.nu * r * p / 2 - np.cos(r))

    def one_form(self, t, r, p):
        return [np.exp(self.nu * t) * p / 2, -np.exp(self.nu * t) * r / 2]

    def alpha(self, t, t0, new_z, old_z, new_r, old_p):
        growth, before = np.exp(self.nu * t), np.exp(self.nu * t0)
        rise, turn = growth * new_z[1] - before * old_p, new_r - old_z[0]
        return [[rise, turn], [(new_r + old_z[0] + turn**2) / 2, rise * turn - (growth * new_z[1] + before * old_p) / 2]]


CASES = [
    (Alpha(), "nu", "generating-function-alpha"),
    (duffing, "alpha", "verlet"),
    (Pendulum(), "g", "gauss"),
    (Everything(), "g", "rattle"),
    (Birkhoffian(), "nu", "generating-function"),
    (Top(), "a", "gauss"),
    (Sleigh(), "mass", "gauss"),
    (Damped(), "nu", "gauss"),
]


@pytest.mark.parametrize("system, parameter, method", CASES, ids=lambda x: getattr(x, "name", str(x)))
def test_a_text_model_has_the_numbers_of_its_system(system, parameter, method, tmp_path):
    text = as_text(system, tmp_path)
    assert text.coordinates == system.coordinates and text.facets == system.facets and text.invariants == system.invariants
    for changes in ({}, {parameter: 0.7}):
        ours, other = end(system(**changes), method), end(text(**changes), method)
        # The operations are the same in number and order but for what constants fold to; a few roundings a step.
        assert np.abs(ours - other).max() < 1e-14, changes
    assert np.abs(end(system, method) - end(text(**{parameter: 0.7}), method)).max() > 1e-6  # the parameter is one


def test_parts_and_separable_energies(tmp_path):
    class Parts(pfaff.System):
        coordinates = ["q", "p"]
        initial = [1, 0.5]
        k: float = 2.0
        part_names = ["drift", "kick"]
        small_part = 1

        def hamiltonian(self, q, p):
            return p**2 / 2 + self.k * q**4 / 4

        def part_flow(self, part, h, q, p):
            return [h * p, 0] if part == 0 else [0, -h * self.k * q**3]

    text = as_text(Parts(), tmp_path)
    assert "separable" in text.facets and "exact-flows" in text.facets and "kinetic" in Parts().to_toml()
    ours, other = end(Parts(), "verlet"), end(text, "verlet")
    assert np.abs(ours - other).max() < 1e-14
    assert np.abs(end(henon_heiles, "verlet") - end(as_text(henon_heiles, tmp_path), "verlet")).max() < 1e-14


def test_an_alpha_is_that_of_the_text_model():
    path = pathlib.Path(__file__).resolve().parents[2] / "examples" / "models" / "damped-pendulum.toml"
    method = pfaff.Method("generating-function-alpha")
    ours, other = end(Alpha(), method, steps=10), end(pfaff.System(path), method, steps=10)
    assert np.abs(ours - other).max() < 1e-13 and "generating-map" in Alpha().facets


def test_what_has_no_text_is_refused():
    with pytest.raises(pfaff.InputError, match="no formulas in Python"):
        pfaff.System("kepler").to_toml()

    @pfaff.system(coordinates={"q": 2, "p": 2})
    def solving(q, p):
        return p @ pfaff.solve([[2 + q[0] ** 2, 1], [1, 3]], p)

    with pytest.raises(pfaff.InputError, match="without it"):
        solving.to_toml()
