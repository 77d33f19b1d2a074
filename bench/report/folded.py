"""What lies behind the verdicts, folded at the end of the page: the experiment, numbers in words, every run, commands and
provenance."""
import itertools
import re

import tables
from bibliography import entries, link
from curves import CONTENDED
from equation import prose
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
            folds("Numbers of a quantity", tables.fields(experiment)),
            folds("Provenance", provenance(experiment)), folds("Notes and sources", notes(head, on_tables(experiment)) + citations(head)), "</footer>"]
    return "\n".join(filter(None, out))


def folds(summary, content):
    return f"<details><summary>{summary}</summary>{content}</details>" if content else ""


def about(experiment):
    head, runs = experiment.head, experiment.runs
    failed, used = sum(r.failed for r in runs), len({r.method for r in runs})
    return ((f'<p class="lead">{prose(head["description"])}</p>' if head.get("description") else "")
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
    again = f"pfaff compare {head.get('asked_for') or head['name']}" + (" --quick" if head.get("quick") else "")
    slug = next((r.slug for r in experiment.runs if r.slug), "")
    out = f"<p>The experiment again:</p><pre>{text(again)}</pre>"
    if not slug:
        return out
    one = f"pfaff run --config runs/{slug}/config.toml --out {slug}\npfaff plot runs/{slug}"
    return out + ("<p>One run of it again, from its settings beside this page, and its pictures. In the tables each run links to "
                  f"its settings and its samples:</p><pre>{text(one)}</pre>")


def provenance(experiment):
    head = experiment.head
    rows = [(k, v) for k, v in (head.get("versions") or {}).items() if v not in (None, "")]
    machine = experiment.machine
    rows += [(said, machine[key]) for key, said in (("cpu", "processor"), ("system", "system"), ("host", "machine"),
                                                    ("date", "timed")) if machine.get(key)]
    if machine.get("load"):
        rows.append(("load", f"{' and '.join(f'{x:.2f}' for x in machine['load'])} processes before and after the timings, on "
                     f"{machine.get('processors')} processors"))
    spread = spreads_of_timings(experiment)
    if spread:
        rows.append(("spread of timings", spread))
    files = [name for name in ("experiment.json", *experiment.tables, "machine.json") if (experiment.folder / name).exists()]
    links = ", ".join(f'<a href="{name}">{name}</a>' for name in files)
    return ("<dl>" + "\n".join(f"<dt>{text(k)}</dt><dd>{text(v)}</dd>" for k, v in rows)
            + f"<dt>data</dt><dd>beside this page: {links}; runs/ with a directory for each run</dd>"
            + f"<dt>figures</dt><dd>{figures_list(experiment)}</dd></dl>")


def figures_list(experiment):
    """The figures beside the page, as SVG and, where they stand still, PNG."""
    folder = experiment.folder / "figures"
    shown = []
    for path in sorted(folder.glob("*.svg")):
        png = path.with_suffix(".png")
        shown.append(f'<a href="figures/{text(path.name)}">{text(path.name)}</a>'
                     + (f' (<a href="figures/{text(png.name)}">PNG</a>)' if png.exists() else ""))
    return ", ".join(shown)


def spreads_of_timings(experiment):
    """How far the repetitions of timings lie apart, in a sentence; empty where nothing was timed."""
    ratios = sorted(r.cost.ns / r.cost.low for r in experiment.runs if r.cost and r.cost.low > 0)
    if not ratios:
        return ""
    disturbed = sum(r > CONTENDED for r in ratios)
    return (f"the median repetition took {ratios[len(ratios) // 2]:.2f} times as long as the fastest, in the worst of "
            f"{len(ratios)} timings {ratios[-1]:.2f} times; {disturbed} above {CONTENDED}")


def on_tables(experiment):
    """Why tables of measures end early or are left out, a line each."""
    path = experiment.folder / "measures" / "notes.txt"
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


def notes(head, more=()):
    lines = [*(head.get("notes") or []), *more]
    return "<ul>" + "\n".join(f"<li>{prose(n)}</li>" for n in lines) + "</ul>" if lines else ""


def citations(head):
    lines, keys = head.get("citation") or [], head.get("reference") or []
    if not lines and not keys:
        return ""
    return ("<p><strong>Please cite</strong>" + (f" ({text(', '.join(keys))})" if keys else "") + "</p>\n<ul>"
            + "\n".join(f"<li>{cited(key, line)}</li>" for key, line in itertools.zip_longest(keys, lines, fillvalue=""))
            + "</ul>")


def cited(key, line):
    """A work, with a link where it has a DOI."""
    address = link(entries([key]).get(key))
    return f'{text(line)} <a href="{text(address)}">{text(address.removeprefix("https://"))}</a>' if address else text(line)
