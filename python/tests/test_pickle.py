"""Objects travel to other processes: by reference where they can be imported, else as what was recorded."""
import multiprocessing
import os
import pickle
import sys

import numpy as np
import pytest
from definitions import Pendulum, duffing, end_of, kick, runge_kutta

import pfaff


def copied(x):
    return pickle.loads(pickle.dumps(x))


def test_systems_and_methods():
    jobs = [
        (duffing(alpha=-0.5), kick),
        (Pendulum(g=2), runge_kutta),
        (pfaff.System("kepler", eccentricity=0.2), pfaff.Method("gauss", stages=2)),
        (duffing, pfaff.table({"kind": "runge-kutta", "name": "ralston", "order": 2, "a": [[], ["2/3"]], "b": ["1/4", "3/4"]})),
    ]
    for job in jobs:
        assert np.array_equal(end_of(copied(job)), end_of(job))
    assert copied(duffing(alpha=2))(alpha=3).parameters == {"alpha": "3", "beta": "1.0"}


def test_a_system_without_an_importable_function_travels_as_it_was_recorded():
    scale = 3

    @pfaff.system(coordinates=["q", "p"], initial=[1, 0], invariants={"half": lambda q, p: q / 2}, behaviours={"half": "free"})
    def local(q, p, k=2.0):
        return p**2 / 2 + scale * k * np.cos(q) + pfaff.where(q, q, 0)

    other = copied(copied(local(k="1/3")))
    assert np.array_equal(end_of((other, kick)), end_of((local(k="1/3"), kick))) and other.invariants == local.invariants
    with pytest.raises(pfaff.InputError, match="its functions are not here"):
        other(k=2)


def test_runs_keep_their_samples():
    result = pfaff.run(duffing, "verlet", step=0.1, time=5)
    other = copied(result)
    assert np.array_equal(other.y, result.y) and other.drift["energy"] == result.drift["energy"] and np.array_equal(other.jacobian, result.jacobian)

    @pfaff.method(order=1)
    def local(problem, t, h, z):
        return z + h * problem.field(t, z)

    with pytest.raises(pickle.PicklingError, match="local"):
        pickle.dumps(local)
    assert copied(pfaff.run(duffing, local, step=0.1, time=5)).method.name == "local"
    with pytest.raises(TypeError, match="cannot be pickled"):
        pickle.dumps(pfaff.Integration(duffing, "verlet", step=0.1))


def test_other_processes_take_jobs(monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([os.path.dirname(__file__), *filter(None, sys.path)]))
    jobs = [(duffing(alpha=-0.5), kick), (Pendulum(), pfaff.Method("gauss", stages=2))]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        ends = pool.map(end_of, jobs)
    assert all(np.array_equal(one, end_of(job)) for one, job in zip(ends, jobs))
