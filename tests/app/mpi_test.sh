#!/usr/bin/env bash
# mpi_test.sh PFAFF [SOURCE INCLUDE COMPILER]: pfaff compare shared by the processes of mpirun leaves what one
# process leaves, refuses what it refuses, and is resumed after a process was killed. PFAFF is built with
# -DPFAFF_MPI=ON; or without, and SOURCE, bench/launched/mpi.cpp, is built here and loaded before the libraries.
# Without MPI the test is skipped, status 77.
set -euo pipefail
pfaff=$1 source=${2:-}
files=$(mktemp -d)
trap 'rm -rf "$files"' EXIT
cd "$files"
fail() { echo "mpi_test: $*" >&2; exit 1; }
command -v mpirun >mpi || { echo "mpi_test: there is no mpirun here (Debian: openmpi-bin); skipped"; exit 77; }
program=("$pfaff")
if [ -n "$source" ]; then
  command -v mpicxx >mpi || { echo "mpi_test: there is no mpicxx here (Debian: libopenmpi-dev); skipped"; exit 77; }
  OMPI_CXX=$4 mpicxx -DOMPI_SKIP_MPICXX -std=c++20 -Wall -Wextra -Werror -fPIC -shared -I "$3" "$source" -o team.so
  program=(env "LD_PRELOAD=$files/team.so" "$pfaff")
fi
mpirun=(mpirun --allow-run-as-root --oversubscribe) compare=(compare --no-report --timing 0.01)
launch() { "${mpirun[@]}" -n "$1" "${program[@]}" "${compare[@]}" "${@:2}"; }

cat >test.toml <<'EOF'
schema = 1
title = "A test"
[[method]]
label = "Gauss"
integrator = "gauss"
set = { stages = [2, 3] }
[[method]]
label = "RK4"
integrator = "rk4"
[[case]]
name = "pendulum"
system = "pendulum"
time = 20
steps = [0.5, 0.2, 0.1]
conserved = "energy"
[[case]]
name = "automatic"
system = "henon-heiles"
time = 20
steps = "auto"
evaluations = 10000
conserved = "energy"
[[case]]
name = "long"
system = "pendulum"
time = 2000
steps = [0.01]
precision = "quad"
reference = "none"
structure = "none"
methods = ["RK4"]
EOF

"$pfaff" "${compare[@]}" test.toml --out one >/dev/null
for ranks in 2 4; do
  launch $ranks test.toml --out "with-$ranks" >"said-$ranks"
  cmp one/results.csv "with-$ranks/results.csv" || fail "$ranks processes leave other results"
  [ "$(grep -c '^results ' "said-$ranks")" = 1 ] || fail "expected one process of $ranks to speak"
  [ "$(sed 's/.*,//' "with-$ranks/cost.csv" | sort -u | grep -vxc host)" = 1 ] || fail "expected one host in cost.csv"
done

# One line from one process, and an exit status that is not 0.
sed 's/"rk4"/"rk5"/' test.toml >wrong.toml
if launch 2 wrong.toml --out wrong >/dev/null 2>refused; then fail "a wrong experiment is accepted"; fi
[ "$(grep -c "^pfaff: .*unknown integrator 'rk5'" refused)" = 1 ] || fail "expected one message, got: $(cat refused)"

# A process is killed once some runs are there: the launcher ends the others, and the same command resumes.
"${mpirun[@]}" -n 2 "${program[@]}" "${compare[@]}" test.toml --out killed >/dev/null 2>&1 &
launcher=$!
until [ "$(find killed/runs -name summary.json -not -path '*.part/*' 2>/dev/null | wc -l)" -ge 3 ]; do sleep 0.05; done
kill -9 "$(pgrep -P "$launcher" | tail -n 1)"
if wait "$launcher"; then fail "a killed process went unnoticed"; fi
[ ! -e killed/results.csv ] || fail "the kill came too late"
launch 2 test.toml --out killed >resumed
grep -q '([1-9][0-9]* resumed' resumed || fail "nothing was resumed: $(cat resumed)"
cmp one/results.csv killed/results.csv || fail "the resumed experiment leaves other results"
