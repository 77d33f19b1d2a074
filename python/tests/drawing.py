"""What the tests of figures have in common: a motion to draw, and no figure that is left open."""
import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("agg")

T = np.linspace(0, 6, 61)
Z = np.column_stack([np.cos(T), -np.sin(T)])


@pytest.fixture(autouse=True)
def no_figure_is_left():
    yield
    from matplotlib import pyplot

    pyplot.close("all")
