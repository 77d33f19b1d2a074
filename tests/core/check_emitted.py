"""Reads emitted texts back and compares what they compute with the tape that they were made from.

  check_emitted.py DIRECTORY

The directory has for every sample NAME.json, the tape with points at which to evaluate it, and the texts NAME.py
(SymPy), NAME.tex, NAME.wl (Mathematica) and NAME.jl. Tapes are evaluated here, in fractions where they are
rational and else in 90 digits. SymPy's modules are imported and called. LaTeX is read by a parser of the little
that is emitted. Of Mathematica and Julia the structure is checked: brackets, names that are defined before they
are used, words that are reserved. None of this shares code with Pfaff.

Exit status: 0 everything agrees, 1 something differs (one line for each).
"""
import importlib.util
import json
import re
import shutil
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import mpmath
import sympy

from read_latex import FUNCTIONS, Latex, number, solved

mpmath.mp.dps = 90


def replayed(sample, t, z):
    """The outputs of the tape."""
    rational = sample["rational"]
    constants = [number(c, rational) for c in sample["constants"]]
    slots = []
    for k, (operation, a, b, c) in enumerate(sample["code"]):
        if operation == "constant":
            slots.append(constants[a])
        elif operation == "time":
            slots.append(t)
        elif operation == "input":
            slots.append(z[a])
        elif operation == "negate":
            slots.append(-slots[a])
        elif operation == "add":
            slots.append(slots[a] + slots[b])
        elif operation == "subtract":
            slots.append(slots[a] - slots[b])
        elif operation == "multiply":
            slots.append(slots[a] * slots[b])
        elif operation == "divide":
            slots.append(slots[a] / slots[b])
        elif operation == "power":
            slots.append(slots[a] ** constants[b])
        elif operation == "select":
            slots.append(slots[b] if slots[a] > 0 else slots[c])
        elif operation == "solve":
            system = sample["solves"][a]
            n = system["size"]
            matrix = [[slots[s] for s in system["matrix"][i * n:(i + 1) * n]] for i in range(n)]
            solution = solved(matrix, [slots[s] for s in system["right_hand_side"]])
            slots.append(solution[0])
        elif operation == "solve_next":
            slots.append(solution[b])
        else:
            slots.append(FUNCTIONS[operation](slots[a]))
    return [slots[s] for s in sample["outputs"]]


def by_sympy(path, sample, t, z):
    spec = importlib.util.spec_from_file_location(path.stem.replace("-", "_"), path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    n = len(module.coordinates)
    if sample["rational"]:
        exact = [sympy.Rational(x.numerator, x.denominator) for x in [t, *z]]
        return [Fraction(int(r.p), int(r.q)) for r in module.rates(exact[0], exact[1:n + 1], exact[n + 1:])]
    floats = [sympy.Float(x, 90) for x in [t, *z]]
    return [mpmath.mpf(sympy.Float(r, 90)._mpf_) for r in module.rates(floats[0], floats[1:n + 1], floats[n + 1:])]


def plain(text):
    return re.sub(r"\s", "", text)


def by_latex(path, sample, t, z):
    text = path.read_text()
    reader = Latex(sample["rational"])
    symbols = re.findall(r"\\item \$(.*?)\$", text)
    if len(symbols) != len(z):
        raise ValueError(f"the legend has {len(symbols)} symbols")
    reader.known = dict(zip(map(plain, symbols), z)) | {"t": t}
    results, section = [], ""
    for part in re.finditer(r"\\subsection\*\{(.*?)\}|\\begin\{align\*\}\n(.*?)\n\\end\{align\*\}", text, re.S):
        section = part.group(1) or section
        for line in (part.group(2) or "").split(" \\\\\n"):
            if not line:
                continue
            left, right = line.split(" &= ")
            value = reader.read(right)
            if section == "Equations":
                rate = re.sub(r"^\\dot\{(.*?)\}(_|$)", r"\1\2", left)
                if not left.startswith("\\text") and rate != symbols[len(results)]:
                    raise ValueError(f"{left} stands where the rate of {symbols[len(results)]} should")
                results.append(value)
            elif left.startswith("\\begin{pmatrix}"):
                names = left[len("\\begin{pmatrix}"):-len("\\end{pmatrix}")].split("\\\\")
                reader.known.update(zip(map(plain, names), value))
            else:
                reader.known[plain(left)] = value
    if shutil.which("pdflatex"):
        done = subprocess.run(["pdflatex", "-interaction=nonstopmode", "-halt-on-error", path.name], cwd=path.parent,
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise ValueError("pdflatex refuses it: " + " ".join(re.findall(r"^! .*", done.stdout, re.M)))
    return results


BRACKETS = {")": "(", "]": "[", "}": "{"}


def balanced(text):
    stack = []
    for c in text:
        if c in "([{":
            stack.append(c)
        elif c in BRACKETS and (not stack or stack.pop() != BRACKETS[c]):
            return False
    return not stack


def structure(text, names, known, assignments, words, allowed):
    """Each name that an assignment reads must be known or assigned before it."""
    if not balanced(text):
        raise ValueError("brackets do not match")
    known = set(known)
    for left, right in assignments:
        for word in re.findall(words, right):
            if word not in known and word not in allowed:
                raise ValueError(f"{word} is used before it is defined")
        known.update(left)
    return names


def check_julia(path, sample):
    text = re.sub(r"#.*", "", path.read_text())
    lines = [line.strip() for line in text.strip().splitlines()]
    if lines[0] == "using SpecialFunctions: erf":
        del lines[0]
    head = re.fullmatch(r"function \w+!\(rates, state, parameters, (\w+)\)", lines[0])
    if not head or lines[-2:] != ["return rates", "end"]:
        raise ValueError("no function")
    reserved = set("begin break catch const continue do else elseif end export false finally for function global if "
                   "import let local macro module quote return struct true try using while in isa where".split())
    assignments = []
    for line in lines[1:-2]:
        left, right = line.split(" = ", 1)
        left = [name for name in re.split(r",\s*", left) if name]
        if reserved & set(left):
            raise ValueError(f"{left} is reserved")
        assignments.append((left, re.sub(r'big"[^"]*"', "1", right)))
    structure(text, [], ["state", "parameters", head.group(1)], assignments, r"[A-Za-z_]\w*",
              set(FUNCTIONS) | {"ifelse"})
    results = [left[0] for left, _ in assignments if left[0].startswith("rates[")]
    if results != [f"rates[{k + 1}]" for k in range(len(sample["outputs"]))]:
        raise ValueError("not all results are set, each once")


def check_mathematica(path, sample):
    text = re.sub(r"\(\*.*?\*\)", "", path.read_text(), flags=re.S)
    head, body = text.split(" :=\n")
    known = re.findall(r"(\w+)_(?=[,}])", head.split("[", 1)[1])
    if len(known) != 1 + sample["inputs"]:
        raise ValueError("not every input has a pattern")
    if found := re.search(r"\w_\w", text):
        raise ValueError(f"an underscore is no letter: {found.group()}")
    module = re.fullmatch(r"\s*Module\[\{(.*?)\},\n((?:    \S.*;\n)*)    \{(.*)\}\]\s*", body, re.S)
    local = [name for name in re.split(r",\s*", module.group(1)) if name]
    assignments = []
    for line in module.group(2).splitlines():
        left, right = line.strip().rstrip(";").split(" = ", 1)
        assignments.append((re.findall(r"\w+", left), right))
    if [name for left, _ in assignments for name in left] != local:
        raise ValueError("not every local name is set once, or one is set that is not local")
    for name in known + local:
        if name[0].isupper():
            raise ValueError(f"{name} may be Mathematica's own")
    assignments.append(([], module.group(3)))
    structure(text, [], known, assignments, r"[A-Za-z]\w*", {"Sqrt", "Exp", "Log", "Sin", "Cos", "ArcTan", "Erf", "Sinh", "Tanh", "If", "LinearSolve"})
    if module.group(3).count(",\n") + 1 != len(sample["outputs"]):
        raise ValueError("not as many results as there should be")


def compare(language, found, expected, tolerance):
    if len(found) != len(expected):
        raise ValueError(f"{len(found)} results instead of {len(expected)}")
    for k, (a, b) in enumerate(zip(found, expected)):
        if (a != b) if tolerance == 0 else (abs(a - b) > tolerance * max(1, abs(b))):
            raise ValueError(f"result {k} is {float(a):.17g} instead of {float(b):.17g}, off by {float(abs(a - b)):.2g}")


def main(directory):
    faults = []

    def attempt(name, language, check):
        try:
            check()
        except Exception as error:  # whatever a wrong text makes of its reader is a fault of the text
            faults.append(f"{name}, {language}: {type(error).__name__}: {error}")

    samples = sorted(directory.glob("*.json"))
    for path in samples:
        sample = json.loads(path.read_text())
        rational = sample["rational"]
        for point in sample["points"]:
            t, z = number(point["t"], rational), [number(x, rational) for x in point["z"]]
            expected = replayed(sample, t, z)
            # The replay here against Pfaff's in quad: 33 digits, of numbers whose conditions are moderate.
            attempt(path.stem, "replay",
                    lambda: compare("replay", [number(x, rational) for x in point["quad"]], expected, 1e-28))
            # Fractions are exact. Otherwise 50 digits of the 90 are asked for, as functions lose some; constants
            # that are no fractions stand in LaTeX with as few digits as quad tells apart.
            exact = 0 if rational else mpmath.mpf("1e-50")
            attempt(path.stem, "sympy",
                    lambda: compare("sympy", by_sympy(path.with_suffix(".py"), sample, t, z), expected, exact))
            attempt(path.stem, "latex",
                    lambda: compare("latex", by_latex(path.with_suffix(".tex"), sample, t, z), expected,
                                    1e-32 if sample["irrational_constants"] else exact))
        attempt(path.stem, "julia", lambda: check_julia(path.with_suffix(".jl"), sample))
        attempt(path.stem, "mathematica", lambda: check_mathematica(path.with_suffix(".wl"), sample))
    print("\n".join(faults) if faults else f"{len(samples)} samples agree")
    return 1 if faults or not samples else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
