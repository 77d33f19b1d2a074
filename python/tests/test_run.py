"""Runs: samples, drift, errors and measures, and what is left where a run ends early."""
import json
import math
import subprocess
import sys
import tomllib

import numpy as np
import pytest
from definitions import duffing, kick, oscillator, runge_kutta
from test_integration import interrupted_after

import pfaff


def test_samples_are_those_of_the_integration():
    result = pfaff.run(duffing, "verlet", step=0.05, time=10, every=10)
    it = pfaff.Integration(duffing, "verlet", step=0.05)
    rows = it.steps(200, every=10)
    assert np.array_equal(result.t[1:], rows.t) and np.array_equal(result.y[1:], rows.y) and result.t[0] == 0
    assert np.array_equal(result.y[0], duffing.initial) and np.array_equal(result["q"], result.y[:, 0])
    q, p = result.y.T
    # The energy is computed from the same states; a unit of round-off of its terms.
    assert np.abs(result.invariants["energy"] - (p**2 / 2 - q**2 / 2 + q**4 / 4)).max() < 1e-15
    assert not result.y.flags.owndata and result.y.flags.writeable  # the memory of the library's samples, without a copy


def test_drift_tells_kept_energies_from_lost_ones():
    kept, lost = (pfaff.run("henon-heiles", method, step=0.1, time=2000) for method in (kick, "rk4"))
    assert kept.drift["energy"]["class"] == "bounded" and lost.drift["energy"]["class"] != "bounded"
    energy = lost.drift["energy"]
    assert energy.slope_low < energy.slope < energy.slope_high < 0 and energy.max >= abs(energy.final) and energy.evidence
    assert "energy" in repr(lost) and "<table>" in lost._repr_html_() and "<svg" in lost._repr_html_()
    with pytest.raises(KeyError, match="did you mean 'slope'"):
        energy["slop"]


def test_the_files_of_a_run_name_the_library_that_made_it(tmp_path):
    for of, (system, method) in enumerate([("pendulum", "verlet"), (duffing, "verlet"), ("damped-oscillator", "yoshida")]):
        pfaff.run(system, method, step=0.1, time=1, out=tmp_path / str(of))
        assert '"libpfaff_plugins.so' in (tmp_path / str(of) / "config.toml").read_text()
    pfaff.run("damped-oscillator", "rk4", step=0.1, time=1, out=tmp_path / "main")
    assert "libpfaff_plugins" not in (tmp_path / "main" / "config.toml").read_text()


def test_the_table_of_drift_has_units():
    damped = pfaff.run("damped-oscillator", "rk4", step=0.1, time=10)
    head, row = (line.split("  ") for line in repr(damped).splitlines()[1:])
    assert [name.strip() for name in head if name] == ["quantity", "class", "max", "slope per s", "slope_low per s", "slope_high per s"]
    assert row[0] == "birkhoffian [m^2/s^2]" and "<th>slope per s</th>" in damped._repr_html_()
    pure = repr(pfaff.run("henon-heiles", "rk4", step=0.1, time=10))
    assert "[" not in pure and " per " not in pure


def test_errors_are_measured_against_what_is_known():
    result = pfaff.run("kepler", "gauss", stages=3, eccentricity=0.3, step=0.05, time=20)
    q, error = result["q"], result.error
    assert result.error_max == np.nanmax(error) and 0 < result.error_max < 1e-7 and q.shape == (len(result.t), 2)
    against = pfaff.run(oscillator, runge_kutta, step=0.01, time=5, reference="solution,every", every=50)
    exact = np.array([[math.cos(2 * t), -2 * math.sin(2 * t)] for t in against.t])
    expected = np.linalg.norm(against.y - exact, axis=1) / np.linalg.norm(exact, axis=1)
    # The closed form in double is off by a unit of round-off, where errors are 1e-8.
    assert np.abs(against.error - expected).max() < 1e-15 and against.error_max > 1e-9
    assert pfaff.run(oscillator, "verlet", step=0.1, time=1, reference=None).error is None


def test_velocities_stand_for_momenta():
    @pfaff.system(coordinates=["q", "p"], initial=[0.5, 0])
    def heavy(q, p, mass=4.0):
        return p**2 / (2 * mass) + q**2 / 2

    result = pfaff.run(heavy, "verlet", step=0.1, time=1, initial=[1], initial_velocities=[0.25])
    assert result.y[0].tolist() == [1, 1] and pfaff.run(heavy, "verlet", step=0.1, time=1, initial_velocities=[2]).y[0].tolist() == [0.5, 8]


def test_measures_and_quad():
    result = pfaff.run(duffing, "verlet", step=0.05, time=10, precision="quad", measures=["structure"])
    table = result.measures["structure"]
    assert len(table["step"]) == len(table["residual"]) > 10 and max(table["residual"]) < 1e-30  # structure, to the round-off of quad
    euler = pfaff.run(duffing, runge_kutta, step=0.05, time=10, measures=["structure"])
    assert max(euler.measures["structure"]["residual"]) > 1e-9


def test_measures_may_be_functions_of_the_run():
    def half_speed(run):
        return run["p"] / 2

    def both(run):
        return {"sum": run["q"] + run["p"], "square": run["q"] ** 2}

    result = pfaff.run(duffing, "verlet", step=0.05, time=10, measures=[half_speed, both, "structure"])
    assert np.array_equal(result.measures["half-speed"]["half-speed"], result.y[:, 1] / 2) and set(result.measures["both"]) == {"t", "sum", "square"}
    assert "residual" in result.measures["structure"]
    with pytest.raises(pfaff.InputError, match="one for each sample"):
        pfaff.run(duffing, "verlet", step=0.05, time=10, measures=[lambda run: [1, 2]])
    with pytest.raises(ZeroDivisionError) as caught:
        pfaff.run(duffing, "verlet", step=0.05, time=10, measures=lambda run: 1 // 0)
    assert len(caught.value.run.t) == 201
    with pytest.raises(pfaff.InputError, match="names of measures and functions"):
        pfaff.run(duffing, "verlet", step=0.05, time=10, measures=[3])
    for twice, name in ([lambda run: run.t, lambda run: run.y[:, 0]], "lambda"), (["drift", "drift"], "drift"), ([half_speed, half_speed], "half-speed"):
        with pytest.raises(pfaff.InputError, match=f"'{name}' is the name of 2 of them"):
            pfaff.run(duffing, "verlet", step=0.05, time=10, measures=twice)


def test_files_are_left(tmp_path):
    folder = tmp_path / "out"
    result = pfaff.run(duffing, "verlet", step=0.1, time=1, out=folder)
    table = np.loadtxt(folder / "series.csv", delimiter=",", skiprows=1, usecols=(0, 1, 2))
    assert np.array_equal(table, np.column_stack([result.t, result.y])) and (folder / "summary.json").exists()
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "mine.txt").write_text("mine")
    with pytest.raises(pfaff.InputError, match="other"):
        pfaff.run(duffing, "verlet", step=0.1, time=1, out=tmp_path / "other")


def test_runs_that_end_early_keep_their_samples():
    @pfaff.system(coordinates=["x"], initial=[1], formula="field")
    def explosion(x):
        return [x**2]

    with pytest.raises(pfaff.RunFailed) as caught:
        pfaff.run(explosion, "rk4", step=0.01, time=5)
    run = caught.value.run
    assert 10 < len(run.t) and run.t[-1] < 1.3 and run.message and run.status == "non_finite"
    error, late = interrupted_after(0.3, lambda: pfaff.run(duffing, "gauss", step=1e-3, time=1e7, every=1000))
    assert late < 0.1 and len(error.run.t) > 1 and "interrupted" in error.run.message and error.run.status == "interrupted"

    @pfaff.method(order=1, traced=False)
    def breaking(problem, t, h, z):
        if t > 0.5:
            raise LookupError("broken")
        return z + h * problem.field(t, z)

    with pytest.raises(LookupError, match="broken") as caught:
        pfaff.run(duffing, breaking, step=0.01, time=1, every=1)
    assert abs(caught.value.run.t[-1] - 0.5) < 0.02


def test_pandas_has_a_row_for_each_sample():
    pytest.importorskip("pandas")
    frame = pfaff.run("kepler", "verlet", step=0.05, time=1, eccentricity=0.1).to_pandas()
    assert list(frame.columns)[:5] == ["t", "q1", "q2", "p1", "p2"] and len(frame) == 21


@pytest.mark.parametrize(
    "settings, words",
    [
        ({"step": 0.1}, "time: expected the duration"),
        ({"time": 1}, "step is missing"),
        ({"step": 0.1, "time": 0}, "other than 0"),
        ({"step": 0.1, "time": 1, "initial": [1]}, r"initial: expected shape \(2,\), a number for each of q, p, got 1 number"),
        ({"step": 0.1, "time": 1, "initial": np.eye(2)}, r"expected shape \(2,\), .* got an array of shape \(2, 2\); pfaff.ensemble takes many"),
        ({"step": 0.1, "time": 1, "initial": [[1, 2], [3]]}, r"initial: expected shape \(2,\)"),
        ({"step": 0.1, "time": 1, "t0": "then"}, "^t0: expected"),
        ({"step": 1e-15, "time": 1}, "expected at most [0-9]+$"),
        ({"step": 0.1, "time": 1, "precision": "dubble"}, "did you mean 'double'"),
        ({"step": 0.1, "time": 1, "reference": "exat"}, "did you mean 'exact'"),
        ({"step": 0.1, "time": 1, "every": 1.5}, "whole number"),
        ({"step": 0.1, "time": 1, "measures": ["structre"]}, "did you mean 'structure'"),
        ({"step": 0.1, "time": 1, "bta": 2}, "did you mean 'beta'"),
        ({"step": 2, "time": 1}, "at most the duration"),
        ({"step": 0.1, "tolerance": 1e-6, "time": 1}, "exclude each other"),
    ],
)
def test_bad_input_is_refused_without_options_of_the_command_line(settings, words):
    with pytest.raises(pfaff.InputError, match=words) as caught:
        pfaff.run(duffing, "verlet", **settings)
    assert "--" not in str(caught.value)


def test_messages_of_runs_that_end_early_name_arguments():
    with pytest.raises(pfaff.NotConverged, match="gave up at t = 1.1107.*in small ones, absolute says") as failed:
        pfaff.run("kepler", "taylor", initial=[1, 0, 0, 0], tolerance=1e-9, time=2)  # a fall into the centre
    assert "--" not in failed.value.run.message


@pytest.mark.parametrize("method", ["verlet", "rk4", "rattle"])
@pytest.mark.parametrize("call", [
    lambda method: pfaff.run("kepler", method, step=0.1, time=1, formulation="dirac"),
    lambda method: pfaff.Integration("kepler", method, step=0.1, formulation="dirac"),
    lambda method: pfaff.evaluate("kepler", formulation="dirac"),
])
def test_a_formulation_of_a_system_without_constraints_is_refused_as_by_the_program(call, method):
    with pytest.raises(pfaff.InputError) as refused:
        call(method)
    assert str(refused.value) == "formulation: kepler has no constraints; expected none"


def test_a_method_on_constraints_takes_no_formulation():
    words = "rattle steps on the constraints of spherical-pendulum themselves; expected no formulation"
    for call in (lambda **k: pfaff.run("spherical-pendulum", "rattle", step=0.1, time=1, **k), lambda **k: pfaff.Integration("spherical-pendulum", "rattle", step=0.1, **k)):
        with pytest.raises(pfaff.InputError, match=words):
            call(formulation="dirac")


def test_names_that_both_know_are_asked_for(tmp_path):
    text = 'name = "one"\ncoordinates = ["q", "p"]\ninitial = [1, 0]\nparameters = { stages = 1 }\nkinetic = "p^2/2"\npotential = "stages*q^2/2"\n'
    path = tmp_path / "stages.toml"
    path.write_text(text)
    with pytest.raises(pfaff.InputError, match="belongs to both"):
        pfaff.run(path, "gauss", step=0.1, time=1, stages=2)
    assert pfaff.run(path, "gauss", step=0.1, time=1, method_parameters={"stages": 2}).method.parameters["stages"] == "2"


def test_out_leaves_what_the_run_is_made_again_from(tmp_path):
    """By names, and with a system that is written in Python; a method that is written in Python has no name."""
    @pfaff.system(coordinates=["q", "p"], initial=[0.5, 0.1], name="quartic")
    def quartic(q, p, a: float = 1.0):
        return p**2 / 2 + a * q**4 / 4

    runs = {"names": lambda out: pfaff.run("kepler", "gauss", stages=3, step="0.05", time=1, every=1, out=out),
            "traced": lambda out: pfaff.run(quartic, "verlet", a=2, step="0.05", time=1, every=1, out=out)}
    for name, run in runs.items():
        run(tmp_path / name)
        text = (tmp_path / name / "config.toml").read_text(encoding="utf-8")
        config = tomllib.loads(text)
        again = pfaff.run(config["system"], config["integrator"], step=config["step"], time=config["time"], every=1,
                          system_parameters={key[7:]: value for key, value in config["set"].items() if key.startswith("system.")},
                          method_parameters={key[11:]: value for key, value in config["set"].items() if key.startswith("integrator.")},
                          out=tmp_path / (name + "-again"))
        assert again.status == "converged"
        series = [(tmp_path / folder / "series.csv").read_bytes() for folder in (name, name + "-again")]
        assert series[0] == series[1] and len(series[0]) > 100
    assert (tmp_path / "traced" / "system.toml").exists()

    pfaff.run(quartic, kick, step=0.05, time=1, out=tmp_path / "method")
    assert not (tmp_path / "method" / "config.toml").exists()
    assert tomllib.loads((tmp_path / "traced" / "config.toml").read_text(encoding="utf-8"))["files"]  # a changed system.toml is seen


def test_out_is_not_replaced_unasked(tmp_path):
    """Neither another run nor a longer one; and of what is replaced nothing stays beside the new series."""
    @pfaff.system(coordinates=["q", "p"], initial=[0.5, 0.1], name="quartic")
    def quartic(q, p):
        return p**2 / 2 + q**4 / 4

    def names(folder):
        return sorted(one.name for one in folder.iterdir() if one.name != ".lock")

    out = tmp_path / "out"
    pfaff.run(quartic, "verlet", step="0.05", time=10, out=out)
    before = (out / "series.csv").read_bytes()
    for call, words in ((lambda **more: pfaff.run("kepler", "verlet", step=0.05, time=1, out=out, **more), "holds another run that is longer, 201 rows"),
                        (lambda **more: pfaff.run(quartic, "verlet", step="0.05", time=1, out=out, **more), "longer, 201 rows"),
                        (lambda **more: pfaff.run(quartic, kick, step=0.05, time=1, out=out, **more), "longer, 201 rows")):
        with pytest.raises(pfaff.InputError, match=words + ".*force=True"):
            call()
        assert (out / "series.csv").read_bytes() == before
    assert names(out) == ["config.toml", "series.csv", "summary.json", "system.toml"]
    pfaff.run(quartic, kick, step=0.05, time=1, out=out, force=True)
    assert names(out) == ["series.csv", "summary.json"]

    @pfaff.method(order=1, traced=False)
    def falling(problem, t, h, z):
        if t > 0.5:
            raise RuntimeError("fell")
        return z + h * problem.field(t, z)

    with pytest.raises(RuntimeError, match="fell"):
        pfaff.run(quartic, falling, step=0.05, time=1, every=1, out=out, force=True)
    assert names(out) in (["series.csv"], ["series.csv", "summary.json"])
    if (out / "summary.json").exists():
        assert json.loads((out / "summary.json").read_text(encoding="utf-8"))["integrator"] == "falling"


def test_a_run_of_an_experiment_that_goes_on_is_left_alone(tmp_path):
    folder = tmp_path / "experiment" / "runs" / "one"
    folder.mkdir(parents=True)
    (tmp_path / "experiment" / "experiment.json").write_text("{}")
    held = subprocess.Popen([sys.executable, "-c", "import fcntl, sys, time; file = open(sys.argv[1], 'w'); fcntl.flock(file, fcntl.LOCK_EX); print('held', flush=True); time.sleep(60)",
                             str(tmp_path / "experiment" / ".lock")], stdout=subprocess.PIPE)
    try:
        assert held.stdout.readline() == b"held\n"
        with pytest.raises(pfaff.InputError, match="in use"):
            pfaff.run("kepler", "verlet", step=0.1, time=1, out=folder)
    finally:
        held.kill()
        held.wait()
    pfaff.run("kepler", "verlet", step=0.1, time=1, out=folder)


@pytest.mark.parametrize("size, rate, words", [(1.1, 1, "does not begin at the state that it is asked for: q is 1.1 instead of 1"),
                                               (1, 1.01, "does not follow its equations: at the start p changes by -1.01 a unit of time instead of -1")])
def test_errors_are_not_measured_against_another_motion(size, rate, words):
    def solution(elapsed, q, p):
        c, s = np.cos(rate * elapsed), np.sin(rate * elapsed)
        return [size * (q * c + p * s), size * (p * c - q * s)]

    said = pfaff.system(coordinates=["q", "p"], initial=[1, 0], exact_solution=solution, name="said")(lambda q, p: p**2 / 2 + q**2 / 2)
    with pytest.raises(pfaff.InputError, match=words):
        pfaff.run(said, "gauss", step=0.05, time=20)
    assert pfaff.run(said, "gauss", step=0.05, time=20, reference=None).error is None


def test_a_run_says_how_far_its_reference_reaches(tmp_path):
    riccati = pfaff.system(coordinates=["x"], initial=[1], formula="field", name="riccati")(lambda x: [x**2])
    run = pfaff.run(riccati, "rk4", step=0.3, time=1.2, reference="solution", out=tmp_path / "out")  # x = 1/(1 - t)
    assert "largest error 0.107, errors end early: the solution was found up to t = 1" in repr(run) and "errors end early" in run._repr_html_()
    assert "early" not in repr(pfaff.run(riccati, "rk4", step=0.3, time=0.6, reference="solution"))


def test_a_measure_has_nothing_for_the_class_of_a_quantity_that_may_do_anything():
    members = dict(coordinates=["q", "p"], initial=[1, 0], formula="field", behaviours={"place": "free"})
    alone = pfaff.system(**members, name="alone", invariants={"place": lambda q: q})(lambda q, p: [p, -q])
    beside = pfaff.system(**members, name="beside", invariants={"place": lambda q: q, "energy": lambda q, p: q**2 + p**2})(lambda q, p: [p, -q])
    for system, others in ((alone, []), (beside, ["bounded"])):
        table = pfaff.run(system, "gauss", step=0.1, time=10, measures=["drift"]).measures["drift"]
        assert list(table["class"])[0] is None and list(table["evidence"])[0] is None and math.isnan(table["max"][0])
        assert len(table["class"]) == 1 + len(others)
