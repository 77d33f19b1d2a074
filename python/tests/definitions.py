"""Systems and methods of the tests, in a module of their own so that other processes can import them."""
import numpy as np

import pfaff


@pfaff.system(coordinates={"q": 2, "p": 2}, initial=[0.1, -0.2, 0.3, 0.15], name="henon-heiles-in-python")
def henon_heiles(q, p):
    return p @ p / 2 + q @ q / 2 + q[0] ** 2 * q[1] - q[1] ** 3 / 3


@pfaff.system(coordinates=["q", "p"], initial=[0.5, 0.0])
def duffing(t, q, p, alpha: float = -1.0, beta: float = 1.0):
    return p**2 / 2 + alpha * q**2 / 2 + beta * q**4 / 4


@pfaff.system(coordinates=["q", "p"], initial=[1, 0])
def oscillator(q, p, omega=2):
    return p**2 / 2 + omega**2 * q**2 / 2


class Pendulum(pfaff.System):
    """q'' = -g sin q."""

    coordinates = ["q", "p"]
    initial = [1, 0]
    g: float = 9.81

    def kinetic(self, p):
        return p**2 / 2

    def potential(self, q):
        return -self.g * np.cos(q)


@pfaff.method(order=2, preserves=["symplectic", "symmetric"], needs=["separable"])
def kick(problem, t, h, z):
    n = problem.size // 2
    q, p = z[:n], z[n:]
    p = p + h / 2 * problem.force(t, q)
    q = q + h * problem.velocity(t + h / 2, p)
    p = p + h / 2 * problem.force(t + h, q)
    return np.concatenate([q, p])


@pfaff.method(order=4)
def runge_kutta(problem, t, h, z):
    k1 = problem.field(t, z)
    k2 = problem.field(t + h / 2, z + h / 2 * k1)
    k3 = problem.field(t + h / 2, z + h / 2 * k2)
    k4 = problem.field(t + h, z + h * k3)
    return z + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def end_of(job):
    """The end of a run, for other processes: job = (system, method)."""
    system, method = job
    it = pfaff.Integration(system, method, step=0.01)
    it.steps(100)
    return it.state
