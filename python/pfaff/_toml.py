"""Dictionaries as TOML, which the readers of tables and text models take."""
from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._arguments import shown
from ._errors import InputError
from ._numbers import text_of_constant


def toml_of(values: Mapping[str, Any], what: str) -> str:
    """The text of a dictionary, a line for each key; dictionaries in it are inline tables.

    Numbers other than floats and whole numbers become texts, which keep all their digits.
    """
    if not isinstance(values, Mapping):
        raise InputError(f"{what}: expected a dictionary, got {shown(values)}")
    return "".join(f"{_key(key, what)} = {_value(value, f'{what}: {key}')}\n" for key, value in values.items())


def _key(key: Any, what: str) -> str:
    if not isinstance(key, str):
        raise InputError(f"{what}: expected keys that are texts, got {shown(key)}")
    return json.dumps(key, ensure_ascii=False)


def _value(value: Any, what: str) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key, what)} = {_value(one, what)}" for key, one in value.items()) + " }"
    if isinstance(value, (list, tuple)) or isinstance(value, np.ndarray) and value.ndim > 0:
        return "[" + ", ".join(_value(one, what) for one in value) + "]"
    text = text_of_constant(value)
    if text is None:
        raise InputError(f"{what}: expected a number, a text, a list or a dictionary, got {shown(value)}")
    return text if isinstance(value, (int, float, np.integer)) else json.dumps(text)
