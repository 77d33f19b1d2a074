"""Animations: bodies stand where the state says, and rods are those of the system and no others."""
import numpy as np
import pytest

import pfaff
from pfaff import plots
from drawing import T, no_figure_is_left  # the fixture is in use once it is here

pytestmark = pytest.mark.filterwarnings("ignore:Animation was deleted")


def picture(animation, frame):
    """The places of the bodies in a picture, and the rods as pairs of ends, {(x, y), (x, y)}."""
    animation._draw_frame(frame)
    animation._draw_was_started = True  # nothing is shown
    lines = [np.array(line.get_data()).T for line in animation._fig.axes[0].get_lines()]
    marked = [line.get_linestyle() == "None" for line in animation._fig.axes[0].get_lines()]
    rods = [line for line, mark in zip(lines, marked) if not mark]
    return lines[-1], {frozenset(ends_of(rod)) for rod in rods}


def ends_of(rod):
    return [(round(float(x), 9) + 0.0, round(float(y), 9) + 0.0) for x, y in rod]


def rods_of(run, expected, **keywords):
    """Compares the rods of a picture with the expected pairs of ends, numbers of bodies or places."""
    places, rods = picture(run.plot("animation", **keywords), len(run.t) - 1)
    ends = [[places[end] if isinstance(end, int) else end for end in pair] for pair in expected]
    return rods == {frozenset(ends_of(pair)) for pair in ends} and len(rods) == len(expected)


# The human figure as docs/bead-rod.md and systems/bead_rod/humanoid.cpp have it; others by their pictures in words.
HUMAN = [(0, 1), (1, 2), (2, 3), (3, 4), (1, 5), (5, 6), (6, 7), (1, 8), (8, 9), (9, 10), (8, 11), (11, 12)]
RODS = {
    "n-pendulum": ("rattle", [([0, 0], 0), (0, 1), (1, 2), (2, 3)]),
    "chain-molecule": ("rattle", [(k, k + 1) for k in range(7)]),
    "ring": ("rattle", [*((k, k + 1) for k in range(7)), (7, 0)]),
    "four-bar": ("rattle", [([0, 0], 0), (0, 1), (1, [2, 0])]),
    "skate-chain": ("gauss", [([0, 0], 0), (0, 1), (1, 2), (2, 3)]),
    "bead-rod": ("rattle", [([0, 0], 0), (0, 1)]),
}


@pytest.mark.parametrize("name", RODS)
def test_rods_are_the_constraints_of_the_system(name):
    method, rods = RODS[name]
    assert rods_of(pfaff.run(name, method, step=0.005, time=0.05), rods)


def test_a_human_figure_is_joined_as_it_is():
    run = pfaff.run("humanoid", "projected-gauss", step=0.01, time=0.1)
    animation = run.plot("animation")
    places, _ = picture(animation, len(run.t) - 1)
    lines = [np.array(line.get_data()).T for line in animation._fig.axes[0].get_lines()][: len(HUMAN)]
    assert len(animation._fig.axes[0].get_lines()) == len(HUMAN) + 1  # and the bodies: nothing hangs on the origin
    assert [line == pytest.approx(places[list(pair)]) for line, pair in zip(lines, HUMAN)] == [True] * len(HUMAN)


def test_every_system_of_beads_has_a_rod_for_each_constraint_of_length():
    for name in pfaff.systems():
        system = pfaff.System(name)
        if "x0" in system.coordinates:
            assert name in [*RODS, "humanoid"], name


def two_bodies(**formulas):
    @pfaff.system(coordinates=["x0", "y0", "x1", "y1", "px0", "py0", "px1", "py1"], initial=[0, 0, 3, 4, 0, 0, 0, 0], **formulas)
    def two(q, p):
        return p @ p / 2 + q[1] + q[3]

    return two


@pytest.mark.parametrize("constraint, rods", [
    (lambda q: (q[0] - q[2]) ** 2 + (q[1] - q[3]) ** 2 - 25, [(0, 1)]),
    (lambda q: np.sqrt((q[0] - q[2]) ** 2 + (q[1] - q[3]) ** 2) - 5, [(0, 1)]),
    (lambda q: (q[2] - 3) ** 2 / 2 + q[3] ** 2 / 2 - 8, [(1, [3, 0])]),
    (lambda q: q[1] - q[3] + 4, []),  # of equal height but for 4
    (lambda q: q[0] + q[2] - 3, []),
    (lambda q: q[0] + q[1], []),
], ids=["length", "root", "fixed place", "height", "sum", "line"])
def test_constraints_of_systems_in_python_are_rods_where_they_hold_apart(constraint, rods):
    run = pfaff.run(two_bodies(holonomic=constraint), "rattle", step=0.01, time=0.1)
    assert rods_of(run, rods)


def test_no_rods_are_where_none_are_and_others_are_drawn_when_asked_for():
    run = pfaff.run(two_bodies(), "verlet", step=0.01, time=0.1)
    assert rods_of(run, [])
    assert rods_of(run, [(0, 1), (-1, 0)], rods=[(0, 1), (-1, 0)]) is False  # -1 is the origin, no last body
    assert rods_of(run, [(0, 1), ([0, 0], 0), (1, [2, 2])], rods=[(0, 1), (-1, 0), (1, [2, 2])])
    hanging = pfaff.run("n-pendulum", "rattle", step=0.01, time=0.1)
    assert rods_of(hanging, [], rods=[])


@pytest.mark.parametrize("name, method, parameters", [
    ("pendulum", "verlet", {}), ("damped-pendulum", "rk4", {}), ("n-pendulum-angles", "gauss", {"bobs": 3, "length": "1/2"}),
    ("polar-double-pendulum", "projected-gauss", {"l2": 0.7}), ("spherical-pendulum", "rattle", {"length": 2}), ("shaken-pendulum", "rattle", {})])
def test_pendula_are_shown_with_rods_of_their_lengths(name, method, parameters):
    run = pfaff.run(name, method, step=0.01, time=0.5, **parameters)
    lengths = {"n-pendulum-angles": [0.5] * 3, "polar-double-pendulum": [1, 0.7], "spherical-pendulum": None}.get(name, [1])
    animation = run.plot("animation")
    places, _ = picture(animation, len(run.t) - 1)
    rods = [np.array(line.get_data()) for line in animation._fig.axes[0].get_lines() if line.get_linestyle() != "None"]
    found = [np.hypot(*(rod[:, 1] - rod[:, 0])) for rod in rods]
    if lengths is None:
        assert rods[0][:, 1] == pytest.approx(run.y[-1, [0, 2]]) and rods[0][:, 0] == pytest.approx([0, 0])
    else:
        assert found == pytest.approx(lengths, rel=1e-4)


def test_angles_are_counted_from_below():
    run = pfaff.run("pendulum", "verlet", step=0.01, time=0.5)
    places, _ = picture(run.plot("animation"), 30)
    assert places[0] == pytest.approx([np.sin(run["q"][30]), -np.cos(run["q"][30])])
    run = pfaff.run("polar-double-pendulum", "projected-gauss", step=0.01, time=0.5)
    (r1, a, r2, b), (first, second) = run.y[30, :4], picture(run.plot("animation"), 30)[0]
    assert first == pytest.approx([r1 * np.sin(a), -r1 * np.cos(a)])
    assert second - first == pytest.approx([r2 * np.sin(b), -r2 * np.cos(b)])


def test_positions_are_what_a_function_of_the_state_says():
    run = pfaff.run("kepler", "gauss", step=0.05, time=1)
    places, rods = picture(run.plot("animation", positions=lambda z: [[0, 0], z[:2]], rods=[(0, 1)]), 10)
    assert places == pytest.approx(np.array([[0, 0], run["q"][10]])) and len(rods) == 1
    for positions, words in [(3, "expected a function of a state"), (lambda z: z, "got shape \\(4,\\)"), (lambda z: "a", "expected a function of a state")]:
        with pytest.raises(pfaff.InputError, match=f"positions: .*{words}"):
            run.plot("animation", positions=positions)
    with pytest.raises(pfaff.InputError, match="got kepler; give positions"):
        run.plot("animation")
    with pytest.raises(pfaff.InputError, match="did you mean 'frames'"):
        run.plot("animation", positions=lambda z: [z[:2]], frame=3)


def test_pictures_have_units_and_the_time():
    run = pfaff.run("n-pendulum", "rattle", step=0.01, time=0.1)
    animation = run.plot("animation", frames=3)
    axes = animation._fig.axes[0]
    picture(animation, 10)
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_title()) == ("x [m]", "y [m]", "t = 0.1 s")
    in_space = pfaff.run("chain-molecule", "rattle", step=0.001, time=0.01).plot("animation", frames=3)
    picture(in_space, 0)
    assert in_space._fig.axes[0].get_ylabel() == "z [m]"


def test_bodies_move_as_they_are_told():
    places = np.stack([np.column_stack([np.sin(T), -np.cos(T)]), np.column_stack([2 * np.sin(T), -2 * np.cos(T)])], axis=1)
    animation = plots.bodies(T, places, frames=5)
    assert picture(animation, 30)[0] == pytest.approx(places[30])
    html = animation.to_jshtml()
    assert html.count("data:image/png") >= 5


@pytest.mark.parametrize("positions, rods, words", [
    (np.zeros((61, 2)), None, "expected positions of shape"),
    (np.zeros((61, 2, 2)), [(0, 2)], "expected rods between bodies 0 .. 1"),
    (np.zeros((61, 2, 2)), [(0, 1, 1)], "expected rods between bodies 0 .. 1"),
    (np.zeros((61, 2, 2)), [(0, [1, 2, 3])], "expected rods between bodies 0 .. 1"),
    (np.zeros((61, 2, 2)), [(0, 0.5)], "expected rods between bodies 0 .. 1"),
])
def test_bad_input_is_refused_in_one_line(positions, rods, words):
    with pytest.raises(pfaff.InputError) as refused:
        plots.bodies(T, positions, rods=rods)
    assert words in str(refused.value) and "\n" not in str(refused.value)
