"""What is taken for the error of a run, and how the report calls it.

state      the largest |z - z_exact| / |z_exact|: where a solution is known and the case does not say otherwise
quantity   the largest |I - I(0)| / |I(0)| of a conserved quantity I: where the case says error = "I"
drift      the largest |I - I(0)| of the conserved quantity, in its unit: where neither is known

The last two are at most of the size that the error of the state allows, and may fall with a higher power of the step.
"""
import dataclasses
import math
import typing

from experiment import Run


@dataclasses.dataclass
class ErrorMeasure:
    kind: str
    name: str  # of the quantity; empty for the state
    of: typing.Callable[[Run], float]

    @property
    def of_state(self):
        """Errors are of the state: from a half on the phase is lost, and the claimed order is theirs."""
        return self.kind == "state"

    @property
    def relative(self):
        return self.kind != "drift"

    @property
    def noun(self):
        """What sentences and heads of tables call it: an error of what."""
        return {"state": "state error", "quantity": f"{self.name} error", "drift": f"drift of {self.name}"}[self.kind]

    @property
    def axis(self):
        return {"state": "largest relative error of the state", "quantity": f"largest relative error of {self.name}, |ΔI/I(0)|",
                "drift": f"largest drift of {self.name}"}[self.kind]

    def defined(self, solution, rows=""):
        """What it is, for the line that says for what a verdict holds; `rows` as some_rows() has them."""
        return {"state": f"state error is the largest error of the state relative to {solution}{rows}",
                "quantity": f"{self.noun} is the largest |I − I(0)| / |I(0)| of {self.name}, whatever the error of the state",
                "drift": f"no reference solution, so that errors are the drift of {self.name}"}[self.kind]


def some_rows(case):
    """At how many rows errors of the state are measured, where runs of the case may have more; otherwise empty."""
    return f" at {case['error_rows']} rows of a run at most" if case.get("error_rows") else ""


def error_measure(experiment, case):
    """The ErrorMeasure of a case; None where there is neither a solution nor a conserved quantity."""
    if case.get("error"):
        return ErrorMeasure("quantity", case["error"], lambda r: r.number("relative_drift_max"))
    if any(math.isfinite(r.number("error_max")) for r in experiment.runs_of(case)):
        return ErrorMeasure("state", "", lambda r: r.number("error_max"))
    invariant = case.get("conserved")
    if invariant and experiment.expectation(case, invariant)[0] == "conserved":
        return ErrorMeasure("drift", invariant, lambda r: r.drift(invariant, "max"))
    return None
