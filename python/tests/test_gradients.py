"""Gradients of runs with respect to their start and to parameters."""
import math
import warnings

import numpy as np
import pytest
from definitions import oscillator

import pfaff


def test_gradients_have_their_closed_form():
    result = pfaff.run(oscillator, pfaff.Method("gauss", stages=6), step=0.02, time=1)
    w, t = 2, 1
    c, s = math.cos(w * t), math.sin(w * t)
    # Of the flow; the method of order 12 is exact to round-off here.
    assert np.abs(result.jacobian - [[c, s / w], [-w * s, c]]).max() < 1e-13

    @pfaff.system(coordinates=["q", "p"], initial=[1, 0])
    def real(q, p, omega=2.0):
        return p**2 / 2 + omega**2 * q**2 / 2

    result = pfaff.run(real, pfaff.Method("gauss", stages=6), step=0.02, time=1)
    assert np.abs(result.sensitivity("omega") - [-t * s, -s - w * t * c]).max() < 1e-13
    other = pfaff.run(real, "verlet", step=0.1, time=1)
    assert np.abs(other.sensitivity("omega") - [-t * s, -s - w * t * c]).max() > 1e-4  # of the map, not of the flow
    with pytest.raises(pfaff.InputError, match="did you mean 'omega'"):
        result.sensitivity("omga")


def difference(of, h):
    """The derivative of of(x) at 0, by a central difference."""
    return (of(h) - of(-h)) / (2 * h)


ON_A_SPHERE = {"project_initial": {"initial": [0.6, 0, -0.7, 0.4, 0.1, 0], "project_initial": True}, "own": {}}


def test_gradients_move_the_start_along():
    def kepler(e, **settings):
        return pfaff.run("kepler", "gauss", stages=3, eccentricity=e, step=0.05, time=5, **settings)

    # The truncation of a difference is its step squared times a sixth of the third derivative, here below 5; its rounding 1e-16 over the step.
    total = kepler("0.3").sensitivity("eccentricity")
    assert np.abs(total - difference(lambda h: kepler(0.3 + h).y[-1], 1e-5)).max() < 2e-9 and np.abs(total).min() > 0.1
    # The range of the eccentricity begins at 0: a difference to one side, as good.
    edge = kepler(0).sensitivity("eccentricity")
    apart = [kepler(k * 1e-5).y[-1] for k in range(3)]
    assert np.abs(edge - (4 * apart[1] - 3 * apart[0] - apart[2]) / 2e-5).max() < 2e-9
    # A state that was given stays, and the field does not depend on the eccentricity.
    assert not kepler(0.3, initial=[1, 0, 0, 1]).sensitivity("eccentricity").any()

    @pfaff.system(coordinates=["q", "p"], initial=[0.5, 0])
    def heavy(q, p, mass=4.0):
        return p**2 / (2 * mass) + q**2 / 2

    def thrown(mass):
        return pfaff.run(heavy(mass=mass), pfaff.Method("gauss", stages=6), step=0.02, time=1, initial=[1], initial_velocities=[0.25])

    # q = cos t/2 + sin(t/2)/2 for w = 1/sqrt(m) = 1/2: by hand, q = cos w t + v/w sin w t, and w' = -w/(2 m)
    w, v, t, m = 0.5, 0.25, 1, 4
    of_w = -t * math.sin(w * t) + v * (t * math.cos(w * t) / w - math.sin(w * t) / w**2)
    assert abs(thrown("4").sensitivity("mass")[0] + of_w * w / (2 * m)) < 1e-13


@pytest.mark.parametrize("start", ON_A_SPHERE)
@pytest.mark.parametrize("method, formulation", [("rattle", None), ("rk4", "lmm")])
def test_gradients_keep_the_start_on_the_constraints(method, formulation, start):
    def swing(length):
        return pfaff.run("spherical-pendulum", method, formulation=formulation, length=length, step=0.01, time=1, **ON_A_SPHERE[start])

    total = swing(1).sensitivity("length")
    assert np.abs(total - difference(lambda h: swing(1 + h).y[-1], 1e-5)).max() < 1e-9 and np.abs(total).max() > 1


def test_gradients_that_do_not_exist_are_refused_in_one_line():
    swing = pfaff.run("spherical-pendulum", "rattle", step=0.01, time=0.1, initial=[0.6, 0, -0.8, 0.4, 0.5, 0.3])
    chain = pfaff.run("n-pendulum", "rattle", bobs=2, step=0.01, time=0.1)
    chosen = pfaff.run("kepler", "taylor", tolerance=1e-9, time=1)
    for run, parameter, words in ((swing, "length", "another 'length' does not fit: initial state of spherical-pendulum: constraint rod is off"),
                                  (chain, "bobs", "no small change of 'bobs' makes a system: .* expected an integer"), (chosen, "eccentricity", "steps of one size"),
                                  (pfaff.run("n-pendulum-angles", "gauss", step=0.01, time=0.1), 3, "parameter: expected a name, such as")):
        with pytest.raises(pfaff.InputError, match=words) as refused:
            run.sensitivity(parameter)
        assert "\n" not in str(refused.value)


def test_gradients_of_runs_whose_times_are_expressions():
    late, never = (pfaff.run("driven-duffing", "gauss", step="pi/100", time="pi/10", t0=t0).jacobian for t0 in ("pi/3", math.pi / 3))
    assert np.abs(late - never).max() < 1e-13 and np.abs(late - np.eye(len(late))).max() > 0.01


def jumping(t, c):
    return [pfaff.where(t - c, 1, 0)]


def test_derivatives_of_what_may_jump_come_with_a_warning():
    switched = pfaff.system(coordinates=["q", "p"], initial=[1, 0], applied_force=jumping, name="switched")(lambda q, p, c=1.2345: p**2 / 2 + q**2 / 2)
    run = pfaff.run(switched, "rk4", step=0.1, time=2)
    for ask in (lambda: run.jacobian, lambda: run.sensitivity("c"), lambda: pfaff.Integration(switched, "rk4", step=0.1).jacobian(3)):
        with pytest.warns(pfaff.JumpWarning, match="the formulas of switched have branches") as warned:
            ask()
        assert len(warned) == 1 and warned[0].filename == __file__
    # Branches that nothing but a parameter chooses are passed by no motion.
    chosen = pfaff.system(coordinates=["q", "p"], initial=[1, 0], name="chosen")(lambda q, p, k=2: p**2 / 2 + pfaff.where(k - 1, k, 1) * q**2 / 2)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for system in (chosen, "kepler", "pendulum"):
            assert pfaff.run(system, "rk4", step=0.1, time=0.5).jacobian.shape[0] >= 2
