#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The 24 columns at 4 mm show the trends that the paper reports.
#   trends.sh SIMSAND
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" study columns --spacing 0.004 --sets table4 -o "$folder" > "$folder/log" 2>&1 ||
  { cat "$folder/log" >&2; echo "trends.sh: the study failed" >&2; exit 1; }
/usr/bin/python3 "$(dirname "${BASH_SOURCE[0]}")/trends.py" "$folder/trends.csv"
