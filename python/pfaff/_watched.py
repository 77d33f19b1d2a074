"""What is left of a quantity that was watched along a run."""
from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ._arguments import unknown


class Watched(Mapping):
    """What is left of a quantity that was watched along a run: the fields that docs/drift-and-cost.md lists.

    They are read as items, drift["class"], or, but for the class, as attributes: drift.slope, drift.slope_low,
    drift.slope_high, drift.max, drift.rms, drift.evidence. A number that is not known is None.
    """

    def __init__(self, fields: Mapping[str, Any]) -> None:
        self._fields = dict(fields)

    def __getitem__(self, name: str) -> Any:
        if not isinstance(name, str) or name not in self._fields:
            raise KeyError(unknown("field", name, list(self._fields)))
        return self._fields[name]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or "_fields" not in self.__dict__ or name not in self._fields:
            raise AttributeError(name)
        return self._fields[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._fields)

    def __len__(self) -> int:
        return len(self._fields)

    def __repr__(self) -> str:
        named = self._fields.get("class")
        return f"<{named or 'watched'}: {', '.join(f'{key} {value:.3g}' for key, value in self._fields.items() if isinstance(value, float))}>"
