"""Verification and falsification: of names and of objects, true and false."""
import math
import re
import signal
import threading
import time

import numpy as np
import pytest

import pfaff


@pytest.fixture
def pendulum():
    @pfaff.system(coordinates=["q", "p"], initial=[0.5, 0.2])
    def swing(q, p):
        return p**2 / 2 - np.cos(q)

    return swing


@pfaff.method(order=2, needs=["vector-field"])
def heun(problem, t, h, z):
    k = problem.field(t, z)
    return z + h / 2 * (k + problem.field(t + h, z + h * k))


@pfaff.method(order=2, preserves=["symplectic"], needs=["vector-field"])
def false_heun(problem, t, h, z):
    k = problem.field(t, z)
    return z + h / 2 * (k + problem.field(t + h, z + h * k))


def test_a_sound_method_is_found_sound_and_says_so():
    checks = pfaff.verify("verlet", on="henon-heiles")
    assert checks.ok and bool(checks) and checks.failed == ()
    order = next(check for check in checks if check.claim == "order")
    assert order.expected == 2 and abs(order.measured - 2) < 0.05  # the slope settles to a hundredth
    assert checks.verdict.startswith("ok: ") and checks.verdict in repr(checks) and checks.verdict in checks._repr_html_()


def test_names_are_verified_as_by_the_program():
    checks = pfaff.verify("verlet")
    assert checks.ok and any(check.control and check.result == "rejected" for check in checks)
    assert {check.precision for check in checks} >= {"double", "quad"}


def test_coefficients_of_a_table_are_controlled():
    ralston = pfaff.table({"kind": "runge-kutta", "name": "ralston", "order": 2, "a": [[], ["2/3"]], "b": ["1/4", "3/4"]})
    checks = pfaff.verify(ralston)
    assert checks.ok and [check.result for check in checks if check.control] == ["rejected"] * 2  # the two weights


def test_a_claim_in_whose_scope_no_system_is_fails():
    @pfaff.method(order=2, preserves=["symplectic", "entropy"], needs=["separable"])
    def kick(problem, t, h, z):
        q, p = np.split(z, 2)
        p = p + h / 2 * problem.force(t, q)
        q = q + h * problem.velocity(t + h / 2, p)
        return np.concatenate([q, p + h / 2 * problem.force(t + h, q)])

    failed = pfaff.verify(kick).failed
    assert {check.claim for check in failed} == {"entropy"} and all("judged on no system" in check.reason for check in failed)


def test_a_method_of_python_is_verified_on_a_system_of_python(pendulum):
    checks = pfaff.verify(heun, on=pendulum)
    assert checks.ok and {check.system for check in checks} == {"swing"}


def test_a_false_claim_fails(pendulum):
    checks = pfaff.verify(false_heun, on=[pendulum, "henon-heiles"])
    assert not checks.ok and not bool(checks)
    assert {check.claim.removesuffix(" along a run").removesuffix(" in a large step") for check in checks.failed} == {"symplectic"}
    assert checks.verdict.startswith("NOT OK") and '#b3261e' in checks._repr_html_()


def test_without_systems_a_method_is_tried_on_all_that_it_fits_and_on_random_ones():
    checks = pfaff.verify(false_heun)
    systems = {check.system for check in checks}
    assert not checks.ok and "kepler" in systems and any(system.startswith("random") for system in systems)


def test_a_system_of_python_is_verified_itself(pendulum):
    assert pfaff.verify(pendulum).ok

    @pfaff.system(coordinates=["q", "p"], initial=[0.5, 0.2], invariants={"energy": lambda q, p: p**2 / 2 + q**4})
    def wrong(q, p):
        return p**2 / 2 - np.cos(q)

    assert "conserves energy" in {check.claim for check in pfaff.verify(wrong).failed}


def test_checks_become_a_data_frame():
    pandas = pytest.importorskip("pandas")
    checks = pfaff.verify("verlet", on="pendulum")
    frame = checks.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and len(frame) == len(checks)
    assert list(frame["claim"]) == [check.claim for check in checks] and frame["good"].all()


@pytest.mark.parametrize("call, words", [
    (lambda: pfaff.verify("verlt"), "unknown name 'verlt'; did you mean 'verlet'?"),
    (lambda: pfaff.verify("verlet", on="damped-pendulum"), "verlet needs"),
    (lambda: pfaff.verify(on="kepler"), "expected a method"),
    (lambda: pfaff.verify("gauss", "verlet", on="kepler", stages=2), "alone"),
    (lambda: pfaff.falsify("verlet", "symplectc"), "did you mean 'symplectic'?"),
    (lambda: pfaff.falsify("verlet", budget=0), "budget: expected a time above 0 s"),
])
def test_bad_input_is_refused_in_one_line(call, words):
    with pytest.raises(pfaff.InputError) as refused:
        call()
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_a_counterexample_is_small_and_shows_the_failure(tmp_path):
    found = pfaff.falsify("rk4", "symplectic", systems=5)
    assert not found.ok and found[0].result == "falsified" and not found[0].claimed
    example = found[0].counterexample
    # rk4 leaves a residual of the order h^5 or so, which halving makes 2^5 times smaller at least.
    assert example.dimension <= 2 and example.exponent > 4.5
    path = tmp_path / f"{example.name}.toml"
    path.write_text(example.model)
    again = pfaff.verify(pfaff.Method("rk4"), on=str(path))
    residual = next(check for check in again if check.claim == "symplectic" and check.precision == "double")
    assert residual.measured > 1e-12 and residual.result == "measured"
    assert "falsified" in repr(found) and "<table>" in found._repr_html_()


def test_a_true_claim_holds_and_a_false_one_of_an_object_does_not():
    held = pfaff.falsify("verlet", "symplectic", systems=5)
    assert held.ok and all(one.tried > 0 and one.result == "held" for one in held)
    false = pfaff.falsify(false_heun, systems=5)
    assert [(one.claim, one.claimed) for one in false.failed] == [("symplectic", True)]
    assert math.isfinite(false.failed[0].counterexample.residuals[0])


def test_an_interruption_comes_soon():
    main = threading.main_thread().ident
    sent = []

    def interrupt():
        sent.append(time.monotonic())
        signal.pthread_kill(main, signal.SIGINT)

    timer = threading.Timer(1, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt) as stopped:
        pfaff.verify("gauss", full=True)
    late = time.monotonic() - sent[0]
    assert isinstance(stopped.value, pfaff.Interrupted)
    made = stopped.value.run
    assert not made.ok and made.verdict == str(stopped.value) and re.fullmatch(r"interrupted: .* groups? of checks were made", made.verdict)
    assert late < 0.5  # .1 s on an idle machine; tests share theirs


def test_a_method_is_not_blamed_for_a_system_that_is_wrong(tmp_path):
    """The stated reversal is none, so that no method is reversible under it."""
    file = tmp_path / "turned.toml"
    file.write_text('name = "turned"\ncoordinates = ["q", "p"]\ninitial = [0.5, 0.3]\nkinetic = "p^2/2"\npotential = "q^4/4"\n'
                    'reversal = ["q", "p"]\n', encoding="utf-8")
    checks = pfaff.verify("verlet", on=str(file))
    assert not checks.ok
    assert {check.plugin for check in checks.failed} == {"turned"}


def conformal_splitting(kick_at_end):
    """A splitting for friction whose second kick is at the end of the step, or at its start, as if the force had no time."""
    @pfaff.method(order=2, preserves=["conformal"], needs=["conformal", "vector-field"], name=f"kick-at-{kick_at_end}")
    def split(problem, t, h, z):
        n = problem.size // 2
        q, p = z[:n], z[n:]
        none = 0 * p

        def force(t, q):
            return problem.field(t, np.concatenate([q, none]))[n:]

        rate = force(t, q)[0] - problem.field(t, np.concatenate([q, none + 1]))[n]
        p = p * np.exp(-rate * h / 2) + h / 2 * force(t, q)
        q = q + h * problem.field(t + h / 2, np.concatenate([q, p]))[:n]
        return np.concatenate([q, (p + h / 2 * force(t + kick_at_end * h, q)) * np.exp(-rate * h / 2)])

    return split


def test_a_splitting_that_forgets_the_time_of_a_force_is_found_out():
    checks = pfaff.verify(conformal_splitting(0))
    assert not checks.ok and {check.claim for check in checks.failed} == {"order", "order conditions"}
    assert pfaff.verify(conformal_splitting(1)).ok


def test_a_start_of_floats_is_on_its_constraints():
    def pendulum(angle, digits):
        start = [round(float(np.sin(angle)), digits), round(float(-np.cos(angle)), digits), 0, 0]
        return pfaff.system(coordinates={"q": 2, "p": 2}, initial=start, holonomic=lambda q: q @ q - 1, name="rod")(lambda q, p: p @ p / 2 + 9.81 * q[1])

    for angle in np.random.default_rng(5).uniform(-3, 3, 5):
        assert pfaff.verify(pendulum(angle, 17)).ok
    coarse = pfaff.verify(pendulum(0.3, 10))
    assert {check.claim for check in coarse.failed} == {"initial state is on the constraints"}


forced = pfaff.system(coordinates=["q", "p"], initial=[1, 0], applied_force=lambda p: [-p], name="forced")(lambda q, p: p**2 / 2 + q**2 / 2)
free = pfaff.system(coordinates=["x", "y"], initial=[1, 0], formula="field", invariants={"size": lambda x, y: x**2 + y**2}, behaviours={"size": "free"}, name="free")(lambda x, y: [y, -x - y])
wrong = pfaff.system(coordinates=["x", "y"], initial=[1, 0], formula="field", invariants={"size": lambda x, y: x**2 + y**2}, name="wrong")(lambda x, y: [y, -x - y])


@pytest.mark.parametrize("system", [forced, free])
def test_a_system_that_states_nothing_that_could_be_false_is_not_wrong(system):
    checks = pfaff.verify(system)
    assert checks.ok and checks.verdict.startswith(f"ok: there is nothing to check of {system.name}, because it states nothing that could be false")
    assert not pfaff.verify(system, wrong).ok and pfaff.verify(system, "pendulum").verdict.startswith("ok: ")
    assert "nothing" not in pfaff.verify(system, "pendulum").verdict


def test_a_method_that_nothing_fits_is_not_ok():
    nowhere = pfaff.method(order=0, needs=["generating-map", "holonomic"], name="nowhere")(lambda problem, t, h, z: z)
    checks = pfaff.verify(nowhere)
    assert not checks.ok and "no system that is registered fits it" in checks.verdict


def test_a_falsification_without_claims_says_why():
    found = pfaff.falsify(pfaff.method(order=1, name="euler")(lambda problem, t, h, z: z + h * problem.field(t, z)), systems=1)
    assert len(found) == 0 and not found.ok and repr(found).startswith("no claim was tried: the method makes none that random systems could falsify")


def test_friction_that_drives_is_found():
    def rubbed(friction):
        return pfaff.system(coordinates={"q": 2, "p": 2}, initial=[1, 0, 0, 0.5], holonomic=lambda q: q @ q - 1, friction=friction, name="rubbed")(
            lambda q, p: p @ p / 2 + 9.81 * q[1])

    for sound in (lambda q: [0.1, 0.1], lambda q: [0, 0.1], lambda q: [q[0] ** 2, 0.1 + 0.1 * np.sin(q[1])], lambda q, p: [np.sqrt(p @ p), 0]):
        assert pfaff.verify(rubbed(sound)).ok
    # The second is negative where the motion comes to later alone.
    for driving, where in ((lambda q: [-0.1, -0.1], ""), (lambda q: [q[0], 0.1], " along the motion")):
        assert f"coefficients of friction are not negative{where}" in {check.claim for check in pfaff.verify(rubbed(driving)).failed}


def test_a_closed_form_that_jumps_is_found():
    def oscillator(jump):
        def solution(elapsed, q, p):
            s = elapsed + pfaff.where(elapsed - 1.3, jump, 0)
            return [q * np.cos(s) + p * np.sin(s), p * np.cos(s) - q * np.sin(s)]

        return pfaff.system(coordinates=["q", "p"], initial=[1, 0], exact_solution=solution, name="jumping")(lambda q, p: p**2 / 2 + q**2 / 2)

    assert pfaff.verify(oscillator(0)).ok
    assert [check.claim for check in pfaff.verify(oscillator(1e-15)).failed] == ["exact solution along the motion"]
