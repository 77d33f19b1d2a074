"""What `cmake --install` makes can be moved, and finds its libraries and its data where it then stands."""
import os
import pathlib
import shutil
import subprocess
import sys

import pfaff

BUILD = (pathlib.Path(pfaff.__file__).parent / "lib").resolve()
LOOK = """
import pathlib, pfaff
maps = pathlib.Path("/proc/self/maps").read_text()
print(pathlib.Path(pfaff.__file__).parent)
print(*sorted({line.split()[-1] for line in maps.splitlines() if "libpfaff" in line}), sep="\\n")
print(*pfaff.experiments())
"""


def test_an_installed_package_can_be_moved(tmp_path):
    made, moved = tmp_path / "made", tmp_path / "moved"
    for component in ("libraries", "data", "python"):
        subprocess.run(["cmake", "--install", BUILD, "--prefix", made / "pfaff", "--component", component], check=True, capture_output=True)
    made.rename(moved)
    package = next(moved.rglob("_pfaff.*.so")).parent
    assert package.name == "pfaff"
    environment = {**os.environ, "PYTHONPATH": str(package.parent)}
    done = subprocess.run([sys.executable, "-c", LOOK], env=environment, capture_output=True, text=True, check=True, cwd=tmp_path)
    assert done.stderr == ""
    imported, *libraries, experiments = done.stdout.splitlines()
    assert imported == str(package)
    assert libraries and all(library.startswith(str(moved)) for library in libraries)
    assert "kepler" in experiments.split()


def test_a_machine_that_lacks_instructions_is_told_so(tmp_path):
    """The module is compiled once more, for instructions that no machine of today has."""
    root = pathlib.Path(__file__).resolve().parents[2]
    include = subprocess.run([shutil.which("python3-config") or "python3-config", "--includes"], capture_output=True, text=True,
                             check=True).stdout.split()
    subprocess.run(["c++", "-std=c++20", "-fPIC", "-shared", *include, f"-I{BUILD}/include", "-DPFAFF_REQUIRED=PFAFF_REQUIRE(xop)",
                    root / "python" / "machine" / "machine.cpp", "-o", tmp_path / "_machine.so"], check=True)
    done = subprocess.run([sys.executable, "-c", "import _machine"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "ImportError: pfaff is built for machines with the instructions xop, which this one lacks" in done.stderr
