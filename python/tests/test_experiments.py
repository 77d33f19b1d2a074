"""Experiments from Python: by name, file and dictionary, with methods and systems that are objects."""
import json
import pathlib
import re
import shutil

import numpy as np
import pytest

import pfaff

SWING = {
    "title": "A pendulum that swings",
    "method": [{"label": "Verlet", "integrator": "verlet"}, {"label": "Gauss 4", "integrator": "gauss", "set": {"stages": 2}}],
    "case": [{"name": "swing", "system": "pendulum", "time": 4, "steps": [0.2, 0.1]}],
}


@pfaff.method(order=2, preserves=["symplectic"], needs=["separable"])
def leap(problem, t, h, z):
    n = len(z) // 2
    q, p = z[:n], z[n:]
    q = q + h / 2 * problem.velocity(t, p)
    p = p + h * problem.force(t + h / 2, q)
    return np.concatenate([q + h / 2 * problem.velocity(t + h, p), p])


@pytest.fixture(scope="module")
def swing():
    return pfaff.compare(SWING, methods=[leap], timing=0.005)


def test_a_dictionary_is_run_with_a_method_of_python_beside_its_own(swing):
    assert swing.ok and swing.runs == 6 and swing.failed == 0
    assert set(swing.table["method"]) == {"Verlet", "Gauss 4", "leap"}
    errors = {(row["method"], row["step"]): row["error_max"] for row in swing.table}
    # The method of Python is Verlet's, so that errors agree to the rounding of some 40 steps.
    for step in (0.2, 0.1):
        assert errors["leap", step] == pytest.approx(errors["Verlet", step], rel=1e-9)
    # Orders 2 and 4: halving the step divides errors by about 4 and 16.
    assert 3.5 < errors["Verlet", 0.2] / errors["Verlet", 0.1] < 4.5
    assert 13 < errors["Gauss 4", 0.2] / errors["Gauss 4", 0.1] < 19


def test_methods_may_all_be_objects():
    found = pfaff.compare({key: value for key, value in SWING.items() if key != "method"}, methods=[leap, "gauss"], timing=0.005)
    assert set(found.table["method"]) == {"leap", "gauss"}
    frame = found.work_precision.to_pandas()
    assert list(frame.columns) == ["case", "method", "work", "error"] and len(frame) == found.runs


def test_work_and_precision_are_those_of_the_tables(swing):
    curves = swing.work_precision.curves["swing"]
    work, error = curves["Verlet"]
    assert set(curves) == {"Verlet", "Gauss 4", "leap"} and work.shape == error.shape == (2,)
    costs = [row["ns_per_step"] / row["step"] for row in swing.cost if row["method"] == "Verlet"]
    assert sorted(costs) == pytest.approx(list(work))
    pytest.importorskip("matplotlib").use("agg")
    axes = swing.work_precision.plot()
    assert {line.get_label() for line in axes.get_lines()} == set(curves) and axes.get_xscale() == "log"
    assert swing._repr_html_().count("<svg") == 1 and "A pendulum that swings" in repr(swing)


def test_tables_are_arrays_and_data_frames(swing):
    assert swing.table["error_max"].dtype == float and len(swing.table) == 6
    pytest.importorskip("pandas")
    frame = swing.to_pandas()
    assert list(frame["method"]) == list(swing.table["method"]) and frame["error_max"].dtype == float


def test_a_method_that_does_not_fit_is_left_out_with_its_reason():
    found = pfaff.compare({**SWING, "case": [{**SWING["case"][0], "system": "damped-pendulum"}],
                           "method": [{"label": "RK4", "integrator": "rk4"}]}, methods=[leap], timing=0.005)
    assert set(found.table["method"]) == {"RK4"}
    assert found.left_out[0][:2] == ("swing", "leap") and "needs separable" in found.left_out[0][2]


def test_a_system_of_python_and_a_report(tmp_path):
    @pfaff.system(coordinates=["q", "p"], initial=[0.5, 0.2])
    def well(q, p):
        return p**2 / 2 + q**4 / 4

    experiment = {**SWING, "case": [{"name": "well", "system": well, "time": 4, "steps": [0.2, 0.1]}]}
    found = pfaff.compare(experiment, out=tmp_path / "out", report=True, timing=0.005)
    assert found.ok and found.report == tmp_path / "out" / "report.html" and found.sentences
    assert "pfaff compare experiment.toml" in found.report.read_text()  # a file that is left beside it
    assert pfaff.compare(found.directory / "experiment.toml", timing=0.005).runs == 4
    again = pfaff.compare(experiment, out=tmp_path / "out", timing=0.005)
    assert again.runs == 4 and json.loads((tmp_path / "out" / "experiment.json").read_text())["title"] == SWING["title"]


def test_one_that_ships_is_run_by_its_name():
    assert "kepler" in pfaff.experiments()
    found = pfaff.compare("contact-particle", quick=True, timing=0.005)
    assert found.ok and found.runs > 0 and re.search("contact", found.title, re.I)


def test_temporary_results_go_with_the_object():
    found = pfaff.compare(SWING, timing=0.005)
    directory = pathlib.Path(found.directory)
    assert (directory / "results.csv").exists()
    del found
    assert not directory.exists()


@pytest.mark.parametrize("call, words", [
    (lambda: pfaff.compare("keplr"), "did you mean 'kepler'?"),
    (lambda: pfaff.compare({**SWING, "tilte": 1}), "'title'"),
    (lambda: pfaff.compare(SWING, methods=["verlt"]), "did you mean 'verlet'?"),
    (lambda: pfaff.compare(SWING, timing=0), "timing: expected a time above 0 s"),
    (lambda: pfaff.compare("derive", methods=["verlet"]), "no integrators"),
])
def test_bad_input_is_refused_in_one_line(call, words):
    with pytest.raises(pfaff.InputError) as refused:
        call()
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_objects_are_not_mixed_with_earlier_runs(tmp_path):
    pfaff.compare(SWING, out=tmp_path, timing=0.005)
    with pytest.raises(pfaff.InputError, match="expected a new directory"):
        pfaff.compare(SWING, methods=[leap], out=tmp_path, timing=0.005)


def test_a_column_that_is_not_there_is_named(swing):
    with pytest.raises(pfaff.InputError, match="did you mean 'error_max'"):
        swing.table["eror_max"]


def test_an_interrupted_experiment_is_resumed(tmp_path):
    import signal
    import threading

    main = threading.main_thread().ident
    long = {**SWING, "case": [{"name": "swing", "system": "pendulum", "time": 1000, "steps": [0.1, 0.01, 0.001, 0.0001]}]}
    for out, words in ((None, r"runs are in (\S+); with out= of it the same call resumes"), (tmp_path, "the same call resumes")):
        timer = threading.Timer(0.4, lambda: signal.pthread_kill(main, signal.SIGINT))
        timer.start()
        with pytest.raises(pfaff.Interrupted, match=words) as interrupted:
            pfaff.compare(long, out=out, timing=0.3)
        directory = out or pathlib.Path(re.search(words, str(interrupted.value))[1])
        made = len(list(directory.glob("runs/*/summary.json")))
        short = pfaff.compare(long, out=directory, timing=0.005)
        assert short.ok and short.runs == 8 and short.resumed == made > 0
        shutil.rmtree(directory)


def test_a_system_of_python_is_shown_by_its_name(tmp_path):
    swing = pfaff.system(coordinates=["q", "p"], initial=[1, 0], name="swing")(lambda q, p: p**2 / 2 - np.cos(q))
    case = {"name": "free", "system": swing, "time": 1, "steps": [0.1]}
    found = pfaff.compare({"title": "A swing", "method": [{"label": "Verlet", "integrator": "verlet"}], "case": [case]}, timing=0.01, out=tmp_path / "out")
    assert "free (swing, T = 1), drift of energy" in found.text and ".toml" not in found.text
    assert list(found.table["system"]) == ["swing"]
    described = json.loads((tmp_path / "out" / "experiment.json").read_text())["cases"][0]
    assert described["model"] == "swing" and described["conserved"] == "energy"
