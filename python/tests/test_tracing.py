"""What NumPy does with numbers that are recorded, and what it refuses."""
import numpy as np
import pytest

import pfaff


def value(formula):
    system = pfaff.system(coordinates=["x", "y"], formula="field")(lambda z: [formula(z), 0])
    return pfaff.evaluate(system, [0.3, 0.4])["rhs"][0]


def test_arrays_of_no_dimension_are_numbers():
    assert value(lambda z: np.real(z[0])) == 0.3 and value(lambda z: np.tensordot(z, z, 1)) == pytest.approx(0.25, abs=1e-16)


@pytest.mark.parametrize("formula", [
    lambda z: np.arctan2(1.0, z[0]), lambda z: np.hypot(1, z[0]), lambda z: np.fmod(z[0], 1), lambda z: np.linalg.norm(z, 3), lambda z: np.einsum("i,i", z, z),
])
def test_what_numpy_cannot_do_is_a_trace_error_with_the_line(formula):
    with pytest.raises(pfaff.TraceError, match=r"test_tracing.py:\d+: field of system .*NumPy cannot do this with numbers that are recorded"):
        value(formula)


def test_a_fault_of_the_users_own_passes():
    with pytest.raises(AttributeError, match="nothing_of_the_kind"):
        value(lambda z: z[0].nothing_of_the_kind)
