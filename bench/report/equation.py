"""Equations in prose as MathML, which browsers draw without a script and without anything fetched.

In a description or a note of an experiment an equation stands between dollar signs, written as one would type it:
$r'' + nu r' + r = 0$, $K = e^{nu t} [[0, -1], [1, 0]]$.

names      one letter, or the name of a Greek letter, is a variable; names of functions and longer names stand upright
x'  x''    derivatives
x^y  x_k   raised and lowered: a name, a number or what is in braces
[[a, b], [c, d]]  a matrix; sqrt(x) a root
|x|        the size of x; sum and times are the signs of a sum and of a vector product
+ - * / = < > <= >= , ( ) [ ]  as they are; what stands side by side is multiplied

What cannot be read as an equation, such as brackets in brackets more than 40 deep, is shown as it is written, and so is a dollar sign without another.
"""
import html
import re
from xml.sax.saxutils import escape

GREEK = dict(zip("alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon phi chi psi "
                 "omega".split(), "αβγδεζηθικλμνξπρστυφχψω"))
GREEK |= dict(zip("Gamma Delta Theta Lambda Xi Pi Sigma Phi Psi Omega".split(), "ΓΔΘΛΞΠΣΦΨΩ"))
FUNCTIONS = ("sin", "cos", "tan", "exp", "log", "sinh", "cosh", "det", "grad")
SIGNS = {"-": "−", "*": "⋅", "<=": "≤", ">=": "≥", "sum": "∑", "times": "×"}
TOKEN = re.compile(r"\s*([0-9]+(?:\.[0-9]+)?|[A-Za-z]+|<=|>=|'+|[-+*/=<>,()\[\]{}|^_])")
DEEPEST = 40  # levels of brackets, beyond which no equation is meant
TIMES, APPLIED = "<mo>&#8290;</mo>", "<mo>&#8289;</mo>"


class NotRead(Exception):
    """What stands there is no equation."""


class Reader:
    def __init__(self, source):
        self.tokens, end = [], 0
        source = source.strip()
        while end < len(source):
            found = TOKEN.match(source, end)
            if not found:
                raise NotRead(source)
            self.tokens.append(found[1])
            end = found.end()
        self.at = self.depth = 0

    def peek(self, ahead=0):
        return self.tokens[self.at + ahead] if self.at + ahead < len(self.tokens) else ""

    def take(self, expected=""):
        token = self.peek()
        if not token or expected and token != expected:
            raise NotRead(expected)
        self.at += 1
        return token

    def row(self, *ends):
        """A row of terms and signs up to one of `ends`, which is not taken."""
        out, before = [], ""
        self.depth += 1
        if self.depth > DEEPEST:
            raise NotRead("brackets too deep")
        while self.peek() not in ends:
            term, kind = self.item()
            if before and kind != "sign":
                out += [APPLIED] if before == "function" else [TIMES] if before == "term" else []
            out.append(term)
            before = kind
        if not out:
            raise NotRead("")
        self.depth -= 1
        return f"<mrow>{''.join(out)}</mrow>"

    def item(self):
        """(MathML, "term", "function" or "sign"), with what is raised or lowered at it."""
        body, kind = self.base()
        if kind == "sign":
            return body, kind
        under = over = primes = ""
        while self.peek() in ("^", "_") or self.peek().startswith("'"):
            token = self.take()
            if token == "^" and not over:
                over = self.script()
            elif token == "_" and not under:
                under = self.script()
            elif token.startswith("'") and not primes:
                primes = f"<mo>{'′' * len(token)}</mo>"
            else:
                raise NotRead(token)
        over = f"<mrow>{primes}{over}</mrow>" if primes and over else primes or over
        if under and over:
            return f"<msubsup>{body}{under}{over}</msubsup>", kind
        tag, script = ("msup", over) if over else ("msub", under)
        return (f"<{tag}>{body}{script}</{tag}>" if script else body), kind

    def base(self):
        token = self.take()
        if token == "(":
            inner = self.row(")", "")
            self.take(")")
            return f'<mrow><mo>(</mo>{inner}<mo>)</mo></mrow>', "term"
        if token == "{":
            inner = self.row("}", "")
            self.take("}")
            return inner, "term"
        if token == "|":
            inner = self.row("|", "")
            self.take("|")
            return f'<mrow><mo>|</mo>{inner}<mo>|</mo></mrow>', "term"
        if token == "[" and self.peek() == "[":
            return self.matrix(), "term"
        if token == "sqrt":
            self.take("(")
            inner = self.row(")", "")
            self.take(")")
            return f"<msqrt>{inner}</msqrt>", "term"
        if token[0].isdigit():
            return f"<mn>{token}</mn>", "term"
        if token[0].isalpha() and token not in SIGNS:
            upright = token not in GREEK and len(token) > 1
            style = ' mathvariant="normal"' if upright else ""
            return f"<mi{style}>{GREEK.get(token, token)}</mi>", "function" if token in FUNCTIONS else "term"
        if token in ("}", ")", "^", "_") or token.startswith("'"):
            raise NotRead(token)
        return f"<mo>{escape(SIGNS.get(token, token))}</mo>", "sign"

    def script(self):
        if self.peek() in ("-", "+"):
            raise NotRead(self.peek())  # what is raised by a sign stands in braces
        body, kind = self.base()
        if kind == "sign":
            raise NotRead(body)
        return body

    def matrix(self):
        rows = []
        while not rows or self.peek() == ",":
            if rows:
                self.take(",")
            self.take("[")
            cells = [self.row(",", "]", "")]
            while self.peek() == ",":
                self.take(",")
                cells.append(self.row(",", "]", ""))
            self.take("]")
            rows.append(cells)
        self.take("]")
        if len({len(cells) for cells in rows}) != 1:
            raise NotRead("]")
        table = "".join(f"<mtr>{''.join(f'<mtd>{cell}</mtd>' for cell in cells)}</mtr>" for cells in rows)
        return f'<mtable class="matrix">{table}</mtable>'


def mathml(source):
    """The equation as an element <math>; NotRead where it is none."""
    reader = Reader(source)
    body = reader.row("")
    return f'<math xmlns="http://www.w3.org/1998/Math/MathML" aria-label="{html.escape(source.strip())}">{body}</math>'


def prose(words):
    """HTML: the text, its equations as MathML."""
    parts = str(words).split("$")
    if len(parts) % 2 == 0:
        parts[-2:] = ["$".join(parts[-2:])]  # the last dollar sign has no other
    return "".join(shown(part) if k % 2 else html.escape(part) for k, part in enumerate(parts))


def shown(source):
    try:
        return mathml(source)
    except NotRead:
        return html.escape(f"${source}$")
