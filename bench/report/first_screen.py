"""The first screen of a case: the question of the experiment, the sentence that answers it, and two lines below.

`answer` of the case says which clauses make the sentence and which the second line; what the runs do not tell is said in their
place. The third line says for what all of it holds. report.json has every sentence with the assertions that it makes.
"""
import json

import answers
import drift_sentence
import sentence
from assertion import said
from equation import prose
from error_measure import some_rows
from figures import heading
from files import InputError
from verdict_data import rows
from wording import counted, plain_text, text

# What answers a question, what stands in the second line, and what is said where the runs do not answer.
RANKED = (sentence.cheapest, sentence.bounded)
ANSWERS = {
    "cost": ((sentence.cheapest, drift_sentence.losing, sentence.bounded, sentence.structure), (sentence.dearer, drift_sentence.drift_beside_losing), ""),
    "energy": ((drift_sentence.drift,), (sentence.structure, *RANKED, sentence.dearer),
               "which methods let the conserved quantity drift away"),
    "structure": ((sentence.structure,), (drift_sentence.drift, *RANKED, sentence.dearer), "which methods keep the structure"),
    "growth": ((answers.growth,), (answers.drift_beside_growth,), "with which power of time errors grow"),
    "constraints": ((answers.constraints,), (drift_sentence.drift, *RANKED), "which methods stay on the constraints"),
    "agreement": ((answers.agreement_or_constraints,), (answers.constraints_beside_agreement, drift_sentence.drift),
                  "whether formulations agree"),
    "frequencies": ((answers.turning,), (drift_sentence.drift, *RANKED), "which frequencies are right"),
}


def answer_of(verdict):
    kind = verdict.case.get("answer") or "cost"
    if kind not in ANSWERS:
        raise InputError(f"experiment.json, case {verdict.case['name']}: expected 'answer' to be one of {', '.join(ANSWERS)}, "
                         f"got '{kind}'")
    return ANSWERS[kind]


def first(verdict):
    return [clause for make in answer_of(verdict)[0] for clause in make(verdict)]


def second(verdict):
    return [clause for make in answer_of(verdict)[1] for clause in make(verdict)]


def finding(verdict):
    """The sentence, in HTML."""
    if out := said(first(verdict)):
        return out
    if kind := answer_of(verdict)[2]:
        why = ": no quantity is conserved in all of them" if drift_sentence.drift in answer_of(verdict)[0] and not verdict.invariant else ""
        return f"The runs do not tell {kind}{why}."
    if out := said(second(verdict)):
        return out
    return f"No method is called cheapest: {sentence.why_none_is_cheapest(verdict) or 'too few are ranked'}."


def below(verdict):
    """The second line, in HTML; empty where there is nothing to say."""
    parts = []
    shown, below = said(first(verdict)), said(second(verdict))
    whole = shown or answer_of(verdict)[2]
    why = sentence.why_none_is_cheapest(verdict)
    if why and sentence.cheapest in sum(answer_of(verdict)[:2], ()) and (whole or below):
        parts.append(f"No method is called cheapest: {why}.")
    parts += [below] if whole else []
    others = [r for r in verdict.rows if r not in verdict.rivals]
    if others:
        left_out = not any(r.label in clause.rows for r in others for clause in first(verdict) + second(verdict))
        parts.append(f"{sentence.names(others)} {'is' if len(others) == 1 else 'are'} another motion, and no rival of the others"
                     + (", of which alone the sentences speak." if left_out else "."))
    failing = [c for _, c in verdict.experiment.claims if c["case"] == verdict.case["name"] and c["holds"] != "yes"]
    if failing:
        parts.append(f"<strong>{counted(len(failing), 'finding')} that the experiment states "
                     f"{'does' if len(failing) == 1 else 'do'} not hold.</strong>")
    return " ".join(filter(None, parts))


def above(verdict):
    """HTML: the equation of the motion, and the question that the sentence answers; empty where the experiment has none."""
    about, asked = verdict.case.get("equation"), verdict.case.get("question")
    return "".join(filter(None, (f'<p class="equation">{prose(about)}</p>' if about else "",
                                 f'<p class="question">{text(asked)}</p>' if asked else "")))


def data(experiment, verdicts):
    """The content of report.json."""
    cases = [{"case": v.case["name"], "question": v.case.get("question") or "", "answer": v.case.get("answer") or "cost",
              "title": heading(v.case), "sentence": plain_text(finding(v)), "below": plain_text(below(v)), "methods": rows(v),
              "assertions": [clause.data() | {"case": v.case["name"]} for clause in first(v) + second(v)]} for v in verdicts]
    return json.dumps({"schema": 1, "experiment": experiment.head["name"], "cases": cases}, indent=1, ensure_ascii=False) + "\n"


def holds(verdict):
    """The third line: for what it holds."""
    case, runs = verdict.case, verdict.experiment.runs_of(verdict.case)
    unit = case.get("time_unit") or ""
    parts = [text(heading(case)) + (f" to t = {text(case['time'])} {text(unit)}".rstrip() if "time" in case else ""),
             f"{case['precision']} precision"]
    if verdict.measure:
        which = {"exact": "the exact solution", "30-digit": "a solution of up to 30 digits"}.get(
            case.get("reference_solution") or "", "the reference solution")
        parts.append(text(verdict.measure.defined(which, some_rows(case))))
    steps = sorted({r.step for r in runs if not r.tolerance}, reverse=True)
    between = ("" if not steps else f" at step {steps[0]:.4g}" if len(steps) == 1 else
               f" at {len(steps)} steps between {steps[0]:.4g} and {steps[-1]:.4g}") + (f" {unit}" if unit and steps else "")
    parts.append(counted(len(verdict.rows), "method") + text(between))
    timing = {"time": "times are the fastest repetition of a run on one core, and differences within 10 % or the spread of "
              "timings count as ties", "right-hand sides": "timings were not measured: right-hand sides stand for cost",
              "steps": "timings were not measured: steps stand for cost"}[verdict.work]
    if case.get("seeds"):
        parts.append(f"medians over {case['seeds']} seeds")
    if verdict.target and len(verdict.ranked(verdict.target)) < len(verdict.rivals):
        timing += "; ranked are methods with runs on both sides of the error"
    return f"Holds for {', '.join(parts[:-1])}{', ' if len(parts) > 1 else ''}{parts[-1]}; {timing}."
