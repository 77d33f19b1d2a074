"""What lies behind the verdicts, folded at the end of the page: the experiment, numbers in words, every run, commands and
provenance."""
import re

import tables
from figures import heading
from findings import findings
from wording import counted, text


def footer(experiment, verdicts, drawn, picture):
    head = experiment.head
    out = ['<footer id="runs">', "<h2>Runs, commands, provenance</h2>", folds("About the experiment", about(experiment))]
    for verdict in verdicts:
        case, name = verdict.case, text(heading(verdict.case))
        runs = [r for r in experiment.runs if r.case == case["name"]]
        more = [d for d in drawn[case["name"]] if d[0].kind == "drift_at_equal_step"]
        if more:
            out.append(folds(f"Drift at equal step: {name}", "".join(map(picture, more))))
        said = findings(experiment, case)
        if said:
            out.append(folds(f"In numbers: {name}", f"<ul>{''.join(map(finding, said))}</ul>"))
        results = (tables.spreads(experiment, case) if case.get("seeds") else
                   tables.results(experiment, case) + tables.invariants(experiment, case))
        out.append(folds(f"Every run: {name} ({len(runs)})", results))
    out += [folds("Commands", commands(experiment)), folds("Classes of drift", tables.drift_classes(experiment)),
            folds("Provenance", provenance(experiment)), folds("Notes and sources", notes(head) + citations(head)), "</footer>"]
    return "\n".join(filter(None, out))


def folds(summary, content):
    return f"<details><summary>{summary}</summary>{content}</details>" if content else ""


def about(experiment):
    head, runs = experiment.head, experiment.runs
    failed, used = sum(r.failed for r in runs), len({r.method for r in runs})
    return ((f'<p class="lead">{text(head["description"])}</p>' if head.get("description") else "")
            + f"<p>{counted(len(experiment.cases), 'case')}, {counted(used, 'method')}, {counted(len(runs), 'run')}"
            + (f", of which <strong>{failed} failed</strong>" if failed else ", all finished") + ". "
            + ("Timings come from a separate serial pass." if experiment.timed else "Timings were not measured.") + "</p>"
            + tables.cases(experiment) + tables.methods(experiment) + tables.overview(experiment))


def finding(found):
    subject, sentence, items = found
    return (f"<li><strong>{text(subject)}.</strong> {text(sentence)}"
            + ("<ul>" + "".join(f"<li>{powers(text(i))}</li>" for i in items) + "</ul>" if items else "") + "</li>\n")


def powers(escaped):
    """t^0.5 with a raised exponent."""
    return re.sub(r"\b([ht])\^(-?[0-9.]*[0-9])", r"\1<sup>\2</sup>", escaped)


def commands(experiment):
    head = experiment.head
    again = f"pfaff compare {head['name']}" + (" --quick" if head.get("quick") else "")
    slug = next((r.slug for r in experiment.runs if r.slug), "")
    out = f"<p>The experiment again:</p><pre>{text(again)}</pre>"
    return out + (f"<p>One run of it again, from its settings beside this page; the tables name the runs:</p><pre>"
                  f"{text(f'pfaff run --config runs/{slug}/config.toml --out {slug}')}</pre>" if slug else "")


def provenance(experiment):
    head = experiment.head
    rows = [(k, v) for k, v in (head.get("versions") or {}).items() if v not in (None, "")]
    rows.append(("data", "experiment.json, results.csv, cost.csv and runs/ beside this page; figures/ holds the figures as SVG "
                 "and PNG"))
    return "<dl>" + "\n".join(f"<dt>{text(k)}</dt><dd>{text(v)}</dd>" for k, v in rows) + "</dl>"


def notes(head):
    lines = head.get("notes") or []
    return "<ul>" + "\n".join(f"<li>{text(n)}</li>" for n in lines) + "</ul>" if lines else ""


def citations(head):
    lines, keys = head.get("citation") or [], head.get("reference") or []
    if not lines and not keys:
        return ""
    return ("<p><strong>Please cite</strong>" + (f" ({text(', '.join(keys))})" if keys else "") + "</p>\n<ul>"
            + "\n".join(f"<li>{text(line)}</li>" for line in lines) + "</ul>")
