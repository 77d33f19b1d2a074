"""What stands for a system or a method wherever one is expected."""
from __future__ import annotations

from typing import Any

from ._errors import InputError
from ._system import System


def as_system(x: Any, **parameters: Any) -> System:
    """The system of a registered name, the path of a text model, a System or a subclass of it, with these parameters.

    Raises:
        InputError: for anything else, unknown names and wrong values.
    """
    if isinstance(x, System):
        return x(**parameters) if parameters else x
    if isinstance(x, type) and issubclass(x, System):
        return x(**parameters)
    if isinstance(x, str) or hasattr(x, "__fspath__"):
        return System(str(x), **parameters)
    raise InputError(f"expected a system: a name, the path of a text model, or a pfaff.System, got {x!r}")
