"""The package as such: it is imported, and says which version it is."""
import pathlib
import re

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
