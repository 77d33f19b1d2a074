"""What runs say that do not last as long as was asked for: whole steps, and Ctrl-C before and behind them."""
import math
import pickle

from test_integration import interrupted_after

import pfaff


def test_a_run_says_what_it_lasts_where_that_is_not_what_was_asked_for():
    run = pfaff.run("kepler", "verlet", step=0.3, time=1, t0=2)
    words = "the run lasts 0.9, not 1: 3 whole steps of 0.3, and none is shortened"
    assert run.summary["duration"] == words and repr(run).splitlines()[0].endswith(f"4 samples, largest error {run.error_max:.3g}; {words}")
    assert f"; {words}</p>" in run._repr_html_()
    for step, time in ((0.1, 0.3), ("1/3", 1), (math.pi / 100, math.pi)):
        assert "duration" not in pfaff.run("kepler", "verlet", step=step, time=time).summary


def test_a_run_that_is_interrupted_before_its_first_step_is_empty():
    error, late = interrupted_after(0.2, lambda: pfaff.run("henon-heiles", "verlet", step=0.01, time=1e6, reference="solution"))
    run = error.run
    assert late < 0.1 and str(error) == run.message == "it was interrupted while its reference was computed, before the first step"
    assert run.y.shape == (0, 4) and run.status == "interrupted" and repr(run).endswith(f"no samples; {run.message}") and run.message in run._repr_html_()
    assert not run.drift and not run.counters and run.error_max is None and pickle.loads(pickle.dumps(run)).message == run.message


def test_a_run_that_is_interrupted_while_it_is_measured_has_its_samples():
    error, late = interrupted_after(0.3, lambda: pfaff.run("henon-heiles", "verlet", step=0.01, time=1e4, measures=["error"]))
    assert late < 0.1 and len(error.run.t) > 1000 and error.run.status == "converged" and not error.run.measures
    assert str(error) == error.run.message == "it was interrupted while measures looked at it, which its tables are without"
