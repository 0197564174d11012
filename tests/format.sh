#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every C++ file is as clang-format leaves it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Without git (an unpacked archive) all folders of sources stand for the tracked files.
if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
  mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
else
  mapfile -t files < <(find vumat host drivers calibration tests -name '*.cpp' -o -name '*.hpp')
fi
[ ${#files[@]} -gt 0 ]
clang-format --dry-run --Werror "${files[@]}"
echo "${#files[@]} files"
