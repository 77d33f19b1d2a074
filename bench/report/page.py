"""report.html: one file without scripts or anything fetched, for a screen of any width and for paper.

Order: what was run, what it shows, then every case with its figures and tables, then what the classes of drift say,
how to make it again and whom to cite. Every figure is inlined twice, wide and narrow; the style sheet shows the one that fits the screen.
"""
import html
import math
import pathlib
import re

import tables
from figures import heading, slug
from findings import findings

POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"


def text(value):
    return html.escape(str(value))


def page(experiment, drawn):
    """The page; `drawn` maps a case's name to its [(drawing, wide svg, narrow svg)]."""
    head = experiment.head
    style = (pathlib.Path(__file__).parent / "page.css").read_text(encoding="utf-8")
    body = [opening(experiment), summary(experiment)]
    body += [section(experiment, case, drawn[case["name"]]) for case in experiment.cases]
    body += [tables.drift_classes(experiment), notes(head), provenance(head), citations(head)]
    return "\n".join([
        "<!DOCTYPE html>", '<html lang="en">', "<head>", '<meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{text(head['title'])}</title>", f"<style>\n{style}</style>", "</head>", "<body>",
        *filter(None, body), "</body>", "</html>", ""])


def opening(experiment):
    head, runs = experiment.head, experiment.runs
    failed = sum(r.failed for r in runs)
    out = ["<header>", f"<h1>{text(head['title'])}</h1>"]
    if head.get("description"):
        out.append(f'<p class="lead">{text(head["description"])}</p>')
    if head.get("quick"):
        out.append('<p class="notice"><strong>Quick run.</strong> Times and steps were cut down to see that everything '
                   "works; draw no conclusions from it.</p>")
    used = len({r.method for r in runs})
    out.append(f"<p>{count(len(experiment.cases), 'case')}, {count(used, 'method')}, {count(len(runs), 'run')}"
               + (f", of which <strong>{failed} failed</strong>" if failed else ", all finished") + ". "
               + ("Timings come from a separate serial pass: the median of repetitions, with its spread."
                  if experiment.timed else "Timings were not measured.") + "</p></header>")
    out += ["<h2>What was run</h2>", tables.cases(experiment), tables.methods(experiment)]
    return "\n".join(out)


def count(n, noun):
    return f"{n} {noun}" + ("" if n == 1 else "s")


def summary(experiment):
    out = ["<h2>Findings</h2>", "<p>Every sentence is computed from the data below.</p>",
           tables.overview(experiment)]
    for case in experiment.cases:
        out.append(f'<h3><a href="#case-{text(slug(case))}">{text(heading(case))}</a></h3>')
        said = findings(experiment, case)
        out.append(f"<ul>{''.join(map(finding, said))}</ul>" if said else "<p>Nothing to compare.</p>")
    return "\n".join(out)


def finding(found):
    subject, sentence, items = found
    return (f"<li><strong>{text(subject)}.</strong> {text(sentence)}"
            + ("<ul>" + "".join(f"<li>{powers(text(i))}</li>" for i in items) + "</ul>" if items else "") + "</li>\n")


def powers(escaped):
    """t^0.5 with a raised exponent."""
    return re.sub(r"\b([ht])\^(-?[0-9.]*[0-9])", r"\1<sup>\2</sup>", escaped)


def section(experiment, case, drawn):
    out = [f'<section id="case-{text(slug(case))}">', f"<h2>{text(heading(case))}</h2>"]
    for drawing, wide, narrow in drawn:
        out.append(f"<figure>\n{picture(drawing, wide, 'wide')}\n{picture(drawing, narrow, 'narrow')}\n"
                   f"<figcaption>{text(drawing.caption)}</figcaption></figure>")
    absent = missing(experiment, case, {drawing.kind for drawing, *_ in drawn})
    if absent:
        out.append(f"<p>{text(absent)}</p>")
    if case.get("seeds"):
        return "\n".join(out + [tables.spreads(experiment, case), "</section>"])
    out += [tables.results(experiment, case), tables.invariants(experiment, case), "</section>"]
    return "\n".join(out)


def picture(drawing, svg, width):
    return svg.replace("<svg ", f'<svg class="{width}" role="img" aria-label="{text(drawing.title)}" ', 1)


def missing(experiment, case, kinds):
    """Why a figure is not there."""
    if case.get("seeds"):
        return ""
    why = []
    if "drift" not in kinds:
        why.append("no figure of drift, because " + ("no run left a series" if case.get("conserved")
                                                     else "the case names no conserved quantity"))
    if "work_precision" not in kinds:
        errors = any(math.isfinite(r.number("error_max")) for r in experiment.runs_of(case))
        why.append("no figure of work and precision, because " + ("no run with an error finished" if errors
                                                                  else "the case has no reference solution"))
    if "structure" not in kinds:
        why.append("no figure of structure, because no structure residual was measured")
    return f"There is {'; there is '.join(why)}." if why else ""


def notes(head):
    lines = head.get("notes") or []
    return "<h2>Notes</h2>\n<ul>" + "\n".join(f"<li>{text(n)}</li>" for n in lines) + "</ul>" if lines else ""


def provenance(head):
    rows = [(k, v) for k, v in (head.get("versions") or {}).items() if v not in (None, "")]
    rows.append(("make it again", f"pfaff compare {head['name']}" + (" --quick" if head.get("quick") else "")))
    rows.append(("data", "experiment.json, results.csv, cost.csv and runs/ beside this page; figures/ holds the "
                 "figures as SVG and PNG"))
    return ("<h2>Provenance</h2>\n<dl>"
            + "\n".join(f"<dt>{text(k)}</dt><dd>{text(v)}</dd>" for k, v in rows) + "</dl>")


def citations(head):
    lines, keys = head.get("citation") or [], head.get("reference") or []
    if not lines and not keys:
        return ""
    return ("<h2>Please cite</h2>\n" + (f"<p>Keys: {text(', '.join(keys))}</p>\n" if keys else "")
            + "<ul>" + "\n".join(f"<li>{text(line)}</li>" for line in lines) + "</ul>")
