"""Parts of systems that are solved exactly, as methods that split step them."""
import numpy as np
import pytest

import pfaff


def split(**described):
    @pfaff.system(coordinates=["q", "p"], initial=[1, 0], part_flow=lambda part, h, q, p: [h * p, 0] if part == 0 else [0, -h * q], **described)
    def split_oscillator(q, p):
        return p**2 / 2 + q**2 / 2

    return split_oscillator


def end(system, method, steps=1000, step=0.001):
    it = pfaff.Integration(system, method, step=step)
    it.steps(steps)
    return it.state


@pytest.mark.parametrize("small", [{}, {"small_part": 1}, {"small_part": 0}])
def test_parts_are_stepped_by_methods_that_split(small):
    system = split(part_names=["drift", "turn"], **small)
    # The scheme of Strang has the order two: h^2/6 is 1.7e-7.
    assert np.abs(end(system, "exact-flow-splitting") - [np.cos(1), -np.sin(1)]).max() < 1.7e-7
    if small != {"small_part": 0}:  # half a drift, the turn, half a drift is the other leap-frog, of the same order
        assert np.abs(end(system, "exact-flow-splitting") - end(system, "verlet")).max() < 1e-6


def test_the_small_part_is_one_of_the_parts():
    with pytest.raises(pfaff.InputError, match="small_part of system split-oscillator: expected the number of one of 2 parts, counted from 0, got 2"):
        split(part_names=["drift", "turn"], small_part=2)
