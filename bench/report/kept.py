"""Whether a report is there already: made of these files by these scripts, and as it was left.

figures/made.json, which is written last, holds a digest of what a report was made of, and one of each of its files. Drawing takes
longer than all else of an experiment that is kept whole, and reading all of its files hardly any time.
"""
import hashlib
import importlib.metadata
import json
import pathlib
import sys

import bibliography
from command import write

RECORD = "figures/made.json"
PAGES = ("report.html", "report.json", "verdict.csv")


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def files_in(folder):
    return sorted(path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))


def left(folder):
    """{file: digest} of the files of a report."""
    files = [*(folder / name for name in PAGES if (folder / name).is_file()), *files_in(folder / "figures")]
    names = {path.relative_to(folder).as_posix(): path for path in files}
    return {name: digest(path) for name, path in names.items() if name != RECORD and not name.startswith("figures/paper/")}


def made_of(folder):
    """A digest of everything that a report depends on: the files of the experiment, the scripts, and what they use."""
    scripts = pathlib.Path(__file__).parent
    found = hashlib.sha256(f"{sys.version} {importlib.metadata.version('matplotlib')}".encode())
    works = bibliography.file()
    for root, files in ((scripts, [path for path in files_in(scripts) if path.suffix != ".pyc"]), (folder, inputs(folder)),
                        *([(works.parent, [works])] if works else [])):
        for path in files:
            found.update(f"{path.relative_to(root).as_posix()} {digest(path)}\n".encode())
    return found.hexdigest()


def inputs(folder):
    """The tables and descriptions of an experiment and of its runs, and not what `pfaff plot` or somebody else has put beside them."""
    own = ("", "measures", "runs/*", "runs/*/measures", "equal-cost/*")
    found = [path for place in own for kind in ("*.csv", "*.json") for path in sorted(folder.glob(f"{place}/{kind}".lstrip("/")))]
    return [path for path in found if path.relative_to(folder).as_posix() not in PAGES]


def is_kept(folder, of):
    """Whether the report that is there was made `of` that, and none of its files has changed since."""
    try:
        record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
        return record["made of"] == of and "report.html" in record["files"] and left(folder) == record["files"]
    except (OSError, ValueError, KeyError, TypeError):
        return False


def note(folder, of):
    """Notes that the report which is there was made `of` that."""
    write(folder / RECORD, json.dumps({"made of": of, "files": left(folder)}, indent=1) + "\n")
