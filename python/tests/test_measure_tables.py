"""Tables of measures: columns, units, and what is shown of them."""
import pickle

import numpy as np
import pytest

import pfaff
from drawing import no_figure_is_left  # the fixture is in use once it is here


def first_row(run):
    return np.where(run.t == 0, 1.0, np.nan)


@pytest.fixture(scope="module")
def run():
    return pfaff.run("damped-oscillator", "gauss", step=0.05, time=2, measures=["error", "contraction", "drift", first_row])


def test_columns_have_the_units_that_the_measure_states(run):
    error = run.measures["error"]
    assert list(error) == ["step", "error", "energy:error"] and len(error) == 3 and error["error"].shape == (41,)
    assert error.units == {"step": "", "error": "", "energy:error": "m^2/s^2"}
    assert "outline" not in run.measures["contraction"].units and isinstance(run.measures["contraction"]["outline"], list)
    drift = run.measures["drift"]
    assert drift["unit"] == ["m^2/s^2"] * 2 and drift.units["rate"] == "1/s" and drift.units["max"] == ""  # each row has its own
    assert run.measures["first-row"].units == {"t": "s", "first-row": ""}
    with pytest.raises(KeyError, match="did you mean 'energy:error'"):
        error["enrgy:error"]
    kept = pickle.loads(pickle.dumps(error))
    assert kept.units == error.units and np.array_equal(kept["error"], error["error"])


def test_axes_have_the_unit_of_a_column(run):
    axes = run.plot("error: energy:error")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("t [s]", "error: energy:error [m^2/s^2]")
    assert run.plot("error: error").get_ylabel() == "error: error" and run.plot("contraction: area").get_ylabel() == "contraction: area"
    for kind in ("contraction: outline", "error: step", "first-row: first-row"):
        with pytest.raises(pfaff.InputError, match="unknown plot"):
            run.plot(kind)


def test_tables_are_shown_with_units(run):
    lines = repr(run.measures["error"]).splitlines()
    assert lines[0] == "measure error: 41 rows" and lines[1].split("  ")[-1].strip() == "energy:error [m^2/s^2]"
    assert "<th>energy:error [m^2/s^2]</th>" in run.measures["error"]._repr_html_()
    assert max(map(len, repr(run.measures["contraction"]).splitlines())) < 100  # texts are cut, which are outlines of 1000 letters


def test_data_frames_have_units(run):
    pytest.importorskip("pandas")
    frame = run.measures["error"].to_pandas()
    assert frame.attrs["units"]["energy:error"] == "m^2/s^2" and len(frame) == 41
    units = pfaff.run("spherical-pendulum", "rattle", step=0.1, time=1).to_pandas().attrs["units"]
    assert units["x"] == "m" and units["energy"] == "J" and units["constraint"] == "1"


def test_a_table_says_why_it_ends_early():
    riccati = pfaff.system(coordinates=["x"], initial=[1], formula="field", name="riccati")(lambda x: [x**2])
    run = pfaff.run(riccati, "rk4", step=0.3, time=1.2, measures=["error"])  # x = 1/(1 - t)
    table = run.measures["error"]
    assert "solution" in table.ended and f"; it ends early: {table.ended}" in repr(table).splitlines()[0]
