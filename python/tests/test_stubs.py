"""The stub of the extension module is the one that stubgen makes of what is built, and the package's types hold together."""
import pathlib
import shutil
import subprocess
import sys

import pytest

import pfaff

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python" / "packaging"))
import stubs  # noqa: E402

pytestmark = pytest.mark.skipif(shutil.which("stubgen") is None, reason="mypy is not installed")


def test_the_stub_is_up_to_date():
    assert stubs.PLACE.read_text() == stubs.stub(), "expected what python/packaging/stubs.py --write makes"


def test_the_package_says_that_it_has_types():
    assert (pathlib.Path(pfaff.__file__).parent / "py.typed").exists()


def said_of(tmp_path, *files):
    """What mypy says. The stubs of NumPy and others take most of its time, and say nothing of the package."""
    (tmp_path / "mypy.ini").write_text("[mypy]\nignore_missing_imports = True\n" + "".join(
        f"[mypy-{name}.*]\nfollow_imports = skip\n" for name in ("numpy", "matplotlib", "pandas", "scipy", "sympy")))
    return subprocess.run(["mypy", "--cache-dir", tmp_path / "cache", *files], cwd=tmp_path, capture_output=True, text=True,
                          env={"MYPYPATH": str(ROOT / "python"), "PATH": "/usr/bin:/bin"}, check=False).stdout


def test_the_types_of_the_package_hold_together(tmp_path):
    assert "Success" in said_of(tmp_path, ROOT / "python" / "pfaff")


def test_types_are_known_to_those_who_use_the_package(tmp_path):
    """What mypy says of code that is right, and of code that is not."""
    (tmp_path / "right.py").write_text(
        "import pfaff\n"
        "checks: pfaff.Checks = pfaff.verify('verlet', on='kepler')\n"
        "ok: bool = checks.ok\n"
        "number: float = pfaff.bracket(lambda q: q, lambda p: p, [0.5, 0.2], on='pendulum')\n"
        "curves = pfaff.compare('kepler', quick=True).work_precision.plot()\n"
    )
    (tmp_path / "wrong.py").write_text("import pfaff\nchecks: int = pfaff.verify('verlet')\nrows = pfaff.reproduce(3)\n")
    said = {name: said_of(tmp_path, "--follow-imports", "silent", f"{name}.py") for name in ("right", "wrong")}
    assert "Success" in said["right"], said["right"]
    assert said["wrong"].count("error:") == 2, said["wrong"]
