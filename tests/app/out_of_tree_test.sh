#!/usr/bin/env bash
# What a researcher does: install Pfaff, build a plug-in and a program against it elsewhere, run both.
#   out_of_tree_test.sh SOURCE BUILD CMAKE FLAGS
set -euo pipefail
source=$1
build=$2
cmake=$3
flags=$4
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
  printf 'FAILED %s\n' "$*" >&2
  exit 1
}

# Installed into a path with a space, then moved: the package finds itself wherever it is.
"$cmake" --install "$build" --prefix "$scratch/first place" >/dev/null
mv "$scratch/first place" "$scratch/moved here"
prefix="$scratch/moved here"
pfaff="$prefix/bin/pfaff"
unset LD_LIBRARY_PATH PFAFF_PLUGIN_PATH

# The library of studies stands beside the others; without it, it is said what to do.
"$pfaff" derive damped-pendulum --method birkhoffian >/dev/null || fail "the library of studies is not found"
mkdir "$scratch/away"
mv "$prefix"/lib*/libpfaff_studies.so* "$prefix"/lib*/*/libpfaff_studies.so* "$scratch/away" 2>/dev/null || true
[[ -n $(ls "$scratch/away") ]] || fail "no library of studies is installed"
status=0
"$pfaff" derive damped-pendulum --method birkhoffian 2>"$scratch/err" || status=$?
[[ $status == 2 && $(<"$scratch/err") == *"is missing"*"installed again" ]] ||
  fail "without the library of studies: exit status $status, $(<"$scratch/err")"
mv "$scratch"/away/* "$(dirname "$(find "$prefix" -name libpfaff_bench.so)")"

# A program that calls it is linked to it, and has what is loaded otherwise.
mkdir "$scratch/checks"
printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(Checks LANGUAGES CXX)' 'find_package(Pfaff REQUIRED)' \
  'add_executable(checks checks.cpp)' 'target_link_libraries(checks PRIVATE Pfaff::studies)' \
  >"$scratch/checks/CMakeLists.txt"
printf '%s\n' '#include <pfaff/bench/studies/studies.hpp>' '#include <pfaff/verify/check.hpp>' 'int main() {' \
  '  int failed = 0;' '  for (const pfaff::Check& check : pfaff::verify({.names = {"canonical"}})) failed += !good(check);' \
  '  return failed + pfaff::studies().verify({.names = {"canonical"}}, {.quiet = true});' '}' >"$scratch/checks/checks.cpp"
"$cmake" -S "$scratch/checks" -B "$scratch/checks/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_FLAGS="$flags" >"$scratch/log" 2>&1 || fail "checks: $(<"$scratch/log")"
"$cmake" --build "$scratch/checks/build" >"$scratch/log" 2>&1 || fail "checks: $(<"$scratch/log")"
"$scratch/checks/build/checks" || fail "a program that is linked to the library of studies: exit status $?"

for example in plugin program; do
  "$cmake" -S "$source/examples/$example" -B "$scratch/$example" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_FLAGS="$flags" >"$scratch/log" 2>&1 || fail "$example: $(<"$scratch/log")"
  "$cmake" --build "$scratch/$example" >"$scratch/log" 2>&1 || fail "$example: $(<"$scratch/log")"
  if grep -E 'warning:|note:' "$scratch/log"; then fail "$example: compiles with complaints"; fi
done

# Methods that a program instantiates have the bits of the registered ones, which stay the library's. Optimised, as a
# compiler that contracts products and sums would only do it then.
"$cmake" -S "$source/tests/app/outside" -B "$scratch/outside" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="$flags" >"$scratch/log" 2>&1 || fail "outside: $(<"$scratch/log")"
"$cmake" --build "$scratch/outside" >"$scratch/log" 2>&1 || fail "outside: $(<"$scratch/log")"
for instantiated in by_program by_library; do
  "$scratch/outside/$instantiated" >"$scratch/out" || fail "$instantiated: $(grep DIFFERENT "$scratch/out")"
done
"$scratch/outside/first_reads" "$scratch/outside/reads_while_loaded.so" >"$scratch/out" || fail "first reads: $(<"$scratch/out")"

"$scratch/program/energy" >"$scratch/out"
awk '$1 == "verlet" { verlet = $2 } $1 == "rk4" { rk4 = $2 }
     END { exit !(verlet > 0 && verlet < 0.1 && rk4 > 3 * verlet) }' "$scratch/out" ||
  fail "energy: $(<"$scratch/out")"

# The pieces of docs/cpp.md: cos 1, the energy -7/64, {x, y} = -z at z = 0.3, a pendulum's acceleration along its circle.
(cd "$scratch" && program/tour >out)
awk '$1 == "energy" { good += $2 > 0 && $2 < 1e-6 } $1 == "odeint" { good += $2 == 0.540302 }
     $1 == "well" { good += $2 > -0.10940 && $2 < -0.10935 } $1 == "bracket" { good += $2 == -0.3 }
     $1 == "rods" { good += $2 == 0 && $4 == -4.7088 && $5 == -3.5316 } END { exit good != 5 }' "$scratch/out" ||
  fail "tour: $(<"$scratch/out")"

plugin="$scratch/plugin/duffing.so"
# grep reads to the end: with -q it would end at its first finding, and the program complains of a closed pipe.
"$pfaff" list systems --plugin "$plugin" | grep '^ *duffing ' >/dev/null || fail "duffing is not listed"
PFAFF_PLUGIN_PATH="$scratch/plugin" "$pfaff" list integrators | grep '^ *ralston ' >/dev/null || fail "ralston is not listed"
"$pfaff" list systems | grep '^ *duffing ' >/dev/null && fail "duffing is listed without its plug-in"

# The new integrator on the new system, against a method of the library at a tenth of the step: order 3.
for run in 'ralston 0.02' 'ralston 0.01' 'rk4 0.001'; do
  "$pfaff" run --plugin "$plugin" --system duffing --integrator "${run% *}" --step "${run#* }" --time 5 --out - |
    tail -n 1 >>"$scratch/ends"
done
awk -F, '{ q[NR] = $2 } function size(x) { return x < 0 ? -x : x }
         END { coarse = size(q[1] - q[3]); fine = size(q[2] - q[3]); ratio = coarse / fine
               print "errors", coarse, fine, "ratio", ratio; exit !(fine < 1e-5 && ratio > 6.5 && ratio < 9.5) }' \
  "$scratch/ends" || fail "ralston on duffing: $(<"$scratch/ends")"

# The new integrator on a system of the library.
"$pfaff" run --plugin "$plugin" --system henon-heiles --integrator ralston --step 0.1 --time 1 --out - >"$scratch/out"
[[ $(wc -l <"$scratch/out") -ge 3 ]] || fail "ralston on henon-heiles: $(<"$scratch/out")"
echo "out of tree: as expected"
