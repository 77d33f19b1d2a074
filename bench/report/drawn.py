"""All figures of a case, in the order of the page."""
import bands
import constraints
import contraction
import drift
import ensembles
import frequencies
import loops
import measured
import moving
import reversibility
import structure
import work_precision


def drawn(verdict):
    """[Drawing]"""
    makers = (work_precision, drift, structure, loops, reversibility, frequencies, moving, contraction, measured, constraints, bands, ensembles)
    return [drawing for maker in makers for drawing in maker.drawings(verdict)] + drift.at_equal_step(verdict)
