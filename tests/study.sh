#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The studies on coarse grids: tables, pictures and pages are written, complete runs are not run again, a run that
# fails is named.
#   study.sh SIMSAND
set -euo pipefail
simsand=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "study.sh: $*" >&2; exit 1; }

columns=("$simsand" study columns --spacing 0.005 --only dense_a0.5 --sets table4,dem,literal -o "$folder/columns")
"${columns[@]}" > "$folder/first.log" 2>&1 || { cat "$folder/first.log" >&2; fail "columns failed"; }
grep -q "9 runs, 9 of them to do" "$folder/first.log" || fail "not 9 runs at first"
"${columns[@]}" > "$folder/second.log" 2>&1
grep -q "9 runs, 0 of them to do" "$folder/second.log" || fail "complete runs were run again"
for file in table4.csv dem.csv literal.csv index.html table4_deposits.png table4_all_fields.png; do
  [[ -s $folder/columns/$file ]] || fail "no $file"
done
[[ $(wc -l < "$folder/columns/table4.csv") == 4 ]] || fail "table4.csv has not one row for each column"
head -n 1 "$folder/columns/table4.csv" | grep -q "^shape,packing,a,void_ratio,height,runout,.*dem_height" ||
  fail "columns of table4.csv"

"$simsand" study channel --spacing 0.02 -o "$folder/channel" > "$folder/channel.log" 2>&1 ||
  { cat "$folder/channel.log" >&2; fail "channel failed"; }
[[ $(wc -l < "$folder/channel/channel.csv") == 7 ]] || fail "channel.csv has not one row for each run"
[[ -s $folder/channel/index.html && -s $folder/channel/channel_lines.png ]] || fail "no page of the channel"

mkdir -p "$folder/data/scenes" # a scene whose material is not there
cp "$(dirname "$simsand")/../data/scenes/ss_dense_a0.5.toml" "$folder/data/scenes/"
if "$simsand" study columns --data "$folder/data" -o "$folder/none" 2> "$folder/err"; then fail "no error"; fi
grep -q "SS.toml" "$folder/err" || fail "the missing material is not named: $(cat "$folder/err")"
