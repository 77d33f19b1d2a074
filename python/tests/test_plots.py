"""Plots: what is drawn is what was given, in the style of the report."""
import numpy as np
import pytest

import pfaff
from pfaff import plots
from drawing import T, Z, matplotlib, no_figure_is_left  # the fixture is in use once it is here


def drawn(line):
    return np.array(line.get_data())


def test_a_trajectory_has_a_line_for_each_coordinate():
    axes = plots.trajectory(T, Z, ["q", "p"], time_unit="s")
    assert np.array_equal(drawn(axes.get_lines()[1]), [T, Z[:, 1]]) and axes.get_xlabel() == "t [s]"
    assert len(plots.trajectory(T, Z, ["q", "p"], coordinates="p").get_lines()) == 1


def test_a_phase_portrait_has_one_coordinate_against_another():
    axes = plots.phase_portrait(T, Z, ["q", "p"])
    assert np.array_equal(drawn(axes.get_lines()[0]), Z.T) and (axes.get_xlabel(), axes.get_ylabel()) == ("q", "p")
    four = plots.phase_portrait(T, np.hstack([Z, 2 * Z]), ["q1", "q2", "p1", "p2"])
    assert (four.get_xlabel(), four.get_ylabel()) == ("q1", "p1")


def test_drift_is_the_difference_from_the_start():
    axes = plots.drift(T, {"energy": 0.5 + 1e-9 * T, "constant": np.ones_like(T)}, relative=True)
    energy, constant = axes.get_lines()
    assert drawn(energy)[1] == pytest.approx(2e-9 * T[1:], rel=1e-6) and axes.get_yscale() == "log"
    assert (drawn(constant)[1] > 0).all()  # zeros have a place below the scale


def test_a_measure_leaves_out_what_was_not_measured():
    values = np.where(np.arange(61) % 2 == 0, 1e-16, np.nan)
    axes = plots.measure(T, values, "structure residual")
    assert drawn(axes.get_lines()[0]).shape == (2, 31) and axes.get_yscale() == "log"
    assert plots.measure(T, Z[:, 0], "q").get_yscale() == "linear"


def test_work_and_precision_have_the_colours_of_families():
    curves = {"Gauss": ([1, 2], [1e-3, 1e-6]), "Verlet": ([0.5, 1], [1e-2, 2e-3])}
    lines = plots.work_precision(curves, families={"Gauss": "gauss", "Verlet": "splitting"}).get_lines()
    assert [line.get_color() for line in lines] == ["#8f3413", "#157b62"]


def test_a_run_is_drawn_by_the_kind_of_plot():
    run = pfaff.run("spherical-pendulum", "rattle", step=0.01, time=1, measures=["reversibility"])
    assert np.array_equal(drawn(run.plot(coordinates="x").get_lines()[0]), [run.t, run["x"]])
    assert run.plot("phase portrait", coordinates=["x", "y"]).get_ylabel() == "y [m]"
    assert {line.get_label() for line in run.plot("drift").get_lines()} == {f"{name} [{run.units[name]}]" for name in run.drift}
    assert {line.get_label() for line in run.plot("constraints").get_lines()} == set(run.constraints)
    axes = run.plot("reversibility: distance")
    steps = np.asarray(run.measures["reversibility"]["step"])
    assert axes.get_ylabel() == "reversibility: distance" and drawn(axes.get_lines()[0])[0] == pytest.approx(0.01 * steps)
    with pytest.raises(pfaff.InputError, match="did you mean 'drift'"):
        run.plot("drfit")


def test_the_structure_residual_is_drawn():
    run = pfaff.run("pendulum", "verlet", step=0.1, time=5)
    axes = run.plot("structure residual")
    known = np.isfinite(run.structure)
    assert np.array_equal(drawn(axes.get_lines()[0])[0], run.t[known]) and axes.get_ylabel() == "structure residual"


def test_the_settings_of_the_caller_stay():
    matplotlib.rcdefaults()
    matplotlib.use("agg")
    before = dict(matplotlib.rcParams)
    plots.trajectory(T, Z, ["q", "p"])
    assert dict(matplotlib.rcParams) == before


def test_figures_are_written_and_put_into_pages(tmp_path):
    axes = plots.trajectory(T, Z, ["q", "p"])
    plots.save(axes, tmp_path / "figure.png")
    assert (tmp_path / "figure.png").stat().st_size > 1000
    assert plots.svg(axes).startswith("<svg")


@pytest.mark.parametrize("call, words", [
    (lambda: plots.trajectory(T[1:], Z, ["q", "p"]), "z: expected states of shape (60, 2)"),
    (lambda: plots.trajectory(T, Z, ["q", "p"], coordinates="r"), "unknown coordinate 'r'"),
    (lambda: plots.phase_portrait(T, Z, ["q", "p"], coordinates=["q"]), "expected two coordinates"),
    (lambda: plots.drift(T, {"energy": T[1:]}), "values['energy']: expected 61 numbers, one for each time"),
    (lambda: plots.trajectory(T, Z, ["q", "p"], cordinates="q"), "did you mean 'coordinates'"),
    (lambda: plots.drift(T, {"energy": T}, units={"energy": 3}), "units['energy']: expected a text, got 3"),
])
def test_bad_input_is_refused_in_one_line(call, words):
    with pytest.raises(pfaff.InputError) as refused:
        call()
    assert words in str(refused.value) and "\n" not in str(refused.value)
