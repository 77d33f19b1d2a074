"""What stands for a system or a method wherever one is expected."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ._arguments import shown
from ._errors import InputError
from ._method import Method, table
from ._system import System


def as_system(x: Any, what: str = "system", /, **parameters: Any) -> System:
    """The system of a registered name, the path of a text model, a System or a subclass of it, with these parameters.

    `what` is the argument that it was given as.

    Raises:
        InputError: for anything else, unknown names and wrong values.
    """
    if isinstance(x, System):
        return x(**parameters) if parameters else x
    if isinstance(x, type) and issubclass(x, System):
        return x(**parameters)
    if isinstance(x, str) or hasattr(x, "__fspath__"):
        return System(str(x), **parameters)
    raise InputError(f"{what}: expected a system, which is a name, the path of a text model or a pfaff.System, got {shown(x)}")


def as_method(x: Any, what: str = "method", /, **parameters: Any) -> Method:
    """The method of a registered name, the path of a table, a dictionary of coefficients or a Method, with these
    parameters.

    Raises:
        InputError: for anything else, unknown names and wrong values.
    """
    if isinstance(x, Method):
        return x(**parameters) if parameters else x
    if isinstance(x, str) or hasattr(x, "__fspath__"):
        return Method(str(x), **parameters)
    if isinstance(x, Mapping):
        return table(x, **parameters)
    raise InputError(f"{what}: expected a method, which is a name, the path of a table, a dictionary of coefficients or a pfaff.Method, got {shown(x)}")
