"""Families of methods. A family has one colour and one mark in every report, so that it is recognised from report to report.

A method belongs to the family that its plug-in names, by the key below, and to the last one where it names none of these. Colours
come in pairs, for light and for dark paper; that families also differ in their marks keeps them apart in grey and for every kind of
sight. Within a family lines are solid, dashed, dotted and dash-dotted, by falling order. A filled mark says that the method keeps
the structure of its problem, an open one that it does not or that there is none, and one of which half is filled that this is not known.
"""
import dataclasses

LINES = 6  # of a panel that have a colour and a name


@dataclasses.dataclass(frozen=True)
class Family:
    key: str  # as style sheets name it
    plural: str  # as sentences name it
    light: str
    dark: str
    mark: str  # as matplotlib names it


FAMILIES = (
    Family("generating", "generating functions", "#003b68", "#3292f4", "o"),
    Family("darboux", "Gauss in Darboux coordinates", "#9a41ba", "#c784c4", "D"),
    Family("nonholonomic", "nonholonomic integrators", "#3b1a8f", "#feb2ff", "P"),
    Family("constrained", "methods on the constraints", "#6b0a26", "#ff486a", "p"),
    Family("gauss", "Gauss collocation", "#8f3413", "#fb894b", "s"),
    Family("splitting", "splittings and compositions", "#157b62", "#73e4c9", "^"),
    Family("multistep", "multistep methods", "#2d3f87", "#9db2ff", "X"),
    Family("explicit", "structure-blind methods", "#86761c", "#f0dd9c", "v"),
    Family("other", "other methods", "#443b47", "#b8a693", "h"))

DASHES = ("-", (0, (5, 1.8)), (0, (1.4, 1.4)), (0, (6, 1.6, 1.4, 1.6)),
          (0, (10, 3)), (0, (3, 1.2, 1, 1.2, 1, 1.2)))

# The marks in a box from 0 to 12, as SVG has them.
SHAPES = {"o": '<circle cx="6" cy="6" r="4.4"/>', "s": '<rect x="2" y="2" width="8" height="8"/>',
          "D": '<path d="M6 .9 11.1 6 6 11.1 .9 6Z"/>', "^": '<path d="M6 1.3 11 10.2H1Z"/>',
          "v": '<path d="M6 10.7 11 1.8H1Z"/>', "p": '<path d="M6 1 11 4.7 9.1 10.6H2.9L1 4.7Z"/>',
          "P": '<path d="M4.3 1H7.7V4.3H11V7.7H7.7V11H4.3V7.7H1V4.3H4.3Z"/>',
          "X": '<path d="M3.4 1 6 3.6 8.6 1 11 3.4 8.4 6 11 8.6 8.6 11 6 8.4 3.4 11 1 8.6 3.6 6 1 3.4Z"/>',
          "h": '<path d="M6 .8 10.5 3.4V8.6L6 11.2 1.5 8.6V3.4Z"/>'}


def family_named(key):
    """The family of that key; the last one where there is none, as of methods from outside the tree."""
    return next((f for f in FAMILIES if f.key == key), FAMILIES[-1])


def mark(family, fill):
    """The mark as an SVG element, in the family's colour on whatever paper; the fill is "full", "open" or "half"."""
    shape = SHAPES[family.mark]
    half = f'<svg class="part" width="6" height="12" viewBox="0 0 6 12">{shape}</svg>' if fill == "half" else ""
    return (f'<svg class="mk {"full" if fill == "full" else "open"}" style="--c:var(--{family.key})" width="12" height="12" '
            f'viewBox="0 0 12 12" aria-hidden="true">{shape}{half}</svg>')


def style(family, rank, fill):
    """Line and marker of the method that is the rank-th of its family, as matplotlib takes them."""
    colour = family.light
    return {"color": colour, "linestyle": DASHES[rank % len(DASHES)], "marker": family.mark, "markersize": 5,
            "fillstyle": "left" if fill == "half" else "full", "markerfacecolor": "#fefefe" if fill == "open" else colour,
            "markerfacecoloralt": "#fefefe", "markeredgecolor": colour, "markeredgewidth": 1.2}
