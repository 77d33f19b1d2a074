#!/usr/bin/env bash
# Sources that the compiler must refuse, each for the reasons that its comments give; a sound one is the control.
set -euo pipefail
compiler=$1 include=$2 root=$3
compile() { "$compiler" -std=c++20 -fsyntax-only -I "$include" "$1" 2>&1; }

compile "$root/examples/templates/system.cpp" || { echo "the control was refused"; exit 1; }
for source in "$root"/tests/core/refused/*.cpp; do
  if said=$(compile "$source"); then
    echo "$source was accepted"
    exit 1
  fi
  while IFS= read -r reason; do
    grep -qF -- "static assertion failed: $reason" <<<"$said" || {
      echo "$source: expected '$reason' in"
      echo "$said"
      exit 1
    }
  done < <(sed -n 's|^// refused: ||p' "$source")
done
