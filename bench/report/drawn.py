"""All figures of a case, in the order of the page."""
import bands
import constraints
import contraction
import drift_at_cost
import ensembles
import frequencies
import loops
import motion
import moving
import reversibility
import structure
import work_precision
from figures import drift_at_equal_step


def drawn(verdict):
    """[Drawing]"""
    experiment, case = verdict.experiment, verdict.case
    equal_step = None if case.get("seeds") else drift_at_equal_step(experiment, case)
    return (work_precision.drawings(verdict) + drift_at_cost.drawings(verdict) + structure.drawings(verdict) + loops.drawings(verdict)
            + reversibility.drawings(verdict) + frequencies.drawings(verdict)
            + (motion.drawings(experiment, case) or moving.drawings(verdict))
            + contraction.drawings(verdict) + constraints.drawings(experiment, case)
            + bands.drawings(verdict) + ensembles.drawings(experiment, case) + ([equal_step] if equal_step else []))
