"""What a case shows of cost and structure: clauses in HTML, each with its assertion as data (assertion.py).

cheapest    who is cheapest at the target, of the methods that are ranked there
bounded     who is not ranked there and yet costs no more
structure   who keeps the structure; "only", "all" and "no method" are said of those alone of which it is known
dearer      what the cheapest method that keeps the structure costs, and what the experiment's subject, which is the family of
            the method it lists first, costs beside the Gauss method of equal order
A clause that the data do not make is not printed: properties have three values, and of two methods at least it must be known
how they stand.
"""
import math

from assertion import Clause, labels, three
from verdict import TIE
from wording import listed, plain_text, power, text, two_digits


def name(row):
    return f'<b class="c-{row.curve.family.key}">{text(row.label)}</b>'


def names(rows):
    return listed(name(r) for r in rows)


def some(rows):
    return names(rows) if len(rows) <= 6 else f"{len(rows)} methods"


def structure_of(case):
    return f"the {text(case.get('structure') or 'symplectic')} structure"


def quantity(verdict):
    """The conserved quantity with its article; one that is called by a letter has none."""
    called = text(verdict.invariant)
    return f"<i>{called}</i>" if len(called) == 1 else f"the {called}"


def with_work(verdict, cost):
    return verdict.cost_text(cost) + ("" if verdict.work == "time" else f" {verdict.work}")


def spent(verdict, row):
    return with_work(verdict, row.times[verdict.target][0])


def sides(row, target):
    return [p.run.where for p in row.curve.bracket(target)]


def priced(verdict, rows):
    """What an assertion on costs at the target says beside its subject."""
    return {"target": verdict.target, "work": verdict.work,
            "costs": {r.label: r.times[verdict.target][0] for r in rows}}


def error_columns(verdict):
    column = {"state": "error_max", "quantity": "relative_drift_max"}.get(verdict.measure.kind, f"{verdict.measure.name}:max")
    return [column, {"time": "ns_per_step_min", "right-hand sides": "rhs_per_step", "steps": "steps"}[verdict.work]]


def cheapest(verdict):
    best = verdict.best(verdict.target) if verdict.target else []
    if not best:
        return []
    ranked, rivals = verdict.ranked(verdict.target), verdict.rivals
    who = names(best) if len(best) <= 3 else f"{names(best[:2])} and {len(best) - 2} others"
    scope = "" if len(ranked) == len(rivals) else f" of {len(ranked)} ranked methods"
    out = f"at {text(verdict.measure.noun)} {power(round(math.log10(verdict.target)))} {who} "
    out += (f"cost the same{scope.replace(' of ', ', of ', 1)}, {spent(verdict, best[0])}" if len(best) == len(ranked) else
            f"{'is' if len(best) == 1 else 'are'} cheapest{scope}, {spent(verdict, best[0])}")
    if verdict.work == "time" and any(r.curve.disturbed_at(verdict.target) for r in ranked):
        out += " (disturbed)"
    return [Clause(out, "cheapest", labels(best), error_columns(verdict), {r.label: sides(r, verdict.target) for r in ranked},
                   priced(verdict, ranked) | {"unranked": [r.label for r in rivals if r not in ranked]})]


def bounded(verdict):
    """Who is not ranked, as runs are on one side of the target alone, but has a run that reaches it for no more than the cheapest."""
    best = verdict.best(verdict.target) if verdict.target else []
    rows = [r for r in verdict.rivals if best and not r.ranked(verdict.target)
            and r.times[verdict.target][0] <= best[0].times[verdict.target][0]]
    if not rows:
        return []
    words = f"{some(rows)}, not ranked, {'reaches' if len(rows) == 1 else 'reach'} it for no more"
    of_rows = {r.label: [p.run.where for p in r.curve.measured()] for r in rows}
    return [Clause(words, "no-dearer", labels(rows), error_columns(verdict), of_rows, priced(verdict, best[:1]))]


def why_none_is_cheapest(verdict):
    """The reason in words where no method is called cheapest; otherwise empty."""
    if verdict.target and verdict.best(verdict.target):
        return ""
    finished = [r for r in verdict.rivals if r.curve.points]
    return ("no run finished" if not finished else "one method alone finished a run" if len(finished) == 1 else
            "no error is known here" if not verdict.comparable else
            "no two methods have runs on both sides of one error")


def kept_split(verdict):
    """(rows that keep the structure, that do not, of which it is not known); none of the first two where no residual was
    measured at all, since what does not keep the structure could not be seen then."""
    return three(verdict.rivals, lambda r: r.curve.kept) if verdict.structured else ([], [], verdict.rivals)


def collective(rows, others):
    """The rows as families, where none of a family is among the others; as methods where they are few; or their count."""
    families = list(dict.fromkeys(r.curve.family for r in rows))
    if not {f.key for f in families} & {r.curve.family.key for r in others}:
        return names(rows) if len(rows) <= len(families) else listed(f.plural for f in families)
    return names(rows) if len(rows) <= 4 else f"{len(rows)} of {len(rows) + len(others)} methods"


def structure(verdict):
    keep, lose, unknown = kept_split(verdict)
    known, what = len(keep) + len(lose), structure_of(verdict.case)
    if known < 2:
        return []
    who, whose = collective(keep, lose + unknown), collective(lose, keep + unknown)
    scope = f"of {known} methods of which it is known " if unknown else ""
    rest = f"; of {collective(unknown, keep + lose)} it is not known" if unknown else ""
    verb = "keeps" if len(keep) == 1 else "keep"
    if not lose:
        out = f"{scope}all keep {what}" if unknown else f"{'both' if known == 2 else 'all'} methods keep {what}"
    elif not keep:
        out = f"{scope}none keeps {what}" if unknown else f"no method keeps {what}"
    elif len(keep) > 1 and len(plain_text(whose)) < len(plain_text(who)) and not whose.startswith(f"{len(lose)} of "):
        out = f"{scope}all but {whose} keep {what}"
    elif who.startswith(f"{len(keep)} of "):
        out = f"{who} keep {what}" + (f", and {len(lose)} do not" if unknown else "")
    else:
        out = f"{scope}only {who} {verb} {what}"
    rows = {r.label: [p.run.where for p in r.curve.points] for r in verdict.rivals}
    return [Clause(out + rest, "keeps", labels(keep), ["structure_residual", error_columns(verdict)[0] if verdict.of_state else ""],
                   rows, {"not": labels(lose), "unknown": labels(unknown)})]


def times_as_much(verdict, cheap, dear):
    """(words, [least, most]): how many times as much the dear one costs, from the spread of timings."""
    (a, b), target = (cheap, dear), verdict.target
    least = b.times[target][0] / max(a.times[target][0], a.curve.slowest_to(target))
    most = max(b.times[target][0], b.curve.slowest_to(target)) / a.times[target][0]
    ends = list(dict.fromkeys(two_digits(x) for x in (least, most)))
    return " to ".join(ends), [least, most]


def ratio(verdict, dear, cheap, words):
    told, ends = times_as_much(verdict, cheap, dear)
    out = words.format(told)
    if verdict.work == "time" and any(r.curve.disturbed_at(verdict.target) for r in (cheap, dear)):
        out += " (disturbed)"
    return Clause(out, "costs-times", [dear.label], error_columns(verdict), {r.label: sides(r, verdict.target) for r in (cheap, dear)},
                  priced(verdict, (cheap, dear)) | {"than": cheap.label, "times": ends})


def dearer(verdict):
    best = verdict.best(verdict.target) if verdict.target else []
    if not best:
        return []
    out, ranked = [], verdict.ranked(verdict.target)
    keeper = next((r for r in ranked if verdict.structured and r.curve.kept), None)
    if keeper and keeper not in best:
        out.append(ratio(verdict, keeper, best[0], f"{name(keeper)}, which keeps the structure, costs {{}} times as much as "
                                                   f"{name(best[0])} ({spent(verdict, keeper)})"))
    family = verdict.curves[0].family
    ours = next((r for r in ranked if r.curve.family is family and family.key != "gauss"), None)
    gauss = ours and next((r for r in ranked if r.curve.family.key == "gauss" and r.curve.claimed == ours.curve.claimed), None)
    if gauss:
        cheap, dear = sorted((ours, gauss), key=lambda r: r.times[verdict.target][0])
        if times_as_much(verdict, cheap, dear)[1][0] > TIE and not (cheap is best[0] and dear is keeper):
            out.append(ratio(verdict, dear, cheap, f"{name(dear)} costs {{}} times as much as {name(cheap)} of equal order "
                                                   f"({spent(verdict, dear)})"))
    return out
