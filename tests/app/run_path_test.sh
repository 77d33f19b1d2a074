#!/usr/bin/env bash
# Where the loader looks for libraries: beside the file that needs them, and never in the current directory, which an
# empty entry of the run path would mean. Every ELF file that is built or installed is read.
#   run_path_test.sh BUILD CMAKE PROGRAM COMPILER
# The dollar of $ORIGIN is the loader's, not the shell's.
# shellcheck disable=SC2016
set -euo pipefail
build=$1
cmake=$2
program=$3
compiler=$4
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export LC_ALL=C

fail() {
  printf 'FAILED %s\n' "$*" >&2
  exit 1
}

# run_path FILE: the entries of its run path, one on each line, and whatever it needs by path instead of by name.
run_path() {
  readelf -d "$1" | sed -nE 's/.*\((RPATH|RUNPATH)\).*\[(.*)\]$/\2/p' | tr ':' '\n'
}
# strays FILE: 'FILE: ENTRY' for entries of the run path that do not begin with $ORIGIN.
strays() {
  run_path "$1" | grep -vE '^\$ORIGIN(/|$)' | sed "s|^|$1: '|; s|\$|'|" || true
}
# elf_files DIRECTORY: the ELF files with a dynamic section.
elf_files() {
  find "$1" -type f \( -perm -u+x -o -name '*.so*' \) -print0 |
    while IFS= read -r -d '' file; do
      [[ $(head -c 4 "$file" | tr -d '\0') == $'\177ELF' ]] || continue
      if readelf -d "$file" 2>/dev/null | grep -q 'Dynamic section'; then printf '%s\n' "$file"; fi
    done
}
# check DIRECTORY LEAST: fails where a file strays, or where fewer than LEAST files with a run path are there.
check() {
  local count=0 file all=
  while IFS= read -r file; do
    all+=$(strays "$file")
    [[ -z $(run_path "$file") ]] || count=$((count + 1))
  done < <(elf_files "$1")
  [[ -z $all ]] || fail "run paths beside \$ORIGIN: $all"
  ((count >= $2)) || fail "$1: $count files with a run path, expected at least $2"
}

# The controls: an empty entry, at the end or alone, and the path of a directory are found, $ORIGIN is not.
printf 'int main() { return 0; }\n' >"$scratch/control.cpp"
for path in '$ORIGIN:' ':' ':::' "$scratch" '$ORIGIN:/tmp' '$ORIGINAL'; do
  "$compiler" "$scratch/control.cpp" -o "$scratch/control" "-Wl,-rpath,$path"
  [[ -n $(strays "$scratch/control") ]] || fail "the control: a run path '$path' is not found"
done
"$compiler" "$scratch/control.cpp" -o "$scratch/control" '-Wl,-rpath,$ORIGIN:$ORIGIN/../lib'
[[ -z $(strays "$scratch/control") ]] || fail "the control: $(strays "$scratch/control")"

check "$build" 3
"$cmake" --install "$build" --prefix "$scratch/installed" >/dev/null
check "$scratch/installed" 3

# And seen at work: a library of a name that the program needs, in the directory where it is started.
mkdir "$scratch/here"
needed=$(readelf -d "$build/libpfaff_bench.so" | sed -nE 's/.*\(NEEDED\).*\[(libtbb[^]]*)\]$/\1/p')
[[ -n $needed ]] || fail "libpfaff_bench.so does not need libtbb"
printf '#include <unistd.h>\n__attribute__((constructor)) static void start() { _exit(99); }\n' >"$scratch/fake.cpp"
"$compiler" -shared -fPIC "$scratch/fake.cpp" -o "$scratch/here/$needed"
for one in "$program" "$scratch/installed/bin/pfaff"; do
  status=0
  (cd "$scratch/here" && "$one" --version >/dev/null 2>&1) || status=$?
  [[ $status == 0 ]] || fail "$one: exit status $status with a library $needed in the current directory"
done
# The control: asked to, the loader does take it.
status=0
LD_LIBRARY_PATH="$scratch/here" "$program" --version >/dev/null 2>&1 || status=$?
[[ $status == 99 ]] || fail "the control: the library of the current directory was never looked at ($status)"
echo "run paths: as expected"
