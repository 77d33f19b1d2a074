"""Evaluates the LaTeX that Pfaff writes, in fractions where all is rational and else in mpmath's numbers."""
import re
from fractions import Fraction

import mpmath

FUNCTIONS = {"sqrt": mpmath.sqrt, "exp": mpmath.exp, "log": mpmath.log, "ln": mpmath.log, "sin": mpmath.sin,
             "cos": mpmath.cos, "atan": mpmath.atan, "arctan": mpmath.atan, "erf": mpmath.erf,
             "sinh": mpmath.sinh, "tanh": mpmath.tanh}


def number(text, rational):
    value = Fraction(text)
    return value if rational else mpmath.mpf(value.numerator) / value.denominator


def solved(matrix, right):
    """Gauss's elimination; the first entry that is not zero is the pivot where fractions are exact."""
    a = [row[:] + [b] for row, b in zip(matrix, right)]
    n = len(a)
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(a[i][k]))
        a[k], a[pivot] = a[pivot], a[k]
        for i in range(k + 1, n):
            factor = a[i][k] / a[k][k]
            a[i] = [x - factor * y for x, y in zip(a[i], a[k])]
    x = [None] * n
    for i in reversed(range(n)):
        x[i] = (a[i][n] - sum(a[i][j] * x[j] for j in range(i + 1, n))) / a[i][i]
    return x


class Latex:
    """Evaluates the expressions of emitted LaTeX."""
    TOKEN = re.compile(r"\s*(\\left\(|\\right\)|\\[a-zA-Z]+|\\,|\\\\|[0-9]+(?:\.[0-9]+)?|[a-zA-Z]|[-+^_{}&>=()~,])")

    def __init__(self, rational):
        self.rational = rational
        self.known = {}

    def read(self, text):
        self.tokens, at = [], 0
        text = text.replace("\\operatorname{erf}", "\\erf")
        text = text.replace("\\text{if }", " \\condition ").replace("\\text{otherwise}", " \\otherwise ")
        while at < len(text.rstrip()):
            found = self.TOKEN.match(text, at)
            if not found:
                raise ValueError(f"no LaTeX that is known: {text[at:at + 30]!r}")
            self.tokens.append(found.group(1))
            at = found.end()
        self.at = 0
        value = self.whole()
        if self.at != len(self.tokens):
            raise ValueError(f"not understood from {' '.join(self.tokens[self.at:self.at + 6])!r}")
        return value

    def next(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self, *expected):
        token = self.next()
        if expected and token not in expected:
            raise ValueError(f"expected {expected}, got {token!r}")
        self.at += 1
        return token

    def takes(self, *texts):
        if self.tokens[self.at:self.at + len(texts)] == list(texts):
            self.at += len(texts)
            return True
        return False

    def environment(self, word):
        for token in ("{", *word, "}"):
            self.take(token)

    def whole(self):
        if self.next() != "\\begin":
            return self.sum()
        if "".join(self.tokens[self.at + 2:self.at + 7]) == "cases":
            self.take("\\begin")
            self.environment("cases")
            positive = self.sum()
            self.take("&")
            self.take("\\condition")
            condition = self.sum()
            self.take(">")
            self.take("0")
            self.take("\\\\")
            otherwise = self.sum()
            self.take("&")
            self.take("\\otherwise")
            self.take("\\end")
            self.environment("cases")
            return positive if condition > 0 else otherwise
        matrix = self.matrix()
        for token in ("^", "{", "-", "1", "}"):
            self.take(token)
        return solved(matrix, [row[0] for row in self.matrix()])

    def matrix(self):
        self.take("\\begin")
        self.environment("pmatrix")
        rows = [[self.sum()]]
        while self.next() != "\\end":
            if self.take("&", "\\\\") == "&":
                rows[-1].append(self.sum())
            else:
                rows.append([self.sum()])
        self.take("\\end")
        self.environment("pmatrix")
        return rows

    def sum(self):
        value = -self.product() if self.takes("-") else self.product()
        while self.next() in ("+", "-"):
            value = value + self.product() if self.take() == "+" else value - self.product()
        return value

    def product(self):
        value = self.power()
        while self.next() in ("\\,", "\\cdot"):
            self.take()
            value = value * self.power()
        return value

    def power(self):
        value = self.primary()
        if not self.takes("^"):
            return value
        exponent = self.group()
        if isinstance(exponent, Fraction) and exponent.denominator == 1:
            return value ** int(exponent)
        return value ** exponent

    def group(self):
        self.take("{")
        value = self.sum()
        self.take("}")
        return value

    def primary(self):
        token = self.take()
        if token[0].isdigit():
            return number(token, self.rational)
        if token == "\\left(":
            value = self.sum()
            self.take("\\right)")
            return value
        if token == "\\frac":
            above = self.group()
            return above / self.group()
        if token == "\\sqrt":
            return mpmath.sqrt(self.group())
        if token[1:] in FUNCTIONS:
            self.take("\\left(")
            value = self.sum()
            self.take("\\right)")
            return FUNCTIONS[token[1:]](value)
        return self.known[self.symbol(token)]

    def symbol(self, token):
        if token in ("\\mathit", "\\mathrm"):
            token += self.raw()
        return token + ("_" + self.raw() if self.takes("_") else "")

    def raw(self):
        """A group as it stands."""
        text, depth = "", 0
        while not text or depth:
            token = self.take()
            depth += {"{": 1, "}": -1}.get(token, 0)
            text += token
        return text
