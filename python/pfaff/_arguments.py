"""Arguments of the wrong kind are refused in one line: which argument, what was expected, and what was given."""
from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _pfaff
from ._errors import InputError


def shown(value: Any, most: int = 80) -> str:
    """A value as messages show it: on one line and not too long, arrays by their shapes and functions by their names."""
    if isinstance(value, np.ndarray) and value.ndim > 0:
        return f"an array of shape {value.shape}"
    if inspect.isfunction(value) or inspect.ismethod(value):
        return f"the function {value.__name__}"
    try:
        text = " ".join(repr(value).split())
    except Exception:  # one whose text cannot be made is told by its kind
        text = f"<{type(value).__name__}>"
    return text if len(text) <= most else text[: most - 4] + " ..."


def unknown(kind: str, name: Any, names: Sequence[str]) -> str:
    """What is said of a name that is none of `names`: the nearest of them, or some."""
    if isinstance(name, str):
        return _pfaff.unknown_name(kind, name, list(names))
    return f"{kind}: expected a name{f', such as {names[0]!r}' if names else ''}, got {shown(name)}"


def text(value: Any, what: str, expected: str = "a text") -> str:
    """A text, such as a name."""
    if not isinstance(value, str):
        raise InputError(f"{what}: expected {expected}, got {shown(value)}")
    return value


def yes_or_no(value: Any, what: str) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise InputError(f"{what}: expected True or False, got {shown(value)}")
    return bool(value)


def path(value: Any, what: str, expected: str = "the path of a directory") -> str:
    """A path, as a text or an os.PathLike."""
    if not isinstance(value, (str, os.PathLike)) or not isinstance(os.fspath(value), str) or not os.fspath(value):
        raise InputError(f"{what}: expected {expected}, got {shown(value)}")
    return os.fspath(value)


def function(value: Any, what: str, expected: str) -> Callable[..., Any]:
    """Something that can be called."""
    if not callable(value):
        raise InputError(f"{what}: expected {expected}, got {shown(value)}")
    return value


def named_function(value: Any, what: str, expected: str) -> Callable[..., Any]:
    """A function that has a name, as what def and lambda make has."""
    if not inspect.isroutine(value):
        raise InputError(f"{what}: expected {expected}, got {shown(value)}")
    return value


def dictionary(value: Any, what: str, expected: str = "a dictionary of names and values") -> dict[str, Any]:
    """A copy of a dictionary whose keys are texts."""
    if not isinstance(value, Mapping) or not all(isinstance(key, str) for key in value):
        raise InputError(f"{what}: expected {expected}, got {shown(value)}")
    return dict(value)


def dictionary_or_none(value: Any, what: str, expected: str = "a dictionary of names and values") -> dict[str, Any]:
    """The same; an empty one of None."""
    return {} if value is None else dictionary(value, what, expected)


def texts(value: Any, what: str, example: str) -> list[str]:
    """A list of texts, which a text alone is not."""
    listed = list(value) if isinstance(value, Iterable) and not isinstance(value, (str, bytes, Mapping)) else [None]
    if not all(isinstance(one, str) for one in listed):
        such = f"[{value!r}]" if isinstance(value, str) and value else example
        raise InputError(f"{what}: expected a list of names, such as {such}, got {shown(value)}")
    return listed


# The library counts in whole numbers of 64 bits.
_LARGEST = 2**63 - 1


def whole(value: Any, what: str, least: int) -> int:
    """A whole number that is `least` or more."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)) or value < least:
        raise InputError(f"{what}: expected a whole number >= {least}, got {shown(value)}")
    if value > _LARGEST:
        raise InputError(f"{what}: expected a whole number of 64 bits, got {shown(value)}")
    return int(value)


def refuse_masked(value: Any, what: str, expected: str) -> None:
    """What is masked is no number, and NumPy leaves one behind the mask when it makes an array of it."""
    if np.ma.is_masked(value):
        raise InputError(f"{what}: expected {expected}, got an array with masked elements")


def real_array(value: Any, what: str, expected: str) -> np.ndarray:
    """An array of doubles of real numbers, of any shape."""
    refuse_masked(value, what, expected)
    try:
        array = np.asarray(value)
        if array.dtype.kind in "iuf" or array.size == 0 or array.dtype == object and not _has_other_kinds(array):
            return array.astype(float, copy=False)
    except (TypeError, ValueError, OverflowError):
        pass  # rows of different lengths, and what is no number
    raise InputError(f"{what}: expected {expected}, got {shown(value)}")


def _has_other_kinds(array: np.ndarray) -> bool:
    """Whether there are objects that float() takes and that are no numbers, or are truth values."""
    return any(isinstance(one, (str, bytes, bool, np.bool_)) or one is None for one in array.ravel())
