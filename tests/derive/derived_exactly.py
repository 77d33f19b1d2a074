#!/usr/bin/env python3
"""The equations that `pfaff derive` writes for SymPy against the definition of the Dirac bracket, nguyen-turski (1.2).

    derived_exactly.py PFAFF

For a chain of 3 rods, one of 12 and the humanoid, with and without friction, every method's text is evaluated where each
symbol, masses and gravity included, is a random number, and compared with (1.2) by dense elimination and gradients by hand. No
state of these lies on the constraints. Two kinds of numbers show exactness: fractions for the short chain, and for all of them
the integers modulo the prime 2^127 - 1. Two different rational functions of a degree below 2^40 agree at a random point there
with a probability below 2^-87. Charged chains, whose forces have square roots, are compared to 50 digits. As a control, each
text is evaluated with one sign in it changed, which must be noticed. Exit status 1 where something is not as it should be.
"""
import fractions
import random
import re
import subprocess
import sys

import mpmath

PRIME = 2**127 - 1
mpmath.mp.dps = 90
CHAIN_METHODS = ("ldl", "simplified", "lmm", "recursion", "recursion-literal", "bivector", "minors")


class Modular:
    """An integer modulo PRIME."""
    __slots__ = ("value",)

    def __init__(self, value):
        self.value = value % PRIME

    def __add__(self, other):
        return Modular(self.value + integer(other))

    def __sub__(self, other):
        return Modular(self.value - integer(other))

    def __rsub__(self, other):
        return Modular(integer(other) - self.value)

    def __mul__(self, other):
        return Modular(self.value * integer(other))

    def __truediv__(self, other):
        return Modular(self.value * inverse(integer(other)))

    def __rtruediv__(self, other):
        return Modular(integer(other) * inverse(self.value))

    def __pow__(self, exponent):
        return Modular(pow(inverse(self.value) if exponent < 0 else self.value, abs(exponent), PRIME))

    def __neg__(self):
        return Modular(-self.value)

    def __eq__(self, other):
        return self.value == integer(other)

    def __gt__(self, other):
        """There is no order modulo a prime. What is asked is whether a pivot is positive or zero, and none is negative."""
        return self.value != integer(other)

    __radd__, __rmul__ = __add__, __mul__


def piecewise(*cases):
    return next(value for value, condition in cases if condition)


def integer(x):
    return x.value if isinstance(x, Modular) else x % PRIME


def inverse(x):
    if x == 0:
        raise ZeroDivisionError("the inverse of zero")
    return pow(x, -1, PRIME)


class Field:
    """Kinds of numbers: how random ones are drawn, and how two are compared."""

    def __init__(self, name, draw, fraction, same):
        self.name, self.draw, self.fraction, self.same = name, draw, fraction, same


FRACTIONS = Field("fractions", lambda r: fractions.Fraction(r.randint(-99, 99) or 1, r.randint(1, 9)), fractions.Fraction,
                  lambda a, b: a == b)
MODULAR = Field("modular", lambda r: Modular(r.randrange(1, PRIME)), lambda a, b=1: Modular(a) / b, lambda a, b: a == b)
DIGITS = Field("50 digits", lambda r: mpmath.mpf(r.randrange(2**40, 2**42)) / 2**41, lambda a, b=1: mpmath.mpf(a) / b,
               lambda a, b: abs(a - b) <= mpmath.mpf(10)**-50 * max(1, abs(b)))


class Rods:
    """Beads i with positions, momenta, masses; rods (i, j); gravity along the last axis; drag; alternating charges."""

    def __init__(self, field, rods, seed, friction, charge=None):
        self.rods, self.beads, r = rods, 1 + max(map(max, rods)), random.Random(seed)
        self.q, self.p = ([field.draw(r) for _ in range(3 * self.beads)] for _ in range(2))
        self.mass = [field.draw(r)**2 for _ in range(self.beads)]  # squares, because negative ones have no factors
        self.gravity = field.draw(r)
        self.drag = [field.draw(r)**2 for _ in range(self.beads)] if friction else None
        n = 3 * self.beads
        self.force = [self.mass[a // 3] * self.gravity if a % 3 == 2 else 0 for a in range(n)]
        if charge is not None:
            self.repel(charge)
        self.speed = [self.p[a] / self.mass[a // 3] for a in range(n)]
        self.rows = []  # (gradient of phi, gradient of phi~ by q, by p) as {coordinate: number}
        for i, j in rods:
            d = [self.q[3 * i + x] - self.q[3 * j + x] for x in range(3)]
            v = [self.speed[3 * i + x] - self.speed[3 * j + x] for x in range(3)]
            def ends(u):
                return {3 * i + x: u[x] for x in range(3)} | {3 * j + x: -u[x] for x in range(3)}
            self.rows.append((ends(d), ends(v), {a: w / self.mass[a // 3] for a, w in ends(d).items()}))

    def repel(self, charge):
        """k q_i q_j / r of all pairs that no rod joins, with k = 1 and charges of alternating sign."""
        for i in range(self.beads):
            for j in range(i + 1, self.beads):
                if (i, j) in self.rods:
                    continue
                d = [self.q[3 * i + x] - self.q[3 * j + x] for x in range(3)]
                r = mpmath.sqrt(sum(x * x for x in d))
                for x in range(3):
                    f = (-1)**(i + j) * charge * charge * d[x] / r**3
                    self.force[3 * i + x] += f
                    self.force[3 * j + x] -= f

    def parameter(self, name):
        if name == "gz":
            return self.gravity
        kind, index = re.fullmatch(r"(m|lambda)([0-9]+)", name).groups()
        return (self.mass if kind == "m" else self.drag)[int(index)]

    def dirac(self):
        """(1.2) with the canonical bracket, less the symmetric one of the drag where there is some."""
        n = 3 * self.beads
        slope = [-f for f in self.force] + self.speed
        both = [({a: w for a, w in row.items()}, {}) for row, _, _ in self.rows] + [(b, c) for _, b, c in self.rows]
        vectors = [{a: w for a, w in by_p.items()} | {n + a: -w for a, w in by_q.items()} for by_q, by_p in both]
        gradients = [by_q | {n + a: w for a, w in by_p.items()} for by_q, by_p in both]
        rate = self.reduced(slope[n:] + [-s for s in slope[:n]], gradients, vectors)
        if self.drag is None:
            return rate
        rubbed = [0] * n + [self.drag[a // 3] * slope[n + a] for a in range(n)]
        vectors = [{n + a: self.drag[a // 3] * w for a, w in c.items()} for _, _, c in self.rows]
        rubbed = self.reduced(rubbed, gradients[len(self.rows):], vectors)
        return [a - b for a, b in zip(rate, rubbed)]

    @staticmethod
    def reduced(vector, gradients, vectors):
        """v - sum_ij X_i (W^-1)_ij dphi_j(v), where W_ij = dphi_i(X_j)."""
        matrix = [[dot(g, x) for x in vectors] for g in gradients]
        weights = solved(matrix, [sum((w * vector[a] for a, w in g.items()), 0) for g in gradients])
        out = list(vector)
        for weight, x in zip(weights, vectors):
            for a, w in x.items():
                out[a] = out[a] - weight * w
        return out

    def multipliers(self):
        """(A.5): q' = v, p' = F - B^T S^-1 (|V|^2 + B M^-1 F), with Stokes's drag in F where there is drag."""
        force = [f - (self.drag[a // 3] * self.speed[a] if self.drag else 0) for a, f in enumerate(self.force)]
        matrix = [[dot(row, other) for _, _, other in self.rows] for row, _, _ in self.rows]
        right = [sum((v * v for v in list(turn.values())[:3]), 0) + sum((w * force[a] for a, w in by_p.items()), 0)
                 for _, turn, by_p in self.rows]
        for weight, (row, _, _) in zip(solved(matrix, right), self.rows):
            for a, w in row.items():
                force[a] = force[a] - weight * w
        return self.speed + force


def dot(f, x):
    return sum((w * x[a] for a, w in f.items() if a in x), 0)


def solved(matrix, right):
    """Gauss's elimination; the pivot is the first entry that is not zero, or the largest of real numbers."""
    a, n = [row + [b] for row, b in zip(matrix, right)], len(right)
    for k in range(n):
        real = isinstance(a[k][-1], mpmath.mpf)
        pivot = max(range(k, n), key=lambda i: abs(a[i][k])) if real else next(i for i in range(k, n) if not a[i][k] == 0)
        a[k], a[pivot] = a[pivot], a[k]
        for i in range(k + 1, n):
            if not a[i][k] == 0:
                factor = a[i][k] / a[k][k]
                a[i] = a[i][:k] + [x - factor * y for x, y in zip(a[i][k:], a[k][k:])]
    x = [0] * n
    for k in reversed(range(n)):
        x[k] = (a[k][n] - sum((a[k][j] * x[j] for j in range(k + 1, n)), 0)) / a[k][k]
    return x


def evaluated(text, field, rods):
    """The text's rates where its names of SymPy's functions are those of the numbers."""
    text = re.sub(r"^from sympy import.*$", "", text, flags=re.M)
    names = {"Rational": field.fraction, "sympify": lambda x: x, "sqrt": mpmath.sqrt, "Piecewise": piecewise}
    exec(compile(text, "derived", "exec"), names)
    return names["rates"](0, rods.q + rods.p, [rods.parameter(name) for name in names["parameters"]])


def flipped(text, seed):
    """One sum made a difference."""
    begin = text.index("\n\ndef rates(")
    places = [m.start() for m in re.finditer(r" \+ ", text) if m.start() > begin]
    at = random.Random(seed).choice(places)
    return text[:at] + " - " + text[at + 3:]


def derive(program, system, method, form, settings):
    command = [program, "derive", system, "--method", method, "--emit", "sympy", "--set", f"friction-form={form}"]
    return subprocess.run(command + [x for s in settings for x in ("--set", s)], check=True, stdout=subprocess.PIPE,
                          text=True).stdout


def check(program, system, rods, settings, fields, methods, friction, charge=None):
    faults = []
    for method in methods:
        lagrange = method in ("lmm", "simplified")
        if friction and method == "simplified":
            continue  # its friction sets the hidden constraints to zero, which is another force off the surface
        form = "none" if not friction else "stokes" if lagrange else "metriplectic"
        text = derive(program, system, method, form, settings)
        wrong = flipped(text, 1)
        for field in fields:
            place = f"{system} of {len(rods)} rods by {method}, {form} friction, {field.name}"
            beads = Rods(field, rods, f"{system} {method}", friction, charge)
            expected = beads.multipliers() if lagrange else beads.dirac()
            def agrees(candidate):
                found = evaluated(candidate, field, beads)
                return len(found) == len(expected) and all(map(field.same, found, expected))
            if not agrees(text):
                faults.append(f"{place}: differs from the definition")
            elif agrees(wrong):
                faults.append(f"{place}: a changed sign is not noticed")
    return faults


def main(program):
    chain = {k: [(i, i + 1) for i in range(k)] for k in (3, 12)}
    figure = [(0, 1), (1, 2), (2, 3), (3, 4), (1, 5), (5, 6), (6, 7), (1, 8), (8, 9), (9, 10), (8, 11), (11, 12)]
    faults = []
    for friction in (False, True):
        drag = ["friction=1/2"] if friction else []
        for k in chain:
            fields = [FRACTIONS, MODULAR] if k == 3 else [MODULAR]
            faults += check(program, "chain-molecule", chain[k], [f"beads={k + 1}", "epsilon=0", "charge=0", "gravity=9.81"]
                            + drag, fields, CHAIN_METHODS, friction)
        faults += check(program, "humanoid", figure, drag, [MODULAR], CHAIN_METHODS[:-1], friction)
    for k in chain:
        faults += check(program, "chain-molecule", chain[k], [f"beads={k + 1}", "epsilon=0", "charge=1/2", "gravity=9.81"],
                        [DIGITS], CHAIN_METHODS, False, mpmath.mpf(1) / 2)
    print("\n".join(faults) if faults else "every text is the definition")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
