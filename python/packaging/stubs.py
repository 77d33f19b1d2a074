#!/usr/bin/env python3
"""Makes the stub of the extension module, python/pfaff/_pfaff.pyi, by mypy's stubgen, from the module that is built.

  PYTHONPATH=build/release/python python/packaging/stubs.py [--write]

Without --write it prints the stub. The package itself has its types in its sources, and needs none. The test
python/tests/test_stubs.py makes it anew and compares.
"""
import pathlib
import subprocess
import sys
import tempfile

PLACE = pathlib.Path(__file__).resolve().parents[1] / "pfaff" / "_pfaff.pyi"
# Numbers of a recording have operators that give numbers, as NumPy's arrays have.
HEAD = "# Made by python/packaging/stubs.py.\n# mypy: disable-error-code=\"override, assignment\"\n"


def stub():
    """The text of the stub. What pybind11 calls otherwise than Python does has Python's name."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["stubgen", "-m", "pfaff._pfaff", "-o", folder], check=True, capture_output=True)
        text = (pathlib.Path(folder) / "pfaff" / "_pfaff.pyi").read_text()
    text = text.replace("numpy.ndarray[numpy.float64]", "numpy.typing.NDArray[numpy.float64]").replace(": handle", ": object")
    return HEAD + text.replace("import numpy\n", "import numpy\nimport numpy.typing\n\n__version__: str\n")


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        PLACE.write_text(stub())
    elif not sys.argv[1:]:
        print(stub(), end="")
    else:
        sys.exit(__doc__)
