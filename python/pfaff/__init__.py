"""Structure-preserving integration of mechanical systems: define, run, verify and compare.

What the program `pfaff` does, at the speed of C++, from Python:

>>> import pfaff
>>> pfaff.__version__
'0.1.0'
"""
from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from . import _machine  # noqa: F401  first: it refuses machines that lack instructions
from . import _pfaff
from ._derivation import Equations, derivation_methods, derive
from ._ensemble import Ensemble, ensemble
from ._errors import InputError, Interrupted, InvariantWarning, JumpWarning, NotConverged, RunFailed, TraceError
from ._evaluation import Evaluation, bracket, evaluate
from ._experiments import Comparison, Table, WorkPrecision, compare, experiments
from ._falsification import Counterexample, Falsification, Falsifications, falsify
from ._integration import Integration, Outcome, Watching
from ._measure_table import MeasureTable
from ._method import Method, method, methods, table
from ._papers import Reproduced, Reproduction, papers, reproduce
from ._run import Run, run
from ._solve_ivp import solve_ivp
from ._step import Problem
from ._system import System, system, systems
from ._tracing import solve, where
from ._verification import Check, Checks, verify
from ._watched import Watched

if TYPE_CHECKING:
    from . import plots

__version__: str = _pfaff.__version__

__all__ = [
    "Check",
    "Checks",
    "Comparison",
    "Counterexample",
    "Ensemble",
    "Equations",
    "Evaluation",
    "Falsification",
    "Falsifications",
    "InputError",
    "Integration",
    "Interrupted",
    "InvariantWarning",
    "JumpWarning",
    "MeasureTable",
    "Method",
    "NotConverged",
    "Outcome",
    "Problem",
    "Reproduced",
    "Reproduction",
    "Run",
    "RunFailed",
    "System",
    "Table",
    "TraceError",
    "Watched",
    "Watching",
    "WorkPrecision",
    "__version__",
    "bracket",
    "compare",
    "derivation_methods",
    "derive",
    "ensemble",
    "evaluate",
    "experiments",
    "falsify",
    "method",
    "methods",
    "papers",
    "plots",
    "reproduce",
    "run",
    "solve",
    "solve_ivp",
    "system",
    "systems",
    "table",
    "verify",
    "where",
]


def __getattr__(name: str) -> Any:
    """`pfaff.plots`, which is imported when it is first asked for, since it is what takes longest."""
    if name == "plots":
        return importlib.import_module(".plots", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
