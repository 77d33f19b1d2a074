"""The notebooks of examples/ run from beginning to end. What they state with `assert` holds."""
import os
import pathlib
import subprocess
import sys

import pytest

import pfaff

NOTEBOOKS = pathlib.Path(__file__).resolve().parents[2] / "examples" / "notebooks"

pytest.importorskip("nbconvert")
pytest.importorskip("ipykernel")


@pytest.mark.parametrize("name", sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb")))
def test_a_notebook_runs(name, tmp_path):
    import nbformat

    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(pfaff.__file__).parents[1]), "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    environment.pop("MPLBACKEND", None)
    done = subprocess.run(
        [sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir", tmp_path, NOTEBOOKS / f"{name}.ipynb"],
        env=environment, capture_output=True, text=True, check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    notebook = nbformat.read(tmp_path / f"{name}.ipynb", as_version=4)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    outputs = [output for cell in code for output in cell.outputs]
    assert not [output for output in outputs if output.output_type == "stream" and output.name == "stderr"]
    # Every cell that draws has a figure.
    drawing = [cell for cell in code if ".plot(" in cell.source and "to_jshtml" not in cell.source]
    assert len(drawing) > 0 and all(any("image/png" in output.get("data", {}) for output in cell.outputs) for cell in drawing)


def test_notebooks_are_kept_without_outputs():
    """Outputs would go out of date, and hide what a change is about."""
    import nbformat

    for path in NOTEBOOKS.glob("*.ipynb"):
        cells = [cell for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code"]
        assert not any(cell.outputs or cell.execution_count for cell in cells), path.name
