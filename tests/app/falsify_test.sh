#!/usr/bin/env bash
# What `pfaff falsify` prints: a text model, and a command that shows on it that the claim fails.
#   falsify_test.sh PROGRAM PLUGINS SANITIZERS
set -euo pipefail
pfaff=$1
plugins=$2
sanitizers=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
PATH=$(dirname "$pfaff"):$PATH

fail() {
  printf 'FAILED %s\n' "$*" >&2
  exit 1
}

# falsified NAME ARGUMENT...: finds a counterexample, which is called NAME, and runs the command that is printed with
# its model.
falsified() {
  local name=$1 status=0 show
  shift
  pfaff falsify "$@" --budget "${budget:-60}" --out . >"$name.text" 2>"$name.err" || status=$?
  [[ $status == 1 ]] || fail "falsify $*: exit status $status, expected 1: $(<"$name.err")$(<"$name.text")"
  [[ $(sed '/^$/q' "$name.text" | wc -L) -le 80 ]] || fail "falsify $*: the table is wider than 80 columns"
  show=$(sed -n 's|^#   \(pfaff falsify .*\)$|\1|p' "$name.toml")
  [[ -n $show ]] || fail "falsify $*: no command in $name.toml"
  grep -qF -- "$show" "$name.text" || fail "falsify $*: the command is not printed"
  status=0
  bash -c "$show" >"$name.shown" 2>&1 || status=$?
  [[ $status == 1 ]] || fail "$show: exit status $status, expected 1: $(<"$name.shown")"
  grep -q '^FALSIFIED' "$name.shown" || fail "$show: $(<"$name.shown")"
  # The control: the same command judges that a method which keeps the claim keeps it on this system too.
  if [[ -n ${keeper:-} ]]; then
    status=0
    bash -c "${show/pfaff falsify */pfaff falsify $keeper ${show#pfaff falsify * }}" >"$name.kept" 2>&1 || status=$?
    [[ $status == 0 ]] || fail "$keeper on $name: exit status $status, expected 0: $(<"$name.kept")"
  fi
}

keeper=gauss falsified rk4-not-symplectic rk4 --claim symplectic
falsified false-two-step-not-symmetric false-two-step --plugin "$plugins/false-claims.so"
keeper=rattle falsified rk4-not-constrained-symplectic rk4 --claim constrained-symplectic
# A round takes ten seconds with the sanitizers, and the others run the same code on other claims; the search for each
# claim runs with them in a test of its own.
if [[ -n $sanitizers ]]; then
  echo "falsify: as expected"
  exit
fi
keeper=gauss falsified rk4-not-quadratic-invariants rk4 --claim quadratic-invariants
keeper=gauss-darboux falsified rk4-not-k-symplectic rk4 --claim K-symplectic
falsified rk4-not-casimirs rk4 --claim casimirs
falsified rk4-not-entropy rk4 --claim entropy
falsified rk4-not-conformal rk4 --claim conformal
falsified false-singly-diagonal-not-symplectic false-singly-diagonal --plugin "$plugins/false-claims.so"
falsified false-averaged-not-energy false-averaged --plugin "$plugins/false-claims.so"
# With its default parameters the method keeps the claim, and the search there takes the whole budget.
budget=5 falsified false-with-parameters-not-symplectic false-with-parameters --plugin "$plugins/false-claims.so"
echo "falsify: as expected"
