"""The examples in docstrings, and in the docs pages on Python, give what they say."""
import doctest
import importlib
import pathlib
import pkgutil

import numpy as np
import pytest

import pfaff

MODULES = [name for _, name, _ in pkgutil.iter_modules(pfaff.__path__) if name not in ("_pfaff", "_machine", "lib")]
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings(name):
    module = importlib.import_module(f"pfaff.{name}")
    names = {"np": np, "pfaff": pfaff, **vars(module)}
    assert doctest.testmod(module, extraglobs=names, optionflags=FLAGS).failed == 0


@pytest.mark.parametrize("name", ["python", "python-systems"])
def test_examples_of_pages(name):
    page = pathlib.Path(__file__).resolve().parents[2] / "docs" / f"{name}.md"
    text = "\n".join(line for line in page.read_text().splitlines() if not line.startswith("```"))
    test = doctest.DocTestParser().get_doctest(text, {"__name__": "page"}, page.name, str(page), 0)
    assert len(test.examples) > 10
    assert doctest.DocTestRunner(optionflags=FLAGS).run(test).failed == 0
