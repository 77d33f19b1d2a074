"""report.html: one file in which nothing is fetched, for a screen of any width, light or dark, and for paper.

Order: the sentence, then every case with its verdict table and figures, then, folded, what lies behind them. Every figure is
inlined twice, wide and narrow; the style sheet shows the one that fits the screen. Everything but sorting the table works
without the one inline script.
"""
import base64
import hashlib
import pathlib

import constraints
import folded
import structure
from canvas import BAND, FRONT, GREY, INK, MID, PAPER, RULE
from experiment import DIRECTIONS
from families import FAMILIES, mark
from figures import heading, slug
from first_screen import above, below, finding, holds
from verdict_table import table
from wording import plain_text, power, text

DARK = {"paper": "#151618", "ink": "#ececea", "mid": "#a5a6ab", "rule": "#383a3f", "grey": "#6d6f76", "band": "#1f2226",
        "front": "#4c431f", "soft": "#1c1e21", "bad": "#ff9a76", "good": "#6fd6a8"} | {f.key: f.dark for f in FAMILIES}
LIGHT = {"paper": PAPER, "ink": INK, "mid": MID, "rule": RULE, "grey": GREY, "band": BAND, "front": FRONT, "soft": "#f6f6f4",
         "bad": "#a3330f", "good": "#0d6b49"} | {f.key: f.light for f in FAMILIES}

SECTIONS = (("work", "Work and precision", ("work_precision", "work_precision_evaluations")),
            ("drift", "Drift at equal cost", ("drift",)), ("structure", "Structure", ("structure",)),
            ("loop", "Poincaré's integral invariant", ("loop",)),
            ("reversibility", "Reversibility along the run", ("reversibility",)),
            ("frequencies", "Frequencies", ("frequencies",)),
            ("motion", "Motion", ("motion", "section")), ("contraction", "Contraction of areas", ("contraction",)), ("constraints", "Constraints", ("constraints",)),
            ("spread", "Spread over the seeds", ("bands", "ensemble")))


def sections(experiment):
    """SECTIONS, and before the last one for each measure that has no figure of its own."""
    measures = [(f"measure-{name}", measure["title"], (f"measure-{name}",)) for name, measure in experiment.measures.items()]
    return (*SECTIONS[:-1], *((key, text(title), kinds) for key, title, kinds in measures), SECTIONS[-1])


def page(experiment, verdicts, drawn):
    """The page; `drawn` maps a case's name to its [(drawing, wide svg, narrow svg)]."""
    body = [opening(experiment, verdicts, drawn), "<main>"]
    body += [section(experiment, v, drawn[v.case["name"]], first=k == 0) for k, v in enumerate(verdicts)]
    body += ["</main>", folded.footer(experiment, verdicts, drawn, lambda d: figure([d], ""))]
    return document(experiment.head["title"], plain_text(finding(verdicts[0])), body)


def document(title, description, body):
    """The page around its parts, with style sheet and script, and leave to run that script alone."""
    here = pathlib.Path(__file__).parent
    script = (here / "page.js").read_text(encoding="utf-8")
    digest = base64.b64encode(hashlib.sha256(script.encode("utf-8")).digest()).decode("ascii")
    policy = f"default-src 'none'; style-src 'unsafe-inline'; img-src data:; script-src 'sha256-{digest}'"
    return "\n".join([
        "<!DOCTYPE html>", '<html lang="en">', "<head>", '<meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f'<meta name="description" content="{text(description)}">',
        f"<title>{text(title)}</title>",
        f"<style>\n{colours()}{(here / 'page.css').read_text(encoding='utf-8')}</style>", "</head>", "<body>",
        *filter(None, body), f"<script>{script}</script>", "</body>", "</html>", ""])


def colours():
    def block(some):
        return ";".join(f"--{k}:{v}" for k, v in some.items())
    classes = "".join(f".c-{f.key}{{color:var(--{f.key})}}" for f in FAMILIES)
    return (f":root{{{block(LIGHT)};color-scheme:light}}\n"
            f"@media screen and (prefers-color-scheme:dark){{:root{{{block(DARK)};color-scheme:dark}}}}\n{classes}\n")


def opening(experiment, verdicts, drawn):
    head, first = experiment.head, verdicts[0]
    out = ["<header>", '<p class="kicker">Pfaff experiment report</p>', f"<h1>{text(head['title'])}</h1>",
           above(first), f'<p class="find">{finding(first)}</p>']
    if head.get("quick"):
        out.append('<p class="notice"><strong>Quick run.</strong> Times and steps were cut down to see that everything '
                   "works; draw no conclusions from it.</p>")
    second = below(first)
    out.append(f'<p class="where">{second + "<br>" if second else ""}{holds(first)}</p>')
    if len(verdicts) > 1:
        links = " ".join(f'<a href="#case-{slug(v.case)}">{text(heading(v.case))}</a>' for v in verdicts)
        out.append(f"<nav>{links} <a href=\"#runs\">Runs and provenance</a></nav></header>")
    else:
        name = slug(first.case)
        kinds = {d.kind for d, *_ in drawn[first.case["name"]]}
        links = " ".join(f'<a href="#{key}-{name}">{title}</a>' for key, title, some in sections(experiment) if kinds & set(some))
        out.append(f'<nav><a href="#case-{name}">Verdict</a> {links} <a href="#runs">Runs and provenance</a></nav></header>')
    return "\n".join(out)


def section(experiment, verdict, drawn, first):
    case, name = verdict.case, slug(verdict.case)
    out = [f'<section class="case" id="case-{name}">', f"<h2>{text(heading(case))}</h2>"]
    if not first:
        second = below(verdict)
        alike = all(case.get(k) == experiment.cases[0].get(k) for k in ("equation", "question"))
        asked = "" if alike else above(verdict)
        out += [asked, f'<p class="casefind">{finding(verdict)}</p>',
                f'<p class="where">{second + "<br>" if second else ""}{holds(verdict)}</p>']
    out.append(table(verdict))
    for _, said, items in constraints.claims(experiment, case):
        out.append(f"<h3>Claims</h3><p class=\"lede\">{text(said)}</p><ul>{''.join(f'<li>{text(i)}</li>' for i in items)}</ul>")
    for key, title, kinds in sections(experiment):
        some = [d for d in drawn if d[0].kind in kinds]
        if some:
            out.append(f'<h3 id="{key}-{name}">{title}</h3>')
            if key == "structure":
                out.append(f'<p class="lede">{structure.lede(verdict)}</p>')
            shown = figure(some, f"{key}-{name}")
            cheapest = cheapest_table(verdict) if key == "work" else ""
            out.append(f'<div class="grid">{shown}<div>{cheapest}</div></div>' if cheapest else shown)
        if key == "motion":
            out += [animation(d, svg) for d, svg, _ in drawn if d.kind == "animation"]
    absent = missing(verdict, {d.kind for d, *_ in drawn})
    if absent:
        out.append(f'<p class="where">{text(absent)}</p>')
    return "\n".join(out + ["</section>"])


def figure(some, name):
    """The drawings as one figure; of several, one is shown at a time."""
    if len(some) == 1:
        drawing, wide, narrow = some[0]
        return f"<figure>{pictures(drawing, wide, narrow)}\n<figcaption>{text(drawing.caption)}</figcaption></figure>"
    tabs = "".join(f'<input type="radio" name="{name}" id="{name}-{k}"{" checked" if k == 0 else ""}>'
                   f'<label for="{name}-{k}">{text(d.tab)}</label>' for k, (d, *_) in enumerate(some))
    panes = "".join(f'<div class="pane p{k}">{pictures(d, wide, narrow)}</div>' for k, (d, wide, narrow) in enumerate(some))
    return f'<figure class="tabs">{tabs}{panes}\n<figcaption>{text(some[0][0].caption)}</figcaption></figure>'


def animation(drawing, svg):
    return f"<details><summary>Animation</summary><figure>{svg}<figcaption>{text(drawing.caption)}</figcaption></figure></details>"


def pictures(drawing, wide, narrow):
    return "\n".join(svg.replace("<svg ", f'<svg class="{width}" role="img" aria-label="{text(drawing.title)}" ', 1)
                     for svg, width in ((wide, "wide"), (narrow, "narrow")))


def cheapest_table(verdict):
    """Who is cheapest at each power of ten at which two methods or more are ranked, down to where round-off rules."""
    floor = verdict.floor()
    rows = []
    for k in range(1, 16):
        target = float(f"1e-{k}")
        ranked = verdict.ranked(target)
        if len(ranked) < 2 or target < floor:
            continue
        best, keeping = ranked[0], next((r for r in ranked if r.curve.kept), None)
        rows.append(f'<tr><th scope="row">{power(-k)}</th>{cheapest_cell(verdict, best, target)}'
                    + (cheapest_cell(verdict, keeping, target) if verdict.structured else "") + "</tr>")
    if not rows:
        return ""
    what = text(verdict.measure.noun)
    keeping = '<th colspan="2">keeping the structure</th>' if verdict.structured else ""
    return (f'<table class="mini"><caption>Cheapest at each {what}</caption><thead><tr><th>{what}</th><th colspan="2">of those ranked</th>'
            f'{keeping}</tr></thead><tbody>{"".join(rows)}</tbody></table>')


def cheapest_cell(verdict, row, target):
    if row is None:
        return '<td class="na">–</td><td></td>'
    return (f'<td>{mark(row.curve.family, row.curve.fill)}<span class="c-{row.curve.family.key}">'
            f'{text(row.label)}</span></td><td class="r">{verdict.cost_text(row.times[target][0])}</td>')


def missing(verdict, kinds):
    """Why a figure is not there."""
    if verdict.case.get("seeds"):
        return ""
    why = []
    if "drift" not in kinds:
        why.append("no figure of drift, because " + ("the case names no conserved quantity" if not verdict.invariant
                                                     else "the error of a quantity that changes is seen only beside an "
                                                     "accurate solution" if verdict.expected in DIRECTIONS and not
                                                     verdict.of_state else "no run left a series"))
    if "work_precision" not in kinds:
        why.append("no figure of work and precision, because " + (
            "no run with an error finished" if verdict.relative or verdict.comparable else
            "the case has no reference solution"))
    if "structure" not in kinds:
        why.append("no figure of structure, because no structure residual was measured")
    return f"There is {'; there is '.join(why)}." if why else ""
