"""The index of experiments: of each its first figure and what its report says, and a table of all methods and problems."""
import re

from canvas import recoloured
from families import FAMILIES, family_named, mark
from figures import slug
from page import document
from wording import counted, text, two_digits

FILLS = {"yes": "full", "no": "open", "not known": "half"}  # of marks, by whether the structure is kept


def page(reported):
    """The page of what was reported."""
    count = f"{counted(len(reported), 'experiment')}, {counted(sum(len(r.problems) for r in reported), 'problem')}"
    body = ["<header>", '<p class="kicker">Pfaff index of experiments</p>', f"<h1>{count}</h1>"]
    if any(r.head.get("quick") for r in reported):
        body.append('<p class="notice"><strong>Quick runs are among them.</strong> Their times and steps were cut down to see that '
                    "everything works; draw no conclusions from them.</p>")
    body += ['<nav><a href="#methods">Methods and problems</a> ' + " ".join(
        f'<a href="#{text(r.head["name"])}">{text(r.head["name"])}</a>' for r in reported) + "</nav></header>", "<main>"]
    body += ['<div class="cards">', *(card(r) for r in reported), "</div>", table(reported), "</main>"]
    return document("Pfaff: index of experiments", count, body)


def card(reported):
    """An experiment: its title, its first figure, and what its report says of each case."""
    name, link = text(reported.head["name"]), text(reported.link)
    drawing = re.sub(r'(\bid="|href="#|url\(#)small', rf"\g<1>{name}", recoloured(reported.picture.partition("?>")[2]))
    several = len(reported.cases) > 1
    said = "".join(f"<p>{titled(c) if several else ''}{powers(text(c['sentence']))}</p>" for c in reported.cases)
    return (f'<section class="card" id="{name}"><h2><a href="{link}">{text(reported.head["title"])}</a></h2>'
            f'<figure><a href="{link}">{drawing}</a></figure>{said}</section>')


def titled(case):
    return f"<strong>{text(case['title'])}.</strong> "


def powers(escaped):
    """HTML: exponents raised, as of 10^-6, t^0.5 ± 0.1 and e^0.04 K."""
    return re.sub(r"\^([-−]?[0-9]+(?:\.[0-9]+)?(?: ± [0-9.]*[0-9]| K)?)", r"<sup>\1</sup>", escaped)


def table(reported):
    """Who keeps what, and what it costs: a row for each method, a column for each problem."""
    columns = [(r, case) for r in reported for case in r.problems]
    rows = {}
    for k, (_, case) in enumerate(columns):
        for row in case["methods"]:
            rows.setdefault(row["method"], {})[k] = row
    order = [f.key for f in FAMILIES]
    families = {method: usual_family(cells) for method, cells in rows.items()}
    heads = "".join(f'<th scope="col"><a href="{text(r.link)}#case-{slug({"name": case["case"]})}">'
                    f'{text(r.head["name"])}: {text(case["case"])}</a></th>' for r, case in columns)
    body = []
    for method in sorted(rows, key=lambda m: (order.index(families[m].key), claimed(rows[m]), m)):
        cells = "".join(cell(rows[method].get(k), case) for k, (_, case) in enumerate(columns))
        body.append(f'<tr><th scope="row"><span class="c-{families[method].key}">{text(method)}</span></th>{cells}</tr>')
    return ('<h2 id="methods">Methods and problems</h2><p class="where">Numbers say how many times as much as the cheapest method a '
            "method costs at the error that the sentence of the report speaks of; there is none where its runs do not lie on both "
            "sides of that error. A filled mark: it keeps the structure; an open one: it does not; half of one: this is not known. "
            "↗: the conserved quantity drifts away at equal cost, or in the nearest run of a method that cannot cost this. Pointed at, a "
            "cell tells more.</p>"
            '<div class="scroll" tabindex="0" role="region" aria-label="methods and problems">'
            f'<table class="overview"><thead><tr><th></th>{heads}</tr></thead><tbody>{"".join(body)}</tbody></table></div>')


def usual_family(row):
    """Of the problems of a method the family that it most often has: a name may stand for another method in another experiment."""
    named = [family_named(cells["family"]) for cells in row.values()]
    return max(named, key=named.count)


def claimed(row):
    """The largest order that a method claims of the problems."""
    return max(cells["order_claimed"] or 0 for cells in row.values())


def cell(row, case):
    if row is None:
        return "<td></td>"
    fill = FILLS.get(row["structure_kept"], "open")
    kept = {"yes": "keeps the structure", "no": "does not keep the structure"}.get(row["structure_kept"], "")
    drift = f"{row['quantity']} {row['drift_class']} {row['drift']:.1e}" if row["drift"] is not None else ""
    error = f"error {row['error']:.1e} at equal cost" if row["error"] is not None else ""
    failed = f"{row['failed']} of {row['runs']} runs failed" if row["failed"] else ""
    told = "; ".join(x for x in (f"{row['method']}, {case['title']}", kept, drift, error, failed) if x)
    ratio = f"{two_digits(row['ratio'])}" if row["ratio"] is not None else "–" if not failed else "failed"
    drifts = row["drifts"] == "yes"
    classes = " ".join(x for x in ("best" if row["cheapest"] else "", "bad" if drifts else "") if x)
    return (f'<td class="{classes}" title="{text(told)}">{mark(family_named(row["family"]), fill)}'
            f'<span class="cls">{ratio}{" ↗" if drifts else ""}</span></td>')
