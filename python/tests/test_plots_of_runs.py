"""What figures say of runs: units, legends that name the runs, lines that differ in grey, and ranges that can be read."""
import numpy as np
import pytest

import pfaff
from pfaff import plots
from pfaff._style import families as report_families
from drawing import T, Z, matplotlib, no_figure_is_left  # the fixture is in use once it is here


@pytest.fixture(scope="module")
def spherical():
    return pfaff.run("spherical-pendulum", "rattle", step=0.01, time=1)


@pytest.fixture(scope="module")
def kepler():
    return [pfaff.run("kepler", method, step=0.05, time=5) for method in ("gauss", "rk4")]


def legend(axes):
    return [] if axes.get_legend() is None else [entry.get_text() for entry in axes.get_legend().get_texts()]


def test_an_axis_has_the_unit_that_its_curves_share(spherical):
    assert spherical.plot(coordinates="x").get_ylabel() == "x [m]"
    axes = spherical.plot(coordinates=["x", "z"])
    assert axes.get_ylabel() == "x, z [m]" and legend(axes) == ["x", "z"]
    portrait = spherical.plot("phase portrait")
    assert (portrait.get_xlabel(), portrait.get_ylabel()) == ("x [m]", "p_x [kg m/s]")
    energy = plots.drift(T, {"energy": 1 + 1e-9 * T}, units={"energy": "J"})
    assert energy.get_ylabel() == "difference from the start [J]" and legend(energy) == ["energy"]
    assert plots.drift(T, {"energy": 1 + 1e-9 * T}, units={"energy": "J"}, relative=True).get_ylabel() == "relative difference from the start"


def test_different_units_of_one_axis_stand_in_the_legend(spherical):
    axes = spherical.plot(coordinates=["x", "p_x"])
    assert axes.get_ylabel() == "" and legend(axes) == ["x [m]", "p_x [kg m/s]"]
    drift = spherical.plot("drift")
    assert drift.get_ylabel() == "difference from the start"
    assert legend(drift) == ["energy [J]", "angular-momentum-z [kg m^2/s]"]
    later = plots.trajectory(T, Z, ["q", "p"], coordinates="q", units={"q": "m"})
    plots.trajectory(T, Z, ["q", "p"], coordinates="p", units={"p": "m/s"}, axes=later)
    assert later.get_ylabel() == "" and legend(later) == ["q [m]", "p [m/s]"]


def test_time_has_a_unit_only_where_something_else_has_one(spherical, kepler):
    @pfaff.system(coordinates=["q", "p"], initial=[0.5, 0])
    def without(q, p):
        return p**2 / 2 + q**4 / 4

    run = pfaff.run(without, "verlet", step=0.1, time=2)
    assert [run.plot(kind).get_xlabel() for kind in ("trajectory", "drift", "structure residual")] == ["t"] * 3
    assert kepler[0].plot().get_xlabel() == "t" and spherical.plot().get_xlabel() == "t [s]"


def test_runs_in_one_figure_are_named(kepler):
    gauss, rk4 = kepler
    axes = gauss.plot("drift")
    assert legend(axes) == list(gauss.drift)
    rk4.plot("drift", axes=axes)
    assert legend(axes) == [f"{name}: {one}" for name in ("gauss", "rk4") for one in gauss.drift]
    coarse, fine = (pfaff.run("pendulum", "verlet", step=step, time=2) for step in (0.2, 0.1))
    axes = fine.plot("drift", axes=coarse.plot("drift"))
    assert legend(axes) == ["verlet, step 0.2: energy", "verlet, step 0.1: energy"]


def test_a_label_stands_before_the_entries(kepler, spherical):
    gauss, rk4 = kepler
    for kind in ("error", "structure residual"):
        axes = rk4.plot(kind, label="Runge", axes=gauss.plot(kind, label="Gauss"))
        assert legend(axes) == [f"Gauss: {kind}", f"Runge: {kind}"] and axes.get_ylabel() == kind
    axes = rk4.plot("error", axes=gauss.plot("error"))
    assert legend(axes) == ["gauss: error", "rk4: error"]
    assert legend(rk4.plot("phase portrait", label="Runge", axes=gauss.plot("phase portrait", label="Gauss"))) == ["Gauss", "Runge"]
    assert legend(rk4.plot(coordinates="q1", label="Runge")) == ["Runge: q1"]
    assert legend(spherical.plot("constraints", label="a")) == [f"a: {name}" for name in spherical.constraints]


def test_what_the_caller_wrote_stays(kepler):
    gauss, rk4 = kepler
    axes = gauss.plot("error")
    axes.get_lines()[0].set_label("mine")
    axes.set(xlabel="time", ylabel="wrong by", ylim=(1e-9, 1))
    rk4.plot("error", axes=axes)
    assert legend(axes) == ["mine", "rk4: error"] or legend(axes) == ["mine", "error"]
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_ylim()) == ("time", "wrong by", (1e-9, 1))


def test_lines_differ_in_grey(spherical):
    lines = spherical.plot().get_lines()
    assert len({line._unscaled_dash_pattern if hasattr(line, "_unscaled_dash_pattern") else line._dash_pattern for line in lines}) == 6
    colours = [matplotlib.colors.to_rgb(line.get_color()) for line in lines[:4]]
    greys = sorted(0.299 * r + 0.587 * g + 0.114 * b for r, g, b in colours)
    assert min(np.diff(greys)) > 0.04
    families = {family.light for family in report_families()["FAMILIES"]}
    assert {line.get_color() for line in lines} <= families


def test_lines_that_have_the_same_dashes_differ_in_their_marks(kepler):
    lines = kepler[1].plot("drift", axes=kepler[0].plot("drift")).get_lines()
    looks = [(str(line._unscaled_dash_pattern if hasattr(line, "_unscaled_dash_pattern") else line._dash_pattern), line.get_marker()) for line in lines]
    assert len(lines) == 8 and len(set(looks)) == 8
    empty = plots.trajectory([], np.empty((0, 9)), list("abcdefghi"))
    plots.trajectory(T[:1], np.ones((1, 9)), list("abcdefghi")).figure.canvas.draw()
    plots.trajectory(T[:2], np.full((2, 9), np.nan), list("abcdefghi")).figure.canvas.draw()
    empty.figure.canvas.draw()


def test_axes_of_the_caller_have_the_same_style(kepler):
    from matplotlib import pyplot

    given, own = kepler[0].plot("drift", axes=pyplot.subplots()[1]), kepler[0].plot("drift")
    for axes in (given, own):
        axes.figure.canvas.draw()

    def style(axes):
        line, grid, tick = axes.get_lines()[1], axes.get_xgridlines()[0], axes.get_xticklabels()[0]
        spines = {side: (spine.get_visible(), spine.get_edgecolor()) for side, spine in axes.spines.items()}
        return [line.get_color(), line.get_linestyle(), line.get_linewidth(), grid.get_visible(), matplotlib.colors.to_rgb(grid.get_color()),
                grid.get_linewidth(), matplotlib.colors.to_rgb(tick.get_color()), tick.get_size(), axes.xaxis.label.get_size(),
                axes.xaxis.label.get_color(), axes.get_legend().get_texts()[0].get_size(), spines]

    assert style(given) == style(own)


def overlaps(axes):
    """How many samples of curves lie under the legend."""
    axes.figure.canvas.draw()
    box = axes.get_legend().get_window_extent()
    return sum(int(box.contains(*axes.transData.transform(point))) for line in axes.get_lines() for point in np.array(line.get_data()).T)


def test_legends_hide_nothing():
    run = pfaff.run("spherical-pendulum", "rattle", step=0.01, time=10)
    for axes in (run.plot(), run.plot("constraints"), run.plot("drift")):
        assert overlaps(axes) == 0
        figure, box = axes.figure.bbox, axes.get_legend().get_window_extent()
        assert box.x1 <= figure.x1 and box.y0 >= figure.y0


def test_long_legends_are_cut():
    run = pfaff.run("fermi-pasta-ulam-tsingou", "verlet", step=0.1, time=2)
    axes = run.plot()
    assert len(axes.get_lines()) == 64 and legend(axes)[-2:] == ["q15", "and 49 more"]
    assert overlaps(axes) == 0 and axes.get_legend().get_window_extent().y0 >= 0


def test_one_point_has_a_mark():
    run = pfaff.run("pendulum", "verlet", step=0.1, time=0.1, measures=["reversibility"])
    assert run.plot("reversibility: distance").get_lines()[0].get_marker() == "o"
    assert plots.measure(T[:2], [np.nan, 2.0], "x").get_lines()[0].get_marker() == "o"
    assert plots.drift(T[:2], {"energy": [1, 1.5]}).get_lines()[0].get_marker() == "o"
    assert plots.measure(T, T, "x").get_lines()[0].get_marker() == "None"
    assert len(plots.drift(T[:1], {"energy": [1.0]}).get_lines()) == 1


def test_noise_is_drawn_as_points(spherical):
    noise = 1e-16 * (1 + np.random.default_rng(1).random(200))
    line = plots.measure(np.arange(200.0), noise, "residual").get_lines()[0]
    assert line.get_linestyle() == "None" and line.get_marker() != "None"
    smooth = plots.measure(np.arange(200.0), 2 + np.sin(np.arange(200) / 3), "residual").get_lines()[0]
    assert smooth.get_linestyle() == "-"
    first, second = plots.drift(np.arange(200.0), {"a": 1 + noise * 9, "b": 1 + noise[::-1] * 9}).get_lines()
    assert first.get_marker() != second.get_marker() and first.get_fillstyle() != second.get_fillstyle()


def test_residuals_that_are_zero_stand_below_the_others():
    run = pfaff.run("polar-double-pendulum", "projected-gauss", step=0.01, time=1)
    exact, hidden = run.plot("constraints").get_lines()
    assert (run.constraints["constraint"] == 0).all() and 0 < exact.get_ydata().max() < run.constraints["hidden-constraint"].max()
    assert len(set(exact.get_ydata())) == 1 and exact.get_ydata()[0] <= hidden.get_ydata().min()


@pytest.mark.filterwarnings("error")
def test_what_is_not_finite_is_left_out():
    values = [1, np.inf, 1.5, np.nan, 1.25]
    line = plots.drift(T[:5], {"energy": values}).get_lines()[0]
    assert line.get_ydata()[[1, 3]] == pytest.approx([0.5, 0.25]) and not np.isfinite(line.get_ydata()[[0, 2]]).any()
    for draw in (lambda: plots.trajectory(T[:5], np.reshape(values, (5, 1)), ["q"]), lambda: plots.measure(T[:5], values, "x"),
                 lambda: plots.drift([], {"energy": []}), lambda: plots.trajectory([], np.empty((0, 2)), ["q", "p"])):
        draw().figure.canvas.draw()


def tick_labels(axis):
    axis.figure.canvas.draw()
    return [label.get_text() for label in axis.get_ticklabels()], axis.get_offset_text().get_text()


def test_what_is_round_off_is_not_magnified():
    axes = plots.trajectory(T, np.column_stack([1 + 2e-16 * (np.arange(61) % 2), Z[:, 0]]), ["r", "p"], coordinates="r")
    assert axes.get_ylim() == pytest.approx((0.95, 1.05)) and tick_labels(axes.yaxis)[1] == ""
    plots.trajectory(T, Z, ["q", "p"], axes=axes)
    assert axes.get_ylim()[0] < -1  # the range is that of all
    residual = plots.measure(T, 1e-7 * (1 + 1e-9 * T), "structure residual")
    low, high = residual.get_ylim()
    assert low < 1e-7 and high >= 1e-6 and len(set(tick_labels(residual.yaxis)[0])) == len(tick_labels(residual.yaxis)[0])
    kept = plots.drift(T, {"energy": 5 + 8.9e-16 * (np.arange(61) % 2)}).get_lines()[0].get_ydata()
    assert kept.min() == pytest.approx(2.0**-53 * 5, rel=1e-3)  # and no zeros far below


@pytest.mark.parametrize("kind, keyword, words", [
    ("trajectory", "cordinates", "did you mean 'coordinates'"), ("drift", "realtive", "did you mean 'relative'"), ("error", "lable", "did you mean 'label'"),
    ("phase portrait", "axis", "did you mean 'axes'"), ("constraints", "colour", "unknown argument 'colour'"), ("trajectory", "units", "unknown argument 'units'")])
def test_misspelt_arguments_are_named(spherical, kepler, kind, keyword, words):
    run = kepler[0] if kind == "error" else spherical
    with pytest.raises(pfaff.InputError, match=words) as refused:
        run.plot(kind, **{keyword: "x"})
    assert "\n" not in str(refused.value)


def test_runs_that_differ_by_parameters_or_systems_are_told_apart():
    axes = pfaff.run("pendulum", "verlet", step=0.1, time=5).plot("drift")
    for omega in (1, 2):
        pfaff.run("pendulum", "verlet", step=0.2, time=5, omega=omega).plot("drift", axes=axes)
    pfaff.run("harmonic-oscillator", "verlet", step=0.2, time=5, omega=2).plot("drift", axes=axes)
    entries = [text.get_text() for text in axes.get_legend().get_texts()]
    assert len(set(entries)) == 4, entries
    assert any("pendulum, omega=2" in entry for entry in entries) and any("harmonic-oscillator, omega=2" in entry for entry in entries)


def test_times_of_one_axis_have_one_unit():
    @pfaff.system(coordinates=["q", "p"], initial=[1, 0], time_unit="h")
    def slow(q, p):
        return p**2 / 2 + q**2 / 2

    axes = pfaff.run(slow, "verlet", step=0.1, time=5).plot("drift")
    with pytest.raises(pfaff.InputError, match="those that are there are in h"):
        pfaff.run("pendulum", "verlet", step=0.1, time=5).plot("drift", axes=axes)
    pfaff.run(slow, "verlet", step=0.2, time=5).plot("drift", axes=axes)
    pfaff.run("pendulum", "verlet", step=0.1, time=5).plot("phase portrait", axes=axes)  # has no axis of times
