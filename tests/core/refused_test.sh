#!/usr/bin/env bash
# Sources that the compiler must refuse, each for the reasons that its comments give; of every kind of plug-in a
# sound one, its template, is the control. What plug-ins include is precompiled for all of them; that the templates
# include what they need shows where they are built.
set -euo pipefail
compiler=$1 include=$2 root=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
printf '#include <pfaff/core/%s.hpp>\n' system integrator >"$scratch/plugin.hpp"
"$compiler" -std=c++20 -I "$include" -x c++-header "$scratch/plugin.hpp" -o "$scratch/plugin.hpp.gch"
compile() { "$compiler" -std=c++20 -fsyntax-only -I "$include" -include "$scratch/plugin.hpp" "$1" 2>&1; }

for kind in system integrator bracket formulation measure; do
  compile "$root/examples/templates/$kind.cpp" || { echo "the control, a sound $kind, was refused"; exit 1; }
done
for source in "$root"/tests/core/refused/*.cpp; do
  if said=$(compile "$source"); then
    echo "$source was accepted"
    exit 1
  fi
  reasons=0
  while IFS= read -r reason; do
    grep -qF -- "static assertion failed: $reason" <<<"$said" || {
      echo "$source: expected '$reason' in"
      echo "$said"
      exit 1
    }
    reasons=$((reasons + 1))
  done < <(sed -n 's|^// refused\( alone\)\?: ||p' "$source")
  # Where a sentence is all that an author shall read, further errors are too much.
  if grep -q '^// refused alone: ' "$source" && [[ $(grep -c ' error: ' <<<"$said") != "$reasons" ]]; then
    echo "$source: expected no errors but its $reasons reasons in"
    echo "$said"
    exit 1
  fi
  [[ $reasons -gt 0 ]] || { echo "$source gives no reasons"; exit 1; }
done
