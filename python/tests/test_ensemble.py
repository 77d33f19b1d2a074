"""Arrays of initial states: the same bits as one by one, whatever the threads, and samples where they end early."""
import numpy as np
import pytest
from definitions import henon_heiles, kick
from test_integration import interrupted_after

import pfaff

STATES = np.random.default_rng(1).normal(scale=0.1, size=(20, 4))


@pytest.mark.parametrize("method", ["verlet", "gauss", kick])
def test_trajectories_have_the_bits_of_integrations(method):
    ensemble = pfaff.ensemble(henon_heiles, method, STATES, step=0.05, steps=100, every=10, threads=3)
    assert ensemble.y.shape == (20, 11, 4) and ensemble.done.all() and not ensemble.failures
    for k in (0, 7, 19):
        it = pfaff.Integration(henon_heiles, method, step=0.05, initial=STATES[k])
        rows = it.steps(100, every=10)
        assert np.array_equal(ensemble.y[k, 1:], rows.y) and np.array_equal(ensemble.y[k, 0], STATES[k])
        assert np.array_equal(ensemble.t[1:], rows.t)
    one = pfaff.ensemble(henon_heiles, method, STATES, step=0.05, steps=100, every=10, threads=1)
    assert np.array_equal(one.y, ensemble.y)


def test_start_and_end_alone_are_kept_without_every():
    assert pfaff.ensemble(henon_heiles, "verlet", STATES, step=0.05, steps=7).y.shape == (20, 2, 4)
    assert pfaff.ensemble(henon_heiles, "verlet", np.empty((0, 4)), step=0.05, steps=7).y.shape == (0, 2, 4)


def test_a_trajectory_that_fails_says_so_and_leaves_the_others():
    @pfaff.system(coordinates=["x"], formula="field")
    def explosion(x):
        return [x**2]

    ensemble = pfaff.ensemble(explosion, "rk4", [[0.1], [1.0], [-1.0]], step=0.01, steps=200, every=20)
    assert list(ensemble.failures) == [1] and "range of numbers" in ensemble.failures[1]
    assert np.isnan(ensemble.y[1, -1, 0]) and np.isfinite(ensemble.y[1, :5]).all()
    # x = 1/(1/x0 - t); rk4 with h x = 0.01 is right to 1e-8 and better.
    assert abs(ensemble.y[2, -1, 0] + 1 / 3) < 1e-8


def test_callbacks_and_ctrl_c():
    seen = []
    pfaff.ensemble(henon_heiles, "verlet", STATES, step=0.05, steps=10, callback=seen.append)
    assert sorted(seen) == list(range(20))

    def raising(k):
        if k == 5:
            raise LookupError(k)

    with pytest.raises(LookupError) as caught:
        pfaff.ensemble(henon_heiles, "verlet", STATES, step=0.05, steps=10, callback=raising)
    assert caught.value.run.done[5] and np.isfinite(caught.value.run.y[5]).all()
    error, late = interrupted_after(0.3, lambda: pfaff.ensemble(henon_heiles, "verlet", STATES, step=0.05, steps=10**9, every=10**5, threads=2))
    assert late < 0.1 and np.isfinite(error.run.y[0, 1]).all() and not error.run.done.all()
    assert repr(error.run).endswith("trajectories, t = 0 .. 5e+07, 10001 rows each; 0 of them came to their end")


def test_an_ensemble_says_what_it_is_and_becomes_a_data_frame():
    pytest.importorskip("pandas")
    of = pfaff.ensemble(henon_heiles, "verlet", STATES, step=0.05, steps=10, every=5)
    assert repr(of) == f"ensemble of {henon_heiles.name} by verlet: 20 trajectories, t = 0 .. 0.5, 3 rows each" and repr(of) in of._repr_html_()
    frame = of.to_pandas()
    assert list(frame.columns) == ["trajectory", "t", *henon_heiles.coordinates] and len(frame) == 60
    assert (frame[list(henon_heiles.coordinates)].to_numpy() == of.y.reshape(60, 4)).all() and list(frame["trajectory"][:4]) == [0, 0, 0, 1]


@pytest.mark.parametrize(
    "states, settings, words",
    [
        ([1, 2, 3, 4], {}, r"expected shape \(N, 4\), got \(4,\)"),
        ([[1, 2]], {}, r"got \(1, 2\)"),
        ([["a", 1, 2, 3]], {}, "expected real numbers"),
        ([[1j, 1, 2, 3]], {}, "expected real numbers"),
        ([[np.nan, 0, 0, 0]], {}, "expected finite numbers; state 0"),
        (STATES, {"steps": 0}, "steps: expected a whole number >= 1"),
        (STATES, {"every": 20}, "at most 10"),
        (STATES, {"threads": 0}, "threads"),
        (STATES, {"step": "x"}, "step"),
    ],
)
def test_bad_input_is_refused(states, settings, words):
    with pytest.raises(pfaff.InputError, match=words):
        pfaff.ensemble(henon_heiles, "verlet", states, **{"step": 0.05, "steps": 10, **settings})


def test_arrays_of_any_layout_are_taken():
    wide = np.asfortranarray(np.repeat(STATES, 2, axis=0))
    strided = pfaff.ensemble(henon_heiles, "verlet", wide[::2], step=0.05, steps=10)
    assert np.array_equal(strided.y, pfaff.ensemble(henon_heiles, "verlet", STATES, step=0.05, steps=10).y)
    with pytest.raises(pfaff.InputError, match="verlet needs separable"):
        pfaff.ensemble("lotka-volterra", "verlet", [[1, 2]], step=0.05, steps=10)


def test_states_of_float32_are_the_same_alone_and_in_an_ensemble():
    states = np.array([[0.1, -0.2, 0.3, 0.15]], dtype=np.float32)
    alone = pfaff.Integration("henon-heiles", "verlet", step=0.1, initial=states[0])
    assert np.array_equal(alone.state, states[0].astype(float))
    together = pfaff.ensemble("henon-heiles", "verlet", states, step=0.1, steps=10)
    assert np.array_equal(alone.steps(10, every=10).y[0], together.y[0, -1])


@pytest.mark.parametrize("method, settings", [
    ("gauss", {"precision": "quad"}),
    ("odeint-dopri5", {"tolerance": 1e-9, "absolute": [1e-12] * 4}),
    ("odeint-dopri5", {"tolerance": 1e-6, "scales": "step", "t0": 0.1}),
    ("taylor", {"tolerance": "1e-20", "precision": "quad", "t0": "1/3"}),
], ids=["quad", "tolerance", "scales", "both"])
@pytest.mark.parametrize("threads", [1, 3])
def test_quad_and_tolerances_have_the_bits_of_integrations(method, settings, threads):
    ensemble = pfaff.ensemble(henon_heiles, method, STATES[:5], step=0.3, steps=10, every=3, threads=threads, **settings)
    for k, state in enumerate(STATES[:5]):
        it = pfaff.Integration(henon_heiles, method, step=0.3, initial=state, **settings)
        rows = it.steps(10, every=3)
        assert np.array_equal(ensemble.y[k, 1:], rows.y) and np.array_equal(ensemble.t[1:], rows.t) and np.array_equal(ensemble.y[k, 0], state)


def test_a_step_control_that_gives_up_counts_the_steps_of_its_own_trajectory():
    fall = [[1, 0, 0, 0], [0.5, 0, 0, 1.4], [1, 0, 0, 0]]
    ensemble = pfaff.ensemble("kepler", "taylor", fall, step=1, steps=3, tolerance=1e-9, threads=1)
    it = pfaff.Integration("kepler", "taylor", step=1, tolerance=1e-9, initial=fall[0])
    with pytest.raises(pfaff.NotConverged) as failed:
        it.steps(3)
    assert ensemble.failures == {0: str(failed.value), 2: str(failed.value)} and ensemble.done.all()


@pytest.mark.parametrize("settings, words", [
    ({"tolerance": 2}, r"tolerance: expected a number in \(0, 1\]"),
    ({"tolerance": 1e-40}, "tolerance: 1e-40 is below round-off"),
    ({"tolerance": 1e-9, "absolute": [1, 2]}, "one for each of the 4 coordinates"),
    ({"absolute": 1}, "expected a tolerance beside them"),
    ({"tolerance": 1e-9, "step": 0}, "step: expected the time between two looks beside the tolerance"),
    ({"step": None}, "step: expected a number other than 0, or a tolerance"),
    ({"scales": "stpe"}, "did you mean 'step'"),
    ({"precision": "half"}, "expected one of: double, quad"),
    ({"precision": "quad"}, "has coefficients in double only"),
])
def test_ensembles_refuse_what_integrations_refuse(settings, words):
    for make in (lambda **of: pfaff.ensemble(henon_heiles, "odeint-dopri5", STATES, steps=2, **of),
                 lambda **of: pfaff.Integration(henon_heiles, "odeint-dopri5", initial=STATES[0], **of).steps(2)):
        with pytest.raises(pfaff.InputError, match=words):
            make(**{"step": 0.05, **settings})


def test_what_was_never_begun_is_left_out_and_not_filled():
    """Two gigabytes of rows, which take some seconds to fill."""
    states = np.repeat(STATES[:1], 60, axis=0)
    error, late = interrupted_after(0.2, lambda: pfaff.ensemble(henon_heiles, "verlet", states, step=0.05, steps=10**9, every=1000, threads=2))
    assert late < 0.5 and len(error.run.y) == len(error.run.done) <= 2 and np.isnan(error.run.y[:, -1]).all()
    assert np.isfinite(error.run.y[0, :10]).all() and error.run.t[-1] == 5e7 and len(error.run.t) == 10**6 + 1
