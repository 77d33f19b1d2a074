"""Numbers as texts, in which every digit counts: a float stands for the decimal that it is printed as."""
from __future__ import annotations

import contextlib
import decimal
import fractions
import math
import threading
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from . import _pfaff
from ._arguments import refuse_masked, shown
from ._errors import InputError


class _Noted(threading.local):
    list: list[tuple[str, str]] | None = None


_noted = _Noted()


@contextlib.contextmanager
def noted_constants() -> Iterator[list[tuple[str, str]]]:
    """Notes the floats of sixteen digits and more that become constants meanwhile, as (place, text): a float that
    was computed, such as 1/3, is rounded, and not the constant that was meant."""
    before, _noted.list = _noted.list, []
    try:
        yield _noted.list
    finally:
        _noted.list = before


def _digits(text: str) -> int:
    """The significant digits of a number as Python prints it."""
    return len(text.lower().split("e")[0].lstrip("-").replace(".", "").strip("0"))


def text_of_constant(value: Any) -> str | None:
    """The text of a number, such as "0.1" or "1/3"; None for what is no real number."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (bool, np.bool_)):
        return None
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, float):  # numpy.float64 among them
        text = repr(float(value))
        if _noted.list is not None and _digits(text) >= 16:
            from ._tracing import place_of_caller

            _noted.list.append((place_of_caller(), text))
        return text
    if isinstance(value, (np.half, np.single)):
        return text_of_constant(float(value))  # its value, as arrays of it have when they become doubles
    if isinstance(value, np.floating):
        return str(value)
    if isinstance(value, fractions.Fraction):
        return f"{value.numerator}/{value.denominator}"
    if isinstance(value, decimal.Decimal):
        return str(value)
    if isinstance(value, _pfaff.Number):
        return value.constant
    return None


def text_of_number(value: Any, what: str) -> str:
    """The text of a number that is a setting: a finite number, or a text such as "1/3"."""
    text = value.strip() if isinstance(value, str) else text_of_constant(value)
    if not text:
        raise InputError(f"{what}: expected a number, got {shown(value)}")
    if not isinstance(value, str) and text.lstrip("-").isalpha():
        raise InputError(f"{what}: expected a finite number, got {shown(value)}")
    return text


def float_of_number(value: Any, what: str, expected: str = "a number", above: float | None = None) -> float:
    """A finite number as a float, to which a text such as "1/3" is rounded; one `above` another where that is given."""
    try:
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            found = float(value)
        else:
            text = value if isinstance(value, str) else text_of_constant(value)
            found = float(fractions.Fraction(text)) if text is not None else math.nan
    except (ValueError, ZeroDivisionError, OverflowError):
        found = math.nan
    if not math.isfinite(found) or above is not None and not found > above:
        raise InputError(f"{what}: expected {expected}, got {shown(value)}")
    return found


def text_of_setting(value: Any, what: str) -> str:
    """The text of the value of a parameter: a number, a name, a registered method, yes or no, or a list of these."""
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple, np.ndarray)) and _dimensions(value) == 1:
        return ",".join(text_of_setting(one, what) for one in value)
    if hasattr(value, "as_value"):  # another method, as of a composition
        return value.as_value()
    text = text_of_constant(value)
    if text is None and hasattr(value, "__fspath__"):
        text = str(value)
    if text is None:
        raise InputError(f"{what}: expected a number, a text, True or False, or a list of numbers, got {shown(value)}")
    return text


def _dimensions(values: Any) -> int:
    """Those of an array; -1 for rows of different lengths, which make none."""
    try:
        return np.ndim(values)
    except ValueError:
        return -1


def texts_of_state(values: Any, what: str, expected: str = "a list or an array of one dimension") -> list[str]:
    """The texts of the numbers of a state, an array of one dimension."""
    refuse_masked(values, what, expected)
    if _dimensions(values) != 1:
        several = "; pfaff.ensemble takes many initial states" if _dimensions(values) == 2 and what == "initial" else ""
        raise InputError(f"{what}: expected {expected}, got {shown(values)}{several}")
    return [text_of_number(value, what) for value in values]


def texts_of_tolerances(values: Any, what: str) -> list[str]:
    """The texts of absolute tolerances: one number, or a list of them."""
    if isinstance(values, (tuple, list)) and not values:
        return []
    return texts_of_state([values] if _dimensions(values) == 0 else values, what, "one number, or one for each coordinate")


def texts_of_coordinates(values: Any, what: str, names: Sequence[str]) -> list[str]:
    """The texts of a state that has a number for each of these coordinates."""
    listed = ", ".join(names[:8]) + (", ..." if len(names) > 8 else "")
    expected = f"shape ({len(names)},), a number for each of {listed}"
    texts = texts_of_state(values, what, expected)
    if len(texts) != len(names):
        raise InputError(f"{what}: expected {expected}, got {len(texts)} number{'' if len(texts) == 1 else 's'}")
    return texts
