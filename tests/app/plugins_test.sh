#!/usr/bin/env bash
# Plug-ins and the program: the templates load and register, files that do not fit are refused with exit status 2 and
# one line on stderr before anything in them has run.   plugins_test.sh PROGRAM DIRECTORY
set -euo pipefail
pfaff=$1
plugins=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export PFAFF_WITNESS="$scratch/loaded"
failures=0

fail() {
  printf 'FAILED %s\n' "$*" >&2
  failures=$((failures + 1))
}

# run_pfaff ARGUMENT...: leaves $status and the files out and err.
run_pfaff() {
  rm -f "$PFAFF_WITNESS"
  status=0
  timeout 120 "$pfaff" "$@" >"$scratch/out" 2>"$scratch/err" || status=$?
}

# refused NAME FILE TEXT: refused before loading, saying TEXT.
refused() {
  run_pfaff list systems --plugin "$2"
  [[ $status == 2 ]] || fail "$1: exit status $status, expected 2"
  [[ $(wc -l <"$scratch/err") == 1 ]] || fail "$1: expected one line, got: $(<"$scratch/err")"
  [[ ! -s $scratch/out ]] || fail "$1: wrote to stdout"
  grep -qF -- "$3" "$scratch/err" || fail "$1: expected '$3' in: $(<"$scratch/err")"
  [[ ! -e $PFAFF_WITNESS ]] || fail "$1: was loaded"
}

# The control: the witness does leave its file when it is loaded.
run_pfaff list systems --plugin "$plugins/fits.so"
[[ $status == 0 && -e $PFAFF_WITNESS ]] || fail "fits.so: was not loaded: $(<"$scratch/err")"

refused other-version "$plugins/other-version.so" 'built for pfaff=0.0.9; expected pfaff='
refused two-stamps "$plugins/two-stamps.so" 'built for pfaff=0.0.8; expected pfaff='
refused no-stamp "$plugins/no-stamp.so" 'has no Pfaff ABI stamp'
refused fast-math "$plugins/fast-math.so" 'built for arithmetic=fast; expected arithmetic=strict'
if [[ -e $plugins/other-alignment.so ]]; then
  refused other-alignment "$plugins/other-alignment.so" 'built for alignment='
fi
refused short-enums "$plugins/short-enums.so" 'built for enum=1; expected enum=4'
refused unsigned-char "$plugins/unsigned-char.so" 'built for char=unsigned; expected char=signed'
refused missing "$scratch/missing.so" 'cannot be read'
refused directory "$scratch" 'expected a shared object'
printf 'pfaff-abi-stamp\n' >"$scratch/text.so"
refused text "$scratch/text.so" 'expected a shared object'
head -c 100 "$plugins/fits.so" >"$scratch/short.so"
refused short "$scratch/short.so" 'plug-in'
# Cut off behind its headers: what is missing would be mapped into memory and end the process when it is read.
end=0
while read -r offset size; do
  ((offset + size <= end)) || end=$((offset + size))
done < <(LC_ALL=C readelf -lW "$plugins/fits.so" | awk '$1 == "LOAD" { print $2, $5 }')
head -c "$((end - 1))" "$plugins/fits.so" >"$scratch/cut.so"
refused cut-off "$scratch/cut.so" 'cut off or damaged'
# Nobody ever writes to this pipe, and /dev/zero never ends.
mkfifo "$scratch/pipe.so"
refused pipe "$scratch/pipe.so" 'is no regular file'
refused device /dev/zero 'is no regular file'
refused throws-error "$plugins/throws-error.so" "throws-error.so': throws while it is loaded: not today"
refused throws-odd "$plugins/throws-odd.so" 'throws while it is loaded: an exception of type (anonymous namespace)::Odd'
refused ends-by-signal "$plugins/ends-by-signal.so" 'ends the program while it is loaded: Terminated'
refused ends-by-itself "$plugins/ends-by-itself.so" 'ends the program while it is loaded, with exit status 0'
refused misnamed-system "$plugins/misnamed-system.so" "the name 'My System'; expected kebab-case"
refused misnamed-parameter "$plugins/misnamed-parameter.so" "well-named in"
refused misnamed-parameter "$plugins/misnamed-parameter.so" "the parameter 'rate=1'; expected kebab-case"

# --plugin takes one file: what follows it is the command's own.
run_pfaff list --plugin "$plugins/templates.so" systems
[[ $status == 0 ]] || fail "list --plugin FILE KIND: $(<"$scratch/err")"
grep -q 'template-system' "$scratch/out" || fail "list --plugin FILE KIND: the plug-in is not loaded"
if grep -q 'template-bracket' "$scratch/out"; then fail "list --plugin FILE KIND: more than the kind is listed"; fi

# In a directory of PFAFF_PLUGIN_PATH the same holds, and what fits loads from there.
mkdir "$scratch/good" "$scratch/bad dir"
cp "$plugins/fits.so" "$scratch/good"
cp "$plugins/other-version.so" "$scratch/bad dir"
PFAFF_PLUGIN_PATH="$scratch/good" run_pfaff list systems
[[ $status == 0 && -e $PFAFF_WITNESS ]] || fail "PFAFF_PLUGIN_PATH: not loaded: $(<"$scratch/err")"
PFAFF_PLUGIN_PATH="$scratch/bad dir" run_pfaff list systems
[[ $status == 2 && ! -e $PFAFF_WITNESS ]] || fail "PFAFF_PLUGIN_PATH: exit status $status for a file that does not fit"
PFAFF_PLUGIN_PATH="$scratch/nowhere" run_pfaff list systems
[[ $status == 2 ]] || fail "PFAFF_PLUGIN_PATH: exit status $status for a directory that is not there"

# The templates register, run together, and cannot be registered from two files.
for kind in system integrator bracket formulation measure; do
  run_pfaff list "${kind}s" --plugin "$plugins/templates.so"
  grep -q "template-$kind " "$scratch/out" || fail "template-$kind is not listed"
done
run_pfaff verify template-formulation --plugin "$plugins/templates.so"
[[ $status == 0 ]] || fail "verify template-formulation: $(tail -n 3 "$scratch/out")"
grep -q '^field is its definition ' "$scratch/out" || fail "verify template-formulation: the field was not looked at"
run_pfaff run --plugin "$plugins/templates.so" --system spherical-pendulum --formulation template-formulation \
  --integrator rk4 --step 0.01 --time 1 --out -
[[ $status == 0 && $(wc -l <"$scratch/out") -ge 3 ]] || fail "template-formulation does not run: $(<"$scratch/err")"
for integrator in template-integrator template-multistep-integrator; do
  run_pfaff run --plugin "$plugins/templates.so" --system template-system --integrator "$integrator" \
    --step 0.1 --time 1 --out -
  [[ $status == 0 && $(wc -l <"$scratch/out") -ge 3 ]] || fail "$integrator does not run: $(<"$scratch/err")"
done
run_pfaff verify template-multistep-integrator --plugin "$plugins/templates.so"
[[ $status == 0 ]] || fail "verify template-multistep-integrator: $(tail -n 3 "$scratch/out")"
grep -q '^order ' "$scratch/out" || fail "verify template-multistep-integrator: its order was not measured"
run_pfaff verify template-measure --plugin "$plugins/templates.so"
[[ $status == 0 ]] || fail "verify template-measure: $(tail -n 3 "$scratch/out")"
grep -q '^measure ' "$scratch/out" || fail "verify template-measure: its answers were not looked at"
run_pfaff run --plugin "$plugins/templates.so" --system kepler --integrator verlet --step 0.1 --time 10 \
  --measure 'template-measure(looks=4)' --out "$scratch/measured"
[[ $status == 0 && $(wc -l <"$scratch/measured/measures/template-measure.csv") == 6 ]] ||
  fail "template-measure does not measure: $(<"$scratch/err")"
run_pfaff run --plugin "$plugins/templates.so" --system spherical-pendulum --integrator rattle --step 0.1 --time 10 \
  --measure template-measure --out "$scratch/refused"
[[ $status == 2 && ! -e $scratch/refused ]] || fail "template-measure of constraints: exit status $status, expected 2"
grep -q 'template-measure needs states without constraints; spherical-pendulum has some' "$scratch/err" ||
  fail "template-measure of constraints: $(<"$scratch/err")"
# The Birkhoffian one does what docs/generating-functions.md promises of it.
run_pfaff list systems --plugin "$plugins/templates.so"
grep -q "template-birkhoffian " "$scratch/out" || fail "template-birkhoffian is not listed"
run_pfaff verify template-birkhoffian --plugin "$plugins/templates.so"
[[ $status == 0 ]] || fail "verify template-birkhoffian: $(tail -n 3 "$scratch/out")"
grep -q '^chart is Darboux ' "$scratch/out" || fail "verify template-birkhoffian: the chart was not looked at"
grep -q '^K-symplectic ' "$scratch/out" || fail "verify template-birkhoffian: no method was"
run_pfaff run --plugin "$plugins/templates.so" --system template-birkhoffian --integrator generating-function \
  --set order=8 --step 0.1 --time 100 --out -
[[ $status == 0 ]] || fail "template-birkhoffian does not run: $(<"$scratch/err")"
cp "$plugins/templates.so" "$scratch/copy.so"
run_pfaff list systems --plugin "$plugins/templates.so" --plugin "$scratch/copy.so"
[[ $status == 2 ]] || fail "two copies of the templates: exit status $status, expected 2"
grep -q 'registered twice' "$scratch/err" || fail "two copies of the templates: $(<"$scratch/err")"
for kind in system integrator bracket formulation measure; do
  grep -q "template-$kind in " "$scratch/err" || fail "two copies of the templates: template-$kind is not reported"
done

[[ $failures == 0 ]] && echo "plug-ins: as expected"
