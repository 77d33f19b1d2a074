"""Exceptions. Each is also one of Python's own kinds, so that code that knows nothing of Pfaff can catch it."""
from typing import Any


class InputError(ValueError):
    """Wrong usage or input, refused before work starts: one line that says what, where and what was expected."""


class TraceError(TypeError):
    """A formula did something with a value that has none while it is recorded, such as comparing it."""


class JumpWarning(UserWarning):
    """A derivative was asked of a motion that may pass a jump of its rates, where the derivative of steps is not its own."""


class InvariantWarning(UserWarning):
    """A quantity that is said to be conserved has a rate along the motion: its drift is not the method's alone."""


class NotConverged(RuntimeError):
    """A step did not converge, a linear system in it was singular, or no step meets the tolerance. `run` holds the samples up to
    there, or None."""

    run: Any = None


class RunFailed(RuntimeError):
    """Work that had begun ended early. `run` holds the samples up to there, or None where there are none."""

    def __init__(self, message: str, run: Any = None) -> None:
        super().__init__(message)
        self.run = run


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended the work. `run` holds the samples up to there, or None where there are none."""

    def __init__(self, message: str = "interrupted", run: Any = None) -> None:
        super().__init__(message)
        self.run = run
