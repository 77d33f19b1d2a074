"""The package as such: it is imported, and says which version it is."""
import os
import pathlib
import re
import subprocess
import sys

import pfaff

ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_the_version_is_that_of_the_library():
    header = (ROOT / "core" / "registry" / "version.hpp").read_text()
    assert pfaff.__version__ == re.search(r'PFAFF_VERSION_TEXT "([^"]+)"', header).group(1)


def test_all_that_is_promised_is_there_and_has_a_docstring():
    for name in pfaff.__all__:
        assert name == "__version__" or getattr(pfaff, name).__doc__, name


def test_exceptions_are_of_the_kinds_that_python_has():
    assert issubclass(pfaff.InputError, ValueError)
    assert issubclass(pfaff.TraceError, TypeError)
    assert issubclass(pfaff.Interrupted, KeyboardInterrupt) and pfaff.Interrupted().run is None


def test_notices_of_the_library_are_warnings(tmp_path):
    """Without a compiler formulas are interpreted, which the library says once, and not on stderr."""
    code = (
        "import sys, warnings, pfaff\n"
        "with warnings.catch_warnings(record=True) as caught:\n"
        "    warnings.simplefilter('always')\n"
        f"    pfaff.System({str(ROOT / 'examples' / 'models' / 'toda.toml')!r}, compile=True)\n"
        "print(*(one.message for one in caught))"
    )
    done = subprocess.run([sys.executable, "-c", code], env={**os.environ, "PATH": str(tmp_path), "CXX": ""}, capture_output=True, text=True,
                          check=True)
    assert "no C++ compiler" in done.stdout and done.stderr == ""
