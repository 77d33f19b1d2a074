"""The classes of drift: in which way an error grows over a run, or does not.

The list is that of the program which made the runs, as experiment.json holds it; no class is named here.
"""
import dataclasses
import difflib

from files import InputError, require

SIZES = ("max", "slope", "exponent")


@dataclasses.dataclass
class DriftClass:
    """A class of drift, as the program that made the runs lists it in experiment.json."""
    name: str
    meaning: str
    measure: str  # which of SIZES says how much a quantity drifts; empty for none
    grows: bool  # whether such an error is larger at the end of a longer run
    keeps: bool  # whether it is known not to be


def read(entries):
    """{name: DriftClass}, in the order of the list, which is that of the report."""
    classes = {}
    for i, entry in enumerate(entries):
        where = f"experiment.json, drift class {i + 1}"
        require(entry, where, name=str, meaning=str, measure=str, grows=bool, keeps=bool)
        if entry["measure"] and entry["measure"] not in SIZES:
            raise InputError(f"{where}: expected 'measure' to be empty or one of {', '.join(SIZES)}, got "
                             f"'{entry['measure']}'")
        if entry["name"] in classes:
            raise InputError(f"experiment.json: drift class '{entry['name']}' appears 2 times, expected once")
        classes[entry["name"]] = DriftClass(entry["name"], entry["meaning"], entry["measure"], entry["grows"],
                                            entry["keeps"])
    return classes


def check(name, classes, where):
    """An empty name stands where nothing was measured."""
    if name and name not in classes:
        near = difflib.get_close_matches(name, classes, 1)
        expected = f"did you mean '{near[0]}'?" if near else f"expected one of {', '.join(classes)}"
        raise InputError(f"{where}: unknown drift class '{name}'; {expected}")
