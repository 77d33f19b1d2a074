"""The figures of derived equations against the number K of constraints: operations, time, and sizes without sharing.

A method has the same colour and mark in all of them; every line is named where it stands, with the power of K, or the rate per
constraint, that was fitted to it. Published times and the number of terms of a determinant are dashed and grey.
"""
import math

from canvas import MID
from families import FAMILIES, style
from figures import Drawing, sentences
from labels import right_of
from scales import power_of_ten
from wording import listed
from work_precision import frame_of

TALLEST_TREE = 1e30  # larger ones leave the frame: nobody writes them out
RAISED = str.maketrans("0123456789.-", "⁰¹²³⁴⁵⁶⁷⁸⁹·⁻")
TREES = "terms of |S|  exp(0.48 K)"
TITLES = {"operations": "operations of all equations", "seconds": "processor time of the derivation [s]",
          "tree": "operations of all equations, written out"}


def drawings(study):
    return [drawing(study, quantity) for quantity in ("operations", "seconds", "tree")
            if any(m.line(quantity)[0] for m in study.methods)]


def drawing(study, quantity):
    titles = {"operations": "Size of the equations", "seconds": "Time of the derivation", "tree": "Size without sharing"}
    fitted = [m for m in study.methods if quantity in m.fits]
    begin = min((m.fits[quantity].begin for m in fitted), default=math.nan)
    caption = sentences(
        {"operations": "Equal expressions are computed once. Both axes are logarithmic: a power of K is a straight line.",
         "seconds": "Least of a few repetitions, for all equations."
                    + (f" Dashed: the times that are published for one pair of equations, {listed(map(formula, study.published))}."
                       if study.published else ""),
         "tree": "The same equations with every expression written out wherever it is used. The axis of K is linear: an "
                 "exponential is a straight line. Each method is labelled with the law, power or exponential, that fits it "
                 "better. Dashed: the terms of the determinant of a tridiagonal matrix of K rows, multiplied out, which grow by the "
                 "logarithm of the golden ratio, 0.481, for each row."}[quantity],
        f"Exponents are fitted from K = {begin:.0f} on." if fitted else "")
    return Drawing("growth", {"name": quantity}, titles[quantity], caption,
                   lambda wide: draw(study, quantity, wide), printed=True)


def formula(published):
    return f"{published['factor']:g} exp({published['rate']:g} K) s by the {published['label']}"


def family_of(study, method):
    """Whose colour and mark the method has, though it belongs to none."""
    return FAMILIES[[m.name for m in study.methods].index(method.name) % len(FAMILIES)]


def name_of(method, quantity):
    fit = method.fits.get(quantity)
    if fit is None:
        return method.name
    if fit.law == "exponential":
        return f"{method.name}  exp({fit.exponent:.2f} K)"
    return f"{method.name}  K" + f"{fit.exponent:.2f}".translate(RAISED)


def draw(study, quantity, wide):
    others = [f"{p['label']}, published" for p in study.published] if quantity == "seconds" else [TREES] if quantity == "tree" else []
    canvas, axes = frame_of(wide, [name_of(m, quantity) for m in study.methods] + others)
    largest = max(k for m in study.methods for k in m.line(quantity)[0])
    if quantity == "tree":
        largest = min(largest, 64)
    values = [v for m in study.methods for k, v in zip(*m.line(quantity)) if k <= largest]
    top = min(max(values), TALLEST_TREE) if quantity == "tree" else max(values)
    low, high = 10.0 ** math.floor(math.log10(min(values))), 10.0 ** math.ceil(math.log10(top) + 0.05)
    if quantity == "seconds" and study.published:
        high = max(high, 1e4)  # three hours, by which both published lines have left the methods far below
    axes.set_yscale("log")
    lines = []  # (text, colour, weight, [(K, value)])
    for published in study.published if quantity == "seconds" else []:
        rods = [1 + 63 * i / 200 for i in range(201)]
        curve = [(k, published["factor"] * math.exp(published["rate"] * k)) for k in rods]
        curve = [(k, v) for k, v in curve if low <= v <= high and k <= 1.15 * largest]
        lines.append((f"{published['label']}, published", MID, "normal", curve))
    if quantity == "tree":
        lines.append((TREES, MID, "normal", [(k, v) for k, v in enumerate(fibonacci(int(largest)), 1)
                                                                  if low <= v <= high]))
    lines = [line for line in lines if line[-1]]  # those of which a part is in the frame
    for text, _, _, curve in lines:
        canvas.line(axes, *zip(*curve), text, color=MID, linewidth=1.1, linestyle=(0, (6, 2.5)), zorder=2)
    for method in study.methods:
        some = [(k, v) for k, v in zip(*method.line(quantity)) if k <= largest]
        if not some:
            continue
        shown = style(family_of(study, method), 0, "open") | {"linewidth": 1.6, "markersize": 4.6, "zorder": 4}
        told = f"{name_of(method, quantity)}: " + "; ".join(f"K = {k:.0f}, {v:.3g}" for k, v in some)
        canvas.line(axes, *zip(*some), told, **shown)
        lines.append((name_of(method, quantity), shown["color"], "bold", [(k, v) for k, v in some if v <= high]))
    if quantity == "tree":
        axes.set_xlim(0, 1.04 * largest)
    else:
        twos = range(0, math.ceil(math.log2(largest)) + 1, 1 if wide is True else 2)
        axes.set_xscale("log")
        axes.set_xticks([2.0**k for k in twos], [str(2**k) for k in twos])
        axes.set_xticks([], minor=True)
        axes.set_xlim(0.88, largest * 1.15)
    decades = round(math.log10(high / low))
    stride = 1 if decades <= 8 else 2 if decades <= 14 else 5
    powers = [k for k in range(round(math.log10(low)), round(math.log10(high)) + 1) if k % stride == 0]
    axes.set_yticks([10.0**k for k in powers], [power_of_ten(k) for k in powers])
    axes.set_yticks([], minor=True)
    axes.set_ylim(low, high)
    canvas.labels(axes, "number K of constraints", TITLES[quantity])
    canvas.description = f"{TITLES[quantity]} against K: " + "; ".join(name_of(m, quantity) for m in study.methods)
    right_of(canvas, axes, [(text, *curve[-1], colour, "") for text, colour, _, curve in lines], "bold")
    return canvas


def fibonacci(count):
    """F(2), F(3), ...: the terms of the determinants of 1, 2, ... rows."""
    out, following = [1], 2
    while len(out) < count:
        out.append(following)
        following += out[-2]
    return out
