"""Integrations as objects: steps, samples, callbacks, ways back, Ctrl-C, and derivatives through the steps."""
import math
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from definitions import duffing, henon_heiles, kick, oscillator

import pfaff


def interrupted_after(seconds, work):
    """Presses Ctrl-C after so many seconds; gives the exception and how long after that it came."""
    timer = threading.Timer(seconds, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.perf_counter()
    with pytest.raises(pfaff.Interrupted) as caught:
        work()
    late = time.perf_counter() - begin - seconds
    timer.join()
    return caught.value, late


def test_samples_are_the_states_that_go_by():
    it = pfaff.Integration(duffing, "verlet", step=0.1)
    rows = it.steps(25, every=10)
    assert rows.reached and rows.t.tolist() == [1.0, 2.0] and rows.y.shape == (2, 2) and it.time == 2.5
    one = pfaff.Integration(duffing, "verlet", step=0.1)
    one.steps(10)
    assert np.array_equal(rows.y[0], one.state)
    assert it.to(3.05, every=10).t.tolist() == [3.0] and it.steps_taken == 31 and it.steps(0, every=5).y.shape == (0, 2)
    assert it.steps(9, every=1).y.shape == (9, 2)  # another number of steps between rows, beside the first
    assert it.steps(5).y.shape == (0, 2) and it.steps_taken == 45  # none are kept that nobody asked for
    assert "verlet" in repr(it) and it.counters["steps"] == 45


def test_ways_back():
    it = pfaff.Integration(henon_heiles, "gauss", step=0.1)
    start = it.state
    it.steps(100)
    back = it.reversed()
    back.steps(100)
    # A symmetric method returns but for round-off, a unit a step; one that is not symmetric does not.
    assert np.abs(back.state - start).max() < 1e-13 and back.step == -0.1
    euler = pfaff.Integration(henon_heiles, "rk4", step=0.1)
    euler.steps(100)
    lost = euler.reversed()
    lost.steps(100)
    assert np.abs(lost.state - start).max() > 1e-8
    it.turn()
    it.steps(100)
    assert np.abs(it.state - start).max() < 1e-13
    beside = it.beside([0.1, 0.1, 0.1, 0.1])
    assert beside.state.tolist() == [0.1] * 4
    it.go_on_from([0, 0, 0, 0], t0=5, step=-0.5)
    assert it.time == 5 and it.step == -0.5 and it.steps(2).reached and it.time == 4


def test_callbacks_see_copies_and_may_end_the_integration():
    seen = []
    it = pfaff.Integration(duffing, "verlet", step=0.1)
    it.watch(lambda t, z: seen.append((t, z)), every=5)
    rows = it.steps(20, every=5)
    assert [t for t, _ in seen] == rows.t.tolist() and np.array_equal([z for _, z in seen], rows.y)
    ends = pfaff.Integration(duffing, "verlet", step=0.1)
    ends.watch(lambda t, z: np.float64(t) > 0.95)  # NumPy's True
    outcome = ends.steps(1000, every=1)
    assert not outcome.reached and "watcher" in outcome.message and outcome.steps == 10 == len(outcome.t) and ends.time == 1.0


def test_what_a_callback_raises_reaches_the_caller_with_the_samples():
    def raising(t, z):
        if t >= 2:
            raise LookupError("far enough")

    it = pfaff.Integration(duffing, "verlet", step=0.1)
    it.watch(raising, every=10)
    with pytest.raises(LookupError, match="far enough") as caught:
        it.steps(1000, every=10)
    assert caught.value.run.t.tolist() == [1.0, 2.0] and it.time == 2.0
    nested = pfaff.Integration(duffing, "verlet", step=0.1)
    nested.watch(lambda t, z: nested.steps(1))
    with pytest.raises(pfaff.InputError, match="one at a time"):
        nested.steps(1)


def test_ctrl_c_ends_steps_and_leaves_the_samples():
    it = pfaff.Integration(henon_heiles, "gauss", step=0.01)
    error, late = interrupted_after(0.2, lambda: it.steps(10**12, every=1000))
    assert late < 0.1 and len(error.run.t) > 0 and it.steps_taken > 0 and isinstance(error, KeyboardInterrupt)
    it.steps(10)  # it goes on from there
    called = pfaff.method(order=2, needs=["separable"], traced=False, name="called")(kick._definition.function)
    error, late = interrupted_after(0.2, lambda: pfaff.Integration(henon_heiles, called, step=0.01).steps(10**9))
    assert late < 0.1
    with_callback = pfaff.Integration(henon_heiles, "gauss", step=0.01)
    with_callback.watch(lambda t, z: None)
    error, late = interrupted_after(0.2, lambda: with_callback.steps(10**9))
    assert late < 0.1


def test_other_threads_run_meanwhile():
    stop = threading.Event()
    turns = []

    def turning():
        while not stop.is_set():
            turns.append(0)
            time.sleep(0.001)

    thread = threading.Thread(target=turning)
    thread.start()
    it = pfaff.Integration(henon_heiles, "gauss", step=0.01)
    begin = time.perf_counter()
    while time.perf_counter() - begin < 0.2:
        it.steps(20000)
    stop.set()
    thread.join()
    assert len(turns) > 20  # with Python's lock held it would be one for each of the few calls


def test_steps_that_fail_raise_with_the_last_good_state():
    @pfaff.system(coordinates=["x"], initial=[1], formula="field")
    def explosion(x):
        return [x**2]

    it = pfaff.Integration(explosion, "rk4", step=0.01)
    with pytest.raises(pfaff.RunFailed, match="range of numbers") as caught:
        it.steps(1000, every=10)
    assert caught.value.run.status == "non_finite" and 0.9 < it.time < 1.2 and np.isfinite(it.state).all()
    implicit = pfaff.Integration(explosion, "gauss", step=0.3)
    with pytest.raises((pfaff.NotConverged, pfaff.RunFailed)):
        implicit.steps(100)


def test_quad_has_all_digits():
    it = pfaff.Integration(oscillator, pfaff.Method("gauss", stages=8), step="1/10", precision="quad")
    it.steps(10)
    cos2 = "-0.41614683654714238699756822950076"  # cos 2
    # The error of sixteen orders of h omega = 0.2 over ten steps is below 1e-24.
    assert abs(float(it.decimals[0]) - math.cos(2)) < 1e-16 and str(it.decimals[0])[:24] == cos2[:24]


def test_jacobians_of_the_map_have_their_closed_form():
    it = pfaff.Integration(oscillator, pfaff.Method("gauss", stages=4), step=0.01)
    z, m = it.jacobian(100)
    c, s = math.cos(2), math.sin(2)
    assert np.abs(m - [[c, s / 2], [-2 * s, c]]).max() < 1e-13 and it.time == 0
    # Of more coordinates than a dual has directions: against differences of two runs.
    it = pfaff.Integration("fermi-pasta-ulam-tsingou", "verlet", step=0.01)
    n = it.system.dimension
    m = it.jacobian(20)[1]
    assert n > 4
    for k in (0, n - 1):
        ends = []
        for sign in (1, -1):
            beside = it.beside(it.state + sign * 1e-5 * np.eye(n)[k])
            beside.steps(20)
            ends.append(beside.state)
        # The error of the difference is its step squared times a third derivative, and round-off over the step.
        assert np.abs((ends[0] - ends[1]) / 2e-5 - m[:, k]).max() < 1e-5 * np.abs(m).max()


@pytest.mark.parametrize(
    "settings, words",
    [
        ({}, "step: expected"),
        ({"step": 0}, "other than 0"),
        ({"step": "a"}, "got 'a'"),
        ({"step": 0.1, "initial": [1]}, r"expected shape \(2,\)"),
        ({"step": 0.1, "initial": [[1, 2], [3, 4]]}, r"expected shape \(2,\), a number for each of q, p, got .*; pfaff.ensemble takes many"),
        ({"step": 0.1, "initial": [1, float("nan")]}, "initial"),
        ({"step": 0.1, "initial": [1, 1j]}, "expected a number, got 1j"),
        ({"step": 0.1, "initial": "1,2"}, r"expected shape \(2,\)"),
        ({"step": 0.1, "precision": "quadd"}, "did you mean 'quad'"),
        ({"step": 0.1, "tolerance": 1e-6}, "takes fixed steps only"),
        ({"step": 0.1, "tolerance": 0}, r"tolerance: expected a number in \(0, 1\]"),
        ({"step": 0.1, "alpa": 1}, "did you mean 'alpha'"),
        ({"step": 0.1, "formulation": "dirak"}, "formulation"),
    ],
)
def test_bad_input_is_refused(settings, words):
    with pytest.raises(pfaff.InputError, match=words):
        pfaff.Integration(duffing, "verlet", **settings)


def test_formulations_take_parameters():
    rods = {"beads": 4, "friction": 0.5, "mass": 2}
    ring = pfaff.System("ring", **rods)

    def end(formulation):
        run = pfaff.run(ring, "gauss", step=0.01, time=0.2, formulation=formulation)
        it = pfaff.Integration(ring, "gauss", step=0.01, formulation=formulation)
        it.steps(20)
        assert np.array_equal(run.y[-1], it.state)
        return run.y[-1]

    for form in ("stokes", "metriplectic", "none"):
        assert end(f"lmm(friction-form={form})") == pytest.approx(end(f"dirac(friction-form={form})"), abs=1e-6)
    assert np.array_equal(end("lmm"), end("lmm(friction-form=stokes)"))
    assert abs(end("lmm(friction-form=none)") - end("lmm")).max() > 1e-3
    rate = [pfaff.evaluate(ring, formulation=f"lmm(friction-form={form})", time=0)["rhs"] for form in ("none", "stokes")]
    assert rate[0].shape == rate[1].shape == (ring.dimension,)
    for text, words in (("lmm(friction=none)", "friction-form"), ("lmm(", "formulation"), ("lmn(friction-form=none)", "lmm")):
        with pytest.raises(pfaff.InputError, match=words):
            pfaff.Integration(ring, "gauss", step=0.01, formulation=text)


def test_formulations_make_motions_of_constraints():
    dirac = pfaff.Integration("n-pendulum", "gauss", stages=4, bobs=2, step=0.01, formulation="dirac")
    usual = pfaff.Integration("n-pendulum", "gauss", stages=4, bobs=2, step=0.01)
    own = pfaff.Integration("n-pendulum", "rattle", bobs=2, step=0.01)
    for it in (dirac, usual, own):
        it.steps(50)
    # The method of order 8 is exact to round-off here; that on the constraints has order 2.
    assert np.array_equal(dirac.state, usual.state) and 1e-8 < np.abs(own.state - usual.state).max() < 1e-2
    for method, words in (("rattle", "expected no formulation"), ("verlet", "needs separable")):
        with pytest.raises(pfaff.InputError, match=words):
            pfaff.Integration("n-pendulum", method, step=0.01, formulation="dirac")
    with pytest.raises(pfaff.InputError, match="unknown parameter 'x'"):
        pfaff.run("kepler", "gauss", step=0.1, time=1, system_parameters={"x": 1})


def test_calls_with_bad_numbers_are_refused():
    it = pfaff.Integration(duffing, "verlet", step=0.1)
    for call in (lambda: it.steps(-1), lambda: it.steps(2**63), lambda: it.steps(1, every=2**70), lambda: it.steps(1.5), lambda: it.steps(5, every=-1), lambda: it.watch(3), lambda: it.watch(print, every=0),
                 lambda: it.to("x"), lambda: it.beside([1]), lambda: it.jacobian(-1)):
        with pytest.raises(pfaff.InputError):
            call()
    it.steps(10)
    with pytest.raises(pfaff.InputError, match="lies behind"):
        it.to(0)


def test_arrays_of_any_layout_and_kind_are_taken():
    expected = pfaff.Integration(duffing, "verlet", step=0.1, initial=[0.5, 0.25])
    for state in (np.array([0.5, 9, 0.25, 9])[::2], np.array([0.5, 0.25], dtype=np.float32), (0.5, "0.25"), np.array([0.5, 0.25], dtype=object)):
        it = pfaff.Integration(duffing, "verlet", step=0.1, initial=state)
        it.steps(5)
        other = expected.beside([0.5, 0.25])
        other.steps(5)
        assert np.array_equal(it.state, other.state)


def test_threads_that_work_end_with_the_interpreter():
    # A thread that came back to an interpreter that has ended would be ended in the middle of C++, which aborts.
    code = """
import sys, threading, time
import pfaff
from definitions import henon_heiles, kick
called = pfaff.method(order=2, needs=["separable"], traced=False, name="called")(kick._definition.function)
threading.excepthook = lambda *_: None
watched = pfaff.Integration(henon_heiles, "gauss", step=0.01)
watched.watch(lambda t, z: None)
jobs = [watched, pfaff.Integration(henon_heiles, "gauss", step=0.01), pfaff.Integration(henon_heiles, called, step=0.01)]
for job in jobs:
    threading.Thread(target=lambda job=job: job.steps(10**12), daemon=True).start()
time.sleep(0.2)
"""
    paths = os.pathsep.join([os.path.dirname(__file__), *filter(None, sys.path)])
    ended = subprocess.run([sys.executable, "-B", "-c", code], env={**os.environ, "PYTHONPATH": paths}, capture_output=True, text=True, timeout=30)
    assert ended.returncode == 0 and not ended.stderr


def test_ctrl_c_ends_a_compiler(tmp_path, monkeypatch):
    if subprocess.run(["c++", "--version"], capture_output=True).returncode != 0:
        pytest.skip("there is no compiler")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))  # where nothing is compiled already
    chain = pfaff.system(coordinates={"q": 60, "p": 60})(lambda q, p: p @ p / 2 + sum(np.cos(q[i] - q[j]) for i in range(60) for j in range(i)))
    _, late = interrupted_after(0.7, chain.compiled)
    assert late < 0.3


def test_steps_before_something_was_raised_have_converged():
    @pfaff.method(order=1, traced=False)
    def fragile(problem, t, h, z):
        return z * (1 / (t < 0.25))

    with pytest.raises(ZeroDivisionError) as caught:
        pfaff.Integration("kepler", fragile, step=0.1).steps(9, every=1)
    assert caught.value.run.status == "converged" and len(caught.value.run.t) == 3 and not caught.value.run.reached


def test_going_on_keeps_all_digits_of_time_and_step():
    driven = pfaff.system(coordinates=["q", "p"], initial=[1, 0])(lambda t, q, p: p**2 / 2 + q**2 / 2 * (1 + np.sin(t) / 3))
    whole, parts = (pfaff.Integration(driven, "gauss", step="1/3", t0="1/7", precision="quad") for _ in range(2))
    whole.steps(6)
    parts.steps(3)
    parts.go_on_from(parts.decimals)
    parts.steps(3)
    assert max(abs(x - y) for x, y in zip(whole.decimals, parts.decimals)) < 1e-32  # a step of a double is off by 2e-17


@pytest.mark.parametrize("work", [
    lambda: pfaff.Integration("kepler", "gauss", step=1e-6).steps(10**9, every=1000), lambda: pfaff.run("kepler", "gauss", step=1e-6, time=1000),
])
def test_what_a_handler_of_ones_own_raises_passes_with_the_samples(work):
    def handler(number, frame):
        raise TimeoutError("enough")

    before = signal.signal(signal.SIGINT, handler)
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    try:
        timer.start()
        with pytest.raises(TimeoutError, match="enough") as caught:
            work()
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)
    assert len(caught.value.run.t) > 0


def test_steps_that_a_method_chooses_are_counted():
    it = pfaff.Integration("kepler", "taylor", tolerance=1e-12)
    outcome = it.to(10)
    assert outcome.steps == it.steps_taken == it.counters["steps"] > 20
    assert it.to(11).steps == it.steps_taken - outcome.steps > 0


def test_a_tolerance_out_of_its_range_is_refused():
    with pytest.raises(pfaff.InputError, match="^tolerance: 1e-16 is below round-off, which is 2.22e-16; expected at least that$"):
        pfaff.Integration("harmonic-oscillator", "taylor", step=1, tolerance=1e-16)
    with pytest.raises(pfaff.InputError, match="^tolerance: 1e-40 is below round-off, which is 1.93e-34; expected at least that$"):
        pfaff.Integration("harmonic-oscillator", "taylor", step=1, tolerance="1e-40", precision="quad")
    pfaff.Integration("harmonic-oscillator", "taylor", step=1, tolerance="1e-30", precision="quad").steps(1)
    with pytest.raises(pfaff.InputError, match=r"^tolerance: expected a number in \(0, 1\], got 2$"):
        pfaff.Integration("kepler", "taylor", tolerance=2)


@pytest.mark.parametrize("length, gravity, step", [
    (0.8905316463357724, 80.27938927960153, 0.03459434948929595), (2.143557051222946, 74.17629302757872, 0.024285780693430792),
    (2.597433036397459, 0.3903512636844095, 0.048396097440242584), (1.297073026454934, 0.19821280276726197, 0.013708741165948151)])
def test_a_symmetric_projection_converges_at_rest(length, gravity, step):
    """What the shift holds rounds, where nothing moves."""
    hanging = pfaff.system(coordinates={"q": 2, "p": 2}, initial=[0, -length, 0, 0], holonomic=lambda q: q @ q - length * length)(
        lambda q, p: p @ p / 2 + gravity * q[1])
    it = pfaff.Integration(hanging, "projected-gauss", step=step)
    it.steps(100)
    assert np.abs(it.state - [0, -length, 0, 0]).max() < 1e-12 * gravity
