#!/usr/bin/env bash
# Installs the Debian packages that Pfaff is built from, where any is missing; otherwise does nothing, quickly.
# `--tests` adds what the Python module is built from and tested with, and what other tests use; `--lint` besides what
# .ci/run checks the sources with, and MPI, which one test needs. PFAFF_SKIP_SETUP=1 skips all of it.
#
# Exit status: 0 everything is there; 2 something is missing and cannot be installed from here, or nothing can be built.
set -euo pipefail

# What is built goes to `build`, which is looked at first: CMake's own words about it name a folder of its own.
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
for folder in "$root/build/release" "$root/build" "$root"; do
  [[ -e $folder ]] || continue
  [[ -d $folder && -w $folder ]] && break
  printf 'pfaff: %s: expected a folder that can be written, where Pfaff is built\n' "$folder" >&2
  exit 2
done
[[ ${PFAFF_SKIP_SETUP:-} == 1 ]] && exit 0

# The one list: package, and how to see it on systems without Debian's package manager (a program, a header, or a
# Python module).
needed=(
  "g++ program:g++"
  "cmake program:cmake"
  "ninja-build program:ninja"
  "libboost-dev header:boost/numeric/odeint.hpp"
  "libcli11-dev header:CLI/CLI.hpp"
  "libtomlplusplus-dev header:toml++/toml.h"
  "nlohmann-json3-dev header:nlohmann/json.hpp"
  "libtbb-dev header:tbb/version.h"
  "libeigen3-dev header:eigen3/Eigen/Core"
  "libgtest-dev header:gtest/gtest.h"
  "libgmock-dev header:gmock/gmock.h"
  "libbenchmark-dev header:benchmark/benchmark.h"
  "python3 program:python3"
  "python3-matplotlib module:matplotlib"
  "python3-sympy module:sympy"
)
[[ ${1:-} == --tests || ${1:-} == --lint ]] && needed+=(
  "python3-dev program:python3-config"
  "pybind11-dev header:pybind11/pybind11.h"
  "python3-numpy module:numpy"
  "python3-scipy module:scipy"
  "python3-pandas module:pandas"
  "python3-pytest module:pytest"
  "python3-ipykernel module:ipykernel"
  "jupyter-nbconvert module:nbconvert"
  "mypy program:stubgen"
  "git program:git"
)
[[ ${1:-} == --lint ]] && needed+=(
  "clang-format program:clang-format"
  "clang-tidy program:clang-tidy"
  "clang program:clang++"
  "libclang-dev header:clang-c/Index.h"
  "llvm-dev program:llvm-config"
  "shellcheck program:shellcheck"
  "groff-base program:groff"
  "python3-markdown module:markdown"
  "libopenmpi-dev program:mpicxx"
  "openmpi-bin program:mpirun"
)

# Can it be seen at all, however it came here?
visible() {
  case $1 in
    program:*) command -v "${1#*:}" >/dev/null ;;
    header:*)
      printf '#if !__has_include(<%s>)\n#error\n#endif\n' "${1#*:}" |
        "${CXX:-c++}" -std=c++20 -fsyntax-only -x c++ - >/dev/null 2>&1
      ;;
    module:*)
      python3 -c "import importlib.util, sys; sys.exit(importlib.util.find_spec('${1#*:}') is None)" 2>/dev/null
      ;;
  esac
}

# Nothing can be installed from here: is what is missing here under another name?
by_hand() {
  local unseen=() entry
  for entry in "${needed[@]}"; do
    visible "${entry#* }" || unseen+=("${entry% *}")
  done
  [[ ${#unseen[@]} == 0 ]] && exit 0
  printf 'pfaff: %s\npfaff: install by hand (Debian names): %s\n' "$1" "${unseen[*]}" >&2
  printf 'pfaff: PFAFF_SKIP_SETUP=1 goes on without\n' >&2
  exit 2
}

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  by_hand "what Pfaff is built from is not all here, and there is no apt-get"
fi
present=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${needed[@]% *}" 2>/dev/null || true)
missing=()
for package in "${needed[@]% *}"; do
  [[ $'\n'$present$'\n' == *$'\n'"$package installed"$'\n'* ]] || missing+=("$package")
done
[[ ${#missing[@]} == 0 ]] && exit 0

as_root=()
if [[ $(id -u) != 0 ]]; then
  command -v sudo >/dev/null || by_hand "packages are missing, and installing them needs root or sudo"
  as_root=(sudo)
fi
printf 'pfaff: installing with apt-get: %s\n' "${missing[*]}" >&2
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300)
"${apt[@]}" update >&2 || printf 'pfaff: apt-get update failed; trying with the lists that are here\n' >&2
"${apt[@]}" install -y --no-install-recommends "${missing[@]}" >&2 || by_hand "apt-get could not install the packages"
