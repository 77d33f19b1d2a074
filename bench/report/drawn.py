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
import stretches
import structure
import work_precision


def drawn(verdict):
    """[Drawing]"""
    before = (work_precision, drift, structure, loops, reversibility, frequencies, moving, contraction)
    others = measured.drawings(verdict, {maker.MEASURE for maker in (*before, stretches) if hasattr(maker, "MEASURE")})
    return [drawing for maker in before for drawing in maker.drawings(verdict)] + others + \
        [drawing for maker in (constraints, bands, ensembles) for drawing in maker.drawings(verdict)] + drift.at_equal_step(verdict)
