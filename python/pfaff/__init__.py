"""Structure-preserving integration of mechanical systems: define, run, verify and compare.

What the program `pfaff` does, at the speed of C++, from Python:

>>> import pfaff
>>> pfaff.__version__
'0.1.0'
"""
from . import _machine  # noqa: F401  first: it refuses machines that lack instructions
from . import _pfaff
from ._errors import InputError, Interrupted, NotConverged, RunFailed, TraceError
from ._integration import Integration, Outcome
from ._method import Method, Problem, method, methods, table
from ._system import System, system, systems
from ._tracing import solve, where

__version__: str = _pfaff.__version__

__all__ = [
    "InputError",
    "Integration",
    "Interrupted",
    "Method",
    "NotConverged",
    "Outcome",
    "Problem",
    "RunFailed",
    "System",
    "TraceError",
    "__version__",
    "method",
    "methods",
    "solve",
    "system",
    "systems",
    "table",
    "where",
]
