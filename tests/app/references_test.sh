#!/usr/bin/env bash
# Every source that the code cites by key is in references.bib.   references_test.sh SOURCE
set -euo pipefail
cd -- "$1"

# cited FILE...: keys such as hairer-lubich-wanner2006, one a line.
cited() { grep -rhoE '\b[a-z]{3,}(-[a-z]+)*(1[5-9]|20)[0-9]{2}[a-z]*\b' "$@" | sort -u; }
listed() { sed -nE 's/^@[a-z]+\{([^,]+),$/\1/p' references.bib | sort; }
unknown() { comm -23 <(cited "$@") <(listed); }

# The control: a key that is not there is found.
control=$(mktemp)
trap 'rm -f "$control"' EXIT
printf '// nobody1999 (7), su-qin, welford1962\n' >"$control"
[[ $(unknown "$control") == nobody1999 ]] || { printf 'FAILED the control: %s\n' "$(unknown "$control")" >&2; exit 1; }

missing=$(unknown core brackets formulations systems integrators runs bench verify derive papers app examples \
  --include='*.?pp' --include='*.toml')
for key in su-qin nguyen-turski pitanga-rodrigues; do
  listed | grep -qx -- "$key" || missing+=" $key"
done
[[ -z $missing ]] || { printf 'FAILED not in references.bib: %s\n' "$missing" >&2; exit 1; }
duplicates=$(listed | uniq -d)
[[ -z $duplicates ]] || { printf 'FAILED twice in references.bib: %s\n' "$duplicates" >&2; exit 1; }
echo "references: as expected"
