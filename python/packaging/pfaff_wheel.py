"""How pip makes a wheel of Pfaff: CMake builds and installs, and what it installs is packed.

    pip install --no-build-isolation .

builds with the preset `portable`, for every machine of the architecture, in build/wheel, which a second build uses again.
`--config-settings=build-dir=build/release` packs what stands in another build directory instead, as that is configured.

The functions are the hooks of PEP 517, and nothing is downloaded. The wheel holds the package with its libraries in
pfaff/lib and its data in pfaff/share, and can be moved.
"""
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

from wheel.wheelfile import WheelFile

ROOT = Path(__file__).resolve().parents[2]
METADATA = """Metadata-Version: 2.1
Name: pfaff
Version: {version}
Summary: Structure-preserving integration: brackets, systems, integrators, drift and cost
Requires-Python: >=3.11
Requires-Dist: numpy
Provides-Extra: plots
Requires-Dist: matplotlib ; extra == 'plots'
Provides-Extra: tables
Requires-Dist: pandas ; extra == 'tables'
Provides-Extra: symbols
Requires-Dist: sympy ; extra == 'symbols'
"""
WHEEL = """Wheel-Version: 1.0
Generator: pfaff
Root-Is-Purelib: false
Tag: {tag}
"""


def version():
    """The version number, which the C++ library has, too."""
    text = (ROOT / "core" / "registry" / "version.hpp").read_text()
    return re.search(r'PFAFF_VERSION_TEXT "([^"]+)"', text).group(1)


def tag():
    """The interpreter and the platform that the extension is for."""
    python = "cp{}{}".format(*sys.version_info[:2])
    return f"{python}-{python}-" + re.sub(r"[-.]", "_", sysconfig.get_platform())


def get_requires_for_build_wheel(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Leaves what is known before anything is built, so that pip does not build twice. Returns its folder."""
    return write_information(Path(metadata_directory)).name


def write_information(folder):
    """The folder with what pip reads of a wheel."""
    information = folder / f"pfaff-{version()}.dist-info"
    information.mkdir()
    (information / "METADATA").write_text(METADATA.format(version=version()))
    (information / "WHEEL").write_text(WHEEL.format(tag=tag()))
    (information / "LICENSE").write_text((ROOT / "LICENSE").read_text())
    return information


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Builds, and leaves the wheel in the directory. Returns its name."""
    chosen = (config_settings or {}).get("build-dir")
    build = (ROOT / (chosen or "build/wheel")).resolve()
    preset = [] if chosen else ["--preset", "portable", "-DPFAFF_TESTS=OFF", "-DPFAFF_BENCHMARKS=OFF", "-DPFAFF_JOINED=ON"]
    parallel = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count())
    run(["cmake", *preset, "-S", ROOT, "-B", build, "-DPFAFF_PYTHON=ON", f"-DPFAFF_PYTHON_PROGRAM={sys.executable}",
         "-DPFAFF_PYTHON_DESTINATION=.", "-DCMAKE_INSTALL_LIBDIR=lib", "-DCMAKE_INSTALL_DATADIR=share"])
    run(["cmake", "--build", build, "--parallel", parallel, "--target", "pfaff_python", "pfaff_python_machine",
         "pfaff_trial_load"])
    name = f"pfaff-{version()}-{tag()}.whl"
    with tempfile.TemporaryDirectory() as folder:
        for component in ("libraries", "data", "python"):
            run(["cmake", "--install", build, "--prefix", Path(folder) / "pfaff", "--component", component])
        for link in (Path(folder) / "pfaff" / "lib").glob("*.so.*"):
            if link.is_symlink():  # wheels have no links: the library itself takes the name that is asked for
                link.resolve().rename(link)
        write_information(Path(folder))
        with WheelFile(Path(wheel_directory) / name, "w") as wheel:
            wheel.write_files(folder)
    return name


def run(words):
    subprocess.run([str(word) for word in words], check=True, cwd=ROOT)
