"""solve_ivp against closed forms and SciPy's own."""
import functools
import math
import time

import numpy as np
import pytest

import pfaff

integrate = pytest.importorskip("scipy.integrate")


def oscillator(t, y, omega=1.0):
    return [y[1], -(omega**2) * y[0]]


def test_the_error_is_as_asked_and_the_result_is_scipys():
    for tolerance in (1e-4, 1e-8, 1e-11):
        result = pfaff.solve_ivp(oscillator, (0, 20), [1, 0], "gauss", stages=3, rtol=tolerance, atol=tolerance)
        exact = np.array([np.cos(result.t), -np.sin(result.t)])
        assert result.success and result.status == 0 and result.t[-1] == 20 and result.y.shape == (2, len(result.t))
        assert np.abs(result.y - exact).max() < 2 * tolerance  # rtol |y| + atol, |y| <= 1
    assert isinstance(result, integrate._ivp.ivp.OdeResult) and result.nfev > 0 and result.sol is None


def test_times_between_steps_are_as_accurate_as_steps():
    times = np.sort(np.random.default_rng(1).uniform(0, 20, 50))
    result = pfaff.solve_ivp(oscillator, (0, 20), [1, 0], "gauss", times, stages=3, step=0.1)
    assert np.array_equal(result.t, times)
    # h^6 times the length of the run over 6! and more is 3e-9; seen are 1e-9
    assert np.abs(result.y[0] - np.cos(times)).max() < 3e-9


def test_fixed_steps_keep_the_energy_over_a_long_time_where_scipy_does_not():
    result = pfaff.solve_ivp(oscillator, (0, 2000), [1, 0], "gauss", stages=2, step=0.2)
    energy = (result.y**2).sum(axis=0) / 2
    assert np.abs(energy - 0.5).max() < 1e-13  # quadratic, which Gauss keeps; ten thousand roundings, compensated
    other = integrate.solve_ivp(oscillator, (0, 2000), [1, 0])
    assert abs((other.y[:, -1] ** 2).sum() / 2 - 0.5) > 1e-3


def test_args_are_passed_and_time_runs_back():
    result = pfaff.solve_ivp(oscillator, (0, -3), [0, 2], args=(2.0,), rtol=1e-9, atol=1e-9)
    assert result.y[0, -1] == pytest.approx(math.sin(-6), abs=3e-9)


def test_driven_motion_has_its_time():
    result = pfaff.solve_ivp(lambda t, y: [np.cos(t)], (1, 4), [0.0], rtol=1e-10, atol=1e-10)
    assert result.y[0, -1] == pytest.approx(math.sin(4) - math.sin(1), abs=1e-9)


def test_a_method_that_chooses_its_steps_takes_the_tolerances():
    times = [0.5, 3.0, 7.0]
    result = pfaff.solve_ivp(oscillator, (0, 7), [1, 0], "taylor", times, rtol=1e-10, atol=1e-12)
    assert list(result.t) == times and np.abs(result.y[0] - np.cos(times)).max() < 1e-9 and result.step is None


def test_systems_take_methods_that_need_more_than_a_field():
    result = pfaff.solve_ivp("kepler", (0, 1), None, "verlet", step=0.01)
    assert result.y.shape == (4, 101)
    assert result.y[:, 0] == pytest.approx(pfaff.System("kepler").initial)


def test_a_run_that_fails_says_so_and_keeps_what_there_is():
    # y' = y^2 from 1 has a pole at t = 1.
    result = pfaff.solve_ivp(lambda t, y: [y[0] ** 2], (0, 3), [1.0], "gauss", step=0.05)
    assert not result.success and result.status == -1 and result.message and 0.8 < result.t[-1] < 1.2


def test_an_explicit_method_that_fails_says_what_failed():
    result = pfaff.solve_ivp(lambda t, y: [y[0] ** 2], (0, 3), [1.0], "taylor")
    assert not result.success and result.message.startswith("the step control gave up at t = 1.0000")
    assert "implicit" not in result.message and "(step 0)" not in result.message and "no step meets the tolerance" in result.message


@pytest.mark.parametrize("method", ["rk4", "gauss"])
def test_where_no_step_is_found_it_is_said_what_to_give(method):
    with pytest.raises(pfaff.RunFailed, match=f"at t = [01].* with every step of {method} down to .*expected a t_span that ends before, .*or step=") as failed:
        pfaff.solve_ivp(lambda t, y: [y[0] ** 2], (0, 2), [1.0], method, most_steps=2**10)  # the pole of y' = y^2 is at t = 1
    assert "\n" not in str(failed.value) and 0.8 < failed.value.run.t[-1] < 1.1
    with pytest.raises(pfaff.RunFailed, match=f"^solve_ivp: no step of {method} down to 0.0977 meets rtol and atol; expected larger ones, calls that end and begin where the field jumps, step=, .*or a larger most_steps="):
        pfaff.solve_ivp(oscillator, (0, 100), [1, 0], method, rtol=1e-12, atol=1e-12, args=(3.0,), most_steps=2**10)


def test_a_motion_that_never_gets_on_ends_with_its_steps():
    # y = sqrt(1 - 2 t) ends at t = 1/2, behind which steps rattle about zero.
    begin = time.perf_counter()
    result = pfaff.solve_ivp(lambda t, y: [-1 / y[0]], (0, 3), [1.0], "taylor", most_steps=20000)
    assert not result.success and result.status == -1 and 0.4 < result.t[-1] < 0.7 and result.nfev <= 8 * 20000  # degrees of a series
    assert result.message.startswith("20000 steps were taken by t = 0.5") and "most_steps=" in result.message
    assert "as happens at a singularity and, with explicit methods, where the motion is stiff; expected" in result.message
    times = pfaff.solve_ivp(lambda t, y: [-1 / y[0]], (0, 3), [1.0], "taylor", np.linspace(0, 3, 7), most_steps=20000)
    assert list(times.t) == [0, 0.5] and not times.success
    assert pfaff.solve_ivp(lambda t, y: [-1 / y[0]], (0, 0.4), [1.0], "taylor", most_steps=20000).success
    assert time.perf_counter() - begin < 5


@pytest.mark.parametrize("method, settings", [("gauss", {"stages": 3}), ("gauss", {"stages": 6}), ("rk4", {})])
def test_the_error_is_as_asked_where_the_order_is_not_that_of_the_method(method, settings):
    tolerance = 1e-4
    # A jump of the field, behind which steps have the order one, and a transient of a thousandth of the span.
    jump = pfaff.solve_ivp(lambda t, y: [pfaff.where(t - 1 / 3, 1, -1)], (0, 1), [0.0], method, rtol=tolerance, atol=tolerance, **settings)
    assert np.abs(jump.y[0] - (np.abs(jump.t - 1 / 3) - 1 / 3)).max() < tolerance
    fast = pfaff.solve_ivp(lambda t, y: [-1000 * y[0]], (0, 1), [1.0], method, rtol=tolerance, atol=tolerance, **settings)
    assert np.abs(fast.y[0] - np.exp(-1000 * fast.t)).max() < tolerance


def switched(switch):
    return lambda t, y: [y[1], -y[0] + pfaff.where(t - switch, 1, 0)]


def switched_motion(t, switch):
    return np.where(t < switch, np.cos(t), np.cos(t) + 1 - np.cos(t - switch))


@pytest.mark.parametrize("method, settings", [("gauss", {}), ("gauss", {"stages": 4}), ("rk4", {}), ("implicit-midpoint", {})])
def test_no_step_is_taken_that_meets_a_jump_by_chance(method, settings):
    tolerance, shares = 1e-4, []
    for switch in np.random.default_rng(5).uniform(0.5, 9.5, 25):
        result = pfaff.solve_ivp(switched(switch), (0, 10), [1.0, 0.0], method, rtol=tolerance, atol=tolerance, **settings)
        exact = switched_motion(result.t, switch)
        shares.append(np.max(np.abs(result.y[0] - exact) / (tolerance * (1 + np.abs(exact)))))
    # Two runs that have to agree may still do so by chance: of 25 errors that are spread evenly over sixteen tolerances one
    # or two. Runs in steps of halves alone gave medians of 0.9 to 51 and largest ones of up to 310.
    assert np.median(shares) < 0.7 and np.max(shares) < 16


def test_a_jump_that_lies_just_behind_a_step_is_seen():
    # 5.9 is 0.2 steps behind a step where there are 128 of them, and before the first node of Gauss's of all that are halves.
    result = pfaff.solve_ivp(switched(5.9), (0, 10), [1.0, 0.0], rtol=1e-6, atol=1e-6)
    assert np.abs(result.y[0] - switched_motion(result.t, 5.9)).max() < 2e-6  # rtol |y| + atol, |y| <= 2.5, and seen are 6e-7
    with pytest.raises(pfaff.RunFailed, match="^solve_ivp: no step of gauss down to .* meets rtol and atol"):
        pfaff.solve_ivp(switched(5.9), (0, 10), [1.0, 0.0], rtol=1e-10, atol=1e-10, most_steps=2**14)
    # Steps of a tenth and more may miss a pulse of a tenth as a whole, that shorter ones see.
    with pytest.raises(pfaff.RunFailed, match="^solve_ivp: no step of gauss down to .* meets rtol and atol"):
        pfaff.solve_ivp(lambda t, y: [pfaff.where(t - 5.7, pfaff.where(5.8 - t, 10, 0), 0) + 0 * y[0]], (0, 10), [0.0], rtol=1e-8, atol=1e-8, most_steps=2**14)


def test_a_steep_rise_is_no_smooth_one_before_its_steps_are_short():
    for rise in np.random.default_rng(5).uniform(0.5, 9.5, 10):
        result = pfaff.solve_ivp(lambda t, y: [1 / (1 + np.exp((rise - t) * 1e3))], (0, 10), [0.0], rtol=1e-6, atol=1e-6)
        assert abs(result.y[0, -1] - (10 - rise)) < 1e-5  # the tolerance of 10; errors were up to 0.1


def test_smooth_motions_take_the_steps_that_halving_alone_finds():
    for method, tolerance, steps in (("gauss", 1e-6, 2**12), ("gauss", 1e-9, 2**14), ("implicit-midpoint", 1e-3, 2**15)):
        assert round(20 / pfaff.solve_ivp("kepler", (0, 20), None, method, rtol=tolerance, atol=tolerance).step) == steps


def short(t, y):
    return [y[1]]


class Callable:
    def __call__(self, t, y):
        return [y[1]]


@pytest.mark.parametrize("function", [short, functools.partial(short), Callable()])
def test_what_is_wrong_with_a_function_is_said_with_its_line(function):
    line = (Callable.__call__ if isinstance(function, Callable) else short).__code__.co_firstlineno
    with pytest.raises(pfaff.InputError, match=rf"test_solve_ivp.py:{line}: fun returned a list of length 1; expected 2, a rate for each") as refused:
        pfaff.solve_ivp(function, (0, 1), [1.0, 2.0])
    assert "_solve_ivp.py:" not in str(refused.value).replace("test_solve_ivp.py:", "")


def test_other_faults_of_a_function_have_its_line_too():
    numbers = iter(range(100))
    faults = {
        "fun returned nothing; expected numbers": lambda t, y: None,
        "fun returned 'abc'; expected numbers": lambda t, y: "abc",
        "fun: expected a function of t and y: too many positional arguments": lambda t: [t],
        "fun: expected a function of t and y: missing a required argument: 'a'": lambda t, y, a: [a],
    }
    for words, function in faults.items():
        with pytest.raises(pfaff.InputError, match=rf"^[^ ]*test_solve_ivp.py:\d+: {words}$"):
            pfaff.solve_ivp(function, (0, 1), [1.0])
    with pytest.raises(pfaff.InputError, match="fun: expected a function of t and y and what args has, 2: missing"):
        pfaff.solve_ivp(lambda t, y, a, b, c: [a], (0, 1), [1.0], args=(1, 2))
    with pytest.raises(pfaff.TraceError, match=r"^[^ ]*test_solve_ivp.py:\d+: field of system solve-ivp is another formula each time"):
        pfaff.solve_ivp(lambda t, y: [y[0] * next(numbers)], (0, 1), [1.0])


@pytest.mark.parametrize("call, words", [
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], events=lambda t, y: y[0]), "events: not there; expected pfaff.Integration"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], dense_output=True), "dense_output: not there"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], t_eval=[0, 2]), "t_eval: expected times in 0.0 .. 1.0"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 0), [1, 0]), "t_span: expected two different"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1j, 0]), "y0: expected real numbers"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], rtol=-1), "rtol: expected a number above 0"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], "odeint-dopri5", rtol=1e-16), "rtol: 1e-16 is below round-off, which is 2.22e-16; expected at least that"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], rtol=1e-16), "rtol: 1e-16 is below round-off"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], "gaus"), "did you mean 'gauss'?"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], "verlet"), "verlet needs separable"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0, 0]), "3"),
    (lambda: pfaff.solve_ivp("kepler", (0, 1), args=(1,)), "args: expected them beside a function alone"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], step=-0.1), "step: expected a size above 0"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], step=1e-12), "step: 1e-12 makes 1e+12 steps, more than 16777216; expected a larger one, or most_steps="),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], most_steps=0), "most_steps: expected a whole number >= 16, got 0"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], args=3.0), "args: expected a tuple of further arguments of fun, such as (2.0,), got 3.0"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], "taylor", rtol=2), "rtol: expected a number in (0, 1] for taylor, got 2.0"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [0, 0], "taylor", atol=0), "start at rest in zero has none; expected absolute beside it"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], max_step=0.1), "max_step: not there; expected step=, the size of all steps"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), [1, 0], jac=lambda t, y: y), "jac: not there; expected nothing, since derivatives are taken of fun itself"),
    (lambda: pfaff.solve_ivp(oscillator, (0, 1), np.eye(2)), "y0: expected real numbers, all finite, shape (n,), got an array of shape (2, 2)"),
    (lambda: pfaff.solve_ivp(pfaff.system(coordinates=["q", "p"])(lambda q, p: q * p), (0, 1)), "y0: expected 2 numbers, because lambda has no initial state"),
    (lambda: pfaff.solve_ivp("kepler", (0, 1), [1, 0]), "y0: expected shape (4,), a number for each of q1, q2, p1, p2, got 2 numbers"),
])
def test_bad_input_is_refused_in_one_line(call, words):
    with pytest.raises(pfaff.InputError) as refused:
        call()
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_a_function_that_compares_values_is_refused_with_its_line():
    with pytest.raises(pfaff.TraceError, match="test_solve_ivp.py"):
        pfaff.solve_ivp(lambda t, y: [y[0] if y[0] > 0 else 0], (0, 1), [1.0])


def test_times_close_behind_a_step_have_their_own_states():
    times = np.array([0, 9e-11, 0.1, 0.1 + 9e-11, 0.2])
    result = pfaff.solve_ivp(lambda t, y: -y, (0, 1), [1.0], "gauss", times, stages=4, step=0.1)
    assert np.abs(result.y[0] - np.exp(-times)).max() < 1e-15  # h^9 times 1e-9 and less, and round-off


@pytest.mark.parametrize("method", ["extrapolation", "taylor", "odeint-dopri5", "odeint-bulirsch-stoer"])
def test_tolerances_are_relative_to_the_state_as_scipys_are(method):
    """From 1 down to e^-30 and back to 1: an error that is small beside the 1 of the beginning is large beside e^-30."""
    def field(t, y):
        return [-3 * np.sin(t / 5) * y[0]]

    result = pfaff.solve_ivp(field, (0, 10 * math.pi), [1.0], method, rtol=1e-9, atol=1e-30)
    assert result.success and abs(result.y[0, -1] - 1) < 1e-6  # a few hundred steps of 1e-9 each; 2e-2 relative to the largest
    loose = pfaff.Integration(result_system(field), "odeint-dopri5", step=10 * math.pi, initial=[1.0], tolerance=1e-9)
    loose.steps(1)
    assert abs(loose.state[0] - 1) > 1e-4
    with pytest.raises(pfaff.InputError, match="unknown scales 'state'.*motion.*step"):
        pfaff.Integration(result_system(field), "taylor", step=1, initial=[1.0], tolerance=1e-9, scales="state")


def result_system(field):
    return pfaff.system(coordinates=["y"], initial=[1.0], formula="field", name="down-and-up")(lambda t, y: field(t, [y]))
