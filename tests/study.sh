#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The studies on coarse grids: tables, pictures and pages are written, complete runs are not run again, those of another
# build are told, a run that fails is named.
#   study.sh SIMSAND
set -euo pipefail
simsand=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "study.sh: $*" >&2; exit 1; }

# Three columns, five sets, two spacings; DEM exists of all three.
columns=("$simsand" study columns --spacing 0.005,0.00625 --only dense_a0.5 -o "$folder/columns")
"${columns[@]}" > "$folder/first.log" 2>&1 || { cat "$folder/first.log" >&2; fail "columns failed"; }
grep -q "30 runs, 30 of them to do" "$folder/first.log" || fail "not 30 runs at first: $(head -n 1 "$folder/first.log")"

# One that is missing is run again; one that was interrupted goes on from its checkpoint; others stay.
rm "$folder/columns/5mm/table4/ts_dense_a0.5/result.h5"
run=$folder/columns/5mm/dem/ss_dense_a0.5
rm "$run/result.h5"
(cd "$folder" && exec "$simsand" run "$run/scene.toml" -t 1 -q > /dev/null 2>&1) &
process=$!
for _ in $(seq 500); do [[ -s $run/result.h5 ]] && break; sleep 0.01; done
kill "$process" || fail "the run ended before it could be interrupted"
wait "$process" || true
[[ -s $run/checkpoint.h5 ]] || fail "no checkpoint of the interrupted run"
"${columns[@]}" > "$folder/second.log" 2>&1 || { cat "$folder/second.log" >&2; fail "columns failed again"; }
grep -q "30 runs, 2 of them to do" "$folder/second.log" || fail "not only the two were run: $(head -n 1 "$folder/second.log")"
[[ -e $run/checkpoint.h5 ]] && fail "the interrupted run did not go on"
for file in table4.csv dem.csv literal.csv dem_packing.csv drucker_prager.csv cost.csv trends.csv report.md index.html \
  deposits.png errors.png cost.png dem_all_fields.png dem_heights.png; do
  [[ -s $folder/columns/$file ]] || fail "no $file"
done
[[ $(wc -l < "$folder/columns/table4.csv") == 4 ]] || fail "table4.csv has not one row for each column"
head -n 1 "$folder/columns/table4.csv" | grep -q "^shape,packing,a,void_ratio,height,top,runout,.*dem_height" ||
  fail "columns of table4.csv"
[[ $(wc -l < "$folder/columns/cost.csv") == 11 ]] || fail "cost.csv has not one row for each set and spacing"
grep -q 'src="http' "$folder/columns/index.html" && fail "the page is not self-contained"
grep -q "data:image/png" "$folder/columns/index.html" || fail "the page has no pictures"

# A result of another build is named, and run again where that is asked for.
one=("$simsand" study columns --spacing 0.005 --sets table4 --only ss_dense_a0.5 -o "$folder/columns")
/usr/bin/python3 "$(dirname "${BASH_SOURCE[0]}")/another_build.py" "$folder/columns/5mm/table4/ss_dense_a0.5/result.h5"
"${one[@]}" > "$folder/third.log" 2>&1 || { cat "$folder/third.log" >&2; fail "a result of another build failed"; }
grep -q "1 of 1 complete results are of another build" "$folder/third.log" || fail "another build is not named"
grep -q "1 runs, 0 of them to do" "$folder/third.log" || fail "a result of another build was run again unasked"
"${one[@]}" --again > "$folder/fourth.log" 2>&1 || { cat "$folder/fourth.log" >&2; fail "--again failed"; }
grep -q "1 runs, 1 of them to do" "$folder/fourth.log" || fail "--again did not run"
"${one[@]}" > "$folder/fifth.log" 2>&1 || { cat "$folder/fifth.log" >&2; fail "a run made again failed"; }
grep -q "another build" "$folder/fifth.log" && fail "a run made again is still of another build"

"$simsand" study channel --spacing 0.02 -o "$folder/channel" > "$folder/channel.log" 2>&1 ||
  { cat "$folder/channel.log" >&2; fail "channel failed"; }
[[ $(wc -l < "$folder/channel/channel.csv") == 7 ]] || fail "channel.csv has not one row for each run"
[[ -s $folder/channel/index.html && -s $folder/channel/channel_lines.png ]] || fail "no page of the channel"

mkdir -p "$folder/data/scenes" # a scene whose material is not there
cp "$(dirname "$simsand")/../data/scenes/ss_dense_a0.5.toml" "$folder/data/scenes/"
if "$simsand" study columns --data "$folder/data" --sets table4 -o "$folder/none" 2> "$folder/err"; then fail "no error"; fi
grep -q "SS.toml" "$folder/err" || fail "the missing material is not named: $(cat "$folder/err")"
