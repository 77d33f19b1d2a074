"""What NumPy does with numbers that are recorded, and what is refused."""
import fractions
import math

import numpy as np
import pytest

import pfaff


def value(formula):
    system = pfaff.system(coordinates=["x", "y"], formula="field")(lambda z: [formula(z), 0])
    return pfaff.evaluate(system, [0.3, 0.4])["rhs"][0]


def test_numpy_works_on_the_numbers():
    @pfaff.system(coordinates={"q": 3, "p": 3}, initial=[1, 2, 3, 4, 5, 6])
    def energy(q, p):
        m = np.array([[2.0, 1.0, 0.0], [1.0, 3.0, 0.5], [0.0, 0.5, 1.0]])
        turned = np.cross(q, p)
        size = np.linalg.norm(q) + np.sqrt(p.dot(p)) + np.hypot(q[0], p[0])
        return p @ pfaff.solve(m, p) / 2 + turned.sum() + size + np.exp(-q).mean() + np.arctan2(q[0], q[1]) + pfaff.where(q[0], q[1] ** 2, q[2]) + np.tanh(q).sum() + abs(q[2])

    def value(q, p):
        m = np.array([[2.0, 1.0, 0.0], [1.0, 3.0, 0.5], [0.0, 0.5, 1.0]])
        return p @ np.linalg.solve(m, p) / 2 + np.cross(q, p).sum() + np.linalg.norm(q) + np.sqrt(p @ p) + np.hypot(q[0], p[0]) + np.exp(-q).mean() + np.arctan2(q[0], q[1]) + (q[1] ** 2 if q[0] > 0 else q[2]) + np.tanh(q).sum() + abs(q[2])

    tape = pfaff._pfaff.formula_of(energy.model, "hamiltonian")
    for z in ([1, 2, 3, 4, 5, 6], [-1, 0.5, -2, 0.1, 3, -7]):
        expected = value(np.array(z[:3], float), np.array(z[3:], float))
        assert tape(0, z)[0] == pytest.approx(expected, rel=1e-15 * 8)  # some units of round-off


@pytest.mark.parametrize(
    "formula, words",
    [
        (lambda q, p: math.sin(q) + p, "numpy.sin"),
        (lambda q, p: p if q > 0 else q, r"pfaff\.where\(x - y, a, b\)"),
        (lambda q, p: p if q else q, r"pfaff\.where"),
        (lambda q, p: p if q == p else q, r"pfaff\.where"),
        (lambda q, p: q % 2 + p, "remainders"),
        (lambda q, p: np.floor(q) + p, "remainders"),
        (lambda q, p: round(q, 2) + p, "remainders"),
        (lambda q, p: np.maximum(q, p), r"pfaff\.where"),
        (lambda q, p: q + np.random.rand(), "recorded once"),
        (lambda q, p: np.linalg.inv(np.array([[q, p], [p, q]]))[0, 0], r"pfaff\.solve"),
    ],
)
def test_what_cannot_be_recorded_is_refused_with_the_line(formula, words):
    with pytest.raises(pfaff.TraceError, match=words) as caught:
        pfaff.system(coordinates=["q", "p"], name="refused")(formula)
    assert f"test_tracing.py:{formula.__code__.co_firstlineno}" in str(caught.value)


def test_a_counter_and_a_number_that_was_kept_are_found():
    count, kept = [0], []

    def counting(q, p):
        count[0] += 1
        return p**2 / 2 + count[0] * q**2

    def keeping(q, p):
        kept.append(q)
        return p**2 / 2 + kept[0] ** 2

    for formula, words in ((counting, "recorded once"), (keeping, "not kept")):
        with pytest.raises(pfaff.TraceError, match=words):
            pfaff.system(coordinates=["q", "p"])(formula)


def test_arrays_of_no_dimension_are_numbers():
    assert value(lambda z: np.real(z[0])) == 0.3 and value(lambda z: np.tensordot(z, z, 1)) == pytest.approx(0.25, abs=1e-16)


@pytest.mark.parametrize("formula, words", [
    (lambda z: np.arctan2(1.0, z[0]), "numpy.arctan2 cannot be recorded with a first argument that is a plain number; expected one that is recorded"),
    (lambda z: np.hypot(1, z[0]), "numpy.hypot cannot be recorded with a first argument that is a plain number"),
    (lambda z: np.fmod(z[0], 1), "numpy.fmod cannot be recorded; expected .*, numpy's sqrt, exp, "),
    (lambda z: np.linalg.norm(z, 3), "NumPy cannot do this with numbers that are recorded .*; expected .*, numpy's sqrt, exp, "),
    (lambda z: np.einsum("i,i", z, z), "NumPy cannot do this with numbers that are recorded"),
])
def test_what_numpy_cannot_do_is_a_trace_error_with_the_line(formula, words):
    with pytest.raises(pfaff.TraceError, match=rf"test_tracing.py:\d+: field of system [^ ]*: {words}"):
        value(formula)


def test_a_fault_of_the_users_own_passes():
    with pytest.raises(AttributeError, match="nothing_of_the_kind"):
        value(lambda z: z[0].nothing_of_the_kind)


@pytest.mark.parametrize("name, formula", [
    ("expm1", lambda x: np.exp(x) - 1), ("log1p", lambda x: np.log(1 + x)), ("arcsinh", lambda x: np.log(x + np.sqrt(x**2 + 1))), ("log2", lambda x: np.log(x) / np.log(2)),
    ("arctanh", lambda x: np.log((1 + x) / (1 - x)) / 2), ("exp2", lambda x: 2**x), ("log10", lambda x: np.log(x) / np.log(10)), ("cbrt", lambda x: x ** fractions.Fraction(1, 3)),
])
def test_what_to_write_instead_is_said_and_is_the_same(name, formula):
    with pytest.raises(pfaff.TraceError, match=f"field of system .*: numpy.{name} cannot be recorded; expected ") as refused:
        value(lambda z: getattr(np, name)(z[0]))
    instead = str(refused.value).split("expected ")[1].removesuffix(", for x > 0")
    assert eval(instead, {"numpy": np, "fractions": fractions, "x": 0.3}) == pytest.approx(getattr(np, name)(0.3), rel=1e-14)
    assert value(lambda z: formula(z[0])) == pytest.approx(getattr(np, name)(0.3), rel=1e-14)  # some units of round-off


def test_the_functions_that_there_are_are_named_and_there():
    with pytest.raises(pfaff.TraceError, match="numpy.spacing cannot be recorded; expected ") as refused:
        value(lambda z: np.spacing(z[0]))
    for name in str(refused.value).split("numpy's ")[1].split(", pfaff.where")[0].split(", "):
        function = getattr(np, name)
        arguments = [0.3, 0.4][: function.nin]
        assert value(lambda z: function(*z[: function.nin])) == pytest.approx(function(*arguments), rel=1e-14)
    with pytest.raises(pfaff.TraceError, match=r"numpy.sign\(x\): pfaff.where\(x, 1, -1\)"):
        value(lambda z: np.sign(z[0]))
