"""report.html of derived equations: a sentence, a table of the methods, the figures, and folded what lies behind them."""
import json
import math

import folded
import papers as paper_figures
from command import table, write
from derivation_figures import drawings, family_of
from equation import prose
from families import mark
from figures import saved
from page import document, figure
from wording import counted, number, plain_text, text


def report(study):
    pictures = saved(drawings(study), study.folder / "figures", small=True)
    rows = [row_of(m) for m in study.methods]
    said = {"case": "equations", "title": study.head["title"], "question": "", "answer": "growth of equations",
            "sentence": plain_text(finding(study)), "below": "", "methods": rows, "assertions": []}
    write(study.folder / "verdict.csv", table(rows))
    write(study.folder / "report.json", json.dumps({"schema": 1, "experiment": study.head["name"], "cases": [said]}, indent=1,
                                                   ensure_ascii=False) + "\n")
    write(study.folder / "report.html", document(study.head["title"], plain_text(finding(study)), body(study, pictures)))
    return {"report": str(study.folder / "report.html")}


def row_of(method):
    """A row of verdict.csv: the largest equations that the method was given, and the law by which operations grow."""
    last, fit = method.points[-1], method.fits.get("operations")
    return {"case": "equations", "method": method.name, "constraints": last["K"], "equations": last["equations"],
            "operations": last["operations"], "seconds": None if math.isnan(last["seconds"]) else last["seconds"],
            "law": fit.law if fit else "", **{k: getattr(fit, k) if fit else None for k in ("exponent", "low", "high")}}


def papers(study, wanted):
    target = study.folder / "figures" / "paper"
    with paper_figures.settings(wanted, target):
        for drawing in drawings(study):
            paper_figures.figure(drawing, wanted, target, paper_figures.caption(study.head, drawing, plain_text(finding(study)), {}))


def grown(fit):
    """HTML: the law with its exponent."""
    if fit is None:
        return "–"
    return f"K<sup>{fit.exponent:.2f}</sup>" if fit.law == "power" else f"e<sup>{fit.exponent:.3f} K</sup>"


def finding(study):
    """HTML: how the first method grows, and how the published times do."""
    first = study.methods[0]
    last, fit = first.points[-1], first.fits.get("operations")
    said = (f"By <b>{text(first.name)}</b> the {last['equations']:.0f} equations of {last['K']:.0f} constraints take "
            f"{last['operations']:.0f} operations, derived in {number(last['seconds'])} s")
    said += f", and grow like {grown(fit)}" if fit else ""
    rates = " and ".join(f"e<sup>{p['rate']:g} K</sup>" for p in study.published)
    return said + (f"; published times for one pair grew like {rates}." if rates else ".")


def body(study, pictures):
    head = study.head
    out = ["<header>", '<p class="kicker">Pfaff experiment report</p>', f"<h1>{text(head['title'])}</h1>",
           f'<p class="find">{finding(study)}</p>']
    if head.get("quick"):
        out.append('<p class="notice"><strong>Quick run.</strong> Sizes were cut down to see that everything works; draw no '
                   "conclusions from it.</p>")
    out += ["</header>", "<main>", methods_table(study)]
    for drawing, wide, narrow in pictures:
        out += [f'<h3 id="{drawing.name}">{text(drawing.title)}</h3>', figure([(drawing, wide, narrow)], drawing.name)]
    out += ["</main>", '<footer id="runs">', "<h2>Derivations, commands, provenance</h2>",
            folded.folds("About the experiment", f'<p>{prose(head["description"])}</p>' if head.get("description") else ""),
            folded.folds("Every derivation", every_derivation(study)),
            folded.folds("Commands", commands(study)), folded.folds("Provenance", folded.provenance(study)),
            folded.folds("Notes and sources", folded.notes(head) + folded.citations(head)), "</footer>"]
    return out


def interval(fit):
    if fit is None:
        return '<td class="na">–</td>'
    digits = 2 if fit.law == "power" else 3
    return (f'<td title="95 %: {fit.low:.{digits}f} to {fit.high:.{digits}f}">{grown(fit)} '
            f"<small>± {(fit.high - fit.low) / 2:.{digits}f}</small></td>")


def methods_table(study):
    rows = []
    for method in study.methods:
        last = method.points[-1]
        family = family_of(study, method)
        rows.append(
            f'<tr><th scope="row">{mark(family, "open")}<span class="c-{family.key}">{text(method.name)}</span></th>'
            f'<td>{text(method.title)}</td>'
            f'<td class="r">{last["K"]:.0f}</td><td class="r">{last["operations"]:.0f}</td>'
            f'<td class="r">{number(last["seconds"])}</td>' + "".join(interval(method.fits.get(q))
                                                                      for q in ("operations", "seconds", "tree")) + "</tr>")
    return ('<div class="scroll"><table class="verdict"><caption>Every method at the largest number K of constraints that it was '
            "given, and how its equations grow. ± is half of an interval of 95 %. Without sharing means that every expression is "
            'written out wherever it is used.</caption><thead><tr><th>method</th><th></th><th class="r">K</th>'
            '<th class="r">operations</th><th class="r">seconds</th><th>operations grow</th><th>time grows</th>'
            f'<th>without sharing</th></tr></thead><tbody>{"".join(rows)}</tbody></table></div>')


def every_derivation(study):
    rows = "".join(
        f'<tr><td>{text(m.name)}</td><td class="number">{p["K"]:.0f}</td><td class="number">{p["equations"]:.0f}</td>'
        f'<td class="number">{p["operations"]:.0f}</td><td class="number">{p["nodes"]:.0f}</td>'
        f'<td class="number">{number(p["tree"])}</td><td class="number">{number(p["seconds"])}</td></tr>'
        for m in study.methods for p in m.points)
    return (f'<div class="scroll"><table><thead><tr><th>method</th><th class="number">K</th><th class="number">equations</th>'
            '<th class="number">operations</th><th class="number">nodes</th><th class="number">operations without sharing</th>'
            f'<th class="number">seconds</th></tr></thead><tbody>{rows}</tbody></table></div>'
            f"<p>{counted(sum(len(m.points) for m in study.methods), 'derivation')}.</p>")


def commands(study):
    head = study.head
    quick = " --quick" if head.get("quick") else ""
    first = study.methods[0].name
    return (f"<p>The experiment again:</p><pre>{text('pfaff compare ' + head['name'] + quick)}</pre>"
            f"<p>One set of equations as text:</p><pre>"
            f"{text('pfaff derive ' + head['system'] + ' --method ' + first + ' --emit latex')}</pre>")
