#!/usr/bin/env bash
# What is installed of the headers: those of cmake/public_headers.txt, each of which finds what it includes, and what they
# include, but nothing else.
#   public_headers_test.sh SOURCE BUILD CMAKE FLAGS
set -euo pipefail
source=$1
build=$2
cmake=$3
flags=$4
export LC_ALL=C  # one order for sort and comm
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
  printf 'FAILED %s\n' "$*" >&2
  exit 1
}

"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null
include="$scratch/prefix/include/pfaff"
grep -v '^#' "$source/cmake/public_headers.txt" >"$scratch/listed"
(cd "$include" && find . -path ./detail -prune -o -type f -printf '%P\n' | sort >"$scratch/public")
(cd "$include/detail/pfaff" && find . -type f -printf '%P\n' | sort >"$scratch/detail")

count=$(wc -l <"$scratch/listed")
((count <= 80)) || fail "$count public headers, expected at most 80"
different=$(diff "$scratch/listed" "$scratch/public") ||
  fail "listed in sorted order (<) and installed for authors (>) are: $different"

# What is installed besides is included by something that is installed, by the same lines as in the tree.
mapfile -t installed < <(find "$include" -type f)
grep -hoE '^ *# *include <pfaff/[^>]+' "${installed[@]}" | sed 's/.*<pfaff.//' | sort -u >"$scratch/included"
unneeded=$(comm -23 "$scratch/detail" "$scratch/included")
[[ -z $unneeded ]] || fail "installed, but included by nothing: $unneeded"

# What examples and pages name with angles are public headers, but for the placeholder of the house rules.
mapfile -t shown < <(find "$source/examples" "$source/docs" "$source/tests/app/outside" -name '*.[ch]pp' -o -name '*.md')
grep -hoE '<pfaff/[a-z0-9_/]+\.hpp>' "${shown[@]}" "$source/CONTRIBUTING.md" "$source/README.md" | sed 's/<pfaff.//; s/>//' |
  grep -vxF room/file.hpp | sort -u >"$scratch/shown"
(($(wc -l <"$scratch/shown") > 10)) || fail "found hardly any header in examples and pages: $(<"$scratch/shown")"
private=$(comm -23 "$scratch/shown" "$scratch/listed")
[[ -z $private ]] || fail "examples and pages name what is not in cmake/public_headers.txt: $private"

# Each finds all that it includes, with what the package asks for and nothing else. That it compiles alone is seen of the same
# lines in the tree (.ci/includes.py). Of those that one another include, each is read after what it includes.
mkdir "$scratch/alone"
"$source/.ci/includes.py" --chains "$scratch/listed" >"$scratch/chains"
different=$(diff "$scratch/listed" <(tr ' ' '\n' <"$scratch/chains" | sort)) || fail "read are (>) instead of (<): $different"
{
  printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(Alone LANGUAGES CXX)' 'find_package(Pfaff REQUIRED)'
  printf '%s\n' 'add_library(alone OBJECT'
  number=0
  while read -r -a chain; do
    number=$((number + 1))
    printf '#include <pfaff/%s>\n' "${chain[@]}" >"$scratch/alone/$number.cpp"
    printf '%s\n' "$number.cpp"
  done <"$scratch/chains"
  printf '%s\n' ')' 'target_link_libraries(alone PRIVATE Pfaff::studies)' \
    'target_compile_options(alone PRIVATE -E)'
} >"$scratch/alone/CMakeLists.txt"
"$cmake" -S "$scratch/alone" -B "$scratch/alone/build" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/prefix" \
  -DCMAKE_CXX_FLAGS="$flags" >"$scratch/log" 2>&1 || fail "public headers: $(<"$scratch/log")"
"$cmake" --build "$scratch/alone/build" -- -k 0 >"$scratch/log" 2>&1 ||
  fail "public headers, alone: $(grep -E 'error' "$scratch/log" | head -n 5)"
echo "public headers: $count, with $(wc -l <"$scratch/detail") that they include"
